//! How laws over random cases are run.

use proptest::test_runner::{Config, RngSeed};

/// Where the draws of a law begin.
const SEED: u64 = 1;

/// A law over so many cases, the same in each run: what fails has been changed, not drawn.
/// `PROPTEST_CASES` asks for more of them, `PROPTEST_RNG_SEED` for others.
pub fn draws(cases: u32) -> Config {
    let wished = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok());
    let config = Config::default();
    let rng_seed = match config.rng_seed {
        RngSeed::Random => RngSeed::Fixed(SEED),
        fixed @ RngSeed::Fixed(_) => fixed,
    };
    Config { cases: wished.unwrap_or(cases), rng_seed, failure_persistence: None, ..config }
}
