//! Random scenes that are known to have a solution: they are built around one.

use std::f64::consts::PI;

use super::constraint::{Kind, Range};
use super::plane::{self, Place, direction, distance, polar, way};
use super::random::Random;
use super::scene::Scene;

/// How a random scene is built.
pub struct Recipe {
    /// Points to begin with, the first few of them frozen.
    pub n_points: usize,
    pub n_frozen: usize,
    /// Constraints that each add a point where they hold.
    pub n_placing: usize,
    /// Constraints among the points there are.
    pub n_measuring: usize,
    /// How far each coordinate of the start may be from the solution.
    pub noise: f64,
    /// The share of the measuring ones that are lengths.
    pub lengths: f64,
    /// The share of them that are limits.
    pub limits: f64,
}

/// Kinds that hold at any pose with the right value.
const MEASURING: [&str; 9] =
    ["coordinate", "equal", "length", "orientation", "motor", "cog", "distance", "rigid", "rack"];
/// Kinds that hold only where a point is in the right place.
const PLACING: [&str; 8] = [
    "coincidence",
    "equivalence",
    "equal",
    "glider",
    "bounded glider",
    "hinge",
    "parallel",
    "perpendicular",
];
/// More of these. They are in no random scene, since the rates known of those are of the scenes
/// that their seeds gave before there were such kinds.
const PLACED_ON_REQUEST: [&str; 4] = ["multiple", "horizontal", "vertical", "symmetric"];

/// A scene whose points are made at a solution and start away from it.
pub fn scene(recipe: &Recipe, random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    for k in 0..recipe.n_points {
        let at = apart(&scene.made_at, random);
        if k < recipe.n_frozen {
            scene.ground(at)
        } else {
            scene.point(at)
        };
    }
    for _ in 0..recipe.n_placing {
        let word = random.pick(&PLACING);
        place(&mut scene, word, random);
    }
    for _ in 0..recipe.n_measuring {
        let is_length = random.chance(recipe.lengths);
        let word = if is_length { "length" } else { random.pick(&MEASURING) };
        measure(&mut scene, word, recipe.limits, random);
    }
    for (p, is_frozen) in scene.is_frozen.clone().into_iter().enumerate() {
        if !is_frozen {
            let push = |c: f64| c + random.within(-recipe.noise, recipe.noise);
            scene.start[p] = scene.made_at[p].map(push);
        }
    }
    scene
}

/// A place not next to any of these.
fn apart(places: &[Place], random: &mut Random) -> Place {
    loop {
        let at = [random.within(-4.0, 4.0), random.within(-4.0, 4.0)];
        if places.iter().all(|p| distance(*p, at) > 0.5) {
            return at;
        }
    }
}

/// Points in different places, if as many are found.
fn distinct(n: usize, x: &[Place], random: &mut Random) -> Option<Vec<usize>> {
    let is_far = |p: usize, q: usize| distance(x[p], x[q]) > 1e-3;
    (n <= x.len()).then_some(())?;
    (0..50).find_map(|_| {
        let chosen = random.different(n, x.len());
        let are_apart = chosen.iter().all(|&p| chosen.iter().all(|&q| p == q || is_far(p, q)));
        are_apart.then_some(chosen)
    })
}

/// Adds a point where a constraint of a kind holds, and the constraint.
fn place(scene: &mut Scene, word: &str, random: &mut Random) {
    let Some(chosen) = distinct(3, &scene.made_at, random) else { return };
    let [a, b, c] = [0, 1, 2].map(|k| chosen[k]);
    let [xa, xb, xc] = [a, b, c].map(|p| scene.made_at[p]);
    let v = way(xa, xb);
    let along = |from: Place, v: Place, k: f64| [from[0] + k * v[0], from[1] + k * v[1]];
    let length = random.within(0.3, 1.5) * random.sign();
    let (at, points, kind): (Place, &[Option<usize>], Kind) = match word {
        "coincidence" => (xa, &[Some(a), None], Kind::Coincidence),
        "equivalence" => (along(xc, v, 1.0), &[Some(a), Some(b), Some(c), None], Kind::Equivalence),
        "equal" => {
            let at = along(xc, polar(plane::length(v), random.angle()), 1.0);
            (at, &[Some(a), Some(b), Some(c), None], Kind::Equal(Range::exactly(0.0)))
        }
        "multiple" => {
            // As far as `length` times AB, from C.
            let at = along(xc, polar(plane::length(v), random.angle()), length);
            (at, &[Some(c), None, Some(a), Some(b)], Kind::Multiple(length.abs()))
        }
        "hinge" => (along(xa, v, length), &[None, Some(a), Some(b)], Kind::Hinge(length)),
        "parallel" => (along(xc, v, length), &[Some(a), Some(b), Some(c), None], Kind::Parallel),
        "perpendicular" => {
            let across = [-v[1], v[0]];
            (along(xc, across, length), &[Some(a), Some(b), Some(c), None], Kind::Perpendicular)
        }
        "horizontal" => (along(xa, [1.0, 0.0], length), &[Some(a), None], Kind::Horizontal),
        "vertical" => (along(xa, [0.0, 1.0], length), &[Some(a), None], Kind::Vertical),
        "symmetric" => {
            let arm = way(xa, xc);
            let mirrored = plane::length(arm);
            let angle = 2.0 * direction(v) - direction(arm);
            let at = along(xa, polar(mirrored, angle), 1.0);
            (at, &[Some(c), None, Some(a), Some(b)], Kind::Symmetric)
        }
        "bounded glider" => {
            let at = along(xa, v, random.within(0.0, 1.0));
            (at, &[None, Some(a), Some(b)], Kind::Glider { is_bounded: true })
        }
        _ => {
            let at = along(xa, v, length);
            (at, &[None, Some(a), Some(b)], Kind::Glider { is_bounded: false })
        }
    };
    let p = scene.point(at);
    let points: Vec<usize> = points.iter().map(|q| q.unwrap_or(p)).collect();
    scene.add(&points, kind);
}

/// Adds a constraint of a kind that holds where the points are made.
fn measure(scene: &mut Scene, word: &str, limits: f64, random: &mut Random) {
    let (points, kind) = held(&scene.made_at, word, limits, random);
    scene.add(&points, kind);
}

/// A constraint of a measuring kind that holds at a pose; a limit in this share of the cases, on
/// its end, or by a margin.
pub fn held(x: &[Place], word: &str, limits: f64, random: &mut Random) -> (Vec<usize>, Kind) {
    let n = match word {
        "coordinate" => 1,
        "length" | "motor" => 2,
        "distance" => 3,
        _ => 4,
    };
    let Some(p) = distinct(n, x, random) else {
        return held(x, "length", limits, random);
    };
    let at = |k: usize| x[p[k]];
    let value = |kind: &Kind| {
        let places: Vec<Place> = p.iter().map(|&p| x[p]).collect();
        kind.equations(&places, 0.0)[0].f
    };
    let zero = Range::exactly(0.0);
    let mut range = |value: f64, least: f64, most: f64| {
        if !random.chance(limits) {
            return Range::exactly(value);
        }
        let margin = random.pick(&[0.0, 0.2, 1.0]);
        let (lo, hi) = ((value - margin).max(least), (value + margin).min(most));
        match random.below(3) {
            0 if hi < most => Range { lo: least, hi },
            1 if lo > least => Range { lo, hi: most },
            _ => Range { lo, hi: (value + 0.5).min(most) },
        }
    };
    let far = f64::INFINITY;
    let kind = match word {
        "coordinate" => Kind::Coordinate(at(0)),
        "length" => Kind::Length(range(value(&Kind::Length(zero)), 0.0, far)),
        "equal" => Kind::Equal(range(value(&Kind::Equal(zero)), -far, far)),
        "distance" => Kind::Distance(range(value(&Kind::Distance(zero)), -far, far)),
        "orientation" => Kind::Orientation(range(value(&Kind::Orientation(zero)), -PI, PI)),
        "motor" => {
            let v = way(at(0), at(1));
            let speed = random.within(-1.0, 1.0);
            Kind::Motor { radius: plane::length(v), phase: direction(v), speed }
        }
        "cog" => Kind::cog(random.pick(&[-0.25, -2.0, 0.5, 1.0, 3.0]), [0, 1, 2, 3].map(at)),
        "elbow" => {
            let (crank, link) = (way(at(0), at(1)), way(at(2), at(3)));
            let phase = direction(crank) - direction(link);
            Kind::Elbow { radius: plane::length(crank), phase }
        }
        "belt" => Kind::belt([1.0, 2.0], [0, 1, 2, 3].map(at)),
        "pinion" => Kind::pinion(0.5, [0, 1, 2, 3].map(at)),
        "rack" => Kind::rack([0, 1, 2, 3].map(at)),
        _ => Kind::Rigid(p.iter().map(|&p| x[p]).collect()),
    };
    (p, kind)
}

/// A constraint of a kind on the first of these points that it takes, with values that it need
/// not have at the pose.
pub fn stated(
    x: &[Place],
    points: &[usize],
    word: &str,
    random: &mut Random,
) -> (Vec<usize>, Kind) {
    let n = match word {
        "coordinate" => 1,
        "coincidence" | "length" | "motor" | "horizontal" | "vertical" => 2,
        "glider" | "bounded glider" | "hinge" | "distance" => 3,
        _ => 4,
    };
    let p = points[..n].to_vec();
    let at = |k: usize| x[p[k]];
    let any = random.within(0.2, 4.0);
    let value = random.pick(&[0.0, 0.5 * PI, 1.0, any]);
    let range = match random.below(4) {
        0 => Range { lo: value, hi: value + 1.0 },
        _ => Range::exactly(value),
    };
    let kind = match word {
        "coordinate" => Kind::Coordinate([value, random.within(-2.0, 2.0)]),
        "coincidence" => Kind::Coincidence,
        "equivalence" => Kind::Equivalence,
        "equal" => Kind::Equal(range),
        "multiple" => Kind::Multiple(value.max(0.5)),
        "length" => Kind::Length(range),
        // A range of angles ends within half a turn.
        "orientation" if range.is_exact() => Kind::Orientation(range),
        "orientation" => Kind::Orientation(Range { lo: value.min(2.0), hi: value.min(2.0) + 1.0 }),
        "motor" => Kind::Motor { radius: value, phase: random.angle(), speed: 0.0 },
        "elbow" => Kind::Elbow { radius: value, phase: random.angle() },
        "glider" => Kind::Glider { is_bounded: false },
        "bounded glider" => Kind::Glider { is_bounded: true },
        "hinge" => Kind::Hinge(value),
        "cog" => Kind::cog(2.0, [0, 1, 2, 3].map(at)),
        "pinion" => Kind::pinion(value.max(0.5), [0, 1, 2, 3].map(at)),
        "belt" => Kind::belt([1.0, random.pick(&[2.0, -0.5])], [0, 1, 2, 3].map(at)),
        "distance" => Kind::Distance(range),
        "parallel" => Kind::Parallel,
        "perpendicular" => Kind::Perpendicular,
        "horizontal" => Kind::Horizontal,
        "vertical" => Kind::Vertical,
        "symmetric" => Kind::Symmetric,
        "rigid" => Kind::Rigid(p.iter().map(|&p| x[p]).collect()),
        _ => Kind::rack([0, 1, 2, 3].map(at)),
    };
    (p, kind)
}

/// Adds a constraint of any kind that holds where the points are made, with a point of its own if
/// it needs one.
pub fn add(scene: &mut Scene, word: &str, random: &mut Random) {
    let is_placing = PLACING.contains(&word) || PLACED_ON_REQUEST.contains(&word);
    if is_placing && !MEASURING.contains(&word) {
        place(scene, word, random);
    } else {
        measure(scene, word, 0.3, random);
    }
}
