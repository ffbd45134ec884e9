//! What is said of each mistake in a text, word for word.
//!
//! `lang_mistakes/*.txt` hold the mistakes: lines that begin with `> ` are the text,
//! what follows is what is said of it. With `UPDATE_GOLDEN=1` the files are written anew;
//! read the difference before you keep it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use linkwork::diag::{Paint, Sources, render};
use linkwork::lang::parse;

#[test]
fn commands() {
    check("commands.txt");
}

#[test]
fn constraints() {
    check("constraints.txt");
}

#[test]
fn expressions() {
    check("expressions.txt");
}

#[test]
fn trade() {
    check("trade.txt");
}

#[test]
fn layout() {
    check("layout.txt");
}

fn check(file: &str) {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden/lang_mistakes").join(file);
    let golden = fs::read_to_string(&path).expect("the file is there");
    let said: String = texts(&golden).iter().map(|text| told(text)).collect();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&path, said).expect("the file can be written");
        return;
    }
    for (wanted, got) in golden.split("\n\n> ").zip(said.split("\n\n> ")) {
        assert_eq!(got, wanted, "in {file}");
    }
    assert_eq!(said, golden, "in {file}");
}

/// The texts in `golden`, without what is said of them.
fn texts(golden: &str) -> Vec<String> {
    let mut texts: Vec<String> = Vec::new();
    let mut is_text = false;
    for line in golden.lines() {
        let Some(text) = line.strip_prefix('>') else {
            is_text = false;
            continue;
        };
        let text = text.strip_prefix(' ').unwrap_or(text);
        match texts.last_mut().filter(|_| is_text) {
            Some(last) => write!(last, "\n{text}").expect("writing to a string"),
            None => texts.push(text.to_owned()),
        }
        is_text = true;
    }
    texts
}

/// `text` and what is said of it.
fn told(text: &str) -> String {
    let mut told = String::new();
    for line in text.lines() {
        told.push_str(format!("> {line}").trim_end());
        told.push('\n');
    }
    let mut sources = Sources::new();
    let id = sources.add("a.link", text);
    for statement in parse(id, text) {
        match statement {
            Ok(statement) => writeln!(told, "reads as: {statement}"),
            Err(problem) => writeln!(told, "{}", render(&problem, &sources, Paint::Plain)),
        }
        .expect("writing to a string");
    }
    told + "\n"
}
