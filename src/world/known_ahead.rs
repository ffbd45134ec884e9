//! Frames that are known ahead: nothing changes in them but motors that turn evenly, and values that
//! follow time alone.

use super::environments::Here;
use super::{Clock, ConstraintId, Depends, Formula, ParameterId, Record, User, Value, World};
use crate::constraint::{Field, Program, Register};

impl World {
    /// Whether what drives the scene is known ahead. It is not where a frame measures or counts
    /// something, or is the first.
    pub fn is_known_ahead(&mut self) -> bool {
        self.sort_constraints();
        // Those that follow points which stand still may be of where these stood before an edit.
        self.refresh_parameters();
        let live = &self.dependencies;
        self.clock.frame > 0
            && live.ramps().is_empty()
            && live.turned().is_empty()
            && live.first_failure().is_none()
            && self.turn_counts.is_empty()
            && self.driven().iter().all(|&id| self.follows_time(id))
            && live.order().iter().all(|&id| {
                self.parameter(id).is_some_and(|parameter| self.is_of_time(&parameter.formula))
            })
    }

    /// The motors that turn evenly.
    pub fn motors(&self) -> &[ConstraintId] {
        self.dependencies.motors()
    }

    /// The constraints with a value that time or points drive, in order.
    pub fn driven(&self) -> &[ConstraintId] {
        self.dependencies.driven()
    }

    /// Lets the clock go on by frames that are known ahead. Who moved motors and points and changed
    /// values says where they are by [`constraint_state_mut`](World::constraint_state_mut) and
    /// [`set_position`](World::set_position).
    pub fn pass(&mut self, n_frames: u64) {
        self.clock.frame += n_frames;
        self.dependencies.note_change();
    }

    /// Whether the live values of a constraint follow time alone.
    fn follows_time(&self, id: ConstraintId) -> bool {
        let mut live = self.constraint(id).into_iter().flat_map(Record::live);
        live.all(|(_, formula)| self.is_of_time(formula))
    }

    /// Whether a value follows nothing but time, points that stand still, and what the user says.
    fn is_of_time(&self, formula: &Formula) -> bool {
        let depends = self.depends(formula);
        let others = Depends { on_time: false, on_parameters: false, on_points: false, ..depends };
        !(others.is_live() || depends.on_points && self.follows_motion(formula))
    }

    /// Whether something follows time in a scene that is known ahead.
    pub fn has_timetable(&self) -> bool {
        !(self.driven().is_empty() && self.dependencies.order().is_empty())
    }

    /// The parameters of such a scene that follow time and drive nothing: that one has no value ends a frame
    /// all the same.
    pub fn spare_parameters(&self) -> impl Iterator<Item = ParameterId> + '_ {
        let drives = |user: User| match user {
            User::Parameter(_) => true,
            User::Constraint(id) => self.driven().binary_search(&id).is_ok(),
            User::Measure(_) => false,
        };
        let live = &self.dependencies;
        live.order().iter().copied().filter(move |&id| !live.users(id).any(drives))
    }

    /// The values of some of the driven constraints of a scene that is known ahead, and some parameters.
    pub fn timetable<const N: usize>(
        &self,
        ids: impl Iterator<Item = ConstraintId>,
        also: impl Iterator<Item = ParameterId>,
    ) -> Timetable<N> {
        let (program, inputs, values) = self.compile_in_time(ids, also);
        let here = Here::new(self, None);
        let inputs = inputs.into_iter().map(|formula| {
            if formula.is_time() {
                return Input::Time;
            }
            // What has no value says so in the frame that is to come.
            Input::Number(formula.evaluate(&here).map_or(f64::NAN, Value::number))
        });
        Timetable { program, inputs: inputs.collect(), values, results: Vec::new() }
    }
}

/// Values that follow time alone, in `N` frames at a time.
pub struct Timetable<const N: usize> {
    program: Program,
    inputs: Vec<Input>,
    values: Vec<TimedValue>,
    /// What each operation of the program came to in each frame.
    results: Vec<[f64; N]>,
}

/// A value of a constraint that follows time.
pub struct TimedValue {
    /// The constraint.
    pub constraint: ConstraintId,
    /// The value.
    pub field: Field,
    /// Where it is among the results.
    pub register: Register,
}

/// What the values follow from.
#[derive(Clone, Copy)]
enum Input {
    Time,
    Number(f64),
}

impl<const N: usize> Timetable<N> {
    /// Whether there is nothing to evaluate.
    pub fn is_empty(&self) -> bool {
        self.program.is_empty()
    }

    /// The values, constraint by constraint.
    pub fn values(&self) -> &[TimedValue] {
        &self.values
    }

    /// Evaluates them for the frames that follow an instant.
    #[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
    #[inline(always)]
    pub fn evaluate(&mut self, clock: &Clock) {
        let times = std::array::from_fn(|l| clock.time_after(l as u64 + 1));
        let input = |k: usize| match self.inputs[k] {
            Input::Time => times,
            Input::Number(value) => [value; N],
        };
        // No point is looked at.
        self.program.evaluate_each(|_| [[f64::NAN; N]; 2], input, &mut self.results);
    }

    /// A value in each of these frames; not a number where it has none.
    pub fn get(&self, register: Register) -> &[f64; N] {
        &self.results[register as usize]
    }

    /// In which of these frames, the first of them before all others, some value or what it follows has
    /// none.
    pub fn first_failure(&self) -> usize {
        let fails = |l: &usize| self.results.iter().any(|each| each[*l].is_nan());
        (0..N).find(fails).unwrap_or(N)
    }
}
