//! A point: a small circle, on a triangle if it is frozen.

use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::{BASE_LINE, Class, JOINT, MOTOR, letter};
use std::sync::Arc;

/// What a point stands on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    /// Nothing: it is free.
    Free,
    /// The ground: it is frozen.
    Frozen,
    /// The ground, with a motor on it.
    FrozenMotor,
}

/// A point.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Which one.
    pub point: PointIdx,
    /// What it is called.
    pub name: Arc<str>,
    /// What it stands on.
    pub support: Support,
    /// Whether it sits within the disc of a motor.
    pub is_driven: bool,
}

impl Draw for Joint {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.point]
    }

    fn draw(&self, canvas: &mut Canvas) {
        let at = Placement::at(canvas.px(self.point));
        match self.support {
            Support::Free => {}
            Support::Frozen => ground(canvas, at, 16.0),
            // The triangle has to look out from under the disc.
            Support::FrozenMotor => ground(canvas, at, 2.5 * MOTOR),
        }
        let radius = canvas.size(if self.is_driven { 0.7 * JOINT } else { JOINT });
        let offset = canvas.lettering.get(&self.point).copied();
        let to_base_line = Vector::new(0.0, BASE_LINE * letter(canvas.page.mark()));
        let joint = canvas.figure(Layer::Joint, at).circle(Class::Joint, Point::ORIGIN, radius);
        if let Some(offset) = offset {
            joint.text(Class::Name, (offset + to_base_line).to_point(), self.name.clone());
        }
    }
}

/// The paper's sign of a frozen point, standing on hatched ground.
fn ground(canvas: &mut Canvas, at: Placement, height: f64) {
    let height = canvas.size(height);
    let half = 0.62 * height;
    let hatch = canvas.size(5.0);
    let figure = canvas.figure(Layer::Ground, at);
    let base = [Point::new(half, height), Point::new(-half, height)];
    figure.path(Class::Ground, Path::polygon([Point::ORIGIN, base[0], base[1]]));
    let mut strokes = Path::segment(
        Point::new(-half - 0.6 * hatch, height),
        Point::new(half + 0.6 * hatch, height),
    );
    for k in 0..4 {
        let x = -half + (2.0 * half + 0.5 * hatch) * (f64::from(k) + 0.5) / 4.0;
        strokes.move_to(Point::new(x, height)).line_to(Point::new(x - hatch, height + hatch));
    }
    figure.path(Class::Hatch, strokes);
}
