//! A motion with other numbers: what a search for the best ones asks for.

use crate::constraint::Point;
use crate::solve::{Along, Budget, Memory, Settings, Solver, Status};
use crate::world::{
    Edit, Extremes, Formula, Measuring, ParameterId, PointId, Rates, SampleList, Trace, Value,
    World,
};

/// A motion that is tried with different numbers, each time from the same pose.
pub struct Trial {
    /// As it is before a trial, with measures that have no value yet.
    world: World,
    memory: Memory,
    settings: Settings,
    n_frames: u64,
}

/// A scene after a trial.
pub struct Tried {
    world: World,
    solver: Solver,
    settings: Settings,
}

/// Frames that are solved one by one before it is tried again whether many can pass at once.
const PATIENCE: u64 = 16;

impl Trial {
    /// So many frames from how a world and what its solver remembers are now; the path of a point is
    /// kept where it is wanted.
    pub fn new(
        world: &World,
        memory: Memory,
        settings: Settings,
        n_frames: u64,
        path_of: Option<PointId>,
    ) -> Self {
        let mut world = world.clone();
        world.forget_readings();
        for k in (0..world.traces().len()).rev() {
            world.apply(Edit::Trace(k, None));
        }
        if let Some(point) = path_of {
            let trace = Trace {
                point,
                label: None,
                every: 1,
                is_ended: false,
                samples: SampleList::default(),
            };
            world.apply(Edit::Trace(0, Some(Box::new(trace))));
        }
        Self { world, memory, settings, n_frames }
    }

    /// Runs it with these numbers; none where something has no value, or a frame is not solved.
    pub fn run(&self, numbers: &[(ParameterId, f64)]) -> Option<Tried> {
        let (mut world, mut solver) = (self.world.clone(), Solver::new());
        solver.set_memory(self.memory.clone());
        for &(id, number) in numbers {
            let name = world.parameter(id)?.name.clone();
            world.set_parameter(id, name, Formula::constant(number), &mut Vec::new()).ok()?;
        }
        world.refresh_driven().ok()?;
        let budget = Budget::default();
        if solver.settle(&mut world, &self.settings, &budget).status != Status::Converged {
            return None;
        }
        let mut tried = Tried { world, solver, settings: self.settings };
        tried.measure(true)?;
        tried.world.sample_traces(false);
        tried.advance(self.n_frames)?;
        Some(tried)
    }
}

impl Tried {
    fn measure(&mut self, only_empty: bool) -> Option<()> {
        let Self { world, solver, settings } = self;
        let mut rates = |world: &mut World| solver.rates(world, settings);
        let how = &mut Measuring { extremes: Extremes::Refined, is_met: true, rates: &mut rates };
        if world.has_measures() { world.take_readings(only_empty, how).ok() } else { Some(()) }
    }

    fn advance(&mut self, n: u64) -> Option<()> {
        let budget = Budget::default();
        let (mut k, mut next_try) = (0, 0);
        while k < n {
            let Self { world, solver, settings } = &mut *self;
            if k >= next_try {
                let goes_on = || true;
                let on = Along { n: n - k, extremes: Extremes::Refined, goes_on: &goes_on };
                let n_passed = solver.stretch(world, settings, &budget, &on).ok()?.n_frames;
                k += n_passed;
                if n_passed > 0 {
                    continue;
                }
                next_try = k + if k == 0 { 1 } else { PATIENCE };
            }
            let report = solver.step(world, settings, &budget, |_| {}).ok()?;
            if report.status != Status::Converged {
                return None;
            }
            world.sample_traces(false);
            self.measure(false)?;
            k += 1;
        }
        Some(())
    }

    /// The value of an expression at its end.
    pub fn value(&mut self, formula: &Formula) -> Option<f64> {
        let Self { world, solver, settings } = self;
        let rates: Option<Rates> = if world.depends(formula).on_rates {
            Some(solver.rates(world, settings).ok()?)
        } else {
            None
        };
        match world.evaluate(formula, rates.as_ref()).ok()? {
            Value::Number(n) => Some(n),
            Value::Vector(_) => None,
        }
    }

    /// Where the point was whose path was kept: at the start, and after each frame.
    pub fn path(&self) -> impl Iterator<Item = Point> {
        self.world.traces().iter().flat_map(|trace| trace.samples.iter()).map(|sample| sample.at)
    }
}
