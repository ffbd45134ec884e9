//! What the program says held against the reference, point by point: each study counts what was
//! tried, what was wrong and by how much.

mod best_fit;
mod branch;
mod conflict;
mod driver;
mod effects;
mod least;
mod looser;
mod motor;
mod near_singular;
mod order;
mod receipt;
mod replaced;
mod sequence;
mod verdict;

use std::ops::Range;

/// One rate that was measured.
pub struct Count {
    /// What is wrong in the cases counted as wrong.
    pub what: String,
    /// What the rate is to be.
    pub goal: &'static str,
    pub n_tried: usize,
    pub n_wrong: usize,
    /// The worst case, in the unit that `what` says, and its seed; 0 if nothing was wrong.
    pub worst: f64,
    pub worst_seed: u64,
    /// The seeds of the first few wrong ones.
    pub seeds: Vec<u64>,
}

/// A study: its name, and what it does with some seeds.
pub struct Study {
    pub name: &'static str,
    pub run: fn(Range<u64>) -> Vec<Count>,
}

/// All of them.
pub const ALL: [Study; 23] = [
    Study { name: "verdict", run: verdict::run },
    Study { name: "sequences", run: sequence::run },
    Study { name: "replaced", run: replaced::run },
    Study { name: "line_of_centres", run: best_fit::line_of_centres },
    Study { name: "reach", run: best_fit::reach },
    Study { name: "contradictory", run: best_fit::contradictory },
    Study { name: "conflict", run: conflict::sets },
    Study { name: "redundancy", run: conflict::redundancies },
    Study { name: "least", run: least::solves },
    Study { name: "drags", run: least::drags },
    Study { name: "triads", run: branch::triads },
    Study { name: "six_bars", run: branch::six_bars },
    Study { name: "branches", run: branch::change_points },
    Study { name: "motor", run: motor::run },
    Study { name: "arcs", run: near_singular::arcs },
    Study { name: "ranges", run: near_singular::ranges },
    Study { name: "dead_points", run: driver::dead_points_of_four_bars },
    Study { name: "change_points", run: driver::with_change_points },
    Study { name: "velocities", run: driver::velocities },
    Study { name: "receipts", run: receipt::run },
    Study { name: "looser", run: looser::run },
    Study { name: "effects", run: effects::run },
    Study { name: "order", run: order::run },
];

/// Seeds that are told.
const MOST_SEEDS: usize = 8;

impl Count {
    /// Nothing tried yet.
    pub fn new(what: impl Into<String>, goal: &'static str) -> Self {
        Self {
            what: what.into(),
            goal,
            n_tried: 0,
            n_wrong: 0,
            worst: 0.0,
            worst_seed: 0,
            seeds: Vec::new(),
        }
    }

    /// The head of the table of which [`line`](Self::line) gives a line.
    pub const HEAD: &'static str =
        "| measured | tried | wrong | rate | worst (seed) | to be | seeds |
|---|---|---|---|---|---|---|";

    /// The rate as a line of a table in Markdown.
    pub fn line(&self) -> String {
        let rate = 100.0 * self.n_wrong as f64 / self.n_tried.max(1) as f64;
        let worst = if self.worst > 0.0 {
            format!("{:.1e} ({})", self.worst, self.worst_seed)
        } else {
            String::new()
        };
        let seeds: Vec<String> = self.seeds.iter().map(u64::to_string).collect();
        format!(
            "| {} | {} | {} | {rate:.2} % | {worst} | {} | {} |",
            self.what,
            self.n_tried,
            self.n_wrong,
            self.goal,
            seeds.join(" ")
        )
    }

    /// One case more.
    pub fn add(&mut self, seed: u64, is_wrong: bool, how_bad: f64) {
        self.n_tried += 1;
        if is_wrong {
            self.n_wrong += 1;
            if how_bad > self.worst {
                (self.worst, self.worst_seed) = (how_bad, seed);
            }
            if self.seeds.len() < MOST_SEEDS && self.seeds.last() != Some(&seed) {
                self.seeds.push(seed);
            }
        }
    }
}
