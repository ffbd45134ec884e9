//! A study as text: a table to read, and CSV for programs.

use std::fmt::Write;

use super::report::{ErrorMeasure, Study};
use crate::diag::{format_digits, format_exponent, format_number, format_seconds};

/// The table, a line a row; the efficient ones have a star.
pub fn table(study: &Study) -> Vec<String> {
    let mut lines = vec![format!(
        "  {:<11} {:>7} {:>12} {:>6} {:>10} {:>10} {:>8}",
        "method", "setting", "time a frame", "+-", "residual", "position", "missed"
    )];
    for row in &study.rows {
        let position =
            row.position_error.map_or_else(|| "-".to_owned(), |error| format_exponent(error, 2));
        lines.push(format!(
            "{} {:<11} {:>7} {:>12} {:>6} {:>10} {position:>10} {:>8}",
            if row.is_efficient { '*' } else { ' ' },
            row.rung.method.word(),
            row.rung.setting(),
            format_seconds(row.seconds_per_frame),
            format!("{:.0} %", 100.0 * row.spread),
            format_exponent(row.residual, 2),
            row.n_failed,
        ));
    }
    lines.push(format!(
        "* efficient: no other setting is both faster and better by {}{}",
        study.measure.words(),
        if study.measure == ErrorMeasure::Position {
            format!("; errors below {} are rounding", format_exponent(study.floor, 2))
        } else {
            String::new()
        }
    ));
    lines
}

/// The names over the columns of the CSV.
pub const CSV_HEADING: &str = "method,iterations,tolerance,seconds_per_frame,spread,rounds,\
     residual,position_error,failed_frames,efficient";

/// The rows as CSV, with a line of names.
pub fn csv(study: &Study) -> String {
    let mut text = format!("{CSV_HEADING}\n");
    for row in &study.rows {
        let position = row.position_error.map(format_number).unwrap_or_default();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{position},{},{}",
            row.rung.method.word(),
            row.settings.iterations,
            format_number(row.settings.tolerance),
            format_digits(row.seconds_per_frame, 3),
            format_digits(row.spread, 2),
            row.n_rounds,
            format_number(row.residual),
            row.n_failed,
            row.is_efficient
        );
    }
    text
}
