//! Strokes for plotters: the mechanism and each path on a layer of its own, in true size.

use std::fmt::Write;

use super::notation::escaped;
use crate::constraint::{Point, Vector};
use crate::diag::format_decimals;
use crate::render::FIRST_WORDS;
use crate::render::laps::once;
use crate::render::page::BoundingBox;
use crate::render::scene::Scene;
use crate::render::symbols::SymbolForm;
use crate::render::trace::thin;

/// Digits after the point of a mm: a thousandth is finer than any pen.
const PLACES: usize = 3;
/// From what is drawn to the edge of the page, mm.
const MARGIN: f64 = 10.0;
/// How far a stroke may pass a sample of a path, mm.
const TOLERANCE: f64 = 0.01;
/// The radius of a joint, mm.
const JOINT: f64 = 1.0;

/// What a pen draws without being lifted.
enum Stroke {
    Chain(Vec<Point>),
    Circle(Point, f64),
}

/// A scene as strokes, `scale` mm for each unit of the plane; none if there is nothing to draw.
pub fn strokes(scene: &Scene, scale: f64) -> Option<String> {
    let mut layers = vec![("mechanism".to_owned(), mechanism(scene, scale))];
    for curve in &scene.curves {
        let points = curve.samples.read(|all| {
            let places = once(all).of(all).map(|sample| scaled(sample.at, scale));
            thin(&places.collect::<Vec<_>>(), TOLERANCE)
        });
        layers.push((curve.name.to_string(), vec![Stroke::Chain(points)]));
    }
    for (_, strokes) in &mut layers {
        strokes.retain(|stroke| !matches!(stroke, Stroke::Chain(points) if points.len() < 2));
    }
    layers.retain(|(_, strokes)| !strokes.is_empty());
    if layers.is_empty() {
        return None;
    }
    Some(written(&layers))
}

fn scaled(p: Point, scale: f64) -> Point {
    (p.to_vector() * scale).to_point()
}

/// The middle lines of bars, the edges of bodies, circles, joints.
fn mechanism(scene: &Scene, scale: f64) -> Vec<Stroke> {
    let at = |p: u32| scaled(scene.pose.at[p as usize], scale);
    let mut strokes = Vec::new();
    for symbol in scene.pose.symbols.iter().filter(|symbol| !symbol.is_off) {
        if let Some([a, b]) = symbol.bar_ends() {
            strokes.push(Stroke::Chain(vec![at(a), at(b)]));
        }
        match &symbol.form {
            SymbolForm::Plate(plate) => {
                let corners = plate.hull();
                let round = corners.iter().chain(corners.first());
                strokes.push(Stroke::Chain(round.map(|&p| at(p)).collect()));
            }
            SymbolForm::Round(round) => {
                let chain = round.chain(&scene.pose.at);
                strokes.push(Stroke::Chain(chain.into_iter().map(|p| scaled(p, scale)).collect()));
            }
            SymbolForm::Joint(joint) => strokes.push(Stroke::Circle(at(joint.point), JOINT)),
            _ => {}
        }
    }
    // Points alone are no mechanism.
    if strokes.iter().all(|stroke| matches!(stroke, Stroke::Circle(..))) {
        strokes.clear();
    }
    strokes
}

fn written(layers: &[(String, Vec<Stroke>)]) -> String {
    let mut bounds = BoundingBox::default();
    for stroke in layers.iter().flat_map(|(_, strokes)| strokes) {
        match stroke {
            Stroke::Chain(points) => points.iter().for_each(|&p| bounds.include(p)),
            Stroke::Circle(centre, radius) => bounds.include_circle(*centre, *radius),
        }
    }
    let (lo, hi) = bounds.corners().unwrap_or_default();
    let number = |value: f64| format_decimals(value, PLACES);
    let [width, height] = [hi.x - lo.x, hi.y - lo.y].map(|side| number(side + 2.0 * MARGIN));
    // On a page y points down.
    let place = |p: Point| Point::new(p.x - lo.x + MARGIN, hi.y - p.y + MARGIN);
    let mut text = format!(
        "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{width}mm\" \
         height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n"
    );
    for (k, (name, strokes)) in layers.iter().enumerate() {
        let (n, name) = (k + 1, escaped(name));
        let _ = writeln!(
            text,
            "<g id=\"layer{n}\" inkscape:groupmode=\"layer\" inkscape:label=\"{n} {name}\" \
             fill=\"none\" stroke=\"#000000\" stroke-width=\"0.3\">"
        );
        for stroke in strokes {
            let _ = match stroke {
                Stroke::Chain(points) => {
                    let point = |p: &Point| {
                        let p = place(*p);
                        format!("{} {}", number(p.x), number(p.y))
                    };
                    let points: Vec<String> = points.iter().map(point).collect();
                    writeln!(text, "<path d=\"M{}\"/>", points.join("L"))
                }
                Stroke::Circle(centre, radius) => {
                    let at: Vector = place(*centre).to_vector();
                    let [x, y, r] = [at.x, at.y, *radius].map(number);
                    writeln!(text, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>")
                }
            };
        }
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}
