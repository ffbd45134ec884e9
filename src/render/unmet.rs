//! What does not hold in a pose: drawn red, with the amount by which it is off.

use std::sync::Arc;

use super::canvas::{Canvas, Lettering};
use super::figure::{Figure, Key, Layer, Outline, Placement};
use super::labels::{Area, cheapest, direction, directions, text_width};
use super::occupancy::Occupancy;
use super::page::Page;
use super::scene::Scene;
use super::style::{AMOUNT, BASE_LINE, Class, letter};
use super::symbols::SymbolForm;
use super::view::View;
use crate::constraint::{Point, Vector};

/// How far an amount may stand off what is off, px.
const DISTANCES: [f64; 7] = [8.0, 13.0, 20.0, 30.0, 44.0, 62.0, 90.0];
/// How much a px of that weighs against what the letters cover.
const PER_PX: f64 = 0.015;
/// Around the letters of an amount, px.
const GAP: f64 = 2.0;
/// From the edge of the page to what has no place of its own, px.
const EDGE: f64 = 14.0;
/// More amounts than this cover the mechanism; the others are counted.
const MOST: usize = 16;

/// Marks the figures of constraints that do not hold.
pub fn mark(figures: &mut [Figure], scene: &Scene) {
    for figure in figures {
        if let Key::Constraint(id) = figure.key {
            figure.is_unmet = scene.unmet.contains_key(&id);
        }
    }
}

/// By how much each is off, written beside the line of it that has most room: on nothing else, as far as
/// there is a place. What is not drawn is told in the corner.
pub fn amounts(figures: &[Figure], scene: &Scene, view: &View, names: &Lettering) -> Vec<Figure> {
    if scene.unmet.is_empty() {
        return Vec::new();
    }
    let page = view.page();
    let mut taken = occupied(figures, scene, page, names);
    let mut canvas = Canvas::new(page, &scene.pose.at, names);
    let mut write = |anchors: &[Point], name: Option<Arc<str>>, text: Arc<str>| {
        let half = Vector::new(0.5 * AMOUNT * text_width(&text), 0.5 * AMOUNT);
        let middle = place(anchors, half, &taken, page);
        taken.add_area(Area::around(middle, half + Vector::new(GAP, GAP)));
        canvas.begin(Key::Legend, false, name);
        let figure = canvas.figure(Layer::Legend, Placement::at(middle));
        figure.text(Class::Amount, Point::new(0.0, BASE_LINE * AMOUNT), text);
    };
    for (&id, amount) in scene.unmet.iter().take(MOST) {
        let own = figures.iter().filter(|figure| figure.key == Key::Constraint(id));
        let name = own.clone().find_map(|figure| figure.note.clone());
        let mut anchors: Vec<Point> = own.filter_map(anchor).collect();
        if anchors.is_empty() {
            anchors.push(Point::new(EDGE, EDGE));
        }
        write(&anchors, name, amount.clone());
    }
    if let Some(more) = scene.unmet.len().checked_sub(MOST).filter(|more| *more > 0) {
        write(&[Point::new(EDGE, EDGE)], None, format!("and {more} more off").into());
    }
    canvas.finish()
}

/// What of the page letters may not lie on.
fn occupied(figures: &[Figure], scene: &Scene, page: &Page, names: &Lettering) -> Occupancy {
    let mut taken = Occupancy::new(page);
    figures.iter().for_each(|figure| taken.add(figure, page.mark()));
    let letter = letter(page.mark());
    for symbol in scene.pose.symbols.iter() {
        let SymbolForm::Joint(joint) = &symbol.form else { continue };
        let at = page.px(scene.pose.at[joint.point as usize]);
        let half = Vector::new(0.5 * text_width(&joint.name) * letter, 0.5 * letter);
        if let Some(&offset) = names.get(&joint.point) {
            taken.add_area(Area::around(at + offset, half));
        }
    }
    taken
}

/// The middle of the longest line of a figure; none where it has no line.
fn anchor(figure: &Figure) -> Option<Point> {
    let mut longest: Option<(f64, Point)> = None;
    let mut take = |length: f64, middle: Point| {
        if longest.is_none_or(|(most, _)| length > most) {
            longest = Some((length, middle));
        }
    };
    for shape in &figure.shapes {
        match &shape.outline {
            Outline::Path(path) | Outline::GrowingPath { path, .. } => {
                path.flatten(&mut |a, b| take(a.distance(b), a + (b - a) * 0.5));
            }
            Outline::Circle { centre, radius } => {
                take(*radius, *centre - Vector::new(0.0, *radius));
            }
            Outline::Text { .. } => {}
        }
    }
    longest.map(|(_, middle)| figure.placement.place(middle))
}

/// Where the middle of letters is to be that belong to one of these places.
fn place(anchors: &[Point], half: Vector, taken: &Occupancy, page: &Page) -> Point {
    let n_cells = half.x * half.y;
    let places = anchors.iter().flat_map(|&anchor| {
        DISTANCES.iter().flat_map(move |&distance| {
            directions().map(move |k| (anchor, distance, direction(f64::from(k))))
        })
    });
    let costs = places.filter_map(|(anchor, distance, phi)| {
        let e = Vector::polar(1.0, phi);
        // The box touches the circle of this radius: at a corner, or at a side.
        let aside = |part: f64, half: f64| half * (1.5 * part).clamp(-1.0, 1.0);
        let middle = anchor + e * distance + Vector::new(aside(e.x, half.x), aside(e.y, half.y));
        let covered = f64::from(taken.cost(Area::around(middle, half))?) / n_cells;
        Some((covered + PER_PX * distance, middle))
    });
    let (width, height) = page.size();
    let inside = |at: Point| {
        let within = |value: f64, half: f64, most: f64| value.min(most - half).max(half);
        Point::new(within(at.x, half.x, width), within(at.y, half.y, height))
    };
    cheapest(costs).map_or_else(|| inside(anchors[0]), |(_, middle)| middle)
}
