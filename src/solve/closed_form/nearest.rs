//! Points on circles that nothing else holds: each stays as near as it can to where it was.

use super::abreast::{Abreast, Places, Poses, put_each};
use super::length::{Length, Timed};
use crate::constraint::{Point, PointIdx};

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
    let mut centres = [Places::all(Point::ORIGIN); FEW];
    let mut radii = [[0.0; N]; FEW];
    let mut last = [Point::ORIGIN; FEW];
    let mut found = [[(Point::ORIGIN, 0.0, 0.0); N]; FEW];
    let n = points.len().min(FEW);
    for (k, point) in points[..n].iter().enumerate() {
        (centres[k], radii[k]) = (x.get(point.from), point.radius.of(x, &abreast.lengths));
        last[k] = x.get(point.to).at(N - 1);
    }
    for l in 0..N {
        for k in 0..n {
            let (centre, radius) = (centres[k].at(l), radii[k][l]);
            let arm = last[k] - centre;
            let at = centre + arm * (radius / arm.norm());
            let off = (at - centre).norm() - radius;
            // How far it went is not said: nothing follows from where it is.
            found[k][l] = (at, 0.0, if radius >= 0.0 { off } else { f64::NAN });
            last[k] = at;
        }
    }
    for (point, found) in points.iter().zip(&found) {
        put_each(point.to, x, abreast, |l| found[l]);
    }
}

impl Radius {
    /// How long it is in each frame.
    fn of<const N: usize>(&self, x: &(impl Poses<N> + ?Sized), lengths: &[Timed<N>]) -> [f64; N] {
        match *self {
            Self::Fixed(radius) if N > 1 => radius.each(lengths).now,
            Self::Fixed(radius) => [radius.now; N],
            Self::Measured { between, factor, offset } => {
                let [p, q] = between.map(|p| x.get(p));
                std::array::from_fn(|l| factor * p.at(l).distance(q.at(l)) + offset)
            }
        }
    }
}
