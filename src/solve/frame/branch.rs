//! Whether something turned over from one pose to another: on which side of its neighbours
//! each point is.

use super::decomposition::{Part, Plan};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx};
use crate::solve::method::rows::{Equations, Rows};

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
    /// The volume of each part that is small enough for it, as last accepted; none while it is not
    /// known.
    pub volumes: Vec<Option<Volume>>,
    /// The same at the pose that was tried last.
    pub next_volumes: Vec<Option<Volume>>,
    /// Whether the volumes are those of the last pose that counted.
    pub knows_volumes: bool,
}

/// The determinant of the rows of a part that has as many as unknowns. They are of length 1, so
/// it lies between -1 and 1, and is 0 where the part is singular: it takes the part that the
/// angle between two bars has for a single point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Volume {
    /// With its sign.
    pub value: f64,
    /// Which rows are active, a bit each: volumes of others do not compare.
    active: u64,
}

/// Parts with more unknowns than this are watched by their triangles alone.
const MOST_UNKNOWNS: usize = 24;

impl Volume {
    /// The volume of rows; none where they are no square of few unknowns.
    pub fn of(equations: &Equations, rows: &Rows) -> Option<Self> {
        let n = 2 * equations.points().len();
        if n > MOST_UNKNOWNS || rows.n_active() != n || equations.n_rows() > u64::BITS as usize {
            return None;
        }
        let mut matrix = [[0.0; MOST_UNKNOWNS]; MOST_UNKNOWNS];
        let (mut active, mut used) = (0, 0);
        for (r, (_, unknowns, gradient, _)) in rows.iter(equations).enumerate() {
            if rows.scales()[r] > 0.0 {
                active |= 1 << r;
                for (&u, g) in unknowns.iter().zip(gradient.as_chunks::<2>().0) {
                    matrix[used][2 * u as usize] = g[0];
                    matrix[used][2 * u as usize + 1] = g[1];
                }
                used += 1;
            }
        }
        Some(Self { value: determinant(&mut matrix, n), active })
    }

    /// Whether a singular pose may lie between this one and another, or next to them.
    pub fn may_cross(self, other: Self) -> bool {
        self.active == other.active && may_cross(self.value, other.value)
    }
}

/// Whether something that is 0 at a singular pose may be 0 between two poses, or next to them: it
/// changed by more than what is left of it.
pub(crate) fn may_cross(before: f64, after: f64) -> bool {
    before.abs().min(after.abs()) < (after - before).abs()
}

/// The determinant of the first `n` rows and columns, by elimination.
fn determinant(matrix: &mut [[f64; MOST_UNKNOWNS]; MOST_UNKNOWNS], n: usize) -> f64 {
    let mut product = 1.0;
    for k in 0..n {
        let size =
            |row: usize, matrix: &[[f64; MOST_UNKNOWNS]; MOST_UNKNOWNS]| matrix[row][k].abs();
        let mut largest = k;
        for row in k + 1..n {
            if size(row, matrix) > size(largest, matrix) {
                largest = row;
            }
        }
        let pivot = matrix[largest][k];
        if pivot == 0.0 {
            return 0.0;
        }
        if largest != k {
            matrix.swap(largest, k);
            product = -product;
        }
        product *= pivot;
        let (done, left) = matrix.split_at_mut(k + 1);
        for row in &mut left[..n - k - 1] {
            let factor = row[k] / pivot;
            if factor != 0.0 {
                for (a, b) in row[k + 1..n].iter_mut().zip(&done[k][k + 1..n]) {
                    *a -= factor * b;
                }
            }
        }
    }
    product
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
        let volumes = vec![None; plan.rest.len()];
        Self {
            sides: vec![0.0; triangles.len()],
            triangles,
            next_volumes: volumes.clone(),
            volumes,
            knows_volumes: false,
        }
    }

    /// The pose that was tried last counts.
    pub fn keep_volumes(&mut self) {
        self.volumes.copy_from_slice(&self.next_volumes);
        self.knows_volumes = true;
    }

    /// A pose was reached in another way.
    pub fn forget_volumes(&mut self) {
        self.knows_volumes = false;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_determinant_knows_its_sign() {
        let mut matrix = [[0.0; MOST_UNKNOWNS]; MOST_UNKNOWNS];
        matrix[0][..3].copy_from_slice(&[0.0, 2.0, 1.0]);
        matrix[1][..3].copy_from_slice(&[3.0, 0.0, 1.0]);
        matrix[2][..3].copy_from_slice(&[1.0, 1.0, 0.0]);
        assert!((determinant(&mut matrix, 3) - 5.0).abs() < 1e-15);
    }

    #[test]
    fn a_crossing_is_near_where_more_changed_than_is_left() {
        assert!(may_cross(0.1, -0.1) && may_cross(0.3, 0.1) && may_cross(0.0, 0.1));
        assert!(!may_cross(0.5, 0.4) && !may_cross(-0.5, -0.9));
    }
}
