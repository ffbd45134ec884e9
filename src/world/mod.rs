//! The state of a mechanism: points, constraints, parameters, clock, traces, and every edit of it.
//!
//! All edits go through [`World::apply`], which gives the edit that takes it back. Nothing
//! here iterates towards a solution, parses, prints or holds a number that is not finite.

// What there is.
mod clock;
mod id;
mod measure;
mod name;
mod points;
mod records;
mod samples;
mod smooth;
mod state;
mod tally;
mod touched;
mod trace;

// Who has which name, and who uses whom.
mod name_index;
mod names;
mod point_users;
mod user;
mod users;

// Expressions, their values, and what they depend on.
mod arithmetic;
mod compile;
mod dependencies;
mod dependency_order;
mod driving;
mod environments;
mod evaluate;
mod formula;
mod handles;
mod member;
mod rate_function;
mod value;

// Edits, and time going on.
mod apply;
mod batch;
mod edit;
mod gauges;
mod known_ahead;
mod log;
pub(crate) mod marks;
mod moment;
mod motion;
mod noting;
mod quadrature;
pub(crate) mod repeated;
mod same;
mod turn_count;
mod turning;
mod unchanged;

pub(crate) use arithmetic::{call, operate};
#[doc(hidden)]
pub use batch::{Batch, BatchRecords};
pub use clock::Clock;
pub(crate) use driving::Driving;
pub use edit::{Edit, Refreeze};
#[doc(hidden)]
pub use environments::Rates;
pub use formula::{Depends, Environment, Extent, Formula, Mention, Node};
pub(crate) use gauges::Gauges;
pub use handles::Handles;
pub use id::{ConstraintId, Entity, MeasureId, ParameterId, PointId};
pub(crate) use known_ahead::Timetable;
#[doc(hidden)]
pub use log::Motion;
pub(crate) use log::Places;
pub(crate) use measure::Measuring;
#[doc(hidden)]
pub use moment::Moment;
pub use name::NameText;
pub use names::Namespace;
pub use points::{PointRecord, Points};
pub use records::{Drivers, Measure, Parameter, Record};
pub(crate) use same::same_place;
pub use samples::{Sample, SampleList};
pub use smooth::Reading;
pub use state::World;
pub use tally::{Extremes, Tally};
#[doc(hidden)]
pub use touched::Touched;
pub use trace::{Ghost, Trace};
pub use turning::{TurnCount, Turning};
pub use user::User;
pub use value::Value;
