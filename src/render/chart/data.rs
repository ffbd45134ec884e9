//! A chart as plain data.

use super::axis::ChartAxis;

/// A chart as plain data.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// Above the chart.
    pub title: String,
    /// Below the title, smaller; may be empty.
    pub subtitle: String,
    /// To the right.
    pub x: ChartAxis,
    /// Upwards.
    pub y: ChartAxis,
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
    pub data: Vec<Datum>,
}

/// One place of a line.
#[derive(Debug, Clone)]
pub struct Datum {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// Written beside it where there is room.
    pub label: Option<String>,
    /// Whether it is to be emphasised.
    pub is_notable: bool,
}
