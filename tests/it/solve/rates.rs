//! Velocities and accelerations against closed forms and differences.

use crate::support::scene::{Scene, four_bar, jansen};
use linkwork::constraint::Motor;
use std::f64::consts::TAU;

#[test]
fn a_slider_crank_moves_as_its_closed_form() {
    let (r, l) = (1.0, 3.0);
    for degrees in [10.0, 80.0, 135.0, 250.0] {
        let mut s = Scene::new();
        let phi = f64::to_radians(degrees);
        let o = s.ground(0.0, 0.0);
        let pin = s.point(r * phi.cos(), r * phi.sin());
        let (near, far) = (s.ground(-10.0, 0.0), s.ground(10.0, 0.0));
        let piston = s.point(3.0, 0.0);
        s.motor(o, pin, r, phi);
        s.length(pin, piston, l);
        s.glider(piston, near, far);
        s.settle();
        let rates = s.solver.rates(&mut s.world, &s.settings).expect("no live values");
        let (sin, cos) = phi.sin_cos();
        let root = (l * l - r * r * sin * sin).sqrt();
        let v = -r * TAU * sin - r * r * TAU * sin * cos / root;
        let a = -r * TAU * TAU * cos
            - r * r * TAU * TAU * ((cos * cos - sin * sin) / root)
            - r.powi(4) * TAU * TAU * (sin * cos).powi(2) / root.powi(3);
        let (dv, da) = (rates.velocity[piston.idx()], rates.acceleration[piston.idx()]);
        assert!((dv.x - v).abs() < 1e-10 && dv.y.abs() < 1e-10, "{degrees}: {dv:?} {v}");
        assert!((da.x - a).abs() < 1e-8 && da.y.abs() < 1e-8, "{degrees}: {da:?} {a}");
    }
}

#[test]
fn rates_agree_with_differences_of_frames() {
    let h = 1.0 / 36000.0;
    for which in 0..2 {
        let mut s = Scene::new();
        s.frames_per_unit(1.0 / h);
        let points = if which == 0 {
            let bar = four_bar(&mut s, [1.0, 3.5, 3.0, 4.0], 0.5, (3.0, 3.0));
            vec![bar.crank, bar.rocker]
        } else {
            jansen(&mut s).to_vec()
        };
        for p in points {
            let mut x = Vec::new();
            let mut rates = None;
            for frame in 0..3 {
                s.step();
                x.push(s.at(p));
                if frame == 1 {
                    rates =
                        Some(s.solver.rates(&mut s.world, &s.settings).expect("no live values"));
                }
            }
            let rates = rates.expect("asked in the middle");
            let (v, a) = (rates.velocity[p.idx()], rates.acceleration[p.idx()]);
            let dv = (x[2] - x[0]) / (2.0 * h);
            let da = ((x[2] - x[1]) - (x[1] - x[0])) / (h * h);
            assert!((dv - v).norm() < 1e-5 * v.norm(), "{v:?} {dv:?}");
            assert!((da - a).norm() < 1e-3 * a.norm(), "{a:?} {da:?}");
        }
    }
}

#[test]
fn what_nothing_moves_stands_still() {
    let mut s = Scene::new();
    let (o, p, q) = (s.ground(0.0, 0.0), s.point(1.0, 0.0), s.point(2.0, 0.0));
    s.add(Motor::new([o.0, p.0], 1.0, 0.0, 0.0));
    s.length(p, q, 1.0);
    s.settle();
    let rates = s.solver.rates(&mut s.world, &s.settings).expect("no live values");
    for p in [p, q] {
        assert!(rates.velocity[p.idx()].norm() < 1e-15);
        assert!(rates.acceleration[p.idx()].norm() < 1e-15);
    }
}
