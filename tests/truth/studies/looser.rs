//! A looser tolerance is never more work.

use std::fmt::Write;
use std::ops::Range;

use super::Count;
use crate::program::{Program, iterations_a_frame};
use crate::reference::random::Random;

/// From tight to loose.
const TOLERANCES: [f64; 4] = [1e-9, 1e-6, 1e-4, 1e-3];
/// More iterations than this times those of the tighter tolerance, and one more a frame, are more.
const MORE: f64 = 1.2;

/// One motion at several tolerances.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut more = Count::new("a looser tolerance takes more iterations (times)", "0");
    for seed in seeds {
        let text = pistons(&mut Random::new("looser", seed));
        let mut least = f64::INFINITY;
        for tolerance in TOLERANCES {
            let mut program = Program::after(&text).expect("the script has no mistake");
            let told = program.must(&format!("set tolerance {tolerance}; step 120")).told;
            let n = iterations_a_frame(&told).expect("a receipt counts iterations");
            if least.is_finite() {
                more.add(seed, n > MORE * least + 1.0, n / least.max(1.0));
            }
            least = n.min(least);
        }
    }
    vec![more]
}

/// A crank with pistons on radial lines, each with an indicator that is as long as its way.
fn pistons(random: &mut Random) -> String {
    let radius = random.within(0.5, 1.0);
    let mut text = format!(
        "point O = (0, 0) frozen, P = ({radius}, 0)
         motor O P radius {radius} speed 1rev
         set dt 1/360\n"
    );
    for k in 0..=random.below(4) {
        let (at, rod) = (random.within(-180.0, 180.0), random.within(2.0, 4.0));
        let (near, far) = (rod - radius - 0.5, rod + radius + 0.5);
        let line = format!(
            "point g{k} = polar({near}, {at}deg) frozen, h{k} = polar({far}, {at}deg) frozen
             point q{k} = polar({rod}, {at}deg)
             length P q{k} = {rod}
             glider q{k} on g{k} h{k}"
        );
        writeln!(text, "{line}").expect("a string takes all");
        if random.chance(0.7) {
            let line = format!(
                "point a{k} = ({k}, 9) frozen, b{k} = ({k}, 10)
                 equal a{k} b{k}, g{k} q{k}"
            );
            writeln!(text, "{line}").expect("a string takes all");
        }
    }
    text
}
