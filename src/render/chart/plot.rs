//! How a chart is drawn: the frame, the lines, their labels and the legend.

use super::axis::{Scale, Tick};
use super::data::{Chart, Datum, Series};
use super::label_placer::{ChartLabel, LabelPlacer, Preference};
use super::series_look::SeriesLook;
use super::sheet::{Anchor, Sheet, Stroke, TextStyle, number};
use crate::constraint::Point;
use crate::interrupt::tick;
use crate::render::labels::{Area, BOLD, even_width, text_width, wrapped};
use crate::render::trace::thin;

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
const TITLE_LINE: f64 = 22.0;
const TEXT: f64 = 13.0;
const SMALL: f64 = 11.0;
const TINY: f64 = 9.5;
/// Marks without labels stand at least this far apart.
const MARK_GAP: f64 = 26.0;
/// A line of more places is drawn through as many as it takes, so near to all, px.
const DENSE: usize = 1000;
const FINE: f64 = 0.05;
/// The line through the efficient places: broad and pale, beneath the others.
const FRONTIER: Stroke = Stroke { colour: "#c9c9c9", width: 9.0, is_round: false, dash: "" };
/// What a look at a datum takes, in ticks.
const LOOK: usize = 10;
/// Words around the data.
const WORDS: TextStyle = TextStyle { size: TEXT, anchor: Anchor::Middle, colour: "#222" };
/// Words of the legend.
const NAMES: TextStyle = TextStyle { anchor: Anchor::Start, ..WORDS };
/// Words above and below the chart.
const REMARKS: TextStyle = TextStyle { size: SMALL, anchor: Anchor::Start, colour: "#555" };
const HEADING: TextStyle = TextStyle { size: TITLE, anchor: Anchor::Start, colour: "#111" };

impl Chart {
    /// The chart as an SVG document.
    pub fn svg(&self) -> String {
        let plot = Plot::new(self);
        let width = BODY + self.legend_width();
        let title = wrapped(&self.title, (width - LEFT) / (BOLD * TITLE));
        let n_more = title.len().saturating_sub(1) as f64;
        let mut sheet = Sheet::new(width, [n_more * TITLE_LINE, HEIGHT], &self.title);
        for (k, line) in title.iter().enumerate() {
            let up = (n_more - k as f64) * TITLE_LINE;
            sheet.write_bold(Point::new(LEFT, 28.0 - up), line, HEADING);
        }
        sheet.write(Point::new(LEFT, 48.0), &self.subtitle, REMARKS);
        sheet.write(Point::new(LEFT, HEIGHT - 14.0), &self.note, REMARKS);
        plot.draw_grid(self, &mut sheet);
        plot.draw_frontier(self, &mut sheet);
        let lines: Vec<Line> = self.series.iter().map(|series| plot.line(series)).collect();
        for line in &lines {
            line.draw(&mut sheet);
        }
        draw_labels(&lines, &mut sheet);
        self.draw_legend(&lines, &mut sheet);
        sheet.finish()
    }

    fn legend_width(&self) -> f64 {
        let width = |name: &str| even_width(name, TEXT).max(TEXT * text_width(name));
        let names = self.series.iter().map(|series| width(&series.name));
        names.fold(0.0, f64::max).ceil().max(LEAST_LEGEND - LEGEND) + LEGEND
    }

    fn draw_legend(&self, lines: &[Line], sheet: &mut Sheet) {
        let x = BODY + 20.0;
        let mut y = TOP + 8.0;
        for line in lines {
            line.look.draw_line(&[Point::new(x, y), Point::new(x + 30.0, y)], sheet);
            line.look.draw_marker(Point::new(x + 15.0, y), 1.0, sheet);
            sheet.write(Point::new(x + 38.0, y + 4.5), line.name, NAMES);
            y += 22.0;
        }
        if !self.frontier.is_empty() {
            y += 4.0;
            let path = format!("M{} {}H{}", number(x), number(y), number(x + 30.0));
            sheet.line(&path, FRONTIER);
            sheet.write(Point::new(x + 38.0, y + 4.5), "efficient", NAMES);
        }
    }
}

/// Writes what stands beside marks and lines: first what must be seen.
fn draw_labels(lines: &[Line], sheet: &mut Sheet) {
    let page = Area { lo: Point::new(LEFT, TOP), hi: Point::new(BODY, FLOOR) };
    let mut placer = LabelPlacer::within(page);
    for line in lines {
        line.stretches.iter().for_each(|stretch| placer.avoid_line(stretch));
        line.marked().for_each(|(place, _)| placer.avoid_mark(place));
    }
    let beside_marks = |placer: &mut LabelPlacer, sheet: &mut Sheet, is_notable: bool| {
        for line in lines {
            for (place, datum) in line.marked().filter(|(_, datum)| datum.is_notable == is_notable)
            {
                let Some(text) = &datum.label else { continue };
                let label = ChartLabel {
                    text,
                    size: if is_notable { SMALL } else { TINY },
                    is_bold: is_notable,
                    colour: line.look.text_colour,
                    preference: Preference::NearMark,
                    must: is_notable,
                };
                placer.place(place, label, sheet);
            }
        }
    };
    beside_marks(&mut placer, sheet, true);
    for line in lines {
        if let Some(&end) = line.stretches.last().and_then(|stretch| stretch.last()) {
            let label = ChartLabel {
                text: line.name,
                size: TEXT,
                is_bold: true,
                colour: line.look.text_colour,
                preference: Preference::BehindEnd,
                must: true,
            };
            placer.place(end, label, sheet);
        }
    }
    beside_marks(&mut placer, sheet, false);
}

/// Where the data lie on the page.
struct Plot {
    x: Scale,
    y: Scale,
}

/// A line on the page; data that have no place on an axis break it into stretches.
struct Line<'a> {
    name: &'a str,
    look: SeriesLook,
    stretches: Vec<Vec<Point>>,
    marks: Vec<(Point, &'a Datum)>,
}

impl Plot {
    fn new(chart: &Chart) -> Self {
        let data = || chart.series.iter().flat_map(|series| &series.data);
        tick(LOOK * chart.series.iter().map(|series| series.data.len()).sum::<usize>());
        let mut x = Scale::new(&chart.x, data().map(|datum| datum.x), LEFT, BODY);
        let mut y = Scale::new(&chart.y, data().map(|datum| datum.y), FLOOR, TOP);
        x.keep_clear(0.02);
        y.keep_clear(0.02);
        Self { x, y }
    }

    fn place(&self, x: f64, y: f64) -> Option<Point> {
        Some(Point::new(self.x.place(x)?, self.y.place(y)?))
    }

    fn line<'a>(&self, series: &'a Series) -> Line<'a> {
        let mut line = Line {
            name: &series.name,
            look: SeriesLook::of(series.look),
            stretches: vec![Vec::new()],
            marks: Vec::new(),
        };
        for datum in &series.data {
            tick(LOOK);
            match self.place(datum.x, datum.y) {
                Some(place) => {
                    line.stretches.last_mut().expect("there is one").push(place);
                    line.marks.push((place, datum));
                }
                None => line.stretches.push(Vec::new()),
            }
        }
        line.stretches.retain(|stretch| !stretch.is_empty());
        line
    }

    fn draw_grid(&self, chart: &Chart, sheet: &mut Sheet) {
        let (left, right) = (number(LEFT), number(BODY));
        let (top, bottom) = (number(TOP), number(FLOOR));
        let (x_ticks, y_ticks) = (self.x.ticks(), self.y.ticks());
        let lines = |is_written: bool| -> String {
            let of = |tick: &&Tick| tick.label.is_some() == is_written;
            let upright = |tick: &Tick| format!("M{} {top}V{bottom}", number(tick.at));
            let level = |tick: &Tick| format!("M{left} {}H{right}", number(tick.at));
            let upright = x_ticks.iter().filter(of).map(upright);
            upright.chain(y_ticks.iter().filter(of).map(level)).collect()
        };
        for (path, colour) in [(lines(false), "#f1f1f1"), (lines(true), "#dcdcdc")] {
            if !path.is_empty() {
                sheet.line(&path, Stroke::thin(colour));
            }
        }
        sheet.line(&format!("M{left} {top}V{bottom}H{right}"), Stroke::thin("#333"));
        for tick in &x_ticks {
            if let Some(label) = &tick.label {
                sheet.write_markup(Point::new(tick.at, FLOOR + 18.0), label, WORDS);
            }
        }
        for tick in &y_ticks {
            if let Some(label) = &tick.label {
                let at = Point::new(LEFT - 8.0, tick.at + 4.5);
                sheet.write_markup(at, label, TextStyle { anchor: Anchor::End, ..WORDS });
            }
        }
        let below = Point::new(0.5 * (LEFT + BODY), FLOOR + 40.0);
        sheet.write(below, &chart.x.label, WORDS);
        let beside = Point::new(22.0, 0.5 * (TOP + FLOOR));
        sheet.write_upwards(beside, &chart.y.label, WORDS);
    }

    /// Steps: right of an efficient place its error is to be had, until the next.
    fn draw_frontier(&self, chart: &Chart, sheet: &mut Sheet) {
        let places: Vec<Point> =
            chart.frontier.iter().filter_map(|&(x, y)| self.place(x, y)).collect();
        let Some(first) = places.first() else { return };
        let steps = places.iter().map(|p| format!("H{}V{}", number(p.x), number(p.y)));
        let steps: String = steps.collect();
        let path = format!("M{} {}{steps}H{}", number(first.x), number(TOP), number(BODY));
        sheet.line(&path, Stroke { is_round: true, ..FRONTIER });
    }
}

impl Line<'_> {
    fn draw(&self, sheet: &mut Sheet) {
        for stretch in &self.stretches {
            if stretch.len() > DENSE {
                self.look.draw_line(&thin(stretch, FINE), sheet);
            } else {
                self.look.draw_line(stretch, sheet);
            }
        }
        for (place, datum) in self.marked() {
            self.look.draw_marker(place, if datum.is_notable { 1.35 } else { 1.0 }, sheet);
        }
    }

    /// The places that get a mark: those that are labelled, and as many others as stand apart.
    fn marked(&self) -> impl Iterator<Item = (Point, &Datum)> {
        let mut last: Option<Point> = None;
        self.marks.iter().filter_map(move |&(place, datum)| {
            tick(1);
            let is_apart = last.is_none_or(|last| place.distance(last) >= MARK_GAP);
            (datum.label.is_some() || is_apart).then(|| {
                last = Some(place);
                (place, datum)
            })
        })
    }
}
