//! Parts as DXF: lines, arcs and circles of release 12, which every cutter reads.

use std::fmt::Write;

use super::notation::PLACES;
use super::rounded::Stretch;
use super::sheet::Placed;
use crate::constraint::Point;
use crate::diag::format_decimals;
use crate::interrupt::tick;

/// What the writing of a group takes, in ticks.
const GROUP: usize = 50;

/// A file of group codes and values, a line each.
struct Groups(String);

impl Groups {
    fn word(&mut self, code: u16, word: &str) {
        tick(GROUP);
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{code}\n{word}");
    }

    fn number(&mut self, code: u16, value: f64) {
        let text = format_decimals(value, PLACES);
        self.word(code, &text);
    }

    fn place(&mut self, code: u16, p: Point) {
        self.number(code, p.x);
        self.number(code + 10, p.y);
    }
}

/// Parts on their sheet, in mm: outlines on the layer `outline`, holes on the layer `hole`.
pub fn dxf(sheet: &Placed) -> String {
    let mut file = Groups("999\nlinkwork\n".to_owned());
    for (code, word) in [
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1009"),
        (9, "$INSUNITS"),
        (70, "4"),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "TABLES"),
        (0, "TABLE"),
        (2, "LAYER"),
        (70, "2"),
    ] {
        file.word(code, word);
    }
    for (layer, colour) in [("outline", "7"), ("hole", "5")] {
        for (code, word) in [(0, "LAYER"), (2, layer), (70, "0"), (62, colour), (6, "CONTINUOUS")] {
            file.word(code, word);
        }
    }
    for (code, word) in [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")] {
        file.word(code, word);
    }
    for part in &sheet.parts {
        for stretch in part.outline.stretches() {
            draw(&mut file, stretch, part.outline.radius);
        }
        for &hole in &part.holes {
            circle(&mut file, "hole", hole, part.hole_radius);
        }
    }
    file.word(0, "ENDSEC");
    file.word(0, "EOF");
    file.0
}

fn draw(file: &mut Groups, stretch: Stretch, radius: f64) {
    match stretch {
        Stretch::Line { from, to } => {
            file.word(0, "LINE");
            file.word(8, "outline");
            file.place(10, from);
            file.place(11, to);
        }
        Stretch::Arc { centre, angles: [from, to] } if to - from < std::f64::consts::TAU => {
            file.word(0, "ARC");
            file.word(8, "outline");
            file.place(10, centre);
            file.number(40, radius);
            for (code, angle) in [(50, from), (51, to)] {
                file.number(code, angle.to_degrees().rem_euclid(360.0));
            }
        }
        Stretch::Arc { centre, .. } => circle(file, "outline", centre, radius),
    }
}

fn circle(file: &mut Groups, layer: &str, centre: Point, radius: f64) {
    file.word(0, "CIRCLE");
    file.word(8, layer);
    file.place(10, centre);
    file.number(40, radius);
}
