//! What a program that uses the library is promised.

use std::error::Error;
use std::thread;

use linkwork::diag::{Paint, Severity, render};
use linkwork::session::{Completion, Nowhere, Transcript};
use linkwork::{Answer, Diagnostic, Session};

const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    rocker: length C D = 3
    set dt 1/360
";

const fn is_shared<T: Send + Sync>() {}

const _: () = is_shared::<Session>();
const _: () = is_shared::<Diagnostic>();
const _: () = is_shared::<Answer>();

#[test]
fn a_session_goes_on_on_another_thread_to_the_same_bits() {
    let mut session = Session::new();
    session.run(FOUR_BAR).unwrap();
    session.run("trace C; record \"a.csv\"; step 50").unwrap();
    let mut session = thread::spawn(move || {
        session.run("step 50").unwrap();
        session
    })
    .join()
    .unwrap();
    let there = session.run("record stop").unwrap();

    let mut alone = Session::new();
    alone.run(FOUR_BAR).unwrap();
    let here = alone.run("trace C; record \"a.csv\"; step 50; step 50; record stop").unwrap();
    assert_eq!(session.to_script(), alone.to_script());
    assert_eq!(there.files, here.files);
}

#[test]
fn without_a_clock_nothing_is_said_of_time() {
    let mut session = Session::new();
    session.run(FOUR_BAR).unwrap();
    let script = session.to_script();
    for statement in
        ["step 2 in 1ms", "run 0.1 in 1ms", "solve in 1ms", "accuracy", "accuracy in 1ms"]
    {
        let problem = session.run(statement).expect_err(statement);
        assert_eq!(&*problem.message, "there is no clock here", "{statement}");
        assert_eq!(session.to_script(), script, "{statement}");
    }
    let told = session.run("step 20").unwrap().told;
    assert!(told.last().unwrap().to_string().ends_with("20 frames, exact to 1e-12"));
    let told = session.run("set receipt long; step 20").unwrap().told;
    let receipt = told.last().unwrap().to_string();
    assert!(receipt.contains("iterations a frame, largest residual"), "{receipt}");
    assert_eq!(session.last_run().unwrap().seconds, None);

    let lines = session.run("effects").unwrap().lines;
    assert_eq!(lines.last().unwrap(), "no frame is timed: there is no clock here");
    let clock: Vec<&str> = lines[1].split_whitespace().collect();
    assert_eq!(clock, ["clock", "on", "24", "B", "-", "-", "crank"]);
}

#[test]
fn an_answer_holds_what_was_said_and_written() {
    let mut session = Session::new();
    let problem = session.run(&format!("{FOUR_BAR} step 2; print B == B")).unwrap_err();
    assert_eq!(problem.severity, Severity::Error);
    let answer =
        session.run("print \"here\", time; set iterations 1; set method relaxation; step").unwrap();
    assert_eq!(answer.to_string(), "here 0.005555555555555556\n");
    let warnings: Vec<String> = answer.warnings().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].starts_with("1 of 1 frame did not reach the tolerance"), "{warnings:?}");

    let answer = session.run("save \"now.link\"; svg \"now.svg\"").unwrap();
    let names: Vec<_> = answer.files.keys().map(|path| path.to_string_lossy()).collect();
    assert_eq!(names, ["now.link", "now.svg"]);
    assert_eq!(answer.files.values().next().unwrap(), session.to_script().as_bytes());
}

#[test]
fn a_file_is_kept_below_the_output_folder() {
    let mut session = Session::new();
    for path in ["../up.svg", "/elsewhere/a.svg", "a/../../b.svg"] {
        let problem = session.run(&format!("svg \"{path}\"")).unwrap_err();
        assert_eq!(&*problem.message, "files are written below the output folder only");
    }
    let answer = session.run("svg \"./deep/./a.svg\"").unwrap();
    assert_eq!(answer.files.keys().next().unwrap().to_str(), Some("deep/a.svg"));
}

#[test]
fn an_error_prints_itself_and_can_be_drawn() {
    let mut session = Session::new();
    let problem = session.run("point A = (0, 0)\nlength A X").unwrap_err();
    let error: Box<dyn Error> = Box::new(problem.clone());
    assert_eq!(error.to_string(), "unknown name `X`: nothing has this name");
    let drawn = render(&problem, session.sources(), Paint::Plain);
    assert!(drawn.contains("<text>:2:10"), "{drawn}");
    // Statements before it keep their effect.
    assert!(session.position("A").is_some());
}

#[test]
fn things_are_asked_for_by_name() {
    let mut session = Session::new();
    session.run(&format!("{FOUR_BAR} let r = 2 * distance(B, C); step 30")).unwrap();
    let (b, c) = (session.position("B").unwrap(), session.position("C").unwrap());
    assert!((b.distance(c) - 3.5).abs() < 1e-12);
    let r = session.evaluate("r").unwrap().number();
    assert!((r - 7.0).abs() < 1e-12);
    assert_eq!(session.residual("coupler").map(|f| f.abs() < 1e-12), Some(true));
    for nothing in ["crank", "r", "X", "coupler.x"] {
        assert_eq!(session.position(nothing), None, "{nothing}");
    }
    for nothing in ["A", "r", "X"] {
        assert_eq!(session.residual(nothing), None, "{nothing}");
    }
    session.run("move C to C + (0, 1); off rocker").unwrap();
    assert_eq!(session.residual("rocker"), None);
    assert!(session.residual("coupler").unwrap() > 0.5);
}

#[test]
fn looking_changes_nothing_and_keeps_nothing() {
    let mut session = Session::new();
    session.run(&format!("{FOUR_BAR} step 3; move C to (3, 2)")).unwrap();
    let (before, last) = (session.to_script(), session.sources().last().map(|(id, _)| id));
    for _ in 0..3 {
        assert!(session.evaluate("norm(velocity(B))").unwrap().number() > 6.0);
    }
    assert_eq!(session.to_script(), before);
    assert_eq!(session.sources().last().map(|(id, _)| id), last);
    for wrong in ["", "1, 2", "1; clear", "\"text\"", "1 +", "B + 1"] {
        session.evaluate(wrong).unwrap_err();
    }
    assert_eq!(session.to_script(), before);
}

#[test]
fn a_second_front_end_types_and_completes() {
    let mut session = Session::new();
    let mut typed = Transcript::new("<page>");
    // After a mistake the rest of its line is left out.
    let outcome = typed.enter(
        "point A = (1, 2)\nlenght; point B = A\npoint C = A",
        &mut session,
        &mut Nowhere,
    );
    assert_eq!(
        outcome.failure.unwrap().to_string(),
        "unknown name `lenght`: nothing has this name"
    );
    assert!(session.position("B").is_none() && session.position("C").is_some());
    let mut completion = Completion::default();
    completion.refresh(&session);
    let offer = completion.offer("show ");
    let words: Vec<&str> = offer.candidates.iter().map(|candidate| &*candidate.text).collect();
    assert_eq!((offer.start, words), (5, vec!["A", "C"]));
}
