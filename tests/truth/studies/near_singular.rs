//! Poses that are nearly singular, and ranges that are entered from outside.

use std::ops::Range;

use super::Count;
use crate::program::{Program, Verdict};
use crate::reference::random::Random;

/// Arcs so large that their equations are all but dependent.
pub fn arcs(seeds: Range<u64>) -> Vec<Count> {
    let mut off =
        Count::new("very large arc: converged and off by more than 1e-6 (length units)", "0");
    let mut mobile = Count::new("very large arc, rigid: called truly mobile", "0");
    for seed in seeds {
        let mut random = Random::new("arcs", seed);
        let r = random.log_within(1e4, 1e7);
        let along = random.within(1.0, 3.0);
        let turn = along / r;
        // The start is beside the solution by so much.
        let (dx, dy) = (random.within(-0.1, 0.1), random.log_within(1e-5, 1e-3));
        let mut program = Program::after(&format!(
            "let r = {r}, turn = {turn}
             point P = (0, 0) frozen, D = (-10, 0) frozen, M = (0, r) frozen
             point Q = ({}, {dy}), E = ({}, {})
             length Q M = r
             length Q E = 10
             orientation Q E, Q M = 90deg
             orientation D P, Q E = turn",
            along + dx,
            along + dx + 10.0,
            10.0 * dy
        ))
        .expect("the script has no mistake");
        let verdict = program.solve();
        let wrong = (program.number("Q.x") - r * libm::sin(turn)).abs();
        off.add(seed, verdict == Verdict::Converged && wrong > 1e-6, wrong);
        mobile.add(seed, program.check().pose.contains("truly mobile"), 0.0);
    }
    vec![off, mobile]
}

/// Ranges of angles, and the same said by two limits.
pub fn ranges(seeds: Range<u64>) -> Vec<Count> {
    let mut inside =
        Count::new("range entered from outside: does not end on its stop (degrees)", "0");
    for seed in seeds {
        let mut random = Random::new("ranges", seed);
        let (lo, width) = (random.within(-170.0, 60.0), random.within(10.0, 110.0));
        let hi = lo + width;
        let beyond = random.within(1.0, 100.0_f64.min(340.0 - width) / 2.0);
        let (from, stop) = if random.chance(0.5) { (lo - beyond, lo) } else { (hi + beyond, hi) };
        let radius = random.within(0.5, 3.0);
        let statement = if random.chance(0.5) {
            format!("orientation c s, c p in {lo}deg..{hi}deg")
        } else {
            // The same said by two limits, each against a mark of its own.
            format!(
                "point l = polar(1, {lo}deg) frozen, h = polar(1, {hi}deg) frozen
                 orientation c l, c p >= 0; orientation c p, c h >= 0"
            )
        };
        let mut program = Program::after(&format!(
            "point c = (0, 0) frozen, s = (1, 0) frozen, p = polar({radius}, {from}deg)
             length c p = {radius}
             {statement}"
        ))
        .expect("the script has no mistake");
        let verdict = program.solve();
        let angle = program.number("angle(c, s, c, p)").to_degrees();
        let off = crate::reference::constraint::wrapped(angle - stop, 360.0).abs();
        inside.add(seed, verdict != Verdict::Converged || off > 1e-9, off);
    }
    vec![inside]
}
