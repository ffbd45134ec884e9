//! Where a constraint that adds up points, as a hinge does, puts one of them.

use super::found::Found;
use crate::constraint::{Constraint, ConstraintKind as _, Point, PointIdx};

/// A point that is so many parts of each of up to three others.
pub(super) struct Sum {
    /// The point that is found.
    pub to: PointIdx,
    /// The constraint.
    constraint: u32,
    /// The others with their parts, which add up to 1, the largest first.
    parts: [(PointIdx, f64); 3],
    n_parts: usize,
}

impl Sum {
    /// A point where the constraint of number `c` puts it; none where that is no sum of others.
    pub fn new(to: PointIdx, c: u32, constraint: &Constraint, n_points: usize) -> Option<Self> {
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
        is_sound.then_some(Self { to, constraint: c, parts, n_parts })
    }

    /// Puts the point where it belongs.
    #[inline]
    pub fn run(
        &self,
        x: &mut [Point],
        ways: &mut [f64],
        constraints: &[Constraint],
        found: &mut Found,
    ) {
        let [(first, part), ..] = self.parts;
        // From there, so that no digits are lost far from the origin.
        let base = x[first as usize];
        let (mut at, mut way) = (base, part.abs() * ways[first as usize]);
        for &(p, part) in &self.parts[1..self.n_parts] {
            at += (x[p as usize] - base) * part;
            way += part.abs() * ways[p as usize];
        }
        x[self.to as usize] = at;
        ways[self.to as usize] = way;
        found.add(constraints[self.constraint as usize].residual(x));
    }
}
