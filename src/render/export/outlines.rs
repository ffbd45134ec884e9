//! Parts on a sheet as SVG, for cutters.

use std::fmt::Write;

use super::notation::{PLACES, escaped};
use super::rounded::{Rounded, Stretch};
use super::sheet::Placed;
use crate::constraint::{Point, Vector};
use crate::diag::format_decimals;
use crate::interrupt::tick;
use crate::render::FIRST_WORDS;

/// What the writing of an arc takes, in ticks.
const ARC: usize = 200;

/// The parts on their sheet, one path each.
pub fn outlines(sheet: &Placed) -> String {
    let number = |value: f64| format_decimals(value, PLACES);
    let [width, height] = sheet.size.map(number);
    let mut text = format!(
        "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" \
         height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <g id=\"parts\" fill=\"none\" stroke=\"#ff0000\" stroke-width=\"0.1\">\n"
    );
    // On a page y points down.
    let point = |p: Point| format!("{} {}", number(p.x), number(sheet.size[1] - p.y));
    for part in &sheet.parts {
        let name = escaped(&part.name);
        tick(ARC * (part.outline.corners.len() + 3 * part.holes.len()));
        let _ = write!(text, "<path d=\"{}", outline_data(&part.outline, &point));
        for &hole in &part.holes {
            text.push_str(&circle_data(hole, part.hole_radius, &point));
        }
        let _ = writeln!(text, "\"><title>{name}</title></path>");
    }
    text.push_str("</g>\n</svg>\n");
    text
}

fn outline_data(outline: &Rounded, point: &dyn Fn(Point) -> String) -> String {
    let stretches = outline.stretches();
    let radius = format_decimals(outline.radius, PLACES);
    if let [Stretch::Arc { centre, .. }] = stretches[..] {
        return circle_data(centre, outline.radius, point);
    }
    let mut data = String::new();
    for stretch in &stretches {
        match *stretch {
            Stretch::Line { to, .. } => data.extend(["L", &point(to)]),
            Stretch::Arc { centre, angles: [from, to] } => {
                let [from, to] =
                    [from, to].map(|angle| point(centre + Vector::polar(outline.radius, angle)));
                if data.is_empty() {
                    data.extend(["M", &from]);
                }
                data.extend(["A", &radius, " ", &radius, " 0 0 0 ", &to]);
            }
        }
    }
    data + "Z"
}

fn circle_data(centre: Point, radius: f64, point: &dyn Fn(Point) -> String) -> String {
    let [a, b, c] = [0.0, 1.0, 2.0]
        .map(|third| point(centre + Vector::polar(radius, third * std::f64::consts::TAU / 3.0)));
    let r = format_decimals(radius, PLACES);
    format!("M{a}A{r} {r} 0 0 0 {b}A{r} {r} 0 0 0 {c}A{r} {r} 0 0 0 {a}Z")
}
