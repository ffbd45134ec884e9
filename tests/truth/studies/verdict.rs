//! Verdicts: what is said to have converged has, and what is called contradictory is.

use std::ops::Range;

use super::Count;
use crate::program::{Program, Verdict, has_missed};
use crate::reference::make::{Recipe, scene};
use crate::reference::plane::Place;
use crate::reference::random::Random;
use crate::reference::scene::Scene;
use crate::reference::solve::solution;

/// The tolerance that is set, relative to the size, and what of it the reference lets pass: its
/// size is not exactly the program's.
const TOLERANCE: f64 = 1e-12;
const SLACK: f64 = 10.0;

/// Scenes of all kinds, as drawn, solved, and through some frames.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut wrong = Count::new("solved: converged but wrong (violation over the size)", "0");
    let mut moving = Count::new("frames: converged but wrong (violation over the size)", "0");
    let mut screen =
        Count::new("`check` calls an unsolved pose converged (violation over the size)", "0");
    let mut false_contradiction = Count::new("scenes with a solution called contradictory", "0");
    let mut missed = Count::new("scenes with a solution not solved, whatever is said", "");
    for seed in seeds {
        let mut random = Random::new("verdict", seed);
        let scene = any_scene(&mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        let size = scene.size(&scene.start);
        let at_start = scene.violation(&scene.start, 0.0);
        let check = program.check();
        let is_called_solved =
            check.verdict == Some(Verdict::Converged) && !check.is_drawn_unsolved;
        screen.add(seed, is_called_solved && at_start > 1e-6 * size, at_start / size);
        let verdict = program.solve();
        let x = program.places(&scene.names());
        let (off, rounding) = (scene.violation(&x, 0.0), rounding(&x));
        let is_solved = off <= SLACK * (TOLERANCE * scene.size(&x)).max(rounding);
        wrong.add(seed, verdict == Verdict::Converged && !is_solved, off / size);
        missed.add(seed, verdict != Verdict::Converged, 0.0);
        let mut has_solution = || solution(&scene, &scene.made_at, 0.0, 1, &mut random).is_some();
        let is_false = verdict == Verdict::Contradictory && has_solution();
        false_contradiction.add(seed, is_false, 0.0);
        for k in 1..=3 {
            let told = program.must("step").told;
            let x = program.places(&scene.names());
            let off = scene.violation(&x, f64::from(k) / 60.0);
            let is_solved = off <= SLACK * (TOLERANCE * scene.size(&x)).max(self::rounding(&x));
            moving.add(seed, !has_missed(&told) && !is_solved, off / size);
        }
    }
    vec![wrong, moving, screen, false_contradiction, missed]
}

/// What the coordinates of a pose cannot say.
fn rounding(x: &[Place]) -> f64 {
    let largest = x.iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()));
    8.0 * f64::EPSILON * largest
}

/// A scene with a solution, of all kinds, that starts near it or not so near.
fn any_scene(random: &mut Random) -> Scene {
    let n_points = 3 + random.below(3);
    let recipe = Recipe {
        n_points,
        n_frozen: random.below(3),
        n_placing: random.below(4),
        n_measuring: 1 + random.below(5),
        noise: random.log_within(0.01, 2.0),
        lengths: 0.3,
        limits: 0.4,
    };
    let mut scene = scene(&recipe, random);
    if random.chance(0.2) {
        let p = random.below(scene.weight.len());
        scene.weight[p] = random.log_within(0.1, 10.0);
    }
    scene
}
