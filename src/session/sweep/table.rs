//! What a sweep writes: rows of a table, objects, a sheet of pictures.

use std::borrow::Cow;
use std::fmt::Write;

use super::grid::Grid;
use super::variant::Variant;
use crate::diag::{format_decimals, format_number, format_rounded};
use crate::render::{FIRST_WORDS, base64};
use crate::session::{csv, json};

/// The columns of a table: the same in every row, and in every part of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    parameters: Vec<String>,
    results: Vec<String>,
}

/// The columns behind the results.
const LAST: [&str; 5] = ["status", "residual", "missed", "dead_points", "error"];

impl Columns {
    /// Those of a grid whose variants have such results.
    pub fn new(grid: &Grid, model: Option<&Variant>) -> Self {
        let results = model.into_iter().flat_map(|variant| variant.results.iter());
        Self {
            parameters: grid.axes.iter().map(|axis| axis.name.clone()).collect(),
            results: results.map(|(name, _)| name.to_owned()).collect(),
        }
    }

    /// What the columns are called.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let given = self.parameters.iter().chain(&self.results).map(String::as_str);
        std::iter::once("variant").chain(given).chain(LAST)
    }

    /// The heading of the table, with its line end.
    pub fn heading(&self) -> String {
        let names: Vec<_> = self.names().map(csv::cell).collect();
        format!("{}\n", names.join(","))
    }

    /// The row of a variant, with its line end.
    pub fn row(&self, variant: &Variant) -> String {
        let mut row = variant.number.to_string();
        for value in &variant.values {
            row.push(',');
            row.push_str(&format_number(*value));
        }
        for name in &self.results {
            row.push(',');
            if let Some(value) = variant.results.get(name) {
                row.push_str(&format_number(value));
            }
        }
        let status = variant.word();
        // Writing to a string cannot fail.
        let _ = writeln!(
            row,
            ",{status},{},{},{},{}",
            format_number(variant.residual),
            variant.n_missed,
            variant.n_dead_points,
            variant.failure.as_ref().map_or(Cow::Borrowed(""), |failure| csv::cell(&failure.text))
        );
        row
    }

    /// The object of a variant, with its line end.
    pub fn object(&self, variant: &Variant) -> String {
        format!("{}\n", json::variant(&self.parameters, variant))
    }
}

/// The width of a picture on its sheet, and the room below it for its values, px.
const CELL: [f64; 2] = [220.0, 34.0];

/// Pictures of variants side by side, each with the values of its parameters.
pub fn picture_sheet(grid: &Grid, pictures: &[(u64, String)]) -> String {
    let n_columns = (pictures.len() as f64).sqrt().ceil().max(1.0) as usize;
    let n_rows = pictures.len().div_ceil(n_columns).max(1);
    let [side, caption] = CELL;
    let (width, height) = (n_columns as f64 * side, n_rows as f64 * (side + caption));
    let mut sheet = format!(
        "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"Helvetica, Arial, 'Liberation Sans', \
         sans-serif\" font-size=\"11\">\n<rect width=\"{width}\" height=\"{height}\" \
         fill=\"#fdfdfb\"/>\n"
    );
    for (k, (number, picture)) in pictures.iter().enumerate() {
        let x = (k % n_columns) as f64 * side;
        let y = (k / n_columns) as f64 * (side + caption);
        let values = grid.axes.iter().zip(grid.values(*number));
        let told: Vec<String> = values
            .map(|(axis, value)| format!("{} = {}", axis.name, format_rounded(value)))
            .collect();
        let told = told.join(", ").replace('&', "&amp;").replace('<', "&lt;");
        let number = |value: f64| format_decimals(value, 1);
        // A picture within a picture has a style sheet of its own only as an image.
        let _ = write!(
            sheet,
            "<image x=\"{}\" y=\"{}\" width=\"{side}\" height=\"{side}\" \
             href=\"data:image/svg+xml;base64,{}\"/>\n\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"#273542\">{told}</text>\n",
            number(x),
            number(y),
            base64::encode(picture.as_bytes()),
            number(x + 0.5 * side),
            number(y + side + 0.5 * caption),
        );
    }
    sheet.push_str("</svg>\n");
    sheet
}
