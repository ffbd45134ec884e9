//! Statements made from the input by the generators of the tests, held to what `laws::steadfast` says.
//!
//! Eight bytes of the input are the seed of a statement, the first eight that of what there is to
//! begin with and of what it is held to: what libFuzzer cuts out, puts in and joins are statements.
#![no_main]
#![allow(dead_code, unused_imports)]

#[path = "../../tests/it/laws"]
mod laws {
    pub mod random_command;
    pub mod random_scene;
    pub mod random_session;
    pub mod steadfast;
}
#[path = "../../tests/it/support"]
mod support {
    pub mod compare;
    pub mod draws;
    pub mod fresh;
    pub mod notebook;
    pub mod talk;
}

use std::cell::LazyCell;

use libfuzzer_sys::fuzz_target;
use proptest::strategy::{BoxedStrategy, Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use laws::random_command::{beginning, command};
use laws::steadfast::{Held, hold_out};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Bytes of a seed.
const SEED: usize = 8;
/// The most statements after the beginning.
const MOST: usize = 5;

/// What a strategy makes of a seed.
fn made<T: std::fmt::Debug>(strategy: &BoxedStrategy<T>, bytes: &[u8]) -> T {
    let mut seed = [0; 32];
    seed[..bytes.len()].copy_from_slice(bytes);
    let randomness = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    let mut runner = TestRunner::new_with_rng(Config::default(), randomness);
    strategy.new_tree(&mut runner).expect("nothing is filtered").current()
}

thread_local! {
    static BEGINNING: LazyCell<BoxedStrategy<Vec<String>>> =
        LazyCell::new(|| beginning().boxed());
    static COMMAND: LazyCell<BoxedStrategy<String>> = LazyCell::new(|| command().boxed());
}

fuzz_target!(|bytes: &[u8]| {
    let mut seeds = bytes.chunks_exact(SEED);
    let Some(first) = seeds.next() else { return };
    let beginning = BEGINNING.with(|strategy| made(strategy, first));
    let statements: Vec<String> =
        seeds.take(MOST).map(|seed| COMMAND.with(|strategy| made(strategy, seed))).collect();
    if std::env::var_os("SHOW").is_some() {
        eprintln!("{}\n# then\n{}", beginning.join("\n"), statements.join("\n"));
    }
    // One at a time: three sessions take three times as long as one.
    let held = [Held::Failing, Held::Undoing, Held::Saving][usize::from(first[0]) % 3];
    hold_out(&beginning, &statements, held);
});
