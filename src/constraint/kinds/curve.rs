//! Circles and arcs: what others slide on or touch.

use crate::constraint::parts::content::add_all;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Culprit, Declared, Equal, Field, Flaw, Given, Point,
    PointIdx, Quantity, Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// A circle, or a part of one. Only an arc asks for something: that its ends are as far from the
/// centre.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A circle with a radius of its own.
    Circle {
        /// The centre.
        points: [PointIdx; 1],
        /// The radius, length units.
        radius: f64,
    },
    /// A circle through a point.
    Through {
        /// The centre and the point.
        points: [PointIdx; 2],
    },
    /// The part of a circle from one point counter-clockwise to another.
    Arc {
        /// The centre, the start and the end.
        points: [PointIdx; 3],
    },
}

impl Curve {
    /// The ends of an arc.
    fn spokes(&self) -> Option<Equal> {
        match *self {
            Self::Arc { points: [o, p, q] } => {
                Some(Equal { points: [o, p, o, q], bounds: Bounds::exactly(0.0), ratio: 1.0 })
            }
            _ => None,
        }
    }

    /// The radius at a pose, length units: that of an arc is the one of its start.
    pub fn radius_at(&self, x: &[Point]) -> f64 {
        match *self {
            Self::Circle { radius, .. } => radius,
            Self::Through { points: [o, p] } | Self::Arc { points: [o, p, _] } => {
                x[o as usize].distance(x[p as usize])
            }
        }
    }
}

impl Declared for Curve {
    const WORDS: &'static [&'static str] = &["circle", "arc"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let o = given.point(0);
        let rim = |group: usize| given.groups.get(group).map(|points| points[0]);
        let apart = |p: PointIdx, group: usize| {
            let is_one = p == o || !given.is_restored && given.at(p) == given.at(o);
            let refusal = Refusal {
                message: "a circle needs a size",
                at: Culprit::Group(group),
                label: "this is its centre",
                help: Some(match rim(2) {
                    Some(_) => "name a point that is apart from the centre",
                    None => "name a point that is apart from the centre, or say `radius 1`",
                }),
            };
            if is_one { Err(refusal) } else { Ok(()) }
        };
        match (rim(1), rim(2)) {
            (Some(p), Some(q)) => {
                apart(p, 1)?;
                apart(q, 2)?;
                if p == q || !given.is_restored && given.at(p) == given.at(q) {
                    return Err(Refusal {
                        message: "the ends of an arc coincide",
                        at: Culprit::Group(2),
                        label: "here it begins, too",
                        help: Some("a whole circle is `circle c = O through P`"),
                    });
                }
                Ok(Self::Arc { points: [o, p, q] })
            }
            // A radius that is said takes the place of a point.
            (Some(p), None) if given.value(Field::Radius).is_none() => {
                apart(p, 1)?;
                Ok(Self::Through { points: [o, p] })
            }
            _ => {
                let radius = given.value(Field::Radius).unwrap_or_default();
                Ok(Self::Circle { points: [o], radius })
            }
        }
    }
}

impl Stateless for Curve {}

impl ConstraintKind for Curve {
    fn points(&self) -> &[PointIdx] {
        match self {
            Self::Circle { points, .. } => points,
            Self::Through { points } => points,
            Self::Arc { points } => points,
        }
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        match self {
            Self::Circle { points, .. } => points,
            Self::Through { points } => points,
            Self::Arc { points } => points,
        }
    }

    fn n_rows(&self) -> usize {
        usize::from(self.spokes().is_some())
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.spokes().map_or(0.0, |spokes| spokes.residual(x))
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        if let Some(spokes) = self.spokes() {
            spokes.correct(x, w, move_by);
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        if let Some(spokes) = self.spokes() {
            spokes.jacobian(x, row);
        }
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        if let Some(spokes) = self.spokes() {
            spokes.equations(
                x,
                &|of, value| match of {
                    // Nothing drives the difference of two spokes.
                    Field::Lo | Field::Hi => T::constant(value),
                    _ => field(of, value),
                },
                equation,
            );
        }
    }

    fn get(&self, field: Field) -> Option<f64> {
        match (self, field) {
            (Self::Circle { radius, .. }, Field::Radius) => Some(*radius),
            _ => None,
        }
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        match (self, field) {
            (Self::Circle { radius, .. }, Field::Radius) => {
                *radius = value;
                true
            }
            _ => false,
        }
    }

    fn nominal_length(&self) -> f64 {
        // It asks nothing of its centre; where something touches it, the pose is as large as it is.
        0.0
    }

    fn traits(&self) -> Traits {
        let has_size = self.get(Field::Radius).is_none_or(|radius| radius > 0.0);
        Traits {
            word: if self.spokes().is_some() { "arc" } else { "circle" },
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: self.n_rows(),
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: (!has_size).then_some(Flaw::NoRadius),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        match self {
            Self::Circle { points: _, radius } => add_all([*radius], word),
            Self::Through { points: _ } => word(1),
            Self::Arc { points: _ } => word(2),
        }
    }
}
