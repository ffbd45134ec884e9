//! Prints the rates of docs/hard-cases.md: `cargo bench --bench truth -- 13000`, and some seeds of one
//! study: `cargo bench --bench truth -- 621..622 conflict`.

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
    let some = arguments.iter().find_map(|a| {
        let (from, to) = a.split_once("..")?;
        Some(from.parse::<u64>().ok()?..to.parse().ok()?)
    });
    let is_name = |a: &&String| a.starts_with(|first: char| first.is_ascii_alphabetic());
    let names: Vec<&String> = arguments.iter().filter(is_name).collect();
    println!("{}", studies::Count::HEAD);
    for study in &studies::ALL {
        if !names.is_empty() && !names.iter().any(|name| *name == study.name) {
            continue;
        }
        let begun = Instant::now();
        let most = if LONG.contains(&study.name) { n.div_ceil(10) } else { n };
        let seeds = some.clone().unwrap_or(0..most);
        for count in (study.run)(seeds.clone()) {
            println!("{}", count.line());
        }
        eprintln!("{}: seeds {seeds:?}, {:.1} s", study.name, begun.elapsed().as_secs_f64());
    }
}
