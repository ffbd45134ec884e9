//! Pictures of a world: stills and moving ones, as SVG.
//!
//! A [`Scene`] is what there is to draw, as plain data; a [`Stage`] says what part of the plane
//! the page shows and where the names stand; figures in px follow from both, and a document
//! from the figures. Nothing here changes a world or opens a file, and the same scene gives
//! the same bytes.
//!
//! ```
//! use linkwork::render::{Options, Scene, svg};
//! use linkwork::world::World;
//!
//! let picture = svg(&Scene::of(&World::new()), &Options::default());
//! assert!(picture.starts_with("<svg"));
//! ```

// From a world to what is to be drawn.
mod curve;
mod groups;
mod parts;
mod plan;
mod scene;

// From there to figures on a page.
mod cover;
mod figure;
mod ink;
mod lettering;
mod number;
mod stage;
mod strip;
mod style;
mod view;

// Figures in motion.
mod animation;
mod motion;
mod pen;
mod recording;

mod document;

pub use number::rounded;
pub use recording::Recording;
pub use scene::Scene;
pub use stage::{Options, Stage};

/// A scene as an SVG document, fitted to the page.
pub fn svg(scene: &Scene, options: &Options) -> String {
    Stage::of(&[scene]).svg(scene, options)
}
