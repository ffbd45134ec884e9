//! The reference itself is right: its formulas, their derivatives, its matrices and its solvers.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, SQRT_2};

use crate::reference::constraint::{Kind, Range, WORDS};
use crate::reference::dense::{Factors, Matrix, dot, norm};
use crate::reference::number::{Curve, Number, Slope};
use crate::reference::plane::{Place, direction};
use crate::reference::random::Random;
use crate::reference::scene::Scene;
use crate::reference::solve;

/// One constraint of each kind on points p0 to p3, with a value that its formula has by hand at
/// A = (0, 0), B = (3, 4), C = (1, 2), D = (2, 1).
const AT: [Place; 4] = [[0.0, 0.0], [3.0, 4.0], [1.0, 2.0], [2.0, 1.0]];

fn samples() -> Vec<(Kind, Vec<usize>, Vec<f64>)> {
    let exactly = Range::exactly;
    let all = vec![0, 1, 2, 3];
    // Seen from A, B is at atan(4/3); the angle from AB to CD is -pi/4 less that.
    let turn = -0.25 * PI - direction([3.0, 4.0]);
    let made_at = vec![[0.0, 0.0], [6.0, 8.0], [0.0, 2.0]];
    vec![
        (Kind::Coordinate([1.0, 1.0]), vec![1], vec![2.0, 3.0]),
        (Kind::Coincidence, vec![1, 2], vec![2.0, 2.0]),
        (Kind::Equivalence, all.clone(), vec![2.0, 5.0]),
        (Kind::Equal(exactly(1.0)), all.clone(), vec![4.0 - SQRT_2]),
        (Kind::Multiple(2.0), all.clone(), vec![5.0 - 2.0 * SQRT_2]),
        (Kind::Length(exactly(2.0)), vec![0, 1], vec![3.0]),
        (Kind::Length(Range { lo: 1.0, hi: 4.5 }), vec![0, 1], vec![0.5]),
        (Kind::Length(Range { lo: 6.0, hi: 9.0 }), vec![0, 1], vec![-1.0]),
        (Kind::Orientation(exactly(-1.5)), all.clone(), vec![turn + 1.5]),
        (Kind::Orientation(Range { lo: -1.0, hi: 1.0 }), all.clone(), vec![turn + 1.0]),
        (
            Kind::Motor { radius: 2.0, phase: FRAC_PI_2, speed: PI },
            vec![0, 1],
            // At time 1/2 it points left.
            vec![5.0, 4.0],
        ),
        (
            // Where CD turned to the left points, along (1, 1), and across that.
            Kind::Elbow { radius: 2.0, phase: FRAC_PI_2 },
            all.clone(),
            vec![7.0 * FRAC_1_SQRT_2 - 2.0, FRAC_1_SQRT_2],
        ),
        (Kind::Glider { is_bounded: false }, vec![2, 0, 1], vec![0.4]),
        (Kind::Glider { is_bounded: true }, vec![0, 2, 3], vec![-1.5 * SQRT_2]),
        (Kind::Glider { is_bounded: true }, vec![0, 2, 1], vec![-1.0, -2.0]),
        (Kind::Glider { is_bounded: true }, vec![1, 0, 2], vec![2.0, 2.0]),
        (Kind::Hinge(0.25), vec![3, 0, 1], vec![1.25, 0.0]),
        (
            Kind::cog(2.0, [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [2.0, 1.0]]),
            all.clone(),
            vec![direction([3.0, 4.0])],
        ),
        (
            Kind::belt([1.0, -2.0], [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [2.0, 1.0]]),
            all.clone(),
            vec![direction([3.0, 4.0])],
        ),
        (Kind::Distance(exactly(0.1)), vec![2, 0, 1], vec![0.3]),
        (Kind::Parallel, all.clone(), vec![turn + PI]),
        (Kind::Perpendicular, all.clone(), vec![turn + FRAC_PI_2]),
        // The frame is half as long; C was at 2i and is at 1 + 2i: in the frame's place it
        // belongs at i.
        (Kind::Rigid(made_at), vec![0, 1, 2], vec![-5.0, 1.0, 1.0]),
        (
            Kind::rack([[0.0, 0.0], [1.0, 1.0], [1.0, 2.0], [2.0, 1.0]]),
            all.clone(),
            vec![(direction([3.0, 4.0]) - 0.25 * PI) * -3.0 * FRAC_1_SQRT_2],
        ),
        (
            // 3 below the line then.
            Kind::pinion(3.0, [[0.0, 0.0], [1.0, 1.0], [1.0, 2.0], [2.0, 1.0]]),
            all.clone(),
            vec![(direction([3.0, 4.0]) - 0.25 * PI) * -3.0],
        ),
        (Kind::Horizontal, vec![0, 1], vec![4.0]),
        (Kind::Vertical, vec![1, 2], vec![-2.0]),
        // About the line x + y = 3, (0, 0) belongs at (3, 3), and (3, 4) is 1 above.
        (Kind::Symmetric, all, vec![-FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    ]
}

fn values(kind: &Kind, points: &[usize], time: f64) -> Vec<f64> {
    let places: Vec<Place> = points.iter().map(|&p| AT[p]).collect();
    kind.equations(&places, time).iter().map(|e| e.f).collect()
}

#[test]
fn formulas_have_the_values_that_they_have_by_hand() {
    let mut seen = [false; WORDS.len()];
    for (kind, points, wanted) in samples() {
        seen[WORDS.iter().position(|word| *word == kind.word()).expect("it is a kind")] = true;
        let got = values(&kind, &points, 0.5);
        assert_eq!(got.len(), wanted.len(), "{kind:?}: {got:?}");
        for (got, wanted) in got.iter().zip(&wanted) {
            assert!((got - wanted).abs() < 1e-14, "{kind:?}: {got} and not {wanted}");
        }
    }
    assert_eq!(seen, [true; WORDS.len()]);
}

#[test]
fn limits_that_are_kept_ask_for_nothing() {
    let kept = [
        (Kind::Length(Range { lo: 4.0, hi: 6.0 }), vec![0, 1]),
        (Kind::Length(Range { lo: 0.0, hi: 5.0 }), vec![0, 1]),
        (Kind::Orientation(Range { lo: -2.0, hi: -1.0 }), vec![0, 1, 2, 3]),
        (Kind::Distance(Range { lo: 0.3, hi: f64::INFINITY }), vec![2, 0, 1]),
        (Kind::Equal(Range { lo: -1.0, hi: 4.0 }), vec![0, 1, 2, 3]),
    ];
    for (kind, points) in kept {
        let places: Vec<Place> = points.iter().map(|&p| AT[p]).collect();
        assert!(kind.equations(&places, 0.0).iter().all(|e| !e.is_active && e.f == 0.0));
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    for (kind, points, _) in samples() {
        let places: Vec<Place> = points.iter().map(|&p| AT[p]).collect();
        let at = |by: &dyn Fn(usize) -> f64| -> Vec<Place> {
            let place = |(k, p): (usize, &Place)| [p[0] + by(2 * k), p[1] + by(2 * k + 1)];
            places.iter().enumerate().map(place).collect()
        };
        let slopes = |x: &[Place]| -> Vec<Slope> {
            let variable = |k: usize| [0, 1].map(|i| Slope::variable(x[k][i], 2 * k + i));
            let x: Vec<_> = (0..x.len()).map(variable).collect();
            kind.equations(&x, 0.5).into_iter().map(|e| e.f).collect()
        };
        let variable = |k: usize| [0, 1].map(|i| Curve::variable(places[k][i], 2 * k + i));
        let x: Vec<_> = (0..places.len()).map(variable).collect();
        let curves: Vec<Curve> = kind.equations(&x, 0.5).into_iter().map(|e| e.f).collect();
        let h = 1e-5;
        for i in 0..2 * places.len() {
            let moved = |h: f64| slopes(&at(&|k| if k == i { h } else { 0.0 }));
            for ((up, down), curve) in moved(h).iter().zip(moved(-h)).zip(&curves) {
                let slope = (up.value - down.value) / (2.0 * h);
                assert!((slope - curve.gradient[i]).abs() < 1e-8, "{kind:?}");
                for j in 0..2 * places.len() {
                    let bend = (up.gradient[j] - down.gradient[j]) / (2.0 * h);
                    assert!((bend - curve.hessian[i][j]).abs() < 1e-8, "{kind:?}");
                }
            }
        }
    }
}

#[test]
fn the_rate_of_a_motor_is_that_of_differences() {
    let kind = Kind::Motor { radius: 1.5, phase: 0.3, speed: 2.0 };
    let (h, time) = (1e-5, 0.7);
    let (up, down) = (values(&kind, &[0, 1], time + h), values(&kind, &[0, 1], time - h));
    for ((up, down), rate) in up.iter().zip(down).zip(kind.rates(2, time)) {
        assert!(((up - down) / (2.0 * h) - rate).abs() < 1e-8);
    }
}

#[test]
fn arithmetic_with_derivatives_is_arithmetic() {
    let (x, y) = (Curve::variable(0.7, 0), Curve::variable(-1.3, 1));
    // f = x y / (x + y^2), by hand.
    let f = x * y / (x + y * y);
    let below = 0.7 + 1.69;
    assert!((f.value - 0.7 * -1.3 / below).abs() < 1e-15);
    assert!((f.gradient[0] - -1.3 * 1.69 / (below * below)).abs() < 1e-15);
    let by_y = 0.7 * (0.7 - 1.69) / (below * below);
    assert!((f.gradient[1] - by_y).abs() < 1e-15);
    assert!((f.hessian[0][1] - f.hessian[1][0]).abs() < 1e-15);
    assert!(((-x).sqrt().value).is_nan() && (-y).sqrt().value == 1.3_f64.sqrt());
}

#[test]
fn singular_values_are_the_known_ones() {
    // A = [[3, 0], [4, 5]]: 3 sqrt 5 and sqrt 5.
    let known = Matrix::of(2, vec![vec![3.0, 0.0], vec![4.0, 5.0]]);
    let sigma = known.svd().sigma;
    assert!(
        (sigma[0] - 45.0_f64.sqrt()).abs() < 1e-14 && (sigma[1] - 5.0_f64.sqrt()).abs() < 1e-14
    );
    // A matrix of ones has rank 1, whatever its shape.
    for (m, n) in [(3, 5), (5, 3)] {
        let svd = Matrix::of(n, vec![vec![1.0; n]; m]).svd();
        assert!((svd.sigma[0] - 15.0_f64.sqrt()).abs() < 1e-14 && svd.rank(1e-12) == 1);
    }
}

#[test]
fn decompositions_give_the_matrix_back() {
    let mut random = Random::new("matrices", 1);
    for (m, n) in [(4, 4), (7, 4), (4, 7), (1, 6), (9, 9)] {
        let row = |random: &mut Random| (0..n).map(|_| random.within(-1.0, 1.0)).collect();
        let a = Matrix::of(n, (0..m).map(|_| row(&mut random)).collect());
        let svd = a.svd();
        for i in 0..m {
            for j in 0..n {
                let sum: f64 =
                    (0..svd.sigma.len()).map(|k| svd.sigma[k] * svd.u[k][i] * svd.v[k][j]).sum();
                assert!((sum - a.rows[i][j]).abs() < 1e-13);
            }
        }
        let gram = a.gram();
        for (value, v) in gram.eigen() {
            for (left, v) in times(&gram, &v).iter().zip(&v) {
                assert!((left - value * v).abs() < 1e-13);
            }
        }
        // The shortest solution has no part that the rows do not ask for.
        let wanted: Vec<f64> = (0..m).map(|_| random.within(-1.0, 1.0)).collect();
        let x = svd.solve(&wanted, 1e-12);
        let left: Vec<f64> = times(&a, &x).iter().zip(&wanted).map(|(a, b)| a - b).collect();
        assert!(norm(&a.transposed_times(&left)) < 1e-12);
        let mut outside = x.clone();
        for v in &svd.v[..svd.rank(1e-12)] {
            let k = dot(v, &outside);
            outside.iter_mut().zip(v).for_each(|(x, v)| *x -= k * v);
        }
        assert!(norm(&outside) < 1e-12);
        if m == n {
            let x = Factors::new(&a).expect("it is regular").solve(&wanted);
            assert!(times(&a, &x).iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-11));
        }
        if m >= n {
            let b: Vec<f64> = (0..n).map(|_| random.within(-1.0, 1.0)).collect();
            let x = gram.clone().solve_definite(&b).expect("it is definite");
            assert!(times(&gram, &x).iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-10));
        }
    }
    assert!(
        Matrix::of(2, vec![vec![1.0, 2.0], vec![2.0, 1.0]]).solve_definite(&[1.0; 2]).is_none()
    );
}

fn times(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    matrix.rows.iter().map(|row| dot(row, x)).collect()
}

/// A point P between rods of length 1 from O = (0, 0) and Q = (span, 0).
fn dyad(span: f64, p: Place) -> Scene {
    let mut scene = Scene::default();
    let (o, q) = (scene.ground([0.0, 0.0]), scene.ground([span, 0.0]));
    let p = scene.point(p);
    scene.add(&[o, p], Kind::Length(Range::exactly(1.0)));
    scene.add(&[q, p], Kind::Length(Range::exactly(1.0)));
    scene
}

#[test]
fn a_dyad_is_solved_and_judged_as_by_hand() {
    let scene = dyad(1.2, [0.3, 0.1]);
    let x = solve::polished(&scene, &scene.start, 0.0, 50).expect("it has a solution");
    assert!((x[2][0] - 0.6).abs() < 1e-14 && (x[2][1] - 0.8).abs() < 1e-14);
    // On the line of centres, beyond both: the energy's slope is 0 there at 0.6 +- 1, and across
    // the line it curves down, by the stretch over the lengths.
    let far = dyad(1.2, [1.6, 0.0]);
    let fit = solve::fit(&far, &far.start, 0.0);
    assert!(fit.slope < 1e-14 && fit.is_saddle);
    let across: f64 = 0.6 / 1.6 - 0.6 / 0.4;
    assert!((fit.curvature - across).abs() < 1e-12, "{}", fit.curvature);
    // Out of reach: stretched alike, a true minimum.
    let out = dyad(3.0, [1.5, 0.0]);
    let fit = solve::fit(&out, &out.start, 0.0);
    assert!(fit.slope < 1e-14 && !fit.is_saddle && (fit.curvature - 2.0 / 3.0).abs() < 1e-12);
    let best = solve::descended(&out, &[[0.0, 0.0], [3.0, 0.0], [1.0, 0.4]], 0.0, 100, 0.0);
    assert!((best[2][0] - 1.5).abs() < 1e-9 && best[2][1].abs() < 1e-6);
    assert!(solve::solution(&out, &out.start, 0.0, 5, &mut Random::new("dyad", 1)).is_none());
    assert!(solve::solution(&far, &far.start, 0.0, 5, &mut Random::new("dyad", 1)).is_some());
}

#[test]
fn the_nearest_point_of_a_circle_is_found() {
    let mut scene = Scene::default();
    let (o, p) = (scene.ground([0.0, 0.0]), scene.point([3.0, 4.0]));
    scene.add(&[o, p], Kind::Length(Range::exactly(2.0)));
    // From the far side of the circle too.
    let starts = [scene.start.clone(), vec![[0.0, 0.0], [-2.0, 1.0]]];
    let (way, x) = solve::nearest(&scene, &scene.start, 0.0, &starts[1..]).expect("a circle");
    assert!((way - 3.0).abs() < 1e-9 && (x[1][0] - 1.2).abs() < 1e-6);
    let (way, _) = solve::nearest(&scene, &scene.start, 0.0, &starts).expect("a circle");
    assert!((way - 3.0).abs() < 1e-12);
}

#[test]
fn weights_and_frozen_points_count_in_the_measure() {
    let mut scene = dyad(1.2, [2.0, 0.0]);
    assert!((scene.violation(&scene.start, 0.0) - 1.0).abs() < 1e-15);
    // A point that resists four times as much is twice as far away.
    scene.weight[2] = 4.0;
    assert!((scene.violation(&scene.start, 0.0) - 2.0).abs() < 1e-15);
    scene.is_frozen[2] = true;
    // Nothing moves: measured as if all points did.
    assert!((scene.violation(&scene.start, 0.0) - FRAC_1_SQRT_2).abs() < 1e-15);
}
