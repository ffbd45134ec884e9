//! The angle between two segments: an arc, or a square if it is a right one.

use super::bar::arrow_head;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;
use std::f64::consts::FRAC_PI_2;

/// Two segments and the angle from the one to the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Angle {
    /// Start and end of the one, start and end of the other.
    pub points: [PointIdx; 4],
}

impl Draw for Angle {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b, c, d] = self.points.map(|p| canvas.px(p));
        let (Some(e), Some(f)) = ((b - a).unit(), (d - c).unit()) else {
            return;
        };
        let turn = e.angle_to(f);
        let vertex = vertex([a, b], [c, d]);
        let (radius, ray) = (canvas.size(25.0), canvas.size(34.0));
        let x_axis = Vector::new(1.0, 0.0);
        let figure = canvas.figure(Layer::Mark, Placement::along(vertex, e));
        let other = x_axis.rotate(turn);
        let mut rays = Path::along_x(0.0, ray);
        rays.move_to(Point::ORIGIN).line_to((other * ray).to_point());
        figure.path(Class::Construction, rays);
        // Within a tenth of a degree of a right angle: what is drawn here is what is asked
        // for, and a frame may be off by its tolerance.
        if (turn.abs() - FRAC_PI_2).abs() < 2e-3 {
            let side = 0.5 * radius;
            let corner = (x_axis + other) * side;
            let square = [x_axis * side, corner, other * side].map(Vector::to_point);
            figure.path(Class::Mark, Path::polyline(square));
        } else {
            figure.path(Class::Mark, Path::arc(radius, 0.0, turn));
            let head = head_length(radius, turn);
            let forward = turn.signum();
            let tip = Vector::polar(radius, turn);
            let direction =
                Vector::polar(1.0, turn - forward * 0.5 * head / radius).perp() * forward;
            figure.path(Class::Arrow, arrow_head(tip.to_point(), direction, head));
        }
    }
}

/// The length of the arrow head on an arc: shorter than the arc.
fn head_length(radius: f64, turn: f64) -> f64 {
    (0.3 * radius).min(0.7 * radius * turn.abs())
}

/// Where the arc goes: where the lines meet if that is on or near both segments, else where
/// the second begins.
fn vertex([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Point {
    const REACH: f64 = 0.25;
    let (u, v) = (b - a, d - c);
    let cross = u.cross(v);
    // Nearly parallel lines meet too far away, if at all.
    if cross.abs() < 1e-6 * u.norm() * v.norm() {
        return c;
    }
    let (s, t) = ((c - a).cross(v) / cross, (c - a).cross(u) / cross);
    let is_near = |k: f64| (-REACH..=1.0 + REACH).contains(&k);
    if is_near(s) && is_near(t) { a + u * s } else { c }
}
