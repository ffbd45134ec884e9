//! What does not hold in a pose: drawn red, with the amount by which it is off.

use super::canvas::Canvas;
use super::figure::{Figure, Key, Layer, Placement};
use super::scene::Scene;
use super::style::Class;
use crate::constraint::Point;

/// From the middle of what is off up to its amount, px.
const RISE: f64 = 11.0;

/// Marks the figures of constraints that do not hold.
pub fn mark(figures: &mut [Figure], scene: &Scene) {
    for figure in figures {
        if let Key::Constraint(id) = figure.key {
            figure.is_unmet = scene.unmet.contains_key(&id);
        }
    }
}

/// Writes by how much each is off, over the middle of its points.
pub fn label(canvas: &mut Canvas, scene: &Scene) {
    let mut left = scene.unmet.clone();
    for symbol in scene.pose.symbols.iter() {
        let Key::Constraint(id) = symbol.key else { continue };
        let Some(amount) = left.remove(&id) else { continue };
        let points = symbol.points();
        let n = points.len().max(1) as f64;
        let middle =
            points.iter().fold(Point::ORIGIN, |sum, &p| sum + canvas.px(p).to_vector() / n);
        canvas.begin(Key::Legend, false, Some(symbol.name.clone()));
        canvas.figure(Layer::Legend, Placement::at(middle)).text(
            Class::Amount,
            Point::new(0.0, -RISE),
            amount,
        );
    }
}
