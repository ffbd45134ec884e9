//! After any sequence of statements: what is said to have converged has, at the values of now.

use std::ops::Range;

use super::Count;
use crate::program::{Program, Said, Verdict, has_missed, verdict};
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::make::{Recipe, scene};
use crate::reference::plane::{Place, distance};
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// Statements of a sequence.
const N_STATEMENTS: usize = 12;
/// A violation within this many tolerances is within the tolerance: the sizes are not the same.
const SLACK: f64 = 10.0;

/// A scene with one length whose value is an expression, `base + factor * x` of a point.
#[derive(Clone)]
struct State {
    scene: Scene,
    base: f64,
    factor: f64,
    measured: usize,
    tolerance: f64,
}

impl State {
    fn random(random: &mut Random) -> Self {
        loop {
            let recipe = Recipe {
                n_points: 5,
                n_frozen: 2,
                n_placing: random.below(2),
                n_measuring: 3,
                noise: 0.3,
                lengths: 0.5,
                limits: 0.3,
            };
            let mut scene = scene(&recipe, random);
            let is_plain = |kind: &Kind| !kind.is_captured() && !matches!(kind, Kind::Motor { .. });
            if !scene.constraints.iter().all(|c| is_plain(&c.kind)) {
                continue;
            }
            let measured = random.below(2);
            let factor = random.within(-0.4, 0.4);
            let l = distance(scene.made_at[2], scene.made_at[3]);
            let base = l - factor * scene.made_at[measured][0];
            scene.add(&[2, 3], Kind::Length(Allowed::exactly(l)));
            return Self { scene, base, factor, measured, tolerance: 1e-12 };
        }
    }

    fn script(&self) -> String {
        let last = self.scene.constraints.len() - 1;
        let others: Vec<usize> = (0..last).collect();
        format!(
            "{}c{last}: length p2 p3 = {} + {} * p{}.x\n",
            self.scene.only(&others).script(),
            self.base,
            self.factor,
            self.measured
        )
    }

    /// The violation at a pose, relative to what is within the tolerance.
    fn off(&self, x: &[Place]) -> f64 {
        let mut scene = self.scene.clone();
        let value = self.base + self.factor * x[self.measured][0];
        let last = scene.constraints.len() - 1;
        scene.constraints[last].kind = Kind::Length(Allowed::exactly(value));
        scene.violation(x, 0.0) / (self.tolerance * scene.size(x)).max(1e-15)
    }

    /// A statement, and the state after it.
    fn changed(&self, random: &mut Random) -> (String, Self) {
        let mut next = self.clone();
        let n = next.scene.constraints.len();
        let p = random.below(5);
        let k = random.below(n);
        let shift = [random.within(-0.5, 0.5), random.within(-0.5, 0.5)];
        let text = match random.below(9) {
            0 => {
                next.scene.constraints[k].is_on = false;
                format!("off c{k}")
            }
            1 | 2 => {
                next.scene.constraints[k].is_on = true;
                format!("on c{k}")
            }
            3 => {
                next.scene.is_frozen[p] = !next.scene.is_frozen[p];
                format!("{} p{p}", if next.scene.is_frozen[p] { "freeze" } else { "thaw" })
            }
            4 => format!("move p{p} to p{p} + ({}, {})", shift[0], shift[1]),
            5 => format!("drag p{p} to p{p} + ({}, {}) over 2", shift[0], shift[1]),
            6 => {
                next.tolerance = random.pick(&[1e-3, 1e-6, 1e-12]);
                format!("set tolerance {}", next.tolerance)
            }
            7 => {
                if let (Kind::Length(range), true) =
                    (&mut next.scene.constraints[k].kind, k < n - 1)
                {
                    *range = Allowed::exactly(range.lo.max(0.5) + random.within(-0.2, 0.2));
                    format!("change c{k} = {}", range.lo)
                } else {
                    "solve".to_owned()
                }
            }
            _ => "step".to_owned(),
        };
        (text, next)
    }
}

/// Statements of all sorts, each followed by a frame.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut frames = Count::new(
        "after any sequence, a frame: converged but wrong (violation over the tolerance)",
        "0",
    );
    let mut solves = Count::new(
        "after any sequence, a solve: converged but wrong (violation over the tolerance)",
        "0",
    );
    let mut screen = Count::new(
        "after any statement: `check` calls a pose converged that is not (the same)",
        "0",
    );
    let mut refused = Count::new("sequences that end with a live value that there cannot be", "");
    for seed in seeds {
        let mut random = Random::new("sequence", seed);
        let mut state = State::random(&mut random);
        let mut program = Program::after(&state.script()).expect("the script has no mistake");
        let mut ends_early = false;
        for _ in 0..N_STATEMENTS {
            let (text, next) = state.changed(&mut random);
            // A refusal changes nothing.
            if program.run(&text).is_ok() {
                state = next;
            }
            let check = program.check();
            if check.verdict == Some(Verdict::Converged) && !check.is_drawn_unsolved {
                let off = state.off(&program.places(&state.scene.names()));
                screen.add(seed, off > SLACK, off);
            }
            // A length that is measured on the pose may become less than 0 as points move.
            let Ok(Said { told, .. }) = program.run("step") else {
                ends_early = true;
                break;
            };
            if !has_missed(&told) {
                let off = state.off(&program.places(&state.scene.names()));
                frames.add(seed, off > SLACK, off);
            }
            if random.chance(0.1) {
                program.must("undo");
            }
            if !random.chance(0.3) {
                continue;
            }
            let Ok(Said { told, .. }) = program.run("solve") else {
                ends_early = true;
                break;
            };
            if verdict(&told) == Some(Verdict::Converged) {
                let off = state.off(&program.places(&state.scene.names()));
                solves.add(seed, off > SLACK, off);
            }
        }
        refused.add(seed, ends_early, 0.0);
    }
    vec![frames, solves, screen, refused]
}
