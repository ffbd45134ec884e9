//! Whether something turned over from one pose to another: on which side of its neighbours
//! each point is.

use super::decomposition::{Part, Plan};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx};
use crate::linalg::{MOST_UNKNOWNS, Square};
use crate::solve::method::rows::{Equations, Rows};

/// A triangle flatter than this, as the sine of an angle, has no side.
pub(crate) const FLAT: f64 = 1e-6;
/// A pose this near to a singular one counts as next to it: what the tolerance leaves open is a place
/// that much less well known.
pub(crate) const NEARLY_SINGULAR: f64 = 3e-4;
/// On what is nearer to its singular pose than this, as the sine of an angle or a pivot, errors
/// grow more than fivefold.
pub(crate) const SENSITIVE: f64 = 0.2;

/// Triangles of points that bars tie together, in the parts of an island that are solved as a
/// whole. Points found one by one have a side already, see [`super::decomposition::Block`].
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// A point and the other ends of two of its bars.
    pub triangles: Vec<[PointIdx; 3]>,
    /// On which side each point was when last looked at: 1, -1, or 0 if next to none.
    pub sides: Vec<f64>,
    /// On which side each part is that is small enough for it, as last accepted; none while it is not
    /// known.
    pub part_sides: Vec<Option<PartSide>>,
    /// The same at the pose that was tried last.
    pub next_part_sides: Vec<Option<PartSide>>,
    /// Whether these are those of the last pose that counted.
    pub knows_part_sides: bool,
}

/// The least pivot of the rows of a part that has as many as unknowns, with the sign of their
/// determinant. The rows are of length 1, so it lies between -1 and 1, and it is 0 where the part is
/// singular: it takes the part that the angle between two bars has for a single point. (The
/// determinant itself is the smaller the more rows there are.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PartSide {
    /// With its sign.
    pub value: f64,
    /// Which rows are active, a bit each: sides of others do not compare.
    active: u64,
}

impl PartSide {
    /// The side of rows; none where they are no square of few unknowns: more are watched by
    /// their triangles alone.
    pub fn of(equations: &Equations, rows: &Rows) -> Option<Self> {
        let n = 2 * equations.points().len();
        if n > MOST_UNKNOWNS || rows.n_active() != n || equations.n_rows() > u64::BITS as usize {
            return None;
        }
        let mut square: Square = Square::new(n);
        let (mut active, mut used) = (0, 0);
        for (r, (_, unknowns, gradient, _)) in rows.iter(equations).enumerate() {
            if rows.scales()[r] > 0.0 {
                active |= 1 << r;
                let row = square.row(used);
                for (&u, g) in unknowns.iter().zip(gradient.as_chunks::<2>().0) {
                    row[2 * u as usize..][..2].copy_from_slice(g);
                }
                used += 1;
            }
        }
        Some(Self { value: square.eliminate(), active })
    }

    /// Whether it compares with another.
    pub fn is_like(self, other: Self) -> bool {
        self.active == other.active
    }
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
        let part_sides = vec![None; plan.rest.len()];
        Self {
            sides: vec![0.0; triangles.len()],
            triangles,
            next_part_sides: part_sides.clone(),
            part_sides,
            knows_part_sides: false,
        }
    }

    /// The pose that was tried last counts.
    pub fn keep_part_sides(&mut self) {
        self.part_sides.copy_from_slice(&self.next_part_sides);
        self.knows_part_sides = true;
    }

    /// A pose was reached in another way.
    pub fn forget_part_sides(&mut self) {
        self.knows_part_sides = false;
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
