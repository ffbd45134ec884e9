//! What is asked of a driver: dead points with and without a tracer, and velocities.

use std::ops::Range;

use super::Count;
use super::branch::{six_bar, triad};
use crate::program::{Program, dead_points, has_missed, may_be_lost, turns_fully};
use crate::reference::motion::Motion;
use crate::reference::plane::{self, farthest, polar};
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// A four-bar with crank, coupler, rocker and ground.
struct FourBar {
    sides: [f64; 4],
    angle: f64,
    side: f64,
}

impl FourBar {
    /// One that can be put together.
    fn random(random: &mut Random) -> Self {
        loop {
            let sides = [0; 4].map(|_| random.within(0.5, 4.0));
            let bar = Self { sides, angle: random.angle(), side: random.sign() };
            let [_, b, c, _] = sides;
            let gap = bar.diagonal();
            // Not next to a dead point, and not next to a change point.
            let is_clear = ((b - c).abs() + 0.05..b + c - 0.05).contains(&gap);
            if is_clear && bar.margin() > 0.05 {
                return bar;
            }
        }
    }

    /// The distance from the crank's end to the rocker's ground.
    fn diagonal(&self) -> f64 {
        let [a, _, _, d] = self.sides;
        (a * a + d * d - 2.0 * a * d * libm::cos(self.angle)).sqrt()
    }

    /// How far it is from the nearest with a change point: from a pair of bars as long as the
    /// other pair.
    fn margin(&self) -> f64 {
        let [a, b, c, d] = self.sides;
        [a + b - c - d, a + c - b - d, a + d - b - c].map(f64::abs).into_iter().fold(9.0, f64::min)
    }

    /// The dead points of the crank to the left and to the right of where it is, radians; none
    /// where it turns fully.
    fn dead_points(&self) -> Option<[f64; 2]> {
        let [a, b, c, d] = self.sides;
        // The diagonal stretches coupler and rocker, or folds them.
        let cosine = |reach: f64| (a * a + d * d - reach * reach) / (2.0 * a * d);
        let [far, near] = [cosine(b + c), cosine(b - c)];
        let now = self.angle.abs();
        let (lo, hi) = (
            if near < 1.0 { libm::acos(near) } else { 0.0 },
            if far > -1.0 { libm::acos(far) } else { std::f64::consts::PI },
        );
        // By symmetry the diagonal tells the crank's angle up to its sign.
        match (near < 1.0, far > -1.0) {
            (false, false) => None,
            (true, false) => Some([lo, 2.0 * std::f64::consts::PI - lo]),
            (false, true) => Some([-hi, hi]),
            (true, true) if now == self.angle => Some([lo, hi]),
            (true, true) => Some([-hi, -lo]),
        }
    }

    fn script(&self) -> String {
        let [a, b, c, d] = self.sides;
        let [x, y] = polar(a, self.angle);
        // The coupler's end by the triangle over the diagonal.
        let gap = self.diagonal();
        let (ex, ey) = ((d - x) / gap, -y / gap);
        let along = (b * b - c * c + gap * gap) / (2.0 * gap);
        let across = self.side * (b * b - along * along).max(0.0).sqrt();
        let (px, py) = (x + along * ex - across * ey, y + along * ey + across * ex);
        format!(
            "point A = (0, 0) frozen, D = ({d}, 0) frozen, B = ({x}, {y}), C = ({px}, {py})
             length B C = {b}
             length C D = {c}
             crank: motor A B radius {a} speed 1 phase {}
             solve\n",
            self.angle
        )
    }
}

/// Dead points of four-bars, known in closed form.
pub fn dead_points_of_four_bars(seeds: Range<u64>) -> Vec<Count> {
    let mut plain = Count::new("dead points of a four-bar: off by more than 1e-9 degree", "0");
    let mut traced = Count::new("the same with tracers, near and far", "0");
    for seed in seeds {
        let mut random = Random::new("dead points", seed);
        let bar = FourBar::random(&mut random);
        let right = bar.dead_points();
        let mut program = Program::after(&bar.script()).expect("the script has no mistake");
        let (is_wrong, off) = judged(&mut program, right);
        plain.add(seed, is_wrong, off);
        let ratio = random.log_within(1.5, 1000.0);
        program.must(&format!("point P = B + {ratio} * (C - B); hinge P on B C at {ratio}"));
        let (is_wrong, off) = judged(&mut program, right);
        traced.add(seed, is_wrong, off);
    }
    vec![plain, traced]
}

/// The same for bars in pairs: at the change points the motions cross.
pub fn with_change_points(seeds: Range<u64>) -> Vec<Count> {
    let mut lost = Count::new("crank that turns fully through change points: called lost", "0");
    let mut traced = Count::new("the same with a tracer", "0");
    for seed in seeds {
        let mut random = Random::new("change points", seed);
        // The crank is the shortest, and the shortest and the longest are as long as the others.
        let (a, b) = (random.within(0.5, 1.5), random.within(2.0, 4.0));
        let c = random.within(a + 0.3, b);
        let d = b + c - a;
        let sides = if random.chance(0.5) { [a, b, c, d] } else { [a, d, c, b] };
        let bar = FourBar { sides, angle: random.within(0.5, 2.5), side: random.sign() };
        let mut program = Program::after(&bar.script()).expect("the script has no mistake");
        let told = program.must("limits crank").printed.concat();
        lost.add(seed, may_be_lost(&told) || !turns_fully(&told), 0.0);
        let ratio = random.log_within(1.5, 1000.0);
        program.must(&format!("point P = B + {ratio} * (C - B); hinge P on B C at {ratio}"));
        let told = program.must("limits crank").printed.concat();
        traced.add(seed, may_be_lost(&told) || !turns_fully(&told), 0.0);
    }
    vec![lost, traced]
}

/// Whether what `limits` says is wrong, and by how many degrees.
fn judged(program: &mut Program, right: Option<[f64; 2]>) -> (bool, f64) {
    let told = program.must("limits crank").printed.concat();
    let Some(right) = right else {
        return (!turns_fully(&told), 0.0);
    };
    let found = dead_points(&told);
    if found.len() != 2 || may_be_lost(&told) {
        return (true, 0.0);
    }
    let off = right.iter().zip(&found).map(|(right, found)| {
        crate::reference::constraint::wrapped(right.to_degrees() - found, 360.0).abs()
    });
    let off = off.fold(0.0, f64::max);
    // They are printed to 1e-9.
    (off > 1.5e-9, off)
}

/// Velocities of everything that one motor drives.
pub fn velocities(seeds: Range<u64>) -> Vec<Count> {
    let mut off = Count::new("velocities: off by more than 1e-9 of the largest", "0");
    for seed in seeds {
        let mut random = Random::new("velocities", seed);
        let scene = if random.chance(0.5) { triad(&mut random) } else { six_bar(&mut random) };
        let scene = Scene { dt: 0.01, ..scene };
        let mut motion = Motion::new(&scene, &scene.start);
        if !motion.advance(0.05) || motion.least_step < 1e-3 {
            continue;
        }
        let Some(velocity) = motion.velocity() else { continue };
        let right = scene.moved(&vec![[0.0; 2]; scene.start.len()], &velocity);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        if has_missed(&program.must("step 5").told) {
            continue;
        }
        // On another branch, other velocities are right.
        if farthest(&motion.x, &program.places(&scene.names())) > 1e-6 {
            continue;
        }
        let points = (0..scene.start.len()).map(|p| format!("velocity({})", Scene::name(p)));
        let found = program.places(&points.collect::<Vec<_>>().join(", "));
        let largest = right.iter().map(|v| plane::length(*v)).fold(0.0, f64::max);
        let wrong = farthest(&right, &found) / largest;
        off.add(seed, wrong > 1e-9, wrong);
    }
    vec![off]
}
