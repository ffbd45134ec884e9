//! One scalar equation at a pose: its value and its gradient at the few points it holds.

use super::geometry::Vector;

/// Index of a point in the columns a constraint is evaluated on.
pub type PointIdx = u32;

/// A scalar equation `f = 0`, linearised: value and gradient at the points it holds.
///
/// Four of them have their place in the row itself, which is all that most kinds need; those of
/// an equation between more stand behind it.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// The value of `f`, in the unit of its constraint (length, or radians).
    pub f: f64,
    /// How many of `points` and `gradient` are in use.
    pub n_points: usize,
    /// The first points, each once.
    pub points: [PointIdx; 4],
    /// The derivative of `f` by each of these points.
    pub gradient: [Vector; 4],
    /// Further points, each once, with the derivatives by them.
    pub further: &'a [(PointIdx, Vector)],
    /// False where an inequality is satisfied: the row asks for nothing then.
    pub is_active: bool,
    /// The length of the segment whose direction is the gradient (length rows), else 0.
    /// A stretched segment is stiff across its direction too: `f / span` per unit length.
    pub span: f64,
}

impl<'a> Row<'a> {
    /// An equation with value `f` and no points yet.
    #[inline]
    pub fn new(f: f64) -> Self {
        Self {
            f,
            n_points: 0,
            points: [0; 4],
            gradient: [Vector::ZERO; 4],
            further: &[],
            is_active: true,
            span: 0.0,
        }
    }

    /// A row that asks for nothing at this pose but keeps its place among `points`.
    #[inline]
    pub fn inactive(points: &[PointIdx]) -> Self {
        let mut row = points.iter().fold(Self::new(0.0), |row, &p| row.with(p, Vector::ZERO));
        row.is_active = false;
        row
    }

    /// An equation between any number of points, each of them once.
    #[must_use]
    pub fn of_terms(f: f64, terms: &'a [(PointIdx, Vector)]) -> Self {
        let (first, further) = terms.split_at(terms.len().min(4));
        let row = first.iter().fold(Self::new(f), |row, &(p, g)| row.with(p, g));
        Self { further, ..row }
    }

    /// Adds the derivative by a point; a point that occurs twice is merged.
    #[must_use]
    #[inline]
    pub fn with(mut self, point: PointIdx, gradient: Vector) -> Self {
        if let Some(k) = self.points[..self.n_points].iter().position(|p| *p == point) {
            self.merge(k, gradient);
        } else {
            self.points[self.n_points] = point;
            self.gradient[self.n_points] = gradient;
            self.n_points += 1;
        }
        self
    }

    #[cold]
    fn merge(&mut self, k: usize, gradient: Vector) {
        let size = self.gradient[k].norm() + gradient.norm();
        self.gradient[k] += gradient;
        // Derivatives that cancel leave their rounding; dividing by that would throw the
        // point across the plane.
        if self.gradient[k].norm() <= 4.0 * f64::EPSILON * size {
            self.gradient[k] = Vector::ZERO;
        }
    }

    /// The points with their derivatives.
    #[inline]
    pub fn terms(&self) -> impl Iterator<Item = (PointIdx, Vector)> + '_ {
        let first = (0..self.n_points).map(|k| (self.points[k], self.gradient[k]));
        first.chain(self.further.iter().copied())
    }

    /// The squared norm of the gradient in the metric of the weights; 0 if nothing can move.
    pub fn norm_squared(&self, w: &[f64]) -> f64 {
        let moving = self.terms().filter(|&(p, _)| w[p as usize] > 0.0);
        moving.map(|(p, g)| w[p as usize] * g.norm_squared()).sum()
    }

    /// The norm of the gradient in the metric of the weights, also where its square is beyond what
    /// numbers hold; 0 if nothing can move.
    pub fn norm(&self, w: &[f64]) -> f64 {
        self.norm_by(|p| w[p as usize])
    }

    fn norm_by(&self, weight: impl Fn(PointIdx) -> f64) -> f64 {
        let terms = || self.terms().filter(|&(p, _)| weight(p) > 0.0);
        let squared: f64 = terms().map(|(p, g)| weight(p) * g.norm_squared()).sum();
        if squared.is_normal() {
            return squared.sqrt();
        }
        let largest = terms().fold(0.0, |most: f64, (_, g)| most.max(g.x.abs()).max(g.y.abs()));
        if !largest.is_normal() {
            return largest;
        }
        let part = |(p, g): (PointIdx, Vector)| {
            weight(p) * Vector::new(g.x / largest, g.y / largest).norm_squared()
        };
        largest * terms().map(part).sum::<f64>().sqrt()
    }

    /// The distance to satisfaction, see [`crate::constraint::ConstraintKind::violation`].
    pub fn distance(&self, w: &[f64]) -> f64 {
        if self.f == 0.0 {
            return 0.0;
        }
        let weighted = self.norm(w);
        let norm = if weighted > 0.0 { weighted } else { self.norm_by(|_| 1.0) };
        let f = self.f.abs();
        if norm > 0.0 { f / norm } else { f }
    }

    /// The shortest displacement that satisfies the linearised equation: the general form of
    /// the paper's `A_a`, `d = -f W grad f / |grad f|_W^2`.
    pub fn correct(&self, w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let squared = self.norm_squared(w);
        if self.f == 0.0 || !squared.is_normal() {
            return;
        }
        let tau = -self.f / squared;
        for (p, g) in self.terms().filter(|&(p, _)| w[p as usize] > 0.0) {
            move_by(p, g * (w[p as usize] * tau));
        }
    }
}
