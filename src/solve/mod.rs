//! From constraints to positions: the paper's section 2 and what goes beyond it.
//!
//! A scene is solved island by island, an island being what constraints tie together through
//! points that are not frozen. Each method is one file; [`Method::Auto`], the default, is
//! exact to rounding where there is a solution and fits best where there is none. Nothing
//! here knows statements, clocks on the wall or files.

pub mod linear;
pub mod mobility;

// What the methods work on.
mod crew;
mod ends;
mod fingerprint;
mod footprint;
mod halt;
mod history;
mod inputs;
mod island;
mod memory;
mod method;
mod plan;
mod rates;
mod rows;
mod spectrum;
mod topology;
mod watch;

// The methods.
mod anderson;
mod auto;
mod block;
mod conjugate;
mod descent;
mod follow;
mod nesterov;
mod newton;
mod relaxation;
mod struggle;
mod successive;
mod sweep;

// Their face.
mod pass;
mod settings;
mod solver;
mod status;
mod visit;

pub use footprint::{Effect, is_inequality, is_wheel};
pub use halt::Halt;
pub use memory::Memory;
pub use settings::{CogForm, Method, Settings};
pub use solver::Solver;
pub use status::{Budget, Counters, Report, Status};
