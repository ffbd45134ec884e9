//! What holds whatever is typed: no statement ends in a panic, one that fails changes no bit of what
//! follows, nor do undo and redo, nor saving and loading; and what is said to be solved is so.

use super::random_command::session;
use crate::support::compare::check_same;
use crate::support::draws::draws;
use crate::support::fresh::flaws;
use crate::support::talk::Talking;
use linkwork::session::Flow;
use proptest::prelude::*;

/// How often a statement may ask whether it is to go on: a frame of a billion iterations is what was
/// asked for.
const PATIENCE: u64 = 60;

/// What a look within a long piece of work counts for: there are milliseconds between two of them.
const POLLS_A_LOOK: u64 = 30;

/// What is told where a statement was stopped in the middle.
const LEFT: &str = "stopped; it changed nothing";

/// What comes after everything else.
const AFTER: [&str; 3] = ["step 2", "solve", "print velocity(B), time; list"];

/// How a statement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    Done,
    Failed,
    /// It would have gone on for longer than anybody waits, and changed nothing.
    Left,
    /// It would have gone on for longer than anybody waits, and did some of it.
    Stopped,
}

fn carry_out(talking: &mut Talking, statement: &str) -> End {
    talking.talk.n_polls.set(0);
    talking.talk.told.clear();
    match talking.execute(statement) {
        Err(_) => End::Failed,
        Ok(Flow::Stopped) if talking.talk.told().iter().any(|told| told == LEFT) => End::Left,
        Ok(Flow::Stopped) => End::Stopped,
        Ok(_) => End::Done,
    }
}

fn patient() -> Talking {
    let mut talking = Talking::default();
    talking.talk.most_polls = Some(PATIENCE);
    talking.talk.polls_a_look = POLLS_A_LOOK;
    talking
}

/// What a command claims of the pose that it leaves.
fn assert_claim_holds(talking: &mut Talking, statement: &str) {
    let told = talking.talk.told();
    let is_claimed = statement == "solve" && told.iter().any(|told| told.starts_with("converged"));
    if is_claimed {
        let line = talking.ask("set tolerance").concat();
        let tolerance = line.split_whitespace().nth(2).and_then(|value| value.parse().ok());
        let flaws = flaws(talking.world(), 4.0 * tolerance.unwrap_or(1e-12));
        assert!(flaws.is_empty(), "{flaws:?}");
    }
}

/// What a session is held to beside the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// What fails leaves no trace.
    Failing,
    /// Nor do undo and redo.
    Undoing,
    /// What is loaded from its file goes on as it does.
    Saving,
    /// All of these.
    All,
}

impl Held {
    fn to(self, what: Self) -> bool {
        self == what || self == Self::All
    }
}

/// One that is told nothing: notes and warnings change nothing of what there is.
fn deaf() -> Talking {
    let mut talking = patient();
    talking.talk.is_deaf = true;
    talking
}

/// Carries a statement out that took effect elsewhere; whether it did in time.
fn follow(talking: &mut Talking, statement: &str) -> bool {
    match carry_out(talking, statement) {
        End::Stopped | End::Left => false,
        End::Failed => panic!("`{statement}` fails without what failed before"),
        End::Done => true,
    }
}

/// Takes a statement back and does it again.
fn walk(talking: &mut Talking, statement: &str) {
    let before = talking.script();
    if carry_out(talking, "undo") == End::Done {
        assert_eq!(carry_out(talking, "redo"), End::Done, "what was undone");
    }
    check_same(&talking.script(), &before, &format!("`{statement}` undone and redone"));
}

/// Carries statements out, with failures, undo and redo among them, and again with nothing but what
/// took effect; both are then the same, and so is what is loaded from their file.
pub fn hold_out(beginning: &[String], statements: &[String], held: Held) {
    // Who is to blame for a pose is nearly half of all work: it is told where that is held against one
    // who is not told.
    let mut talking = if held.to(Held::Failing) { patient() } else { deaf() };
    let mut others: Vec<Talking> = Vec::new();
    if held.to(Held::Failing) {
        others.push(deaf());
    }
    for (k, statement) in beginning.iter().chain(statements).enumerate() {
        match carry_out(&mut talking, statement) {
            End::Stopped => return,
            // One that was left is one that failed.
            End::Failed | End::Left => continue,
            End::Done => {}
        }
        assert_claim_holds(&mut talking, statement);
        // What was taken back is taken back in both.
        if !others.iter_mut().all(|plain| follow(plain, statement)) {
            return;
        }
        let is_walk = statement.starts_with("undo") || statement == "redo";
        let is_due = k >= beginning.len() && k.is_multiple_of(2) && !is_walk;
        if is_due && held.to(Held::Undoing) {
            walk(&mut talking, statement);
        }
    }
    let script = talking.script();
    for plain in &others {
        check_same(&script, &plain.script(), "with what failed and was undone");
    }
    if held.to(Held::Saving) {
        let mut loaded = deaf();
        loaded.talk.most_polls = None;
        loaded.run(&script);
        loaded.talk.most_polls = Some(PATIENCE);
        check_same(&loaded.script(), &script, "loaded");
        others.push(loaded);
    }
    for statement in AFTER {
        let end = carry_out(&mut talking, statement);
        for other in &mut others {
            let ends = [end, carry_out(other, statement)];
            if ends.iter().any(|end| matches!(end, End::Stopped | End::Left)) {
                return;
            }
            assert_eq!(ends[0], ends[1], "`{statement}`");
            check_same(&other.script(), &talking.script(), &format!("after {statement}"));
        }
    }
}

proptest! {
    #![proptest_config(draws(24))]

    #[test]
    fn nothing_that_is_typed_harms((beginning, statements) in session(12)) {
        hold_out(&beginning, &statements, Held::All);
    }
}
