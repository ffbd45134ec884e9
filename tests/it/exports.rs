//! Files for machines: the sizes of what they hold, against closed forms, and the files themselves.

use std::f64::consts::PI;
use std::path::Path;

use linkwork::{Answer, Session};

use crate::support::compare::{check_golden, golden};
use crate::support::talk::Talking;

/// A four-bar with a plate: rods of 10, 40 and 30, a right triangle of 30 and 40.
const PARTS: &str = include_str!("../parts.link");

/// What a text writes under a name.
fn written(text: &str, name: &str) -> String {
    let answer: Answer = Session::new().run(text).unwrap_or_else(|e| panic!("{e}\nof {text}"));
    let bytes = answer.files.get(Path::new(name)).expect("the file is written");
    String::from_utf8(bytes.clone()).expect("a text")
}

/// One closed contour of lines and arcs: its area and length, an arc by its angle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Contour {
    area: f64,
    length: f64,
}

/// The contours of a path of `M`, `L`, `A` (counter-clockwise as the plane has it) and `Z`.
fn contours(data: &str) -> Vec<Contour> {
    let mut found = Vec::new();
    for chain in data.split('M').filter(|chain| !chain.is_empty()) {
        let chain = chain.strip_suffix('Z').expect("it is closed");
        let mut pen = [0.0; 2];
        let mut start = None;
        let mut now = Contour { area: 0.0, length: 0.0 };
        let mut rest = chain;
        let mut verb = 'M';
        loop {
            let end = rest.find(['L', 'A']).unwrap_or(rest.len());
            let numbers: Vec<f64> =
                rest[..end].split(' ').map(|text| text.parse().expect("a number")).collect();
            let to: [f64; 2] = numbers[numbers.len() - 2..].try_into().expect("two");
            if start.is_some() {
                let chord = f64::hypot(to[0] - pen[0], to[1] - pen[1]);
                // Downwards is positive on a page: counter-clockwise gives a negative sum.
                now.area -= 0.5 * (pen[0] * to[1] - pen[1] * to[0]);
                if verb == 'A' {
                    let radius = numbers[0];
                    assert_eq!(numbers[2..5], [0.0, 0.0, 0.0], "a small arc, counter-clockwise");
                    let angle = 2.0 * (0.5 * chord / radius).min(1.0).asin();
                    now.area += 0.5 * radius * radius * (angle - angle.sin());
                    now.length += radius * angle;
                } else {
                    now.length += chord;
                }
            }
            (start, pen) = (start.or(Some(to)), to);
            let Some(next) = rest[end..].chars().next() else { break };
            (verb, rest) = (next, &rest[end + 1..]);
        }
        let [x, y] = start.expect("it begins");
        now.area -= 0.5 * (pen[0] * y - pen[1] * x);
        now.length += f64::hypot(x - pen[0], y - pen[1]);
        found.push(now);
    }
    found
}

fn paths(svg: &str) -> Vec<(String, Vec<Contour>)> {
    let paths = svg.split("<path d=\"").skip(1);
    paths
        .map(|path| {
            let (data, rest) = path.split_once('"').expect("quotes");
            let name = rest.split_once("<title>").and_then(|(_, name)| name.split_once('<'));
            (name.expect("a title").0.to_owned(), contours(data))
        })
        .collect()
}

/// The chains of straight lines among the paths of a document.
fn chains(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').expect("two numbers");
        [x, y].map(|text| text.parse().expect("a number"))
    };
    let data = svg.split("d=\"M").skip(1).map(|data| data.split_once('"').expect("its end").0);
    data.map(|data| data.split('L').map(point).collect()).collect()
}

fn length(points: &[[f64; 2]]) -> f64 {
    points.windows(2).map(|p| f64::hypot(p[1][0] - p[0][0], p[1][1] - p[0][1])).sum()
}

#[track_caller]
fn assert_near(found: f64, wanted: f64, what: &str) {
    assert!((found - wanted).abs() < 2e-4 * wanted.abs(), "{what}: {found}, not {wanted}");
}

#[test]
fn parts_are_as_large_as_they_should_be() {
    let (scale, width, hole, kerf) = (10.0, 12.0, 4.0, 0.2);
    let text = format!(
        "{PARTS}export \"p.svg\" in mm scale {scale} width {width} hole {hole} kerf {kerf}"
    );
    let all = paths(&written(&text, "p.svg"));
    let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["crank", "coupler", "rocker", "plate"]);
    let radius = 0.5 * (width + kerf);
    let lengths = [10.0, 30.0 * 2.0_f64.sqrt(), 30.0];
    for ((name, contours), length) in all.iter().zip(lengths) {
        assert_eq!(contours.len(), 3, "{name} has two holes");
        assert_near(contours[0].area, 2.0 * radius * length + PI * radius * radius, name);
        assert_near(contours[0].length, 2.0 * length + 2.0 * PI * radius, name);
        for hole_cut in &contours[1..] {
            let radius = 0.5 * (hole - kerf);
            assert_near(hole_cut.area, PI * radius * radius, name);
        }
    }
    let plate = &all[3].1;
    assert_eq!(plate.len(), 4, "a hole at each point");
    // A right triangle of 30, 40 and 50: area, perimeter times the width around, the corners.
    assert_near(plate[0].area, 600.0 + 120.0 * radius + PI * radius * radius, "plate");
    assert_near(plate[0].length, 120.0 + 2.0 * PI * radius, "plate");
}

#[test]
fn parts_lie_apart_on_their_sheet() {
    let rod =
        |k: u32| format!("point a{k} = (0, {k}), b{k} = ({}, {k}); length a{k} b{k}\n", 1 + k % 7);
    let many = (0..30).map(rod).collect::<Vec<String>>().concat();
    let text = format!("{many}export \"p.dxf\" scale 20 width 8 hole 3");
    let dxf = written(&text, "p.dxf");
    let lines: Vec<&str> = dxf.lines().collect();
    let mut boxes: Vec<[f64; 4]> = Vec::new();
    let mut groups = lines.chunks(2).map(|pair| (pair[0], pair[1])).peekable();
    while let Some((code, word)) = groups.next() {
        if (code, word) != ("0", "LINE") {
            continue;
        }
        let mut at = [0.0; 4];
        for slot in [("10", 0), ("20", 1), ("11", 2), ("21", 3)] {
            let (_, text) = groups.by_ref().find(|(code, _)| *code == slot.0).expect("a number");
            at[slot.1] = text.parse().expect("a number");
        }
        boxes.push(at);
    }
    assert_eq!(boxes.len(), 60, "two long sides each");
    let rods: Vec<[f64; 4]> = boxes
        .chunks(2)
        .map(|sides| {
            let all = [sides[0], sides[1]].concat();
            let of = |k: usize| all.iter().skip(k).step_by(2).copied();
            let (lo_x, hi_x) = (of(0).fold(f64::MAX, f64::min), of(0).fold(f64::MIN, f64::max));
            let (lo_y, hi_y) = (of(1).fold(f64::MAX, f64::min), of(1).fold(f64::MIN, f64::max));
            [lo_x - 4.0, lo_y, hi_x + 4.0, hi_y]
        })
        .collect();
    for (k, a) in rods.iter().enumerate() {
        assert!(a[0] >= 3.0 - 1e-6 && a[1] >= 3.0 - 1e-6, "{a:?} is on the sheet");
        for b in &rods[..k] {
            let apart = (a[0] - b[2]).max(b[0] - a[2]).max(a[1] - b[3]).max(b[1] - a[3]);
            assert!(apart >= 3.0 - 1e-6, "{a:?} and {b:?} are {apart} mm apart");
        }
    }
}

#[test]
fn one_pair_is_one_part_and_what_is_hinged_on_it_a_hole() {
    let text = "point A = (0, 0), B = (4, 0), P = (1, 0), F = (0, 3) frozen, G = (3, 3) frozen
        length A B = 4; motor A B; hinge P on A B at 1/4; length F G; spare: length A F
        off spare
        export \"p.svg\" scale 10 width 6 hole 2";
    let all = paths(&written(text, "p.svg"));
    assert_eq!(all.len(), 1, "{all:?}");
    assert_eq!(all[0].1.len(), 4, "an outline and three holes");
}

#[test]
fn a_body_keeps_its_sense() {
    // Its points in this order turn left; a mirrored sheet would turn right.
    let text = "point A = (0, 0), B = (3, 0), C = (0, 1)
        rigid A B C
        export \"p.svg\" scale 10 width 2 hole 1";
    let svg = written(text, "p.svg");
    let data = svg.split("<path d=\"").nth(1).expect("a path");
    let holes: Vec<[f64; 2]> = data
        .split('M')
        .skip(2)
        .map(|hole| {
            let numbers: Vec<f64> = hole
                .split([' ', 'A'])
                .take(2)
                .map(|text| text.parse().expect("a number"))
                .collect();
            [numbers[0], -numbers[1]]
        })
        .collect();
    let [a, b, c] = holes[..] else { panic!("three holes in {svg}") };
    let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert_near(turn, 300.0, "the sense");
}

#[test]
fn strokes_are_in_true_size_a_layer_a_path() {
    let text = "point O = (0, 0) frozen, P = (2, 0), Q = (1, 0)
        motor O P radius 2 speed 1rev; motor O Q radius 1 speed 1rev
        set dt 1/360; trace P, Q; step 361
        export \"p.svg\" in mm scale 10";
    let svg = written(text, "p.svg");
    assert_eq!(svg.matches("inkscape:groupmode=\"layer\"").count(), 3, "{svg}");
    for label in ["1 mechanism", "2 P", "3 Q"] {
        assert!(svg.contains(&format!("inkscape:label=\"{label}\"")), "no layer {label}");
    }
    assert!(!svg.contains("<text") && !svg.contains("fill=\"#"), "strokes only");
    assert_eq!(svg.matches("fill=\"none\"").count(), 3);
    // 40 mm of path, a joint of 1 mm on its right, and 10 mm around.
    let (_, box_of_page) = svg.split_once("viewBox=\"0 0 ").expect("a page");
    let (width, height) =
        box_of_page.split_once('"').expect("its end").0.split_once(' ').expect("two");
    assert_near(width.parse().expect("a number"), 61.0, "the width");
    assert_near(height.parse().expect("a number"), 60.0, "the height");
    assert!(svg.contains(&format!("width=\"{width}mm\" height=\"{height}mm\"")));
    let layers: Vec<&str> = svg.split("<g ").collect();
    for (layer, radius) in [(layers[2], 20.0), (layers[3], 10.0)] {
        let points = chains(layer).remove(0);
        for [x, y] in &points {
            assert!((f64::hypot(x - 30.0, y - 30.0) - radius).abs() < 0.02, "{x} {y}");
        }
        let length = length(&points);
        // A chord may pass the circle by a hundredth of a mm.
        assert!((length / (2.0 * PI * radius) - 1.0).abs() < 1e-3, "{length} once around");
    }
}

/// How often an `export` asks whether it is to stop: what it has to do, as a number.
fn work(scene: &str, export: &str) -> u64 {
    let mut talking = Talking::after(scene);
    talking.talk.n_polls.set(0);
    talking.execute(export).expect("it does not fail");
    talking.talk.n_polls.get()
}

#[test]
fn what_is_twice_as_large_takes_twice_as_long() {
    let chain = |n: u32| {
        format!(
            "point p[0] = (0, 0) frozen
             for i in 1..{n} {{ point p[i] = (i, 0); length p[i - 1] p[i]; point q[i] = (i - 0.5, 0)
             hinge q[i] on p[i - 1] p[i] at 1/2 }}"
        )
    };
    let star = |n: u32| {
        format!(
            "point o = (0, 0) frozen; for i in 1..{n} {{ point p[i] = polar(9, i); length o p[i]
             point q[i] = polar(4.5, i); hinge q[i] on o p[i] at 1/2 }}"
        )
    };
    for scene in [&chain as &dyn Fn(u32) -> String, &star] {
        for export in ["export \"p.dxf\" scale 9 width 2 hole 1", "export \"p.svg\""] {
            let [once, twice] = [4000, 8000].map(|n| work(&scene(n), export));
            assert!(once >= 3 && twice <= 3 * once, "{export}: {once}, {twice} of twice the size");
        }
    }
}

#[test]
fn parts_are_the_same_in_whatever_order_they_were_said() {
    let points = "point A = (0, 0), B = (4, 0), C = (0, 3), P = (1, 0), Q = (0.5, 0)\n";
    let said = [
        "plate: rigid A B C",
        "edge: length A B = 4",
        "other: length P A = 1",
        "hinge P on A B at 1/4",
        "hinge Q on A P at 1/2",
    ];
    let sizes = |order: &[&str]| {
        let text =
            format!("{points}{}\nexport \"p.svg\" scale 10 width 3 hole 1", order.join("\n"));
        let parts = paths(&written(&text, "p.svg"));
        let all: Vec<(String, usize)> =
            parts.into_iter().map(|(name, contours)| (name, contours.len())).collect();
        all
    };
    let backwards: Vec<&str> = said.iter().rev().copied().collect();
    // The plate, with a hole at each corner and at both pins; what lies within it is no other part.
    for order in [&said[..], &backwards] {
        assert_eq!(sizes(order), [("plate".to_owned(), 6)], "{order:?}");
    }
    // Of two that are the same the first gives its name.
    assert_eq!(sizes(&["one: length A B", "two: length B A"]), [("one".to_owned(), 3)]);
}

#[test]
fn what_changes_its_length_is_no_part() {
    let scene = "point A = (0, 0) frozen, B = (1, 0), C = (3, 0), P = (1.5, 0)
        crank: motor A B radius 1 + time / 9 speed 1rev
        jack: length B C = 2 + time / 9
        hinge P on B C at 1/4 + time / 9
        whole: length A C\n";
    let parts = paths(&written(&format!("{scene}export \"p.svg\" width 0.2 hole 0.1"), "p.svg"));
    let found: Vec<_> = parts.iter().map(|(name, contours)| (&**name, contours.len())).collect();
    assert_eq!(found, [("whole", 3)]);
}

#[test]
fn a_pen_passes_each_place_once() {
    // A bar that is a crank, a rail's bar and an edge of a body at once; two points at one place.
    let svg = written(
        "point A = (0, 0) frozen, B = (4, 0), C = (0, 3), P = (1, 0), D = (0, 3)
         length A B = 4; crank: motor A B radius 4 speed 1rev; hinge P on A B at 1/4; length A P
         rigid A B C; length C A; coincidence C D
         export \"p.svg\" scale 10",
        "p.svg",
    );
    let length: f64 = chains(&svg).iter().map(|points| length(points)).sum();
    assert_near(length, 120.0, "a triangle of 30, 40 and 50");
    assert_eq!(svg.matches("<path").count(), 1, "the pen is put down once: {svg}");
    assert_eq!(svg.matches("<circle").count(), 4, "a joint at each place: {svg}");
}

/// With `UPDATE_GOLDEN=1` they are written anew; read the difference before you keep it.
#[test]
fn files_for_machines_are_as_written() {
    let traced = format!("{PARTS}set dt 1/24; trace C; step 24\n");
    for (statement, name) in [
        ("export \"parts.svg\" in mm scale 10 width 12 hole 4 kerf 0.2", "parts.svg"),
        ("export \"parts.dxf\" in mm scale 10 width 12 hole 4 kerf 0.2", "parts.dxf"),
        ("export \"plot.svg\" in mm scale 10", "plot.svg"),
    ] {
        let file = written(&format!("{traced}{statement}"), name);
        check_golden(&golden("exports").join(name), &file);
    }
}
