//! The workloads as plain data: what each peer is given, and the script linkwork is given.

use std::f64::consts::{PI, SQRT_2};

/// A position or a difference of two.
pub type Place = [f64; 2];

/// What is to hold between points, given by their numbers.
#[derive(Debug, Clone, Copy)]
pub enum Relation {
    /// Two points are this far apart.
    Length(usize, usize, f64),
    /// The first two points are as far apart as the last two.
    Equal([usize; 4]),
    /// A point lies on the line through two others.
    OnLine(usize, [usize; 2]),
}

/// How a point follows from known ones, in closed form.
#[derive(Debug, Clone, Copy)]
pub enum Step {
    /// At these distances from two points, on the left of the way from one to the other (1) or
    /// on its right (-1).
    Dyad { p: usize, of: [usize; 2], lengths: [f64; 2], side: f64 },
    /// At a distance from a point, on a line through the origin, on its far side.
    Slider { p: usize, of: usize, length: f64, direction: Place },
    /// A parallelogram's corner; wrong is its mirror image in the line through the two.
    Corner { p: usize, of: [usize; 2], by: Place },
    /// Above a point by the distance of two others.
    Copy { p: usize, of: usize, as_far_as: [usize; 2] },
}

/// One workload.
#[derive(Debug, Clone)]
pub struct Work {
    pub name: String,
    /// The script, whose last statement is what runs.
    pub script: &'static str,
    /// Values of the script's parameters.
    pub set: Vec<(&'static str, f64)>,
    /// Where the points are at the start, in a solved pose where one is known.
    pub start: Vec<Place>,
    /// The names of the points in the script.
    pub names: Vec<String>,
    /// The points that stand still.
    pub ground: Vec<usize>,
    /// The points that are moved, and what they are moved about.
    pub driven: Vec<(usize, Place)>,
    /// Where in frame `k` all driven points are, against what they are moved about; then again
    /// from the beginning.
    pub offsets: Vec<Place>,
    pub relations: Vec<Relation>,
    /// The way to the pose in closed form, where there is one.
    pub plan: Vec<Step>,
    /// Frames of one round.
    pub block: usize,
    /// Degrees of the crank in a frame; none where a hand drags a point.
    pub degrees: Option<f64>,
}

impl Work {
    /// Where a driven point is in frame `k`.
    pub fn target(&self, about: Place, k: usize) -> Place {
        let offset = self.offsets[k % self.offsets.len()];
        [about[0] + offset[0], about[1] + offset[1]]
    }

    /// The largest side of the box around the start.
    pub fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let values = self.start.iter().map(|p| p[axis]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        };
        extent(0).max(extent(1))
    }

    /// Which points nothing but the constraints decides.
    pub fn free(&self) -> Vec<usize> {
        let is_held = |p: &usize| self.ground.contains(p) || self.driven.iter().any(|d| d.0 == *p);
        // Large scenes have few held points or a plan by name: keep this linear for them.
        let mut held = vec![false; self.start.len()];
        self.ground.iter().for_each(|&p| held[p] = true);
        self.driven.iter().for_each(|d| held[d.0] = true);
        debug_assert!((0..self.start.len().min(50)).all(|p| held[p] == is_held(&p)));
        (0..self.start.len()).filter(|&p| !held[p]).collect()
    }

    /// The same work with another step of the crank.
    pub fn at_degrees(&self, degrees: f64) -> Self {
        let step = degrees as usize;
        let n = self.offsets.len();
        Self {
            name: format!("{} at {degrees}°", self.name),
            offsets: (0..n).map(|k| self.offsets[k * step % n]).collect(),
            degrees: Some(degrees),
            ..self.clone()
        }
    }
}

/// A turn of a crank in 360 frames.
fn turn(radius: f64) -> Vec<Place> {
    (0..360)
        .map(|k| {
            let (s, c) = f64::from(k).to_radians().sin_cos();
            [radius * c, radius * s]
        })
        .collect()
}

/// There and back, a step a frame, `n` frames each way.
fn there_and_back(step: Place, n: usize) -> Vec<Place> {
    (0..2 * n)
        .map(|k| {
            let k = k.min(2 * n - k) as f64;
            [k * step[0], k * step[1]]
        })
        .collect()
}

fn names(names: &str) -> Vec<String> {
    names.split_whitespace().map(str::to_owned).collect()
}

/// W1: a four-bar.
pub fn four_bar() -> Work {
    Work { name: "W1".into(), set: vec![], ..four_bars(1) }.with_script(
        include_str!("../../../scripts/bench/w1-four-bar.link"),
        names("A D B C"),
        [0.0, -6.0],
    )
}

impl Work {
    fn with_script(mut self, script: &'static str, names: Vec<String>, by: Place) -> Self {
        self.script = script;
        self.names = names;
        self.driven.iter_mut().for_each(|(_, at)| *at = [at[0] + by[0], at[1] + by[1]]);
        self.start.iter_mut().for_each(|at| *at = [at[0] + by[0], at[1] + by[1]]);
        self
    }
}

/// W2: one leg of Theo Jansen's strandbeest.
pub fn jansen() -> Work {
    let [o, b, x, j, k, h, n, f] = [0, 1, 2, 3, 4, 5, 6, 7];
    let _ = o;
    let bars = [
        (x, j, 50.0),
        (b, j, 41.5),
        (x, k, 61.9),
        (b, k, 39.3),
        (j, h, 55.8),
        (b, h, 40.1),
        (h, n, 39.4),
        (k, n, 36.7),
        (n, f, 65.7),
        (k, f, 49.0),
    ];
    let dyad = |p, of, lengths, side| Step::Dyad { p, of, lengths, side };
    Work {
        name: "W2".into(),
        script: include_str!("../../../scripts/bench/w2-jansen.link"),
        set: vec![],
        start: vec![
            [0.0, 0.0],
            [-38.0, -7.8],
            [15.0, 0.0],
            [-19.0, 29.0],
            [-27.0, -45.5],
            [-74.0, 9.5],
            [-62.0, -28.0],
            [-43.0, -92.0],
        ],
        names: names("O B X J K H N F"),
        ground: vec![0, 1],
        driven: vec![(x, [0.0, 0.0])],
        offsets: turn(15.0),
        relations: bars.iter().map(|&(a, b, l)| Relation::Length(a, b, l)).collect(),
        plan: vec![
            dyad(j, [b, x], [41.5, 50.0], 1.0),
            dyad(k, [b, x], [39.3, 61.9], -1.0),
            dyad(h, [b, j], [40.1, 55.8], 1.0),
            dyad(n, [h, k], [39.4, 36.7], -1.0),
            dyad(f, [n, k], [65.7, 49.0], -1.0),
        ],
        block: 360,
        degrees: Some(1.0),
    }
    .from_plan()
}

/// W3: Peaucellier's inversor.
pub fn peaucellier() -> Work {
    let [o, p, q, u, v] = [0, 2, 3, 4, 5];
    let bars = [(o, u, 6.0), (o, v, 6.0), (u, p, 3.0), (p, v, 3.0), (v, q, 3.0), (q, u, 3.0)];
    let dyad = |p, of, lengths, side| Step::Dyad { p, of, lengths, side };
    Work {
        name: "W3".into(),
        script: include_str!("../../../scripts/bench/w3-peaucellier.link"),
        set: vec![],
        start: vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [4.0, 0.0],
            [6.75, 0.0],
            [5.375, 2.667],
            [5.375, -2.667],
        ],
        names: names("O C P Q U V"),
        ground: vec![0, 1],
        driven: vec![(p, [2.0, 0.0])],
        offsets: (0..360)
            .map(|k| {
                let (s, c) = (60f64.to_radians() * f64::from(k).to_radians().sin()).sin_cos();
                [2.0 * c, 2.0 * s]
            })
            .collect(),
        relations: bars.iter().map(|&(a, b, l)| Relation::Length(a, b, l)).collect(),
        plan: vec![
            dyad(u, [o, p], [6.0, 3.0], 1.0),
            dyad(v, [o, p], [6.0, 3.0], -1.0),
            dyad(q, [v, u], [3.0, 3.0], -1.0),
        ],
        block: 360,
        degrees: Some(1.0),
    }
    .from_plan()
}

/// W4: a crankshaft with four pistons and four indicator bars.
pub fn crankshaft() -> Work {
    let mut work = Work {
        name: "W4".into(),
        script: include_str!("../../../scripts/bench/w4-crankshaft.link"),
        set: vec![],
        start: vec![[0.0, 0.0], [1.0, 0.0]],
        names: names("O P"),
        ground: vec![0],
        driven: vec![(1, [0.0, 0.0])],
        offsets: turn(1.0),
        relations: vec![],
        plan: vec![],
        block: 360,
        degrees: Some(1.0),
    };
    for i in 0..4 {
        let (s, c) = (PI / 2.0 * f64::from(i)).sin_cos();
        let [g, h, q, a, b] = [0, 1, 2, 3, 4].map(|k| work.start.len() + k);
        let x = 6.0 + f64::from(i);
        work.start.extend([[1.5 * c, 1.5 * s], [4.5 * c, 4.5 * s], [3.0 * c, 3.0 * s]]);
        work.start.extend([[x, 0.0], [x, 1.5]]);
        work.names.extend(["g", "h", "q", "a", "b"].map(|name| format!("{name}[{i}]")));
        work.ground.extend([g, h, a]);
        work.relations.extend([
            Relation::Length(1, q, 3.0),
            Relation::OnLine(q, [g, h]),
            Relation::Equal([a, b, g, q]),
        ]);
        work.plan.extend([
            Step::Slider { p: q, of: 1, length: 3.0, direction: [c, s] },
            Step::Copy { p: b, of: a, as_far_as: [g, q] },
        ]);
    }
    work.from_plan()
}

/// W5a: a chain of `n` bars along a half circle, one end dragged.
pub fn chain(n: usize) -> Work {
    let r = 1.0 / (2.0 * (PI / (2.0 * n as f64)).sin());
    let start: Vec<Place> = (0..=n)
        .map(|i| {
            let (s, c) = (PI - PI * i as f64 / n as f64).sin_cos();
            [r * c, r * s]
        })
        .collect();
    let end = start[n];
    Work {
        name: format!("W5a {n}"),
        script: include_str!("../../../scripts/bench/w5a-chain.link"),
        set: vec![("n", n as f64)],
        names: (0..=n).map(|i| format!("p[{i}]")).collect(),
        ground: vec![0],
        driven: vec![(n, end)],
        offsets: there_and_back([0.1, 0.05], 20),
        relations: (1..=n).map(|i| Relation::Length(i - 1, i, 1.0)).collect(),
        plan: vec![],
        block: 20,
        degrees: None,
        start,
    }
}

/// W5b: `n` by `n` squares with both diagonals, one corner dragged.
pub fn truss(n: usize) -> Work {
    let at = |i: usize, j: usize| i * (n + 1) + j;
    let mut relations = Vec::new();
    for i in 0..=n {
        for j in 1..=n {
            relations.push(Relation::Length(at(i, j - 1), at(i, j), 1.0));
            relations.push(Relation::Length(at(j - 1, i), at(j, i), 1.0));
        }
    }
    for i in 1..=n {
        for j in 1..=n {
            relations.push(Relation::Length(at(i - 1, j - 1), at(i, j), SQRT_2));
            relations.push(Relation::Length(at(i - 1, j), at(i, j - 1), SQRT_2));
        }
    }
    let places = || (0..=n).flat_map(move |i| (0..=n).map(move |j| (i, j)));
    Work {
        name: format!("W5b {n}"),
        script: include_str!("../../../scripts/bench/w5b-truss.link"),
        set: vec![("n", n as f64)],
        start: places().map(|(i, j)| [i as f64, j as f64]).collect(),
        names: places().map(|(i, j)| format!("p[{i}][{j}]")).collect(),
        ground: vec![],
        driven: vec![(0, [0.0, 0.0])],
        offsets: there_and_back([0.01, 0.005], 20),
        relations,
        plan: vec![],
        block: 20,
        degrees: None,
    }
}

/// W5c: `n` four-bars that have nothing to do with each other.
pub fn four_bars(n: usize) -> Work {
    let mut work = Work {
        name: format!("W5c {n}"),
        script: include_str!("../../../scripts/bench/w5c-four-bars.link"),
        set: vec![("n", n as f64)],
        start: vec![],
        names: vec![],
        ground: vec![],
        driven: vec![],
        offsets: turn(1.0),
        relations: vec![],
        plan: vec![],
        block: 360,
        degrees: Some(1.0),
    };
    for i in 1..=n {
        let [a, d, b, c] = [0, 1, 2, 3].map(|k| work.start.len() + k);
        let y = 6.0 * i as f64;
        work.start.extend([[0.0, y], [4.0, y], [1.0, y], [3.0, y + 2.9]]);
        work.names.extend(["A", "D", "B", "C"].map(|name| format!("{name}[{i}]")));
        work.ground.extend([a, d]);
        work.driven.push((b, [0.0, y]));
        work.relations.extend([Relation::Length(b, c, 3.5), Relation::Length(c, d, 3.0)]);
        work.plan.push(Step::Dyad { p: c, of: [b, d], lengths: [3.5, 3.0], side: 1.0 });
    }
    work.from_plan()
}

/// W7: a parallelogram through both its change points.
pub fn parallelogram() -> Work {
    Work {
        name: "W7".into(),
        script: include_str!("../../../scripts/bench/w7-parallelogram.link"),
        set: vec![],
        start: vec![[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [6.0, 0.0]],
        names: names("A D B C"),
        ground: vec![0, 1],
        driven: vec![(2, [0.0, 0.0])],
        offsets: turn(2.0),
        relations: vec![Relation::Length(2, 3, 4.0), Relation::Length(3, 1, 2.0)],
        plan: vec![Step::Corner { p: 3, of: [2, 1], by: [4.0, 0.0] }],
        block: 360,
        degrees: Some(1.0),
    }
}

/// W8: three parallel cranks and one bar more than the count allows.
pub fn three_cranks() -> Work {
    let [a1, a2, a3, b1, b2, b3] = [0, 1, 2, 3, 4, 5];
    let _ = a1;
    let d = 5f64.sqrt();
    Work {
        name: "W8".into(),
        script: include_str!("../../../scripts/bench/w8-three-cranks.link"),
        set: vec![],
        start: vec![[0.0, 0.0], [4.0, 0.0], [2.0, 1.0], [1.0, 0.0], [5.0, 0.0], [3.0, 1.0]],
        names: names("A1 A2 A3 B1 B2 B3"),
        ground: vec![0, 1, 2],
        driven: vec![(b1, [0.0, 0.0])],
        offsets: turn(1.0),
        relations: vec![
            Relation::Length(a2, b2, 1.0),
            Relation::Length(a3, b3, 1.0),
            Relation::Length(b1, b2, 4.0),
            Relation::Length(b2, b3, d),
            Relation::Length(b3, b1, d),
        ],
        plan: vec![
            Step::Corner { p: b2, of: [b1, a2], by: [4.0, 0.0] },
            Step::Corner { p: b3, of: [b1, a3], by: [2.0, 1.0] },
        ],
        block: 360,
        degrees: Some(1.0),
    }
}
