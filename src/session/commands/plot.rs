//! Series of values: `sample` and `plot`.

use std::sync::Arc;

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{Expr, PlotPart, Text};
use crate::render::Drawable;
use crate::render::chart::{AxisUnit, Chart, ChartAxis, Datum, Series};
use crate::session::execution::Execution;
use crate::session::file_kind::FileKind;
use crate::session::quotas::Quota;
use crate::session::undo::journal::Change;

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
        let file = path.map(|path| self.output_file(path, FileKind::Picture)).transpose()?;
        let place = path.map_or(span, |path| path.span);
        if self.state.series.is_empty() {
            return Err(Diagnostic::error(errors::NOTHING_TO_PLOT, "there is nothing to plot")
                .at(place, "no series has a value")
                .help(r#"`sample "error" = distance(A, B)` appends one"#));
        }
        let mut chart = Chart {
            x: axis("sample", false),
            y: axis("", parts.contains(&PlotPart::Log)),
            ..Chart::default()
        };
        for part in parts {
            match part {
                PlotPart::Log => {}
                PlotPart::Title(text) => chart.title = text.value.to_string(),
                PlotPart::X(text) => chart.x.label = text.value.to_string(),
                PlotPart::Y(text) => chart.y.label = text.value.to_string(),
            }
        }
        let datum =
            |(k, &y): (usize, &f64)| Datum { x: k as f64, y, label: None, is_notable: false };
        let line = |(look, (name, values)): (usize, &(Arc<str>, Vec<f64>))| Series {
            name: name.to_string(),
            look,
            data: values.iter().enumerate().map(datum).collect(),
        };
        chart.series = self.state.series.iter().enumerate().map(line).collect();
        if let Some(file) = file {
            self.queue_file(file, FileKind::Picture, chart.svg().into_bytes(), place);
        } else {
            self.host.draw(Drawable::Chart(&chart));
        }
        Ok(())
    }
}

fn axis(label: &str, is_log: bool) -> ChartAxis {
    ChartAxis { label: label.to_owned(), is_log, unit: AxisUnit::None }
}
