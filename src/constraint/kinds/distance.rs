//! The distance of a point to a line: the glider of section 3.8 at an offset.

use crate::constraint::parts::line::Foot;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The signed distance of the first point to the line from the second to the third lies in
/// `bounds`.
///
/// While the second and third coincide the constraint asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Distance {
    /// The point, then the two that span the line.
    pub points: [PointIdx; 3],
    /// The allowed distances, length units, positive on the left.
    pub bounds: Bounds,
}

impl Distance {
    fn foot(&self, x: &[Point]) -> Option<Foot> {
        Foot::new(self.points.map(|p| x[p as usize]))
    }
}

impl Declared for Distance {
    const WORDS: &'static [&'static str] = &["distance"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.point_and_pair()?;
        let [p, a, b] = points.map(|p| given.at(p));
        let now = (b - a).unit().map_or(0.0, |e| e.cross(p - a));
        Ok(Self { points, bounds: given.bounds.unwrap_or(Bounds::exactly(now)) })
    }
}

impl Stateless for Distance {}

impl ConstraintKind for Distance {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        1
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.foot(x).map_or(0.0, |foot| self.bounds.excess(foot.height))
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let Some(foot) = self.foot(x) else { return };
        let f = self.bounds.excess(foot.height);
        let [p, a, b] = self.points;
        if f == 0.0 || p == a || p == b {
            return;
        }
        let [w1, w2, w3] = self.points.map(|p| w[p as usize]);
        let (c2, c3) = (foot.mu - 1.0, -foot.mu);
        let sum = w1 + w2 * c2 * c2 + w3 * c3 * c3;
        if sum == 0.0 {
            return;
        }
        // All three move along the normal by s w_i c_i. A and B do so by different amounts,
        // which tilts the line: s solves l (h + s sum) = t sqrt(l^2 + (s tilt)^2).
        let (l, h, t) = (foot.length, foot.height, foot.height - f);
        let tilt = (w3 * c3 - w2 * c2) / l;
        let linear = (t - h) / sum;
        let s = quadratic_step(h, t, sum, tilt)
            .filter(|s| s.abs() <= 4.0 * linear.abs())
            // Far off, no line along this path is right: come nearer first.
            .unwrap_or(linear);
        for (p, c, w) in [(p, 1.0, w1), (a, c2, w2), (b, c3, w3)] {
            if w > 0.0 {
                move_by(p, foot.normal * (s * w * c));
            }
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let Some(foot) = self.foot(x) else { return row(Row::inactive(&self.points)) };
        let f = self.bounds.excess(foot.height);
        if f == 0.0 && !self.bounds.is_equality() {
            return row(Row::inactive(&self.points));
        }
        row(foot.row(f, self.points));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3] = self.points.map(x);
        if Foot::new([x1, x2, x3].map(|p| p.value().to_point())).is_none() {
            return equation(T::constant(0.0));
        }
        let v = x3 - x2;
        equation(self.bounds.excess_of(v.cross(x1 - x2) / v.norm(), field));
    }

    fn get(&self, field: Field) -> Option<f64> {
        self.bounds.get(field)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        self.bounds.set(field, value)
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "distance",
            quantity: Quantity::Length,
            bounds: Some(self.bounds),
            activity: Activity::within(self.bounds),
            n_firm_rows: usize::from(self.bounds.is_equality()),
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: Flaw::of_range(self.bounds),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, bounds } = self;
        bounds.content(word);
    }
}

/// The solution s of `h + s sum = t sqrt(1 + (s tilt)^2)`, if there is one.
fn quadratic_step(h: f64, t: f64, sum: f64, tilt: f64) -> Option<f64> {
    let radicand = sum * sum + tilt * tilt * (h * h - t * t);
    if radicand < 0.0 {
        return None;
    }
    let root = t * radicand.sqrt();
    // Of the two forms of one quotient, that which does not cancel.
    let (above, below) = if h * t > 0.0 {
        (t * t - h * h, h * sum + root)
    } else {
        (root - h * sum, sum * sum - (t * tilt) * (t * tilt))
    };
    // Below 0 in the second form, squaring has swapped the side of the line.
    (below > 0.0 || h * t > 0.0).then(|| above / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_step_is_exact_though_the_line_tilts() {
        let x = [Point::new(1.0, 0.7), Point::ORIGIN, Point::new(4.0, 0.5)];
        for w in [[1.0, 1.0, 1.0], [0.0, 1.0, 2.0], [0.1, 1.0, 0.0], [1.0, 0.0, 0.0]] {
            for target in [-0.9, -0.3, 0.0, 0.2, 0.75, 0.9] {
                let c = Distance { points: [0, 1, 2], bounds: Bounds::exactly(target) };
                let mut y = x;
                c.correct(&x, &w, &mut |p, v| y[p as usize] += v);
                assert!(c.residual(&y).abs() < 1e-15, "{target} with {w:?}: {}", c.residual(&y));
            }
        }
    }

    #[test]
    fn what_no_step_reaches_is_approached() {
        // The line turns about B only, and 3 is more than the distance from P to B.
        let x = [Point::new(2.0, 0.5), Point::ORIGIN, Point::new(4.0, 0.0)];
        let c = Distance { points: [0, 1, 2], bounds: Bounds::exactly(3.0) };
        let mut y = x;
        c.correct(&x, &[0.0, 1.0, 0.0], &mut |p, v| y[p as usize] += v);
        assert!(c.residual(&y).abs() < c.residual(&x).abs());
    }
}
