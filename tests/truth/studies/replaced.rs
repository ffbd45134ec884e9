//! A constraint replaced at rest by another: nothing that was known of the old one may let the
//! new one sleep.

use std::fmt::Write;
use std::ops::Range;

use super::Count;
use crate::program::{Program, Verdict, has_missed};
use crate::reference::constraint::Kind;
use crate::reference::make::{add, stated};
use crate::reference::plane::{Place, direction, way};
use crate::reference::random::Random;
use crate::reference::scene::Scene;

/// Kinds as a user tells them apart.
const WORDS: [&str; 23] = [
    "coordinate",
    "coincidence",
    "equivalence",
    "equal",
    "length",
    "orientation",
    "motor",
    "glider",
    "bounded glider",
    "hinge",
    "cog",
    "distance",
    "parallel",
    "perpendicular",
    "rigid",
    "rack",
    "horizontal",
    "multiple",
    "vertical",
    "elbow",
    "pinion",
    "belt",
    "symmetric",
];
/// A violation above this, relative to the size, is not within any tolerance that is set here.
const WRONG: f64 = 1e-9;

/// All kinds by all kinds, by `delete` and a new statement, by `off` and `on`, and by `change`.
pub fn run(seeds: Range<u64>) -> Vec<Count> {
    let mut sleeps = Count::new(
        "constraint replaced at rest: converged but wrong (violation over the size)",
        "0",
    );
    let mut changes =
        Count::new("value changed at rest: converged but wrong (violation over the size)", "0");
    for seed in seeds {
        // Every kind by every kind, again and again with other scenes.
        let pair = seed as usize % (WORDS.len() * WORDS.len());
        let (old, new) = (WORDS[pair / WORDS.len()], WORDS[pair % WORDS.len()]);
        let mut random = Random::new("replaced", seed);
        let off = replaced(old, new, &mut random);
        sleeps.add(seed, off > WRONG, off);
        if let Some(off) = changed(old, &mut random) {
            changes.add(seed, off > WRONG, off);
        }
    }
    vec![sleeps, changes]
}

/// A scene at rest under one constraint of a kind, its first, and perhaps a rod.
fn at_rest(word: &str, random: &mut Random) -> Scene {
    let mut scene = Scene::default();
    let at = |random: &mut Random, k: f64| [k + random.within(-0.5, 0.5), random.within(-2.0, 2.0)];
    scene.ground(at(random, 0.0));
    for k in 1..=3 {
        let p = scene.point(at(random, f64::from(k)));
        scene.is_frozen[p] = random.chance(0.2);
    }
    add(&mut scene, word, random);
    if random.chance(0.5) {
        add(&mut scene, "length", random);
    }
    scene
}

/// How far a constraint that takes the place of another is off although all is called solved.
fn replaced(old: &str, new: &str, random: &mut Random) -> f64 {
    let mut scene = at_rest(old, random);
    // The points of the old one first: where both hold the same points they are most alike.
    let mut points = scene.constraints[0].points.clone();
    points.extend((0..scene.made_at.len()).filter(|p| !scene.constraints[0].points.contains(p)));
    // What it captures is captured elsewhere.
    let elsewhere: Vec<Place> = scene
        .made_at
        .iter()
        .zip(&scene.is_frozen)
        .map(|(at, is_frozen)| if *is_frozen { *at } else { at.map(|c| c + random.sign()) })
        .collect();
    let (points, kind) = stated(&elsewhere, &points, new, random);
    let mut text = scene.script();
    let is_new = random.chance(0.5);
    let b = scene.add(&points, kind);
    let statement = Scene::statement(&scene.constraints[b]);
    let moves = |text: &mut String, x: &[Place]| {
        for (p, [x, y]) in x.iter().enumerate() {
            writeln!(text, "move p{p} to ({x}, {y})").expect("a string takes all");
        }
    };
    if !is_new {
        moves(&mut text, &elsewhere);
        text.push_str(&statement);
        writeln!(text, "\noff c{b}").expect("a string takes all");
        moves(&mut text, &scene.made_at);
    }
    text.push_str("step 2\n");
    let away = if random.chance(0.5) { "delete c0" } else { "off c0" };
    let come = if is_new { statement } else { format!("on c{b}") };
    let [first, second] = if random.chance(0.5) { [away, &come] } else { [&come, away] };
    writeln!(text, "{first}\n{second}").expect("a string takes all");
    let Ok(mut program) = Program::after(&text) else { return 0.0 };
    scene.constraints[0].is_on = false;
    let x = program.places(&scene.names());
    let places: Vec<Place> = points.iter().map(|&p| x[p]).collect();
    // Wheels mesh from the pose at which they are made or switched on, a new body has its shape.
    let kind = &mut scene.constraints[b].kind;
    match kind {
        Kind::Cog { ratio, .. } => *kind = Kind::cog(*ratio, [0, 1, 2, 3].map(|k| places[k])),
        Kind::Belt { radii, .. } => *kind = Kind::belt(*radii, [0, 1, 2, 3].map(|k| places[k])),
        Kind::Rack { radius, is_said: true, .. } => {
            *kind = Kind::pinion(radius.abs(), [0, 1, 2, 3].map(|k| places[k]));
        }
        Kind::Rack { .. } => *kind = Kind::rack([0, 1, 2, 3].map(|k| places[k])),
        Kind::Rigid(made_at) if is_new => *made_at = places,
        // A motor that is switched on goes on from where its point then is, if that is anywhere.
        Kind::Motor { phase, .. } if !is_new && places[0] != places[1] => {
            *phase = direction(way(places[0], places[1]));
        }
        Kind::Elbow { phase, .. } if !is_new && places[0] != places[1] => {
            let link = direction(way(places[2], places[3]));
            *phase = direction(way(places[0], places[1])) - link;
        }
        _ => {}
    }
    off_although_solved(&mut program, &scene, 5.0)
}

/// The same for one whose value is changed; none for a kind that has none.
fn changed(word: &str, random: &mut Random) -> Option<f64> {
    let mut scene = at_rest(word, random);
    let text = scene.script() + "step 2\n";
    let points = scene.constraints[0].points.clone();
    let (_, kind) = stated(&scene.made_at, &points, word, random);
    let whole = Scene::statement(&crate::reference::constraint::Constraint {
        kind: kind.clone(),
        ..scene.constraints[0].clone()
    });
    let part = match kind {
        Kind::Coordinate(_) | Kind::Hinge(_) => &whole[whole.rfind(" at ")?..],
        Kind::Equal(_) | Kind::Length(_) | Kind::Orientation(_) | Kind::Distance(_) => {
            let from = [" = ", " <= ", " >= ", " in "].iter().find_map(|sign| whole.find(sign))?;
            &whole[from..]
        }
        Kind::Motor { .. } => &whole[whole.find(" radius ")?..],
        _ => return None,
    };
    let mut program = Program::after(&format!("{text}change c0{part}\n")).ok()?;
    let turned = match &scene.constraints[0].kind {
        Kind::Motor { speed, .. } => speed * 2.0 / 60.0,
        _ => 0.0,
    };
    scene.constraints[0].kind = match kind {
        // It keeps what it has turned so far.
        Kind::Motor { radius, phase, speed } => {
            Kind::Motor { radius, phase: phase + turned, speed }
        }
        kind => kind,
    };
    Some(off_although_solved(&mut program, &scene, 5.0))
}

/// The violation, relative to the size, after frames that are all called solved, or a solve.
fn off_although_solved(program: &mut Program, scene: &Scene, frames: f64) -> f64 {
    let told = program.must("step 3").told;
    let mut off = 0.0;
    let mut look = |program: &mut Program| {
        let x = program.places(&scene.names());
        let time = frames / 60.0;
        off = f64::max(off, scene.violation(&x, time) / scene.size(&x));
    };
    if !has_missed(&told) {
        look(program);
    }
    if program.solve() == Verdict::Converged {
        look(program);
    }
    off
}
