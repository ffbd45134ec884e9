//! The sheet a chart is drawn on: the one file that spells its SVG.
//!
//! Drawings are spelled by the crate `svg`, charts are not: it sets each child of an element on
//! a line of its own, and within a text that line break is seen, as a gap between the 10 and
//! the exponent of a power of ten.

use std::fmt::Write;

use crate::constraint::Point;
use crate::diag::format_decimals;
use crate::interrupt::tick;
use crate::render::FIRST_WORDS;
use crate::render::text::printable;

/// What the writing of an element takes, in ticks.
const ELEMENT: usize = 200;

const FONT: &str = "Helvetica, Arial, 'Liberation Sans', sans-serif";

/// An SVG document that grows.
pub struct Sheet {
    svg: String,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Stroke<'a> {
    /// Its colour.
    pub colour: &'a str,
    /// Its width, px; of 1 nothing needs to be said.
    pub width: f64,
    /// Whether its corners are round.
    pub is_round: bool,
    /// Its dashes, px; empty if it has none.
    pub dash: &'a str,
}

/// How words are written.
#[derive(Debug, Clone, Copy)]
pub struct TextStyle<'a> {
    /// Size of letters, px.
    pub size: f64,
    /// Which end of the words the place is.
    pub anchor: Anchor,
    /// Their colour.
    pub colour: &'a str,
}

/// Which end of some words stands at their place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The first letter.
    Start,
    /// The middle.
    Middle,
    /// The last letter.
    End,
}

impl<'a> Stroke<'a> {
    /// A thin line without dashes.
    pub const fn thin(colour: &'a str) -> Self {
        Self { colour, width: 1.0, is_round: false, dash: "" }
    }
}

impl Anchor {
    const fn word(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A length on the page: a tenth of a px is finer than any printer.
pub fn number(value: f64) -> String {
    format_decimals(value, 1)
}

/// The chain of straight lines through some places, as the data of a path.
pub fn polyline(places: &[Point]) -> String {
    let place = |p: &Point| {
        tick(ELEMENT);
        format!("{} {}", number(p.x), number(p.y))
    };
    let places: Vec<String> = places.iter().map(place).collect();
    format!("M{}", places.join("L"))
}

impl Sheet {
    /// A sheet of paper with a title for who lists documents, and more of it above the place that heights
    /// are counted from.
    pub fn new(width: f64, [above, below]: [f64; 2], title: &str) -> Self {
        let (width, height, title) = (number(width), number(above + below), escaped(title));
        let top = number(-above);
        let down = if above > 0.0 { format!(" y=\"{top}\"") } else { String::new() };
        Self {
            svg: format!(
                "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 {top} {width} {height}\" \
                 width=\"{width}\" height=\"{height}\" font-family=\"{FONT}\">\n\
                 <title>{title}</title>\n\
                 <rect{down} width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
            ),
        }
    }

    /// The document.
    pub fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }

    fn push(&mut self, element: std::fmt::Arguments) {
        tick(ELEMENT);
        // Writing to a string cannot fail.
        let _ = writeln!(self.svg, "{element}");
    }

    /// Draws a line along the data of a path.
    pub fn line(&mut self, path: &str, stroke: Stroke) {
        let width = if stroke.width == 1.0 {
            String::new()
        } else {
            format!(" stroke-width=\"{}\"", number(stroke.width))
        };
        let join = if stroke.is_round { " stroke-linejoin=\"round\"" } else { "" };
        let dash = if stroke.dash.is_empty() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", stroke.dash)
        };
        let colour = stroke.colour;
        self.push(format_args!(
            "<path d=\"{path}\" stroke=\"{colour}\"{width}{join}{dash} fill=\"none\"/>"
        ));
    }

    /// Draws a mark along the data of a path.
    pub fn mark(&mut self, path: &str, fill: &str, stroke: &str) {
        self.push(format_args!(
            "<path d=\"{path}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"1.6\"/>"
        ));
    }

    /// Draws a round mark.
    pub fn round_mark(&mut self, at: Point, radius: f64, fill: &str, stroke: &str) {
        let (x, y, r) = (number(at.x), number(at.y), number(radius));
        self.push(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\" stroke=\"{stroke}\" \
             stroke-width=\"1.6\"/>"
        ));
    }

    /// Writes words, if there are any.
    pub fn write(&mut self, at: Point, words: &str, style: TextStyle) {
        if !words.is_empty() {
            self.write_markup(at, &escaped(words), style);
        }
    }

    /// Writes bold words, if there are any.
    pub fn write_bold(&mut self, at: Point, words: &str, style: TextStyle) {
        if !words.is_empty() {
            let words = format!("<tspan font-weight=\"bold\">{}</tspan>", escaped(words));
            self.write_markup(at, &words, style);
        }
    }

    /// Writes words with a rim of paper that keeps lines off the letters.
    pub fn write_over_lines(&mut self, at: Point, words: &str, is_bold: bool, style: TextStyle) {
        let weight = if is_bold { " font-weight=\"bold\"" } else { "" };
        let words = format!(
            "<tspan{weight} stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" \
             paint-order=\"stroke\">{}</tspan>",
            escaped(words)
        );
        self.write_markup(at, &words, style);
    }

    /// Writes what is SVG already.
    pub fn write_markup(&mut self, at: Point, words: &str, style: TextStyle) {
        let (x, y, size) = (number(at.x), number(at.y), style.size);
        let (anchor, colour) = (style.anchor.word(), style.colour);
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{colour}\">{words}</text>"
        ));
    }

    /// Writes words upwards, their middle at a place.
    pub fn write_upwards(&mut self, at: Point, words: &str, style: TextStyle) {
        let (x, y, size) = (number(at.x), number(at.y), style.size);
        let (colour, words) = (style.colour, escaped(words));
        self.push(format_args!(
            "<text transform=\"translate({x} {y}) rotate(-90)\" font-size=\"{size}\" \
             text-anchor=\"middle\" fill=\"{colour}\">{words}</text>"
        ));
    }
}

fn escaped(words: &str) -> String {
    let words = printable(words);
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
