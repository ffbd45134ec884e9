//! Solutions, best fits and nearest solutions of a scene, by dense matrices from many starts.

use super::dense::{add_scaled, norm, square};
use super::plane::Place;
use super::random::Random;
use super::scene::Scene;

/// Singular values below this count as 0 in steps: rows have length 1.
const CUT: f64 = 1e-10;
/// A pose this near to satisfaction, relative to the size, is a solution.
pub const SOLVED: f64 = 1e-10;

/// Shortest Gauss-Newton steps from a pose, as long as they arrive; none if they do not.
pub fn polished(scene: &Scene, x: &[Place], time: f64, n_steps: usize) -> Option<Vec<Place>> {
    let mut x = x.to_vec();
    let size = scene.size(&x);
    let mut best = scene.violation(&x, time);
    for _ in 0..n_steps {
        if best <= 1e-16 * size {
            break;
        }
        let rows = scene.rows(&x, time);
        let wanted: Vec<f64> = rows.f.iter().map(|f| -f).collect();
        let next = scene.moved(&x, &rows.jacobian.svd().solve(&wanted, CUT));
        let reached = scene.violation(&next, time);
        // At the limit of rounding nothing is gained any more.
        if reached >= best && best <= 1e-12 * size {
            break;
        }
        if !reached.is_finite() || norm(&scene.way(&x, &next)) > 10.0 * size {
            return None;
        }
        (x, best) = (next, reached);
    }
    (best <= SOLVED * size).then_some(x)
}

/// The pose that damped Gauss-Newton steps (Levenberg and Marquardt) lead to, as long as each gains
/// more than a part of the energy.
pub fn descended(
    scene: &Scene,
    x: &[Place],
    time: f64,
    n_steps: usize,
    least_gain: f64,
) -> Vec<Place> {
    let mut x = x.to_vec();
    let size = scene.size(&x);
    let mut damping = 1e-2;
    for _ in 0..n_steps {
        let rows = scene.rows(&x, time);
        let energy = 0.5 * square(&rows.f);
        if energy.sqrt() <= 1e-14 * size {
            break;
        }
        let measure = scene.measure(&x, time);
        let slope = rows.jacobian.transposed_times(&rows.f);
        let before = scene.energy(&x, time, &measure);
        let mut after = before;
        while damping < 1e8 {
            let mut matrix = rows.jacobian.gram();
            let mu = damping * (energy.sqrt() / size).min(1.0) + 1e-13;
            (0..slope.len()).for_each(|k| matrix.rows[k][k] += mu);
            let downhill: Vec<f64> = slope.iter().map(|g| -g).collect();
            if let Some(step) = matrix.solve_definite(&downhill)
                && norm(&step) < size
            {
                let next = scene.moved(&x, &step);
                let there = scene.energy(&next, time, &measure);
                if there < before {
                    (x, after) = (next, there);
                    damping = (damping * 0.2).max(1e-10);
                    break;
                }
            }
            damping *= 4.0;
        }
        // On the way to a solution a step gains much more.
        if before - after <= least_gain * before {
            break;
        }
    }
    x
}

/// A solution that is reached from one of many starts: the pose, poses nearby, poses anywhere.
pub fn solution(
    scene: &Scene,
    x: &[Place],
    time: f64,
    n_starts: usize,
    random: &mut Random,
) -> Option<Vec<Place>> {
    let size = scene.size(x);
    (0..n_starts).find_map(|k| {
        let push = [0.0, 1e-2, 1e-2, 0.3, 0.3, 1.0][k.min(5)] * size;
        let start = pushed(scene, x, push, random);
        let end = descended(scene, &start, time, 60, 1e-4);
        let is_near = scene.violation(&end, time) <= 1e-2 * size;
        is_near.then(|| polished(scene, &end, time, 30)).flatten()
    })
}

/// The pose with each free coordinate moved by up to this much.
pub fn pushed(scene: &Scene, x: &[Place], most: f64, random: &mut Random) -> Vec<Place> {
    let mut x = x.to_vec();
    for (place, _) in x.iter_mut().zip(&scene.is_frozen).filter(|(_, is_frozen)| !**is_frozen) {
        *place = place.map(|c| c + random.within(-most, most));
    }
    x
}

/// How far the nearest solution is, and where, as far as sequential quadratic programming from
/// the pose and from other starts finds it. The distance is in the metric of the weights; it is
/// never less than the true one by more than rounding.
pub fn nearest(
    scene: &Scene,
    from: &[Place],
    time: f64,
    starts: &[Vec<Place>],
) -> Option<(f64, Vec<Place>)> {
    let mut best: Option<(f64, Vec<Place>)> = None;
    for start in starts {
        let Some(x) = polished(scene, start, time, 60) else { continue };
        let x = slid(scene, from, x, time);
        let way = norm(&scene.way(from, &x));
        if best.as_ref().is_none_or(|(least, _)| way < *least) {
            best = Some((way, x));
        }
    }
    best
}

/// A solution moved along the solutions to where it is nearest to a pose.
fn slid(scene: &Scene, from: &[Place], mut x: Vec<Place>, time: f64) -> Vec<Place> {
    let mut share = 1.0;
    for _ in 0..60 {
        let rows = scene.rows(&x, time);
        let mut along = scene.way(&x, from);
        let svd = rows.jacobian.svd();
        for v in &svd.v[..svd.rank(1e-9)] {
            let k = super::dense::dot(v, &along);
            add_scaled(&mut along, -k, v);
        }
        let before = norm(&scene.way(from, &x));
        if norm(&along) <= 1e-9 * before.max(1e-12 * scene.size(from)) {
            break;
        }
        let step: Vec<f64> = along.iter().map(|a| a * share).collect();
        let next = polished(scene, &scene.moved(&x, &step), time, 20);
        match next.filter(|next| norm(&scene.way(from, next)) < before) {
            Some(next) => {
                x = next;
                share = (share * 1.5_f64).min(1.0);
            }
            None => share *= 0.4,
        }
        if share < 1e-4 {
            break;
        }
    }
    x
}

/// What is wrong with a pose that is called a best fit.
pub struct Fit {
    /// The length of the energy's slope over that of the equations' values.
    pub slope: f64,
    /// Whether some small move lowers the energy although the slope does not show it.
    pub is_saddle: bool,
    /// The least curvature of the energy.
    pub curvature: f64,
}

/// Curvatures above this are 0 for all that this reference can see.
const FLAT: f64 = -1e-6;

/// Judges a pose by slope and curvature; what curves down has to lead down.
pub fn fit(scene: &Scene, x: &[Place], time: f64) -> Fit {
    let rows = scene.rows(x, time);
    let slope = norm(&rows.jacobian.transposed_times(&rows.f)) / norm(&rows.f).max(1e-300);
    let mut ways = scene.hessian(x, time).eigen().into_iter();
    let Some((curvature, way)) = ways.next() else {
        return Fit { slope, is_saddle: false, curvature: 0.0 };
    };
    let measure = scene.measure(x, time);
    let here = scene.energy(x, time, &measure);
    let size = scene.size(x);
    let leads_down = |h: f64| {
        let step: Vec<f64> = way.iter().map(|w| w * h * size).collect();
        let there = scene.energy(&scene.moved(x, &step), time, &measure);
        here - there > 0.25 * curvature.abs() * (h * size) * (h * size)
            && here - there > 1e-12 * here
    };
    let lengths = [1e-2, 1e-3, 1e-4];
    let is_saddle = curvature < FLAT && lengths.iter().any(|&h| leads_down(h) || leads_down(-h));
    Fit { slope, is_saddle, curvature }
}
