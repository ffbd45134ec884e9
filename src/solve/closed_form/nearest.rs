//! Points on circles that nothing else holds: each stays as near as it can to where it was.

use super::abreast::{Abreast, Places, Poses, put_each};
use super::length::{Length, Timed};
use super::{Radius, Step};
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

/// Each goes on from where it was in the frame before, so that frames side by side wait for each other: a
/// few points are found at a time.
const FEW: usize = 4;

impl Nearest {
    /// Its radius, if that is a length.
    pub fn length_mut(&mut self) -> Option<&mut Length> {
        match &mut self.radius {
            Radius::Fixed(length) => Some(length),
            Radius::Measured { .. } => None,
        }
    }
}

/// Puts all such points of a list behind the others, a few together: nothing follows from where they are.
pub(super) fn gather(steps: Vec<Step>) -> Vec<Step> {
    let (last, mut steps): (Vec<_>, Vec<_>) =
        steps.into_iter().partition(|step| matches!(step, Step::Nearest(_)));
    let mut points = last.into_iter().flat_map(Step::into_nearest).peekable();
    while points.peek().is_some() {
        steps.push(Step::Nearest(points.by_ref().take(FEW).collect()));
    }
    steps
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
