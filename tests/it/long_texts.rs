//! Texts of extreme size: none overflows the stack, and all are read in linear time.

use std::thread;
use std::time::{Duration, Instant};

use linkwork::diag::{Paint, SourceId, Sources, render};
use linkwork::lang::ast::Command;
use linkwork::lang::{is_incomplete, parse};

/// Reads `text` on a stack as small as any that a thread usually gets, prints and drops it.
#[track_caller]
fn check(text: String, wanted: Result<(), &str>) {
    let reader = thread::Builder::new().stack_size(2 << 20).spawn(move || {
        is_incomplete(&text);
        let mut sources = Sources::new();
        let id = sources.add("long", &*text);
        let statements: Result<Vec<_>, _> = parse(id, &text).collect();
        if let Err(problem) = &statements {
            let drawn = render(problem, &sources, Paint::Plain);
            assert!(drawn.len() < 2_000, "drawn in {} bytes", drawn.len());
        }
        statements.map(|all| drop(all.iter().map(ToString::to_string).collect::<String>()))
    });
    let read = reader.expect("a thread").join().expect("no overflow");
    let message = read.as_ref().copied().map_err(|problem| &*problem.message);
    assert_eq!(message, wanted);
}

const TOO_LONG: Result<(), &str> = Err("the expression is too long or too deeply nested");
const TOO_DEEP: Result<(), &str> = Err("too many brackets within each other");

#[test]
fn expressions_are_limited_in_depth() {
    let many = 100_000;
    check(format!("print 1{}", " + 1".repeat(290)), Ok(()));
    check(format!("print 1{}", " + 1".repeat(many)), TOO_LONG);
    check(format!("print 1{}", "^1".repeat(many)), TOO_LONG);
    check(format!("print {}1", "-".repeat(290)), Ok(()));
    check(format!("print {}1", "-".repeat(many)), TOO_LONG);
    check(format!("print {}1{}", "(".repeat(64), ")".repeat(64)), Ok(()));
    check(format!("print {}1{}", "(".repeat(many), ")".repeat(many)), TOO_DEEP);
    check(format!("print {}1{}", "sin(".repeat(64), ")".repeat(64)), Ok(()));
    check(format!("print {}1{}", "p[".repeat(64), "]".repeat(64)), Ok(()));
    check(format!("print (A){}", ".x".repeat(many)), TOO_LONG);
    check(format!("print A{}", ".x".repeat(many)), TOO_LONG);
    // Long chains in brackets in long chains: the depths add up.
    let nested = (0..60).fold("1".to_owned(), |inner, _| format!("({inner}{})", " + 1".repeat(20)));
    check(format!("print {nested}"), TOO_LONG);
    check("(".repeat(many), TOO_DEEP);
    check("print [(".repeat(many), TOO_DEEP);
}

#[test]
fn a_word_in_brackets_within_brackets_is_one_mistake() {
    let nested = format!("{}3{}", "(".repeat(40), ")".repeat(40));
    check(format!("freeze {nested}"), Err("unexpected `(`"));
    check(format!("length {nested} = 3"), Err("unexpected `(`"));
}

#[test]
fn blocks_are_limited_in_depth() {
    let nested = |n| "for i in 1..2 { ".repeat(n) + "step" + &" }".repeat(n);
    check(nested(64), Ok(()));
    check(nested(65), TOO_DEEP);
    check(nested(10_000), TOO_DEEP);
}

#[test]
fn long_lists_are_no_nesting() {
    let values: Vec<_> = (0..100_000).map(|i| format!("({i}, -{i}.5e-3)")).collect();
    check(format!("restore trace C = {}", values.join(",\n  ")), Ok(()));
    check(format!("freeze {}", "A ".repeat(100_000)), Ok(()));
    check(format!("print \"{}\"", "é".repeat(1_000_000)), Ok(()));
}

#[test]
fn long_words_are_cut_in_messages() {
    let long = "A".repeat(1_000_000);
    let brief = format!("{}...", "A".repeat(40));
    check(format!("{long} = 1"), Err(&format!("`{brief} = ...` is not a statement")));
    check(format!("{long} 1"), Err(&format!("unknown command `{brief}`")));
    check(format!("print {long}(1)"), Err(&format!("unknown function `{brief}`")));
    check(format!("print 1{long}"), Err(&format!("unknown unit `{brief}`")));
    check(format!("print 1 {long}"), Err(&format!("unexpected `{brief}`")));
    check(format!("svg {long}"), Err(&format!("unexpected `{brief}`")));
    check(format!("set {long} = 3"), Err("unexpected `=`"));
}

#[test]
fn time_grows_with_the_length() {
    let line = "length p[3] q.B = 3.5 * sin(2 * pi * time) # a bar\n";
    let mut n_read = 0;
    let began = Instant::now();
    let text = line.repeat(100_000);
    for statement in parse(SourceId(0), &text) {
        assert!(matches!(statement, Ok(s) if matches!(s.command, Command::Constrain(_))));
        n_read += 1;
    }
    assert_eq!(n_read, 100_000);
    // Far above what it takes; a square of the length would take hours.
    assert!(began.elapsed() < Duration::from_mins(1), "{:?}", began.elapsed());
    println!("{:?} a statement", began.elapsed() / n_read);
}
