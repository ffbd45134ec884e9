//! Two points level with one another, or one above the other: a coordinate of section 3.1 that
//! two points share, wherever it is.

use crate::constraint::parts::content::add_all;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// Two points have one y (horizontal), or one x (vertical).
#[derive(Debug, Clone, PartialEq)]
pub struct Aligned {
    /// The points.
    pub points: [PointIdx; 2],
    /// Which way the line through them goes.
    pub direction: AxisDirection,
}

/// The way that a line parallel to an axis goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisDirection {
    /// As the x axis.
    Horizontal,
    /// As the y axis.
    Vertical,
}

impl AxisDirection {
    /// The unit vector across.
    const fn normal(self) -> Vector {
        match self {
            Self::Horizontal => Vector::new(0.0, 1.0),
            Self::Vertical => Vector::new(1.0, 0.0),
        }
    }

    /// The coordinate that all its points share.
    fn coordinate<T: Real>(self, v: Vec2<T>) -> T {
        match self {
            Self::Horizontal => v.y,
            Self::Vertical => v.x,
        }
    }
}

impl Aligned {
    fn row(&self, x: &[Point]) -> Row<'static> {
        let [a, b] = self.points;
        let normal = self.direction.normal();
        Row::new(self.residual(x)).with(a, -normal).with(b, normal)
    }
}

impl Declared for Aligned {
    const WORDS: &'static [&'static str] = &["horizontal", "vertical"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let is_horizontal = given.word == "horizontal";
        let direction =
            if is_horizontal { AxisDirection::Horizontal } else { AxisDirection::Vertical };
        Ok(Self { points: given.pair(0)?, direction })
    }
}

impl Stateless for Aligned {}

impl ConstraintKind for Aligned {
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
        let [x1, x2] = self.points.map(|p| x[p as usize]);
        (x2 - x1).dot(self.direction.normal())
    }

    /// Linear, so exact in one step.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        self.row(x).correct(w, move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        row(self.row(x));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2] = self.points.map(x);
        equation(self.direction.coordinate(x2 - x1));
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
            word: match self.direction {
                AxisDirection::Horizontal => "horizontal",
                AxisDirection::Vertical => "vertical",
            },
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 1,
            is_linear: true,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, direction } = self;
        let Vector { x, y } = direction.normal();
        add_all([x, y], word);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lighter_moves_more_and_only_across() {
        let x = [Point::new(1.0, 2.0), Point::new(7.0, 5.0)];
        for (direction, moved) in [
            (AxisDirection::Horizontal, [Vector::new(0.0, 1.0), Vector::new(0.0, -2.0)]),
            (AxisDirection::Vertical, [Vector::new(2.0, 0.0), Vector::new(-4.0, 0.0)]),
        ] {
            let c = Aligned { points: [0, 1], direction };
            let mut d = [Vector::ZERO; 2];
            c.correct(&x, &[1.0, 2.0], &mut |p, v| d[p as usize] += v);
            assert_eq!(d, moved);
            let y: Vec<Point> = x.iter().zip(d).map(|(&p, d)| p + d).collect();
            assert_eq!(c.residual(&y), 0.0);
        }
    }
}
