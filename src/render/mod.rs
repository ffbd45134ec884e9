//! Pictures of a world: stills and moving ones, as SVG.
//!
//! A [`Scene`] is what there is to draw, as plain data; a [`View`] says what part of the plane
//! is shown and where the names stand; figures in px follow from both, and a document from
//! the figures. Nothing here changes a world or opens a file, and the same scene gives the
//! same bytes.
//!
//! ```
//! use linkwork::render::{Options, Scene, svg};
//! use linkwork::world::World;
//!
//! let picture = svg(&Scene::new(&World::new()), &Options::default());
//! assert!(picture.starts_with("<svg"));
//! ```

// From a world to what is to be drawn.
mod classify;
mod samples;
mod scene;
mod symbols;
mod trace;

// From there to figures on a page.
mod canvas;
mod figure;
mod labels;
mod laps;
mod legend;
mod lettering;
mod occupancy;
mod page;
mod path;
mod style;
mod view;

// Numbers in lines.
#[doc(hidden)]
pub mod chart;

// Figures that stand still, as a document.
pub(crate) mod base64;
mod document;
mod drawable;
#[cfg(any(feature = "terminal", feature = "pictures"))]
mod png_chunk;
mod still;
mod text;
mod unmet;

// Documents in pixels.
pub mod raster;

// Figures in true size.
#[doc(hidden)]
pub mod export;

// Figures in characters, documents in pixels.
#[cfg(feature = "terminal")]
mod pixels;
mod sketch;

// Figures for who draws them.
mod drawing;

// Figures in motion.
mod animation;
mod animation_tracks;
mod keyframes;
mod trace_animation;

pub use animation::{Animation, is_shown, shown_for};
pub use document::{FIRST_WORDS, Options};
pub use drawable::Drawable;
pub(crate) use drawing::{Drawing, Followed, looks, px, trace_colour};
pub(crate) use figure::{Figure, FigureShape, Key, Outline, Placement};
#[cfg(feature = "terminal")]
pub use pixels::Pixels;
#[cfg(any(feature = "terminal", feature = "pictures"))]
pub use png_chunk::push_chunk;
pub use scene::{Scene, Unmet};
pub use sketch::{Cell, Ink, Sketch};
pub use still::{svg, svg_with_view};
pub(crate) use style::PAPER;
pub use view::View;
