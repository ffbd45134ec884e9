//! The effects that a scene may call for: what switches each on, what it keeps, what it does.

use crate::constraint::{Carried, ConstraintKind as _};
use crate::session::state::State;
use crate::session::undo::recorder::Recorder;
use crate::solve::{Solver, is_one_sided, is_wheel};
use crate::world::{Depends, Record, World};

/// Something that only scenes pay for which call for it.
pub struct Effect {
    /// What it is called.
    pub name: &'static str,
    /// The statements that call for it, by name; it is switched on where there is one.
    pub because: fn(&State) -> Vec<String>,
    /// The memory kept for it, bytes.
    pub n_bytes: fn(&State) -> usize,
    /// Where in a frame its work is done.
    pub work: Work,
}

/// Where in a frame the work for an effect is done, and how it is timed.
pub enum Work {
    /// Among that of others, from which it cannot be told apart.
    Untold,
    /// At its beginning, where the clock ticks: timed there.
    Clock,
    /// Within the solving. This does as much of it once more, to no end but to be timed.
    Solving(fn(&Solver) -> u64),
    /// At its end, by this: timed there.
    Leaving(fn(&mut Rehearsal)),
}

/// A copy of a scene, to do work on that is timed.
pub struct Rehearsal {
    /// The mechanism.
    pub world: World,
    /// What solves it.
    pub solver: Solver,
    /// The recordings under way.
    pub recorders: Vec<Recorder>,
    /// Every how many frames the mechanism leaves a ghost.
    pub expose_every: Option<u64>,
}

/// Every effect there is, in the order in which they are told.
pub static EFFECTS: [Effect; 9] = [
    Effect {
        name: "clock",
        because: |state| names(state, |record| is_timed(state, record)),
        n_bytes: |state| {
            let timed = records(state).filter(|record| is_timed(state, record));
            timed.count() * size_of::<f64>() * 3
        },
        work: Work::Clock,
    },
    Effect {
        name: "measured values",
        because: |state| names(state, |record| depends(state, record).on_points),
        n_bytes: |_| 0,
        work: Work::Untold,
    },
    Effect {
        name: "wheel angles",
        because: |state| names(state, |record| is_wheel(&record.constraint)),
        n_bytes: |state| state.solver.constraint_bytes(is_wheel),
        work: Work::Solving(|solver| solver.rehearse_constraints(is_wheel)),
    },
    Effect {
        name: "previous positions",
        because: |state| {
            let frames = (state.solver.history_bytes() > 0).then_some("frames that were solved");
            frames.into_iter().map(str::to_owned).collect()
        },
        n_bytes: |state| state.solver.history_bytes(),
        work: Work::Solving(Solver::rehearse_predictions),
    },
    Effect {
        name: "inequalities",
        because: |state| names(state, |record| is_one_sided(&record.constraint)),
        // One keeps no more than an equality does.
        n_bytes: |_| 0,
        work: Work::Solving(|solver| solver.rehearse_constraints(is_one_sided)),
    },
    Effect {
        name: "derivatives",
        because: |state| {
            let users = state.world.parameters().filter(|(_, p)| p.depends.on_rates);
            users.map(|(_, parameter)| parameter.name.to_string()).collect()
        },
        n_bytes: |_| 0,
        work: Work::Untold,
    },
    Effect {
        name: "traces",
        because: |state| {
            let name = |point| state.world.points().name(point);
            let traces = state.world.traces().iter();
            traces.map(|trace| format!("trace {}", name(trace.point))).collect()
        },
        n_bytes: |state| {
            let traces = state.world.traces().iter();
            traces.map(|trace| trace.samples.n_bytes()).sum::<usize>()
        },
        work: Work::Leaving(|copy| copy.world.sample_traces(false)),
    },
    Effect {
        name: "ghosts",
        because: |state| match state.preferences.expose_every {
            Some(every) => vec![format!("expose every {every}")],
            None if state.world.ghosts().is_empty() => Vec::new(),
            None => vec!["expose".to_owned()],
        },
        n_bytes: |state| state.world.ghosts().iter().map(|ghost| size_of_val(&*ghost.at)).sum(),
        work: Work::Leaving(|copy| {
            let frame = copy.world.clock().frame;
            if copy.expose_every.is_some_and(|every| frame.is_multiple_of(every)) {
                let ghost = copy.world.expose();
                copy.world.apply(ghost);
            }
        }),
    },
    Effect {
        name: "recorded frames",
        because: |state| {
            let recorders = state.recorders.iter();
            recorders.map(|r| format!("record \"{}\"", r.path.display())).collect()
        },
        n_bytes: |state| state.recorders.iter().map(Recorder::n_bytes).sum(),
        work: Work::Leaving(|copy| {
            for recorder in &mut copy.recorders {
                recorder.take(&copy.world).expect("its tape is in memory");
            }
        }),
    },
];

/// The constraints that are switched on.
fn records(state: &State) -> impl Iterator<Item = &Record> {
    state.world.constraints().map(|(_, record)| record).filter(|record| record.is_on)
}

/// The names of those among them that are one.
fn names(state: &State, is_one: impl Fn(&Record) -> bool) -> Vec<String> {
    records(state).filter(|record| is_one(record)).map(|record| record.name.to_string()).collect()
}

/// What drives the values of a constraint.
fn depends(state: &State, record: &Record) -> Depends {
    let drivers = record.drivers().iter().map(|(_, formula)| state.world.depends(formula));
    drivers.fold(Depends::default(), Depends::or)
}

fn is_timed(state: &State, record: &Record) -> bool {
    let depends = depends(state, record);
    record.constraint.traits().carried == Carried::ByClock || depends.on_time || depends.on_angles
}
