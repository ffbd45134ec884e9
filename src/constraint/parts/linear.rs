//! Vector equations `sum c_i x_i = b` with complex coefficients, every point once.

use crate::constraint::{PointIdx, Row, Vector};

/// The left side of such an equation. A real coefficient has no `y`.
///
/// The value `g` of the equation is the caller's to work out, from differences of positions:
/// summing `c_i x_i` would lose digits far from the origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Linear {
    n_points: usize,
    points: [PointIdx; 4],
    coefficients: [Vector; 4],
    /// The sum of the absolute values merged into each coefficient.
    sizes: [f64; 4],
}

impl Linear {
    /// The equation that holds no points.
    pub const fn new() -> Self {
        Self { n_points: 0, points: [0; 4], coefficients: [Vector::ZERO; 4], sizes: [0.0; 4] }
    }

    /// Adds `c` times the point; a point that occurs twice is merged.
    pub fn with(mut self, point: PointIdx, c: Vector) -> Self {
        let known = (0..self.n_points).find(|&k| self.points[k] == point);
        let k = known.unwrap_or(self.n_points);
        self.n_points = self.n_points.max(k + 1);
        self.points[k] = point;
        self.coefficients[k] += c;
        self.sizes[k] += c.x.abs() + c.y.abs();
        // Coefficients that cancel leave their rounding; dividing by that would throw
        // the point across the plane.
        let cancelled = 4.0 * f64::EPSILON * self.sizes[k];
        if known.is_some() && self.coefficients[k].norm() <= cancelled {
            self.coefficients[k] = Vector::ZERO;
        }
        self
    }

    /// Adds a real multiple of the point.
    pub fn with_real(self, point: PointIdx, c: f64) -> Self {
        self.with(point, Vector::new(c, 0.0))
    }

    /// The shortest displacement that takes the value from `g` to 0:
    /// `d_i = -w_i conj(c_i) g / sum w |c|^2`. Exact in one step.
    pub fn correct(&self, g: Vector, w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let sum: f64 = self.terms().map(|(p, c)| w[p as usize] * c.norm_squared()).sum();
        // Everything frozen, or a point held against itself: nothing can move.
        if sum == 0.0 {
            return;
        }
        let q = g / sum;
        for (p, c) in self.terms().filter(|&(p, _)| w[p as usize] > 0.0) {
            move_by(p, q.times_conj(c) * -w[p as usize]);
        }
    }

    /// The two rows, x before y, for the value `g`.
    pub fn rows(&self, g: Vector, row: &mut impl FnMut(Row)) {
        let (mut along_x, mut along_y) = (Row::new(g.x), Row::new(g.y));
        for (p, c) in self.terms() {
            along_x = along_x.with(p, Vector::new(c.x, -c.y));
            along_y = along_y.with(p, Vector::new(c.y, c.x));
        }
        row(along_x);
        row(along_y);
    }

    fn terms(&self) -> impl Iterator<Item = (PointIdx, Vector)> + '_ {
        (0..self.n_points).map(|k| (self.points[k], self.coefficients[k]))
    }
}
