//! `effects`: what this scene has switched on, because of which statements, and what each costs.

use crate::constraint::{Constraint, Kind};
use crate::diag::format_digits;
use crate::session::execution::Execution;
use crate::session::state::State;
use crate::solve::{Budget, Effect, Solver, is_inequality, is_wheel};
use crate::world::{Formula, Record, Sample, World};

/// The effects of a scene, the islands it falls into, and what a frame costs.
#[derive(Debug, Clone)]
pub struct Effects {
    /// Every effect there is, switched on or not.
    pub rows: Vec<Row>,
    /// How many islands there are, and how many of them a frame visits.
    pub islands: (usize, usize),
    /// How many frames were timed, on a copy.
    pub n_frames: u64,
    /// The wall time they took, seconds.
    pub seconds: f64,
}

/// One effect.
#[derive(Debug, Clone)]
pub struct Row {
    /// Its name.
    pub name: &'static str,
    /// Whether the scene calls for it.
    pub is_on: bool,
    /// The statements that call for it, by name.
    pub because: Vec<String>,
    /// The memory kept for it, bytes.
    pub n_bytes: usize,
    /// The time spent in it during the frames that were timed, seconds.
    pub seconds: f64,
}

/// Frames that are timed, and the wall time after which no more are begun.
const TIMED_FRAMES: u64 = 240;
const TIMED_SECONDS: f64 = 0.3;

/// Names told of those that call for an effect.
const NAMES_TOLD: usize = 6;

impl State {
    /// What the scene has switched on, timed by letting a copy of it run on for as long as its
    /// live expressions have values.
    pub fn effects_on(&self, now: &dyn Fn() -> f64) -> Effects {
        let mut rows = vec![self.clock_row(), self.measures_row()];
        rows.extend([
            self.constraint_row("wheel angles", is_wheel),
            self.prediction_row(),
            self.constraint_row("inequalities", is_inequality),
            self.rates_row(),
            self.traces_row(),
            self.ghosts_row(),
            self.recording_row(),
        ]);
        let mut effects = Effects { rows, islands: (0, 0), n_frames: 0, seconds: 0.0 };
        self.time_effects(&mut effects, now);
        effects
    }

    fn row(name: &'static str, because: Vec<String>, n_bytes: usize) -> Row {
        Row { name, is_on: !because.is_empty(), because, n_bytes, seconds: 0.0 }
    }

    fn records(&self) -> impl Iterator<Item = &Record> {
        self.world.constraints().map(|(_, record)| record).filter(|record| record.is_on)
    }

    fn is_driven(&self, record: &Record, by: impl Fn(&World, &Formula) -> bool) -> bool {
        record.drivers().iter().any(|(_, formula)| by(&self.world, formula))
    }

    fn clock_row(&self) -> Row {
        let is_timed = |record: &&Record| {
            record.constraint.kind() == Kind::Motor
                || self.is_driven(record, |world, formula| world.depends(formula).on_time)
        };
        let timed: Vec<&Record> = self.records().filter(is_timed).collect();
        let n_bytes = timed.len() * size_of::<f64>() * 3;
        Self::row("clock", timed.iter().map(|r| r.name.to_string()).collect(), n_bytes)
    }

    fn measures_row(&self) -> Row {
        let on_points = |world: &World, formula: &Formula| world.depends(formula).on_points;
        let measured: Vec<String> = self
            .records()
            .filter(|record| self.is_driven(record, on_points))
            .map(|record| record.name.to_string())
            .collect();
        Self::row("measured values", measured, 0)
    }

    fn constraint_row(&self, name: &'static str, is_one: fn(&Constraint) -> bool) -> Row {
        let because = self.records().filter(|record| is_one(&record.constraint));
        let mut row = Self::row(name, because.map(|r| r.name.to_string()).collect(), 0);
        row.n_bytes = match name {
            "wheel angles" => self.solver.bytes_of(Effect::Wheels),
            _ => self.solver.bytes_of(Effect::Inequalities),
        };
        row
    }

    fn prediction_row(&self) -> Row {
        let n_bytes = self.solver.bytes_of(Effect::Prediction);
        let because =
            if n_bytes > 0 { vec!["frames that were solved".to_owned()] } else { Vec::new() };
        Self::row("previous positions", because, n_bytes)
    }

    fn rates_row(&self) -> Row {
        let users = self.world.parameters().filter(|(_, p)| p.depends.on_rates);
        Self::row("derivatives", users.map(|(_, p)| p.name.to_string()).collect(), 0)
    }

    fn traces_row(&self) -> Row {
        let traces = self.world.traces();
        let names = traces.iter().map(|t| format!("trace {}", self.world.points().name(t.point)));
        let n_samples: usize = traces.iter().map(|t| t.samples.len()).sum();
        Self::row("traces", names.collect(), n_samples * size_of::<Sample>())
    }

    fn ghosts_row(&self) -> Row {
        let ghosts = self.world.ghosts();
        let mut because = Vec::new();
        if let Some(every) = self.preferences.expose_every {
            because.push(format!("expose every {every}"));
        } else if !ghosts.is_empty() {
            because.push("expose".to_owned());
        }
        let n_bytes = ghosts.iter().map(|ghost| size_of_val(&*ghost.at)).sum();
        Self::row("ghosts", because, n_bytes)
    }

    fn recording_row(&self) -> Row {
        let because = self.recorders.iter().map(|r| format!("record \"{}\"", r.path.display()));
        let n_bytes =
            self.recorders.iter().map(crate::session::undo::recorder::Recorder::n_bytes).sum();
        Self::row("recorded frames", because.collect(), n_bytes)
    }

    /// Lets a copy of the scene run on and times its parts.
    fn time_effects(&self, effects: &mut Effects, now: &dyn Fn() -> f64) {
        let mut world = self.world.clone();
        let mut solver = Solver::new();
        solver.set_memory(self.solver.memory());
        let settings = &self.preferences.solve;
        // The first frames bring the copy to its pace.
        for _ in 0..2 {
            let Ok(report) = solver.step(&mut world, settings, &Budget::default(), |_| {}) else {
                return;
            };
            effects.islands = (solver.n_islands().0, report.counters.islands_visited as usize);
        }
        let begun = now();
        while effects.n_frames < TIMED_FRAMES && now() - begun < TIMED_SECONDS {
            if solver.step(&mut world, settings, &Budget::default(), |_| {}).is_err() {
                break;
            }
            world.sample_traces(false);
            effects.n_frames += 1;
        }
        effects.seconds = now() - begun;
        let n_frames = effects.n_frames;
        let time = |work: &mut dyn FnMut()| {
            let begun = now();
            (0..n_frames).for_each(|_| work());
            now() - begun
        };
        for row in effects.rows.iter_mut().filter(|row| row.is_on) {
            row.seconds = match row.name {
                "clock" => {
                    let mut world = world.clone();
                    // A time at which something has no value costs no less.
                    time(&mut || drop(world.advance()))
                }
                "wheel angles" => time(&mut || _ = solver.rehearse(Effect::Wheels)),
                "previous positions" => time(&mut || _ = solver.rehearse(Effect::Prediction)),
                "inequalities" => time(&mut || _ = solver.rehearse(Effect::Inequalities)),
                "traces" => time(&mut || world.sample_traces(false)),
                "ghosts" => time(&mut || drop(std::hint::black_box(world.expose()))),
                "recorded frames" => {
                    time(&mut || drop(std::hint::black_box(crate::render::Scene::new(&world))))
                }
                _ => 0.0,
            };
        }
    }
}

impl Execution<'_> {
    pub(crate) fn effects(&mut self) {
        for line in self.state.effects_on(&|| self.host.seconds()).lines() {
            self.host.print(&line);
        }
    }
}

impl Effects {
    /// The effects as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let per_frame = |seconds: f64| seconds / self.n_frames.max(1) as f64 * 1e6;
        let digits = |value: f64| format_digits(value, 3);
        let head = ("effect", "", "memory", "us a frame", "share");
        let mut lines = vec![format!(
            "{:<20}{:<5}{:>10}{:>12}{:>8}  because of",
            head.0, head.1, head.2, head.3, head.4
        )];
        for row in &self.rows {
            let share = 100.0 * row.seconds / self.seconds.max(f64::MIN_POSITIVE);
            let because = match row.because.len() {
                0 => String::new(),
                n if n <= NAMES_TOLD => row.because.join(", "),
                n => {
                    format!("{} and {} more", row.because[..NAMES_TOLD].join(", "), n - NAMES_TOLD)
                }
            };
            let line = if row.is_on {
                format!(
                    "{:<20}{:<5}{:>10}{:>12}{:>7}%  {because}",
                    row.name,
                    "on",
                    bytes(row.n_bytes),
                    digits(per_frame(row.seconds)),
                    if share > 0.0 && share < 0.01 { "<0.01".to_owned() } else { digits(share) },
                )
            } else {
                format!("{:<20}off", row.name)
            };
            lines.push(line);
        }
        let (total, awake) = self.islands;
        lines.push(format!("islands: {total}, {awake} awake, {} asleep", total - awake.min(total)));
        lines.push(match self.n_frames {
            0 => "no frame is timed: something has no value in the next ones".to_owned(),
            n => format!(
                "a frame takes {} us, over {n} frames of a copy",
                digits(per_frame(self.seconds))
            ),
        });
        lines
    }
}

fn bytes(n: usize) -> String {
    match n {
        0 => "-".to_owned(),
        n if n < 10_000 => format!("{n} B"),
        n if n < 10_000_000 => format!("{} kB", n / 1000),
        n => format!("{} MB", n / 1_000_000),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stay_apart_however_small_a_share() {
        let row = |seconds| Row {
            name: "ghosts",
            is_on: true,
            because: vec!["expose".to_owned()],
            n_bytes: 480,
            seconds,
        };
        let rows = [1e-9, 1.23e-5, 0.1234, 1.0].map(row).to_vec();
        let effects = Effects { rows, islands: (1, 1), n_frames: 240, seconds: 1.0 };
        for line in &effects.lines()[1..5] {
            assert_eq!(line.split_whitespace().count(), 7, "{line}");
        }
    }
}
