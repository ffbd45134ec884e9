//! A path in a moving picture: it lies there lightly and is drawn over as its point moves.

use super::canvas::{Canvas, Lettering};
use super::figure::{Figure, Outline};
use super::keyframes::{AnimatedAttribute, Keyframes, track};
use super::laps::once;
use super::page::Page;
use super::style::{Class, colour_number};
use super::trace::Curve;
use crate::diag::format_decimals;
use crate::interrupt::tick;

/// What measuring the way to a sample takes, in ticks.
const WAY: usize = 10;

/// How far the end of the path may be from its point, px.
const TOLERANCE: f64 = 0.3;

/// The figures of a path of which there were `n_samples` in each frame.
pub fn follow(
    curve: &Curve,
    page: &Page,
    n_samples: &[usize],
    times: &[f64],
    duration: f64,
) -> Vec<(Figure, Option<Keyframes>)> {
    let none = Lettering::new();
    let mut canvas = Canvas::new(page, &[], &none);
    let whole = curve.draw(&mut canvas).clone();
    let lengths = lengths(curve, page);
    let length = lengths.last().copied().unwrap_or(0.0);
    // A dash pattern begins anew at each stretch: only a path of one lends itself to it.
    let [shape] = &whole.shapes[..] else {
        return vec![(whole, None)];
    };
    let Outline::Path(path) = &shape.outline else {
        return vec![(whole, None)];
    };
    let way_to = |n: usize| match curve.samples.n_seen(n).checked_sub(1) {
        Some(k) => lengths.get(k).copied().unwrap_or(length),
        None => 0.0,
    };
    let left: Vec<f64> = n_samples.iter().map(|&n| length - way_to(n)).collect();
    let change = AnimatedAttribute::Shape(0, "stroke-dashoffset");
    let write = |row: &[f64]| format_decimals(row[0], 2);
    let Some(track) = track(change, times, &left, 1, TOLERANCE, write) else {
        return vec![(whole, None)];
    };
    let (mut faint, mut drawn) = (whole.clone(), whole.clone());
    faint.shapes[0].class = Class::Faint(colour_number(curve.idx));
    drawn.shapes[0].outline = Outline::GrowingPath { path: path.clone(), length };
    drawn.part += 1;
    vec![(faint, None), (drawn, Some(Keyframes { duration, tracks: vec![track] }))]
}

/// How long the path is up to each of its samples, and altogether at the end, px. Later laps add nothing,
/// and a lap that is closed is longer than the way to its last sample.
fn lengths(curve: &Curve, page: &Page) -> Vec<f64> {
    let mut length = 0.0;
    let mut last = None;
    let up_to = |at| {
        let here = page.px(at);
        length += last.replace(here).map_or(0.0, |before| here.distance(before));
        length
    };
    curve.samples.read(|samples| {
        tick(WAY * samples.len());
        let lap = once(samples).of(samples);
        lap.map(|sample| sample.at).map(up_to).collect()
    })
}
