//! Bodies that are found together, since none is by itself: triads and what is like them.

use super::bodies::{check_bars, check_closed};
use super::closed_form::check_same;
use crate::support::draws::draws;
use crate::support::talk::Talking;
use proptest::prelude::*;

/// A crank that drives a link with three joints, whose other two hang on rods from the ground.
const TRIAD: &str =
    "point A = (0, 0) frozen, B = (0.3, 0), D = (6.9, 2.2) frozen, E = (0.3, 7.8) frozen
    motor A B radius 0.3 speed 1rev
    point P = (0.6, 3.4), Q = (2.4, 3.9), R = (2.4, 4.9)
    length B P; length D Q; length E R
    set dt 1/180";

/// Ways of making that link.
const LINKS: [&str; 3] = [
    "length P Q; length Q R; length R P",
    "rigid P Q R",
    "point S = (2, 2.8), T = (2.9, 3)
     length P S; length Q S; length P Q; length S R; length Q R; length P T; length S T",
];

#[test]
fn a_link_on_three_rods_is_found_at_once() {
    let mut ends = Vec::new();
    for link in LINKS {
        let scene = format!("{TRIAD}\n{link}\nstep 4");
        let talking = check_closed(&scene, 175);
        ends.push(talking.session.position("R").unwrap());
        check_same(link, &scene, 60);
    }
    // However it is made, and in however small steps it goes.
    let small = Talking::after(&format!("{TRIAD}\n{}\nset dt 1/3600\nstep 3600", LINKS[0]));
    ends.push(small.session.position("R").unwrap());
    assert!(ends.iter().all(|end| end.distance(ends[0]) < 1e-11), "{ends:?}");
}

/// A rod with a third joint on it, on rods as before.
const HINGED: &str =
    "point A = (0, 0) frozen, B = (0.3, 0), D = (6, 0.8) frozen, E = (1.5, 7.9) frozen
    motor A B radius 0.3 speed 1rev
    point P = (-0.1, 3), Q = (3.8, 2.3), R = (1.46, 2.72)
    length P Q; hinge R on P Q at 0.4
    length B P; length D Q; length E R
    set dt 1/180";

/// Two links hinged on each other, each on two rods.
const PAIR: &str = "point A = (0, 0) frozen, B = (0.3, 0)
    point D = (0.9, -2) frozen, E = (7.8, -1.7) frozen, F = (6, 6.8) frozen
    motor A B radius 0.3 speed 1rev
    point P = (0.7, 3.3), Q = (1.4, 2), H = (2.7, 3.9), S = (4.3, 2.5), T = (4.1, 4.7)
    length P Q; length Q H; length P H
    length S T; length T H; length S H
    length B P; length D Q; length E S; length F T
    set dt 1/180";

/// A link on a pivot, and another on a hinge of that, on two rods.
const CARRIED: &str =
    "point A = (0, 0) frozen, B = (0.3, 0), D = (3.8, -1) frozen, E = (2.2, 7.2) frozen
    motor A B radius 0.3 speed 1rev
    point P = (0.2, 3), Q = (1.6, 3.5), H = (2.7, 2.6), S = (4.1, 1.7), G = (2.5, 7.1)
    length P Q; length Q H; length P H
    length D H; length D S; length S H
    length B P; length G Q; length E G; length S G
    set dt 1/180";

#[test]
fn few_bodies_are_found_together() {
    for (name, scene) in [("hinged", HINGED), ("pair", PAIR), ("carried", CARRIED)] {
        let scene = format!("{scene}\nstep 4");
        let talking = check_closed(&scene, 175);
        check_same(name, &scene, 50);
        let small = Talking::after(&format!("{scene}\nset dt 1/3600\nstep 3520"));
        let [one, other] = [&talking, &small].map(|t| t.session.position("P").unwrap());
        // The clocks differ by rounding.
        assert!(one.distance(other) < 1e-10, "{name}: {one:?} {other:?}");
    }
}

#[test]
fn a_link_on_three_rods_may_hang_on_another() {
    let scene = format!(
        "{TRIAD}\n{}
         point U = (3.6, 4.7), V = (5, 6), W = (4.2, 7.5), F = (12, 6.4) frozen, G = (4.5, 16) frozen
         length U V; length V W; length W U
         length R U; length F V; length G W
         step 4",
        LINKS[0]
    );
    check_closed(&scene, 175);
    check_same("one on the other", &scene, 50);
}

#[test]
fn a_rod_of_a_link_that_changes_moves_it() {
    let scene = TRIAD.replace("length E R", "length E R = 3.58 + 0.1 * sin(time * 2rev)");
    let scene = format!("{scene}\n{}\nstep 4", LINKS[0]);
    check_closed(&scene, 170);
    check_same("changing", &scene, 50);
}

#[test]
fn a_link_that_cannot_go_on_meets_its_dead_point_as_in_small_steps() {
    let scene = TRIAD.replace("0.3, 0)", "2.5, 0)").replace("radius 0.3", "radius 2.5");
    for per_turn in [360, 1440] {
        let mut talking = Talking::after(&format!("{scene}\n{}\nset dt 1/{per_turn}", LINKS[0]));
        talking.run(&format!("step {}", per_turn / 5));
        let told = talking.talk.told().join("\n");
        assert!(told.contains("meets a dead point at 38.30"), "{told}");
    }
    check_same("dead point", &format!("{scene}\n{}", LINKS[0]), 200);
}

/// A triad with its joints somewhere near those of the others.
fn triad() -> impl Strategy<Value = String> {
    let off = || (-0.5..0.5, -0.5..0.5);
    (off(), off(), off(), off(), off(), 0.2..0.9, any::<bool>()).prop_map(
        |(p, q, r, d, e, crank, is_rigid)| {
            let at =
                |x: f64, y: f64, off: (f64, f64)| format!("({:?}, {:?})", x + off.0, y + off.1);
            let (p, q, r) = (at(1.0, 2.0, p), at(3.0, 2.2, q), at(2.0, 3.5, r));
            let (d, e) = (at(4.0, 0.5, d), at(2.0, 6.0, e));
            let link = LINKS[usize::from(is_rigid)];
            format!(
                "point A = (0, 0) frozen, B = ({crank:?}, 0), D = {d} frozen, E = {e} frozen
                 motor A B speed 1rev
                 point P = {p}, Q = {q}, R = {r}
                 length B P; length D Q; length E R
                 {link}"
            )
        },
    )
}

proptest! {
    #![proptest_config(draws(40))]

    #[test]
    fn triads_go_where_small_steps_lead(triad in triad(), per_turn in 40..400_u32) {
        let scene = format!("{triad}\nset dt 1/{per_turn}");
        check_same(&triad, &scene, 40);
        let mut large = Talking::after(&format!("{scene}\nstep {per_turn}"));
        let mut small = Talking::after(&format!("{triad}\nset dt 1/{}\nstep {}", 16 * per_turn, 16 * per_turn));
        let is_exact = |talking: &mut Talking| {
            talking.talk.told().iter().all(|told| told.contains("exact to"))
        };
        if is_exact(&mut large) && is_exact(&mut small) {
            check_bars(&large);
            let [one, other] = [&large, &small].map(|t| t.session.position("R").unwrap());
            prop_assert!(one.distance(other) < 1e-8, "{:?} {:?}\n{}", one, other, scene);
        }
    }
}
