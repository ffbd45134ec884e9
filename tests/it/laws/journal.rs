//! What a journal is told brings the session back to the bit, whatever was typed, taken back and done
//! again; and it is told no more than what a command changed.

use super::random_session::{SCENE, statement};
use crate::support::compare::check_same;
use crate::support::draws::draws;
use crate::support::talk::Talking;
use linkwork::session::Transcript;
use proptest::prelude::*;

/// What statements read.
const FILES: [(&str, &str); 4] = [
    ("part.link", "point N = (9, 9)\ninclude \"inner.link\"\nlength N B <= 20"),
    ("inner.link", "let inner = 3 # \"a\\\\c\"\n"),
    ("plain.link", "let inner = 3; step"),
    ("again.link", "step 2; for i in 1..2 { include \"plain.link\" }"),
];

/// A statement that goes through what was done, or that reads a file.
fn walk_or_read() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => (1..5u32).prop_map(|n| format!("undo {n}")),
        2 => (1..5u32).prop_map(|n| format!("redo {n}")),
        1 => prop::sample::select(vec![
            "include \"part.link\"",
            "include \"plain.link\"",
            "for i in 1..2 { include \"again.link\"; include \"plain.link\" }",
            "load \"again.link\"",
            "save \"kept.link\"",
            "load \"kept.link\"",
            "clear",
        ])
        .prop_map(str::to_owned),
    ]
}

fn typing() -> impl Strategy<Value = Vec<String>> {
    prop::collection::vec(prop_oneof![statement(), walk_or_read()], 1..20)
}

/// A session of which a journal is kept, and what it is typed at.
struct Kept {
    talking: Talking,
    typed: Transcript,
}

impl Kept {
    fn begin() -> Self {
        let mut talking = Talking::default();
        talking.talk.journal = Some(vec![String::new()]);
        for (name, text) in FILES {
            talking.talk.files.insert(name.into(), text.to_owned());
        }
        let mut kept = Self { talking, typed: Transcript::new("typed") };
        kept.enter(SCENE);
        kept
    }

    fn enter(&mut self, text: &str) {
        self.typed.enter(text, &mut self.talking.session, &mut self.talking.talk);
    }

    fn journal(&self) -> &[String] {
        self.talking.talk.journal.as_deref().expect("it is kept")
    }

    /// The journal, where the files are gone that were read, brings back what there is.
    fn assert_brought_back(&self, after: &str) {
        let journal = self.journal().concat();
        let mut loaded = Talking::default();
        loaded.talk.files.insert("journal.link".into(), journal.clone());
        loaded.run("load \"journal.link\"");
        let script = self.talking.session.to_script();
        check_same(&loaded.script(), &script, &format!("after `{after}`\n{journal}"));
    }
}

proptest! {
    #![proptest_config(draws(24))]

    #[test]
    fn a_journal_brings_back_whatever_was_typed(statements in typing()) {
        let mut kept = Kept::begin();
        for statement in &statements {
            kept.enter(statement);
            kept.assert_brought_back(statement);
        }
    }
}

#[test]
fn a_journal_is_told_what_a_command_changed() {
    let mut kept = Kept::begin();
    kept.enter("for i in 1..1000 { point Q[i] = (i, 0) }");
    for statement in [
        "include \"again.link\"",
        "undo",
        "redo",
        "undo 2",
        "let after = 1",
        "undo",
        "include \"plain.link\"",
        "undo",
        "redo 2",
    ] {
        let before: Vec<String> = kept.journal().to_vec();
        kept.enter(statement);
        kept.assert_brought_back(statement);
        let n_same = kept.journal().iter().zip(&before).take_while(|(a, b)| a == b).count();
        let n_new: usize = kept.journal()[n_same..].iter().map(String::len).sum();
        assert!(n_new < 300, "{n_new} bytes after `{statement}`: {:?}", &kept.journal()[n_same..]);
    }
    // All there is makes another beginning, and what is done from there on goes on from it.
    kept.enter("load \"plain.link\"");
    assert_eq!(kept.journal(), ["let inner = 3; step\n"]);
    kept.enter("let other = 2; undo");
    assert_eq!(kept.journal().len(), 1);
    kept.enter("undo");
    kept.assert_brought_back("undo");
    assert!(kept.journal()[0].contains("restore version"), "{:?}", kept.journal());
    kept.enter("redo; redo");
    kept.assert_brought_back("redo");
}

#[test]
fn a_journal_that_could_not_be_read_any_more_begins_anew() {
    let mut kept = Kept::begin();
    kept.talking.session.limit(linkwork::session::Quota::SourceBytes, 20_000);
    for k in 0..1000 {
        kept.enter(&format!("let r = {k}"));
        let n_bytes: usize = kept.journal().iter().map(String::len).sum();
        assert!(n_bytes < 12_000, "{n_bytes} bytes");
    }
    kept.assert_brought_back("many");
    kept.enter("undo 3; redo");
    kept.assert_brought_back("undo 3; redo");
}

#[test]
fn what_no_frame_follows_is_taken_in_within_a_file_as_at_a_prompt() {
    let mut kept = Kept::begin();
    for statement in ["step", "vertical B C", "step 0"] {
        kept.enter(statement);
    }
    kept.assert_brought_back("step 0");
}

#[test]
fn a_value_from_outside_is_kept() {
    let mut kept = Kept::begin();
    kept.talking.session.override_parameter("given", 5.0);
    kept.enter("let given = 3");
    kept.assert_brought_back("let given = 3");
}
