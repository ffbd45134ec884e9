//! The study of accuracy against time, from scenes to words; no time is asserted.

use std::path::Path;

use linkwork::diag::{Diagnostic, Kind, Sources};
use linkwork::session::{Flow, Host, Session, Telling};
use serde_json::Value;

use crate::support::notebook::Notebook;

/// A host whose clock goes a microsecond on whenever it is looked at.
fn notebook() -> Notebook {
    Notebook { tick: 1e-6, ..Notebook::default() }
}

fn run(session: &mut Session, notebook: &mut Notebook, text: &str) -> Result<Flow, Diagnostic> {
    let source = session.add_source("test.link", text, None);
    session.execute_all(source, notebook)
}

/// Runs a script; gives what was printed and told, each note with what it adds, and all that
/// was kept.
fn said(text: &str) -> (Vec<String>, Vec<String>, Notebook) {
    let (mut session, mut notebook) = (Session::new(), notebook());
    if let Err(problem) = run(&mut session, &mut notebook, text) {
        panic!("{}: {:?}", problem.message, problem.labels);
    }
    (std::mem::take(&mut notebook.printed), told(&notebook), notebook)
}

/// The notes, each with what it adds.
fn told(notebook: &Notebook) -> Vec<String> {
    let whole =
        |what: &Diagnostic| [&[what.message.to_string()], &what.notes[..]].concat().join("; ");
    notebook.told.iter().map(whole).collect()
}

const FOUR_BAR: &str = "
point A = (0, 0) frozen, D = (4, 0) frozen
point B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
length B C = 3.5
length C D = 3
set dt 1/36
";

fn numbers(line: &str) -> Vec<&str> {
    line.trim_start_matches('*').split_whitespace().collect()
}

#[test]
fn the_table_has_every_setting_and_marks_the_efficient() {
    let (printed, told, record) = said(&format!("{FOUR_BAR} step 36; accuracy"));
    assert_eq!(printed.len(), 1 + 70 + 1, "{told:?}");
    assert!(printed[0].contains("method") && printed[0].contains("time a frame"));
    let efficient: Vec<_> = printed.iter().filter(|line| line.starts_with("* ")).collect();
    assert!(efficient.len() > 1);
    assert!(printed.last().is_some_and(|line| line.contains("both faster and better")));
    let auto = printed.iter().find(|line| numbers(line).starts_with(&["auto", "1e-12"]));
    let error: f64 = numbers(auto.expect("it is a setting"))[7].parse().expect("a number");
    assert!(error < 1e-10, "the position error of auto is {error}");
    let names: Vec<_> = record.files.keys().collect();
    assert_eq!(names, [Path::new("accuracy.csv"), Path::new("accuracy.svg")]);
    let written: Vec<&String> = record.files.values().collect();
    assert_eq!(written[0].lines().count(), 71);
    for word in ["relaxation", "nesterov", "efficient", "position error", "</svg>"] {
        assert!(written[1].contains(word), "`{word}` is in the picture");
    }
}

/// A host whose clock hurries more and more: no two settings take as long.
struct Hurrying(Notebook);

impl Host for Hurrying {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&self.0)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut self.0)
    }

    fn print(&mut self, line: &str) {
        self.0.print(line);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.0.tell(what, sources);
    }

    fn seconds(&self) -> Option<f64> {
        self.0.seconds().map(|looks| 1e4 * looks.powi(3))
    }
}

#[test]
fn settings_that_lead_the_same_way_are_timed_as_one() {
    let mut host = Hurrying(notebook());
    let mut session = Session::new();
    let text = format!("{FOUR_BAR} step 36; accuracy");
    let source = session.add_source("test.link", &text, None);
    session.execute_all(source, &mut host).expect("it is studied");
    let csv = host.0.files.get(Path::new("accuracy.csv")).expect("it was written");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let times = |method: &str, is_meant: fn(&str) -> bool| {
        let rows = rows.iter().filter(|row| row[0] == method && is_meant(row[1]));
        rows.map(|row| row[3..6].to_vec()).collect::<Vec<_>>()
    };
    // Its closed steps keep no tolerance: they are exact.
    let auto = times("auto", |_| true);
    assert!(auto.len() == 11 && auto.iter().all(|row| *row == auto[0]), "{auto:?}");
    // More iterations than it takes make no difference, fewer do.
    let many = times("conjugate", |n| ["300", "1000"].contains(&n));
    assert!(many.len() == 2 && many[0] == many[1], "{many:?}");
    let few = times("relaxation", |n| ["1", "30"].contains(&n));
    assert!(few.len() == 2 && few[0][0] != few[1][0], "{few:?}");
}

#[test]
fn json_has_these_keys_and_numbers() {
    let (mut session, mut notebook) = (Session::new(), notebook());
    run(&mut session, &mut notebook, FOUR_BAR).expect("it is sound");
    session
        .study_accuracy(Some(12), Telling::Json, &mut notebook)
        .expect("there is something to study");
    let printed = notebook.printed;
    assert_eq!(printed.len(), 70);
    let keys = [
        "efficient",
        "failed_frames",
        "iterations",
        "method",
        "position_error",
        "residual",
        "seconds_per_frame",
        "tolerance",
        "type",
        "version",
    ];
    for line in &printed {
        let row: Value = serde_json::from_str(line).expect("an object on a line");
        let found: Vec<&String> = row.as_object().expect("an object").keys().collect();
        assert_eq!(found, keys, "in {line}");
        let may_be_missing = ["position_error"];
        let missing = keys.iter().filter(|key| row[**key].is_null());
        assert!(missing.into_iter().all(|key| may_be_missing.contains(key)), "in {line}");
    }
}

#[test]
fn a_scene_without_motion_is_solved_from_its_start() {
    let (printed, told, _) = said(
        "
        point A = (0, 0) frozen, B = (4, 0) frozen, C = (1, 1)
        length A C = 3; length B C = 3
        solve
        accuracy
    ",
    );
    assert!(told.iter().any(|t| t.starts_with("nothing moves in this scene")), "{told:?}");
    let one = printed.iter().find(|line| numbers(line).starts_with(&["relaxation", "1"]));
    let one = numbers(one.expect("it is a setting"));
    assert_ne!(one[6], "0", "one iteration does not solve it: the pose is the given one");
    assert!(told.iter().any(|t| t.starts_with("one solve of the starting pose")), "{told:?}");
}

#[test]
fn a_scene_that_never_converges_has_no_position_errors() {
    let (printed, told, _) = said(
        "
        point A = (0, 0) frozen, B = (1, 0), C = (0.3, 0.8)
        length A B = 1; length B C = 1; length C A = 3
        accuracy
    ",
    );
    let words = "there is no reference: it ended as no solution found";
    assert!(told.iter().any(|t| t.starts_with(words)), "{told:?}");
    assert!(printed.last().is_some_and(|line| line.contains("better by residual")));
    assert!(printed[1..printed.len() - 1].iter().all(|line| numbers(line).contains(&"-")));
}

#[test]
fn a_motion_with_freedoms_left_says_so() {
    let (_, told, _) = said(
        "
        point p[0] = (0, 0) frozen
        for i in 1..6 { point p[i] = (i, 0.1 * i^2); length p[i-1] p[i] }
        freeze p[6]
        drag p[6] to p[6] - (1, 0) over 20
        accuracy
    ",
    );
    assert!(told.iter().any(|t| t.contains("freedoms left")), "{told:?}");
    assert!(told.iter().any(|t| t.starts_with("20 frames, ")), "{told:?}");
}

#[test]
fn a_motion_past_its_branches_has_no_reference() {
    // Both frames end where the crank is straight with the coupler, and which way it folds is
    // a matter of how the way there was divided.
    let (_, told, _) = said(
        "
        point A = (0, 0) frozen, D = (2, 0) frozen
        point B = polar(4, 30deg), C = (2.6, 0.8)
        crank: motor A B radius 4 speed 1rev
        length B C = 2.5; length C D = 1
        set dt 1/60
        step 60
        accuracy
    ",
    );
    assert!(told.iter().any(|t| t.starts_with("there is no reference")), "{told:?}");
}

/// A wheel that turns by 200 degrees a time unit, and one of twice the radius that it drives.
const WHEELS: &str = "
point O = (0, 0) frozen, P = (1, 0)
let w = 200deg
coordinate P at (cos(w * time), sin(w * time))
point C = (3, 0) frozen, R = (5, 0)
length C R = 2
cog O P, C R ratio 2
";

/// The notes of a study of these wheels, in which the clock goes a millisecond on at each look.
fn study_of_wheels(motion: &str) -> Vec<String> {
    let mut session = Session::new();
    let mut notebook = Notebook { tick: 1e-3, ..Notebook::default() };
    let text = format!("{WHEELS}\n{motion}; accuracy");
    run(&mut session, &mut notebook, &text).expect("it is sound");
    told(&notebook)
}

#[test]
fn a_motion_that_turns_the_other_way_in_shorter_frames_has_no_reference() {
    // Seen once a time unit, 200 degrees are 160 the other way; seen twice, they are what they
    // are. The second wheel turns back by half of that: by 80 degrees forwards or by 100
    // backwards, which are opposite each other.
    let told = study_of_wheels(
        "set dt 1; step; assert R = C + polar(2, 80deg) within 1e-9
         step 2; assert R = C + polar(2, 240deg) within 1e-9",
    );
    let words = "with frames half as long points come out elsewhere";
    assert!(told.iter().any(|t| t.contains(words)), "{told:?}");
}

#[test]
fn the_same_motion_in_frames_that_are_short_enough_has_one() {
    let told =
        study_of_wheels("set dt 1/10; step 10; assert R = C + polar(2, -100deg) within 1e-9");
    assert!(!told.iter().any(|t| t.contains("there is no reference")), "{told:?}");
}

#[test]
fn advice_can_be_typed() {
    let (printed, _, record) = said(&format!("{FOUR_BAR} step 36; accuracy within 1e-6"));
    assert!(record.files.is_empty());
    assert_eq!(printed.len(), 2);
    assert!(printed[0].starts_with("set method ") && printed[0].contains("# position error "));
    assert!(printed[1].starts_with("set iterations ") || printed[1].starts_with("set tolerance "));
    let (mut session, mut notebook) = (Session::new(), notebook());
    run(&mut session, &mut notebook, &printed.join("\n")).expect("the advice is a script");

    let (printed, _, _) = said(&format!("{FOUR_BAR} step 36; accuracy in 2ms"));
    assert!(printed[0].starts_with("set method "), "{printed:?}");

    let (printed, _, _) = said(&format!("{FOUR_BAR} step 36; accuracy within 1e-30"));
    assert!(printed[0].starts_with("# no setting does that; nearest: "), "{printed:?}");
}

#[test]
fn a_study_that_is_stopped_shows_what_it_has() {
    let (mut session, mut notebook) = (Session::new(), notebook());
    run(&mut session, &mut notebook, &format!("{FOUR_BAR} step 36")).expect("it is sound");
    notebook.patience = Some(notebook.n_looks.get() + 2_000);
    assert_eq!(run(&mut session, &mut notebook, "accuracy").expect("it is stopped"), Flow::Stopped);
    let told = notebook.told();
    assert!(told.iter().any(|t| t.starts_with("stopped: ")), "{told:?}");
    assert!(notebook.printed.len() > 2);
    assert_eq!(notebook.files.len(), 2);
}

#[test]
fn a_study_knows_where_a_hand_took_a_point_up() {
    // C keeps to its side of the line from B to D: where it has to be at the end is known.
    for (from, to, side) in [("(1.1, -1.5)", "(6.8, 2.9)", ">"), ("(3.8, -0.8)", "(4.7, 2.6)", "<")]
    {
        let (printed, told, _) = said(&format!(
            "point D = (4, 0) frozen, B = {from}, C = (3, 2.9)
             length B C = 3.5; length C D = 3; solve
             point Z = (0, 9)
             drag B to {to} over 2
             assert cross(D - B, C - B) {side} 0
             accuracy"
        ));
        assert!(told.iter().all(|told| !told.contains("no reference")), "{told:?}");
        let auto = printed.iter().find(|line| numbers(line).starts_with(&["auto", "1e-12"]));
        let error: f64 = numbers(auto.expect("it is a setting"))[7].parse().expect("a number");
        assert!(error < 1e-10, "the position error of auto is {error}");
    }
}

#[test]
fn a_scene_without_motion_is_told_what_to_do() {
    for (script, help) in [
        ("point A = (0, 0); accuracy", "`motor A B speed 1rev`"),
        ("point A = (0, 0), B = (1, 0); rod: length A B; off rod; accuracy", "`on rod`"),
    ] {
        let (mut session, mut notebook) = (Session::new(), notebook());
        let problem = run(&mut session, &mut notebook, script).expect_err("there is nothing");
        assert_eq!(&*problem.message, "this scene has no motion whose accuracy could be studied");
        assert!(format!("{problem:?}").contains(help), "{problem:?}");
    }
}

#[test]
fn a_study_changes_nothing() {
    let (mut session, mut notebook) = (Session::new(), notebook());
    run(&mut session, &mut notebook, &format!("{FOUR_BAR} trace C; step 20")).expect("it is sound");
    let before = session.to_script();
    run(&mut session, &mut notebook, "accuracy").expect("it can be studied");
    assert_eq!(session.to_script(), before);
}

#[test]
fn one_receipt_a_command() {
    let (_, told, _) = said(&format!("{FOUR_BAR} set receipt long; for k in 1..6 {{ step 6 }}"));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("36 frames by auto: "), "{told:?}");
    for words in ["iterations and", "a frame, largest residual", "position error about"] {
        assert!(told[0].contains(words), "{told:?}");
    }
}

#[test]
fn a_receipt_shows_changes_between_frames() {
    let (_, told, _) = said(&format!(
        "{FOUR_BAR} set receipt long
         for k in 1..2 {{ set method relaxation; set rho 1 / (4 * k); step 3 }}"
    ));
    let words = "6 frames by relaxation (rho 0.25, iterations 30) (3), \
                 then relaxation (rho 0.125, iterations 30) (3): ";
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("6 of 6 frames did not reach the tolerance 1e-12"), "{told:?}");
    assert!(told[0].contains(words), "{told:?}");
}

#[test]
fn a_broken_promise_fails() {
    let (mut session, mut notebook) = (Session::new(), notebook());
    let text = format!("{FOUR_BAR} set method relaxation; step 10 within 1e-9");
    let problem =
        run(&mut session, &mut notebook, &text).expect_err("30 iterations are not enough");
    assert_eq!(problem.kind, Kind::Promise);
    run(&mut session, &mut notebook, "set method auto; step 10 within 1e-9")
        .expect("auto keeps it");
}

#[test]
fn frames_without_time_are_told_and_gone_on_with() {
    let (_, told, _) = said(&format!("{FOUR_BAR} step 4 in 1e-9; print time"));
    assert!(told[0].contains("for want of time"), "{told:?}");
}

#[test]
fn pictures_say_where_they_come_from() {
    let picture = |text: &str| {
        let (_, _, record) = said(&format!("{FOUR_BAR} {text} svg \"now.svg\""));
        let picture = record.files[Path::new("now.svg")].clone();
        let start = picture.find("tolerance: ").expect("it has a receipt");
        let end = picture[start..].find('<').expect("it ends");
        picture[start..start + end].lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let (early, late) = (picture("step 3;"), picture("step 30;"));
    assert_eq!(early[0], "tolerance: 1e-12");
    assert!(early[1].starts_with("largest residual: "));
    assert!(early[2].starts_with("scene: ") && early[2].len() == 7 + 16);
    assert_eq!(early[2], late[2], "the hash is of the scene, not of its state");
    assert_ne!(early[2], picture("change crank radius 1.1; step 3;")[2]);
    assert_eq!(picture("step 3 within 1e-6;")[0], "tolerance: 1e-6");
}

#[test]
fn a_picture_says_how_far_its_own_pose_is_off() {
    // A bar of 90 between points that are 100 apart.
    let scene = "point A = (0, 0) frozen, B = (100, 0); bar: length A B = 90;";
    let off = |text: &str| {
        let (_, _, record) = said(&format!("{scene} {text} svg \"now.svg\""));
        let picture = record.files[Path::new("now.svg")].clone();
        let (_, rest) = picture.split_once("largest residual: ").expect("it has a receipt");
        rest.split_once('\n').expect("its end").0.to_owned()
    };
    for moved in ["", "solve; move B to (100, 0);", "step 2; move B to (100, 0);"] {
        assert_eq!(off(moved), "0.1", "after {moved}");
    }
    assert_eq!(off("step 2; move B to (100, 0); step;"), "0");
    // The run before was of another scene.
    let missed = "freeze B; step; clear; point C = (0, 0) frozen, D = (9, 0); length C D = 9;";
    assert_eq!(off(missed), "0");
}

#[test]
fn series_are_undone_saved_and_plotted() {
    let (mut session, mut notebook) = (Session::new(), notebook());
    run(
        &mut session,
        &mut notebook,
        "sample \"a b\" = 1, 0.5, 0.25; sample \"c\" = 3; undo; sample \"c\" = 2",
    )
    .expect("it is sound");
    let script = session.to_script();
    assert!(script.contains("sample \"a b\" = 1, 0.5, 0.25\n"), "{script}");
    assert!(script.contains("sample \"c\" = 2\n"), "{script}");
    run(&mut session, &mut notebook, "plot \"e.svg\" log title \"T < U\" x \"n\" y \"error\"")
        .expect("it plots");
    let written = &notebook.files[Path::new("e.svg")];
    assert!(written.contains("T &lt; U") && written.contains("a b"));
    run(&mut session, &mut notebook, "clear").expect("it clears");
    let problem =
        run(&mut session, &mut notebook, "plot \"e.svg\"").expect_err("there is nothing to plot");
    assert_eq!(&*problem.message, "there is nothing to plot");
    let problem = run(&mut session, &mut notebook, "sample \"c\" = 2; plot \"e.pdf\"")
        .expect_err("no picture");
    assert_eq!(&*problem.message, "the ending says what is written");
}
