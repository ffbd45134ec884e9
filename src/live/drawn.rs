//! Drawings as JSON.

use serde_json::{Map, Value, json};

use super::anchor::Anchor;
use crate::constraint::Point;
use crate::render::{
    Drawing, Figure, FigureShape, Key, Outline, PAPER, Scene, looks, px, trace_colour,
};
use crate::world::{Trace, World};

/// How the classes of a drawing look, and all of the drawing.
pub fn drawing(
    drawing: &Drawing,
    scene: &Scene,
    topology: u32,
    n_points: usize,
    anchors: &[Option<Anchor>],
) -> [Value; 2] {
    let ghosts = drawing.ghosts(scene);
    let shapes = drawing.figures().iter().chain(ghosts.iter().flat_map(|(_, figures)| figures));
    let looks = looks(shapes.flat_map(|figure| &figure.shapes));
    let classes: Map<String, Value> = looks
        .into_iter()
        .map(|look| {
            let mut value = json!({
                "fill": look.fill,
                "stroke": look.stroke,
                "width": look.width,
                "dash": look.dash,
                "opacity": look.opacity,
            });
            if let Some(size) = look.letters {
                value["size"] = json!(size);
            }
            if look.is_even_odd {
                value["evenodd"] = json!(true);
            }
            (look.name, value)
        })
        .collect();
    let ghosts: Vec<Value> = ghosts
        .iter()
        .map(|(opacity, figures)| {
            let placed = figures.iter().map(|figure| {
                let mut value = figure_value(figure);
                let at = figure.placement.at;
                value["place"] = json!([px(at.x), px(at.y), px(figure.placement.turn)]);
                value
            });
            json!({ "opacity": opacity, "figures": placed.collect::<Vec<_>>() })
        })
        .collect();
    let figures = drawing.figures().iter().zip(anchors).map(|(figure, anchor)| {
        let mut value = figure_value(figure);
        if let Some(anchor) = anchor {
            value["on"] = json!(anchor.handles());
        }
        value
    });
    let corners = drawing.bounds().map(|(lo, hi)| [lo.x, lo.y, hi.x, hi.y]);
    let centre = drawing.centre();
    let drawing = json!({ "drawing": {
        "topology": topology,
        "scale": drawing.scale(),
        "centre": [centre.x, centre.y],
        "mark": drawing.mark(),
        "bounds": corners,
        "points": n_points,
        "figures": figures.collect::<Vec<_>>(),
        "ghosts": ghosts,
    } });
    [json!({ "classes": classes, "paper": PAPER }), drawing]
}

/// The shapes of some figures.
pub fn shapes(drawing: &Drawing, topology: u32, changed: &[usize]) -> Value {
    let figures: Vec<Value> = changed
        .iter()
        .map(|&k| {
            json!([k, drawing.figures()[k].shapes.iter().map(shape_value).collect::<Vec<_>>()])
        })
        .collect();
    json!({ "shapes": { "topology": topology, "figures": figures } })
}

fn figure_value(figure: &Figure) -> Value {
    let mut value = json!({
        "layer": format!("{:?}", figure.layer).to_lowercase(),
        "shapes": figure.shapes.iter().map(shape_value).collect::<Vec<_>>(),
    });
    match figure.key {
        Key::Constraint(id) => value["constraint"] = json!(id.0),
        Key::Point(id) => value["point"] = json!(id.0),
        Key::Triangle(_) | Key::Trace(_) | Key::Legend => {}
    }
    if let Some(note) = figure.note.as_deref().filter(|note| !note.is_empty()) {
        value["note"] = json!(note);
    }
    if figure.is_off {
        value["off"] = json!(true);
    }
    value
}

fn shape_value(shape: &FigureShape) -> Value {
    let class = shape.class.name();
    match &shape.outline {
        Outline::Circle { centre, radius } => {
            json!({ "class": class, "circle": [px(centre.x), px(centre.y), px(*radius)] })
        }
        Outline::Text { at, text } => {
            json!({ "class": class, "text": &**text, "at": [px(at.x), px(at.y)] })
        }
        Outline::Path(_) | Outline::GrowingPath { .. } => {
            json!({ "class": class, "d": shape.path_data() })
        }
    }
}

/// How much of a path a page has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    point: u32,
    n: usize,
    last: Option<Point>,
}

impl Told {
    fn of(trace: &Trace) -> Self {
        let last = trace.samples.last().map(|sample| sample.at);
        Self { point: trace.point.0, n: trace.samples.len(), last }
    }

    /// How many of the samples of a path are those that the page has.
    fn n_same(&self, trace: &Trace) -> usize {
        let is_same = self.point == trace.point.0
            && self.n <= trace.samples.len()
            && (self.n == 0 || Some(trace.samples[self.n - 1].at) == self.last);
        if is_same { self.n } else { 0 }
    }
}

/// The paths as far as a page does not have them; none if it has all.
pub fn traces(world: &World, told: &mut Vec<Told>) -> Option<Value> {
    let now: Vec<Told> = world.traces().iter().map(Told::of).collect();
    if *told == now {
        return None;
    }
    let mut changed = Vec::new();
    for (k, trace) in world.traces().iter().enumerate() {
        if told.get(k) == Some(&now[k]) {
            continue;
        }
        let n_same = told.get(k).map_or(0, |told| told.n_same(trace));
        let new = || trace.samples.iter().skip(n_same);
        let missed = new().enumerate().filter(|(_, sample)| sample.missed);
        let (class, colour) = trace_colour(k);
        changed.push(json!({
            "trace": k,
            "point": trace.point.0,
            "name": world.points().name(trace.point),
            "class": class,
            "colour": colour,
            "from": n_same,
            "at": new().flat_map(|sample| [sample.at.x, sample.at.y]).collect::<Vec<_>>(),
            "missed": missed.map(|(i, _)| n_same + i).collect::<Vec<_>>(),
        }));
    }
    *told = now;
    Some(json!({ "traces": changed, "n": told.len() }))
}
