//! How lines are told apart: by colour, dash and marker at once.

use super::sheet::{Sheet, Stroke, polyline};
use crate::constraint::Point;

/// The look of one line.
#[derive(Debug, Clone, Copy)]
pub struct SeriesLook {
    colour: &'static str,
    /// A darker one of the same hue, for text.
    pub text_colour: &'static str,
    dash: &'static str,
    marker: Marker,
}

#[derive(Debug, Clone, Copy)]
enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Ring,
    Cross,
    Down,
    Box,
}

const fn look(
    colour: &'static str,
    text_colour: &'static str,
    dash: &'static str,
    marker: Marker,
) -> SeriesLook {
    SeriesLook { colour, text_colour, dash, marker }
}

/// Colours that stay apart for colour-blind eyes (M. Okabe and K. Ito, Color Universal Design,
/// 2008), its yellow, too pale on paper, replaced by a grey.
const LOOKS: [SeriesLook; 8] = [
    look("#000000", "#000000", "", Marker::Disc),
    look("#d55e00", "#a84a00", "", Marker::Square),
    look("#e69f00", "#8f6300", "9 3", Marker::Triangle),
    look("#cc79a7", "#a1487a", "2 3", Marker::Diamond),
    look("#0072b2", "#005a8c", "", Marker::Ring),
    look("#009e73", "#00704f", "6 3 2 3", Marker::Cross),
    look("#56b4e9", "#22739f", "12 4", Marker::Down),
    look("#7f7f7f", "#5a5a5a", "4 2", Marker::Box),
];

/// The colour of paper, within a hollow marker.
const PAPER: &str = "#fff";

impl SeriesLook {
    /// The look of this number; they repeat after eight.
    pub const fn of(k: usize) -> Self {
        LOOKS[k % LOOKS.len()]
    }

    /// Draws a line through some places; a single one gives none.
    pub fn draw_line(&self, places: &[Point], sheet: &mut Sheet) {
        if places.len() >= 2 {
            let stroke =
                Stroke { colour: self.colour, width: 1.8, is_round: true, dash: self.dash };
            sheet.line(&polyline(places), stroke);
        }
    }

    /// Draws a marker at a place.
    pub fn draw_marker(&self, at: Point, scale: f64, sheet: &mut Sheet) {
        const SQUARE: [(f64, f64); 4] = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
        let r = 3.6 * scale;
        let place = |(x, y): (f64, f64)| Point::new(at.x + x * r, at.y + y * r);
        let closed = |corners: &[(f64, f64)]| {
            let corners: Vec<Point> = corners.iter().copied().map(place).collect();
            format!("{}Z", polyline(&corners))
        };
        let stroke = |from, to| polyline(&[place(from), place(to)]);
        let (path, fill) = match self.marker {
            Marker::Disc => return sheet.round_mark(at, r, self.colour, self.colour),
            Marker::Ring => return sheet.round_mark(at, r, PAPER, self.colour),
            Marker::Square => (closed(&SQUARE), self.colour),
            Marker::Box => (closed(&SQUARE), PAPER),
            Marker::Triangle => (closed(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), self.colour),
            Marker::Down => (closed(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]), PAPER),
            Marker::Diamond => {
                (closed(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]), self.colour)
            }
            Marker::Cross => {
                (stroke((-1.0, -1.0), (1.0, 1.0)) + &stroke((-1.0, 1.0), (1.0, -1.0)), "none")
            }
        };
        sheet.mark(&path, fill, self.colour);
    }
}
