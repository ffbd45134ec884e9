//! What `effects` says adds up: shares are parts of the frame.

use std::ops::Range;

use super::Count;
use crate::program::Program;
use crate::reference::random::Random;

/// Shares are printed to three digits.
const MOST: f64 = 101.0;

/// A mechanism beside much that stands still.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut above =
        Count::new("four-bar beside still bars: shares of `effects` above 100 % (their sum)", "0");
    for seed in seeds {
        let mut random = Random::new("effects", seed);
        let n = random.pick(&[100, 1000, 3000]);
        let mut program = Program::after(&format!(
            "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
             motor A B radius 1 speed 1rev
             length B C = 3.5
             length C D = 3
             set dt 1/360
             trace C
             for i in 1..{n} {{ point q[i] = (i, 10) frozen, r[i] = (i, 11); length q[i] r[i] = 1 }}
             step 20"
        ))
        .expect("the script has no mistake");
        let shares = program.must("effects").printed;
        let sum: f64 = shares.iter().filter_map(|line| share(line)).sum();
        above.add(seed, sum > MOST, sum);
    }
    vec![above]
}

/// The share in a line, in percent.
fn share(line: &str) -> Option<f64> {
    let word = line.split_whitespace().find(|word| word.ends_with('%'))?;
    word.trim_end_matches('%').trim_start_matches('<').parse().ok()
}
