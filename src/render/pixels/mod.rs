//! Documents of this room in pixels, for who shows them on the spot.
//!
//! Drawings and charts are documents first, so what is shown here is what they write: read again
//! (`markup`), flattened (`outline`, `letters`), and filled with the shares of pixels that are covered
//! (`coverage`).

mod coverage;
mod image;
mod letters;
mod markup;
mod outline;

use std::ops::Range;

use coverage::{Coverage, Rule};
use image::Paint;
pub use image::Pixels;
use letters::Font;
use markup::{Element, Look, Part};
use outline::{Contour, Transform};

use crate::interrupt::tick;

/// The longest side of a picture, pixels.
const MOST: f64 = 8192.0;

/// What the drawing of a line to a place takes, in ticks.
const PLACE: usize = 100;

/// Bytes of a picture that are copied, or looked at, in a tick.
const COPIED: usize = 8;

/// How much wider the strokes of bold letters are, in sizes of letters.
const BOLD: f64 = 0.05;

impl Pixels {
    /// A document that this room wrote, as large as fits into a box of pixels.
    ///
    /// ```
    /// use linkwork::render::{Options, Pixels, Scene, svg};
    /// use linkwork::Session;
    ///
    /// let mut session = Session::new();
    /// session.run("point A = (0, 0), B = (4, 0); length A B")?;
    /// let picture = svg(&Scene::new(session.world()), &Options::default());
    /// let pixels = Pixels::of(&picture, [400, 300]);
    /// assert_eq!(pixels.size()[0], 400);
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub fn of(svg: &str, most: [usize; 2]) -> Self {
        let document = markup::read(svg);
        let [width, height] = document.size;
        let fits = (most[0] as f64 / width).min(most[1] as f64 / height);
        let scale = fits.min(MOST / width.max(height));
        let side = |px: f64| ((px * scale).round() as usize).max(1);
        let (width, height) = (side(width), side(height));
        let mut canvas = Canvas {
            pixels: Self::white(width, height),
            coverage: Coverage::new(width, height),
            contours: Vec::new(),
            groups: Vec::new(),
        };
        let all = Transform::scaling(scale);
        document.visit(&mut |part| match part {
            Part::Begin(opacity) => canvas.begin(opacity),
            Part::Shape(element, look) => canvas.draw(element, look, all),
            Part::End => canvas.end(),
        });
        canvas.pixels
    }
}

/// What is drawn on.
struct Canvas {
    pixels: Pixels,
    coverage: Coverage,
    /// Room for those of one shape.
    contours: Vec<Contour>,
    /// Those that let through what lies below them, outermost first.
    groups: Vec<Faded>,
}

/// A group that lets through what lies below it.
struct Faded {
    below: Pixels,
    opacity: f32,
    /// Those of its rows that were painted.
    rows: Range<usize>,
}

impl Canvas {
    fn begin(&mut self, opacity: f32) {
        tick(self.pixels.rgb().len() / COPIED);
        let rows = self.pixels.size()[1]..0;
        self.groups.push(Faded { below: self.pixels.clone(), opacity, rows });
    }

    fn end(&mut self) {
        if let Some(Faded { below, opacity, rows }) = self.groups.pop() {
            self.pixels.lie_over(&below, opacity, rows.clone());
            self.note(&rows);
        }
    }

    /// Notes that rows were painted.
    fn note(&mut self, rows: &Range<usize>) {
        if let Some(group) = self.groups.last_mut() {
            group.rows = group.rows.start.min(rows.start)..group.rows.end.max(rows.end);
        }
    }

    fn paint(&mut self, rgb: [u8; 3], opacity: f32, rule: Rule) {
        let rows = self.coverage.paint(Paint { rgb, opacity }, rule, &mut self.pixels);
        self.note(&rows);
    }

    fn draw(&mut self, element: &Element, look: &Look, page: Transform) {
        let transform = page.after(look.transform);
        match element {
            Element::Rectangle { width, height } => {
                self.contours = vec![outline::rectangle(*width, *height)];
            }
            Element::Circle { centre, radius } => {
                self.contours = vec![outline::circle(*centre, *radius, transform.scale())];
            }
            Element::Path(data) => self.contours = outline::path(data, transform.scale()),
            Element::Text { at, runs } => {
                self.contours = Font::of(look.is_italic).outlines(runs, *at, look.anchor);
            }
        }
        self.contours.iter_mut().for_each(|contour| contour.place(transform));
        let rule = if look.is_even_odd { Rule::EvenOdd } else { Rule::NonZero };
        let is_text = matches!(element, Element::Text { .. });
        if is_text && let Some(rgb) = look.stroke {
            self.stroke(rgb, look.width, look, transform);
        }
        if let Some(rgb) = look.fill {
            for contour in &self.contours {
                self.coverage.add(&contour.points);
            }
            self.paint(rgb, look.opacity, rule);
            if is_text && look.is_bold {
                self.stroke(rgb, BOLD * look.size, look, transform);
            }
        }
        if !is_text && let Some(rgb) = look.stroke {
            self.stroke(rgb, look.width, look, transform);
        }
    }

    fn stroke(&mut self, rgb: [u8; 3], width: f64, look: &Look, transform: Transform) {
        let scale = transform.scale();
        let half = 0.5 * width * scale;
        for contour in &self.contours {
            tick(PLACE * contour.points.len());
            let dash = look.dash.iter().map(|dash| dash * scale).collect::<Vec<f64>>();
            outline::stroke(contour, half, &dash, &mut |piece| self.coverage.add_convex(piece));
        }
        self.paint(rgb, look.opacity, Rule::NonZero);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(inside: &str, side: usize) -> Pixels {
        let svg = format!("<svg width=\"10\" height=\"10\">\n{inside}\n</svg>\n");
        Pixels::of(&svg, [side, side])
    }

    fn at(pixels: &Pixels, x: usize, y: usize) -> [u8; 3] {
        let [width, _] = pixels.size();
        pixels.rgb()[3 * (y * width + x)..][..3].try_into().expect("a pixel")
    }

    /// How dark a picture is altogether, in pixels of black.
    fn ink(pixels: &Pixels) -> f64 {
        pixels.rgb().iter().map(|&byte| 1.0 - f64::from(byte) / 255.0).sum::<f64>() / 3.0
    }

    #[test]
    fn areas_are_those_of_their_shapes() {
        let check = |inside: &str, area: f64| {
            let found = ink(&picture(inside, 100)) / 100.0;
            assert!((found - area).abs() < 0.005 * area.max(1.0), "{inside}: {found}, not {area}");
        };
        check("<circle cx=\"5\" cy=\"5\" r=\"3\" fill=\"#000\"/>", 9.0 * std::f64::consts::PI);
        check("<path d=\"M1 1L7 1 7 4Z\" fill=\"#000000\"/>", 9.0);
        check("<path d=\"M2 2H8V8H2Z\" fill=\"none\" stroke=\"#000\" stroke-width=\"0\"/>", 0.0);
        // A line with round ends.
        let ends = std::f64::consts::PI;
        check(
            "<path d=\"M2 5L7 5\" stroke=\"#000\" stroke-width=\"2\" fill=\"none\"/>",
            10.0 + ends,
        );
        // Dashes of 1 with gaps of 1, ends included: each dash is round.
        let dashed = "<path d=\"M1 5L9 5\" stroke=\"#000\" stroke-width=\"0.5\" \
                      stroke-dasharray=\"1 1\" fill=\"none\"/>";
        check(dashed, 4.0 * (0.5 + ends / 16.0));
        // An arc of three quarters and its chord.
        let arc =
            "<g transform=\"translate(5 5)\"><path d=\"M4 0A4 4 0 1 1 0 -4Z\" fill=\"#000\"/></g>";
        check(arc, 0.75 * 16.0 * ends + 8.0);
        // A ring.
        let ring = "<path d=\"M1 1H9V9H1ZM3 3H7V7H3Z\" fill=\"#000\" fill-rule=\"evenodd\"/>";
        check(ring, 48.0);
    }

    #[test]
    fn styles_come_from_the_sheet_and_the_groups_above() {
        let sheet = "<style>\npath,circle{stroke-linecap:round}\n.a{fill:#ff0000}\n\
                     .b circle{fill:#0000ff}\n</style>";
        let shapes = "<circle class=\"a\" cx=\"2\" cy=\"2\" r=\"1\"/>\
                      <g class=\"b\" transform=\"translate(6 6)rotate(90)\">\
                      <circle class=\"a\" cx=\"1\" cy=\"0\" r=\"1\"/></g>\
                      <g opacity=\"0.5\"><circle class=\"a\" cx=\"8\" cy=\"2\" r=\"1\"/></g>";
        let fine = picture(&format!("{sheet}{shapes}"), 100);
        assert_eq!(at(&fine, 20, 20), [255, 0, 0]);
        assert_eq!(at(&fine, 60, 70), [0, 0, 255]);
        assert_eq!(at(&fine, 80, 20), [255, 128, 128]);
    }

    #[test]
    fn a_group_is_opaque_as_a_whole() {
        let discs = "<g opacity=\"0.5\"><circle cx=\"4\" cy=\"5\" r=\"2\" fill=\"#0000ff\"/>\
                     <circle cx=\"6\" cy=\"5\" r=\"2\" fill=\"#ff0000\"/></g>";
        let pixels = picture(discs, 100);
        // The blue disc is not seen through the red one.
        assert_eq!(at(&pixels, 50, 50), [255, 128, 128]);
        assert_eq!(at(&pixels, 30, 50), [128, 128, 255]);
        let twice = picture(&format!("<g opacity=\"0.5\">{discs}</g>"), 100);
        assert_eq!(at(&twice, 50, 50), [255, 192, 192]);
        assert_eq!(at(&twice, 50, 90), [255; 3]);
    }

    #[test]
    fn bold_letters_have_more_ink() {
        let text = |weight: &str| {
            let text =
                "<text x=\"5\" y=\"8\" font-size=\"8\" text-anchor=\"middle\" fill=\"#000\">";
            picture(&format!("{text}<tspan{weight}>H</tspan></text>"), 200)
        };
        let [plain, bold] = ["", " font-weight=\"bold\""].map(|weight| ink(&text(weight)));
        assert!(bold > 1.3 * plain && bold < 2.0 * plain, "{plain} and {bold}");
    }

    #[test]
    fn letters_stand_where_they_are_written() {
        let text = |anchor: &str| {
            format!(
                "<text x=\"5\" y=\"8\" font-size=\"8\" text-anchor=\"{anchor}\" fill=\"#000\">I&lt;I</text>"
            )
        };
        let columns = |pixels: &Pixels| {
            let is_dark = |x: &usize| (0..100).any(|y| at(pixels, *x, y)[0] < 100);
            let all: Vec<usize> = (0..100).filter(is_dark).collect();
            (*all.first().expect("letters"), *all.last().expect("letters"))
        };
        let (left, right) = columns(&picture(&text("middle"), 100));
        assert!((95..105).contains(&(left + right)), "{left}..{right}");
        assert!(columns(&picture(&text("start"), 100)).0 >= 50);
        assert!(columns(&picture(&text("end"), 100)).1 <= 50);
    }

    #[test]
    fn nothing_is_drawn_outside_and_nothing_fails() {
        let far = "<circle cx=\"1e9\" cy=\"-1e9\" r=\"1e9\" fill=\"#000\"/>\
                   <path d=\"M-1e12 5L1e12 5\" stroke=\"#000\" stroke-width=\"2\" \
                   stroke-dasharray=\"1 1\" fill=\"none\"/>";
        let pixels = picture(far, 50);
        assert_eq!(pixels.size(), [50, 50]);
        assert_eq!(at(&pixels, 25, 45), [255, 255, 255]);
    }
}
