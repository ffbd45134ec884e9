//! What a statement found, as data: for hosts that speak to programs and not to people.

use std::path::Path;

use super::check::Check;
use super::effects::Effects;
use super::summary::Summary;
use crate::mobility::DriverRange;
use crate::solve::Halt;
use crate::world::Value;

/// What a statement found.
#[derive(Debug)]
#[non_exhaustive]
pub enum Finding<'a> {
    /// Values were printed: the line, and those of its items that are values.
    Printed(&'a str, &'a [Value]),
    /// What `list` lists.
    Listed(&'a Listing),
    /// What `show` shows of this name.
    Shown(&'a str, &'a Listing),
    /// What `check` finds.
    Checked(&'a Check),
    /// What `effects` finds.
    Effects(&'a Effects),
    /// What `limits` finds.
    Limits(&'a Limits),
    /// A command let time pass, up to this time; what it says of it.
    Ran(&'a Summary, f64, &'a str),
    /// A motor could not go on in the frame of this number.
    Halted(&'a str, u64, Halt),
    /// What the run is for: a name and a value.
    Result(&'a str, f64),
    /// The numbers that `fit` found.
    Fitted(&'a Fit),
    /// A file was written.
    Wrote(&'a Path),
    /// What a sweep came to.
    Swept(&'a Swept),
}

/// What `fit` found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The parameters with their numbers.
    pub parameters: Vec<(String, f64)>,
    /// Those that are at an end of their range.
    pub at_ends: Vec<String>,
    /// What was looked for: `minimise`, `maximise`, `to`.
    pub goal: &'static str,
    /// What is least or greatest.
    pub what: String,
    /// Its value with these numbers.
    pub value: f64,
    /// Its value before; none where that was not solved.
    pub before: Option<f64>,
    /// How often the motion was run.
    pub n_runs: u64,
    /// How long that took, where somebody has a clock.
    pub seconds: Option<f64>,
}

/// What a sweep came to: its table, and how its variants went.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Swept {
    /// What the table is called.
    pub table: String,
    /// What its columns are called.
    pub columns: Vec<String>,
    /// How many rows it has.
    pub n_rows: u64,
    /// How many it is to have.
    pub n_wanted: u64,
    /// How many of these were run now, not by a sweep that was gone on with.
    pub n_run: u64,
    /// Of those, how many ended in an error.
    pub n_failed: u64,
    /// Those that missed their tolerance.
    pub n_missed: u64,
    /// Those in which a motor could not go on.
    pub n_dead: u64,
}

/// How far a driver can go.
#[derive(Debug)]
pub struct Limits {
    /// Its name.
    pub driver: String,
    /// Whether its values are angles, in radians.
    pub is_angle: bool,
    /// What is known of it; nothing where it drives nothing that can be followed.
    pub range: Option<DriverRange>,
    /// The constraints that stop it, as its range tells them, by name.
    pub stops: [Option<String>; 2],
    /// The same in words.
    pub text: String,
}

/// Some of what there is.
#[derive(Debug, Default)]
pub struct Listing {
    /// Parameters, in an order in which each mentions only those before it.
    pub parameters: Vec<ParameterRow>,
    /// Points.
    pub points: Vec<PointRow>,
    /// Constraints.
    pub constraints: Vec<ConstraintRow>,
    /// Traces.
    pub traces: Vec<TraceRow>,
    /// Measures.
    pub measures: Vec<MeasureRow>,
    /// Definitions, each with its parameters.
    pub definitions: Vec<(String, Vec<String>)>,
}

/// A parameter.
#[derive(Debug)]
pub struct ParameterRow {
    /// Its name.
    pub name: String,
    /// The statement that makes it.
    pub statement: String,
    /// What it is now, if it has a value.
    pub value: Option<Value>,
}

/// A point.
#[derive(Debug)]
pub struct PointRow {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub at: [f64; 2],
    /// Whether it is frozen.
    pub is_frozen: bool,
    /// Its weight.
    pub weight: f64,
}

/// A constraint.
#[derive(Debug)]
pub struct ConstraintRow {
    /// Its name.
    pub name: String,
    /// The statement that makes it.
    pub statement: String,
    /// Its points.
    pub points: Vec<String>,
    /// Whether it is switched on.
    pub is_on: bool,
    /// By how much it is missed, with its sign.
    pub residual: f64,
}

/// A measure.
#[derive(Debug)]
pub struct MeasureRow {
    /// Its name.
    pub name: String,
    /// The statement that makes it.
    pub statement: String,
    /// What it keeps of its values, each by its word; in its unit.
    pub statistics: Vec<(&'static str, f64)>,
}

/// A trace.
#[derive(Debug)]
pub struct TraceRow {
    /// Its point.
    pub point: String,
    /// What it is called, if not as its point.
    pub label: Option<String>,
    /// Each so many frames.
    pub every: u64,
    /// How many places it has.
    pub n_places: usize,
    /// Whether it is as long as it will be.
    pub is_ended: bool,
}
