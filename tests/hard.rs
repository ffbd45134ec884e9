//! The hard cases: no method answers with numbers that are not finite, that run away, or that
//! claim what is not so.

mod talk;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use linkwork::constraint::Relation as _;
use linkwork::diag::Diagnostic;
use linkwork::session::{Flow, Session};
use linkwork::solve::Method;
use linkwork::world::PointId;
use talk::{Talk, Talking};

/// The scripts of the hard cases, by name; those without a number are definitions they share.
fn scripts() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/hard");
    let mut scripts: Vec<(String, String)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "link"))
        .map(|path| (path.file_stem().unwrap().to_string_lossy().into_owned(), path))
        .filter(|(name, _)| name.starts_with(|c: char| c.is_ascii_digit()))
        .map(|(name, path)| (name, std::fs::read_to_string(path).unwrap()))
        .collect();
    scripts.sort();
    assert!(scripts.len() >= 60, "{}", scripts.len());
    scripts
}

fn begin() -> Talking {
    let talk = Talk::default();
    Talking { session: Session::new(Box::new(talk.clone())), talk }
}

fn run(talking: &mut Talking, text: &str) -> Result<Flow, Diagnostic> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts/hard");
    let source = talking.session.add_source("hard", text, Some(folder));
    talking.session.execute_all(source)
}

/// A script without what it asserts and promises, and without its own choice of a method.
fn without_claims(text: &str) -> String {
    let is_end = |c: char| matches!(c, ';' | '\n' | '}' | '#');
    let mut kept = String::new();
    for line in text.split_inclusive('\n') {
        let mut rest = line;
        while !rest.is_empty() {
            let end = rest.find(is_end).map_or(rest.len(), |k| k + 1);
            // A `}` or a comment ends the line's statements for this purpose.
            let (statement, after) = rest.split_at(end);
            let start = statement.rfind('{').map_or(0, |k| k + 1);
            let (head, body) = statement.split_at(start);
            let verb = body.trim_start();
            kept.push_str(head);
            if verb.starts_with("assert ") || verb.starts_with("set method") {
                kept.extend(body.chars().rev().take(1).filter(|c| is_end(*c)));
            } else if let (Some(k), true) = (
                body.find(" within "),
                ["step", "run", "solve"].iter().any(|word| verb.starts_with(word)),
            ) {
                kept.push_str(&body[..k]);
                kept.extend(body.chars().rev().take(1).filter(|c| is_end(*c)));
            } else {
                kept.push_str(body);
            }
            rest = after;
            if statement.ends_with('#') {
                kept.push_str(rest);
                break;
            }
        }
    }
    kept
}

/// What a method made of a script.
struct Made {
    is_finite: bool,
    reach: f64,
    /// The largest distance to satisfaction at the end, relative to the reach.
    residual: f64,
    /// Whether the last run said that all its frames converged, and with which tolerance.
    claims: Option<f64>,
    n_missed: u64,
    n_frames: u64,
    worst: f64,
}

fn make(text: &str, method: Method) -> Made {
    let mut talking = begin();
    let text = without_claims(text);
    let whole = format!("set method {}\n{text}", method.word());
    let source = talking.session.add_source(
        "hard",
        &whole,
        Some(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts/hard")),
    );
    let (mut n_missed, mut n_frames, mut worst) = (0, 0, 0.0_f64);
    let mut claims = None;
    for statement in linkwork::lang::parse(source, &whole) {
        let statement = statement.unwrap_or_else(|why| panic!("{}\n{whole}", why.message));
        // A script may be right to be refused, where it says so.
        let _ = talking.session.execute(&statement);
        claims = None;
        if let Some(summary) = talking.session.last_run() {
            let is_run = matches!(
                statement.command,
                linkwork::lang::ast::Command::Step { .. }
                    | linkwork::lang::ast::Command::Run { .. }
                    | linkwork::lang::ast::Command::Drag { .. }
            );
            if is_run {
                n_missed += summary.n_missed;
                n_frames += summary.n_frames;
                worst = worst.max(summary.worst_residual);
                claims = (summary.n_missed == 0).then_some(summary.tolerance);
            }
        }
    }
    let world = talking.session.world();
    let x = world.points().column();
    let ids: Vec<PointId> = world.points().ids().collect();
    let w: Vec<f64> = (0..x.len())
        .map(PointId::new)
        .map(|p| if world.points().is_alive(p) { world.points().inverse_mass(p) } else { 0.0 })
        .collect();
    let reach = ids.iter().map(|&p| x[p.idx()].to_vector().norm()).fold(0.0, f64::max);
    let on = world.constraints().filter(|(_, record)| record.is_on);
    let violation = on.map(|(_, r)| r.constraint.violation(x, &w)).fold(0.0, f64::max);
    Made {
        is_finite: ids.iter().all(|&p| x[p.idx()].is_finite()),
        reach,
        residual: violation / reach.max(f64::MIN_POSITIVE),
        claims,
        n_missed,
        n_frames,
        worst,
    }
}

/// Scripts too long for eight methods in an unoptimised build.
const LONG: [&str; 8] = ["11-", "44-", "56-", "57-", "58-", "59-", "60-", "61-"];

/// `tests/scripts.rs` sees to it that all scripts hold what they assert.
#[test]
fn no_sound_script_is_told_to_have_changed_branch() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
    for folder in ["paper", "gallery", "bench"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "link") {
                continue;
            }
            let mut talking = begin();
            let text = std::fs::read_to_string(&path).unwrap();
            let source = talking.session.add_source("script", &text, Some(root.join(folder)));
            // Whether it holds is not asked here.
            let _ = talking.session.execute_all(source);
            let told = talking.talk.told();
            let alarm = told.iter().find(|told| told.contains("changed branch"));
            assert_eq!(alarm, None, "{}", path.display());
        }
    }
}

#[test]
fn no_method_runs_away_or_claims_what_is_not_so() {
    let mut failures = String::new();
    for (name, text) in scripts() {
        if LONG.iter().any(|long| name.starts_with(long)) {
            continue;
        }
        let auto = make(&text, Method::Auto);
        for method in Method::ALL {
            let made = make(&text, method);
            let word = method.word();
            if !made.is_finite || made.reach > 100.0 * auto.reach + 100.0 {
                writeln!(failures, "{name} by {word}: reach {:e}", made.reach).unwrap();
            }
            if let Some(tolerance) = made.claims
                && made.residual > 100.0 * tolerance.max(1e-13)
            {
                writeln!(failures, "{name} by {word}: claimed, off by {:e}", made.residual)
                    .unwrap();
            }
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

/// Writes the table of docs/hard-cases.md, see there.
#[test]
fn the_table_names_every_case() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/hard-cases.md");
    let page = std::fs::read_to_string(&path).unwrap();
    if std::env::var_os("LINKWORK_WRITE_TABLE").is_some() {
        let head = page.split("\n| case").next().unwrap();
        std::fs::write(&path, format!("{head}\n{}", table())).unwrap();
        return;
    }
    for (name, _) in scripts() {
        assert!(page.contains(&format!("| {name} |")), "{name} is missing: see the command there");
    }
}

fn table() -> String {
    let mut table = "| case | relaxation | auto |\n|---|---|---|\n".to_owned();
    for (name, text) in scripts() {
        let cell = |method: Method| {
            let whole = format!("set method {}\n{}", method.word(), text);
            let mut talking = begin();
            let holds = match run(&mut talking, &whole) {
                Ok(_) => "holds".to_owned(),
                Err(why) => format!("fails: {}", why.message),
            };
            let made = make(&text, method);
            let ends = format!("{:.0e} / {:.0e}", made.residual, made.worst);
            let missed = match made.n_missed {
                0 => String::new(),
                n => format!(", {n} of {} frames missed", made.n_frames),
            };
            format!("{holds}; {ends}{missed}")
        };
        let cells = [Method::Relaxation, Method::Auto].map(cell);
        writeln!(table, "| {name} | {} | {} |", cells[0], cells[1]).unwrap();
    }
    table
}
