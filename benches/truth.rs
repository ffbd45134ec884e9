//! Prints the rates of docs/hard-cases.md: `cargo bench --bench truth -- 13000`.

#![allow(clippy::disallowed_methods)]

#[path = "../tests/truth/program.rs"]
mod program;
#[path = "../tests/truth/reference/mod.rs"]
mod reference;
#[path = "../tests/truth/studies/mod.rs"]
mod studies;

use std::time::Instant;

/// Scenes of a run that is not told how many.
const N_SCENES: u64 = 200;

/// Studies of whole motions, which take one seed where others take ten.
const LONG: [&str; 9] = [
    "drags",
    "triads",
    "six_bars",
    "branches",
    "change_points",
    "velocities",
    "receipts",
    "looser",
    "effects",
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let n = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(N_SCENES);
    let names: Vec<&String> =
        arguments.iter().filter(|a| !a.starts_with('-') && a.parse::<u64>().is_err()).collect();
    println!("{}", studies::Count::HEAD);
    for study in &studies::ALL {
        if !names.is_empty() && !names.iter().any(|name| *name == study.name) {
            continue;
        }
        let begun = Instant::now();
        let n_seeds = if LONG.contains(&study.name) { n.div_ceil(10) } else { n };
        for count in (study.run)(0..n_seeds) {
            println!("{}", count.line());
        }
        eprintln!("{}: {n_seeds} seeds, {:.1} s", study.name, begun.elapsed().as_secs_f64());
    }
}
