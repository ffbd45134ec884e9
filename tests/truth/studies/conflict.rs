//! Sets that `check` and `why` name: do they contradict themselves, and is each member needed?
//! And the lists of what implies what, and the degrees of freedom.

use std::ops::Range;

use super::Count;
use super::best_fit::overdetermined;
use crate::program::{Program, Verdict, is_contradicted};
use crate::reference::dense::Matrix;
use crate::reference::make::{Recipe, scene};
use crate::reference::plane::Place;
use crate::reference::random::Random;
use crate::reference::scene::Scene;
use crate::reference::solve::{pushed, solution};

/// Starts from which a set gets its chance to hold.
const N_STARTS: usize = 12;
/// The same for one that is said to hold.
const MORE_STARTS: usize = 100;
/// What is off by no more than this part of the size holds.
const HELD: f64 = 1e-9;
/// Rows that depend on others do so to rounding times what the pose is off; others do not.
const DEPENDENT: f64 = 1e-9;
/// A matrix has a clear rank where no singular value lies in between.
const UNCLEAR: [f64; 2] = [1e-8, 1e-4];
const CUT: f64 = 1e-6;

/// Conflict sets of scenes that ask for too much.
pub fn sets(seeds: Range<u64>) -> Vec<Count> {
    let mut holding = Count::new("conflict sets of `check` that can hold", "0");
    let mut larger = Count::new("conflict sets of `check` with a member that is not needed", "0");
    let mut disagreeing =
        Count::new("members of such sets that `why` calls satisfied or free of conflict", "0");
    for seed in seeds {
        let mut random = Random::new("conflict", seed);
        let scene = overdetermined(&mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        if program.solve() == Verdict::Converged {
            continue;
        }
        let x = program.places(&scene.names());
        for names in program.check().conflicting {
            let set: Vec<usize> = names.iter().filter_map(|name| place(&scene, name)).collect();
            let mut can_hold = |set: &[usize], n_starts: usize| {
                solution(&scene.only(set), &x, 0.0, n_starts, &mut random).is_some()
            };
            let holds = can_hold(&set, N_STARTS);
            holding.add(seed, holds, 0.0);
            if !holds {
                let is_needed = |k: &usize| {
                    let others: Vec<usize> = set.iter().copied().filter(|c| c != k).collect();
                    can_hold(&others, MORE_STARTS) || is_found(&scene.only(&others), &x)
                };
                larger.add(seed, !set.iter().all(is_needed), 0.0);
            }
            for name in names {
                let lines = program.must(&format!("why {name}")).printed;
                disagreeing.add(seed, !is_contradicted(&lines), 0.0);
            }
        }
    }
    vec![holding, larger, disagreeing]
}

/// Whether the program finds a pose where a scene holds that it has not been seen to hold in: the
/// reference only judges the pose.
fn is_found(scene: &Scene, x: &[Place]) -> bool {
    let mut random = Random::new("others", 0);
    (0..MORE_STARTS).any(|k| {
        let far = [1e-2, 0.1, 0.3, 1.0][k % 4] * scene.size(x);
        let start = pushed(scene, x, far, &mut random);
        let scene = Scene { start, ..scene.clone() };
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        program.solve() == Verdict::Converged
            && scene.violation(&program.places(&scene.names()), 0.0) <= HELD * scene.size(x)
    })
}

fn place(scene: &Scene, name: &str) -> Option<usize> {
    scene.constraints.iter().position(|c| c.name == name)
}

/// What is redundant in scenes at a solution, what implies it, and what is free.
pub fn redundancies(seeds: Range<u64>) -> Vec<Count> {
    let mut lacking = Count::new("redundancy lists that lack a member", "0");
    let mut freedoms = Count::new("degrees of freedom: wrong", "0");
    for seed in seeds {
        let mut random = Random::new("redundancy", seed);
        let recipe = Recipe {
            n_points: 3 + random.below(3),
            n_frozen: random.below(3),
            n_placing: random.below(3),
            n_measuring: 3 + random.below(8),
            noise: 0.02,
            lengths: random.pick(&[0.3, 1.0]),
            limits: 0.0,
        };
        let scene = scene(&recipe, &mut random);
        let mut program = Program::after(&scene.script()).expect("the script has no mistake");
        if program.solve() != Verdict::Converged {
            continue;
        }
        let x = program.places(&scene.names());
        let check = program.check();
        let rows = scene.rows(&x, 0.0);
        let svd = rows.jacobian.svd();
        let [low, high] = UNCLEAR;
        if !svd.sigma.iter().all(|sigma| sigma.is_finite() && !(low..high).contains(sigma)) {
            continue;
        }
        let n_free = scene.n_columns() - svd.rank(CUT);
        freedoms.add(seed, check.degrees_of_freedom != n_free, 0.0);
        for (name, implied_by) in check.redundant {
            let Some(one) = place(&scene, &name) else { continue };
            let others: Vec<usize> =
                implied_by.iter().filter_map(|name| place(&scene, name)).collect();
            let left = left_over(&scene, &x, one, &others);
            lacking.add(seed, left > DEPENDENT, left);
        }
    }
    vec![lacking, freedoms]
}

/// How far some row of a constraint is at least from what the rows of others span, if those are
/// independent: the least singular value of all of them.
fn left_over(scene: &Scene, x: &[Place], one: usize, others: &[usize]) -> f64 {
    let rows = scene.rows(x, 0.0);
    let of = |which: &[usize]| -> Vec<Vec<f64>> {
        let all = rows.of.iter().zip(&rows.jacobian.rows);
        all.filter(|(c, _)| which.contains(c)).map(|(_, row)| row.clone()).collect()
    };
    // What the others span: orthonormal, so that their own angles do not count.
    let n = scene.n_columns();
    let svd = Matrix::of(n, of(others)).svd();
    let span = &svd.v[..svd.rank(1e-7)];
    let mut left = of(&[one]);
    for row in &mut left {
        for v in span {
            let k = crate::reference::dense::dot(v, row);
            crate::reference::dense::add_scaled(row, -k, v);
        }
    }
    // Of a constraint with several rows some combination has to be left with nothing.
    let n_rows = left.len();
    let sigma = Matrix::of(n, left).svd().sigma;
    if sigma.len() < n_rows { 0.0 } else { sigma.last().copied().unwrap_or(0.0) }
}
