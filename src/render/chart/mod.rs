//! Line charts with linear or logarithmic axes, as SVG; the same data, the same bytes.
//!
//! A chart is meant for print and for colour-blind eyes: every line has a colour, a dash and a
//! mark of its own, its name stands at its end and in the legend, and no label covers another.
//!
//! ```
//! use linkwork::render::chart::{AxisUnit, Chart, ChartAxis, Datum, Series};
//!
//! let axis = |label: &str, is_log| ChartAxis { label: label.into(), is_log, unit: AxisUnit::None };
//! let datum = |x, y| Datum { x, y, label: None, is_notable: false };
//! let data = vec![datum(0.0, 1.0), datum(1.0, 0.5)];
//! let line = Series { name: "halving".into(), look: 0, data };
//! let chart = Chart {
//!     title: "An error that is halved".into(),
//!     x: axis("iteration", false),
//!     y: axis("error", true),
//!     series: vec![line],
//!     ..Chart::default()
//! };
//! assert!(chart.svg().starts_with("<svg"));
//! ```

// What is to be shown.
mod axis;
mod data;

// How it lies on the page.
mod label_placer;
mod plot;
mod series_look;
mod sheet;

pub use axis::{AxisUnit, ChartAxis};
pub use data::{Chart, Datum, Series};
