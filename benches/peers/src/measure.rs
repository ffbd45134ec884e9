//! How well and how fast: the same code for every peer.

use std::collections::BTreeMap;

use crate::exact;
use crate::peer::Peer;
use crate::work::{Place, Relation, Work};

/// Rounds of timing: at least and at most.
const ROUNDS: (usize, usize) = (5, 31);
/// Seconds spent timing one work, once the least rounds are done.
const TIMING: f64 = 2.0;
/// What is shorter than this is not timed well.
const SHORTEST: f64 = 5e-3;
/// A peer that can stop between frames gets no more seconds than this in a round.
const ROUND: f64 = 0.15;
/// Nor in the pass that looks at every frame.
const LOOKING: f64 = 4.0;

/// What came of one peer on one work.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    /// Median time of the processor for a frame, microseconds.
    pub micros: f64,
    /// That against linkwork, round by round: the median.
    pub ratio: f64,
    /// The largest constraint error of a frame against the size, over all frames looked at.
    pub error: f64,
    /// Frames looked at, those on a wrong branch, those the peer says it did not solve.
    pub n_frames: usize,
    pub n_wrong: usize,
    pub n_failed: usize,
}

/// The largest error of what was to hold, driven points included.
fn error(work: &Work, k: usize, x: &[Place]) -> f64 {
    let distance = |a: usize, b: usize| (x[b][0] - x[a][0]).hypot(x[b][1] - x[a][1]);
    let held = work.ground.iter().map(|&p| (p, work.start[p]));
    let driven = work.driven.iter().map(|&(p, about)| (p, work.target(about, k)));
    let places = held.chain(driven).map(|(p, at)| (x[p][0] - at[0]).hypot(x[p][1] - at[1]));
    let relations = work.relations.iter().map(|relation| match *relation {
        Relation::Length(a, b, l) => (distance(a, b) - l).abs(),
        Relation::Equal([a, b, c, d]) => (distance(a, b) - distance(c, d)).abs(),
        Relation::OnLine(p, [a, b]) => {
            let e = [x[b][0] - x[a][0], x[b][1] - x[a][1]];
            let r = [x[p][0] - x[a][0], x[p][1] - x[a][1]];
            (e[0] * r[1] - e[1] * r[0]).abs() / e[0].hypot(e[1])
        }
    });
    let worst = places.chain(relations).fold(0.0, |worst: f64, e| {
        // A NaN is the worst there is.
        if e.is_nan() { f64::INFINITY } else { worst.max(e) }
    });
    worst / work.size()
}

/// Frame by frame, with a look at each.
fn look(work: &Work, peer: &mut dyn Peer) -> Result<(Outcome, f64, usize), String> {
    let mut outcome = Outcome::default();
    let mut truth = work.start.clone();
    let (mut seconds, mut k) = (0.0, 0);
    for _ in 0..work.offsets.len() {
        let run = peer.run(k, 1)?;
        k += 1;
        seconds += run.seconds;
        let x = peer.pose();
        if x.len() != work.start.len() {
            return Err("broke down".into());
        }
        outcome.error = outcome.error.max(error(work, k, &x));
        outcome.n_failed += run.n_failed;
        if !work.plan.is_empty() {
            for &(p, about) in &work.driven {
                truth[p] = work.target(about, k);
            }
            exact::follow(&work.plan, &mut truth);
            outcome.n_wrong += usize::from(exact::is_wrong(&work.plan, &truth, &x));
        }
        if seconds > LOOKING && !peer.needs_whole_blocks() {
            break;
        }
    }
    outcome.n_frames = k;
    Ok((outcome, seconds / k as f64, k))
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A peer on its way through the rounds.
struct Runner<'a> {
    name: String,
    peer: Box<dyn Peer + 'a>,
    outcome: Outcome,
    /// Frames done, frames of a run, and runs of a round.
    k: usize,
    n: usize,
    n_runs: usize,
    times: Vec<f64>,
}

impl Runner<'_> {
    /// Seconds of a round.
    fn round(&mut self) -> Result<f64, String> {
        let mut seconds = 0.0;
        for _ in 0..self.n_runs {
            seconds += self.peer.run(self.k, self.n)?.seconds;
            self.k += self.n;
        }
        Ok(seconds)
    }
}

/// Looks at every frame of every peer, then times them in turn, one round after the other.
pub fn compare<'a>(
    work: &'a Work,
    peers: Vec<(String, Result<Box<dyn Peer + 'a>, String>)>,
) -> BTreeMap<String, Result<Outcome, String>> {
    let mut found = BTreeMap::new();
    let mut runners = Vec::new();
    for (name, peer) in peers {
        match peer.and_then(|mut peer| look(work, &mut *peer).map(|looked| (peer, looked))) {
            Err(why) => drop(found.insert(name, Err(why))),
            Ok((mut peer, (outcome, mut seconds, mut k))) => {
                // One frame at a time is not what is timed.
                if seconds < ROUND
                    && let Ok(run) = peer.run(k, work.block)
                {
                    k += work.block;
                    seconds = run.seconds / work.block as f64;
                }
                let most = (ROUND / seconds).max(1.0) as usize;
                let least = (SHORTEST / seconds.max(1e-9)) as usize;
                let wanted = work.block.max(least).min(most);
                let (n, n_runs) = if peer.needs_whole_blocks() {
                    (work.block, wanted.div_ceil(work.block))
                } else {
                    (wanted, 1)
                };
                runners.push(Runner { name, peer, outcome, k, n, n_runs, times: Vec::new() });
            }
        }
    }
    let mut spent = 0.0;
    for round in 0..ROUNDS.1 {
        if round >= ROUNDS.0 && spent > TIMING {
            break;
        }
        for runner in &mut runners {
            if let Ok(seconds) = runner.round() {
                runner.times.push(seconds / (runner.n * runner.n_runs) as f64);
                spent += seconds;
            }
        }
    }
    let ours = runners.iter().find(|r| r.name == crate::OURS).map(|r| r.times.clone());
    for mut runner in runners {
        if runner.times.is_empty() {
            found.insert(runner.name, Err("broke down".into()));
            continue;
        }
        if let Some(ours) = &ours {
            let mut ratios: Vec<f64> =
                runner.times.iter().zip(ours).map(|(theirs, ours)| theirs / ours).collect();
            runner.outcome.ratio = median(&mut ratios);
        }
        runner.outcome.micros = 1e6 * median(&mut runner.times);
        found.insert(runner.name, Ok(runner.outcome));
    }
    found
}
