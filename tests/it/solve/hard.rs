//! Places where a solver may lie, jump, blow up or fall silent.

use crate::support::scene::{FourBar, Scene, four_bar, jansen, peaucellier};
use linkwork::constraint::{Cog, Field, Point};
use linkwork::solve::{Method, Status};
use linkwork::world::{Edit, PointId};

#[test]
fn an_impossible_triangle_fits_best() {
    for method in [Method::Auto, Method::Relaxation, Method::Newton, Method::Conjugate] {
        let mut s = Scene::new();
        s.settings.method = method;
        let p = [s.point(0.0, 0.0), s.point(1.0, 0.1), s.point(0.4, 0.9)];
        s.length(p[0], p[1], 1.0);
        s.length(p[1], p[2], 1.0);
        s.length(p[2], p[0], 3.0);
        let report = s.settle();
        assert_eq!(report.status, Status::BestFit, "{method:?}: {report:?}");
        assert_eq!(report.n_unsolved_islands, 1);
        let tolerance = if method == Method::Conjugate { 1e-5 } else { 1e-8 };
        let l = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| s.at(p[a]).distance(s.at(p[b])));
        for (l, best) in l.into_iter().zip([4.0 / 3.0, 4.0 / 3.0, 8.0 / 3.0]) {
            assert!((l - best).abs() < tolerance, "{method:?}: {l} for {best}");
        }
    }
}

#[test]
fn frozen_points_that_contradict_a_constraint_are_reported() {
    let mut s = Scene::new();
    let (a, b) = (s.ground(0.0, 0.0), s.ground(2.0, 0.0));
    let bar = s.length(a, b, 1.0);
    let report = s.step();
    assert_eq!(report.status, Status::Unsatisfiable);
    assert_eq!(s.solver.status_of_constraint(bar), Some(Status::Unsatisfiable));
    assert_eq!(s.drag(b, 1.0, 0.0).status, Status::Converged);
    assert_eq!(s.drag(b, 0.0, 3.0).status, Status::Unsatisfiable);
    s.world.apply(Edit::Freeze(b, false));
    assert_eq!(s.step().status, Status::Converged);
    assert!(s.worst() < 1e-12);
}

#[test]
fn a_straight_strut_leaves_its_saddle() {
    let mut s = Scene::new();
    let (a, b) = (s.ground(0.0, 0.0), s.ground(1.8, 0.0));
    let p = s.point(0.9, 0.0);
    s.length(a, p, 1.0);
    s.length(p, b, 1.0);
    assert_eq!(s.settle().status, Status::Converged);
}

#[test]
fn coincident_points_come_apart() {
    let mut s = Scene::new();
    let p = [s.point(1.0, 1.0), s.point(1.0, 1.0), s.point(1.0, 1.0)];
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        s.length(p[a], p[b], 1.0);
    }
    assert_eq!(s.settle().status, Status::Converged);
    assert!(s.worst() < 1e-12);
}

#[test]
fn a_rod_of_no_length_closes() {
    let mut s = Scene::new();
    let (a, b) = (s.ground(0.0, 0.0), s.point(1.0, 1.0));
    s.length(a, b, 0.0);
    assert_eq!(s.settle().status, Status::Converged);
    assert!(s.at(a).distance(s.at(b)) < 1e-9);
}

#[test]
fn a_slider_passes_its_dead_centre() {
    let mut s = Scene::new();
    let o = s.ground(0.0, 0.0);
    let phase = f64::to_radians(30.0);
    let pin = s.point(phase.cos(), phase.sin());
    let (near, far) = (s.ground(-9.0, 0.0), s.ground(9.0, 0.0));
    let piston = s.point(2.0 * phase.cos(), 0.0);
    s.motor(o, pin, 1.0, phase);
    s.length(pin, piston, 1.0);
    s.glider(piston, near, far);
    for frame in 1..=720 {
        s.step();
        let x = 2.0 * (phase + f64::to_radians(f64::from(frame))).cos();
        let off = (s.at(piston).x - x).abs();
        assert!(off < 1e-5, "frame {frame}: off by {off:e}");
    }
}

#[test]
fn a_chain_stretched_too_far_comes_back() {
    let mut s = Scene::new();
    let a = s.ground(0.0, 0.0);
    let mut last = a;
    let mut joints = Vec::new();
    for k in 1..=10 {
        let y = 0.4 * f64::from(k % 2);
        let p = if k < 10 { s.point(0.9 * f64::from(k), y) } else { s.ground(9.0, 0.0) };
        s.length(last, p, 1.0);
        joints.push(p);
        last = p;
    }
    assert_eq!(s.settle().status, Status::Converged);
    for k in 0..=50 {
        s.drag(last, 9.0 + 9.0 * f64::from(k) / 50.0, 0.0);
    }
    assert_eq!(s.solver.status_of_point(joints[0]), Some(Status::BestFit));
    for p in &joints {
        assert!(s.at(*p).y.abs() < 1e-6, "not straight: {:?}", s.at(*p));
    }
    for k in (0..=50).rev() {
        s.drag(last, 9.0 + 9.0 * f64::from(k) / 50.0, 0.0);
    }
    assert_eq!(s.solver.status_of_point(joints[0]), Some(Status::Converged));
}

#[test]
fn a_hundred_copies_of_each_constraint_change_nothing() {
    for method in Method::ALL {
        let mut s = Scene::new();
        s.settings.method = method;
        let FourBar { rocker, crank, .. } = four_bar(&mut s, [1.0, 3.5, 3.0, 4.0], 0.0, (3.0, 3.0));
        for _ in 0..99 {
            s.length(crank, rocker, 3.5);
        }
        for frame in 0..100 {
            let report = s.step();
            assert!(s.at(rocker).is_finite() && report.residual < 0.1, "{method:?} {frame}");
            assert!(method != Method::Auto || report.status == Status::Converged);
        }
    }
}

#[test]
fn a_star_of_bars_stays_in_one_place() {
    for method in Method::ALL {
        let mut s = Scene::new();
        s.settings.method = method;
        let hub = s.point(0.1, 0.05);
        for k in 0..32 {
            let phi = f64::from(k) / 32.0 * std::f64::consts::TAU;
            let rim = s.point(1.1 * phi.cos(), 1.1 * phi.sin());
            s.length(hub, rim, 1.0);
        }
        (0..20).for_each(|_| {
            s.step();
        });
        assert!(s.worst() < 1e-6, "{method:?}: {:e}", s.worst());
    }
}

#[test]
fn far_from_the_origin_what_can_be_exact_is() {
    for (offset, most) in [(0.0, 1e-12), (1e6, 2e-11), (1e9, 2e-8)] {
        let mut s = Scene::new();
        jansen(&mut s);
        let ids: Vec<PointId> = s.world.points().ids().collect();
        for p in ids {
            let at = s.at(p);
            s.move_to(p, at.x + offset, at.y - offset);
        }
        for _ in 0..90 {
            let report = s.step();
            assert_eq!(report.status, Status::Converged, "{offset:e}: {report:?}");
            assert!(report.residual < most, "{offset:e}: {:e}", report.residual);
        }
    }
}

#[test]
fn size_does_not_matter() {
    let mut all = Vec::new();
    for scale in [1.0, 1e9, 1e-9] {
        let mut s = Scene::new();
        let (o, q) = (s.ground(0.0, 0.0), s.ground(4.0 * scale, 0.0));
        let (p, r) = (s.point(scale, 0.0), s.point(3.0 * scale, 3.0 * scale));
        s.motor(o, p, scale, 0.0);
        s.length(p, r, 3.5 * scale);
        s.length(r, q, 3.0 * scale);
        let iterations: Vec<u64> = (0..100).map(|_| s.step().iterations).collect();
        all.push((iterations, Point::new(s.at(r).x / scale, s.at(r).y / scale)));
    }
    for (iterations, at) in &all[1..] {
        assert_eq!(*iterations, all[0].0);
        assert!(at.distance(all[0].1) < 1e-12);
    }
}

#[test]
fn a_cord_goes_taut_and_slack_without_chatter() {
    let mut s = Scene::new();
    let a = s.ground(0.0, 0.0);
    let (p, q) = (s.point(1.0, 0.0), s.point(1.9, 0.0));
    s.within(a, p, 0.0, 1.5);
    s.within(p, q, 0.5, 1.0);
    for k in 0..400 {
        let report = s.drag(a, 2.0 * (f64::from(k) * 0.05).sin(), 0.0);
        assert_eq!(report.status, Status::Converged, "frame {k}: {report:?}");
    }
}

#[test]
fn a_slider_crank_into_its_end_stop_fits_best_and_returns() {
    let mut s = Scene::new();
    let o = s.ground(0.0, 0.0);
    let pin = s.point(0.0, 1.0);
    let (near, far) = (s.ground(2.3, 0.0), s.ground(3.5, 0.0));
    let piston = s.point(2.8, 0.0);
    s.motor(o, pin, 1.0, f64::to_radians(90.0));
    s.length(pin, piston, 3.0);
    s.glider(piston, near, far);
    assert_eq!(s.settle().status, Status::Converged);
    let (start, mut n_out) = (s.at(piston), 0);
    for _ in 0..360 {
        n_out += u32::from(s.step().status == Status::BestFit);
    }
    assert!((20..340).contains(&n_out), "{n_out} frames out of reach");
    assert!(s.at(piston).distance(start) < 1e-9);
}

#[test]
fn an_impossible_neighbour_does_not_hold_back_a_sound_mechanism() {
    let mut s = Scene::new();
    let [_, foot] = jansen(&mut s);
    let p = [s.point(0.0, 0.0), s.point(1.0, 0.1), s.point(0.4, 0.9)];
    s.length(p[0], p[1], 1.0);
    s.length(p[1], p[2], 1.0);
    s.length(p[2], p[0], 3.0);
    for _ in 0..60 {
        let report = s.step();
        assert_eq!(report.status, Status::BestFit);
        assert_eq!(s.solver.status_of_point(foot), Some(Status::Converged));
    }
}

#[test]
fn wheels_keep_their_phase_for_a_thousand_turns_and_back() {
    let mut s = Scene::new();
    s.frames_per_unit(36.0);
    let (o, ring) = (s.ground(0.0, 0.0), s.ground(1.0, 0.0));
    let planet = s.point(0.75, 0.0);
    let mark = s.point(1.0, 0.0);
    let motor = s.motor(o, planet, 0.75, 0.0);
    s.length(planet, mark, 0.25);
    let x = s.world.points().column().to_vec();
    s.add(Cog::new([o.0, ring.0, planet.0, mark.0], -0.25, &x));
    for turn in 0..100 {
        for _ in 0..36 {
            assert_eq!(s.step().status, Status::Converged);
        }
        let off = s.at(mark).distance(Point::new(1.0, 0.0));
        assert!(off < 1e-9, "turn {turn}: off by {off:e}");
    }
    s.set(motor, Field::Speed, -std::f64::consts::TAU);
    for _ in 0..3600 {
        s.step();
    }
    assert!(s.at(mark).distance(Point::new(1.0, 0.0)) < 1e-9);
}

#[test]
fn peaucelliers_point_stays_on_its_line() {
    let mut s = Scene::new();
    let [_, out] = peaucellier(&mut s);
    let (motor, _) = s.world.constraints().next().expect("a motor");
    let at = |k: f64| f64::to_radians(60.0) * k.to_radians().sin();
    for k in 1..=360 {
        let speed = 360.0 * (at(f64::from(k)) - at(f64::from(k - 1)));
        s.set(motor, Field::Speed, speed);
        assert_eq!(s.step().status, Status::Converged);
        assert!((s.at(out).x - 6.75).abs() < 1e-9, "{k}: {:?}", s.at(out));
    }
}

#[test]
fn a_ground_pivot_goes_to_a_million_and_back() {
    let mut s = Scene::new();
    let (a, b) = (s.ground(0.0, 0.0), s.ground(3.0, 0.0));
    let p = s.point(1.5, 1.0);
    s.length(a, p, 2.0);
    s.length(p, b, 2.0);
    s.settle();
    let before = s.at(p);
    s.drag(b, 1e6, 0.0);
    assert!(s.at(p).is_finite());
    s.drag(b, 3.0, 0.0);
    assert!(s.at(p).distance(before) < 1e-9, "{:?}", s.at(p));
}
