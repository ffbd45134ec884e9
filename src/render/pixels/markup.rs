//! Reads the documents that this room writes: shapes, each with how it looks.
//!
//! It is no reader of SVG: it knows the elements, attributes and style rules that `document` and
//! `chart` write, and passes over what it does not know.

use std::collections::HashMap;

use super::outline::Transform;
use crate::constraint::{Point, Vector};
use crate::interrupt::tick;

/// What reading a tag takes, in ticks, besides its attributes.
const TAG: usize = 500;

/// A shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Element {
    /// From the origin.
    Rectangle { width: f64, height: f64 },
    /// A circle.
    Circle { centre: Point, radius: f64 },
    /// The data of a path.
    Path(String),
    /// A text on its base line, in pieces.
    Text { at: Point, runs: Vec<Run> },
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub text: String,
    /// Of its letters.
    pub size: f64,
    /// How far below the line it stands.
    pub drop: f64,
}

/// Which end of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// What a document has, from the bottom up.
#[derive(Debug, Clone, Copy)]
pub enum Part<'a> {
    /// What lies in a group that is so opaque as a whole, up to its end.
    Begin(f32),
    /// A shape, and how it looks.
    Shape(&'a Element, &'a Look),
    /// The end of the group that was begun last.
    End,
}

/// How a shape looks and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    pub transform: Transform,
    pub fill: Option<[u8; 3]>,
    pub stroke: Option<[u8; 3]>,
    pub width: f64,
    pub dash: Vec<f64>,
    /// Its own; that of a group is the group's.
    pub opacity: f32,
    pub is_even_odd: bool,
    pub is_italic: bool,
    pub is_bold: bool,
    /// Of letters.
    pub size: f64,
    pub anchor: Anchor,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            transform: Transform::NONE,
            fill: Some([0; 3]),
            stroke: None,
            width: 1.0,
            dash: Vec::new(),
            opacity: 1.0,
            is_even_odd: false,
            is_italic: false,
            is_bold: false,
            size: 16.0,
            anchor: Anchor::Start,
        }
    }
}

impl Look {
    /// Takes a property, as an attribute or a style rule gives it.
    fn set(&mut self, name: &str, value: &str) {
        let number = |text: &str| text.trim_end_matches("px").parse::<f64>();
        match name {
            "fill" => self.fill = colour(value),
            "stroke" => self.stroke = colour(value),
            "stroke-width" => self.width = number(value).unwrap_or(self.width),
            "stroke-dasharray" => {
                self.dash = value.split([' ', ',']).filter_map(|word| number(word).ok()).collect();
            }
            "opacity" => self.opacity = number(value).unwrap_or(1.0) as f32,
            "fill-rule" => self.is_even_odd = value == "evenodd",
            "font-style" => self.is_italic = value == "italic",
            "font-weight" => self.is_bold = value == "bold",
            "font-size" => self.size = number(value).unwrap_or(self.size),
            "text-anchor" => {
                self.anchor = match value {
                    "middle" => Anchor::Middle,
                    "end" => Anchor::End,
                    _ => Anchor::Start,
                };
            }
            _ => {}
        }
    }
}

/// A colour `#rgb` or `#rrggbb`; none where there is none.
fn colour(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    let channel = |k: usize| match digits.len() {
        3 => u8::from_str_radix(digits.get(k..=k)?, 16).ok().map(|n| 17 * n),
        _ => u8::from_str_radix(digits.get(2 * k..2 * k + 2)?, 16).ok(),
    };
    Some([channel(0)?, channel(1)?, channel(2)?])
}

/// A document that is read.
pub struct Document<'a> {
    /// Its width and height, px.
    pub size: [f64; 2],
    tags: Vec<Tag<'a>>,
    sheet: Sheet<'a>,
}

/// A tag, with the text behind it.
struct Tag<'a> {
    name: &'a str,
    attributes: &'a str,
    text: &'a str,
}

/// The rules of a style sheet, by what they are for: `path`, `.rod`, `.unmet path`.
#[derive(Default)]
struct Sheet<'a> {
    rules: HashMap<&'a str, Vec<(&'a str, &'a str)>>,
}

/// Reads a document.
pub fn read(svg: &str) -> Document<'_> {
    let tags: Vec<Tag> = svg
        .split('<')
        .skip(1)
        .filter_map(|piece| {
            let (inside, text) = piece.split_once('>')?;
            let end = inside.find(char::is_whitespace).unwrap_or(inside.len());
            Some(Tag {
                name: inside[..end].trim_end_matches('/'),
                attributes: &inside[end..],
                text,
            })
        })
        .collect();
    let mut sheet = Sheet::default();
    for tag in tags.iter().filter(|tag| tag.name == "style") {
        sheet.add(tag.text);
    }
    let side = |name: &str| {
        let root = tags.iter().find(|tag| tag.name == "svg");
        root.and_then(|root| root.number(name)).filter(|px| *px > 0.0).unwrap_or(1.0)
    };
    Document { size: [side("width"), side("height")], tags, sheet }
}

impl<'a> Sheet<'a> {
    fn add(&mut self, text: &'a str) {
        for rule in text.split('}') {
            let Some((selectors, body)) = rule.split_once('{') else { continue };
            let properties = body.split(';').filter_map(|property| property.split_once(':'));
            let properties: Vec<(&str, &str)> = properties.collect();
            for selector in selectors.split(',') {
                self.rules.entry(selector.trim()).or_default().extend(&properties);
            }
        }
    }

    fn apply(&self, selector: &str, look: &mut Look) {
        for (name, value) in self.rules.get(selector).into_iter().flatten() {
            look.set(name, value);
        }
    }
}

impl<'a> Tag<'a> {
    fn attribute(&self, name: &str) -> Option<&'a str> {
        self.attributes().find(|(found, _)| *found == name).map(|(_, value)| value)
    }

    fn attributes(&self) -> impl Iterator<Item = (&'a str, &'a str)> {
        let mut rest = self.attributes;
        std::iter::from_fn(move || {
            let (name, behind) = rest.split_once("=\"")?;
            let (value, behind) = behind.split_once('"')?;
            rest = behind;
            Some((name.trim(), value))
        })
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.attribute(name)?.parse().ok()
    }

    fn is_empty(&self) -> bool {
        self.attributes.ends_with('/')
    }

    fn place(&self, x: &str, y: &str) -> Point {
        Point::new(self.number(x).unwrap_or_default(), self.number(y).unwrap_or_default())
    }
}

/// A group that is open, with what holds of all in it.
struct Group<'a> {
    class: Option<&'a str>,
    look: Look,
}

impl Document<'_> {
    /// Gives each shape and each group that lets through what lies below it, from the bottom up.
    pub fn visit(&self, give: &mut impl FnMut(Part)) {
        let mut groups = vec![Group { class: None, look: Look::default() }];
        let mut k = 0;
        while let Some(tag) = self.tags.get(k) {
            k += 1;
            tick(TAG + tag.attributes.len());
            match tag.name {
                "g" if !tag.is_empty() => {
                    let look = self.look(tag, &groups);
                    if look.opacity < 1.0 {
                        give(Part::Begin(look.opacity));
                    }
                    groups.push(Group { class: tag.attribute("class"), look });
                }
                "/g" if groups.len() > 1 => {
                    let is_faded = groups.pop().is_some_and(|group| group.look.opacity < 1.0);
                    is_faded.then(|| give(Part::End));
                }
                "rect" => {
                    let [width, height] =
                        ["width", "height"].map(|side| tag.number(side).unwrap_or_default());
                    let rectangle = Element::Rectangle { width, height };
                    give(Part::Shape(&rectangle, &self.look(tag, &groups)));
                }
                "circle" => {
                    let (centre, radius) =
                        (tag.place("cx", "cy"), tag.number("r").unwrap_or_default());
                    let circle = Element::Circle { centre, radius };
                    give(Part::Shape(&circle, &self.look(tag, &groups)));
                }
                "path" => {
                    let data = tag.attribute("d").unwrap_or_default().to_owned();
                    give(Part::Shape(&Element::Path(data), &self.look(tag, &groups)));
                }
                "text" => {
                    let mut look = self.look(tag, &groups);
                    let size = look.size;
                    let mut runs = vec![Run { text: unescaped(tag.text), size, drop: 0.0 }];
                    // Spans within: their letters, and what the last of them says of all.
                    while let Some(span) = self.tags.get(k).filter(|tag| tag.name != "/text") {
                        let mut run = Run { text: unescaped(span.text), size, drop: 0.0 };
                        if span.name == "tspan" {
                            span.attributes().for_each(|(name, value)| look.set(name, value));
                            run.size = span.number("font-size").unwrap_or(size);
                            run.drop = span.number("dy").unwrap_or_default();
                        }
                        runs.push(run);
                        k += 1;
                    }
                    let text = Element::Text { at: tag.place("x", "y"), runs };
                    give(Part::Shape(&text, &look));
                }
                _ => {}
            }
        }
    }

    /// How a tag looks: what its group says, then rules, from the weakest, then its own attributes.
    fn look(&self, tag: &Tag, groups: &[Group]) -> Look {
        let around = &groups[groups.len() - 1];
        let mut look = Look { opacity: 1.0, ..around.look.clone() };
        for (name, value) in tag.attributes() {
            look.set(name, value);
        }
        self.sheet.apply(tag.name, &mut look);
        if let Some(class) = tag.attribute("class") {
            self.sheet.apply(&format!(".{class}"), &mut look);
        }
        for class in groups.iter().filter_map(|group| group.class) {
            self.sheet.apply(&format!(".{class} {}", tag.name), &mut look);
        }
        if let Some(transform) = tag.attribute("transform") {
            look.transform = look.transform.after(transform_of(transform));
        }
        look
    }
}

/// `translate(x y)rotate(degrees)`, either left out.
fn transform_of(text: &str) -> Transform {
    let parts = text.split(')').filter_map(|part| part.trim().split_once('('));
    parts.fold(Transform::NONE, |all, (name, numbers)| {
        let numbers: Vec<f64> =
            numbers.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
        all.after(match (name, &numbers[..]) {
            ("translate", &[x, y]) => Transform::shift(Vector::new(x, y)),
            ("translate", &[x]) => Transform::shift(Vector::new(x, 0.0)),
            ("rotate", &[degrees]) => Transform::turn(degrees),
            _ => Transform::NONE,
        })
    })
}

fn unescaped(text: &str) -> String {
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
    text.replace("&apos;", "'").replace("&amp;", "&").trim_matches('\n').to_owned()
}
