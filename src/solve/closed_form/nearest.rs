//! Points on circles that nothing else holds: each stays as near as it can to where it was.

#![allow(clippy::needless_range_loop, reason = "loops over all frames, that vectors are made of")]

use super::abreast::{Abreast, Places, Poses, put_each};
use super::found::plain_length;
use super::length::{Length, Timed};
use crate::constraint::{Point, PointIdx, Vector};

/// A point on a circle, where it is nearest to.
pub(super) struct Nearest {
    /// The point that is found.
    pub to: PointIdx,
    /// The centre.
    pub from: PointIdx,
    /// How far it is to be away.
    pub radius: Radius,
}

/// The radius of a circle.
#[derive(Clone, Copy)]
pub(super) enum Radius {
    /// A length.
    Fixed(Length),
    /// So many times the distance between two points, and so much more.
    Measured {
        /// The points.
        between: [PointIdx; 2],
        /// How many times.
        factor: f64,
        /// How much more.
        offset: f64,
    },
}

/// Each goes on from where it was in the frame before, so that frames side by side wait for each other: a
/// few points are found at a time.
pub(super) const FEW: usize = 4;

impl Nearest {
    /// Its radius, if that is a length.
    pub fn length_mut(&mut self) -> Option<&mut Length> {
        match &mut self.radius {
            Radius::Fixed(length) => Some(length),
            Radius::Measured { .. } => None,
        }
    }
}

/// Puts a few points on circles.
#[inline(always)]
pub(super) fn run<const N: usize>(
    points: &[Nearest],
    x: &mut (impl Poses<N> + ?Sized),
    abreast: &mut Abreast<N>,
) {
    let (mut centres, mut radii) = ([Places::all(Point::ORIGIN); FEW], [[0.0; N]; FEW]);
    let (mut last_x, mut last_y) = ([0.0; FEW], [0.0; FEW]);
    let n = points.len().min(FEW);
    for (k, point) in points[..n].iter().enumerate() {
        (centres[k], radii[k]) = (x.get(point.from), point.radius.of(x, &abreast.lengths));
        let last = x.get(point.to).at(N - 1);
        (last_x[k], last_y[k]) = (last.x, last.y);
    }
    let mut found = [Places::<N>::all(Point::ORIGIN); FEW];
    for l in 0..N {
        for k in 0..FEW {
            let centre = centres[k].at(l);
            let arm = Point::new(last_x[k], last_y[k]) - centre;
            let at = centre + arm * (radii[k][l] / length::<N>(arm));
            (last_x[k], last_y[k]) = (at.x, at.y);
            found[k].set(l, at);
        }
    }
    for (k, point) in points[..n].iter().enumerate() {
        let (centre, radius, found) = (centres[k], radii[k], found[k]);
        put_each(point.to, x, abreast, |l| {
            let at = found.at(l);
            let off = length::<N>(at - centre.at(l)) - radius[l];
            // How far it went is not said: nothing follows from where it is.
            (at, 0.0, if radius[l] >= 0.0 { off } else { f64::NAN })
        });
    }
}

/// How long a vector is; not a number, in frames side by side, where its square is none that can be held.
#[inline(always)]
fn length<const N: usize>(v: Vector) -> f64 {
    if N == 1 { v.norm() } else { plain_length(v) }
}

impl Radius {
    /// How long it is in each frame.
    #[inline(always)]
    fn of<const N: usize>(&self, x: &(impl Poses<N> + ?Sized), lengths: &[Timed<N>]) -> [f64; N] {
        match *self {
            Self::Fixed(radius) if N > 1 => radius.each(lengths).now,
            Self::Fixed(radius) => [radius.now; N],
            Self::Measured { between, factor, offset } => {
                let [p, q] = between.map(|p| x.get(p));
                let mut radii = [0.0; N];
                for l in 0..N {
                    radii[l] = factor * length::<N>(q.at(l) - p.at(l)) + offset;
                }
                radii
            }
        }
    }
}
