//! Tables of chosen columns, charts of measures, and paths with names.

use std::collections::BTreeMap;
use std::path::Path;

use linkwork::Session;
use linkwork::session::Answer;

use crate::support::compare::check_same;
use crate::support::talk::Talking;

const CRANK: &str = "
    point A = (0, 0) frozen, B = (1, 0), D = (4, 0) frozen, C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    length C D = 3
    set dt 1/360
    solve
";

/// All that a script writes.
fn written(script: &str) -> BTreeMap<String, String> {
    let mut session = Session::new();
    let mut answer = Answer::default();
    let source = session.add_source("test", script, None);
    let outcome = session.run_script(source, &mut answer);
    assert_eq!(outcome.failure, None, "{script}");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("a text");
    let files = answer.files.into_iter();
    files.map(|(path, bytes)| (path.display().to_string(), text(bytes))).collect()
}

fn rows(table: &str) -> Vec<Vec<f64>> {
    let cell = |cell: &str| cell.parse().unwrap_or(f64::NAN);
    table.lines().skip(1).map(|line| line.split(',').map(cell).collect()).collect()
}

#[test]
fn a_table_has_the_columns_it_is_of_and_a_row_of_now() {
    let files = written(&format!(
        "{CRANK}
         record \"t.csv\" of time, angle(A, B) in deg, C, omega(A, B) in rpm, B - A every 10
         step 360"
    ));
    let table = &files["t.csv"];
    let heading = table.lines().next().expect("a heading");
    assert_eq!(
        heading,
        "time,\"angle(A, B) in deg\",C.x,C.y,\"omega(A, B) in rpm\",(B - A).x,(B - A).y"
    );
    let rows = rows(table);
    assert_eq!(rows.len(), 37);
    for (k, row) in rows.iter().enumerate() {
        let t = 10.0 * k as f64 / 360.0;
        assert!((row[0] - t).abs() < 1e-15);
        let turned = (row[1] - 360.0 * t).rem_euclid(360.0);
        assert!(turned.min(360.0 - turned) < 1e-9, "{row:?}");
        assert!(((row[2] - 4.0).hypot(row[3]) - 3.0).abs() < 1e-11, "{row:?}");
        assert!((row[4] - 60.0).abs() < 1e-9, "{row:?}");
        assert!((row[5] - (360.0 * t).to_radians().cos()).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn a_cell_of_what_is_gone_is_empty_and_an_undo_makes_a_table_shorter() {
    let mut session = Session::new();
    let mut answer = Answer::default();
    let script = format!(
        "{CRANK}
         point F = (7, 8)
         record \"t.csv\" of time, F, turn(A, B) in rev
         step 2
         delete F
         step 3
         undo
         step 1
         record stop"
    );
    let source = session.add_source("test", &script, None);
    session.execute_all(source, &mut answer).expect("no mistake");
    let table = String::from_utf8(answer.files.into_values().next().expect("a file")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 5, "{table}");
    assert!(lines[3].contains(",7,8,") && lines[4].contains(",,,"), "{table}");
}

#[test]
fn a_table_is_replaced_by_one_with_the_same_columns_only() {
    use crate::support::program::{folder, run, text};
    let script = |of: &str| format!("point A = (0, 0) frozen\nrecord \"t.csv\" of {of}\nstep 2\n");
    let folder = folder(&[("foreign.csv", "a,b\n1,2\n")]);
    let status = |script: &str| {
        let out = run(folder.path(), &["run", "-"], script);
        (out.status.code(), text(&out.stderr))
    };
    assert_eq!(status(&script("time, A")).0, Some(0));
    assert_eq!(status(&script("time, A")).0, Some(0));
    let is_refused = |script: &str| {
        let (code, said) = status(script);
        assert!(code != Some(0) && said.contains("did not write it"), "{said}");
    };
    is_refused(&script("time, A").replace("t.csv", "foreign.csv"));
    for of in ["time, A.x", "A, time", "time, A, A.x", "time", "time in ms, A"] {
        is_refused(&script(of));
    }
    assert_eq!(status(&script("time, A")).0, Some(0));
}

#[test]
fn measures_are_drawn_against_each_other_with_units_on_the_axes() {
    let files = written(&format!(
        "{CRANK}
         measure phi = turn(A, B) in deg
         measure mu = angle(C, B, C, D) in deg
         measure lift = C.y
         measure fall = 5 - C.y
         step 360
         plot \"mu.svg\" mu against phi
         plot \"lift.svg\" lift, fall against time log title \"Lift & fall\"
         plot \"path.svg\" lift, mu against phi x \"crank\" y \"both\"
         plot \"mixed.svg\" lift, mu against phi
         plot \"alike.svg\" mu, phi against time"
    ));
    let mu = &files["mu.svg"];
    assert!(mu.contains(">phi (deg)</text>") && mu.contains(">mu (deg)</text>"), "{mu}");
    let lift = &files["lift.svg"];
    assert!(lift.contains(">time (s)</text>") && lift.contains(">lift, fall</text>"));
    assert!(lift.contains("Lift &amp; fall"));
    let path = &files["path.svg"];
    assert!(path.contains(">crank</text>") && path.contains(">both</text>"));
    // A unit stands with what has it, and with nothing else.
    let mixed = &files["mixed.svg"];
    assert!(mixed.contains(">lift, mu</text>") && mixed.contains(">mu (deg)</text>"), "{mixed}");
    assert!(mixed.contains(">lift</text>"), "{mixed}");
    let alike = &files["alike.svg"];
    assert!(alike.contains(">mu, phi (deg)</text>") && alike.contains(">phi</text>"), "{alike}");
    // A line each, through all of its places.
    let long = mu.lines().filter(|line| line.matches('L').count() >= 360);
    assert_eq!(long.count(), 1);
}

#[test]
fn a_measure_that_began_later_is_drawn_from_there() {
    let files = written(&format!(
        "{CRANK}
         measure x = C.x
         step 10
         measure y = C.y
         step 20
         plot \"p.svg\" y against x
         plot \"q.svg\" x against y"
    ));
    for name in ["p.svg", "q.svg"] {
        let n = files[name].lines().map(|line| line.matches('L').count()).max();
        assert_eq!(n, Some(20), "{name}");
    }
}

#[test]
fn paths_of_one_point_are_told_apart_by_their_names() {
    let mut talking = Talking::after(CRANK);
    talking.run("trace C as \"before\"; step 360; trace C as \"after\"; reset");
    talking.run("change coupler = 3.6; solve; step 100");
    let traces = talking.world().traces();
    let found: Vec<_> =
        traces.iter().map(|it| (it.label.as_deref(), it.is_ended, it.samples.len())).collect();
    assert_eq!(found, [(Some("before"), true, 360), (Some("after"), false, 100)]);
    assert_eq!(
        talking.ask("list traces"),
        ["trace C as \"before\"  # 360 places, ended", "trace C as \"after\"  # 100 places"]
    );
    talking.assert_goes_on_from_its_file("step 20");
    talking.run("svg \"p.svg\"");
    let picture = talking.talk.files.values().next().expect("a picture").clone();
    assert!(picture.contains(">before</text>") && picture.contains(">after</text>"));
    let whole = talking.script();
    talking.run("untrace \"before\"");
    assert_eq!(talking.world().traces().len(), 1);
    talking.run("undo");
    check_same(&talking.script(), &whole, "undone");
    // The one that grows is ended by none.
    talking.run("untrace \"after\"; trace C; step");
    assert_eq!(talking.world().traces().len(), 2);
    talking.assert_goes_on_from_its_file("step 20");
    talking.run("untrace C");
    assert!(talking.world().traces().is_empty());
}

#[test]
fn curvature_and_instant_centre_are_those_of_the_closed_forms() {
    // An ellipsograph: a bar of length 3 slides on both axes, P divides it 1 to 2.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, X = (1, 0) frozen, Y = (0, 1) frozen
         point U = (3 * cos(0.3), 0), V = (0, 3 * sin(0.3)), P = U + (V - U) / 3
         length U V = 3
         glider U on O X unbounded
         glider V on O Y unbounded
         hinge P on U V at 1/3
         orientation O X, V U = -0.3 - time
         set dt 1/100
         solve
         measure k = curvature(P)
         step 110",
    );
    let phi = 0.3 + 1.1;
    // P runs on x = 2 cos, y = sin: the curvature is ab / (a^2 sin^2 + b^2 cos^2)^(3/2).
    let (s, c) = f64::sin_cos(phi);
    let wanted = 2.0 / (4.0 * s * s + c * c).powf(1.5);
    let found = talking.session.evaluate("curvature(P)").expect("it moves").number();
    assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    // The greatest curvature is that of the ends of the long axis; this run leaves one and comes to
    // the end of the short one.
    let least = talking.session.evaluate("k.min").expect("it moved").number();
    assert!((least - wanted).abs() < 1e-9, "{least} {wanted}");
    // The pole is where the perpendiculars in both sliders meet.
    let pole = talking.session.evaluate("ic(U, V, O, X)").expect("it turns").vector();
    assert!((pole.x - 3.0 * c).abs() < 1e-9 && (pole.y - 3.0 * s).abs() < 1e-9, "{pole:?}");
}

#[test]
fn the_transmission_angle_is_measured_as_documented() {
    let mut talking = Talking::after(CRANK);
    talking.run("measure mu = asin(abs(sin(angle(C, B, C, D)))) in deg; step 360");
    // It is least where the crank is in line with the frame, by the law of cosines.
    let at = |apart: f64| ((3.5_f64.powi(2) + 9.0 - apart * apart) / (2.0 * 3.5 * 3.0)).acos();
    let folded = |mu: f64| mu.min(std::f64::consts::PI - mu).to_degrees();
    let wanted = folded(at(3.0)).min(folded(at(5.0)));
    let found = talking.session.evaluate("mu.min").expect("it is measured").number();
    assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
}

/// The words of a chart, each with what it covers: the letters as wide as they are on average, and
/// as high as capitals.
fn words(chart: &str) -> Vec<(String, [f64; 4])> {
    let document = roxmltree::Document::parse(chart).expect("it is well formed");
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    let words = texts.filter_map(|node| {
        let texts = node.descendants().filter(roxmltree::Node::is_text);
        let text: String = texts.filter_map(|it| it.text()).collect();
        let number = |name: &str| node.attribute(name)?.parse::<f64>().ok();
        // What is turned is the name of an axis, by itself at the edge.
        let (x, y, size) = (number("x")?, number("y")?, number("font-size")?);
        let width = 0.5 * size * text.chars().count() as f64;
        let left = match node.attribute("text-anchor") {
            Some("middle") => x - 0.5 * width,
            Some("end") => x - width,
            _ => x,
        };
        Some((text, [left, y - 0.7 * size, left + width, y]))
    });
    words.collect()
}

#[test]
fn no_words_of_a_chart_lie_on_each_other() {
    // Curves that end close together, or in one place, with short and long names.
    for (n, spread) in [(2, 0.0), (5, 0.0), (7, 0.01), (7, 0.3), (9, 0.05)] {
        let names = (0..n).map(|k| format!("m{}{k}", "long".repeat(k % 3)));
        let names: Vec<String> = names.collect();
        let measures = names.iter().enumerate().map(|(k, name)| {
            let (shift, tilt) = (spread * k as f64, 0.2 * k as f64);
            format!("measure {name} = B.x + {shift} + {tilt} * (time - 1)\n")
        });
        let script = format!(
            "point A = (0, 0) frozen, B = (1, 0)
             motor A B radius 1 speed 1rev; set dt 1/24
             {}step 24; plot \"c.svg\" {} against time",
            measures.collect::<Vec<_>>().concat(),
            names.join(", ")
        );
        let answer = Session::new().run(&script).unwrap_or_else(|e| panic!("{e}\n{script}"));
        let chart = answer.files.get(Path::new("c.svg")).expect("a chart");
        let words = words(std::str::from_utf8(chart).expect("a text"));
        // Numbers on two axes, the name of one, and each curve in the legend and at its end.
        assert!(words.len() > 2 * n + 6, "{words:?}");
        for (k, (word, a)) in words.iter().enumerate() {
            for (other, b) in &words[k + 1..] {
                let is_apart = a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];
                assert!(is_apart, "`{word}` lies on `{other}` of {n} curves {spread} apart");
            }
        }
    }
}
