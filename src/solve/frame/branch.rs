//! Whether something turned over from one pose to another: on which side of its neighbours
//! each point is.

use super::decomposition::{Part, Plan};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx};

/// A triangle flatter than this, as the sine of an angle, has no side.
pub(crate) const FLAT: f64 = 1e-6;

/// Triangles of points that bars tie together, in the parts of an island that are solved as a
/// whole. Points found one by one have a side already, see [`super::decomposition::Block`].
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// A point and the other ends of two of its bars.
    pub triangles: Vec<[PointIdx; 3]>,
    /// On which side each point was when last looked at: 1, -1, or 0 if next to none.
    pub sides: Vec<f64>,
}

impl Watch {
    /// The triangles to watch in an island.
    pub fn new(plan: &Plan, constraints: &[Constraint]) -> Self {
        let mut triangles = Vec::new();
        for part in plan.rest.iter().filter(|part| may_be_rigid(part, constraints)) {
            let mut first = vec![None; part.points.len()];
            let mut is_done = vec![false; part.points.len()];
            for &c in &part.constraints {
                let Constraint::Length(bar) = &constraints[c as usize] else { continue };
                let [a, b] = bar.points;
                if !bar.bounds.is_equality() {
                    continue;
                }
                for (p, q) in [(a, b), (b, a)] {
                    let Ok(k) = part.points.binary_search(&p) else { continue };
                    match first[k] {
                        None => first[k] = Some(q),
                        Some(other) if other != q && !is_done[k] => {
                            is_done[k] = true;
                            triangles.push([p, other, q]);
                        }
                        Some(_) => {}
                    }
                }
            }
        }
        Self { sides: vec![0.0; triangles.len()], triangles }
    }

    /// Looks at a pose that counts.
    pub fn update(&mut self, x: &[Point]) {
        for (to, triangle) in self.sides.iter_mut().zip(&self.triangles) {
            *to = side(*triangle, x);
        }
    }

    /// A point that is on the other side than when last looked at.
    pub fn turned_over(&self, x: &[Point]) -> Option<PointIdx> {
        let both = self.sides.iter().zip(&self.triangles);
        both.filter(|(before, t)| *before * side(**t, x) < 0.0).map(|(_, t)| t[0]).next()
    }
}

/// Whether a part has as many equations as coordinates. With fewer it keeps some freedom at every
/// pose, and what has freedom left may be on any side.
fn may_be_rigid(part: &Part, constraints: &[Constraint]) -> bool {
    let rows = part.constraints.iter().map(|&c| constraints[c as usize].n_rows());
    rows.sum::<usize>() >= 2 * part.points.len()
}

/// On which side of the others the first point of a triangle is; 0 where it is flat.
fn side([p, a, b]: [PointIdx; 3], x: &[Point]) -> f64 {
    let [p, a, b] = [p, a, b].map(|k| x[k as usize]);
    let (a, b) = (a - p, b - p);
    let (area, size) = (a.cross(b), a.norm_squared() * b.norm_squared());
    // Squares, so that no root is taken where nothing is needed but a sign.
    if area * area > FLAT * FLAT * size { area.signum() } else { 0.0 }
}
