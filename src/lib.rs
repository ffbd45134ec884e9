//! Planar mechanisms under geometric constraints: name points, state what has to hold between
//! them, let time pass, and look.
//!
//! A [`Session`] holds a mechanism and understands a small language. It takes text, and what
//! comes of it can be asked for by name:
//!
//! ```
//! use linkwork::Session;
//!
//! let mut session = Session::new();
//! session.run(
//!     "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
//!      crank: motor A B radius 1 speed 1rev
//!      coupler: length B C = 3.5
//!      rocker: length C D = 3
//!      set dt 1/360
//!      step 90",
//! )?;
//! let b = session.position("B").expect("B is a point");
//! assert!(b.x.abs() < 1e-12 && (b.y - 1.0).abs() < 1e-12);
//! assert!((session.evaluate("distance(C, D)")?.number() - 3.0).abs() < 1e-12);
//! assert!(session.residual("coupler").expect("it is on").abs() < 1e-12);
//! # Ok::<(), linkwork::Diagnostic>(())
//! ```
//!
//! Every frame is solved to 1e-12 where there is a solution and fits best where there is none,
//! the same to the bit on every platform. A statement takes effect whole or not at all, and
//! `undo` takes it back. What goes wrong is a [`Diagnostic`]: an error that prints itself in one
//! line, and that [`diag::render`] draws with the text it is about.
//!
//! # What to read next
//!
//! - [`Session`]: statements, questions, `save` and `undo`; [`Session::run`] for texts that need
//!   nothing outside, [`Session::execute_all`] with a [`Host`] of one's own for files, a clock and
//!   a way to stop.
//! - [`World`](world::World): what there is, to be read directly: points, constraints,
//!   parameters, traces.
//! - [`render`]: a world becomes a [`Scene`](render::Scene), scenes become SVG.
//! - [`lang`]: the language itself; its catalogue is what `help` says.
//! - `examples/`: a four-bar frame by frame, pictures, a host of one's own.
//! - `docs/language.md`: every statement; `docs/architecture.md`: the rooms of the library.
//!
//! # Features
//!
//! Two are on by default. `terminal` is the program: command line, prompt, files. `parallel`
//! shares out work to all cores. `pictures` draws in pixels, `.png` and `.gif`. Without them the library needs no threads, files or clock:
//! nothing that `wasm32-unknown-unknown` lacks.

// These macros panic where the stream is closed.
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "terminal")]
#[doc(hidden)]
pub mod cli;
pub mod constraint;
pub mod diag;
pub mod errors;
mod interrupt;
pub mod lang;
#[doc(hidden)]
pub mod linalg;
pub mod live;
#[doc(hidden)]
pub mod mobility;
mod optimise;
pub mod render;
#[cfg(feature = "terminal")]
mod repl;
pub mod session;
pub mod solve;
mod study;
pub mod terms;
pub mod world;

pub use diag::Diagnostic;
pub use session::{Answer, Host, Session};
