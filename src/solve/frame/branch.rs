//! Whether something turned over from one pose to another: on which side of its neighbours
//! each point is.

use super::decomposition::{Block, Part, Plan};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx};
use crate::solve::island::Island;

/// A triangle flatter than this, as the sine of an angle, has no side.
const FLAT: f64 = 1e-6;

/// Triangles of points that bars tie together, in the parts of an island that are solved as a
/// whole. Points found one by one have a side already, see [`super::decomposition::Block`].
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// A point and the other ends of two of its bars.
    triangles: Vec<[PointIdx; 3]>,
    /// On which side each point was when last looked at: 1, -1, or 0 if next to none.
    sides: Vec<f64>,
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
    fn turned_over(&self, x: &[Point]) -> Option<PointIdx> {
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

/// On which side everything is.
pub(crate) struct Sides(Vec<f64>);

impl Island {
    /// On which side each block and each watched point is.
    pub fn sides(&self) -> Sides {
        let blocks = self.plan.blocks.iter().map(|block| block.side);
        Sides(blocks.chain(self.watch.sides.iter().copied()).collect())
    }

    /// Puts sides back.
    pub fn set_sides(&mut self, sides: Sides) {
        let mut sides = sides.0.into_iter();
        self.plan.blocks.iter_mut().zip(&mut sides).for_each(|(block, side)| block.side = side);
        self.watch.sides.iter_mut().zip(&mut sides).for_each(|(to, side)| *to = side);
    }

    /// A watched point that is on the other side than at the last pose that counted. Points
    /// with freedom left may be on any side.
    pub fn watched_point_over(&self) -> Option<PointIdx> {
        self.is_smooth().then(|| self.watch.turned_over(&self.x))?
    }

    /// A point that is on the other side than it was.
    pub fn changed_since(&self, before: &Sides) -> Option<PointIdx> {
        let now = self.sides();
        let blocks = self.plan.blocks.iter();
        let blocks = blocks.map(|block| block.is_determined.then_some(block.point));
        let watched = self.watch.triangles.iter().map(|t| self.is_smooth().then_some(t[0]));
        let mut both = before.0.iter().zip(&now.0).zip(blocks.chain(watched));
        let over = |((a, b), point): ((&f64, &f64), Option<PointIdx>)| {
            point.filter(|_| a * b < 0.0 && a.abs().min(b.abs()) > FLAT)
        };
        both.find_map(over)
    }

    /// Notes what is on the other side at a pose that was tried, as against the last that
    /// counted.
    pub fn note_turning_over(&mut self) {
        let is_over = |block: &&Block| block.is_determined && block.side * block.next_side < 0.0;
        let block = self.plan.blocks.iter().find(is_over);
        let point = block.map(|block| block.point).or_else(|| self.watched_point_over());
        self.turned_over = self.turned_over.or(point);
    }
}
