//! How far what drives can go, be it a value of a constraint or a parameter: `limits` against closed
//! forms.

use crate::support::talk::Talking;
use linkwork::constraint::Flaw;
use linkwork::mobility::{DriverRange, RangeEnd as End, Reach};

fn range(talking: &Talking, name: &str) -> DriverRange {
    let session = &talking.session;
    let entity = session.world().names().get(name).unwrap_or_else(|| panic!("nothing is {name}"));
    session.range(entity).expect("it drives")
}

#[track_caller]
fn ends(talking: &Talking, name: &str) -> [End; 2] {
    let found = range(talking, name);
    let Reach::Between(lower, upper) = found.reach else { panic!("{found:?}") };
    [lower, upper]
}

/// Both ends are dead points at these values.
#[track_caller]
fn check_dead_points(talking: &Talking, name: &str, lower: f64, upper: f64) {
    let found = ends(talking, name);
    assert!(found.iter().all(|end| matches!(end, End::DeadPoint(_))), "{found:?}");
    let [from, to] = found.map(End::value);
    let errors = [from - lower, to - upper];
    assert!(errors.iter().all(|e| e.abs() < 1e-10), "{errors:?}: {lower} {upper}");
}

/// A telescope that opens a triangle of sides `a` and `b` along a rail.
fn triangle(a: f64, b: f64) -> Talking {
    Talking::after(&format!(
        "point A = (0, 0) frozen, X = (-1, 0) frozen, Y = (1, 0) frozen, C = (4, 0), B = (2, 1)
         length A B = {a}; length B C = {b}; glider C on X Y unbounded
         jack: length A C = 4
         solve within 1e-11"
    ))
}

#[test]
fn a_telescope_opens_a_triangle_from_the_difference_to_the_sum_of_its_sides() {
    check_dead_points(&triangle(3.0, 2.0), "jack", 1.0, 5.0);
    check_dead_points(&triangle(2.5, 3.25), "jack", 0.75, 5.75);
    let mut told = triangle(3.0, 2.0);
    let told = told.ask("limits jack");
    assert_eq!(told, ["jack goes from 1, a dead point, to 5, a dead point; it is at 4"]);
}

#[test]
fn a_length_goes_down_to_nothing_and_no_farther() {
    let mut talking = triangle(3.0, 3.0);
    let [End::NoValue(from, Some(Flaw::NegativeLength)), End::DeadPoint(to)] =
        ends(&talking, "jack")
    else {
        panic!("{:?}", range(&talking, "jack"))
    };
    assert!((0.0..1e-10).contains(&from) && (to - 6.0).abs() < 1e-10, "{from} {to}");
    // With both ends of the jack in one place the rest could turn around them.
    let told = talking.ask("limits jack").concat();
    assert!(told.contains("from 0, beyond which there would be a negative length, to 6"), "{told}");
    assert!(told.ends_with("it is at 4; change point at 0"), "{told}");
}

#[test]
fn a_length_that_goes_on_for_ever_says_how_far_was_looked() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, X = (-1, 1) frozen, Y = (1, 1) frozen, B = (2, 1)
         glider B on X Y unbounded
         jack: length A B = 2.5
         solve within 1e-11",
    );
    let [End::DeadPoint(from), End::Endless(to)] = ends(&talking, "jack") else {
        panic!("{:?}", range(&talking, "jack"))
    };
    assert!((from - 1.0).abs() < 1e-10 && to > 100.0, "{from} {to}");
    let told = talking.ask("limits jack").concat();
    assert!(told.starts_with("jack goes from 1, a dead point, to at least "), "{told}");
    assert!(told.ends_with(", where the search ends; it is at 2.5"), "{told}");
}

/// A slider-crank with something that says where its slider is.
fn slider_crank(driver: &str) -> Talking {
    Talking::after(&format!(
        "point A = (0, 0) frozen, X = (-9, 0.5) frozen, Y = (9, 0.5) frozen
         point Q = (2, -1) frozen, R = (2, 1) frozen, B = polar(1, 40deg), C = (2.5, 0.5)
         length A B = 1; length B C = 2; glider C on X Y unbounded
         {driver}
         solve within 1e-11"
    ))
}

#[test]
fn a_slider_drives_its_crank_between_its_dead_points() {
    let [lower, upper] = [1.0, 3.0].map(|reach: f64| (reach * reach - 0.25).sqrt());
    check_dead_points(&slider_crank("at: length A C = 2.4"), "at", 1.0, 3.0);
    // Q R points up: what lies to the right of it is negative.
    let distance = slider_crank("at: distance C to Q R = -0.5");
    check_dead_points(&distance, "at", 2.0 - upper, 2.0 - lower);
    check_dead_points(&slider_crank("at: hold C.x = 2.4"), "at", lower, upper);
    check_dead_points(&slider_crank("let u = 2.4; hold C.x = u"), "u", lower, upper);
    check_dead_points(
        &slider_crank("let u = 1.2; hold C.x = 2 * u"),
        "u",
        lower / 2.0,
        upper / 2.0,
    );
    let ratio = "point S = (4, 0.5) frozen, T = (0, 0.5) frozen; at: hinge C on T S at 0.6";
    let hinge = Talking::after(&format!(
        "point A = (0, 0) frozen, B = polar(1, 40deg), C = (2.5, 0.5)
         length A B = 1; length B C = 2
         {ratio}
         solve within 1e-11"
    ));
    check_dead_points(&hinge, "at", lower / 4.0, upper / 4.0);
}

#[test]
fn an_end_stop_of_the_slider_stops_what_drives_it() {
    let mut talking = slider_crank("at: hold C.x = 2.4; stop: length C X <= 11.75");
    let [End::DeadPoint(_), End::Stop(to, _)] = ends(&talking, "at") else {
        panic!("{:?}", range(&talking, "at"))
    };
    assert!((to - 2.75).abs() < 1e-10, "{to}");
    let told = talking.ask("limits at").concat();
    assert!(told.contains("to 2.75, where stop stops it; it is at 2.4"), "{told}");
}

/// A four-bar that its crank holds, its coupler and what else as said.
fn four_bar(more: &str) -> Talking {
    Talking::after(&format!(
        "point A = (0, 0) frozen, D = (4, 0) frozen
         point B = polar(1, 60deg), C = (4.5, 3)
         crank: motor A B radius 1 phase 60deg
         length C D = 3
         {more}
         solve within 1e-11"
    ))
}

#[test]
fn a_parameter_drives_the_length_of_a_coupler() {
    // B is as far from D as the root of 1 + 16 - 2 * 4 cos 60.
    let reach = 13.0_f64.sqrt();
    let coupler = "let w = 3.2; length B C = w";
    check_dead_points(&four_bar(coupler), "w", reach - 3.0, reach + 3.0);
    // Through another parameter, and not in proportion.
    let squared = "let w = 1.8, v = w^2; length B C = v";
    check_dead_points(&four_bar(squared), "w", (reach - 3.0).sqrt(), (reach + 3.0).sqrt());
    // As a part of what is measured on the pose.
    let measured = "let w = 0.8; length B C = w * distance(A, D)";
    check_dead_points(&four_bar(measured), "w", (reach - 3.0) / 4.0, (reach + 3.0) / 4.0);
    let moving = "let w = 0.8; length B C = w * distance(C, D)";
    check_dead_points(&four_bar(moving), "w", (reach - 3.0) / 3.0, (reach + 3.0) / 3.0);
}

#[test]
fn a_parameter_drives_all_that_follows_it() {
    // An isosceles triangle over a base: it lies flat where the sides are half as long.
    let mut talking = Talking::after(
        "let w = 3
         point A = (0, 0) frozen, B = (4, 0) frozen, C = (2, 2)
         length A C = w; length B C = w
         solve within 1e-11",
    );
    let [End::DeadPoint(from), End::Endless(_)] = ends(&talking, "w") else {
        panic!("{:?}", range(&talking, "w"))
    };
    assert!((from - 2.0).abs() < 1e-10, "{from}");
    // A second mechanism, apart from the first, that reaches from 5/3 to 3.
    talking.run(
        "point P = (10, 0) frozen, Q = (15, 0) frozen, R = (13, 2)
         length P R = w; length Q R = 2 * w - 1
         solve within 1e-11",
    );
    check_dead_points(&talking, "w", 2.0, 6.0);
}

#[test]
fn a_root_ends_where_it_has_no_value() {
    let mut talking = Talking::after(
        "let k = 3
         point A = (0, 0) frozen, X = (-1, 0) frozen, Y = (1, 0) frozen, B = (1.7, 0)
         glider B on X Y unbounded; length X B = 2 + sqrt(k)
         solve within 1e-11",
    );
    let [End::NoValue(from, None), End::Endless(_)] = ends(&talking, "k") else {
        panic!("{:?}", range(&talking, "k"))
    };
    assert!((0.0..1e-9).contains(&from), "{from}");
    let told = talking.ask("limits k").concat();
    assert!(told.starts_with("k goes from 0, beyond which something has no value, to"), "{told}");
}

#[test]
fn a_root_that_folds_at_nothing_ends_there() {
    // The bar A C is drawn into a point, and out of it again on the other side.
    let talking = Talking::after(
        "let k = 3
         point A = (0, 0) frozen, B = (2, 0) frozen, C = (1, 1)
         length A C = sqrt(k); length B C = 2
         solve within 1e-11",
    );
    check_dead_points(&talking, "k", 0.0, 16.0);
}

#[test]
fn an_actuator_folds_a_lid_between_its_dead_points() {
    let lid = "point A = (0, 0) frozen, D = (1, -0.5) frozen, C = polar(2, 30deg)
               length A C = 2";
    let pivots = 1.25_f64.sqrt();
    let by_ram = Talking::after(&format!("{lid}\nram: length D C = 2\nsolve within 1e-11"));
    check_dead_points(&by_ram, "ram", 2.0 - pivots, 2.0 + pivots);
    // The other way about: how far the lid turns while the ram has only so much stroke.
    let mut talking = Talking::after(&format!(
        "{lid}
         lid: orientation D A, A C = 240deg
         stroke: length D C in 1..2.5
         solve within 1e-11"
    ));
    let [End::Stop(from, _), End::Stop(to, _)] = ends(&talking, "lid") else {
        panic!("{:?}", range(&talking, "lid"))
    };
    let turn = |ram: f64| ((4.0 + 1.25 - ram * ram) / (4.0 * pivots)).acos().to_degrees();
    let [from, to] = [from, to].map(f64::to_degrees);
    assert!((to - from - (turn(2.5) - turn(1.0))).abs() < 1e-8, "{from} {to}");
    let told = talking.ask("limits lid").concat();
    assert!(told.contains(" deg, where stroke stops it; it is at "), "{told}");
    talking.run("off stroke; solve");
    assert_eq!(range(&talking, "lid").reach, Reach::Full(1));
    assert_eq!(talking.ask("limits lid"), ["lid goes all the way round"]);
}

#[test]
fn the_width_of_a_scissor_lift_reaches_from_nothing_to_its_arms() {
    let talking = Talking::after(
        "let w = 1
         point A = (0, 0) frozen, X = (-1, 0) frozen, Y = (1, 0) frozen
         point B = (w, 0), C = (0, 2.8), D = (1, 2.8), M = (0.5, 1.4)
         glider B on X Y unbounded; length A B = w
         length A D = 3; length B C = 3
         hinge M on A D at 0.5; hinge M on B C at 0.5
         solve within 1e-11",
    );
    let [End::NoValue(from, _), End::DeadPoint(to)] = ends(&talking, "w") else {
        panic!("{:?}", range(&talking, "w"))
    };
    assert!((0.0..1e-10).contains(&from) && (to - 3.0).abs() < 1e-10, "{from} {to}");
}

#[test]
fn an_angle_that_is_a_parameter_is_as_good_as_a_motor() {
    let rocker = |lengths: [f64; 3], drive: &str| {
        let [a, b, c] = lengths;
        Talking::after(&format!(
            "point A = (0, 0) frozen, D = (4, 0) frozen
             point B = polar({a}, 40deg), C = B + polar({b}, 60deg)
             let phi = 40deg
             {drive}
             length A B = {a}; length B C = {b}; length C D = {c}
             solve within 1e-11"
        ))
    };
    for drive in ["o: orientation A D, A B = phi", "motor A B phase phi"] {
        let talking = rocker([3.0, 2.5, 2.5], drive);
        let quarter = std::f64::consts::FRAC_PI_2;
        check_dead_points(&talking, "phi", -quarter, quarter);
        let mut full = rocker([1.0, 3.5, 3.0], drive);
        assert_eq!(range(&full, "phi").reach, Reach::Full(1));
        assert_eq!(full.ask("limits phi"), ["phi goes all the way round"]);
    }
    // It folds flat with the crank away from the other pivot.
    let found = range(&rocker([2.0, 3.0, 3.0], "o: orientation A D, A B = phi"), "o");
    assert_eq!((found.reach, found.change_points.len()), (Reach::Full(2), 2));
}

#[test]
fn a_change_point_on_the_way_is_told() {
    // A kite: where its jack is as long as the base the arms lie on each other and may part.
    let mut talking = four_bar("let w = 3.2; length B C = w");
    assert!(range(&talking, "w").change_points.is_empty());
    talking = Talking::after(
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = polar(1, 50deg), C = D + polar(1, 50deg)
         length A B = 1; length B C = 4; length C D = 1
         reach: hold B.x = cos(50deg)
         solve within 1e-11",
    );
    let found = range(&talking, "reach");
    assert!(!found.change_points.is_empty(), "{found:?}");
    for at in found.change_points {
        assert!((at.abs() - 1.0).abs() < 1e-6, "{at}");
    }
}

#[test]
fn what_only_follows_changes_no_limit_of_a_driver() {
    let reach = 13.0_f64.sqrt();
    for tracer in [
        "",
        "point P = B + 1000 * (C - B); hinge P on B C at 1000",
        "point P = B + 1000 * (C - B), Q = P + 7 * (A - P)
         hinge P on B C at 1000; hinge Q on P A at 7",
        "point F = (1e5, 1e5) frozen; point P = C; coincidence P C",
    ] {
        let talking = four_bar(&format!("let w = 3.2; length B C = w\n{tracer}"));
        check_dead_points(&talking, "w", reach - 3.0, reach + 3.0);
        let talking = four_bar(&format!("bar: length B C = 3.2\n{tracer}"));
        check_dead_points(&talking, "bar", reach - 3.0, reach + 3.0);
    }
}

#[test]
fn what_is_rigid_does_not_change() {
    let mut talking = Talking::after(
        "let w = 2; point A = (0, 0) frozen, B = (2, 0) frozen; length A B = w; solve",
    );
    assert_eq!(range(&talking, "w").reach, Reach::Rigid);
    assert_eq!(talking.ask("limits w"), ["w cannot change: what it drives is rigid"]);
    let mut truss = Talking::after(
        "point A = (0, 0) frozen, B = (2, 0) frozen, C = (1, 1)
         length A C; length B C; length A C
         solve",
    );
    assert_eq!(truss.ask("limits length1"), ["length1 cannot change: what it drives is rigid"]);
    let mut off = four_bar("bar: length B C = 3.2");
    assert_eq!(off.ask("off bar; limits bar"), ["bar is switched off"]);
    let mut open = four_bar("bar: length B C = 3.2; off crank; length A B = 1");
    let told = "it cannot be told how far bar goes: another freedom leaves the motion open";
    assert_eq!(open.ask("limits bar"), [told]);
}
