//! Receipts: the position error that one claims against the true one.

use std::ops::Range;

use super::Count;
use crate::program::{Program, has_missed, may_have_changed_branch, places, position_error};
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::motion::Motion;
use crate::reference::plane::{Place, distance, farthest, polar};
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// How much a claim may be off, either way.
const TIMES: f64 = 10.0;
/// Below this part of the size an error is rounding.
const ROUNDING: f64 = 1e-14;
/// Frames of a run.
const N_FRAMES: usize = 120;

/// Four-bars that pass a dead point by little, and by more.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut low = Count::new("receipt too low by more than 10 times (times)", "0");
    let mut low_near = Count::new("the same after a nearly singular passage (times)", "0");
    let mut high = Count::new("receipt too high by more than 10 times (times)", "");
    let mut silent = Count::new("receipt without a position error", "");
    for seed in seeds {
        let mut random = Random::new("receipt", seed);
        let is_near = random.chance(0.5);
        let gap = if is_near { random.log_within(1e-6, 1e-3) } else { random.within(0.1, 0.6) };
        let scene = four_bar(gap, &mut random);
        let tolerance = random.pick(&[1e-4, 1e-6, 1e-8]);
        let Some((claimed, error)) = claimed_and_true(&scene, tolerance) else { continue };
        let rounding = ROUNDING * scene.size(&scene.start);
        let Some(claimed) = claimed else {
            silent.add(seed, true, error);
            continue;
        };
        silent.add(seed, false, 0.0);
        let (claimed, error) = (claimed.max(rounding), error.max(rounding));
        let count = if is_near { &mut low_near } else { &mut low };
        count.add(seed, error > TIMES * claimed, error / claimed);
        high.add(seed, claimed > TIMES * error, claimed / error);
    }
    vec![low, low_near, high, silent]
}

/// What the receipt of a run claims, and the worst error of its frames; none where the motion
/// ends, or is on another branch, or a frame missed.
fn claimed_and_true(scene: &Scene, tolerance: f64) -> Option<(Option<f64>, f64)> {
    let mut program = Program::after(&scene.script()).expect("the script has no mistake");
    program.must(&format!("set tolerance {tolerance}"));
    // One command, so one receipt, that shows every frame.
    let names = scene.names();
    let said = program.must(&format!("for i in 1..{N_FRAMES} {{ step; print {names} }}"));
    if has_missed(&said.told) || may_have_changed_branch(&said.told) {
        return None;
    }
    let mut motion = Motion::new(scene, &scene.start);
    let mut worst = 0.0;
    for (k, line) in said.printed.iter().enumerate() {
        if !motion.advance(scene.dt * (k + 1) as f64) {
            return None;
        }
        worst = f64::max(worst, farthest(&motion.x, &places(line)));
    }
    (worst < 0.1 * scene.size(&scene.start)).then(|| (position_error(&said.told), worst))
}

/// A crank that turns fully, and misses its dead point by a gap where it is opposite to the
/// ground: there coupler and rocker are all but one line.
fn four_bar(gap: f64, random: &mut Random) -> Scene {
    loop {
        let (a, d) = (random.within(0.6, 1.2), random.within(2.0, 3.5));
        let b = random.within(1.0, 3.0);
        let c = a + d + gap - b;
        if c < 0.5 || (b - c).abs() > d - a - 0.2 {
            continue;
        }
        let phase = random.within(1.2, 2.2);
        let [x, y] = polar(a, phase);
        let diagonal = distance([x, y], [d, 0.0]);
        let (ex, ey) = ((d - x) / diagonal, -y / diagonal);
        let along = (b * b - c * c + diagonal * diagonal) / (2.0 * diagonal);
        let across = random.sign() * (b * b - along * along).sqrt();
        let end: Place = [x + along * ex - across * ey, y + along * ey + across * ex];
        let mut scene = Scene { dt: random.pick(&[1.0_f64, 2.0]).to_radians(), ..Scene::default() };
        let (o, g) = (scene.ground([0.0, 0.0]), scene.ground([d, 0.0]));
        let (p, q) = (scene.point([x, y]), scene.point(end));
        scene.add(&[o, p], Kind::Motor { radius: a, phase, speed: 1.0 });
        scene.add(&[p, q], Kind::Length(Allowed::exactly(b)));
        scene.add(&[g, q], Kind::Length(Allowed::exactly(c)));
        return scene;
    }
}
