//! What the analysis of a mechanism costs: `cargo bench --bench mobility`.
#![allow(clippy::disallowed_methods)]

use linkwork::constraint::{Bounds, Constraint, Length, Point};
use linkwork::mobility::{ConstraintSystem, analyse};
use std::time::Instant;

fn bar(x: &[Point], a: u32, b: u32) -> Constraint {
    let l = x[a as usize].distance(x[b as usize]);
    Length { points: [a, b], bounds: Bounds::exactly(l) }.into()
}

/// Bars of length 1 along half a circle, both ends held.
fn chain(n: u32) -> (Vec<Point>, Vec<f64>, Vec<Constraint>) {
    let r = f64::from(n) / std::f64::consts::PI;
    let x: Vec<_> = (0..=n)
        .map(|k| {
            let (s, c) = (f64::from(k) / r).sin_cos();
            Point::new(-r * c, r * s)
        })
        .collect();
    let mut w = vec![1.0; x.len()];
    w[0] = 0.0;
    w[n as usize] = 0.0;
    let bars = (0..n).map(|k| bar(&x, k, k + 1)).collect();
    (x, w, bars)
}

/// A leg after Theo Jansen, near enough to one to cost the same.
fn leg() -> (Vec<Point>, Vec<f64>, Vec<Constraint>) {
    let x: Vec<_> = [
        (0.0, 0.0),
        (-38.0, -7.8),
        (15.0, 0.0),
        (-19.0, 29.0),
        (-78.0, -1.0),
        (-14.0, -38.0),
        (-66.0, -36.0),
        (-43.0, -80.0),
    ]
    .map(|(x, y)| Point::new(x, y))
    .into();
    let mut w = vec![1.0; x.len()];
    w[0] = 0.0;
    w[1] = 0.0;
    let bars =
        [(0, 2), (2, 3), (1, 3), (1, 4), (3, 4), (2, 5), (1, 5), (4, 6), (5, 6), (5, 7), (6, 7)];
    let bars = bars.map(|(a, b)| bar(&x, a, b)).into();
    (x, w, bars)
}

/// Bars of lengths 1, 1 and 3 at their best fit.
fn impossible_triangle() -> (Vec<Point>, Vec<f64>, Vec<Constraint>) {
    let x: Vec<_> = [0.0, 4.0 / 3.0, 8.0 / 3.0].map(|x| Point::new(x, 0.0)).into();
    let bar = |a, b, l| Length { points: [a, b], bounds: Bounds::exactly(l) }.into();
    (x, vec![1.0; 3], vec![bar(0, 1, 1.0), bar(1, 2, 1.0), bar(0, 2, 3.0)])
}

/// Three parallel cranks, coupled by two bars and one too many.
fn wheels() -> (Vec<Point>, Vec<f64>, Vec<Constraint>) {
    let pivots = [0.0, 2.0, 5.0];
    let mut x: Vec<_> = pivots.map(|x| Point::new(x, 0.0)).into();
    x.extend(pivots.map(|x| Point::new(x + 0.6, 0.8)));
    let bars = [(0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (3, 5)].map(|(a, b)| bar(&x, a, b)).into();
    (x, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], bars)
}

/// `n` x `n` squares with both diagonals, two corners held.
fn net(n: u32) -> (Vec<Point>, Vec<f64>, Vec<Constraint>) {
    let side = n + 1;
    let x: Vec<_> =
        (0..side * side).map(|k| Point::new(f64::from(k % side), f64::from(k / side))).collect();
    let mut w = vec![1.0; x.len()];
    w[0] = 0.0;
    w[n as usize] = 0.0;
    let mut bars = Vec::new();
    for i in 0..side {
        for j in 0..side {
            let at = i * side + j;
            if j < n {
                bars.push(bar(&x, at, at + 1));
            }
            if i < n {
                bars.push(bar(&x, at, at + side));
            }
            if i < n && j < n {
                bars.push(bar(&x, at, at + side + 1));
                bars.push(bar(&x, at + 1, at + side));
            }
        }
    }
    (x, w, bars)
}

fn main() {
    let scenes = [
        ("triangle", impossible_triangle()),
        ("wheels", wheels()),
        ("leg", leg()),
        ("chain 10", chain(10)),
        ("chain 1000", chain(1000)),
        ("chain 10000", chain(10000)),
        ("net 4", net(4)),
        ("net 8", net(8)),
        ("net 16", net(16)),
        ("net 32", net(32)),
        ("net 64", net(64)),
    ];
    println!(
        "{:<12} {:>8} {:>8} {:>10} {:>8}  milliseconds",
        "scene", "rows", "freedoms", "redundant", "analyse"
    );
    for (name, (x, w, bars)) in scenes {
        let constraints: Vec<_> = bars.iter().collect();
        let scene = ConstraintSystem { constraints: &constraints, x: &x, w: &w };
        let mut found = analyse(&scene, 1e-9);
        let mut times: Vec<_> = (0..5)
            .map(|_| {
                let start = Instant::now();
                found = analyse(&scene, 1e-9);
                start.elapsed().as_secs_f64() * 1e3
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!(
            "{name:<12} {:>8} {:>8} {:>10} {:>8.3}",
            bars.len(),
            found.degrees_of_freedom,
            found.n_redundant,
            times[2]
        );
    }
}
