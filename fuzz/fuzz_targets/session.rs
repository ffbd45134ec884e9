//! Statements made from the input by the generators of the tests: what `laws::steadfast` holds.
//!
//! The input takes the place of the generators' randomness, so that a change of a few bytes changes
//! a statement or a number.
#![no_main]

#[path = "../../tests/it/laws"]
mod laws {
    pub mod random_command;
    pub mod random_scene;
    pub mod random_session;
    pub mod steadfast;
}
#[path = "../../tests/it/support"]
#[allow(dead_code)]
mod support {
    pub mod compare;
    pub mod fresh;
    pub mod notebook;
    pub mod talk;
}

use std::cell::LazyCell;

use libfuzzer_sys::fuzz_target;
use proptest::strategy::{BoxedStrategy, Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Statements after the beginning.
const MOST: usize = 12;

type Session = (Vec<String>, Vec<String>);

thread_local! {
    static SESSIONS: LazyCell<BoxedStrategy<Session>> =
        LazyCell::new(|| laws::random_command::session(MOST).boxed());
}

fuzz_target!(|bytes: &[u8]| {
    if bytes.len() < 64 {
        return;
    }
    let randomness = TestRng::from_seed(RngAlgorithm::PassThrough, bytes);
    let mut runner = TestRunner::new_with_rng(Config::default(), randomness);
    let made = SESSIONS.with(|sessions| sessions.new_tree(&mut runner));
    let Ok(session) = made else { return };
    let (beginning, statements) = session.current();
    if std::env::var_os("SHOW").is_some() {
        eprintln!("{}\n# then\n{}", beginning.join("\n"), statements.join("\n"));
    }
    laws::steadfast::hold_out(&beginning, &statements);
});
