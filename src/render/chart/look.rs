//! How lines are told apart: by colour, dash and mark at once.

use std::fmt::Write;

use super::labels::Spot;

/// The look of one line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    /// The colour of the line.
    pub line: &'static str,
    /// A darker one of the same hue, for text.
    pub ink: &'static str,
    dash: &'static str,
    mark: Shape,
}

#[derive(Debug, Clone, Copy)]
enum Shape {
    Disc,
    Square,
    Triangle,
    Diamond,
    Ring,
    Cross,
    Down,
    Box,
}

/// Colours that stay apart for colour-blind eyes (M. Okabe and K. Ito, Color Universal Design,
/// 2008), its yellow, too pale on paper, replaced by a grey.
const LOOKS: [Look; 8] = [
    Look { line: "#000000", ink: "#000000", dash: "", mark: Shape::Disc },
    Look { line: "#d55e00", ink: "#a84a00", dash: "", mark: Shape::Square },
    Look { line: "#e69f00", ink: "#8f6300", dash: "9 3", mark: Shape::Triangle },
    Look { line: "#cc79a7", ink: "#a1487a", dash: "2 3", mark: Shape::Diamond },
    Look { line: "#0072b2", ink: "#005a8c", dash: "", mark: Shape::Ring },
    Look { line: "#009e73", ink: "#00704f", dash: "6 3 2 3", mark: Shape::Cross },
    Look { line: "#56b4e9", ink: "#22739f", dash: "12 4", mark: Shape::Down },
    Look { line: "#7f7f7f", ink: "#5a5a5a", dash: "4 2", mark: Shape::Box },
];

/// A length on the page: a tenth of a px is finer than any printer.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.1}");
    match text.strip_suffix(".0") {
        Some("-0") => "0".to_owned(),
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

impl Look {
    /// The look of this number; they repeat after eight.
    pub const fn of(k: usize) -> Self {
        LOOKS[k % LOOKS.len()]
    }

    pub fn draw_line(&self, spots: &[Spot], svg: &mut String) {
        if spots.len() < 2 {
            return;
        }
        let mut path = String::new();
        for (k, spot) in spots.iter().enumerate() {
            let command = if k == 0 { 'M' } else { 'L' };
            // Writing to a string cannot fail.
            let _ = write!(path, "{command}{} {}", number(spot.x), number(spot.y));
        }
        let dash = if self.dash.is_empty() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", self.dash)
        };
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" stroke=\"{}\" stroke-width=\"1.8\" stroke-linejoin=\"round\"{dash} \
             fill=\"none\"/>",
            self.line
        );
    }

    pub fn draw_mark(&self, at: Spot, scale: f64, svg: &mut String) {
        let r = 3.6 * scale;
        let n = |x: f64, y: f64| format!("{} {}", number(at.x + x * r), number(at.y + y * r));
        let closed = |corners: &[(f64, f64)]| {
            let corners: Vec<String> = corners.iter().map(|&(x, y)| n(x, y)).collect();
            format!("M{}Z", corners.join("L"))
        };
        let square = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
        let (path, is_filled) = match self.mark {
            Shape::Disc | Shape::Ring => {
                let is_filled = matches!(self.mark, Shape::Disc);
                let fill = if is_filled { self.line } else { "#fff" };
                let _ = writeln!(
                    svg,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\" stroke=\"{}\" \
                     stroke-width=\"1.6\"/>",
                    number(at.x),
                    number(at.y),
                    number(r),
                    self.line
                );
                return;
            }
            Shape::Square => (closed(&square), true),
            Shape::Box => (closed(&square), false),
            Shape::Triangle => (closed(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), true),
            Shape::Down => (closed(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]), false),
            Shape::Diamond => (closed(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]), true),
            Shape::Cross => {
                let arms = [n(-1.0, -1.0), n(1.0, 1.0), n(-1.0, 1.0), n(1.0, -1.0)];
                (format!("M{}L{}M{}L{}", arms[0], arms[1], arms[2], arms[3]), false)
            }
        };
        let fill = match (self.mark, is_filled) {
            (Shape::Cross, _) => "none",
            (_, true) => self.line,
            (_, false) => "#fff",
        };
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"1.6\"/>",
            self.line
        );
    }
}
