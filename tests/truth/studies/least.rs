//! Moves: one solve and each frame of a drag go no farther than they have to.

use std::ops::Range;

use super::Count;
use crate::program::{Program, Verdict, has_missed, places};
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::dense::norm;
use crate::reference::make::{Recipe, scene};
use crate::reference::plane::{self, Place, polar};
use crate::reference::random::Random;
use crate::reference::scene::Scene;
use crate::reference::solve::{nearest, pushed};

/// How much farther than the least counts as far, and as too far.
const FAR: f64 = 1.1;
const TOO_FAR: f64 = 1.5;
/// A way shorter than this part of the size is not compared.
const SHORT: f64 = 1e-6;

/// One solve of a scene with freedom left.
pub fn solves(seeds: Range<u64>) -> Vec<Count> {
    let mut far =
        Count::new("one solve with freedom left goes more than 1.1 times the least", "1 %");
    let mut too_far =
        Count::new("one solve with freedom left goes more than 1.5 times the least", "0");
    for seed in seeds {
        let mut random = Random::new("least", seed);
        let scene = with_freedom(&mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        if program.solve() != Verdict::Converged {
            continue;
        }
        let x = program.places(&scene.names());
        let size = scene.size(&scene.start);
        let mut starts = vec![scene.start.clone(), x.clone()];
        starts.extend((0..3).map(|_| pushed(&scene, &scene.start, 0.1 * size, &mut random)));
        let Some((least, _)) = nearest(&scene, &scene.start, 0.0, &starts) else { continue };
        let gone = norm(&scene.way(&scene.start, &x));
        if least > SHORT * size {
            far.add(seed, gone > FAR * least, gone / least);
            too_far.add(seed, gone > TOO_FAR * least, gone / least);
        }
    }
    vec![far, too_far]
}

/// A scene with fewer equations than coordinates, off its solution.
fn with_freedom(random: &mut Random) -> Scene {
    loop {
        let n_points = 3 + random.below(3);
        let n_frozen = 1 + random.below(2);
        let recipe = Recipe {
            n_points,
            n_frozen,
            n_placing: random.below(2),
            n_measuring: 1 + random.below(2 * (n_points - n_frozen)),
            noise: random.log_within(0.02, 1.5),
            lengths: 0.7,
            limits: 0.1,
        };
        let scene = scene(&recipe, random);
        let rows = scene.rows(&scene.made_at, 0.0);
        let sigma = rows.jacobian.svd();
        if sigma.sigma.iter().all(|s| s.is_finite()) && sigma.rank(1e-6) < scene.n_columns() {
            return scene;
        }
    }
}

/// Chains dragged by one end, frame by frame.
pub fn drags(seeds: Range<u64>) -> Vec<Count> {
    let mut far = Count::new("chain dragged, a frame goes more than 1.1 times the least", "1 %");
    let mut too_far = Count::new("chain dragged, a frame goes more than 1.5 times the least", "0");
    for seed in seeds {
        let mut random = Random::new("drag", seed);
        let mut scene = Scene::default();
        let mut at = [0.0, 0.0];
        let mut last = scene.ground(at);
        let n = 3 + random.below(4);
        for k in 1..=n {
            let (rod, phi) = (random.within(0.5, 1.5), random.within(-1.5, 1.5));
            let [dx, dy] = polar(rod, phi);
            at = [at[0] + dx, at[1] + dy];
            let p = if k == n { scene.ground(at) } else { scene.point(at) };
            scene.add(&[last, p], Kind::Length(Allowed::exactly(rod)));
            last = p;
        }
        let frames = random.pick(&[4, 12, 40]);
        let (reach, phi) = (random.within(0.2, 0.9), random.within(-1.5, 1.5));
        let to = polar(reach * plane::length(at), plane::direction(at) + phi);
        let names = scene.names();
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        let mut x = scene.start.clone();
        for k in 1..=frames {
            let share = f64::from(k) / f64::from(frames);
            let hand: Place = [0, 1].map(|i| at[i] + share * (to[i] - at[i]));
            // Frame by frame, so that each can be looked at.
            let said = program
                .must(&format!("drag p{last} to ({}, {}) over 1; print {names}", hand[0], hand[1]));
            if has_missed(&said.told) {
                break;
            }
            x[last] = hand;
            let next = places(&said.printed.concat());
            let starts = [x.clone(), next.clone()];
            if let Some((least, _)) = nearest(&scene, &x, 0.0, &starts)
                && least > SHORT
            {
                let gone = norm(&scene.way(&x, &next));
                far.add(seed, gone > FAR * least, gone / least);
                too_far.add(seed, gone > TOO_FAR * least, gone / least);
            }
            x = next;
        }
    }
    vec![far, too_far]
}
