//! A study as a picture: error against time a frame, one line a method.

use super::report::{RungResult, Study};
use crate::render::chart::{AxisUnit, Chart, ChartAxis, Datum, Series};
use crate::solve::Method;

/// The picture, as SVG; `title` stands above it.
pub fn picture(study: &Study, title: &str) -> String {
    // No logarithm shows an error of 0; what is below the floor is rounding anyway.
    let floor = study.floor.max(1e-16);
    let datum = |row: &RungResult| Datum {
        x: row.seconds_per_frame,
        y: row.error(study.measure).max(floor),
        label: Some(row.rung.setting()),
        is_notable: row.is_efficient,
    };
    let line = |(k, method): (usize, Method)| {
        let rows = study.rows.iter().filter(|row| row.rung.method == method);
        Series { name: method.word().to_owned(), look: k, data: rows.map(datum).collect() }
    };
    let series: Vec<Series> = Method::ALL.into_iter().enumerate().map(line).collect();
    let series = series.into_iter().filter(|series| !series.data.is_empty()).collect();
    let exact = Method::ALL.into_iter().filter(|method| method.goes_to_tolerance());
    let exact: Vec<&str> = exact.map(Method::word).collect();
    let frontier = study.frontier().into_iter().map(|row| (datum(row).x, datum(row).y)).collect();
    let error = format!("{}, relative to the scene's size", study.measure.words());
    let time = if study.is_still { "time for the solve" } else { "time a frame" };
    Chart {
        title: title.to_owned(),
        subtitle: study.summary(),
        x: ChartAxis { label: time.to_owned(), is_log: true, unit: AxisUnit::Seconds },
        y: ChartAxis { label: error, is_log: true, unit: AxisUnit::None },
        series,
        frontier,
        note: format!(
            "numbers at the marks: {} tolerance, others most iterations a frame",
            exact.join(" and ")
        ),
    }
    .svg()
}
