//! Branches: motions in large frames held against the same in tiny steps, or in closed form.

use std::ops::Range;

use super::Count;
use crate::program::{
    Program, began_where_branches_meet, has_missed, may_have_changed_branch, places,
};
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::motion::Motion;
use crate::reference::plane::{Place, distance, farthest, polar};
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// Another branch is farther away than this part of the size.
const ELSEWHERE: f64 = 1e-4;
/// Degrees a frame.
const FRAMES: [f64; 5] = [5.0, 10.0, 30.0, 60.0, 90.0];
/// Turns of the crank that are followed.
const TURNS: f64 = 1.0;

/// How a motion went in the program.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Course {
    Followed,
    /// On the right branch all the way, and said to have changed perhaps.
    Doubted,
    /// On another branch, and that was said.
    Announced,
    /// On another branch, and nothing was said.
    Silent,
}

/// How often motions of one kind are lost.
struct Losses([Count; 3]);

impl Losses {
    fn new(kind: &str, silent: &'static str) -> Self {
        let doubted = format!("{kind}: called changed, but followed");
        Self([
            Count::new(format!("{kind}: on another branch"), ""),
            Count::new(format!("{kind}: on another branch, silent"), silent),
            Count::new(doubted, ""),
        ])
    }

    fn add(&mut self, seed: u64, course: Course) {
        let Self([lost, silent, doubted]) = self;
        let is_lost = matches!(course, Course::Announced | Course::Silent);
        lost.add(seed, is_lost, 0.0);
        silent.add(seed, course == Course::Silent, 0.0);
        doubted.add(seed, course == Course::Doubted, 0.0);
    }
}

fn counts<const N: usize>(losses: [Losses; N]) -> Vec<Count> {
    losses.into_iter().flat_map(|losses| losses.0).collect()
}

/// Triangles on three legs, which are solved as a whole.
pub fn triads(seeds: Range<u64>) -> Vec<Count> {
    in_all_frames("triad", triad, seeds)
}

/// Chains of dyads, which are solved one by one.
pub fn six_bars(seeds: Range<u64>) -> Vec<Count> {
    in_all_frames("six-bar of dyads", six_bar, seeds)
}

fn in_all_frames(kind: &str, make: fn(&mut Random) -> Scene, seeds: Range<u64>) -> Vec<Count> {
    let mut losses = [
        Losses::new(&format!("{kind}, 5 degrees a frame"), "0"),
        Losses::new(&format!("{kind}, 10 and 30 degrees a frame"), "0"),
        Losses::new(&format!("{kind}, 60 and 90 degrees a frame"), ""),
    ];
    for seed in seeds {
        let mut random = Random::new(kind, seed);
        if let Some(scene) = begun(make(&mut random), &mut random) {
            compare(&scene, seed, &mut losses);
        }
    }
    counts(losses)
}

/// A mechanism as it is, or beside a dead point of its own, on its way back from there: a first
/// frame is hardest where nothing is known of the motion and much happens. None where no dead
/// point is met.
fn begun(scene: Scene, random: &mut Random) -> Option<Scene> {
    if random.chance(0.4) {
        return Some(scene);
    }
    let mut motion = Motion::new(&scene, &scene.start);
    if motion.advance(std::f64::consts::TAU) {
        return None;
    }
    let time = motion.time - random.log_within(1e-4, 0.2);
    let mut motion = Motion::new(&scene, &scene.start);
    (time > 0.0 && motion.advance(time)).then_some(())?;
    let mut scene = Scene { made_at: motion.x.clone(), start: motion.x, ..scene.clone() };
    for c in &mut scene.constraints {
        if let Kind::Motor { phase, speed, .. } = &mut c.kind {
            (*phase, *speed) = (*phase + time * *speed, -*speed);
        }
    }
    Some(scene)
}

/// One motion in all sizes of frames.
fn compare(scene: &Scene, seed: u64, [slow, fast, wild]: &mut [Losses; 3]) {
    // Five degrees divide all the others.
    let fine = FRAMES[0].to_radians();
    let mut motion = Motion::new(scene, &scene.start);
    let mut poses = vec![scene.start.clone()];
    let n = (TURNS * 360.0 / FRAMES[0]) as u32;
    while poses.len() as u32 <= n && motion.advance(fine * poses.len() as f64) {
        poses.push(motion.x.clone());
    }
    for degrees in FRAMES {
        let every = (degrees / FRAMES[0]).round() as usize;
        let right: Vec<&Vec<Place>> = poses.iter().step_by(every).skip(1).collect();
        if right.is_empty() {
            continue;
        }
        let losses = match degrees {
            ..=5.0 => &mut *slow,
            ..=30.0 => &mut *fast,
            _ => &mut *wild,
        };
        let is_right = |k: usize, x: &[Place]| is_near(scene, right[k], x);
        losses.add(seed, course(scene, degrees.to_radians(), right.len(), is_right));
    }
}

fn is_near(scene: &Scene, right: &[Place], x: &[Place]) -> bool {
    farthest(right, x) <= ELSEWHERE * scene.size(right)
}

/// Lets the program run frame by frame, up to the first that is on another branch.
fn course(
    scene: &Scene,
    dt: f64,
    n_frames: usize,
    is_right: impl Fn(usize, &[Place]) -> bool,
) -> Course {
    let text = Scene { dt, ..scene.clone() }.script();
    let mut program = Program::after(&text).expect("the script has no mistake");
    let command = format!("step; print {}", scene.names());
    let (mut is_warned, mut is_doubted) = (false, false);
    for k in 0..n_frames {
        let said = program.must(&command);
        let is_missed = has_missed(&said.told);
        is_warned |= is_missed || began_where_branches_meet(&said.told);
        is_doubted |= may_have_changed_branch(&said.told);
        if !is_missed && !is_right(k, &places(&said.printed.concat())) {
            return if is_warned || is_doubted { Course::Announced } else { Course::Silent };
        }
    }
    if is_doubted { Course::Doubted } else { Course::Followed }
}

/// A motor on the origin, its phase as it stands.
fn crank(scene: &mut Scene, radius: f64, phase: f64) -> usize {
    let o = scene.ground([0.0, 0.0]);
    let a = scene.point(polar(radius, phase));
    scene.add(&[o, a], Kind::Motor { radius, phase, speed: 1.0 });
    a
}

fn rod(scene: &mut Scene, a: usize, b: usize) {
    let l = distance(scene.made_at[a], scene.made_at[b]);
    scene.add(&[a, b], Kind::Length(Allowed::exactly(l)));
}

fn anywhere(random: &mut Random) -> Place {
    [random.within(-4.0, 4.0), random.within(-4.0, 4.0)]
}

/// A line on the ground through a place.
fn slider(scene: &mut Scene, p: usize, random: &mut Random) {
    let [x, y] = scene.made_at[p];
    let phi = random.angle();
    let [dx, dy] = polar(random.within(1.0, 4.0), phi);
    let (a, b) = (scene.ground([x - dx, y - dy]), scene.ground([x + dx, y + dy]));
    scene.add(&[p, a, b], Kind::Glider { is_bounded: false });
}

/// A triangle on three legs: to the crank, to the ground, and to the ground or a slider.
pub fn triad(random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    let (radius, phase) = (random.within(0.5, 1.5), random.angle());
    let a = crank(&mut scene, radius, phase);
    let body = [0; 3].map(|_| scene.point(anywhere(random)));
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        rod(&mut scene, body[i], body[j]);
    }
    rod(&mut scene, a, body[0]);
    let g = scene.ground(anywhere(random));
    rod(&mut scene, g, body[1]);
    if random.chance(0.5) {
        let h = scene.ground(anywhere(random));
        rod(&mut scene, h, body[2]);
    } else {
        slider(&mut scene, body[2], random);
    }
    scene
}

/// A dyad on the crank and a second one on the first.
pub fn six_bar(random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    let (radius, phase) = (random.within(0.5, 1.5), random.angle());
    let mut from = crank(&mut scene, radius, phase);
    for _ in 0..2 {
        let p = scene.point(anywhere(random));
        rod(&mut scene, from, p);
        if random.chance(0.5) {
            let g = scene.ground(anywhere(random));
            rod(&mut scene, g, p);
        } else {
            slider(&mut scene, p, random);
        }
        from = p;
    }
    scene
}

/// Four-bars whose bars are equal in pairs, and sliders with a rod as long as the crank: known in
/// closed form, through the change points too.
pub fn change_points(seeds: Range<u64>) -> Vec<Count> {
    let of = |kind: &str| Losses::new(&format!("{kind}, up to 30 degrees a frame"), "0");
    let mut parallelogram = of("parallelogram");
    let mut crossed = of("antiparallelogram");
    let mut kite = of("kite");
    let mut centre = of("slider with rod and crank of one length");
    for seed in seeds {
        let mut random = Random::new("change points", seed);
        let degrees = random.pick(&[5.0, 10.0, 27.0, 30.0, 30.0]);
        // A later frame ends in the change point, or beside it, or anywhere.
        let beside = match random.below(4) {
            0 => 0.0,
            1 => random.within(0.0, 360.0),
            _ => random.log_within(1e-4, 1.0) * random.sign(),
        };
        let start = beside - degrees * random.within(2.0, 12.0).round();
        let a = random.within(0.5, 2.0);
        let b = a * random.within(1.05, 3.0);
        let case = Case { phase: start.to_radians(), dt: degrees.to_radians(), a, b };
        parallelogram.add(seed, case.four_bar(b, a, |_, p| p));
        crossed.add(seed, case.four_bar(b, a, Case::mirrored));
        let side = random.sign();
        kite.add(seed, case.kite(side));
        centre.add(seed, case.slider());
    }
    counts([parallelogram, crossed, kite, centre])
}

/// A crank of length a at an angle, and another length.
#[derive(Clone, Copy)]
struct Case {
    phase: f64,
    dt: f64,
    a: f64,
    b: f64,
}

/// Two turns.
fn n_frames(dt: f64) -> usize {
    (4.0 * std::f64::consts::PI / dt).ceil() as usize
}

impl Case {
    fn at(self, k: usize) -> Self {
        Self { phase: self.phase + self.dt * k as f64, ..self }
    }

    fn crank(self) -> Place {
        polar(self.a, self.phase)
    }

    /// Ground and coupler b, crank and rocker a; `place` makes the crossed one of the coupler's
    /// end of the parallelogram.
    fn four_bar(self, coupler: f64, rocker: f64, place: impl Fn(Self, Place) -> Place) -> Course {
        let end = |case: Self| {
            let [x, y] = case.crank();
            place(case, [x + case.b, y])
        };
        let mut scene = Scene::default();
        let a = crank(&mut scene, self.a, self.phase);
        let d = scene.ground([self.b, 0.0]);
        let c = scene.point(end(self));
        scene.add(&[a, c], Kind::Length(Allowed::exactly(coupler)));
        scene.add(&[d, c], Kind::Length(Allowed::exactly(rocker)));
        self.judged(&scene, c, end)
    }

    /// Mirrored in the line from the crank's end to the rocker's ground.
    fn mirrored(self, [px, py]: Place) -> Place {
        let [x, y] = self.crank();
        let (vx, vy) = (self.b - x, -y);
        let along = (vx * (px - x) + vy * (py - y)) / (vx * vx + vy * vy);
        [2.0 * (x + along * vx) - px, 2.0 * (y + along * vy) - py]
    }

    /// Ground and crank a, coupler and rocker b: the coupler's end is on the bisector.
    fn kite(self, side: f64) -> Course {
        let end = |case: Self| {
            let half = 0.5 * case.phase;
            let [along, across] = polar(case.a, half);
            polar(along + side * (case.b * case.b - across * across).sqrt(), half)
        };
        let mut scene = Scene::default();
        let a = crank(&mut scene, self.a, self.phase);
        let d = scene.ground([self.a, 0.0]);
        let c = scene.point(end(self));
        scene.add(&[a, c], Kind::Length(Allowed::exactly(self.b)));
        scene.add(&[d, c], Kind::Length(Allowed::exactly(self.b)));
        self.judged(&scene, c, end)
    }

    fn slider(self) -> Course {
        let end = |case: Self| [2.0 * case.crank()[0], 0.0];
        let mut scene = Scene::default();
        let a = crank(&mut scene, self.a, self.phase);
        let (l, r) = (scene.ground([-1.0, 0.0]), scene.ground([1.0, 0.0]));
        let c = scene.point(end(self));
        scene.add(&[a, c], Kind::Length(Allowed::exactly(self.a)));
        scene.add(&[c, l, r], Kind::Glider { is_bounded: false });
        self.judged(&scene, c, end)
    }

    fn judged(self, scene: &Scene, c: usize, end: impl Fn(Self) -> Place) -> Course {
        let is_right = |k: usize, x: &[Place]| {
            distance(end(self.at(k + 1)), x[c]) <= ELSEWHERE * (self.a + self.b)
        };
        course(scene, self.dt, n_frames(self.dt), is_right)
    }
}
