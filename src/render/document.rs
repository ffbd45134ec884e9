//! Writes figures as an SVG document; the only file that knows the crate `svg`.

use std::collections::BTreeSet;
use std::fmt::Write;

use svg::Node;
use svg::node::Text;
use svg::node::element::{Element, Style};

use super::figure::{Figure, FigureShape, Outline};
use super::keyframes::{AnimatedAttribute, AttributeTrack, Keyframes};
use super::labels::wrapped;
use super::page::{LEGEND_HEIGHT, Page};
use super::style::{self, Class, HEADLINE, PAPER, Theme};
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

/// Room for a title above the drawing, and for each further line of it, px.
const TITLE_HEIGHT: f64 = 34.0;
const TITLE_LINE: f64 = 22.0;
/// From the sides of the page to the title, px.
const TITLE_EDGE: f64 = 12.0;

/// What a picture says besides the drawing, and how it looks.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Options {
    /// The title of the document, which stands above the drawing too.
    pub title: Option<String>,
    /// How wide it is shown, px; by default as wide as it is drawn.
    pub width: Option<u32>,
    /// Light lines on dark paper.
    pub is_dark: bool,
    /// No paper.
    pub is_transparent: bool,
    /// No names beside the points.
    pub without_names: bool,
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
    let title = options.title.as_deref().unwrap_or_default();
    let headline = wrapped(title, (width - 2.0 * TITLE_EDGE) / HEADLINE);
    let n_more = headline.len().saturating_sub(1) as f64;
    let head = if headline.is_empty() { 0.0 } else { TITLE_HEIGHT + n_more * TITLE_LINE };
    let height = height + head + if page.is_empty() { 0.0 } else { LEGEND_HEIGHT };
    let size = options.width.map_or(1.0, |shown| f64::from(shown) / width);
    let [shown_width, shown_height, width_text, height, top] =
        [width * size, height * size, width, height, -head].map(|px| format_decimals(px, PLACES));
    let theme = if options.is_dark { Theme::Dark } else { Theme::Light };

    let mut root = Element::new("svg");
    root.assign("class", "linkwork");
    root.assign("xmlns", "http://www.w3.org/2000/svg");
    root.assign("viewBox", format!("0 {top} {width_text} {height}"));
    root.assign("width", shown_width);
    root.assign("height", shown_height);
    if !headline.is_empty() {
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
    root.append(Style::new(sheet(page, groups, options, theme)));

    if !options.is_transparent {
        let mut paper = Element::new("rect");
        paper.assign("class", "paper");
        paper.assign("fill", theme.colour(PAPER));
        paper.assign("width", width_text);
        paper.assign("height", height);
        if head > 0.0 {
            paper.assign("y", top);
        }
        root.append(paper);
    }
    for (k, line) in headline.iter().enumerate() {
        let mut text = with_text("text", line);
        text.assign("class", Class::Headline.name());
        text.assign("x", format_decimals(0.5 * width, PLACES));
        let up = 0.3 * TITLE_HEIGHT + (n_more - k as f64) * TITLE_LINE;
        text.assign("y", format_decimals(-up, PLACES));
        root.append(text);
    }
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
    let mut text = Ticking(String::new());
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{root}");
    text.0
}

/// A text that may be left half written.
struct Ticking(String);

impl Write for Ticking {
    fn write_str(&mut self, piece: &str) -> std::fmt::Result {
        tick(piece.len());
        self.0.push_str(piece);
        Ok(())
    }
}

/// The style sheet of a page.
fn sheet(page: &Page, groups: &[Group], options: &Options, theme: Theme) -> String {
    let figures = || groups.iter().flat_map(|group| &group.figures);
    let shapes = figures().flat_map(|(figure, _)| &figure.shapes);
    let mut classes: BTreeSet<Class> = shapes.map(|shape| shape.class).collect();
    if options.title.is_some() {
        classes.insert(Class::Headline);
    }
    let mut text = style::sheet(&classes, page.mark(), theme);
    if figures().any(|(figure, _)| figure.is_unmet) {
        text.push_str(&style::unmet_rule(theme));
    }
    let moves = |group: &Group| group.figures.iter().any(|(_, motion)| motion.is_some());
    if groups.iter().any(moves) {
        // Opened by itself it is never larger than the window.
        text.push_str("svg:root{max-width:100%;max-height:100vh}\n");
    }
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
    if figure.is_unmet {
        group.assign("class", style::UNMET);
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
