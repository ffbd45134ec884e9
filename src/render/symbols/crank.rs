//! A motor: a disc with an arrow and the crank it drives.

use super::bar::{Segment, arrow_head, outlined};
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Figure, Layer, Placement};
use crate::render::page::BoundingBox;
use crate::render::path::Path;
use crate::render::style::{Class, MOTOR};
use std::f64::consts::FRAC_PI_2;

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
    /// How many motors on this centre come before it; their arrows lie within its own.
    pub rank: u8,
}

impl Draw for Crank {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
        let [o, p] = self.points.map(|p| at[p as usize]);
        bounds.include_circle(o, o.distance(p));
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [o, p] = self.points;
        let segment = Segment::between(canvas, o, p);
        let radius = canvas.size(MOTOR);
        let centre = Placement::at(canvas.px(o));
        canvas.figure(Layer::Construction, centre).circle(
            Class::Orbit,
            Point::ORIGIN,
            segment.length,
        );
        outlined(canvas, &segment, [Class::CrankEdge, Class::Crank]);
        let symbol = canvas.figure(Layer::Drive, centre);
        if self.rank == 0 {
            symbol.circle(Class::Motor, Point::ORIGIN, radius);
        }
        arrow(symbol, self.sense, [1.8 * radius, 0.9 * radius], self.rank);
    }
}

/// An arrow over the top of the origin: the radius of the first, and by how much that of each
/// next is greater.
fn arrow(figure: &mut Figure, sense: Sense, [first, step]: [f64; 2], rank: u8) {
    /// From the vertical to either end, radians.
    const HALF: f64 = 1.1;
    let forward = match sense {
        Sense::CounterClockwise => -1.0,
        Sense::Clockwise => 1.0,
        Sense::Still => return,
    };
    let radius = first + step * f64::from(rank);
    // As long as the first: it ends nearer to the top.
    let half = HALF * first / radius;
    // Page angles grow clockwise from the right: straight up is a quarter turn back.
    let (from, tip) = (-FRAC_PI_2 - forward * half, -FRAC_PI_2 + forward * half);
    let head = 0.5 * first;
    // The line ends within the head, which lies along a chord of the arc.
    figure.path(Class::Turn, Path::arc(radius, from, tip - forward * 0.6 * head / radius));
    let direction = Vector::polar(1.0, tip - forward * 0.5 * head / radius).perp() * forward;
    let tip = Vector::polar(radius, tip).to_point();
    figure.path(Class::TurnHead, arrow_head(tip, direction, head));
}
