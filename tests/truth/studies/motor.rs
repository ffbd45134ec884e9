//! Motors whose speed is an expression: the angle is the integral of the speed.

use std::f64::consts::TAU;
use std::ops::Range;

use super::Count;
use crate::program::Program;
use crate::reference::constraint::wrapped;
use crate::reference::random::Random;

/// Radians that an angle may be off, and for each radian that was turned.
const EXACT: f64 = 1e-12;

/// Polynomials, waves and decays.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut off = Count::new("motor with an expression as its speed: off (radians)", "0");
    let mut jumps = Count::new("speed changed on the way: the angle jumps (radians)", "0");
    for seed in seeds {
        let mut random = Random::new("motor", seed);
        let (a, b, c) =
            (random.within(-3.0, 3.0), random.within(-2.0, 2.0), random.within(0.5, 4.0));
        let (text, speed): (String, Box<dyn Fn(f64) -> f64>) = match random.below(4) {
            0 => (format!("{a} + {b} * time"), Box::new(move |t| a + b * t)),
            1 => (format!("{a} * sin({c} * time)"), Box::new(move |t| a * libm::sin(c * t))),
            2 => (format!("{a} * time ^ 2 - {b} * time"), Box::new(move |t| a * t * t - b * t)),
            _ => (format!("{a} * exp(-{c} * time)"), Box::new(move |t| a * libm::exp(-c * t))),
        };
        let frames = 1 + random.below(60);
        let dt = random.pick(&[1.0 / 60.0, 0.01, 0.05]);
        let mut program = Program::after(&format!(
            "point A = (0, 0) frozen, B = (1, 0)
             set dt {dt}
             crank: motor A B speed {text}
             step {frames}"
        ))
        .expect("the script has no mistake");
        let end = frames as f64 * dt;
        let total = integral(&*speed, 0.0, end);
        let wrong = wrapped(program.number("angle(A, B)") - total, TAU).abs();
        off.add(seed, wrong > EXACT * (1.0 + total.abs()), wrong);
        let before = program.number("angle(A, B)");
        program.must(&format!("change crank speed {c}"));
        program.must("step");
        let by = wrapped(program.number("angle(A, B)") - before - c * dt, TAU).abs();
        jumps.add(seed, by > EXACT * (1.0 + total.abs()), by);
    }
    vec![off, jumps]
}

/// The integral of a smooth function, by Gauss and Legendre's five points in 64 parts.
pub fn integral(f: &dyn Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    const N: usize = 64;
    let root = (10.0_f64 / 7.0).sqrt();
    let inner = (5.0 - 2.0 * root).sqrt() / 3.0;
    let outer = (5.0 + 2.0 * root).sqrt() / 3.0;
    let thirteen = 13.0 * 70.0_f64.sqrt();
    let (near, far) = ((322.0 + thirteen) / 900.0, (322.0 - thirteen) / 900.0);
    let points = [(0.0, 128.0 / 225.0), (inner, near), (-inner, near), (outer, far), (-outer, far)];
    let h = (to - from) / N as f64;
    let part = |k: usize| {
        let middle = from + (k as f64 + 0.5) * h;
        points.iter().map(|(x, w)| w * f(middle + 0.5 * h * x)).sum::<f64>()
    };
    0.5 * h * (0..N).map(part).sum::<f64>()
}
