//! What holds whatever is typed: no statement ends in a panic, one that fails changes no bit of what
//! follows, nor do undo and redo, nor saving and loading; and what is said to be solved is so.

use super::random_command::session;
use crate::support::compare::check_same;
use crate::support::fresh::flaws;
use crate::support::talk::Talking;
use linkwork::session::Flow;
use proptest::prelude::*;

/// How often a statement may ask whether it is to go on: a frame of a billion iterations is what was
/// asked for.
const PATIENCE: u64 = 60;

/// What comes after everything else.
const AFTER: [&str; 3] = ["step 2", "solve", "print velocity(B), time; list"];

/// How a statement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    Done,
    Failed,
    /// It would have gone on for longer than anybody waits.
    Stopped,
}

fn carry_out(talking: &mut Talking, statement: &str) -> End {
    talking.talk.n_polls.set(0);
    match talking.execute(statement) {
        Err(_) => End::Failed,
        Ok(Flow::Stopped) => End::Stopped,
        Ok(_) => End::Done,
    }
}

fn patient() -> Talking {
    let mut talking = Talking::default();
    talking.talk.most_polls = Some(PATIENCE);
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

/// Whether going back and forth is to be tried after a statement that took effect.
fn is_walked(k: usize) -> bool {
    k.is_multiple_of(2)
}

/// Carries statements out, with failures, undo and redo among them, and again with nothing but what
/// took effect; both are then the same, and so is what is loaded from their file.
pub fn hold_out(beginning: &[String], statements: &[String]) {
    let (mut talking, mut plain) = (patient(), patient());
    let all = beginning.iter().chain(statements).enumerate();
    for (k, statement) in all {
        let is_walk = statement.starts_with("undo") || statement == "redo";
        match carry_out(&mut talking, statement) {
            End::Stopped => return,
            End::Failed => continue,
            End::Done => {}
        }
        assert_claim_holds(&mut talking, statement);
        // What was taken back is taken back in both.
        match carry_out(&mut plain, statement) {
            End::Stopped => return,
            End::Failed => panic!("`{statement}` fails without what failed before"),
            End::Done => {}
        }
        if k >= beginning.len() && is_walked(k) && !is_walk {
            let before = talking.script();
            if carry_out(&mut talking, "undo") == End::Done {
                assert_eq!(carry_out(&mut talking, "redo"), End::Done, "what was undone");
            }
            check_same(&talking.script(), &before, &format!("`{statement}` undone and redone"));
        }
    }
    check_same(&talking.script(), &plain.script(), "with what failed and was undone");
    let mut loaded = patient();
    let kept = plain.script();
    loaded.talk.most_polls = None;
    loaded.run(&kept);
    loaded.talk.most_polls = Some(PATIENCE);
    check_same(&loaded.script(), &kept, "loaded");
    for statement in AFTER {
        let ends = [&mut talking, &mut plain, &mut loaded].map(|it| carry_out(it, statement));
        if ends.contains(&End::Stopped) {
            return;
        }
        assert_eq!([ends[0]; 2], ends[1..], "`{statement}`");
        check_same(&talking.script(), &plain.script(), &format!("after {statement}"));
        check_same(&loaded.script(), &plain.script(), &format!("loaded, after {statement}"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn nothing_that_is_typed_harms((beginning, statements) in session(12)) {
        hold_out(&beginning, &statements);
    }
}
