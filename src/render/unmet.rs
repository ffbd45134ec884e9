//! What does not hold in a pose: drawn red, with the amount by which it is off.

use super::canvas::Canvas;
use super::figure::{Figure, Key, Layer, Placement};
use super::labels::{Area, text_width};
use super::page::Page;
use super::scene::Scene;
use super::style::{AMOUNT, BASE_LINE, Class, letter};
use super::symbols::{Symbol, SymbolForm};
use crate::constraint::{Point, Vector};

/// From the middle of what is off up to its amount, px.
const RISE: f64 = 11.0;
/// Between two amounts, px.
const GAP: f64 = 2.0;
/// How many rows of amounts there may be on either side of what is off.
const ROWS: u32 = 12;

/// Marks the figures of constraints that do not hold.
pub fn mark(figures: &mut [Figure], scene: &Scene) {
    for figure in figures {
        if let Key::Constraint(id) = figure.key {
            figure.is_unmet = scene.unmet.contains_key(&id);
        }
    }
}

/// Writes by how much each is off, over or under the middle of its points: no amount lies on another,
/// nor on the name of a point while there is room beside it.
pub fn label(canvas: &mut Canvas, scene: &Scene) {
    let mut left = scene.unmet.clone();
    let names: Vec<Area> = scene.pose.symbols.iter().filter_map(|it| name(canvas, it)).collect();
    let mut taken: Vec<Area> = Vec::new();
    for symbol in scene.pose.symbols.iter() {
        let Key::Constraint(id) = symbol.key else { continue };
        let Some(amount) = left.remove(&id) else { continue };
        let points = symbol.points();
        let n = points.len().max(1) as f64;
        let middle =
            points.iter().fold(Point::ORIGIN, |sum, &p| sum + canvas.px(p).to_vector() / n);
        let places: Vec<(Point, Area)> = places(middle, &amount, canvas.page).collect();
        let is_free = |of: &[Area], area: &Area| !of.iter().any(|other| area.meets(other, GAP));
        let free = |(_, area): &&(Point, Area)| is_free(&taken, area) && is_free(&names, area);
        let found = places.iter().find(free);
        let found = found.or_else(|| places.iter().find(|(_, area)| is_free(&taken, area)));
        let Some(&(at, area)) = found.or(places.first()) else { continue };
        taken.push(area);
        canvas.begin(Key::Legend, false, Some(symbol.name.clone()));
        let figure = canvas.figure(Layer::Legend, Placement::at(middle));
        figure.text(Class::Amount, Point::ORIGIN + (at - middle), amount);
    }
}

/// Where an amount may stand, with what it covers: above its middle, below it, then farther and farther.
fn places(middle: Point, amount: &str, page: &Page) -> impl Iterator<Item = (Point, Area)> {
    let half = Vector::new(0.5 * AMOUNT * text_width(amount), 0.5 * AMOUNT);
    let (width, height) = page.size();
    let x = middle.x.min(width - half.x).max(half.x);
    let rises = (0..ROWS).flat_map(|row| {
        let far = RISE + f64::from(row) * (AMOUNT + GAP);
        [-far, far + (1.0 - BASE_LINE) * AMOUNT]
    });
    let places = rises.map(move |rise| {
        let at = Point::new(x, middle.y + rise);
        (at, Area::around(at - Vector::new(0.0, BASE_LINE * AMOUNT), half))
    });
    places.filter(move |(_, area)| area.lo.y >= 0.0 && area.hi.y <= height)
}

/// What the name of a point covers.
fn name(canvas: &Canvas, symbol: &Symbol) -> Option<Area> {
    let SymbolForm::Joint(joint) = &symbol.form else { return None };
    let offset = canvas.lettering.get(&joint.point)?;
    let letter = letter(canvas.page.mark());
    let half = Vector::new(0.5 * text_width(&joint.name) * letter, 0.5 * letter);
    Some(Area::around(canvas.px(joint.point) + *offset, half))
}
