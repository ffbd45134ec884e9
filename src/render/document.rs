//! Writes figures as an SVG document; the only file that knows the crate `svg`.

use std::collections::BTreeSet;
use std::fmt::Write;

use svg::Node;
use svg::node::Text;
use svg::node::element::{Element, Style};

use super::figure::{Figure, FigureShape, Outline};
use super::keyframes::{AnimatedAttribute, AttributeTrack, Keyframes};
use super::page::{LEGEND_HEIGHT, Page};
use super::style::{self, PAPER};
use super::text::printable;
use crate::diag::format_decimals;
use crate::interrupt::tick;

/// How a picture begins that this program drew: `svg` writes attributes in the order of their names.
pub const FIRST_WORDS: &str = "<svg class=\"linkwork\"";

/// Digits after the point of a px: a hundredth cannot be seen, a tenth can where lines meet.
const PLACES: usize = 2;
/// Digits after the point of degrees: at a thousand px a hundredth is a sixth of a px.
const DEGREE_PLACES: usize = 3;
/// How strongly something that is switched off is drawn.
const OFF: f64 = 0.3;

/// What the writing of a figure takes, in ticks.
const FIGURE: usize = 2000;

/// What a picture says besides the drawing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Options {
    /// The title of the document.
    pub title: Option<String>,
    /// What made it and from what: keys and values, kept in the document and not drawn.
    pub receipt: Vec<(String, String)>,
}

/// Figures that are shown as one.
#[derive(Debug, Clone)]
pub struct Group {
    /// From 0, not there, to 1.
    pub opacity: f64,
    /// How that changes.
    pub motion: Option<Keyframes>,
    /// Figures from the bottom up, each with how it moves.
    pub figures: Vec<(Figure, Option<Keyframes>)>,
}

impl Group {
    /// Figures that stand still.
    pub fn of(figures: Vec<Figure>) -> Self {
        let figures = figures.into_iter().map(|figure| (figure, None)).collect();
        Self { opacity: 1.0, motion: None, figures }
    }
}

/// The document of a page.
pub fn write(page: &Page, groups: &[Group], options: &Options) -> String {
    let (width, height) = page.size();
    let height = height + if page.is_empty() { 0.0 } else { LEGEND_HEIGHT };
    let (width, height) = (format_decimals(width, PLACES), format_decimals(height, PLACES));

    let mut root = Element::new("svg");
    root.assign("class", "linkwork");
    root.assign("xmlns", "http://www.w3.org/2000/svg");
    root.assign("viewBox", format!("0 0 {width} {height}"));
    root.assign("width", width.clone());
    root.assign("height", height.clone());
    if let Some(title) = &options.title {
        root.append(with_text("title", title));
    }
    if !options.receipt.is_empty() {
        let lines = options.receipt.iter().fold(String::new(), |mut lines, (key, value)| {
            // Writing to a string cannot fail.
            let _ = writeln!(lines, "{key}: {value}");
            lines
        });
        root.append(with_text("metadata", lines.trim_end()));
    }
    let shapes = groups.iter().flat_map(|group| &group.figures);
    let classes: BTreeSet<_> =
        shapes.flat_map(|(figure, _)| figure.shapes.iter().map(|shape| shape.class)).collect();
    root.append(Style::new(style::sheet(&classes, page.mark())));

    let mut paper = Element::new("rect");
    paper.assign("class", "paper");
    paper.assign("fill", PAPER);
    paper.assign("width", width);
    paper.assign("height", height);
    root.append(paper);
    for group in groups {
        let mut element = Element::new("g");
        if group.opacity < 1.0 {
            element.assign("opacity", format_decimals(group.opacity, 3));
        }
        append_tracks(&mut element, group.motion.as_ref(), None);
        for (figure, motion) in &group.figures {
            if let Some(figure) = figure_element(figure, motion.as_ref()) {
                element.append(figure);
            }
        }
        root.append(element);
    }
    let mut text = root.to_string();
    text.push('\n');
    text
}

/// A figure; none if there is nothing to it.
fn figure_element(figure: &Figure, motion: Option<&Keyframes>) -> Option<Element> {
    if figure.shapes.is_empty() {
        return None;
    }
    let mut group = Element::new("g");
    let transform = transform(figure);
    if !transform.is_empty() {
        group.assign("transform", transform);
    }
    if figure.is_off {
        group.assign("opacity", format_decimals(OFF, PLACES));
    }
    tick(FIGURE);
    if let Some(note) = figure.note.as_deref().filter(|note| !note.is_empty()) {
        group.append(with_text("title", note));
    }
    append_tracks(&mut group, motion, None);
    for (k, shape) in figure.shapes.iter().enumerate() {
        let mut element = shape_element(shape);
        append_tracks(&mut element, motion, Some(k));
        group.append(element);
    }
    Some(group)
}

fn transform(figure: &Figure) -> String {
    let at = figure.placement.at;
    let (x, y) = (format_decimals(at.x, PLACES), format_decimals(at.y, PLACES));
    let turn = format_decimals(figure.placement.turn, DEGREE_PLACES);
    let mut text = String::new();
    if (x.as_str(), y.as_str()) != ("0", "0") {
        text = format!("translate({x} {y})");
    }
    if turn != "0" {
        // Writing to a string cannot fail.
        let _ = write!(text, "rotate({turn})");
    }
    text
}

fn shape_element(shape: &FigureShape) -> Element {
    debug_assert!(
        shape.outline.numbers().iter().all(|number| number.is_finite()),
        "a picture is made of finite numbers"
    );
    let mut element = match &shape.outline {
        Outline::Path(path) => {
            let mut element = Element::new("path");
            element.assign("d", path.write(path.numbers(), PLACES));
            element
        }
        Outline::GrowingPath { path, length } => {
            let mut element = Element::new("path");
            element.assign("d", path.write(path.numbers(), PLACES));
            let length = format_decimals(*length, PLACES);
            element.assign("stroke-dasharray", length.clone());
            element.assign("pathLength", length);
            element
        }
        Outline::Circle { centre, radius } => {
            let mut element = Element::new("circle");
            for (name, value) in [("cx", centre.x), ("cy", centre.y), ("r", *radius)] {
                let value = format_decimals(value, PLACES);
                if name == "r" || value != "0" {
                    element.assign(name, value);
                }
            }
            element
        }
        Outline::Text { at, text } => {
            let mut element = with_text("text", text);
            element.assign("x", format_decimals(at.x, PLACES));
            element.assign("y", format_decimals(at.y, PLACES));
            element
        }
    };
    element.assign("class", shape.class.name());
    element
}

/// Adds those tracks of a motion that act on the figure itself, or on one of its shapes.
fn append_tracks(element: &mut Element, motion: Option<&Keyframes>, shape: Option<usize>) {
    let Some(motion) = motion else { return };
    if shape.is_none() && motion.is_hidden_at_first() {
        element.assign("visibility", "hidden");
    }
    for track in motion.tracks.iter().filter(|track| track.change.shape() == shape) {
        element.append(track_element(track, motion.duration));
    }
}

fn track_element(track: &AttributeTrack, duration: f64) -> Element {
    let (name, attribute) = match track.change {
        AnimatedAttribute::Place | AnimatedAttribute::Turn => ("animateTransform", "transform"),
        AnimatedAttribute::Visibility => ("animate", "visibility"),
        AnimatedAttribute::Shape(_, attribute) => ("animate", attribute),
    };
    let mut element = Element::new(name);
    element.assign("attributeName", attribute);
    match track.change {
        AnimatedAttribute::Place => element.assign("type", "translate"),
        AnimatedAttribute::Turn => {
            element.assign("type", "rotate");
            element.assign("additive", "sum");
        }
        AnimatedAttribute::Visibility => element.assign("calcMode", "discrete"),
        AnimatedAttribute::Shape(..) => {}
    }
    element.assign("values", track.values.join(";"));
    if !track.times.is_empty() {
        let times: Vec<String> = track.times.iter().map(|&t| format_decimals(t, 5)).collect();
        element.assign("keyTimes", times.join(";"));
    }
    element.assign("dur", format!("{}s", format_decimals(duration, 3)));
    element.assign("repeatCount", "indefinite");
    element
}

fn with_text(name: &str, text: &str) -> Element {
    let mut element = Element::new(name);
    element.append(Text::new(printable(text)));
    element
}
