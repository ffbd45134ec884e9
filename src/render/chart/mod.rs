//! Line charts with linear or logarithmic axes, as SVG; the same data, the same bytes.
//!
//! A chart is meant for print and for colour-blind eyes: every line has a colour, a dash and a
//! mark of its own, its name stands at its end and in the legend, and no label covers another.
//!
//! ```
//! use linkwork::render::chart::{Axis, Chart, Mark, Series, Unit};
//!
//! let axis = |label: &str, is_log| Axis { label: label.into(), is_log, unit: Unit::None };
//! let mark = |x, y| Mark { x, y, label: None, is_notable: false };
//! let line = Series { name: "halving".into(), look: 0, marks: vec![mark(0.0, 1.0), mark(1.0, 0.5)] };
//! let chart = Chart {
//!     title: "An error that is halved".into(),
//!     x: axis("iteration", false),
//!     y: axis("error", true),
//!     series: vec![line],
//!     ..Chart::default()
//! };
//! assert!(chart.svg().starts_with("<svg"));
//! ```

mod axis;
mod labels;
mod look;

use std::fmt::Write;

use axis::Scale;
pub use axis::{Axis, Unit};
use labels::{Anchor, Labels, Spot, Wording};
use look::Look;

/// A chart as plain data.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// Above the chart.
    pub title: String,
    /// Below the title, smaller; may be empty.
    pub subtitle: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// The lines.
    pub series: Vec<Series>,
    /// The efficient places, from left to right: a broad step line beneath the others.
    pub frontier: Vec<(f64, f64)>,
    /// Below the chart; may be empty.
    pub note: String,
}

/// One line.
#[derive(Debug, Clone)]
pub struct Series {
    /// What it shows.
    pub name: String,
    /// Which of the looks it has; lines of one look cannot be told apart.
    pub look: usize,
    /// Its places, in order.
    pub marks: Vec<Mark>,
}

/// One place of a line.
#[derive(Debug, Clone)]
pub struct Mark {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// Written beside it where there is room.
    pub label: Option<String>,
    /// Is it to be emphasised?
    pub is_notable: bool,
}

/// The width of the part left of the legend.
const BODY: f64 = 722.0;
const HEIGHT: f64 = 560.0;
const LEFT: f64 = 88.0;
/// What the legend needs besides its longest name, and at least.
const LEGEND: f64 = 74.0;
const LEAST_LEGEND: f64 = 138.0;
const TOP: f64 = 66.0;
/// Where the lower axis lies.
const FLOOR: f64 = HEIGHT - 74.0;
/// Sizes of letters, px.
const TITLE: f64 = 17.0;
const TEXT: f64 = 13.0;
const SMALL: f64 = 11.0;
const TINY: f64 = 9.5;
/// Marks without labels stand at least this far apart.
const MARK_GAP: f64 = 26.0;

impl Chart {
    /// The chart as an SVG document.
    pub fn svg(&self) -> String {
        let plot = Plot::new(self);
        let mut svg = String::new();
        let width = look::number(BODY + self.legend_width());
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {HEIGHT}\" \
             width=\"{width}\" height=\"{HEIGHT}\" \
             font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n\
             <title>{}</title>\n<rect width=\"{width}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n",
            escaped(&self.title)
        );
        text(&mut svg, LEFT, 28.0, TITLE, "start", "#111", &self.title, true);
        text(&mut svg, LEFT, 48.0, SMALL, "start", "#555", &self.subtitle, false);
        text(&mut svg, LEFT, HEIGHT - 14.0, SMALL, "start", "#555", &self.note, false);
        plot.draw_grid(self, &mut svg);
        plot.draw_frontier(self, &mut svg);
        let lines: Vec<Line> = self.series.iter().map(|series| plot.line(series)).collect();
        for line in &lines {
            line.draw(&mut svg);
        }
        self.draw_labels(&lines, &mut svg);
        self.draw_legend(&lines, &mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    fn legend_width(&self) -> f64 {
        let names = self.series.iter().map(|series| labels::width(&series.name, TEXT));
        names.fold(0.0, f64::max).ceil().max(LEAST_LEGEND - LEGEND) + LEGEND
    }

    fn draw_labels(&self, lines: &[Line], svg: &mut String) {
        let mut labels = Labels::within(LEFT, TOP, BODY, FLOOR);
        for line in lines {
            line.stretches.iter().for_each(|stretch| labels.avoid_line(stretch));
            line.marked().for_each(|(spot, _)| labels.avoid_mark(spot));
        }
        let marked = || {
            let of = |line: &Line| {
                let look = line.look;
                line.marked()
                    .map(move |(spot, mark)| (spot, mark.clone(), look))
                    .collect::<Vec<_>>()
            };
            lines.iter().flat_map(of)
        };
        for (spot, mark, look) in marked().filter(|(_, mark, _)| mark.is_notable) {
            if let Some(text) = &mark.label {
                let wording = Wording { text, size: SMALL, is_bold: true, colour: look.ink };
                labels.place(spot, wording, Anchor::Near, true, svg);
            }
        }
        for (line, series) in lines.iter().zip(&self.series) {
            if let Some(&end) = line.stretches.last().and_then(|stretch| stretch.last()) {
                let (text, colour) = (&*series.name, line.look.ink);
                let wording = Wording { text, size: TEXT, is_bold: true, colour };
                labels.place(end, wording, Anchor::End, true, svg);
            }
        }
        for (spot, mark, look) in marked().filter(|(_, mark, _)| !mark.is_notable) {
            if let Some(text) = &mark.label {
                let wording = Wording { text, size: TINY, is_bold: false, colour: look.ink };
                labels.place(spot, wording, Anchor::Near, false, svg);
            }
        }
    }

    fn draw_legend(&self, lines: &[Line], svg: &mut String) {
        let x = BODY + 20.0;
        let mut y = TOP + 8.0;
        for (line, series) in lines.iter().zip(&self.series) {
            let ends = [Spot { x, y }, Spot { x: x + 30.0, y }];
            line.look.draw_line(&ends, svg);
            line.look.draw_mark(Spot { x: x + 15.0, y }, 1.0, svg);
            text(svg, x + 38.0, y + 4.5, TEXT, "start", "#222", &series.name, false);
            y += 22.0;
        }
        if !self.frontier.is_empty() {
            y += 4.0;
            let (left, right) = (look::number(x), look::number(x + 30.0));
            let _ = writeln!(
                svg,
                "<path d=\"M{left} {y}H{right}\" stroke=\"#c9c9c9\" stroke-width=\"9\" fill=\"none\"/>",
                y = look::number(y)
            );
            text(svg, x + 38.0, y + 4.5, TEXT, "start", "#222", "efficient", false);
        }
    }
}

/// Where the data lie on the page.
struct Plot {
    x: Scale,
    y: Scale,
}

/// A line on the page; data that have no place on an axis break it into stretches.
struct Line<'a> {
    look: Look,
    stretches: Vec<Vec<Spot>>,
    marks: Vec<(Spot, &'a Mark)>,
}

impl Plot {
    fn new(chart: &Chart) -> Self {
        let marks = || chart.series.iter().flat_map(|series| &series.marks);
        let mut x = Scale::new(&chart.x, marks().map(|m| m.x), LEFT, BODY);
        let mut y = Scale::new(&chart.y, marks().map(|m| m.y), FLOOR, TOP);
        x.keep_clear(0.02);
        y.keep_clear(0.02);
        Self { x, y }
    }

    fn spot(&self, x: f64, y: f64) -> Option<Spot> {
        Some(Spot { x: self.x.place(x)?, y: self.y.place(y)? })
    }

    fn line<'a>(&self, series: &'a Series) -> Line<'a> {
        let mut line =
            Line { look: Look::of(series.look), stretches: vec![Vec::new()], marks: Vec::new() };
        for mark in &series.marks {
            match self.spot(mark.x, mark.y) {
                Some(spot) => {
                    line.stretches.last_mut().expect("there is one").push(spot);
                    line.marks.push((spot, mark));
                }
                None => line.stretches.push(Vec::new()),
            }
        }
        line.stretches.retain(|stretch| !stretch.is_empty());
        line
    }

    fn draw_grid(&self, chart: &Chart, svg: &mut String) {
        let (right, bottom) = (look::number(BODY), look::number(FLOOR));
        let mut fine = String::new();
        let mut coarse = String::new();
        for tick in self.x.ticks() {
            let path = if tick.label.is_some() { &mut coarse } else { &mut fine };
            let _ = write!(path, "M{} {TOP}V{bottom}", look::number(tick.at));
        }
        for tick in self.y.ticks() {
            let path = if tick.label.is_some() { &mut coarse } else { &mut fine };
            let _ = write!(path, "M{LEFT} {}H{right}", look::number(tick.at));
        }
        for (path, stroke) in [(fine, "#f1f1f1"), (coarse, "#dcdcdc")] {
            if !path.is_empty() {
                let _ = writeln!(svg, "<path d=\"{path}\" stroke=\"{stroke}\" fill=\"none\"/>");
            }
        }
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" stroke=\"#333\" fill=\"none\"/>"
        );
        for tick in self.x.ticks() {
            if let Some(label) = &tick.label {
                raw_text(svg, tick.at, FLOOR + 18.0, TEXT, "middle", "#222", label);
            }
        }
        for tick in self.y.ticks() {
            if let Some(label) = &tick.label {
                raw_text(svg, LEFT - 8.0, tick.at + 4.5, TEXT, "end", "#222", label);
            }
        }
        let middle = 0.5 * (LEFT + BODY);
        text(svg, middle, FLOOR + 40.0, TEXT, "middle", "#222", &chart.x.label, false);
        let middle = 0.5 * (TOP + FLOOR);
        let _ = writeln!(
            svg,
            "<text transform=\"translate(22 {}) rotate(-90)\" font-size=\"{TEXT}\" \
             text-anchor=\"middle\" fill=\"#222\">{}</text>",
            look::number(middle),
            escaped(&chart.y.label)
        );
    }

    /// Steps: right of an efficient place its error is to be had, until the next.
    fn draw_frontier(&self, chart: &Chart, svg: &mut String) {
        let spots: Vec<Spot> =
            chart.frontier.iter().filter_map(|&(x, y)| self.spot(x, y)).collect();
        let Some(first) = spots.first() else { return };
        let mut path = format!("M{} {TOP}", look::number(first.x));
        for spot in &spots {
            let _ = write!(path, "H{}V{}", look::number(spot.x), look::number(spot.y));
        }
        let _ = write!(path, "H{}", look::number(BODY));
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" stroke=\"#c9c9c9\" stroke-width=\"9\" stroke-linejoin=\"round\" \
             fill=\"none\"/>"
        );
    }
}

impl Line<'_> {
    fn draw(&self, svg: &mut String) {
        self.stretches.iter().for_each(|stretch| self.look.draw_line(stretch, svg));
        for (spot, mark) in self.marked() {
            self.look.draw_mark(spot, if mark.is_notable { 1.35 } else { 1.0 }, svg);
        }
    }

    /// The places that get a mark: those that are labelled, and as many others as stand apart.
    fn marked(&self) -> impl Iterator<Item = (Spot, &Mark)> {
        let mut last: Option<Spot> = None;
        self.marks.iter().filter_map(move |&(spot, mark)| {
            let is_apart =
                last.is_none_or(|last| libm::hypot(spot.x - last.x, spot.y - last.y) >= MARK_GAP);
            (mark.label.is_some() || is_apart).then(|| {
                last = Some(spot);
                (spot, mark)
            })
        })
    }
}

#[expect(clippy::too_many_arguments, reason = "a line of text is that: place, look and words")]
fn text(
    svg: &mut String,
    x: f64,
    y: f64,
    size: f64,
    anchor: &str,
    fill: &str,
    words: &str,
    is_bold: bool,
) {
    if words.is_empty() {
        return;
    }
    let words = escaped(words);
    let words =
        if is_bold { format!("<tspan font-weight=\"bold\">{words}</tspan>") } else { words };
    raw_text(svg, x, y, size, anchor, fill, &words);
}

/// Text with marks of its own.
fn raw_text(svg: &mut String, x: f64, y: f64, size: f64, anchor: &str, fill: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{fill}\">{words}</text>",
        look::number(x),
        look::number(y)
    );
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
