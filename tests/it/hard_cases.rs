//! The hard cases: no method answers with numbers that are not finite, that run away, or that
//! claim what is not so. `scripts.rs` sees to it that `auto` holds what each script asserts.

use std::collections::VecDeque;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread;

use crate::support::fresh::violation;
use crate::support::talk::Talking;
use linkwork::diag::Span;
use linkwork::lang::ast::{
    Body, Building, Command, Expr, Function, Looking, Making, Node, Promise, Running, Statement,
};
use linkwork::session::Session;
use linkwork::solve::{Method, Status};

/// The most frames of a single run or round of a loop when every method has its turn: enough
/// for a method to lose its way, few enough for an unoptimised build.
const FEW_FRAMES: f64 = 12.0;
/// How long a `solve` may take by a clock that ticks once an iteration.
const FEW_TICKS: f64 = 200.0;
/// The largest distance to satisfaction of any frame, relative to the size.
const MOST_OFF: f64 = 10.0;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/hard")
}

/// The scripts of the hard cases, by name; those without a number are definitions they share.
fn scripts() -> Vec<(String, String)> {
    let mut scripts: Vec<(String, String)> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "link"))
        .map(|path| (path.file_stem().unwrap().to_string_lossy().into_owned(), path))
        .filter(|(name, _)| name.starts_with(|c: char| c.is_ascii_digit()))
        .map(|(name, path)| (name, std::fs::read_to_string(path).unwrap()))
        .collect();
    scripts.sort();
    assert!(scripts.len() >= 65, "{}", scripts.len());
    scripts
}

/// A statement without what it asserts and promises; with `most`, no run longer than that.
fn ease(statement: &Statement, most: Option<f64>) -> Option<Statement> {
    let span = statement.span;
    let cap = |frames: Option<Expr>| match (frames, most) {
        (Some(frames), Some(most)) => Some(at_most(frames, most, span)),
        (frames, _) => frames,
    };
    let command = match statement.command.clone() {
        Command::Looking(Looking::Assert { .. }) => return None,
        Command::Running(Running::Step { frames, .. }) => {
            Command::Running(Running::Step { frames: cap(frames), promise: Promise::default() })
        }
        Command::Running(Running::Solve(_)) => {
            let in_time = most.map(|_| Expr::literal(FEW_TICKS, span));
            Command::Running(Running::Solve(Promise { within: None, in_time }))
        }
        Command::Making(Making::Drag { targets, over }) => {
            Command::Making(Making::Drag { targets, over: cap(over) })
        }
        Command::Building(Building::For { variable, mut range, body }) => {
            if let Some(most) = most
                && body.iter().any(is_run)
            {
                range.to = at_most(range.to, most, span);
            }
            Command::Building(Building::For { variable, range, body: ease_body(&body, most) })
        }
        Command::Building(Building::Define(definition)) => {
            let mut definition = (*definition).clone();
            definition.body = ease_body(&definition.body, most);
            Command::Building(Building::Define(Arc::new(definition)))
        }
        other => other,
    };
    Some(Statement { command, span })
}

fn ease_body(body: &Body, most: Option<f64>) -> Body {
    body.iter().filter_map(|statement| ease(statement, most)).collect()
}

fn at_most(frames: Expr, most: f64, span: Span) -> Expr {
    Expr { node: Node::Call(Function::Min, vec![frames, Expr::literal(most, span)]), span }
}

fn is_run(statement: &Statement) -> bool {
    match &statement.command {
        Command::Running(Running::Step { .. }) | Command::Making(Making::Drag { .. }) => true,
        Command::Building(Building::For { body, .. }) => body.iter().any(is_run),
        _ => false,
    }
}

/// Whether a statement leaves the world as its last run or `solve` left it.
fn ends_solved(statement: &Statement) -> bool {
    match &statement.command {
        Command::Running(Running::Step { .. } | Running::Solve(_))
        | Command::Making(Making::Drag { .. }) => true,
        Command::Building(Building::For { body, .. }) => body.last().is_some_and(ends_solved),
        _ => false,
    }
}

/// What a method made of a script without its claims.
struct Made {
    is_finite: bool,
    /// How far from the origin a point got, at the end of a statement.
    reach: f64,
    /// The largest distance to satisfaction at the end, relative to the reach.
    residual: f64,
    n_missed: u64,
    n_frames: u64,
    worst: f64,
    /// What was said to be solved and is not.
    lies: Vec<String>,
}

fn make(text: &str, method: Method, most: Option<f64>) -> Made {
    let mut talking = Talking::after(&format!("set method {}", method.word()));
    talking.talk.tick = 1.0;
    let source = talking.session.add_source("hard", text, Some(folder()));
    let mut made = Made {
        is_finite: true,
        reach: 0.0,
        residual: 0.0,
        n_missed: 0,
        n_frames: 0,
        worst: 0.0,
        lies: Vec::new(),
    };
    for statement in linkwork::lang::parse(source, text) {
        let statement = statement.unwrap_or_else(|why| panic!("{}\n{text}", why.message));
        let Some(statement) = ease(&statement, most) else { continue };
        talking.talk.told();
        let frame = talking.session.world().clock().frame;
        // A script may be right to be refused, where it says so.
        if talking.session.execute(&statement, &mut talking.talk).is_err() {
            continue;
        }
        made.look(&talking.session);
        let is_run = talking.session.world().clock().frame != frame;
        let mut claims = talking.talk.told().iter().any(|told| told.starts_with("converged"));
        let mut tolerance = 1e-12;
        if is_run && let Some(summary) = talking.session.last_run() {
            made.n_missed += summary.n_missed;
            made.n_frames += summary.n_frames;
            made.worst = made.worst.max(summary.worst_residual);
            claims = summary.n_missed == 0;
            tolerance = summary.tolerance;
        }
        if claims && ends_solved(&statement) && made.residual > 4.0 * tolerance {
            made.lies.push(format!("{} claims, off by {:e}", statement.command, made.residual));
        }
    }
    made
}

impl Made {
    /// Takes in the world as it is now.
    fn look(&mut self, session: &Session) {
        let world = session.world();
        let x = world.points().column();
        let places = || world.points().ids().map(|p| x[p.idx()].to_vector().norm());
        self.is_finite &= world.points().ids().all(|p| x[p.idx()].is_finite());
        let reach = places().fold(0.0, f64::max);
        self.reach = self.reach.max(reach);
        let violation = violation(world);
        // All may be in one place that is wrong.
        self.residual = violation / reach.max(violation).max(f64::MIN_POSITIVE);
    }
}

/// Does something with each script, on all processors; gives the results in their order.
fn with_each<T: Send>(work: impl Fn(&str, &str) -> T + Sync) -> Vec<T> {
    let queue = Mutex::new(scripts().into_iter().enumerate().collect::<VecDeque<_>>());
    let next = || queue.lock().expect("no worker panics with the queue").pop_front();
    let results = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                while let Some((k, (name, text))) = next() {
                    let result = work(&name, &text);
                    results.lock().expect("no worker panics with it").push((k, result));
                }
            });
        }
    });
    let mut results = results.into_inner().expect("no worker panicked");
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}

#[test]
fn no_method_runs_away_or_claims_what_is_not_so() {
    let failures = with_each(|name, text| {
        let mut failures = String::new();
        let auto = make(text, Method::Auto, Some(FEW_FRAMES));
        for method in Method::ALL {
            let made = make(text, method, Some(FEW_FRAMES));
            let word = method.word();
            if !made.is_finite || made.reach > 100.0 * auto.reach + 100.0 || made.worst > MOST_OFF {
                let Made { reach, worst, .. } = made;
                writeln!(failures, "{name} by {word}: reach {reach:e}, off by {worst:e}").unwrap();
            }
            for lie in &made.lies {
                writeln!(failures, "{name} by {word}: {lie}").unwrap();
            }
        }
        failures
    });
    assert!(failures.iter().all(String::is_empty), "{}", failures.concat());
}

#[test]
fn no_sound_script_is_told_to_have_changed_branch() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
    for folder in ["paper", "gallery", "bench"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "link") {
                continue;
            }
            let mut talking = Talking::after("");
            let text = std::fs::read_to_string(&path).unwrap();
            let source = talking.session.add_source("script", &text, Some(root.join(folder)));
            // Whether it holds is not asked here.
            let _ = talking.session.execute_all(source, &mut talking.talk);
            let told = talking.talk.told();
            let alarm = told.iter().find(|told| told.contains("changed branch"));
            assert_eq!(alarm, None, "{}", path.display());
        }
    }
}

#[test]
fn lines_that_meet_far_away_do_not_contradict_each_other() {
    let (_, text) = scripts().into_iter().find(|(name, _)| name.starts_with("33-")).unwrap();
    let mut talking = Talking::after(&text.replace("for n in 1..100 { step }", "step 100"));
    let told = talking.talk.told();
    assert!(told.iter().any(|told| told.contains("did not reach the tolerance")), "{told:?}");
    let summary = talking.session.last_run().unwrap();
    assert_eq!(summary.worst_status, Status::Stalled, "{told:?}");
    assert_eq!(
        talking.ask("solve; check").last().unwrap().split(',').next(),
        Some("status: converged")
    );
}

/// Writes the table of docs/hard-cases.md, see there.
#[test]
fn the_table_names_every_case() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/hard-cases.md");
    let page = std::fs::read_to_string(&path).unwrap();
    if std::env::var_os("LINKWORK_WRITE_TABLE").is_some() {
        let (head, rest) = page.split_once("\n| case").expect("the table is there");
        let tail = rest.split_once("\n\n").map_or("", |(_, tail)| tail);
        std::fs::write(&path, format!("{head}\n{}\n{tail}", table())).unwrap();
        return;
    }
    for (name, text) in scripts() {
        let row = format!("| {name} | {} |", what_it_asks(&text));
        assert!(page.contains(&row), "{row} is missing: see the command there");
    }
}

/// The first sentence of a script.
fn what_it_asks(text: &str) -> String {
    let comment = text.lines().map_while(|line| line.strip_prefix("# "));
    let comment = comment.collect::<Vec<_>>().join(" ");
    comment.split_once(". ").map_or(comment.trim_end_matches('.'), |(first, _)| first).to_owned()
}

fn table() -> String {
    let rows = with_each(|name, text| {
        let cell = |method: Method| {
            let mut talking = Talking::after(&format!("set method {}", method.word()));
            let source = talking.session.add_source("hard", text, Some(folder()));
            let holds = match talking.session.execute_all(source, &mut talking.talk) {
                Ok(_) => "holds",
                Err(_) => "**fails**",
            };
            let made = make(text, method, None);
            let ends = format!("{:.0e} / {:.0e}", made.residual, made.worst);
            let missed = match made.n_missed {
                0 => String::new(),
                n => format!(", {n} of {} missed", made.n_frames),
            };
            format!("{holds}; {ends}{missed}")
        };
        let cells = [Method::Relaxation, Method::Auto].map(cell);
        format!("| {name} | {} | {} | {} |\n", what_it_asks(text), cells[0], cells[1])
    });
    format!("| case | what it asks | relaxation | auto |\n|---|---|---|---|\n{}", rows.concat())
}
