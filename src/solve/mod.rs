//! From constraints to positions: the paper's section 2 and what goes beyond it.
//!
//! A scene is solved island by island, an island being what constraints tie together through
//! points that are not frozen. Each method is one file; [`Method::Auto`], the default, is
//! exact to rounding where there is a solution and fits best where there is none. Nothing
//! here knows statements, clocks on the wall or files.

// The face: what is asked, what comes back.
mod dead_point;
mod report;
mod settings;
mod solver;
mod verdict;

// A call, island by island.
mod cost;
mod dispatch;
mod parallel;
mod velocity;

// What is solved, how it is followed from frame to frame, and by which method.
mod closed_form;
mod frame;
mod island;
mod method;

#[doc(hidden)]
pub use cost::{is_one_sided, is_wheel};
#[doc(hidden)]
pub use dead_point::Halt;
#[doc(hidden)]
pub use island::memory::Memory;
#[doc(hidden)]
pub use island::recall::Recall;
pub use parallel::limit_cores;
pub use report::Status;
#[doc(hidden)]
pub use report::{Budget, Counters, FrameCounts, Report};
pub use settings::{CogForm, Method, Settings};
#[doc(hidden)]
pub use solver::{Along, Solver, Stretch};
#[doc(hidden)]
pub use verdict::{Judged, Verdict, least_tolerance, present, verdict};
