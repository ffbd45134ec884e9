//! `effects`: what this scene has switched on, because of which statements, and what each costs.

use super::effect_table::{EFFECTS, Rehearsal, Work};
use crate::diag::{format_counted, format_digits};
use crate::interrupt::tick;
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::host::{Host, NO_CLOCK};
use crate::session::state::State;
use crate::session::undo::recorder::Recorder;
use crate::solve::{Budget, Settings, Solver};

/// The effects of a scene, the islands it falls into, and what a frame costs.
#[derive(Debug, Clone)]
pub struct Effects {
    /// Every effect there is, switched on or not.
    pub rows: Vec<EffectRow>,
    /// How many islands there are, and how many of them a frame visits.
    pub islands: (usize, usize),
    /// How many frames were timed, on a copy.
    pub n_frames: u64,
    /// Why none was, if so.
    pub why_none: &'static str,
    /// The wall time they took, looking at the clock left out, seconds.
    pub seconds: f64,
}

/// What one effect came to.
#[derive(Debug, Clone)]
pub struct EffectRow {
    /// Its name.
    pub name: &'static str,
    /// Whether the scene calls for it.
    pub is_on: bool,
    /// The statements that call for it, by name.
    pub because: Vec<String>,
    /// The memory kept for it, bytes.
    pub n_bytes: usize,
    /// The part of the time of those frames that it took, seconds.
    pub seconds: f64,
}

/// Frames that are timed, and the wall time after which no more are begun.
const TIMED_FRAMES: u64 = 240;
const TIMED_SECONDS: f64 = 0.3;

/// Names told of those that call for an effect.
const NAMES_TOLD: usize = 6;

/// Columns of the table, most names left out.
const WIDTH: usize = 68;

/// What a frame takes, in ticks: after so many it is asked whether the user wants to stop.
const FRAME: usize = 100_000;

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
                    tick(FRAME);
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
        // Each may be long in a large scene.
        tick(FRAME);
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

impl Effects {
    /// The effects as lines of text, as a table where that fits.
    pub fn lines(&self, n_columns: usize) -> Vec<String> {
        let mut lines = if n_columns < WIDTH { self.paragraphs() } else { self.table() };
        let (total, awake) = self.islands;
        lines.push(format!("islands: {total}, {awake} awake, {} asleep", total - awake.min(total)));
        lines.push(match self.n_frames {
            0 => format!("no frame is timed: {}", self.why_none),
            n => format!(
                "a frame takes {} us, over {} of a copy",
                self.per_frame(self.seconds),
                format_counted(n, "frame")
            ),
        });
        lines
    }

    fn table(&self) -> Vec<String> {
        let head = ("effect", "", "memory", "us a frame", "share");
        let head = format!(
            "{:<20}{:<5}{:>10}{:>12}{:>8}  because of",
            head.0, head.1, head.2, head.3, head.4
        );
        let row = |row: &EffectRow| {
            if !row.is_on {
                return format!("{:<20}off", row.name);
            }
            let (time, share) = self.cost(row).unwrap_or_else(|| ("-".to_owned(), "-".to_owned()));
            format!(
                "{:<20}{:<5}{:>10}{time:>12}{share:>8}  {}",
                row.name,
                "on",
                bytes(row.n_bytes),
                row.told_because()
            )
        };
        std::iter::once(head).chain(self.rows.iter().map(row)).collect()
    }

    /// What a table says, for pages that have no room for one.
    fn paragraphs(&self) -> Vec<String> {
        let on = |row: &EffectRow| {
            let cost = self.cost(row).map(|(time, share)| format!("{time} us a frame, {share}"));
            let memory = (row.n_bytes > 0).then(|| bytes(row.n_bytes));
            let what: Vec<String> = [cost, memory].into_iter().flatten().collect();
            let says = if what.is_empty() { "on".to_owned() } else { what.join("; ") };
            [format!("{}: {says}", row.name), format!("  because of {}", row.told_because())]
        };
        let off: Vec<&str> =
            self.rows.iter().filter(|row| !row.is_on).map(|row| row.name).collect();
        let mut lines: Vec<String> =
            self.rows.iter().filter(|row| row.is_on).flat_map(on).collect();
        if !off.is_empty() {
            lines.push(format!("off: {}", off.join(", ")));
        }
        lines
    }

    /// The time of an effect in a frame and its share of that, if frames were timed.
    fn cost(&self, row: &EffectRow) -> Option<(String, String)> {
        let share = 100.0 * row.seconds / self.seconds.max(f64::MIN_POSITIVE);
        let share = match share {
            share if share > 0.0 && share < 0.01 => "<0.01%".to_owned(),
            share => format!("{}%", format_digits(share, 3)),
        };
        (self.n_frames > 0).then(|| (self.per_frame(row.seconds), share))
    }

    /// Microseconds a frame.
    fn per_frame(&self, seconds: f64) -> String {
        format_digits(seconds / self.n_frames.max(1) as f64 * 1e6, 3)
    }
}

impl EffectRow {
    fn told_because(&self) -> String {
        match self.because.len() {
            n if n <= NAMES_TOLD => self.because.join(", "),
            n => format!("{} and {} more", self.because[..NAMES_TOLD].join(", "), n - NAMES_TOLD),
        }
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
        let row = |seconds| EffectRow {
            name: "ghosts",
            is_on: true,
            because: vec!["expose".to_owned()],
            n_bytes: 480,
            seconds,
        };
        let rows = [1e-9, 1.23e-5, 0.1234, 1.0].map(row).to_vec();
        let effects = Effects { rows, islands: (1, 1), n_frames: 240, why_none: "", seconds: 1.0 };
        for line in &effects.lines(WIDTH)[1..5] {
            assert_eq!(line.split_whitespace().count(), 7, "{line}");
        }
    }

    #[test]
    fn a_narrow_page_gets_sentences() {
        let row = |name, is_on| EffectRow {
            name,
            is_on,
            because: if is_on { vec!["crank".to_owned()] } else { Vec::new() },
            n_bytes: 480,
            seconds: 0.25,
        };
        let rows = vec![row("clock", true), row("ghosts", false), row("traces", false)];
        let effects = Effects { rows, islands: (1, 1), n_frames: 1, why_none: "", seconds: 1.0 };
        let wanted = [
            "clock: 250000 us a frame, 25%; 480 B",
            "  because of crank",
            "off: ghosts, traces",
            "islands: 1, 1 awake, 0 asleep",
            "a frame takes 1000000 us, over 1 frame of a copy",
        ];
        assert_eq!(effects.lines(40), wanted);
    }
}
