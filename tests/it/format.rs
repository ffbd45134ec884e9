//! The form that scripts are kept in: what `fmt` writes.

use std::fs;
use std::process::{Command, Output};

use linkwork::diag::{Paint, SourceId, Sources, render};
use linkwork::lang::ast::Statement;
use linkwork::lang::{format, parse};

use crate::support::sources::scripts;

/// A text in canonical form.
#[track_caller]
fn formatted(text: &str) -> String {
    let mut sources = Sources::new();
    let source = sources.add("a.link", text);
    format(source, text).unwrap_or_else(|problems| {
        panic!("{}", render(&problems[0], &sources, Paint::Plain));
    })
}

#[track_caller]
fn check(text: &str, wanted: &str) {
    let got = formatted(text);
    assert_eq!(got, wanted, "of {text:?}");
    assert_eq!(formatted(&got), got, "again, of {text:?}");
}

fn statements(text: &str) -> Vec<Statement> {
    parse(SourceId(0), text).map(|statement| statement.expect("no mistake")).collect()
}

#[test]
fn all_scripts_of_the_repository_are_in_this_form() {
    for path in scripts() {
        let text = fs::read_to_string(&path).expect("it can be read");
        let wanted = formatted(&text);
        assert!(text == wanted, "`linkwork fmt {}` changes it", path.display());
    }
}

#[test]
fn it_says_the_same_however_it_was_written() {
    for path in scripts() {
        let text = fs::read_to_string(&path).expect("it can be read");
        // Blanks that may stand anywhere between words, and lines that end otherwise.
        for text in [text.replace(' ', "   "), text.replace('\n', "\r\n"), text.replace("  ", "\t")]
        {
            let again = formatted(&text);
            assert_eq!(statements(&again), statements(&text), "{}", path.display());
            assert_eq!(formatted(&again), again, "{}", path.display());
        }
    }
}

#[test]
fn blanks_are_set() {
    check("point   A=( 0 ,0 )frozen", "point A = (0, 0) frozen\n");
    check("length A B<=5", "length A B <= 5\n");
    check("coupler :length B C in 2 .. 5", "coupler: length B C in 2..5\n");
    check("let a=-1+2*3-b^2", "let a = -1 + 2 * 3 - b^2\n");
    check("set dt 1 / 360", "set dt 1/360\n");
    check("let a = 2*1/3, b = 1/3*x, c = x/3", "let a = 2 * 1 / 3, b = 1/3 * x, c = x / 3\n");
    check("motor A B speed -1rev", "motor A B speed -1rev\n");
    check("print distance( p[i - 1],p[ i ] ) , 1e-9", "print distance(p[i-1], p[i]), 1e-9\n");
    check("print \"a,b  # c\",x", "print \"a,b  # c\", x\n");
    check("set dead-points stop", "set dead-points stop\n");
    check("for i in 0..n - 1 {step}", "for i in 0..n-1 { step }\n");
    check("assert a+b in x-1 .. sin(x + 1)", "assert a + b in x-1..sin(x + 1)\n");
    check("print p[mod(i+2,6)+1].x", "print p[mod(i + 2, 6)+1].x\n");
    check("print (A+B).x", "print (A + B).x\n");
}

#[test]
fn lines_and_comments_stay() {
    check("", "");
    check("\n\n# only this\n\n", "# only this\n");
    check("step;step ; step", "step; step; step\n");
    check("step # a\nstep 100 # b\n\nstep # c", "step      # a\nstep 100  # b\n\nstep  # c\n");
    check("step\n\n\n\nstep", "step\n\nstep\n");
    check(
        "point A = (0, 0), # first\nB = (1, 0)\n# between\n  step",
        "point A = (0, 0),  # first\n  B = (1, 0)\n# between\nstep\n",
    );
    check("print max(\n1,\n2\n) ", "print max(\n  1,\n  2\n)\n");
    check("print 1 + \\\n 2", "print 1 + \\\n  2\n");
}

#[test]
fn blocks_are_indented() {
    check("for i in 1..3{step}", "for i in 1..3 { step }\n");
    check("for i in 1..3 { }", "for i in 1..3 {}\n");
    check(
        "for i in 1..3 { # each\nfor j in 1..2 {\nstep; step\n# last\n} }\nstep",
        "for i in 1..3 {  # each\n  for j in 1..2 {\n    step; step\n    # last\n  }\n}\nstep\n",
    );
    check(
        "define leg(A,a){\npoint P=A+(a,0)\nlength A P=a }",
        "define leg(A, a) {\n  point P = A + (a, 0)\n  length A P = a\n}\n",
    );
}

#[test]
fn what_cannot_be_read_is_told() {
    let problems = format(SourceId(0), "step\nlenght A B\nprint (").expect_err("two mistakes");
    assert_eq!(problems.len(), 2);
}

/// What the program does with a script of this text, and what is in its file then.
fn fmt(arguments: &[&str], text: &str) -> (Output, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("a.link");
    fs::write(&file, text).expect("it can be written");
    let out = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .arg("fmt")
        .args(arguments)
        .arg("a.link")
        .current_dir(folder.path())
        .output()
        .expect("the program starts");
    (out, fs::read_to_string(&file).expect("it is still there"))
}

#[test]
fn the_program_writes_the_form_in_place() {
    let (out, text) = fmt(&[], "point A=(0,0)  # here\n");
    assert!(out.status.success() && out.stdout.is_empty() && out.stderr.is_empty(), "{out:?}");
    assert_eq!(text, "point A = (0, 0)  # here\n");
}

#[test]
fn a_check_names_the_file_and_writes_nothing() {
    let (out, text) = fmt(&["--check"], "point A=(0,0)\n");
    assert_eq!((out.status.code(), &*out.stdout), (Some(1), &b"a.link\n"[..]));
    assert_eq!(text, "point A=(0,0)\n");
    let (out, _) = fmt(&["--check"], "point A = (0, 0)\n");
    assert_eq!((out.status.code(), &*out.stdout), (Some(0), &b""[..]));
}

#[test]
fn a_script_with_a_mistake_is_left_as_it_is() {
    let (out, text) = fmt(&[], "point   A = (0, 0)\nlenght A B\n");
    assert_eq!(out.status.code(), Some(2));
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(said.contains("error[E0101]") && said.contains("a.link:2:1"), "{said}");
    assert_eq!(text, "point   A = (0, 0)\nlenght A B\n");
}

#[test]
fn a_file_that_is_missing_is_told_and_the_others_are_written() {
    let (out, text) = fmt(&["missing.link"], "step  2\n");
    assert_eq!(out.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&out.stderr).contains("cannot read `missing.link`"));
    assert_eq!(text, "step 2\n");
}
