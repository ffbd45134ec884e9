//! The legend below a drawing: a scale, and which colour is whose path.

use super::canvas::Canvas;
use super::figure::{Key, Layer, Placement};
use super::labels::text_width;
use super::page::{LEGEND_HEIGHT, Page};
use super::path::Path;
use super::style::{BASE_LINE, CAPTION, Class};
use super::trace::Curve;
use crate::constraint::Point;
use crate::diag::format_number;

/// From the edge of the page, px.
const EDGE: f64 = 20.0;
/// The longest scale, px.
const LONGEST: f64 = 140.0;
/// A sample of a path's line, px.
const SAMPLE: f64 = 22.0;
/// From a sample to its name, and half of that from one entry to the next, px.
const GAP: f64 = 7.0;

/// Draws the legend.
pub fn draw(canvas: &mut Canvas, curves: &[Curve]) {
    let page = *canvas.page;
    if page.is_empty() {
        return;
    }
    canvas.begin(Key::Legend, false, None);
    let (width, height) = page.size();
    let middle = height + 0.5 * LEGEND_HEIGHT - 4.0;
    let free = draw_scale(canvas, &page, middle);
    // One path needs no legend: there is nothing to tell it from, unless it has a name of its own.
    if curves.len() > 1 || curves.iter().any(|curve| curve.is_named) {
        draw_legend(canvas, curves, middle, width - EDGE - free - 3.0 * GAP);
    }
}

/// Draws the scale on the left; gives how far it reaches, px.
fn draw_scale(canvas: &mut Canvas, page: &Page, middle: f64) -> f64 {
    let Some(length) = round_length(LONGEST / page.scale()) else {
        return EDGE;
    };
    let (px, tick) = (page.length(length), 3.5);
    let mut line = Path::polyline(
        [(0.0, -tick), (0.0, 0.0), (px, 0.0), (px, -tick)].map(|(x, y)| Point::new(x, y)),
    );
    line.move_to(Point::new(0.5 * px, 0.0)).line_to(Point::new(0.5 * px, -0.6 * tick));
    let text = format_number(length);
    let reach = EDGE + px + GAP + text_width(&text) * CAPTION;
    canvas
        .figure(Layer::Legend, Placement::at(Point::new(EDGE, middle)))
        .path(Class::Scale, line)
        .text(Class::Caption, Point::new(px + GAP, BASE_LINE * CAPTION), text.into());
    reach
}

/// The largest of 1, 2, 5, 10, 20, ... (or 0.5, 0.2, ...) not above `most`.
fn round_length(most: f64) -> Option<f64> {
    let exponent = libm::log10(most).floor();
    if !exponent.is_finite() {
        return None;
    }
    // Written and read, so that it is the number the text says.
    let candidate = |digit: u8| format!("{digit}e{exponent}").parse::<f64>().ok();
    [5, 2, 1].into_iter().filter_map(candidate).find(|length| *length > 0.0 && *length <= most)
}

/// Draws as much of the legend as `free` px hold, to the right edge.
fn draw_legend(canvas: &mut Canvas, curves: &[Curve], middle: f64, free: f64) {
    let entry = |name: &str| SAMPLE + GAP + text_width(name) * CAPTION + 2.0 * GAP;
    let more = |n: usize| format!("+{n}");
    let total = |n: usize| -> f64 {
        let rest =
            if n < curves.len() { text_width(&more(curves.len() - n)) * CAPTION } else { 0.0 };
        curves[..n].iter().map(|curve| entry(&curve.name)).sum::<f64>() + rest
    };
    // No entry is shorter than a nameless one: beyond so many there is no room.
    let most = curves.len().min((free / entry("")) as usize);
    let n_shown = (0..=most).rev().find(|&n| total(n) <= free).unwrap_or(0);
    let mut x = canvas.page.size().0 - EDGE - total(n_shown) + 2.0 * GAP;
    let base_line = BASE_LINE * CAPTION;
    for curve in &curves[..n_shown] {
        canvas
            .figure(Layer::Legend, Placement::at(Point::new(x, middle)))
            .path(curve.class(), Path::along_x(0.0, SAMPLE))
            .text(Class::Caption, Point::new(SAMPLE + GAP, base_line), curve.name.clone());
        x += entry(&curve.name);
    }
    if n_shown < curves.len() {
        canvas.figure(Layer::Legend, Placement::at(Point::new(x, middle))).text(
            Class::Caption,
            Point::new(0.0, base_line),
            more(curves.len() - n_shown).into(),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        let check = |most: f64, wanted: f64| assert_eq!(round_length(most), Some(wanted));
        check(1.0, 1.0);
        check(0.99, 0.5);
        check(7.3, 5.0);
        check(3.4e-9, 2e-9);
        check(1.9e12, 1e12);
        assert_eq!(round_length(0.0), None);
        assert_eq!(round_length(f64::INFINITY), None);
    }
}
