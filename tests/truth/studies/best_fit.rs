//! Best fits: starts on a line of centres, pivots dragged back into reach, contradictory scenes.

use std::f64::consts::PI;
use std::ops::Range;

use super::Count;
use crate::program::{Program, Verdict, has_missed};
use crate::reference::constraint::{Kind, Range as Allowed};
use crate::reference::make::{Recipe, scene, stated};
use crate::reference::plane::{self, Place, distance, polar};
use crate::reference::random::Random;
use crate::reference::scene::Scene;
use crate::reference::solve::{fit, solution};

/// Starts where the way out is not seen: on the line of two centres, or beside it by so much of
/// the rod.
pub fn line_of_centres(seeds: Range<u64>) -> Vec<Count> {
    let mut exact = Count::new("start exactly on the line of centres: false best fit", "0");
    let mut beside = [
        Count::new("the same, 1e-12 of the rod off the line, `step`", "0"),
        Count::new("the same, 1e-8 of the rod off the line, `step`", "0"),
        Count::new("the same, 1e-6 of the rod off the line, `step`", "0"),
        Count::new("the same, 1e-4 of the rod off the line, `step`", "0"),
    ];
    for seed in seeds {
        let mut random = Random::new("line of centres", seed);
        let (scene, rod) = on_the_line(&mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        exact.add(seed, program.solve() != Verdict::Converged, 0.0);
        for (count, off) in beside.iter_mut().zip([1e-12, 1e-8, 1e-6, 1e-4]) {
            let mut scene = scene.clone();
            let p = scene.start.len() - 1;
            scene.start[p][1] += off * rod;
            let mut program = Program::after(&scene.script()).expect("the script has no mistake");
            count.add(seed, has_missed(&program.must("step").told), 0.0);
        }
    }
    [exact].into_iter().chain(beside).collect()
}

/// A point that two constraints place off the x axis, but that starts on it, and their length.
fn on_the_line(random: &mut Random) -> (Scene, f64) {
    let mut scene = Scene::default();
    let o = scene.ground([0.0, 0.0]);
    let rod = random.within(0.5, 2.0);
    let length = |l: f64| Kind::Length(Allowed::exactly(l));
    let phi = random.within(0.2, PI - 0.2);
    let target = polar(rod, phi);
    let start = [random.within(0.1, 3.0) * rod * random.sign(), 0.0];
    if random.chance(0.25) {
        // Where a rod meets a line across the axis.
        let (a, b) = (scene.ground([target[0], -1.0]), scene.ground([target[0], 1.0]));
        let p = scene.point(start);
        scene.add(&[o, p], length(rod));
        scene.add(&[p, a, b], Kind::Glider { is_bounded: false });
    } else {
        let q = scene.ground([random.within(0.2, 3.0) * rod * random.sign(), 0.0]);
        let p = scene.point(start);
        scene.add(&[o, p], length(rod));
        let other = distance(scene.made_at[q], target);
        scene.add(&[q, p], length(other));
    }
    (scene, rod)
}

/// Pivots dragged out of reach, and back into it.
pub fn reach(seeds: Range<u64>) -> Vec<Count> {
    let mut dyads = Count::new("dyad drawn out of reach, dragged into reach: never solved", "0");
    let mut chains = Count::new("chain of 3 to 6 rods, the same: never solved", "0");
    let mut back = Count::new("either dragged out of reach and back: never solved", "0");
    let mut others = Count::new("mechanism with a way back, the same: never solved", "0");
    for seed in seeds {
        let mut random = Random::new("reach", seed);
        let n = if random.chance(0.4) { 2 } else { 3 + random.below(4) };
        let (mut scene, q, home) = chain(n, &mut random);
        let far = random.within(1.1, 3.0);
        let way = [0, 1].map(|k| home[k] * far * n as f64 / plane::length(home));
        let frames = random.pick(&[1, 10, 60]);
        let starts_far = random.chance(0.5);
        if starts_far {
            // Never solved so far: nothing is known of the way back.
            scene.made_at[q] = way;
            scene.start[q] = way;
        }
        let drag = |[x, y]: Place| format!("drag p{q} to ({x}, {y}) over {frames}; ");
        let away = if starts_far { String::new() } else { drag(way) };
        let text = format!("{}step; {away}solve; {}step 20", scene.script(), drag(home));
        let mut program = Program::after(&text).expect("the script has no mistake");
        let is_lost = program.solve() != Verdict::Converged;
        let count = match n {
            _ if !starts_far => &mut back,
            2 => &mut dyads,
            _ => &mut chains,
        };
        count.add(seed, is_lost, 0.0);
        if let Some(is_lost) = mechanism_there_and_back(&mut random) {
            others.add(seed, is_lost, 0.0);
        }
    }
    vec![dyads, chains, back, others]
}

/// A chain of rods from the origin to a pivot, which belongs at a place within reach.
fn chain(n: usize, random: &mut Random) -> (Scene, usize, Place) {
    let mut scene = Scene::default();
    let mut at = [0.0, 0.0];
    let mut last = scene.ground(at);
    let (mut reach, mut longest) = (0.0, 0.0_f64);
    for k in 1..=n {
        let rod = random.within(0.5, 1.5);
        reach += rod;
        longest = longest.max(rod);
        let phi = random.within(-0.8, 0.8);
        let [dx, dy] = polar(rod, phi);
        at = [at[0] + dx, at[1] + dy];
        let p = if k == n { scene.ground(at) } else { scene.point(at) };
        scene.add(&[last, p], Kind::Length(Allowed::exactly(rod)));
        last = p;
    }
    // The pivot belongs somewhere between where the chain is straight and where it folds.
    let folded = (2.0 * longest - reach).max(0.0);
    let home = random.within(folded + 0.05 * reach, 0.98 * reach);
    let home = at.map(|c| c * home / plane::length(at));
    (scene, last, home)
}

/// Whether a random scene whose frozen point is dragged away and back is lost; none where it was
/// in reach all the time.
fn mechanism_there_and_back(random: &mut Random) -> Option<bool> {
    let recipe = Recipe {
        n_points: 4,
        n_frozen: 2,
        n_placing: random.below(2),
        n_measuring: 3 + random.below(2),
        noise: 0.0,
        lengths: 0.7,
        limits: 0.1,
    };
    let scene = scene(&recipe, random);
    if scene
        .constraints
        .iter()
        .any(|c| c.kind.is_captured() || matches!(c.kind, Kind::Motor { .. }))
    {
        return None;
    }
    let [x, y] = scene.made_at[0];
    let (dx, dy) = (random.within(-15.0, 15.0), random.within(-15.0, 15.0));
    let frames = random.pick(&[1, 10, 60]);
    let mut program = Program::after(&scene.script()).ok()?;
    program.must("solve");
    let told = program.must(&format!("drag p0 to ({}, {}) over {frames}", x + dx, y + dy)).told;
    if !has_missed(&told) {
        return None;
    }
    program.must(&format!("drag p0 to ({x}, {y}) over {frames}; step 20"));
    Some(program.solve() != Verdict::Converged)
}

/// Scenes that ask for too much.
pub fn contradictory(seeds: Range<u64>) -> Vec<Count> {
    let mut saddles = Count::new("contradictory scenes: a claimed best fit is a saddle", "0");
    let mut rough = Count::new("best fits with a slope above 1e-5", "0");
    let mut steep = Count::new("best fits with a slope above 1e-9", "0");
    let mut false_words = Count::new("called contradictory although a solution was found", "0");
    for seed in seeds {
        let mut random = Random::new("contradictory", seed);
        let scene = overdetermined(&mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        let verdict = program.solve();
        if !verdict.is_best_fit() {
            continue;
        }
        let x = program.places(&scene.names());
        let fit = fit(&scene, &x, 0.0);
        saddles.add(seed, fit.is_saddle, -fit.curvature);
        rough.add(seed, fit.slope > 1e-5, fit.slope);
        steep.add(seed, fit.slope > 1e-9, fit.slope);
        if verdict == Verdict::Contradictory {
            let is_found = solution(&scene, &x, 0.0, 6, &mut random).is_some();
            false_words.add(seed, is_found, 0.0);
        }
    }
    vec![saddles, rough, steep, false_words]
}

/// A scene that asks for too much: more lengths than coordinates, with values of no pose, or
/// constraints of all kinds that agree but for one or two.
pub fn overdetermined(random: &mut Random) -> Scene {
    match random.below(3) {
        0 => lengths_of_no_pose(random),
        1 => one_value_off(random),
        _ => on_one_line(random),
    }
}

/// Joints drawn on the line of two frozen points, where gliders hold some of them and rods are
/// not long enough, or too long: some would fit beside the line.
fn on_one_line(random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    let span = random.within(4.0, 10.0);
    let (a, b) = (scene.ground([0.0, 0.0]), scene.ground([span, 0.0]));
    let mut from = a;
    for k in 0..2 + random.below(2) {
        let p = scene.point([span * random.within(0.1, 0.9), 0.0]);
        if k == 0 || random.chance(0.3) {
            scene.add(&[p, a, b], Kind::Glider { is_bounded: random.chance(0.3) });
        }
        for to in [from, b] {
            let rod = distance(scene.made_at[p], scene.made_at[to]).max(0.1 * span);
            let by = random.within(0.9, 1.5);
            scene.add(&[to, p], Kind::Length(Allowed::exactly(rod * by)));
        }
        from = p;
    }
    scene
}

fn lengths_of_no_pose(random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    let n_points = 3 + random.below(3);
    for _ in 0..n_points {
        let p = scene.point([random.within(-4.0, 4.0), random.within(-4.0, 4.0)]);
        scene.is_frozen[p] = p == 0 || p == 1 && random.chance(0.5);
    }
    let n = scene.n_columns() + 1 + random.below(3);
    for _ in 0..n {
        let others = ["equal", "orientation", "distance", "glider", "parallel", "hinge"];
        let word = if random.chance(0.8) || n_points < 4 { "length" } else { random.pick(&others) };
        let points = random.different(n_points, n_points);
        let (points, mut kind) = stated(&scene.made_at, &points, word, random);
        if let Kind::Length(range) = &mut kind {
            *range = Allowed::exactly(random.within(0.5, 5.0));
        }
        if points.iter().any(|&p| !scene.is_frozen[p]) {
            scene.add(&points, kind);
        }
    }
    scene
}

fn one_value_off(random: &mut Random) -> Scene {
    let n_points = 3 + random.below(3);
    let n_frozen = 1 + random.below(2);
    let n_placing = random.below(3);
    let recipe = Recipe {
        n_points,
        n_frozen,
        n_placing,
        // The placing ones take at least one of the two coordinates of their points.
        n_measuring: 2 * (n_points - n_frozen) + n_placing + 1,
        noise: 0.3,
        lengths: 0.6,
        limits: 0.1,
    };
    let mut scene = scene(&recipe, random);
    for _ in 0..=random.below(2) {
        let k = random.below(scene.constraints.len());
        match &mut scene.constraints[k].kind {
            Kind::Length(range) => {
                let by = random.log_within(0.4, 3.0);
                *range = Allowed { lo: range.lo * by, hi: range.hi * by };
            }
            Kind::Distance(range) | Kind::Orientation(range) if range.is_exact() => {
                *range = Allowed::exactly(range.lo + random.within(0.2, 1.0) * random.sign());
            }
            Kind::Hinge(ratio) => *ratio += random.within(0.2, 1.0),
            Kind::Coordinate(at) => at[0] += random.within(0.2, 2.0),
            _ => {}
        }
    }
    scene
}
