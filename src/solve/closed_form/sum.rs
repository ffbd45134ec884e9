//! Where a constraint that adds up points, as a hinge does, puts one of them.

use super::abreast::{Abreast, Poses, put_each};
use super::found::larger;
use crate::constraint::{Constraint, ConstraintKind as _, Point, PointIdx};

/// A point that is so many parts of each of up to three others.
pub(super) struct Sum {
    /// The point that is found.
    pub to: PointIdx,
    /// The others with their parts, which add up to 1, the largest first.
    parts: [(PointIdx, f64); 3],
    n_parts: usize,
    /// How many times the constraint counts a distance of the point from there.
    scale: f64,
}

impl Sum {
    /// A point where a constraint puts it; none where that is no sum of others.
    pub fn new(to: PointIdx, constraint: &Constraint, n_points: usize) -> Option<Self> {
        let adds_up = matches!(
            constraint,
            Constraint::Coincidence(_) | Constraint::Equivalence(_) | Constraint::Hinge(_)
        );
        if !adds_up {
            return None;
        }
        // The first row adds up the x of all points, in the same way at every pose.
        let anywhere = vec![Point::new(0.0, 0.0); n_points];
        let mut terms = Vec::new();
        constraint.jacobian(&anywhere, &mut |row| {
            if terms.is_empty() {
                let of_points = row.points.iter().zip(row.gradient).take(row.n_points);
                terms.extend(of_points.map(|(&p, gradient)| (p, gradient.x)));
            }
        });
        let (_, own) = *terms.iter().find(|(p, _)| *p == to)?;
        terms.retain(|(p, times)| *p != to && *times != 0.0);
        terms.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
        let mut parts = [(0, 0.0); 3];
        let n_parts = terms.len();
        for (part, (p, times)) in parts.get_mut(..n_parts)?.iter_mut().zip(terms) {
            *part = (p, -times / own);
        }
        let is_sound = n_parts > 0 && parts.iter().all(|(_, part)| part.is_finite());
        is_sound.then_some(Self { to, parts, n_parts, scale: own.abs() })
    }

    /// Puts the point where it belongs.
    #[inline(always)]
    pub fn run<const N: usize>(&self, x: &mut (impl Poses<N> + ?Sized), abreast: &mut Abreast<N>) {
        // What has no part stands for the first, none of which is added to it.
        let parts = &self.parts[..self.n_parts];
        let of = self.parts.map(|(p, part)| if part == 0.0 { parts[0].0 } else { p });
        let times = self.parts.map(|(_, part)| part);
        let places = of.map(|p| x.get(p));
        let ways = of.map(|p| abreast.ways[p as usize]);
        put_each(self.to, x, abreast, |l| {
            // From there, so that no digits are lost far from the origin.
            let [base, second, third] = places.each_ref().map(|p| p.at(l));
            let at = base + (second - base) * times[1] + (third - base) * times[2];
            let went = ways.each_ref().map(|way| way[l]);
            let way =
                times[0].abs() * went[0] + times[1].abs() * went[1] + times[2].abs() * went[2];
            let left = (base - at) * times[0] + (second - at) * times[1] + (third - at) * times[2];
            (at, way, larger(left.x.abs(), left.y) * self.scale)
        });
    }
}
