//! `effects`: what this scene has switched on, because of which statements, and what each costs.

use super::effect_table::{EFFECTS, Rehearsal, Work};
use crate::interrupt::tick;
use crate::session::effects::{EffectRow, Effects};
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::host::{Host, NO_CLOCK};
use crate::session::state::State;
use crate::session::undo::recorder::Recorder;
use crate::solve::{Budget, Settings, Solver};

/// Frames that are timed, and the wall time after which no more are begun.
const TIMED_FRAMES: u64 = 240;
const TIMED_SECONDS: f64 = 0.3;

impl State {
    /// What the scene has switched on, timed by letting a copy of it run on for as long as its
    /// live expressions have values.
    pub fn effects_on(&self, host: &dyn Host) -> Effects {
        let rows = EFFECTS.iter().map(|effect| {
            let because = (effect.because)(self);
            EffectRow {
                name: effect.name,
                is_on: !because.is_empty(),
                because,
                n_bytes: (effect.n_bytes)(self),
                seconds: 0.0,
            }
        });
        let rows = rows.collect();
        let why_none = "something has no value in the next ones";
        let mut effects = Effects { rows, islands: (0, 0), n_frames: 0, why_none, seconds: 0.0 };
        self.time_effects(&mut effects, host);
        effects
    }

    /// Lets a copy of the scene run on and times the parts of its frames.
    fn time_effects(&self, effects: &mut Effects, host: &dyn Host) {
        let mut copy = self.rehearsal();
        let settings = &self.preferences.solve;
        let are_on: Vec<bool> = effects.rows.iter().map(|row| row.is_on).collect();
        // The first frames bring the copy to its pace.
        let mut untimed = Laps::new(&|| 0.0);
        for _ in 0..2 {
            let Some(visited) = copy.frame(settings, &are_on, &mut untimed) else { return };
            effects.islands = (copy.solver.n_islands().0, visited);
        }
        if host.seconds().is_none() {
            effects.why_none = NO_CLOCK;
            return;
        }
        let now = || host.seconds().unwrap_or_default();
        let mut laps = Laps::new(&now);
        let begun = laps.at;
        while effects.n_frames < TIMED_FRAMES && laps.at - begun < TIMED_SECONDS {
            if copy.frame(settings, &are_on, &mut laps).is_none() {
                break;
            }
            effects.n_frames += 1;
        }
        effects.seconds = laps.solving + laps.effects.iter().sum::<f64>();
        let mut in_solving = [0.0; EFFECTS.len()];
        for (k, effect) in EFFECTS.iter().enumerate().filter(|(k, _)| are_on[*k]) {
            if let Work::Solving(again) = effect.work {
                let begun = now();
                for _ in 0..effects.n_frames {
                    tick(usize::MAX);
                    std::hint::black_box(again(&copy.solver));
                }
                in_solving[k] = (now() - begun).max(0.0);
            }
        }
        // What is done again alone may take longer than it did among the rest.
        let sum: f64 = in_solving.iter().sum();
        let scale = if sum > laps.solving { laps.solving / sum } else { 1.0 };
        for (k, row) in effects.rows.iter_mut().enumerate() {
            row.seconds = laps.effects[k] + scale * in_solving[k];
        }
    }

    /// A copy of the scene to do work on.
    fn rehearsal(&self) -> Rehearsal {
        let mut solver = Solver::new();
        solver.set_memory(self.solver.memory());
        Rehearsal {
            world: self.world.clone(),
            solver,
            recorders: self.recorders.iter().map(Recorder::emptied).collect(),
            expose_every: self.preferences.expose_every,
        }
    }
}

/// The time that parts of frames took, by a clock that takes time to look at.
struct Laps<'a> {
    now: &'a dyn Fn() -> f64,
    /// What looking at the clock takes, seconds.
    look: f64,
    /// When the last lap ended.
    at: f64,
    /// What solving took.
    solving: f64,
    /// What each effect took that is timed in the frames.
    effects: [f64; EFFECTS.len()],
}

/// Looks at the clock that are timed at once, and how often.
const LOOKS: u32 = 16;
const ROUNDS_OF_LOOKS: u32 = 8;

impl<'a> Laps<'a> {
    /// Begins now.
    fn new(now: &'a dyn Fn() -> f64) -> Self {
        let mut look = f64::INFINITY;
        for _ in 0..ROUNDS_OF_LOOKS {
            let begun = now();
            let ended = (0..LOOKS).fold(begun, |_, _| now());
            look = look.min((ended - begun) / f64::from(LOOKS));
        }
        Self { now, look, at: now(), solving: 0.0, effects: [0.0; EFFECTS.len()] }
    }

    /// What passed since the last lap, without the look at the clock.
    fn lap(&mut self) -> f64 {
        let before = std::mem::replace(&mut self.at, (self.now)());
        (self.at - before - self.look).max(0.0)
    }
}

impl Rehearsal {
    /// Lets one frame pass with the effects that are on; gives how many islands were visited, none
    /// where something has no value then.
    fn frame(&mut self, settings: &Settings, are_on: &[bool], laps: &mut Laps) -> Option<usize> {
        // Each may be long in a large scene: it is asked before each whether the user wants to stop.
        tick(usize::MAX);
        let Self { world, solver, .. } = &mut *self;
        solver.sync(world, settings);
        world.advance().ok()?;
        for (k, effect) in EFFECTS.iter().enumerate() {
            if are_on[k] && matches!(effect.work, Work::Clock) {
                laps.effects[k] += laps.lap();
            }
        }
        let budget = Budget::default();
        let report = solver.frame(world, settings, &budget);
        laps.solving += laps.lap();
        for (k, effect) in EFFECTS.iter().enumerate() {
            if are_on[k]
                && let Work::Leaving(work) = effect.work
            {
                work(self);
                laps.effects[k] += laps.lap();
            }
        }
        Some(report.counters.islands_visited as usize)
    }
}

impl Execution<'_> {
    pub(crate) fn effects(&mut self) {
        let effects = self.state.effects_on(self.host);
        if self.host.takes_findings() {
            return self.host.find_out(&Finding::Effects(&effects));
        }
        let (n_columns, _) = self.host.page();
        effects.lines(n_columns).iter().for_each(|line| self.host.print(line));
    }
}
