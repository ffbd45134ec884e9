//! Circles and arcs, blocks that slide on them, and where something touches them.

use std::f64::consts::TAU;

use super::draw::Draw;
use crate::constraint::{ConstraintKind as _, Curve, Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::page::BoundingBox;
use crate::render::path::Path;
use crate::render::style::Class;

/// A circle or an arc.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// Its points and its radius.
    pub curve: Curve,
}

/// The direction of a point from another on the page, radians.
fn ray(canvas: &Canvas, from: PointIdx, to: PointIdx) -> f64 {
    (canvas.px(to) - canvas.px(from)).angle()
}

/// Chords of an arc by which its extent is found.
const CHORDS: u32 = 64;

impl Round {
    /// Points along it, close enough together for a pen.
    pub fn chain(&self, at: &[Point]) -> Vec<Point> {
        const N: u32 = 240;
        let (centre, radius) = (at[self.curve.points()[0] as usize], self.curve.radius_at(at));
        let (from, sweep) = match self.curve {
            Curve::Arc { points: [_, p, q] } => {
                let [from, to] = [p, q].map(|p| (at[p as usize] - centre).angle());
                (from, (to - from).rem_euclid(TAU))
            }
            _ => (0.0, TAU),
        };
        let angle = |k: u32| from + sweep * f64::from(k) / f64::from(N);
        (0..=N).map(|k| centre + Vector::polar(radius, angle(k))).collect()
    }
}

impl Draw for Round {
    fn points(&self) -> Vec<PointIdx> {
        self.curve.points().to_vec()
    }

    fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
        let (centre, radius) = (at[self.curve.points()[0] as usize], self.curve.radius_at(at));
        let Curve::Arc { points: [_, p, q] } = self.curve else {
            return bounds.include_circle(centre, radius);
        };
        let [from, to] = [p, q].map(|p| (at[p as usize] - centre).angle());
        let sweep = (to - from).rem_euclid(TAU);
        for k in 0..=CHORDS {
            let angle = from + sweep * f64::from(k) / f64::from(CHORDS);
            bounds.include(centre + Vector::polar(radius, angle));
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        let centre = self.curve.points()[0];
        let radius = canvas.page.length(self.curve.radius_at(canvas.at));
        let mut path = Path::default();
        if let Curve::Arc { points: [o, p, q] } = self.curve {
            // On the page y points down: counter-clockwise is towards smaller angles.
            let (from, to) = (ray(canvas, o, p), ray(canvas, o, q));
            path = Path::arc(radius, from, from - (from - to).rem_euclid(TAU));
        } else {
            path.circle(radius);
        }
        let at = Placement::at(canvas.px(centre));
        canvas.figure(Layer::Rail, at).path(Class::Rail, path);
    }
}

/// A block that slides on a circle.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The point on it.
    pub block: PointIdx,
    /// The centre of the circle.
    pub centre: PointIdx,
}

impl Draw for Block {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.block, self.centre]
    }

    fn draw(&self, canvas: &mut Canvas) {
        let angle = ray(canvas, self.centre, self.block);
        let (half_length, half_width) = (canvas.size(12.0), canvas.size(7.5));
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let corners = corners.map(|(x, y)| Point::new(x * half_length, y * half_width));
        let at = canvas.px(self.block);
        let along = Placement { turn: angle.to_degrees() + 90.0, ..Placement::at(at) };
        canvas.figure(Layer::Slider, along).path(Class::Block, Path::polygon(corners));
    }
}

/// Where a line or a circle touches a circle.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchMark {
    /// The circle.
    pub curve: Curve,
    /// The line, or the centre of the other circle.
    pub other: Toucher,
}

/// What touches a circle.
#[derive(Debug, Clone, PartialEq)]
pub enum Toucher {
    /// A line through two points.
    Line([PointIdx; 2]),
    /// Another circle, by its centre.
    Circle(PointIdx),
    /// Something that has this point in common with it.
    At(PointIdx),
}

impl Draw for TouchMark {
    fn points(&self) -> Vec<PointIdx> {
        let mut points = self.curve.points().to_vec();
        match self.other {
            Toucher::Line(ends) => points.extend(ends),
            Toucher::Circle(p) | Toucher::At(p) => points.push(p),
        }
        points
    }

    fn draw(&self, canvas: &mut Canvas) {
        let centre = canvas.px(self.curve.points()[0]);
        let radius = canvas.page.length(self.curve.radius_at(canvas.at));
        let at = match self.other {
            Toucher::At(p) => canvas.px(p),
            Toucher::Circle(other) => {
                let v = canvas.px(other) - centre;
                centre + v * (radius / v.norm().max(f64::MIN_POSITIVE))
            }
            Toucher::Line([a, b]) => {
                let [a, b] = [a, b].map(|p| canvas.px(p));
                let Some(e) = (b - a).unit() else { return };
                a + e * (centre - a).dot(e)
            }
        };
        let size = canvas.size(5.0);
        canvas.figure(Layer::Mark, Placement::at(at)).circle(Class::Mark, Point::ORIGIN, size);
    }
}
