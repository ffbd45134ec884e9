//! What the linear algebra of an island costs: `cargo bench --bench linear`.
#![allow(clippy::disallowed_methods)]

use linkwork::linalg::{NormalMatrix, Storage};
use std::f64::consts::FRAC_1_SQRT_2;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Bars between places, each a row of length 1.
struct Scene {
    name: String,
    n_points: usize,
    bars: Vec<[u32; 2]>,
    values: Vec<[f64; 4]>,
}

impl Scene {
    fn new(name: String, places: &[[f64; 2]], bars: Vec<[u32; 2]>) -> Self {
        let values = bars
            .iter()
            .map(|&[a, b]| {
                let [a, b] = [places[a as usize], places[b as usize]];
                let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
                let l = dx.hypot(dy) / FRAC_1_SQRT_2;
                [-dx / l, -dy / l, dx / l, dy / l]
            })
            .collect();
        Self { name, n_points: places.len(), bars, values }
    }

    /// Bars of length 1 along half a circle.
    fn chain(n: usize) -> Self {
        let places: Vec<_> = (0..=n)
            .map(|k| {
                let (s, c) = (std::f64::consts::PI * k as f64 / n as f64).sin_cos();
                [c * n as f64, s * n as f64]
            })
            .collect();
        let bars = (0..n as u32).map(|k| [k, k + 1]).collect();
        Self::new(format!("chain {n}"), &places, bars)
    }

    /// Squares with both diagonals, somewhat deformed.
    fn net(n: usize) -> Self {
        let side = n + 1;
        let mut places = Vec::new();
        let mut bars = Vec::new();
        for i in 0..side {
            for j in 0..side {
                let at = (i * side + j) as u32;
                let (x, y) = (j as f64, i as f64);
                places.push([x + 0.1 * (y * 1.3).sin(), y + 0.1 * (x * 1.7).sin()]);
                let (right, up) = (at + 1, at + side as u32);
                if j < n {
                    bars.push([at, right]);
                }
                if i < n {
                    bars.push([at, up]);
                }
                if i < n && j < n {
                    bars.push([at, up + 1]);
                    bars.push([right, up]);
                }
            }
        }
        Self::new(format!("net {n}"), &places, bars)
    }

    fn normal_matrix(&self, storage: Storage) -> NormalMatrix {
        let bars = self.bars.iter().map(<[u32; 2]>::as_slice);
        NormalMatrix::with_storage(storage, self.n_points, bars)
    }

    fn assemble(&self, normal: &mut NormalMatrix) {
        normal.clear();
        for (row_idx, values) in self.values.iter().enumerate() {
            normal.add_row(row_idx, values);
        }
    }
}

/// The median time of one call, in microseconds.
fn median(mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    let once = start.elapsed().max(Duration::from_nanos(20));
    let n_calls = (Duration::from_micros(500).as_nanos() / once.as_nanos()).max(1) as u32;
    let mut times: Vec<_> = (0..41)
        .map(|_| {
            let start = Instant::now();
            for _ in 0..n_calls {
                work();
            }
            start.elapsed().as_secs_f64() * 1e6 / f64::from(n_calls)
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    let scenes = [1, 4, 8, 16, 100, 1000, 10000]
        .map(Scene::chain)
        .into_iter()
        .chain([2, 4, 8, 16, 24, 32, 48, 64, 96].map(Scene::net));
    println!(
        "{:<12} {:>8} {:>10} {:>9} {:>10} {:>10} {:>10} {:>10}  microseconds",
        "scene", "unknowns", "storage", "L", "analyse", "assemble", "factor", "solve"
    );
    for scene in scenes {
        for storage in [Storage::Sparse, Storage::Supernodal] {
            let mut normal = scene.normal_matrix(storage);
            let mut rhs: Vec<f64> = (0..2 * scene.n_points).map(|k| (k as f64).sin()).collect();
            let analyse = median(|| drop(black_box(scene.normal_matrix(storage))));
            let assemble = median(|| scene.assemble(&mut normal));
            let factor = median(|| {
                black_box(normal.factor(1e-6));
            });
            let solve = median(|| normal.solve(black_box(&mut rhs)));
            println!(
                "{:<12} {:>8} {:>10} {:>9} {analyse:>10.2} {assemble:>10.3} {factor:>10.3} {solve:>10.3}",
                scene.name,
                2 * scene.n_points,
                format!("{storage:?}"),
                normal.n_stored(),
            );
        }
    }
}
