//! Freedoms, redundancy, conflicts and poses of mechanisms whose answers are known.

use linkwork::constraint::{
    Bounds, Coincidence, Constraint, ConstraintKind, Glider, Length, Motor, Orientation, Period,
    Point,
};
use linkwork::mobility::{
    Analysis, ConstraintSystem, Directions, PoseClass, analyse, conflict_with, freedom, motion_of,
};

const TOLERANCE: f64 = 1e-9;

/// Points and constraints, built by hand.
#[derive(Default, Clone)]
struct Model {
    constraints: Vec<Constraint>,
    x: Vec<Point>,
    w: Vec<f64>,
}

impl Model {
    fn point(&mut self, x: f64, y: f64) -> u32 {
        self.x.push(Point::new(x, y));
        self.w.push(1.0);
        self.x.len() as u32 - 1
    }

    fn ground(&mut self, x: f64, y: f64) -> u32 {
        let p = self.point(x, y);
        self.w[p as usize] = 0.0;
        p
    }

    /// A bar as long as it is drawn.
    fn bar(&mut self, a: u32, b: u32) -> usize {
        self.bar_of(a, b, self.x[a as usize].distance(self.x[b as usize]))
    }

    fn bar_of(&mut self, a: u32, b: u32, length: f64) -> usize {
        self.push(Length { points: [a, b], bounds: Bounds::exactly(length) })
    }

    fn push(&mut self, constraint: impl Into<Constraint>) -> usize {
        self.constraints.push(constraint.into());
        self.constraints.len() - 1
    }

    /// `n` x `n` squares of side 1 with both diagonals; gives the corner at the origin.
    fn net(&mut self, n: u32) -> u32 {
        let first = self.x.len() as u32;
        let at = |i: u32, j: u32| first + i * (n + 1) + j;
        for i in 0..=n {
            for j in 0..=n {
                self.point(f64::from(j), f64::from(i));
            }
        }
        for i in 0..=n {
            for j in 0..=n {
                if j < n {
                    self.bar(at(i, j), at(i, j + 1));
                }
                if i < n {
                    self.bar(at(i, j), at(i + 1, j));
                }
                if i < n && j < n {
                    self.bar(at(i, j), at(i + 1, j + 1));
                    self.bar(at(i, j + 1), at(i + 1, j));
                }
            }
        }
        first
    }

    /// A linkage of ground, crank, coupler and rocker with the given joints.
    fn four_bar(joints: [[f64; 2]; 4]) -> Self {
        let mut model = Self::default();
        let [a, b, c, d] = joints;
        let (a, d) = (model.ground(a[0], a[1]), model.ground(d[0], d[1]));
        let (b, c) = (model.point(b[0], b[1]), model.point(c[0], c[1]));
        for (p, q) in [(a, b), (b, c), (c, d)] {
            model.bar(p, q);
        }
        model
    }

    fn with<R>(&self, then: impl FnOnce(&ConstraintSystem) -> R) -> R {
        let constraints: Vec<_> = self.constraints.iter().collect();
        then(&ConstraintSystem { constraints: &constraints, x: &self.x, w: &self.w })
    }

    fn analyse(&self) -> Analysis {
        self.with(|scene| analyse(scene, TOLERANCE))
    }

    /// Moves the points towards the best fit by the paper's relaxation.
    fn fit(&mut self, n_iterations: usize) {
        for _ in 0..n_iterations {
            let mut moved = self.x.clone();
            for c in &self.constraints {
                c.correct(&self.x, &self.w, &mut |p, d| moved[p as usize] += d * 0.4);
            }
            self.x = moved;
        }
    }
}

/// The counts and the pose are these.
fn check(
    model: &Model,
    degrees_of_freedom: usize,
    n_redundant: usize,
    pose: PoseClass,
) -> Analysis {
    let found = model.analyse();
    let counts = (found.degrees_of_freedom, found.n_redundant, found.pose);
    assert_eq!(counts, (degrees_of_freedom, n_redundant, pose), "{:?}", found.singular_values);
    assert_eq!((found.conflicts.len(), found.unsatisfiable.len()), (0, 0));
    found
}

#[test]
fn a_four_bar_has_one_freedom() {
    let found = check(
        &Model::four_bar([[0.0, 0.0], [0.6, 0.8], [3.0, 2.5], [4.0, 0.0]]),
        1,
        0,
        PoseClass::Regular,
    );
    let (least, most) = found.singular_values.unwrap();
    assert!(least > 0.3 && most < 1.6, "{least} {most}");
    assert!(!found.is_nearly_singular());
}

#[test]
fn singular_values_are_those_of_dense_algebra() {
    let mut model = Model::default();
    model.net(3);
    let found = model.analyse();
    let mut jacobian = nalgebra::DMatrix::zeros(model.constraints.len(), 2 * model.x.len());
    for (row_idx, c) in model.constraints.iter().enumerate() {
        c.jacobian(&model.x, &mut |row| {
            for (p, g) in row.terms() {
                jacobian[(row_idx, 2 * p as usize)] = g.x / 2f64.sqrt();
                jacobian[(row_idx, 2 * p as usize + 1)] = g.y / 2f64.sqrt();
            }
        });
    }
    let mut values = jacobian.singular_values().as_slice().to_vec();
    values.retain(|&v| v > 1e-9);
    values.sort_by(f64::total_cmp);
    let (least, most) = found.singular_values.unwrap();
    assert!((least / values[0] - 1.0).abs() < 2e-3, "{least} {}", values[0]);
    assert!((most / values[values.len() - 1] - 1.0).abs() < 2e-3);
    assert_eq!(found.degrees_of_freedom, 2 * model.x.len() - values.len());
}

#[test]
fn an_overbraced_net_names_a_diagonal_for_each_square_and_more() {
    let mut model = Model::default();
    let first = model.net(4) as usize;
    check(&model, 3, 25, PoseClass::Regular);
    model.w[first] = 0.0;
    model.w[first + 1] = 0.0;
    // The bar between the two pinned corners holds nothing that moves and is left out; two
    // pins instead of the three freedoms of the whole leave one more bar too many.
    let found = check(&model, 0, 25, PoseClass::Regular);
    assert_eq!(found.redundant.len(), 25);
    model.w[first + 1] = 1.0;
    model.w[first + 4] = 0.0;
    check(&model, 0, 26, PoseClass::Regular);
}

#[test]
fn the_later_of_two_equal_bars_is_redundant() {
    let mut model = Model::four_bar([[0.0, 0.0], [0.6, 0.8], [3.0, 2.5], [4.0, 0.0]]);
    for _ in 0..9 {
        for k in 0..3 {
            model.push(model.constraints[k].clone());
        }
    }
    let found = check(&model, 1, 27, PoseClass::Regular);
    for (k, redundant) in found.redundant.iter().enumerate() {
        assert_eq!((redundant.constraint, &*redundant.depends_on), (k + 3, &[k % 3][..]));
    }
}

#[test]
fn a_vector_constraint_is_named_once() {
    let mut model = Model::default();
    let (a, b) = (model.point(1.0, 2.0), model.point(1.0, 2.0));
    let first = model.push(Coincidence { points: [a, b] });
    let second = model.push(Coincidence { points: [b, a] });
    let found = check(&model, 2, 2, PoseClass::Regular);
    assert_eq!(found.redundant.len(), 1);
    assert_eq!(found.redundant[0].constraint, second);
    assert_eq!(found.redundant[0].depends_on, [first]);
}

#[test]
fn bars_with_ends_of_their_own_are_braced_as_any_others() {
    // A square with both diagonals, each bar with two points of its own, joined at corners.
    let mut model = Model::default();
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let mut ends = vec![Vec::new(); 4];
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
        let p = model.point(corners[a].0, corners[a].1);
        let q = model.point(corners[b].0, corners[b].1);
        model.bar(p, q);
        ends[a].push(p);
        ends[b].push(q);
    }
    for joint in ends {
        for &p in &joint[1..] {
            model.push(Coincidence { points: [joint[0], p] });
        }
    }
    check(&model, 3, 1, PoseClass::Regular);
}

#[test]
fn a_slack_rope_asks_for_nothing() {
    let mut model = Model::default();
    let (a, b) = (model.ground(0.0, 0.0), model.point(1.0, 0.0));
    let rope = model.push(Length { points: [a, b], bounds: Bounds { lo: 0.0, hi: 2.0 } });
    check(&model, 2, 0, PoseClass::Regular);
    model.x[b as usize] = Point::new(2.5, 0.0);
    let found = model.analyse();
    assert_eq!(found.degrees_of_freedom, 1);
    assert_eq!(model.with(|scene| freedom(scene, b)).held_by, [rope]);
}

#[test]
fn a_straight_toggle_is_locked() {
    let mut model = Model::default();
    let (a, b, c) = (model.ground(0.0, 0.0), model.point(1.0, 0.0), model.ground(3.0, 0.0));
    model.bar(a, b);
    model.bar(b, c);
    check(&model, 1, 1, PoseClass::Locked);
}

#[test]
fn a_taut_chain_is_locked_however_long() {
    let mut model = Model::default();
    let mut last = model.ground(0.0, 0.0);
    for k in 1..=60 {
        let next = if k == 60 { model.ground(60.0, 0.0) } else { model.point(f64::from(k), 0.0) };
        model.bar(last, next);
        last = next;
    }
    check(&model, 59, 1, PoseClass::Locked);
}

#[test]
fn a_flat_parallelogram_may_go_two_ways() {
    check(
        &Model::four_bar([[0.0, 0.0], [1.0, 0.0], [5.0, 0.0], [4.0, 0.0]]),
        2,
        1,
        PoseClass::ChangePoint,
    );
    check(
        &Model::four_bar([[0.0, 0.0], [0.6, 0.8], [4.6, 0.8], [4.0, 0.0]]),
        1,
        0,
        PoseClass::Regular,
    );
}

#[test]
fn a_slider_crank_is_locked_at_its_dead_points_only_if_the_slider_drives() {
    let mut model = Model::default();
    let (pivot, pin) = (model.ground(0.0, 0.0), model.point(1.0, 0.0));
    let slider = model.point(3.5, 0.0);
    let rail = [model.ground(2.0, 0.0), model.ground(3.0, 0.0)];
    model.bar(pivot, pin);
    model.bar(pin, slider);
    model.push(Glider { points: [rail[0], slider, rail[1]], bounded: false });
    check(&model, 1, 0, PoseClass::Regular);
    let mut driven = model.clone();
    driven.push(Motor::new([pivot, pin], 1.0, 0.0, 1.0));
    // The motor holds the pin at its radius, as the crank does.
    let found = check(&driven, 0, 1, PoseClass::Regular);
    assert_eq!((found.redundant[0].constraint, &*found.redundant[0].depends_on), (3, &[0][..]));
    model.w[slider as usize] = 0.0;
    check(&model, 1, 1, PoseClass::Locked);
}

#[test]
fn the_third_of_three_parallels_is_implied() {
    let mut model = Model::default();
    let mut segment = |y: f64| [model.point(0.0, y), model.point(2.0, y + 1.0)];
    let [a, b, c] = [segment(0.0), segment(2.0), segment(5.0)];
    for [p, q] in [[a, b], [b, c], [a, c]] {
        model.push(Orientation {
            points: [p[0], p[1], q[0], q[1]],
            bounds: Bounds::exactly(0.0),
            period: Period::Half,
            side: 0.0,
        });
    }
    let found = check(&model, 10, 1, PoseClass::Regular);
    assert_eq!((found.redundant[0].constraint, &*found.redundant[0].depends_on), (2, &[0, 1][..]));
}

#[test]
fn weights_change_no_count() {
    for k in 0..4 {
        let mut model = Model::default();
        model.net(3);
        for (p, w) in model.w.iter_mut().enumerate() {
            *w = [0.01, 0.1, 1.0, 10.0, 100.0][p * (k + 1) % 5];
        }
        check(&model, 3, 13, PoseClass::Regular);
    }
}

#[test]
fn coupled_wheels_run_though_the_count_says_they_stick() {
    // Three cranks on one line, coupled by bars 1-2, 2-3 and, redundant, 1-3.
    for phi in [0.3, 1.0, 2.0] {
        let mut model = Model::default();
        let (s, c) = f64::sin_cos(phi);
        let pins = [0.0, 2.0, 5.0].map(|x| (model.ground(x, 0.0), model.point(x + c, s)));
        for (pivot, pin) in pins {
            model.bar(pivot, pin);
        }
        model.bar(pins[0].1, pins[1].1);
        model.bar(pins[1].1, pins[2].1);
        let last = model.bar(pins[0].1, pins[2].1);
        let found = check(&model, 1, 1, PoseClass::MobileSingular);
        assert_eq!(found.redundant[0].constraint, last);
        assert_eq!(found.redundant[0].depends_on, [3, 4]);
    }
}

#[test]
fn a_double_parallelogram_on_a_plate_runs() {
    // A plate on three equal parallel cranks whose pins are not on one line: the third crank
    // is redundant by its proportions only.
    let mut model = Model::default();
    let (s, c) = f64::sin_cos(0.7);
    let pins = [(0.0, 0.0), (3.0, 0.0), (1.0, 2.0)]
        .map(|(x, y)| (model.ground(x, y), model.point(x + 1.5 * c, y + 1.5 * s)));
    for k in 0..3 {
        model.bar(pins[k].1, pins[(k + 1) % 3].1);
    }
    for (pivot, pin) in pins {
        model.bar(pivot, pin);
    }
    check(&model, 1, 1, PoseClass::MobileSingular);
}

#[test]
fn a_shaky_prism_is_locked() {
    // Two triangles joined by three bars whose lines meet in one point.
    let mut model = Model::default();
    let mut triangles = [[0; 3]; 2];
    for (k, (phi, r)) in [(0.2, 1.0), (2.1, 1.4), (4.4, 0.8)].into_iter().enumerate() {
        let (s, c) = f64::sin_cos(phi);
        triangles[0][k] = model.point(3.0 * c, 3.0 * s);
        triangles[1][k] = model.point(r * c, r * s);
        model.bar(triangles[0][k], triangles[1][k]);
    }
    for triangle in triangles {
        for k in 0..3 {
            model.bar(triangle[k], triangle[(k + 1) % 3]);
        }
    }
    // Three freedoms of the whole, which go on, and one that does not.
    check(&model, 4, 1, PoseClass::Locked);
    for p in triangles[0] {
        model.w[p as usize] = 0.0;
    }
    model.constraints.drain(3..6);
    check(&model, 1, 1, PoseClass::Locked);
}

#[test]
fn dixons_linkage_of_nine_bars_runs() {
    // Three points on each of two perpendicular lines, each joined with the other three.
    let mut model = Model::default();
    let on_x = [1.0, 2.5, -1.7].map(|x| model.point(x, 0.0));
    let on_y = [1.3, -2.0, 3.1].map(|y| model.point(0.0, y));
    for a in on_x {
        for b in on_y {
            model.bar(a, b);
        }
    }
    check(&model, 4, 1, PoseClass::MobileSingular);
    // Somewhere else the same nine bars are rigid.
    model.x[0] = Point::new(1.0, 0.4);
    model.constraints.clear();
    for a in on_x {
        for b in on_y {
            model.bar(a, b);
        }
    }
    check(&model, 3, 0, PoseClass::Regular);
}

#[test]
fn an_impossible_triangle_is_named_alone_in_a_large_sound_scene() {
    let mut model = Model::default();
    let corner = model.net(12);
    let n_sound = model.constraints.len();
    // At the best fit of lengths 1, 1 and 3 all are off by 1/3.
    let p = model.point(-4.0 / 3.0, 0.0);
    let q = model.point(-8.0 / 3.0, 0.0);
    let bars =
        [model.bar_of(corner, p, 1.0), model.bar_of(p, q, 1.0), model.bar_of(corner, q, 3.0)];
    let found = model.analyse();
    assert_eq!(found.conflicts.len(), 1);
    assert_eq!(found.conflicts[0].constraints, bars);
    assert!((found.conflicts[0].residual - 1.0 / 18f64.sqrt()).abs() < 1e-12);
    let changes: Vec<_> = found.conflicts[0].repairs.iter().map(|r| r.change).collect();
    for (change, expected) in changes.iter().zip([1.0, 1.0, -1.0]) {
        assert!((change - expected).abs() < 1e-9, "{changes:?}");
    }
    assert!(found.redundant.iter().all(|r| r.constraint < n_sound));

    for bar in bars {
        let conflict = model.with(|scene| conflict_with(scene, bar, TOLERANCE)).unwrap();
        assert_eq!(conflict.constraints, bars);
    }
    assert_eq!(model.with(|scene| conflict_with(scene, 5, TOLERANCE)), None);
}

#[test]
fn two_impossible_triangles_are_two_conflicts() {
    let mut model = Model::default();
    let corner = model.net(2);
    let mut bars = Vec::new();
    for (x, y) in [(-1.0, 0.0), (0.0, -0.01)] {
        let p = model.point(x * 4.0 / 3.0, y * 4.0 / 3.0);
        let q = model.point(x * 8.0 / 3.0, y * 8.0 / 3.0);
        let k = f64::hypot(x, y);
        bars.push(vec![
            model.bar_of(corner, p, k),
            model.bar_of(p, q, k),
            model.bar_of(corner, q, 3.0 * k),
        ]);
    }
    let found = model.analyse();
    let named: Vec<_> = found.conflicts.into_iter().map(|c| c.constraints).collect();
    assert_eq!(named, bars);
}

#[test]
fn a_bar_too_long_in_a_braced_net_conflicts_with_its_square() {
    let mut model = Model::default();
    model.net(3);
    // The first diagonal.
    let bad = 2;
    let Constraint::Length(bar) = &mut model.constraints[bad] else { unreachable!() };
    bar.bounds = Bounds::exactly(1.1 * 2f64.sqrt());
    model.fit(3000);
    let found = model.analyse();
    assert_eq!(found.conflicts.len(), 1);
    let conflict = &found.conflicts[0];
    assert_eq!(conflict.constraints.len(), 6);
    let repair = conflict.repairs.iter().find(|r| r.constraint == bad).unwrap();
    assert!((repair.change + 0.1 * 2f64.sqrt()).abs() < 0.01, "{repair:?}");
    let other = conflict.constraints[4];
    let about_it = model.with(|scene| conflict_with(scene, other, TOLERANCE)).unwrap();
    assert!(about_it.constraints.contains(&other) && about_it.constraints.contains(&bad));
}

#[test]
fn a_conflict_is_found_at_a_fit_that_is_not_quite_the_best() {
    let mut model = Model::default();
    let corner = model.net(6);
    let p = model.point(-1.3, 1e-3);
    let q = model.point(-2.7, -1e-3);
    let bars =
        [model.bar_of(corner, p, 1.0), model.bar_of(p, q, 1.0), model.bar_of(corner, q, 3.0)];
    let mut n_found = 0;
    for n_iterations in [0, 10, 30, 100, 300, 1000, 3000] {
        model.fit(n_iterations);
        let found = model.analyse();
        let named: Vec<_> = found.conflicts.into_iter().map(|c| c.constraints).collect();
        assert!(named.is_empty() || named == [bars], "{named:?}");
        n_found += named.len();
    }
    assert!(n_found >= 2, "found {n_found} times of 7");
}

#[test]
fn frozen_points_that_contradict_a_bar_make_it_unsatisfiable() {
    let mut model = Model::default();
    let (a, b) = (model.ground(0.0, 0.0), model.ground(1.0, 0.0));
    let good = model.bar(a, b);
    let bad = model.bar_of(a, b, 2.0);
    let found = model.analyse();
    assert_eq!(found.unsatisfiable, [bad]);
    assert_ne!(good, bad);
    assert_eq!((found.degrees_of_freedom, found.n_redundant), (0, 0));
}

#[test]
fn a_point_knows_where_it_can_go() {
    let model = Model::four_bar([[0.0, 0.0], [0.6, 0.8], [3.0, 2.5], [4.0, 0.0]]);
    let of = |p| model.with(|scene| freedom(scene, p));
    assert_eq!(of(0).directions, Directions::None);
    let crank = of(2);
    let Directions::Along(v) = crank.directions else { panic!("{crank:?}") };
    assert!((v.x * 0.6 + v.y * 0.8).abs() < 1e-6);
    // Pushed along the crank it is held by the crank alone.
    assert_eq!(crank.held_by, [0]);

    let mut model = Model::default();
    let a = model.point(0.0, 0.0);
    assert_eq!(model.with(|scene| freedom(scene, a)).directions, Directions::All);
    let (p, q) = (model.ground(-1.0, 0.0), model.ground(0.0, -1.0));
    let (x, y) = (model.bar(p, a), model.bar(q, a));
    let held = model.with(|scene| freedom(scene, a));
    assert_eq!(held.directions, Directions::None);
    assert_eq!(held.held_by, [x, y]);
}

#[test]
fn the_one_free_motion_keeps_all_bars() {
    let model = Model::four_bar([[0.0, 0.0], [0.6, 0.8], [3.0, 2.5], [4.0, 0.0]]);
    let motion = model.with(|scene| motion_of(scene, 2)).unwrap();
    let length: f64 = motion.iter().map(|v| v.norm_squared()).sum();
    assert!((length - 1.0).abs() < 1e-12);
    for c in &model.constraints {
        c.jacobian(&model.x, &mut |row| {
            let rate: f64 = row.terms().map(|(p, g)| g.dot(motion[p as usize])).sum();
            assert!(rate.abs() < 1e-12, "{rate:e}");
        });
    }
    assert_eq!(model.with(|scene| motion_of(scene, 0)), None);
}

#[test]
fn position_errors_are_estimated_where_nothing_is_free() {
    let mut model = Model::default();
    let (a, b) = (model.ground(0.0, 0.0), model.ground(2.0, 0.0));
    // Two bars that meet at a small angle.
    let p = model.point(1.0, 0.0005);
    model.bar(a, p);
    model.bar(b, p);
    let found = model.analyse();
    assert!(found.is_nearly_singular());
    let error = found.position_error(1e-6).unwrap();
    assert!((error / 1.414e-3 - 1.0).abs() < 0.02, "{error}");
}

#[test]
fn a_bar_with_a_small_part_in_a_dependence_is_named() {
    // Of three bars that hold P the third lies `off` the first: it is cos(off) times the first
    // and sin(off) times the second.
    for (off, expected) in [(9e-6_f64, &[0, 1][..]), (1e-7, &[0, 1]), (0.0, &[0])] {
        let mut model = Model::default();
        let a = model.ground(-1.0, 0.0);
        let b = model.ground(0.0, -1.0);
        let c = model.ground(-2.0 * off.cos(), -2.0 * off.sin());
        let p = model.point(0.0, 0.0);
        let bars = [(a, 1.0), (b, 1.0), (c, 2.0)].map(|(q, length)| model.bar_of(q, p, length));
        let found = model.analyse();
        assert_eq!(found.redundant.len(), 1, "{off}");
        assert_eq!(found.redundant[0].constraint, bars[2], "{off}");
        assert_eq!(found.redundant[0].depends_on, expected, "{off}");
    }
}

/// Bars in a row along a line between two frozen points, all off by the same: a pose from which
/// no first-order step leads.
fn in_a_row(lengths: &[f64], span: f64) -> Model {
    let mut model = Model::default();
    let off = (span - lengths.iter().sum::<f64>()) / lengths.len() as f64;
    let mut at = 0.0;
    let mut last = model.ground(0.0, 0.0);
    for (k, length) in lengths.iter().enumerate() {
        at += length + off;
        let is_end = k + 1 == lengths.len();
        let next = if is_end { model.ground(span, 0.0) } else { model.point(at, 0.0) };
        model.bar_of(last, next, *length);
        last = next;
    }
    model
}

#[test]
fn bars_in_a_row_conflict_only_if_no_polygon_has_these_sides() {
    let mut state = 1_u32;
    let mut random = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let mut n_false = 0;
    for round in 0..200 {
        let lengths: Vec<f64> = (0..2 + round % 4).map(|_| 1.0 + 3.0 * random()).collect();
        let sum: f64 = lengths.iter().sum();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let span = sum * (0.4 + 0.9 * random());
        let (most, rest) = (longest.max(span), sum + span - longest.max(span));
        if (most / rest - 1.0).abs() < 1e-3 {
            continue;
        }
        let conflicts = in_a_row(&lengths, span).analyse().conflicts;
        if most < rest {
            n_false += conflicts.len();
        } else if span > sum {
            let all: Vec<usize> = (0..lengths.len()).collect();
            assert_eq!(conflicts.len(), 1, "{lengths:?} {span}");
            assert_eq!(conflicts[0].constraints, all, "{lengths:?} {span}");
        }
    }
    assert_eq!(n_false, 0);
}
