//! What is shown on the spot, however the place can show it.

use super::chart::Chart;
use super::document::Options;
use super::scene::Scene;
use super::sketch::Sketch;
use super::still::svg;

/// A scene or a chart that is to be shown at once.
#[derive(Debug, Clone, Copy)]
pub enum Drawable<'a> {
    /// A mechanism.
    Scene(&'a Scene),
    /// Numbers in lines.
    Chart(&'a Chart),
}

/// Rows of a chart in characters: more say nothing more.
const CHART_ROWS: usize = 20;

impl Drawable<'_> {
    /// In characters, in at most so many columns and rows.
    pub fn sketch(self, n_columns: usize, n_rows: usize) -> Sketch {
        match self {
            Self::Scene(scene) => Sketch::of(scene, n_columns, n_rows),
            Self::Chart(chart) => Sketch::of_chart(chart, n_columns, n_rows.min(CHART_ROWS)),
        }
    }

    /// As a document.
    pub fn svg(self) -> String {
        match self {
            Self::Scene(scene) => svg(scene, &Options::default()),
            Self::Chart(chart) => chart.svg(),
        }
    }
}
