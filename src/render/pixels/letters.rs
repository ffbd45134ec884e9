//! Letters as outlines; the only file that knows the crate `ttf_parser`.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::markup::{Anchor, Run};
use super::outline::{Contour, bend};
use crate::constraint::{Point, Vector};

/// A font.
pub struct Font {
    face: Option<Face<'static>>,
}

static UPRIGHT: LazyLock<Font> =
    LazyLock::new(|| Font::read(include_bytes!("../../../fonts/Arimo-Regular.ttf")));
static ITALIC: LazyLock<Font> =
    LazyLock::new(|| Font::read(include_bytes!("../../../fonts/Arimo-Italic.ttf")));

impl Font {
    fn read(bytes: &'static [u8]) -> Self {
        Self { face: Face::parse(bytes, 0).ok() }
    }

    /// The font of drawings.
    pub fn of(is_italic: bool) -> &'static Self {
        if is_italic { &ITALIC } else { &UPRIGHT }
    }

    /// The outlines of a text on a base line at a place.
    pub fn outlines(&self, runs: &[Run], at: Point, anchor: Anchor) -> Vec<Contour> {
        let Some(face) = &self.face else { return Vec::new() };
        let unit = |run: &Run| run.size / f64::from(face.units_per_em());
        let glyph = |c: char| face.glyph_index(c).or_else(|| face.glyph_index('\u{fffd}'));
        let glyphs = |run: &Run| -> Vec<GlyphId> {
            run.text.chars().map(|c| glyph(c).unwrap_or_default()).collect()
        };
        let advance = |glyph| f64::from(face.glyph_hor_advance(glyph).unwrap_or_default());
        let width = |run: &Run| glyphs(run).into_iter().map(advance).sum::<f64>() * unit(run);
        let share = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        };
        let left = share * runs.iter().map(width).sum::<f64>();
        let mut writer =
            Writer { at: at - Vector::new(left, 0.0), unit: 1.0, contours: Vec::new() };
        for run in runs {
            writer.at.y = at.y + run.drop;
            writer.unit = unit(run);
            for glyph in glyphs(run) {
                face.outline_glyph(glyph, &mut writer);
                writer.at.x += advance(glyph) * writer.unit;
            }
        }
        writer.contours
    }
}

/// Takes the outlines of letters one after the other.
struct Writer {
    at: Point,
    unit: f64,
    contours: Vec<Contour>,
}

/// Letters are small: a few straight parts a bend are enough.
const SCALE: f64 = 2.0;

impl Writer {
    fn place(&self, x: f32, y: f32) -> Point {
        self.at + Vector::new(f64::from(x), -f64::from(y)) * self.unit
    }

    fn add(&mut self, p: Point) {
        if let Some(contour) = self.contours.last_mut() {
            contour.points.push(p);
        }
    }

    fn pen(&self) -> Point {
        self.contours.last().and_then(|contour| contour.points.last()).copied().unwrap_or_default()
    }
}

impl OutlineBuilder for Writer {
    fn move_to(&mut self, x: f32, y: f32) {
        self.contours.push(Contour { points: vec![self.place(x, y)], is_closed: true });
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add(self.place(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (pen, control, end) = (self.pen(), self.place(x1, y1), self.place(x, y));
        bend(pen, control, end, SCALE, &mut |p| self.add(p));
    }

    fn curve_to(&mut self, _: f32, _: f32, x2: f32, y2: f32, x: f32, y: f32) {
        // Fonts of this sort have none; a bend is near enough.
        self.quad_to(x2, y2, x, y);
    }

    fn close(&mut self) {}
}
