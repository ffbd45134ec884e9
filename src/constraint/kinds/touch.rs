//! Points that slide on circles and arcs, and lines, circles and arcs that touch.

use std::f64::consts::FRAC_PI_2;

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::geometry::wrap;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Flag, Given, Point, PointIdx, Quantity,
    Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};

/// What holds between a point or a line and a circle, or between two circles.
///
/// What is compared is measured on the pose, see [`Measured`](super::Measured): by itself it knows
/// the points that its statement names and nothing of where they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Touch {
    /// The points of its statement, in that order.
    points: Vec<PointIdx>,
    /// The circles and arcs of its statement, by their handles.
    curves: Vec<u32>,
    sort: Sort,
    /// What is measured, length units or radians.
    value: f64,
    /// What it is compared with: a radius, or what two of them come to.
    wanted: f64,
    /// How far beyond the nearer end stop, length units; not positive between both.
    beyond: f64,
}

/// The sorts of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sort {
    /// A point on a circle: its distance from the centre is the radius.
    Glider {
        /// Where it is stopped.
        stops: Stops,
    },
    /// A line, or another circle outside of it, at the distance of the radius, or of both.
    Tangent {
        /// On which side of the line the centre is, 1 or -1.
        side: f64,
    },
    /// One circle in the other, the distance of the centres being the difference of the radii.
    Inside {
        /// Whether the first is the larger one, 1, or the second, -1.
        side: f64,
    },
    /// A common direction at a common point: the angle between a line and a radius, or between two
    /// radii, is that many quarter turns.
    At {
        /// The quarter turns.
        quarters: f64,
    },
}

/// Where a point on a circle is stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stops {
    /// Nowhere: a circle has no ends.
    Nowhere,
    /// At the ends of an arc.
    Ends,
    /// Nowhere, though it is on an arc: its statement says so.
    Unbounded,
}

impl Touch {
    /// Which sort it is.
    pub const fn sort(&self) -> Sort {
        self.sort
    }

    /// The circles and arcs of its statement, by their handles.
    pub fn curves(&self) -> &[u32] {
        &self.curves
    }

    /// Whether a point slides on a circle or an arc.
    pub const fn is_glider(&self) -> bool {
        matches!(self.sort, Sort::Glider { .. })
    }

    /// The line that touches, if one does.
    pub fn line(&self) -> Option<[PointIdx; 2]> {
        match self.points[..] {
            [a, b, ..] if self.curves.len() == 1 && !self.is_glider() => Some([a, b]),
            _ => None,
        }
    }

    /// The point at which a common direction is asked for.
    pub fn at(&self) -> Option<PointIdx> {
        if matches!(self.sort, Sort::At { .. }) { self.points.last().copied() } else { None }
    }

    fn is_bounded(&self) -> bool {
        self.sort == Sort::Glider { stops: Stops::Ends }
    }

    /// By how much what is measured is off.
    fn value_over<T: Real>(&self, value: T, wanted: T) -> T {
        match self.sort {
            Sort::Glider { .. } => value - wanted,
            Sort::Tangent { side } => T::constant(side) * value - wanted,
            Sort::Inside { side } => value - T::constant(side) * wanted,
            Sort::At { quarters } => {
                let f = value - T::constant(quarters * FRAC_PI_2);
                f + T::constant(wrap(f.value()) - f.value())
            }
        }
    }
}

impl Declared for Touch {
    const WORDS: &'static [&'static str] = &["tangent"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let value = given.value(Field::Value).unwrap_or_default();
        let wanted = given.value(Field::Wanted);
        let beyond = given.value(Field::Beyond);
        let sign = |v: f64| if v < 0.0 { -1.0 } else { 1.0 };
        let sort = if given.word == "glider" {
            let stops = if beyond.is_some() { Stops::Ends } else { Stops::Nowhere };
            let is_unbounded = given.has(Flag::Unbounded);
            Sort::Glider { stops: if is_unbounded { Stops::Unbounded } else { stops } }
        } else if let Some(wanted) = wanted {
            if given.has(Flag::Inside) {
                Sort::Inside { side: sign(wanted) }
            } else {
                Sort::Tangent { side: sign(value) }
            }
        } else if given.curves.len() == 1 {
            // A line is at right angles to a radius, two radii are in line.
            Sort::At { quarters: sign(value) }
        } else {
            Sort::At { quarters: if value.abs() > FRAC_PI_2 { 2.0 } else { 0.0 } }
        };
        Ok(Self {
            points: given.groups.concat(),
            curves: given.curves.to_vec(),
            sort,
            value,
            wanted: wanted.unwrap_or_default(),
            beyond: beyond.unwrap_or_default(),
        })
    }
}

impl ConstraintKind for Touch {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        1 + usize::from(self.is_bounded())
    }

    fn residual(&self, _x: &[Point]) -> f64 {
        let f = self.value_over(self.value, self.wanted);
        if self.is_bounded() && self.beyond > 0.0 {
            return Vector::new(f, self.beyond).norm();
        }
        f
    }

    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}

    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) {
        row(Row::new(self.value_over(self.value, self.wanted)));
        if self.is_bounded() {
            row(Row { is_active: self.beyond > 0.0, ..Row::new(self.beyond.max(0.0)) });
        }
    }

    fn equations<T: Real>(
        &self,
        _x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let (value, wanted) = (field(Field::Value, self.value), field(Field::Wanted, self.wanted));
        equation(self.value_over(value, wanted));
        if self.is_bounded() {
            let is_beyond = self.beyond > 0.0;
            equation(if is_beyond { field(Field::Beyond, self.beyond) } else { T::constant(0.0) });
        }
    }

    fn get(&self, field: Field) -> Option<f64> {
        match field {
            Field::Value => Some(self.value),
            Field::Wanted => Some(self.wanted),
            Field::Beyond => Some(self.beyond),
            _ => None,
        }
    }

    fn set(&mut self, field: Field, to: f64) -> bool {
        match field {
            Field::Value => self.value = to,
            Field::Wanted => self.wanted = to,
            Field::Beyond => self.beyond = to,
            _ => return false,
        }
        true
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: if matches!(self.sort, Sort::Glider { .. }) { "glider" } else { "tangent" },
            quantity: match self.sort {
                Sort::At { .. } => Quantity::Angle,
                _ => Quantity::Length,
            },
            bounds: None,
            activity: if self.is_bounded() { Activity::AtStops } else { Activity::Always },
            n_firm_rows: 0,
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: match self.sort {
                Sort::Inside { .. } => &[Flag::Inside],
                Sort::Glider { stops: Stops::Unbounded } => &[Flag::Unbounded],
                _ => &[],
            },
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        // Which circles it is about shows in what is measured; their handles are other ones where
        // the same scene was made in another way.
        let Self { points: _, curves: _, sort, value, wanted, beyond } = self;
        add_all([*value, *wanted, *beyond], word);
        let (tag, number) = match *sort {
            Sort::Glider { stops } => (0, f64::from(stops as u8)),
            Sort::Tangent { side } => (1, side),
            Sort::Inside { side } => (2, side),
            Sort::At { quarters } => (3, quarters),
        };
        word(tag);
        add_all([number], word);
    }
}

/// The side that it was stated on is all that it keeps.
impl Stateful for Touch {
    fn state(&self) -> Option<Vec<f64>> {
        None
    }

    fn set_state(&mut self, _state: &[f64]) {}

    fn captured(&self) -> Vec<f64> {
        match self.sort {
            Sort::Glider { .. } => Vec::new(),
            Sort::Tangent { side } | Sort::Inside { side } => vec![side],
            Sort::At { quarters } => vec![quarters],
        }
    }

    fn set_captured(&mut self, captured: &[f64]) {
        if let (
            Sort::Tangent { side: kept }
            | Sort::Inside { side: kept }
            | Sort::At { quarters: kept },
            &[given],
        ) = (&mut self.sort, captured)
        {
            *kept = given;
        }
    }

    fn pick_up(&mut self, _x: &[Point]) {}

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, _x: &[Point]) {}
}
