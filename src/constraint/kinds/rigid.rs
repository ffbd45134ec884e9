//! A rigid body: points that keep the shape they had.

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::geometry::direction;
use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Given, Point, PointIdx, Quantity,
    Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};

/// The points keep their shape: they move, turn and are not mirrored.
///
/// The two farthest apart, A and B, keep their distance; every other point P keeps its place
/// in their frame, `P = A + zeta (B - A)` with a complex number zeta of modulus at most 1.
/// That is one equation for each freedom taken, and none is ill-conditioned.
#[derive(Debug, Clone, PartialEq)]
pub struct Rigid {
    points: Box<[PointIdx]>,
    /// The zeta of each point: 0 for A, 1 for B.
    shape: Box<[Vector]>,
    /// Which of the points are A and B.
    ends: [usize; 2],
    /// The distance from A to B.
    length: f64,
}

impl Rigid {
    /// A body of these points as they stand; a point given twice counts once.
    pub fn new(points: &[PointIdx], x: &[Point]) -> Self {
        let mut once: Vec<PointIdx> = Vec::with_capacity(points.len());
        for &p in points {
            if !once.contains(&p) {
                once.push(p);
            }
        }
        let at = |i: usize| x[once[i] as usize];
        let (mut ends, mut length) = ([0, 1], 0.0);
        for j in 1..once.len() {
            for i in 0..j {
                let l = at(i).distance(at(j));
                if l > length {
                    (ends, length) = ([i, j], l);
                }
            }
        }
        let shape = (0..once.len())
            .map(|i| match i {
                // Points that all coincide have no frame, and need none.
                _ if length == 0.0 => Vector::ZERO,
                _ if i == ends[0] => Vector::ZERO,
                _ if i == ends[1] => Vector::new(1.0, 0.0),
                _ => (at(i) - at(ends[0])).over(at(ends[1]) - at(ends[0])),
            })
            .collect();
        Self { points: once.into(), shape, ends, length }
    }

    /// Where each point is in a frame of the body's own, in units of length.
    pub fn places(&self) -> impl Iterator<Item = (PointIdx, Vector)> + '_ {
        self.points.iter().zip(&self.shape).map(|(&p, &zeta)| (p, zeta * self.length))
    }

    /// The points A and B, and their distance; none for a single point.
    pub fn frame(&self) -> Option<([PointIdx; 2], f64)> {
        Some((self.base()?, self.length))
    }

    /// The points A and B; none for a single point, which is rigid anyhow.
    fn base(&self) -> Option<[PointIdx; 2]> {
        (self.points.len() > 1).then(|| self.ends.map(|i| self.points[i]))
    }

    /// The points other than A and B, with their zeta.
    pub fn others(&self) -> impl Iterator<Item = (PointIdx, Vector)> + '_ {
        self.points
            .iter()
            .zip(&self.shape)
            .enumerate()
            .filter(|(i, _)| !self.ends.contains(i))
            .map(|(_, (&p, &zeta))| (p, zeta))
    }

    /// The centroid of the body and of its shape, and the sum of moments whose angle is the
    /// best rotation, for these masses; relative to `origin`.
    fn fit(&self, x: &[Point], origin: Point, mass: impl Fn(PointIdx) -> f64) -> Fit {
        let terms = || {
            self.points
                .iter()
                .zip(&self.shape)
                .map(|(&p, &zeta)| (mass(p), x[p as usize] - origin, zeta * self.length))
        };
        let mut fit = Fit::default();
        let mut total = 0.0;
        for (m, r, s) in terms() {
            fit.body += r * m;
            fit.shape += s * m;
            total += m;
        }
        if total > 0.0 {
            fit.body = fit.body / total;
            fit.shape = fit.shape / total;
        }
        fit.turn = self.moments(x, origin, &mass, &fit);
        fit
    }

    fn moments(
        &self,
        x: &[Point],
        origin: Point,
        mass: &impl Fn(PointIdx) -> f64,
        about: &Fit,
    ) -> Vector {
        let mut turn = Vector::ZERO;
        for (&p, &zeta) in self.points.iter().zip(&self.shape) {
            let r = x[p as usize] - origin - about.body;
            turn += r.times_conj(zeta * self.length - about.shape) * mass(p);
        }
        turn
    }
}

/// Where a shape belongs: its centroid `shape` on `body`, turned by the angle of `turn`.
#[derive(Debug, Clone, Copy, Default)]
struct Fit {
    body: Vector,
    shape: Vector,
    turn: Vector,
}

/// The place of P in the frame of A and B, `x_P - x_A - zeta (x_B - x_A)`.
fn hinge_value([p, a, b]: [Point; 3], zeta: Vector) -> Vector {
    (p - a) - (b - a).times(zeta)
}

fn hinge_linear([p, a, b]: [PointIdx; 3], zeta: Vector) -> Linear {
    Linear::new().with_real(p, 1.0).with(a, zeta - Vector::new(1.0, 0.0)).with(b, -zeta)
}

impl Declared for Rigid {
    const WORDS: &'static [&'static str] = &["rigid"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = &given.groups[0];
        if let Some(k) = (1..points.len()).find(|&k| points[..k].contains(&points[k])) {
            return Err(Refusal {
                message: "a rigid body holds each point once",
                at: Culprit::Point(0, k),
                label: "named twice",
                help: None,
            });
        }
        Ok(Self::new(points, given.x))
    }
}

impl ConstraintKind for Rigid {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        (2 * self.points.len()).saturating_sub(3)
    }

    fn residual(&self, x: &[Point]) -> f64 {
        let Some([a, b]) = self.base() else { return 0.0 };
        let [xa, xb] = [a, b].map(|p| x[p as usize]);
        let stretch = xa.distance(xb) - self.length;
        let bent = self.others().map(|(p, zeta)| hinge_value([x[p as usize], xa, xb], zeta));
        bent.fold(stretch.abs(), |norm, g| Vector::new(norm, g.norm()).norm())
    }

    /// The weighted least squares fit of the shape (Procrustes): among all places of the
    /// body the one with the shortest displacement, about a frozen point if there is one.
    /// Two frozen points leave no choice.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        if self.points.len() < 2 {
            return;
        }
        let weight = |p: PointIdx| w[p as usize];
        let inertia = |p: PointIdx| if weight(p) > 0.0 { 1.0 / weight(p) } else { 0.0 };
        let frozen = |p: PointIdx| if weight(p) > 0.0 { 0.0 } else { 1.0 };
        let origin = x[self.points[0] as usize];
        let n_frozen = self.points.iter().filter(|&&p| weight(p) == 0.0).count();
        let fit = if n_frozen == 0 {
            self.fit(x, origin, inertia)
        } else {
            let mut fit = self.fit(x, origin, frozen);
            if fit.turn.norm() == 0.0 || n_frozen == 1 {
                fit.turn = self.moments(x, origin, &inertia, &fit);
            }
            fit
        };
        // Points that all coincide say nothing of the angle.
        let turn = fit.turn.unit().unwrap_or(Vector::new(1.0, 0.0));
        for (&p, &zeta) in self.points.iter().zip(&self.shape) {
            if weight(p) > 0.0 {
                let place = fit.body + (zeta * self.length - fit.shape).times(turn);
                move_by(p, place - (x[p as usize] - origin));
            }
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let Some([a, b]) = self.base() else { return };
        let [xa, xb] = [a, b].map(|p| x[p as usize]);
        let (e, l) = direction(xa, xb);
        let mut along = Row::new(l - self.length).with(a, -e).with(b, e);
        along.span = l;
        row(along);
        for (p, zeta) in self.others() {
            let g = hinge_value([x[p as usize], xa, xb], zeta);
            hinge_linear([p, a, b], zeta).rows(g, row);
        }
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let Some([a, b]) = self.base() else { return };
        let (xa, v) = (x(a), x(b) - x(a));
        equation(v.norm() - T::constant(self.length));
        for (p, zeta) in self.others() {
            let g = (x(p) - xa) - v.times(Vec2::constant(zeta));
            equation(g.x);
            equation(g.y);
        }
    }

    fn get(&self, _field: Field) -> Option<f64> {
        None
    }

    fn set(&mut self, _field: Field, _value: f64) -> bool {
        false
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "rigid",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            // A body with two known points says where its others are.
            n_firm_rows: if self.points.len() > 2 { 2 } else { 1 },
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, shape, ends, length } = self;
        ends.iter().for_each(|&end| word(end as u64));
        add_all([*length], word);
        shape.iter().for_each(|&Vector { x, y }| add_all([x, y], word));
    }
}

impl Stateful for Rigid {
    fn state(&self) -> Option<Vec<f64>> {
        None
    }

    fn set_state(&mut self, _state: &[f64]) {}

    /// Which points are A and B, their distance, and the zeta of each point.
    fn captured(&self) -> Vec<f64> {
        let ends = self.ends.map(|i| i as f64);
        let shape = self.shape.iter().flat_map(|zeta| [zeta.x, zeta.y]);
        ends.into_iter().chain([self.length]).chain(shape).collect()
    }

    fn set_captured(&mut self, captured: &[f64]) {
        let n = self.points.len();
        if let [i, j, length, shape @ ..] = captured
            && shape.len() == 2 * n
            && [i, j].iter().all(|&&end| end >= 0.0 && (end as usize) < n)
        {
            self.ends = [*i as usize, *j as usize];
            self.length = *length;
            self.shape = shape.chunks_exact(2).map(|z| Vector::new(z[0], z[1])).collect();
        }
    }

    fn pick_up(&mut self, _x: &[Point]) {}

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, _x: &[Point]) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [Point; 4] =
        [Point::new(0.0, 0.0), Point::new(3.0, 0.1), Point::new(1.0, 2.0), Point::new(2.0, -1.0)];

    fn corrected(body: &Rigid, mut x: [Point; 4], w: [f64; 4]) -> [Point; 4] {
        let before = x;
        body.correct(&before, &w, &mut |p, v| x[p as usize] += v);
        x
    }

    #[test]
    fn frozen_points_lead_the_body() {
        let body = Rigid::new(&[0, 1, 2, 3], &X);
        let moved = X.map(|p| Point::new(7.0, -2.0) + p.to_vector().rotate(2.0));
        // One, two, all but one frozen in the new place; the others left behind.
        for n_frozen in 1..4 {
            let mut x = X;
            let mut w = [1.0, 0.1, 10.0, 3.0];
            x[..n_frozen].copy_from_slice(&moved[..n_frozen]);
            w[..n_frozen].fill(0.0);
            let x = corrected(&body, x, w);
            assert!(body.residual(&x) < 1e-14, "{n_frozen} frozen");
            assert_eq!(x[..n_frozen], moved[..n_frozen]);
        }
    }

    #[test]
    fn a_mirrored_body_turns_back() {
        let body = Rigid::new(&[0, 1, 2, 3], &X);
        let x = corrected(&body, X.map(|p| Point::new(p.x, -p.y)), [1.0; 4]);
        assert!(body.residual(&x) < 1e-14);
        assert!((x[1] - x[0]).cross(x[2] - x[0]) > 0.0);
    }

    #[test]
    fn no_other_place_of_the_body_is_nearer() {
        let body = Rigid::new(&[0, 1, 2, 3], &X);
        let start =
            [(0.5, 0.0), (3.0, 1.0), (1.0, 2.5), (1.0, -1.0)].map(|(x, y)| Point::new(x, y));
        let w = [0.1, 1.0, 2.0, 30.0];
        let cost = |x: [Point; 4]| -> f64 {
            (0..4).map(|i| (x[i] - start[i]).norm_squared() / w[i]).sum()
        };
        let best = corrected(&body, start, w);
        for (shift, turn) in [(0.01, 0.0), (-0.01, 0.0), (0.0, 0.01), (0.0, -0.01)] {
            let other = best.map(|p| {
                p + (p.to_vector().rotate(turn) - p.to_vector()) + Vector::new(shift, shift)
            });
            assert!(cost(other) > cost(best));
        }
    }

    #[test]
    fn points_in_line_and_points_in_one_place_are_bodies_too() {
        let line: [Point; 4] =
            std::array::from_fn(|i| Point::new(i as f64, 1e-13 * (i % 2) as f64));
        let body = Rigid::new(&[0, 1, 2, 3], &line);
        assert!(body.residual(&corrected(&body, X, [1.0; 4])) < 1e-14);
        let spot = Rigid::new(&[0, 1, 2, 3], &[Point::new(1.0, 1.0); 4]);
        assert!(spot.residual(&corrected(&spot, X, [1.0; 4])) < 1e-14);
        assert_eq!(Rigid::new(&[0, 0, 2, 0], &X).points(), [0, 2]);
        assert_eq!(Rigid::new(&[0, 0], &X).n_rows(), 0);
    }
}
