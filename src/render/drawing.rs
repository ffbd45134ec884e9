//! A drawing list: the figures of a mechanism for who draws them, and follows them as it moves.
//!
//! Figures are those of a picture. Most of them only change their places while the mechanism moves;
//! the others are told of.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::canvas::Lettering;
use super::document::Group;
use super::figure::{Figure, FigureShape};
use super::lettering;
use super::page::{BoundingBox, Page};
use super::scene::Scene;
use super::style::{CAPTION, Class, colour_number, letter};
use super::symbols::Symbol;
use super::view::{View, typical_bar};
use crate::constraint::Point;
use crate::diag::format_decimals;

/// How much a shape may differ from how it was told before it is told anew, px.
const TOLERANCE: f64 = 0.06;

/// The figures of a mechanism at some scale.
#[derive(Debug)]
pub struct Drawing {
    view: View,
    bounds: BoundingBox,
    symbols: Arc<[Symbol]>,
    figures: Vec<Figure>,
    n_ghosts: usize,
}

/// How a mechanism that moved looks now.
#[derive(Debug, PartialEq, Eq)]
pub enum Followed {
    /// The figures are the same but for their places and the shapes of these.
    Moved(Vec<usize>),
    /// Another drawing is to be made.
    Another,
}

/// How shapes of a class look, px.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeLook {
    /// The class.
    pub name: String,
    /// The colour of the area, if it has one.
    pub fill: Option<&'static str>,
    /// The colour of the line, if it has one.
    pub stroke: Option<&'static str>,
    /// How wide the line is.
    pub width: f64,
    /// How long its dashes and gaps are in turn.
    pub dash: &'static [f64],
    /// From 0, not there, to 1.
    pub opacity: f64,
    /// How large letters are, where the shape is a text.
    pub letters: Option<f64>,
    /// Whether what an outline surrounds twice is outside again.
    pub is_even_odd: bool,
}

impl Drawing {
    /// The drawing of a scene at so many px a world unit, or as a page shows it.
    pub fn new(scene: &Scene, scale: Option<f64>) -> Self {
        let mut bounds = BoundingBox::default();
        scene.pose.extend(&mut bounds);
        let bars = typical_bar(&scene.pose);
        let sized = |page: Page| if bars > 0.0 { page.with_bars(bars) } else { page };
        let whole = sized(Page::fit(&bounds));
        let page = sized(Page::at_scale(&bounds, scale));
        let mut lettering: Lettering = lettering::place(&[scene], &whole);
        // Names keep as far away from marks as those are large.
        let growth = page.mark() / whole.mark();
        lettering.values_mut().for_each(|offset| *offset *= growth);
        let view = View::new(page, lettering);
        let figures = view.figures(&scene.pose);
        let symbols = scene.pose.symbols.clone();
        Self { view, bounds, symbols, figures, n_ghosts: scene.ghosts.len() }
    }

    /// Follows a scene of the same world somewhat later.
    pub fn follow(&mut self, scene: &Scene) -> Followed {
        let is_same =
            Arc::ptr_eq(&self.symbols, &scene.pose.symbols) || self.symbols == scene.pose.symbols;
        if !is_same || self.n_ghosts != scene.ghosts.len() {
            return Followed::Another;
        }
        self.symbols = scene.pose.symbols.clone();
        let figures = self.view.figures(&scene.pose);
        let is_like = |(a, b): (&Figure, &Figure)| {
            a.order() == b.order()
                && a.shapes.len() == b.shapes.len()
                && a.shapes.iter().zip(&b.shapes).all(|(a, b)| a.class == b.class)
        };
        if figures.len() != self.figures.len() || !self.figures.iter().zip(&figures).all(is_like) {
            return Followed::Another;
        }
        let mut changed = Vec::new();
        for (k, (old, new)) in self.figures.iter_mut().zip(figures).enumerate() {
            old.placement = new.placement;
            if !looks_alike(&old.shapes, &new.shapes) {
                old.shapes = new.shapes;
                changed.push(k);
            }
        }
        Followed::Moved(changed)
    }

    /// The figures, from the bottom up.
    pub fn figures(&self) -> &[Figure] {
        &self.figures
    }

    /// Poses of the past, each with how strongly it is to be drawn.
    pub fn ghosts(&self, scene: &Scene) -> Vec<(f64, Vec<Figure>)> {
        let groups = self.view.ghosts(scene.ghosts.iter().map(|ghost| &**ghost));
        let figures = |group: Group| group.figures.into_iter().map(|(figure, _)| figure).collect();
        groups.into_iter().map(|group| (group.opacity, figures(group))).collect()
    }

    /// px per world unit.
    pub fn scale(&self) -> f64 {
        self.view.page().scale()
    }

    /// The place that px are counted from.
    pub fn centre(&self) -> Point {
        self.view.page().centre()
    }

    /// The corners of what there is, if there is anything.
    pub fn bounds(&self) -> Option<(Point, Point)> {
        self.bounds.corners()
    }

    /// How large marks are, at most 1.
    pub fn mark(&self) -> f64 {
        self.view.page().mark()
    }
}

/// How shapes of these classes look where marks are of full size.
pub fn looks<'a>(shapes: impl Iterator<Item = &'a FigureShape>) -> Vec<ShapeLook> {
    let classes: BTreeSet<Class> = shapes.map(|shape| shape.class).collect();
    classes.into_iter().map(Class::at_full_size).collect()
}

impl FigureShape {
    /// The path as SVG writes it, if it is one.
    pub fn path_data(&self) -> Option<String> {
        use super::figure::Outline;
        match &self.outline {
            Outline::Path(path) | Outline::GrowingPath { path, .. } => {
                Some(path.write(path.numbers(), 2))
            }
            _ => None,
        }
    }
}

impl Class {
    /// How it looks where marks are of full size.
    fn at_full_size(self) -> ShapeLook {
        let look = self.look();
        let colour = |name: &'static str| (name != "none").then_some(name);
        ShapeLook {
            name: self.name(),
            fill: colour(look.fill),
            stroke: colour(look.stroke),
            width: look.width,
            dash: look.dash,
            opacity: look.opacity,
            letters: match self {
                Self::Name => Some(letter(1.0)),
                Self::Caption => Some(CAPTION),
                _ => None,
            },
            is_even_odd: self == Self::RingWheel,
        }
    }
}

/// The class and the colour of the path at a place in the list of a world's traces.
pub fn trace_colour(idx: usize) -> (String, &'static str) {
    let class = Class::Trace(colour_number(idx));
    (class.name(), class.look().stroke)
}

/// Whether nobody can see that these are not those.
fn looks_alike(a: &[FigureShape], b: &[FigureShape]) -> bool {
    a.iter().zip(b).all(|(a, b)| {
        a.outline.is_like(&b.outline) && {
            let (p, q) = (a.outline.numbers(), b.outline.numbers());
            p.iter().zip(&q).all(|(x, y)| (x - y).abs() <= TOLERANCE)
        }
    })
}

/// A number with as many digits as a page shows.
pub fn px(value: f64) -> f64 {
    format_decimals(value, 2).parse().unwrap_or(0.0)
}
