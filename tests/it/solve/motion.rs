//! Mechanisms in motion, solved by `auto`, against closed forms and against themselves.

use crate::support::scene::{FourBar, Scene, four_bar, jansen};
use linkwork::constraint::Field;
use linkwork::solve::Status;

/// Where circles about `p` and `q` meet, on the left of p -> q or on the right.
fn meet(p: (f64, f64), r: f64, q: (f64, f64), s: f64, side: f64) -> (f64, f64) {
    let (dx, dy) = (q.0 - p.0, q.1 - p.1);
    let d = dx.hypot(dy);
    let along = (r * r - s * s + d * d) / (2.0 * d);
    let across = side * (r * r - along * along).max(0.0).sqrt();
    let (ex, ey) = (dx / d, dy / d);
    (p.0 + along * ex - across * ey, p.1 + along * ey + across * ex)
}

#[test]
fn a_four_bar_is_exact_at_every_frame() {
    for degrees in [1.0, 10.0, 30.0, 60.0] {
        let mut s = Scene::new();
        s.frames_per_unit(360.0 / degrees);
        let FourBar { crank, rocker, .. } = four_bar(&mut s, [1.0, 3.5, 3.0, 4.0], 0.0, (3.0, 3.0));
        for frame in 1..=360 {
            let report = s.step();
            assert_eq!(report.status, Status::Converged, "{degrees} degrees, frame {frame}");
            let phi = (f64::from(frame) * degrees).to_radians();
            let b = (phi.cos(), phi.sin());
            let (x, y) = meet(b, 3.5, (4.0, 0.0), 3.0, 1.0);
            let (at, pin) = (s.at(rocker), s.at(crank));
            assert!((pin.x - b.0).hypot(pin.y - b.1) < 1e-11);
            let off = (at.x - x).hypot(at.y - y);
            assert!(off < 1e-10, "{degrees} degrees, frame {frame}: off by {off:e}");
        }
    }
}

#[test]
fn jansens_leg_returns_after_each_turn() {
    for degrees in [1.0, 10.0, 30.0, 60.0] {
        let mut s = Scene::new();
        s.frames_per_unit(360.0 / degrees);
        let [_, foot] = jansen(&mut s);
        s.settle();
        let n = 360.0 / degrees;
        let mut start = s.at(foot);
        for frame in 1..=(3 * n as u32) {
            let report = s.step();
            assert_eq!(report.status, Status::Converged, "{degrees} degrees, frame {frame}");
            assert!(report.residual <= 1e-12);
            if frame == 1 {
                start = s.at(foot);
            }
            if frame == 1 + n as u32 {
                let off = s.at(foot).distance(start);
                assert!(off < 1e-9, "{degrees} degrees: off by {off:e} after a turn");
            }
        }
    }
}

#[test]
fn a_parallelogram_stays_one_through_its_change_points() {
    for (degrees, phase) in [(1.0, 0.0), (1.0, 0.31), (10.0, 0.0), (10.0, 3.7), (30.0, 0.0)] {
        let mut s = Scene::new();
        s.frames_per_unit(360.0 / degrees);
        let phase = f64::to_radians(30.0 + phase);
        let start = (4.0 + 2.0 * phase.cos(), 2.0 * phase.sin());
        let FourBar { crank, rocker, .. } = four_bar(&mut s, [2.0, 4.0, 2.0, 4.0], phase, start);
        for frame in 0..360 {
            s.step();
            let (p, q) = (s.at(crank), s.at(rocker));
            let off = (q.x - p.x - 4.0).hypot(q.y - p.y);
            assert!(off < 1e-5, "{degrees} degrees, frame {frame}: off by {off:e}");
        }
    }
}

#[test]
fn a_nearly_parallelogram_takes_the_turn_it_has_to() {
    for degrees in [1.0, 10.0] {
        let mut s = Scene::new();
        s.frames_per_unit(360.0 / degrees);
        let phase = f64::to_radians(60.0);
        let start = meet((phase.cos(), phase.sin()), 4.0, (4.0, 0.0), 1.001, -1.0);
        let FourBar { crank, rocker, .. } = four_bar(&mut s, [1.0, 4.0, 1.001, 4.0], phase, start);
        for frame in 0..360 {
            assert_eq!(s.step().status, Status::Converged);
            let (p, q) = (s.at(crank), s.at(rocker));
            // The shortest link turns and all lengths differ: the branch never changes.
            let (x, y) = meet((p.x, p.y), 4.0, (4.0, 0.0), 1.001, -1.0);
            let off = (q.x - x).hypot(q.y - y);
            assert!(off < 1e-6, "{degrees} degrees, frame {frame}: off by {off:e}");
        }
    }
}

#[test]
fn a_motor_past_its_toggle_and_back_finds_the_same_pose() {
    for n in [1, 6, 60] {
        let mut s = Scene::new();
        let FourBar { rocker, motor, .. } =
            four_bar(&mut s, [4.0, 2.5, 1.0, 2.0], f64::to_radians(30.0), (2.6, 0.8));
        s.set(motor, Field::Speed, 0.0);
        assert_eq!(s.settle().status, Status::Converged);
        let before = s.at(rocker);
        // Out of reach above about 55 degrees.
        let speed = 360.0 * f64::to_radians(60.0) / f64::from(n);
        for k in 0..2 * n {
            s.set(motor, Field::Speed, if k < n { speed } else { -speed });
            let report = s.step();
            assert!(k + 1 != n || report.status == Status::BestFit, "{report:?}");
        }
        let off = s.at(rocker).distance(before);
        assert!(off < 1e-9, "in {n} frames: off by {off:e}");
    }
}
