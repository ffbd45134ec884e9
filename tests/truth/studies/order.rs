//! The order of statements is no part of the mechanism.

use std::ops::Range;

use super::Count;
use crate::program::Program;
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::plane::farthest;
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// Two constraints of one pair that contradict each other, in either order.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut differing = Count::new(
        "best fits with other bits when two constraints of one pair swap (length units)",
        "0",
    );
    for seed in seeds {
        let mut random = Random::new("order", seed);
        let mut scene = Scene::default();
        for k in 0..4 {
            let p = scene.point([random.within(-3.0, 3.0), random.within(-3.0, 3.0)]);
            scene.is_frozen[p] = k < 2;
        }
        let length = |random: &mut Random| Kind::Length(Allowed::exactly(random.within(0.5, 4.0)));
        for pair in [[0, 2], [2, 3], [1, 3]] {
            let kind = length(&mut random);
            scene.add(&pair, kind);
        }
        // Two that cannot both hold.
        let pair = random.pick(&[[0, 2], [2, 3], [3, 2], [1, 2]]);
        let (first, second) = (length(&mut random), length(&mut random));
        let one = scene.add(&pair, first);
        let other = scene.add(&pair, second);
        let mut swapped = scene.clone();
        swapped.constraints.swap(one, other);
        let poses = [scene, swapped].map(|scene| {
            let mut program = Program::after(&scene.script()).expect("the script has no mistake");
            let verdict = program.solve();
            (verdict, program.places(&scene.names()))
        });
        if poses[0].0.is_best_fit() {
            let [one, other] = poses.map(|(_, x)| x);
            differing.add(seed, one != other, farthest(&one, &other));
        }
    }
    vec![differing]
}
