//! A motor: a disc with an arrow and the crank it drives.

use super::Draw;
use super::bar::{Span, arrow_head, outlined};
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::figure::{Figure, Layer, Path, Placement};
use crate::render::ink::Ink;
use crate::render::style::{Class, MOTOR};
use crate::render::page::Extent;

/// Which way a motor turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// The mathematical sense.
    CounterClockwise,
    /// The other one.
    Clockwise,
    /// It stands.
    Still,
}

impl Sense {
    /// That of an angular speed.
    pub fn of(speed: f64) -> Self {
        if speed > 0.0 {
            Self::CounterClockwise
        } else if speed < 0.0 {
            Self::Clockwise
        } else {
            Self::Still
        }
    }
}

/// A motor and its crank.
#[derive(Debug, Clone, PartialEq)]
pub struct Crank {
    /// The centre and the point driven around it.
    pub points: [PointIdx; 2],
    /// Which way it turns.
    pub sense: Sense,
    /// Whether another motor's disc is there already.
    pub is_bare: bool,
}

impl Draw for Crank {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn extend(&self, at: &[Point], extent: &mut Extent) {
        let [o, p] = self.points.map(|p| at[p as usize]);
        extent.include_circle(o, o.distance(p));
    }

    fn draw(&self, ink: &mut Ink) {
        let [o, p] = self.points;
        let span = Span::between(ink, o, p);
        let radius = ink.size(MOTOR);
        let centre = Placement::at(ink.px(o));
        ink.figure(Layer::Construction, centre).circle(Class::Orbit, Point::ORIGIN, span.length);
        outlined(ink, &span, [Class::CrankEdge, Class::Crank]);
        if !self.is_bare {
            let disc = ink.figure(Layer::Drive, centre).circle(Class::Motor, Point::ORIGIN, radius);
            arrow(disc, self.sense, 0.58 * radius);
        }
    }
}

/// An arrow around the origin, open on one side.
fn arrow(figure: &mut Figure, sense: Sense, radius: f64) {
    // From the lower right over the top to the lower left, or mirrored, in page angles.
    const FROM: f64 = 0.25;
    const TO: f64 = -3.9;
    let (from, to) = match sense {
        Sense::CounterClockwise => (FROM, TO),
        Sense::Clockwise => (std::f64::consts::PI - FROM, std::f64::consts::PI - TO),
        Sense::Still => return,
    };
    let forward = if to < from { -1.0 } else { 1.0 };
    // The head begins where the line ends and is as long as it is drawn.
    let length = 0.95 * radius;
    let end = to - forward * 0.35;
    figure.path(Class::Turn, Path::arc(radius, from, end));
    let direction = Vector::polar(1.0, end + forward * 0.35).perp() * forward;
    let tip = Vector::polar(radius, end).to_point() + direction * (0.8 * length);
    figure.path(Class::TurnHead, arrow_head(tip, direction, length));
}
