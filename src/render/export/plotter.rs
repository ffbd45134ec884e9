//! Strokes for plotters: the mechanism and each path on a layer of its own, in true size.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::lines::chains;
use super::notation::escaped;
use crate::constraint::Point;
use crate::diag::format_decimals;
use crate::interrupt::tick;
use crate::render::FIRST_WORDS;
use crate::render::laps::once;
use crate::render::page::BoundingBox;
use crate::render::scene::Scene;
use crate::render::symbols::SymbolForm;
use crate::render::trace::{Curve, thin};

/// Digits after the point of a mm: a thousandth is finer than any pen.
const PLACES: usize = 3;
/// The same as a length, mm.
const FINEST: f64 = 1e-3;
/// From what is drawn to the edge of the page, mm.
const MARGIN: f64 = 10.0;
/// How far a stroke may pass a sample of a path, mm.
const TOLERANCE: f64 = 0.01;
/// The radius of a joint, mm.
const JOINT: f64 = 1.0;

/// What the writing of a place takes, in ticks.
const PLACE: usize = 50;

/// What a pen draws without being lifted.
#[derive(Debug, Clone, PartialEq)]
enum Stroke {
    Chain(Vec<Point>),
    Circle(Point, f64),
}

/// What a plotter draws, in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Strokes {
    /// Each with its name: the mechanism, then the paths.
    layers: Vec<(String, Vec<Stroke>)>,
    lo: Point,
    hi: Point,
}

impl Strokes {
    /// A scene as strokes, `scale` mm for each unit of the plane; none if there is nothing to draw.
    pub fn of(scene: &Scene, scale: f64) -> Option<Self> {
        let mut layers = vec![("mechanism".to_owned(), mechanism(scene, scale))];
        for curve in &scene.curves {
            layers.push((curve.name.to_string(), vec![Stroke::Chain(path(curve, scale))]));
        }
        for (_, strokes) in &mut layers {
            strokes.retain(|stroke| !matches!(stroke, Stroke::Chain(points) if points.len() < 2));
        }
        layers.retain(|(_, strokes)| !strokes.is_empty());
        let mut bounds = BoundingBox::default();
        for stroke in layers.iter().flat_map(|(_, strokes)| strokes) {
            match stroke {
                Stroke::Chain(points) => points.iter().for_each(|&p| bounds.include(p)),
                Stroke::Circle(centre, radius) => bounds.include_circle(*centre, *radius),
            }
        }
        let (lo, hi) = bounds.corners()?;
        Some(Self { layers, lo, hi })
    }

    /// Width and height of the page, mm.
    pub fn size(&self) -> [f64; 2] {
        [self.hi.x - self.lo.x, self.hi.y - self.lo.y].map(|side| side + 2.0 * MARGIN)
    }

    /// The document.
    pub fn svg(&self) -> String {
        let [width, height] = self.size().map(number);
        let mut text = format!(
            "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{width}mm\" \
             height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n"
        );
        for (k, (name, strokes)) in self.layers.iter().enumerate() {
            let (n, name) = (k + 1, escaped(name));
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "<g id=\"layer{n}\" inkscape:groupmode=\"layer\" inkscape:label=\"{n} {name}\" \
                 fill=\"none\" stroke=\"#000000\" stroke-width=\"0.3\">"
            );
            strokes.iter().for_each(|stroke| self.write(stroke, &mut text));
            text.push_str("</g>\n");
        }
        text.push_str("</svg>\n");
        text
    }

    fn write(&self, stroke: &Stroke, text: &mut String) {
        // On a page y points down.
        let place = |p: Point| [p.x - self.lo.x + MARGIN, self.hi.y - p.y + MARGIN].map(number);
        let _ = match stroke {
            Stroke::Chain(points) => {
                tick(PLACE * points.len());
                let points: Vec<String> = points.iter().map(|&p| place(p).join(" ")).collect();
                writeln!(text, "<path d=\"M{}\"/>", points.join("L"))
            }
            Stroke::Circle(centre, radius) => {
                tick(PLACE);
                let ([x, y], r) = (place(*centre), number(*radius));
                writeln!(text, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>")
            }
        };
    }
}

fn number(value: f64) -> String {
    format_decimals(value, PLACES)
}

fn scaled(p: Point, scale: f64) -> Point {
    (p.to_vector() * scale).to_point()
}

/// A path, a lap once.
fn path(curve: &Curve, scale: f64) -> Vec<Point> {
    curve.samples.read(|all| {
        let places = once(all).of(all).map(|sample| scaled(sample.at, scale));
        thin(&places.collect::<Vec<_>>(), TOLERANCE)
    })
}

/// The middle lines of bars, the edges of bodies, circles, joints; no place twice.
fn mechanism(scene: &Scene, scale: f64) -> Vec<Stroke> {
    let at = |p: u32| scaled(scene.pose.at[p as usize], scale);
    let (mut lines, mut curves, mut joints) = (Vec::new(), Vec::new(), Vec::new());
    for symbol in scene.pose.symbols.iter().filter(|symbol| !symbol.is_off) {
        tick(PLACE);
        if let Some([a, b]) = symbol.bar_ends() {
            lines.push([at(a), at(b)]);
        }
        match &symbol.form {
            SymbolForm::Plate(plate) => {
                let corners = plate.hull();
                let next = corners.iter().cycle().skip(1);
                lines.extend(corners.iter().zip(next).map(|(&a, &b)| [at(a), at(b)]));
            }
            SymbolForm::Round(round) => {
                let chain = round.chain(&scene.pose.at);
                curves.push(Stroke::Chain(chain.into_iter().map(|p| scaled(p, scale)).collect()));
            }
            SymbolForm::Joint(joint) => joints.push(Stroke::Circle(at(joint.point), JOINT)),
            _ => {}
        }
    }
    // Points alone are no mechanism.
    if lines.is_empty() && curves.is_empty() {
        return Vec::new();
    }
    let mut strokes: Vec<Stroke> = chains(&lines).into_iter().map(Stroke::Chain).collect();
    strokes.extend(curves.into_iter().chain(joints));
    let mut drawn = BTreeSet::new();
    strokes.retain(|stroke| drawn.insert(stroke.rounded()));
    strokes
}

impl Stroke {
    /// What is the same of strokes that cannot be told apart.
    fn rounded(&self) -> Vec<i64> {
        let place = |p: &Point| [p.x, p.y].map(|value| (value / FINEST).round() as i64);
        match self {
            Self::Chain(points) => points.iter().flat_map(place).collect(),
            Self::Circle(centre, radius) => {
                place(centre).into_iter().chain([(radius / FINEST).round() as i64]).collect()
            }
        }
    }
}
