//! Figures: the shapes that a picture is made of, in px on the page, y down.

use std::sync::Arc;

use super::path::Path;
use super::style::Class;
use crate::constraint::{Point, Vector};
use crate::world::{ConstraintId, PointId};

/// What lies over what, from the bottom up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Thin lines that only carry a mark.
    Construction,
    /// Rigid bodies.
    Plate,
    /// What others slide or roll on.
    Rail,
    /// Cog wheels and racks.
    Wheel,
    /// Paths.
    Trace,
    /// Rods, cords, telescopes, cranks.
    Bar,
    /// Triangles under frozen points.
    Ground,
    /// Blocks on rails.
    Slider,
    /// Motors.
    Drive,
    /// Ticks, arcs and arrows.
    Mark,
    /// Points.
    Joint,
    /// What stands below the drawing.
    Legend,
}

/// Whose figure it is; the same thing has the same key in every frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    /// Symbol of how a constraint is drawn.
    Constraint(ConstraintId),
    /// A rigid triangle of three rods.
    Triangle([u32; 3]),
    /// A point.
    Point(PointId),
    /// A path, by its place among the paths.
    Trace(usize),
    /// The scale and the legend.
    Legend,
}

/// A group of shapes that moves as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it lies over.
    pub layer: Layer,
    /// Whose it is.
    pub key: Key,
    /// Its number among the figures with the same key.
    pub part: u16,
    /// Whether what it stands for is switched off.
    pub is_off: bool,
    /// Whether what it stands for does not hold.
    pub is_unmet: bool,
    /// What it shows when pointed at.
    pub note: Option<Arc<str>>,
    /// Where its own origin lies on the page, and how it is turned.
    pub placement: Placement,
    /// What it is made of, in its own coordinates.
    pub shapes: Vec<FigureShape>,
}

impl Figure {
    /// Its place in the picture: by layer, then as its owner was made.
    pub const fn order(&self) -> (Layer, Key, u16) {
        (self.layer, self.key, self.part)
    }

    /// Whether it shows a thing and not a remark about things.
    pub const fn is_solid(&self) -> bool {
        !matches!(self.layer, Layer::Construction | Layer::Mark | Layer::Legend)
    }

    /// How far from its origin it reaches, px, roughly.
    pub fn reach(&self) -> f64 {
        let numbers = self.shapes.iter().flat_map(|shape| shape.outline.numbers());
        numbers.fold(0.0, |reach: f64, number| reach.max(number.abs()))
    }

    /// Adds a line or an area.
    pub fn path(&mut self, class: Class, path: Path) -> &mut Self {
        self.shapes.push(FigureShape { class, outline: Outline::Path(path) });
        self
    }

    /// Adds a circle.
    pub fn circle(&mut self, class: Class, centre: Point, radius: f64) -> &mut Self {
        self.shapes.push(FigureShape { class, outline: Outline::Circle { centre, radius } });
        self
    }

    /// Adds a text that stands on `at`.
    pub fn text(&mut self, class: Class, at: Point, text: Arc<str>) -> &mut Self {
        self.shapes.push(FigureShape { class, outline: Outline::Text { at, text } });
        self
    }
}

/// A place on the page and a turn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Placement {
    /// Where the figure's origin lies.
    pub at: Point,
    /// How far the figure is turned, degrees, clockwise as seen.
    pub turn: f64,
}

impl Placement {
    /// At a place, upright.
    pub const fn at(at: Point) -> Self {
        Self { at, turn: 0.0 }
    }

    /// At a place, the figure's x axis along a direction; upright for no direction.
    pub fn along(at: Point, direction: Vector) -> Self {
        Self { at, turn: direction.angle().to_degrees() }
    }

    /// Where a place of the figure lies on the page.
    pub fn place(&self, local: Point) -> Point {
        self.at + local.to_vector().rotate(self.turn.to_radians())
    }
}

/// One outline in one style.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureShape {
    /// How it looks.
    pub class: Class,
    /// Its form.
    pub outline: Outline,
}

/// The form of a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle {
        /// Its centre.
        centre: Point,
        /// Its radius.
        radius: f64,
    },
    /// Lines and arcs.
    Path(Path),
    /// A path that grows as its point moves: shown as far as it has come.
    GrowingPath {
        /// The whole path.
        path: Path,
        /// How long it is.
        length: f64,
    },
    /// A text.
    Text {
        /// Where it stands: the middle of its base line, or the left end of a caption's.
        at: Point,
        /// What it says.
        text: Arc<str>,
    },
}

impl Outline {
    /// Its numbers: those that differ between two frames of a motion.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Circle { centre, radius } => vec![centre.x, centre.y, *radius],
            Self::Path(path) | Self::GrowingPath { path, .. } => path.numbers().to_vec(),
            Self::Text { at, .. } => vec![at.x, at.y],
        }
    }

    /// Whether two outlines differ in their numbers only.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Circle { .. }, Self::Circle { .. }) => true,
            (Self::Path(a), Self::Path(b)) => a.is_like(b),
            (Self::Text { text: a, .. }, Self::Text { text: b, .. }) => a == b,
            _ => false,
        }
    }
}
