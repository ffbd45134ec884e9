//! Charts: of series that `sample` collects, and of measures against each other.

use std::path::PathBuf;
use std::sync::Arc;

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::interrupt::tick;
use crate::lang::ast::{Curves, Expr, Node, PlotPart, Text, Unit};
use crate::render::chart::{AxisUnit, Chart, ChartAxis, Datum, Series};
use crate::render::{Drawable, Options};
use crate::session::execution::Execution;
use crate::session::file_kind::FileKind;
use crate::session::quotas::Quota;
use crate::session::resolve::scope::Meaning;
use crate::session::undo::journal::Change;
use crate::world::{Entity, Measure, Reading};

impl Execution<'_> {
    pub(crate) fn sample(&mut self, series: &Text, values: &[Expr]) -> Result<(), Diagnostic> {
        for value in values {
            let value = self.resolve().number(value)?;
            self.change(Change::Sample(Box::new((series.value.clone(), Some(value)))));
        }
        let n_samples = self.state.series.iter().map(|(_, values)| values.len()).sum::<usize>();
        self.input.quotas.check(Quota::PlotSamples, n_samples as u64, series.span)
    }

    /// Draws the series as a chart: to a file, or in characters.
    pub(crate) fn plot(
        &mut self,
        path: Option<&Text>,
        parts: &[PlotPart],
        span: Span,
    ) -> Result<(), Diagnostic> {
        let file = path.map(|path| self.still_file(path)).transpose()?;
        let place = path.map_or(span, |path| path.span);
        if self.state.series.is_empty() {
            return Err(Diagnostic::error(errors::NOTHING_TO_PLOT, "there is nothing to plot")
                .at(place, "no series has a value")
                .help(r#"`sample "error" = distance(A, B)` appends one"#)
                .help("`plot d against time` draws a measure"));
        }
        let mut chart = Chart { x: axis("sample"), ..Chart::default() };
        let datum = |(k, &y): (usize, &f64)| datum(k as f64, y);
        let line = |(look, (name, values)): (usize, &(Arc<str>, Vec<f64>))| Series {
            name: name.to_string(),
            look,
            data: values.iter().enumerate().map(datum).collect(),
        };
        chart.series = self.state.series.iter().enumerate().map(line).collect();
        say(&mut chart, parts);
        self.show_chart(&chart, file, place)
    }

    /// Draws measures against another, or against time.
    pub(crate) fn plot_measures(
        &mut self,
        path: Option<&Text>,
        curves: &Curves,
        parts: &[PlotPart],
    ) -> Result<(), Diagnostic> {
        let file = path.map(|path| self.still_file(path)).transpose()?;
        let against = match curves.against.node {
            Node::Time => None,
            _ => Some(self.plotted(&curves.against)?),
        };
        let mut chart = Chart { x: axis("time (s)"), ..Chart::default() };
        if let Some(x) = &against {
            chart.x = axis(&with_unit(&x.name, x.unit));
        }
        let mut up = Vec::new();
        for (look, expr) in curves.up.iter().enumerate() {
            let y = self.plotted(expr)?;
            let data = match &against {
                Some(x) => together(x, &y),
                None => y.tally.readings().iter().map(|it| datum(it.time, it.value)).collect(),
            };
            if data.is_empty() {
                return Err(Diagnostic::error(errors::NOTHING_TO_PLOT, "there is nothing to plot")
                    .at(expr.span.to(curves.against.span), "no frame gave a value of both")
                    .help("a solved pose gives one, and each frame: `step`"));
            }
            chart.series.push(Series { name: y.name.to_string(), look, data });
            up.push(y);
        }
        chart.y = axis(&names_of(&up));
        if common_unit(&up).is_none() {
            // One title for all would give the unit of one to the others.
            for (series, measure) in chart.series.iter_mut().zip(&up) {
                series.name = with_unit(&measure.name, measure.unit);
            }
        }
        say(&mut chart, parts);
        let place = path.map_or(curves.against.span, |path| path.span);
        self.show_chart(&chart, file, place)
    }

    /// The measure of this name.
    fn plotted(&mut self, expr: &Expr) -> Result<Measure, Diagnostic> {
        let found = match expr.as_name() {
            Some(name) => {
                let meaning = self.resolve().meaning(name).map_err(|problem| {
                    problem.or_help(format!("`measure {name} = VALUE` before the run makes it"))
                })?;
                match meaning {
                    (Meaning::Entity(Entity::Measure(id)), None) => self.state.world.measure(id),
                    _ => None,
                }
            }
            None => None,
        };
        found.cloned().ok_or_else(|| {
            Diagnostic::error(errors::WRONG_SORT, "`plot ... against` draws measures")
                .at(expr.span, "expected the name of a measure")
                .help(format!("`measure d = {expr}` before the run follows this"))
        })
    }

    /// Writes a chart, or draws it in characters.
    fn show_chart(
        &mut self,
        chart: &Chart,
        file: Option<(PathBuf, FileKind)>,
        place: Span,
    ) -> Result<(), Diagnostic> {
        if let Some((file, kind)) = file {
            self.queue_still(file, kind, chart.svg(), &Options::default(), place)?;
        } else {
            self.host.draw(Drawable::Chart(chart));
        }
        Ok(())
    }
}

/// Takes in what a statement says of a chart.
fn say(chart: &mut Chart, parts: &[PlotPart]) {
    for part in parts {
        match part {
            PlotPart::Log => chart.y.is_log = true,
            PlotPart::Title(text) => chart.title = text.value.to_string(),
            PlotPart::X(text) => chart.x.label = text.value.to_string(),
            PlotPart::Y(text) => chart.y.label = text.value.to_string(),
        }
    }
}

/// The values of two measures in the same frames, in order of time.
fn together(x: &Measure, y: &Measure) -> Vec<Datum> {
    let mut others = y.tally.readings().iter().peekable();
    let both = |x: &Reading| {
        while others.next_if(|y| y.time < x.time).is_some() {}
        others.next_if(|y| y.time == x.time).map(|y| datum(x.value, y.value))
    };
    x.tally.readings().iter().filter_map(both).collect()
}

/// What is drawn upwards, with the unit that all have.
fn names_of(measures: &[Measure]) -> String {
    let names = measures.iter().map(|it| &*it.name).collect::<Vec<_>>().join(", ");
    with_unit(&names, common_unit(measures).unwrap_or(Unit::None))
}

/// The unit of all of these; none where they differ.
fn common_unit(measures: &[Measure]) -> Option<Unit> {
    let is_one = measures.windows(2).all(|pair| pair[0].unit == pair[1].unit);
    measures.first().map(|it| it.unit).filter(|_| is_one)
}

fn with_unit(name: &str, unit: Unit) -> String {
    match unit {
        Unit::None => name.to_owned(),
        unit => format!("{name} ({})", unit.suffix()),
    }
}

/// What a point of a curve takes, in ticks: it may be the first on a new page of memory.
const DATUM: usize = 10;

fn datum(x: f64, y: f64) -> Datum {
    tick(DATUM);
    Datum { x, y, label: None, is_notable: false }
}

fn axis(label: &str) -> ChartAxis {
    ChartAxis { label: label.to_owned(), is_log: false, unit: AxisUnit::None }
}
