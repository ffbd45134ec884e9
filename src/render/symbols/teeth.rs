//! The outlines of teeth, on a circle and on a line.

use crate::constraint::{Point, Vector};
use crate::render::path::Path;
use std::f64::consts::TAU;

/// Half of a tooth's width at its tip, its pitch line and its root, as parts of the pitch,
/// with the height over the pitch line there in modules: the straight flanks of a 20 degree
/// basic rack, a little slimmer so that meshing teeth do not touch.
const PROFILE: [(f64, f64); 3] = [(0.13, 0.9), (0.23, 0.0), (0.345, -1.1)];

/// The outline of a wheel around the origin, a tooth on the x axis.
pub fn wheel(radius: f64, n_teeth: u32, is_ring: bool) -> Path {
    let n = f64::from(n_teeth);
    let pitch = TAU / n;
    let module = if is_ring { -2.0 * radius / n } else { 2.0 * radius / n };
    let mut outline = Vec::with_capacity(6 * n_teeth as usize);
    for k in 0..n_teeth {
        let tooth = f64::from(k) * pitch;
        let rising = PROFILE.iter().rev().map(|(half, height)| (-half, height));
        let falling = PROFILE.iter().map(|(half, height)| (*half, height));
        for (across, height) in rising.chain(falling) {
            let r = radius + module * height;
            outline.push(Vector::polar(r, tooth + across * pitch).to_point());
        }
    }
    Path::polygon(outline)
}

/// The outline of a rack along the x axis from 0 to `length`, teeth towards negative y (up)
/// or, on the other side, towards positive y; a tooth stands at `first` and every `pitch`.
pub fn rack(length: f64, pitch: f64, first: f64, is_below: bool, thickness: f64) -> Path {
    let up = if is_below { 1.0 } else { -1.0 };
    let module = pitch / std::f64::consts::PI;
    let root = PROFILE[2].1 * module;
    let mut outline = vec![
        Point::new(length, up * (root - thickness)),
        Point::new(0.0, up * (root - thickness)),
        Point::new(0.0, up * root),
    ];
    let mut tooth = first.rem_euclid(pitch);
    while tooth < length {
        let rising = PROFILE.iter().rev().map(|(half, height)| (-half, height));
        let falling = PROFILE.iter().map(|(half, height)| (*half, height));
        for (across, height) in rising.chain(falling) {
            let x = tooth + across * pitch;
            if (0.0..=length).contains(&x) {
                outline.push(Point::new(x, up * height * module));
            }
        }
        tooth += pitch;
    }
    outline.push(Point::new(length, up * root));
    Path::polygon(outline)
}
