//! The glider constraint, section 3.8: a point on a line, between end stops.

use super::hinge;
use crate::constraint::parts::line::Foot;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Flag, Given, Point, PointIdx, Quantity,
    Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The first point lies on the segment between the second and the third, or on their line.
///
/// A foot strictly beyond an end makes it a hinge on that end. A foot exactly on the end
/// leaves the point free to slide inward, as any inequality that is met asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Glider {
    /// The point, then the two that span the line.
    pub points: [PointIdx; 3],
    /// Whether the segment's ends stop it.
    pub bounded: bool,
}

/// What the constraint asks for at a pose.
enum Demand {
    /// To come onto the line.
    Line(Foot),
    /// To come to the place that divides the segment so.
    Place(f64),
}

impl Glider {
    fn demand(&self, x: [Point; 3]) -> Demand {
        match Foot::new(x) {
            // Without a line, the middle: symmetric, and met where all three coincide.
            None => Demand::Place(0.5),
            Some(foot) if self.bounded && foot.mu < 0.0 => Demand::Place(0.0),
            Some(foot) if self.bounded && foot.mu > 1.0 => Demand::Place(1.0),
            Some(foot) => Demand::Line(foot),
        }
    }

    /// The value and its derivative by the sliding point alone; none where that takes the general
    /// way.
    #[inline]
    pub fn felt_by(&self, p: PointIdx, x: &[Point]) -> Option<(f64, Vector)> {
        let [slider, a, b] = self.points;
        match self.demand(self.places(x)) {
            Demand::Line(foot) if p == slider && p != a && p != b => {
                Some((foot.height, foot.normal))
            }
            _ => None,
        }
    }

    fn places(&self, x: &[Point]) -> [Point; 3] {
        self.points.map(|p| x[p as usize])
    }
}

impl Declared for Glider {
    const WORDS: &'static [&'static str] = &["glider"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        Ok(Self { points: given.point_and_pair()?, bounded: !given.has(Flag::Unbounded) })
    }
}

impl Stateless for Glider {}

impl ConstraintKind for Glider {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        2
    }

    fn residual(&self, x: &[Point]) -> f64 {
        let places = self.places(x);
        match self.demand(places) {
            Demand::Line(foot) => foot.height,
            Demand::Place(mu) => hinge::value(places, mu).norm(),
        }
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let places = self.places(x);
        match self.demand(places) {
            // Both are the paper's shares of t, with d2 and d3 the right way round: along
            // the normal here, which leaves mu as it is.
            Demand::Line(foot) => foot.row(foot.height, self.points).correct(w, move_by),
            Demand::Place(mu) => {
                hinge::linear(self.points, mu).correct(hinge::value(places, mu), w, move_by);
            }
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let places = self.places(x);
        match self.demand(places) {
            Demand::Line(foot) => {
                row(foot.row(foot.height, self.points));
                row(Row::inactive(&self.points));
            }
            Demand::Place(mu) => {
                hinge::linear(self.points, mu).rows(hinge::value(places, mu), row);
            }
        }
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3] = self.points.map(x);
        match self.demand([x1, x2, x3].map(|p| p.value().to_point())) {
            Demand::Line(_) => {
                let v = x3 - x2;
                equation(v.cross(x1 - x2) / v.norm());
                equation(T::constant(0.0));
            }
            Demand::Place(mu) => {
                let g = (x1 - x2) - (x3 - x2).scale(T::constant(mu));
                equation(g.x);
                equation(g.y);
            }
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
            word: "glider",
            quantity: Quantity::Length,
            bounds: None,
            activity: if self.bounded { Activity::AtStops } else { Activity::Always },
            n_firm_rows: 1,
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: if self.bounded { &[] } else { &[Flag::Unbounded] },
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, bounded } = self;
        word(u64::from(*bounded));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn active(at: f64, bounded: bool) -> usize {
        let x = [Point::new(at, 0.5), Point::ORIGIN, Point::new(2.0, 0.0)];
        let mut n_active = 0;
        Glider { points: [0, 1, 2], bounded }
            .jacobian(&x, &mut |row| n_active += usize::from(row.is_active));
        n_active
    }

    #[test]
    fn an_end_stop_acts_beyond_the_end_only() {
        let counts = [-0.1, 0.0, 1.0, 2.0, 2.1].map(|at| active(at, true));
        assert_eq!(counts, [2, 1, 1, 1, 2]);
        let counts = [-0.1, 0.0, 1.0, 2.0, 2.1].map(|at| active(at, false));
        assert_eq!(counts, [1; 5]);
    }

    #[test]
    fn the_law_of_the_lever_holds() {
        let x = [Point::new(0.5, 1.0), Point::ORIGIN, Point::new(2.0, 0.0)];
        let mut d = [Vector::ZERO; 3];
        let glider = Glider { points: [0, 1, 2], bounded: true };
        glider.correct(&x, &[1.0; 3], &mut |p, v| d[p as usize] += v);
        let mu = 0.25;
        assert!((d[1] * mu - d[2] * (1.0 - mu)).norm() < 1e-15);
    }
}
