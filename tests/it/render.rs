//! What a picture has to be, whatever the mechanism.

use linkwork::constraint::Point;
use linkwork::render::{Animation, Options, Scene, View, svg, svg_with_view};
use linkwork::session::{Nowhere, Session};
use linkwork::world::{Edit, Sample, World};

const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3), P = (2, 3.4)
    motor A B radius 1 speed 1rev
    length B C = 3.5; length C D = 3; length B P = 2.6; length C P = 1.8
    set dt 1/90; trace C; trace P
";

const EVERY_KIND: &str = "
    point a1 = (0, 0), a2 = (2, 0.6), b1 = (3, 0.6), b2 = (5, 0.3), c1 = (6, 0), c2 = (8, 0.6)
    length a1 a2; length b1 b2 <= 2.6; length c1 c2 in 1..3
    point e1 = (0, 2), e2 = (2, 2), e3 = (1.6, 3), e4 = (0.6, 2.4)
    rigid e1 e2 e3 e4
    point f1 = (3.4, 2.3) frozen, f2 = (4.4, 2.9)
    motor f1 f2 speed 1
    point g1 = (6, 2) frozen, g2 = (8, 2.8) frozen, g = (7, 2.4)
    glider g on g1 g2
    point h1 = (9, 2.2), h2 = (10.6, 2.8), h = (11.2, 3)
    glider h on h1 h2 unbounded
    point i1 = (0, 4), i2 = (2, 4.6), i = (0.7, 4.2)
    hinge i on i1 i2 at 1/3
    point j1 = (3, 4), j2 = (5, 4.2), j3 = (3.2, 4.8), j4 = (4.9, 5.3)
    equal j1 j2, j3 j4
    point k1 = (6, 4), k2 = (8, 4.2), k3 = (6, 4.7), k4 = (8, 4.9)
    equivalence k1 k2, k3 k4
    point l1 = (9, 4), l2 = (11, 4), l3 = (10.7, 5.2)
    orientation l1 l2, l1 l3 = 35deg
    point m1 = (3, 6), m2 = (5, 6.4), m3 = (3, 6.6), m4 = (5, 7)
    parallel m1 m2, m3 m4
    point o1 = (6.2, 6.3), q1 = (7.8, 6.4), q2 = (7.9, 6.4)
    coordinate o1 at (6.8, 6.6); coincidence q1 q2
    point r1 = (9, 6), r2 = (11, 6.1), r = (10, 7)
    distance r to r1 r2 = 1
    point s1 = (0.8, 8.8) frozen, s2 = (1.2, 8.8), s3 = (2.5, 8.8) frozen, s4 = (2.5, 9.2)
    cog s1 s2, s3 s4 ratio 2
    point u1 = (8.4, 8.9), u2 = (8.4, 9.3), u3 = (7.2, 8.3) frozen, u4 = (10.4, 8.3) frozen
    rack u1 u2 on u3 u4
    point v1 = (10.5, 9), v2 = (11.6, 9.5)
    faint: length v1 v2
    off faint
";

fn session(script: &str) -> Session {
    let mut session = Session::new();
    run(&mut session, script);
    session
}

fn run(session: &mut Session, script: &str) {
    let source = session.add_source("test", script, None);
    if let Err(problem) = session.execute_all(source, &mut Nowhere) {
        panic!("{problem:?}\nin {script}");
    }
}

fn picture_of(world: &World) -> String {
    svg(&Scene::new(world), &Options::default())
}

fn picture(script: &str) -> String {
    picture_of(session(script).world())
}

/// One element as it was written: its name, its attributes.
#[derive(Debug, Clone)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    text: String,
    /// The transform of the group around it.
    around: Option<(Point, f64)>,
}

impl Element {
    fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str())
    }

    fn number(&self, name: &str) -> f64 {
        self.get(name).map_or(0.0, |text| text.parse().expect("a number"))
    }

    /// A place in its own coordinates as a place on the page.
    fn on_page(&self, local: Point) -> Point {
        let (at, turn) = self.around.unwrap_or_default();
        at + local.to_vector().rotate(turn.to_radians())
    }
}

/// Reads a document, and insists that it is well formed.
fn elements(document: &str) -> Vec<Element> {
    let mut open: Vec<usize> = Vec::new();
    let mut found: Vec<Element> = Vec::new();
    let mut rest = document;
    while let Some(start) = rest.find('<') {
        if let Some(&k) = open.last() {
            found[k].text.push_str(rest[..start].trim());
        }
        let end = start + rest[start..].find('>').expect("each tag is closed");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let k = open.pop().expect("an element is open");
            assert_eq!(found[k].name, name);
            continue;
        }
        let (tag, is_single) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
        let (name, mut tail) = tag.split_once(' ').unwrap_or((tag, ""));
        let mut attributes: Vec<(String, String)> = Vec::new();
        while let Some((attribute, after)) = tail.split_once("=\"") {
            let (value, after) = after.split_once('"').expect("a quoted value");
            let attribute = attribute.trim().to_owned();
            assert!(attributes.iter().all(|(other, _)| *other != attribute), "{attribute} twice");
            attributes.push((attribute, value.to_owned()));
            tail = after;
        }
        let mut element =
            Element { name: name.to_owned(), attributes, text: String::new(), around: None };
        element.around = match element.get("transform") {
            Some(transform) => Some(read_transform(transform)),
            None => open.last().and_then(|&k| found[k].around),
        };
        found.push(element);
        if !is_single {
            open.push(found.len() - 1);
        }
    }
    assert!(open.is_empty(), "all elements are closed");
    found
}

fn read_transform(text: &str) -> (Point, f64) {
    let part = |name: &str| -> Vec<f64> {
        let Some((_, rest)) = text.split_once(&format!("{name}(")) else { return Vec::new() };
        rest.split(')').next().map_or(Vec::new(), numbers)
    };
    let (at, turn) = (part("translate"), part("rotate"));
    let at = at.first().map_or(Point::ORIGIN, |&x| Point::new(x, at[1]));
    (at, turn.first().copied().unwrap_or(0.0))
}

fn numbers(text: &str) -> Vec<f64> {
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    text.split(|c| !is_number(c)).filter_map(|word| word.parse().ok()).collect()
}

fn with_class<'a>(elements: &'a [Element], class: &str) -> Vec<&'a Element> {
    elements.iter().filter(|e| e.get("class") == Some(class)).collect()
}

/// Checks what holds of every document.
fn check(document: &str) -> Vec<Element> {
    let elements = elements(document);
    assert_eq!(elements[0].name, "svg");
    for element in &elements {
        assert!(element.name != "script");
        for (name, value) in &element.attributes {
            let is_drawn =
                ["d", "transform", "x", "y", "r", "cx", "cy", "values"].contains(&name.as_str());
            if is_drawn {
                assert!(!value.contains("NaN") && !value.contains("inf"), "{name}={value}");
                for number in value.split([' ', ';', ',', '(', ')', 'L', 'M', 'A', 'Q', 'Z']) {
                    let n_places = number.split_once('.').map_or(0, |(_, places)| places.len());
                    assert!(n_places <= 3, "{name}: {number}");
                    assert!(number != "-0", "{name}={value}");
                }
            }
        }
    }
    elements
}

#[test]
fn documents_are_well_formed_and_numbers_short() {
    for script in ["", FOUR_BAR, EVERY_KIND, "point A = (3, 4)"] {
        check(&picture(script));
    }
}

#[test]
fn the_same_world_gives_the_same_bytes() {
    assert_eq!(picture(EVERY_KIND), picture(EVERY_KIND));
}

#[test]
fn frozen_points_stand_on_triangles() {
    let n_triangles = |script: &str| with_class(&check(&picture(script)), "ground").len();
    assert_eq!(n_triangles("point A = (0, 0), B = (1, 0)"), 0);
    assert_eq!(n_triangles("point A = (0, 0) frozen, B = (1, 0)"), 1);
    assert_eq!(n_triangles(FOUR_BAR), 2);
}

#[test]
fn only_bars_are_bars() {
    let n_rods = |script: &str| with_class(&check(&picture(script)), "rod").len();
    let points = "point A = (0, 0), B = (1, 0), C = (0, 1), D = (1, 1)\n";
    let with = |statement: &str| n_rods(&format!("{points}{statement}"));
    assert_eq!(with("length A B"), 1);
    assert_eq!(with("rigid A B"), 1);
    assert_eq!(with("equal A B, C D"), 0);
    assert_eq!(with("parallel A B, C D"), 0);
    assert_eq!(with("length A B <= 3"), 0);
}

#[test]
fn motors_turn_the_way_they_turn() {
    let arrow = |speed: &str| {
        let script = format!("point A = (0, 0) frozen, B = (1, 0); motor A B speed {speed}");
        let document = check(&picture(&script));
        let head = with_class(&document, "turn-head").first().map(|e| e.get("d").map(numbers));
        head.flatten().map(|numbers| numbers[0])
    };
    // Over the top to the left, or to the right.
    assert!(arrow("1").is_some_and(|x| x < 0.0));
    assert!(arrow("-1").is_some_and(|x| x > 0.0));
    assert_eq!(arrow("0"), None);
}

#[test]
fn motors_on_one_centre_have_an_arrow_each() {
    let elements = check(&picture(
        "point O = (0, 0) frozen, P = (2, 0), Q = (0, 1.5), R = (-1.5, -1)
         motor O P speed 1; motor O Q speed -1; motor O R speed 2",
    ));
    assert_eq!(with_class(&elements, "motor").len(), 1);
    assert_eq!(with_class(&elements, "turn-head").len(), 3);
}

#[test]
fn what_is_off_is_faint() {
    let document = check(&picture(EVERY_KIND));
    assert_eq!(document.iter().filter(|e| e.get("opacity") == Some("0.3")).count(), 1);
}

/// The box of a name on the page: its middle and half its size.
fn name_box(element: &Element) -> (Point, f64, f64) {
    let base = element.on_page(Point::new(element.number("x"), element.number("y")));
    let half_width = 0.5 * 0.5 * 14.0 * element.text.chars().count() as f64;
    (Point::new(base.x, base.y - 4.8), half_width, 5.0)
}

/// Whether a line touches a box.
fn touches(a: Point, b: Point, (middle, half_x, half_y): (Point, f64, f64)) -> bool {
    (0..=400).any(|k| {
        let p = a + (b - a) * (f64::from(k) / 400.0);
        (p.x - middle.x).abs() < half_x && (p.y - middle.y).abs() < half_y
    })
}

#[test]
fn names_lie_on_no_bar_and_on_no_other_name() {
    let jansen = "
        point O = (0, 7.8) frozen, B = (-38, 0) frozen, Z = (15, 7.8)
        motor O Z speed -1rev
        point C = (-30, 41), E = (-75, 20), D = (-28, -38), G = (-65, -35), F = (-45, -80)
        length Z C = 50; length Z D = 61.9; length B C = 41.5; length B D = 39.3
        length B E = 40.1; length C E = 55.8; length E G = 39.4; length D G = 36.7
        length G F = 49; length D F = 65.7
        set dt 1/60; trace F; step 23";
    let star = "
        point O = (0, 0) frozen
        for i in 0..11 { point P[i] = polar(5, i * 30deg); length O P[i] }";
    for script in [FOUR_BAR, jansen, star] {
        let document = check(&picture(script));
        let names = with_class(&document, "name");
        assert!(names.len() >= 5, "{} names", names.len());
        let boxes: Vec<_> = names.iter().map(|name| name_box(name)).collect();
        for class in ["rod", "crank", "link"] {
            for bar in with_class(&document, class) {
                let [x1, y1, x2, y2] = numbers(bar.get("d").expect("a path"))[..] else {
                    panic!("a bar is one line");
                };
                let (a, b) = (bar.on_page(Point::new(x1, y1)), bar.on_page(Point::new(x2, y2)));
                for (name, name_box) in names.iter().zip(&boxes) {
                    assert!(!touches(a, b, *name_box), "{} lies on a {class}", name.text);
                }
            }
        }
        for (k, a) in boxes.iter().enumerate() {
            for (other, b) in boxes[..k].iter().enumerate() {
                let is_apart =
                    (a.0.x - b.0.x).abs() >= a.1 + b.1 || (a.0.y - b.0.y).abs() >= a.2 + b.2;
                assert!(is_apart, "{} and {}", names[k].text, names[other].text);
            }
        }
    }
}

#[test]
fn a_crowd_goes_without_names() {
    let net = "for i in 0..20 { for j in 0..20 { point p[21 * i + j] = (i, j) } }";
    assert!(with_class(&check(&picture(net)), "name").is_empty());
}

#[test]
fn everything_is_on_the_page() {
    for script in [FOUR_BAR, EVERY_KIND] {
        let document = check(&picture(script));
        let page = numbers(document[0].get("viewBox").expect("a view box"));
        let (width, height) = (page[2], page[3]);
        for element in document.iter().filter(|e| ["path", "circle", "text"].contains(&&*e.name)) {
            let points: Vec<Point> = match element.name.as_str() {
                "circle" => vec![Point::new(element.number("cx"), element.number("cy"))],
                "text" => vec![Point::new(element.number("x"), element.number("y"))],
                _ => {
                    let d = element.get("d").expect("a path");
                    let numbers = numbers(d);
                    // Arcs carry more than places.
                    if d.contains(['A', 'Q']) {
                        continue;
                    }
                    numbers.chunks(2).map(|pair| Point::new(pair[0], pair[1])).collect()
                }
            };
            for p in points.into_iter().map(|p| element.on_page(p)) {
                let is_on = (0.0..=width).contains(&p.x) && (0.0..=height).contains(&p.y);
                assert!(is_on, "{:?} at {p:?}", element.get("class"));
            }
        }
    }
}

#[test]
fn up_is_up() {
    let document = check(&picture("point low = (0, 0) frozen, high = (0, 1) frozen"));
    let names = with_class(&document, "name");
    let y_of = |name: &str| {
        let element = names.iter().find(|e| e.text == name).expect("a name");
        element.on_page(Point::ORIGIN).y
    };
    assert!(y_of("high") < y_of("low"));
}

#[test]
fn small_and_large_mechanisms_look_alike() {
    let drawing = |unit: &str| {
        let script = format!(
            "let k = {unit}
             point A = k * (0, 0) frozen, D = k * (4, 0) frozen, B = k * (1, 0), C = k * (3, 3)
             motor A B speed 1; length B C; length C D
             point E = k * (5, 0) frozen, F = k * (5.5, 0), G = k * (6.5, 0) frozen, H = k * (6.5, 1)
             cog E F, G H ratio 2"
        );
        let text = picture(&script);
        // All but the words of the scale: its length is another one.
        let is_caption = |line: &&str| !line.contains("caption");
        text.lines().filter(is_caption).map(str::to_owned).collect::<Vec<_>>()
    };
    let ordinary = drawing("1");
    for unit in ["1e-3", "1e6", "1e-9", "1e12"] {
        // Powers of ten, so that the line of the scale is as long.
        assert_eq!(drawing(unit), ordinary, "{unit}");
    }
}

#[test]
fn degenerate_mechanisms_have_pictures() {
    for script in [
        "point A = (0, 0), B = (0, 0); length A B = 1",
        "point A = (5, 5) frozen",
        "point A = (0, 0) frozen, B = (0, 0); motor A B radius 0 speed 1",
        "point A = (0, 0), B = (0, 0), C = (0, 0); glider A on B C",
        "point A = (1e60, 0), B = (-1e60, 1e60), C = (0, 0); length A B; length B C",
        "point A = (1e-300, 0), B = (0, 1e-300); length A B",
        "point A = (1e9, 1e9), B = (1000000001, 1e9); length A B",
        "point A = (0, 0), B = (1, 0), C = (2, 0); rigid A B C",
        "point A = (0, 0), B = (0, 1), C = (0.01, 0), D = (0.01, 1); cog A B, C D ratio 300",
        "point A = (0, 0), B = (0, 1), C = (0.01, 0), D = (0.01, 1); cog A B, C D ratio -0.999",
        "point A = (0, 0), B = (1, 0), C = (0, 0); distance C to A B = 1",
        "point A = (0, 0), B = (1, 0), C = (1, 0); orientation A B, B C = 1",
    ] {
        check(&picture(script));
    }
}

#[test]
fn paths_have_colours_and_a_legend() {
    let mut session = session(FOUR_BAR);
    run(&mut session, "step 90");
    let document = check(&picture_of(session.world()));
    for class in ["trace-0", "trace-1"] {
        assert_eq!(with_class(&document, class).len(), 2, "{class}: the path and its legend");
    }
    let captions: Vec<&str> =
        with_class(&document, "caption").iter().map(|e| e.text.as_str()).collect();
    assert_eq!(captions, ["0.5", "C", "P"]);
}

#[test]
fn missed_stretches_are_drawn_otherwise() {
    let mut world = session("point A = (0, 0); trace A").world().clone();
    let mut trace = world.traces()[0].clone();
    for (x, missed) in [(0.0, false), (1.0, false), (2.0, true), (3.0, false)] {
        trace.samples.push(Sample { at: Point::new(x, 0.0), missed });
    }
    world.apply(Edit::Trace(0, None));
    world.apply(Edit::Trace(0, Some(Box::new(trace))));
    let document = check(&picture_of(&world));
    assert_eq!(with_class(&document, "trace-0").len(), 1);
    assert_eq!(with_class(&document, "missed-0").len(), 1);
}

#[test]
fn ghosts_are_the_fainter_the_older() {
    let mut session = session(FOUR_BAR);
    run(&mut session, "expose every 10; step 30");
    let document = check(&picture_of(session.world()));
    let opacities: Vec<f64> = document
        .iter()
        .filter(|e| e.name == "g")
        .filter_map(|e| e.get("opacity")?.parse().ok())
        .collect();
    assert_eq!(opacities.len(), 3);
    assert!(opacities.is_sorted_by(|a, b| a < b) && opacities[2] < 0.6, "{opacities:?}");
    let n_names = with_class(&document, "name").len();
    assert_eq!(n_names, 5, "ghosts have no names");
}

#[test]
fn titles_and_receipts_are_kept_whatever_they_say() {
    let options = Options {
        title: Some("a < b & \"c\" \u{1}".to_owned()),
        receipt: vec![("command".to_owned(), "run <x> --y='z'".to_owned())],
        ..Options::default()
    };
    let text = svg(&Scene::new(session(FOUR_BAR).world()), &options);
    let document = check(&text);
    assert_eq!(document[1].name, "title");
    assert!(text.contains("<title>a &lt; b &amp; \"c\" \u{fffd}</title>"), "{}", &text[..400]);
    assert!(text.contains("command: run &lt;x&gt; --y='z'"));
}

/// The scenes of some frames, made the way a recorder does.
fn motion(session: &mut Session, n_frames: u32) -> Vec<(Scene, f64)> {
    let mut frames: Vec<(Scene, f64)> = Vec::new();
    for _ in 0..n_frames {
        run(session, "step");
        let world = session.world();
        let scene = match frames.last() {
            Some((last, _)) => last.next(world),
            None => Scene::new(world),
        };
        frames.push((scene, world.clock().time()));
    }
    frames
}

fn animation(frames: &[(Scene, f64)]) -> String {
    let view = View::of(frames.iter().map(|(scene, _)| scene));
    let mut animation = Animation::new(view, &Options::default());
    for (scene, time) in frames {
        animation.push(scene, *time);
    }
    animation.finish()
}

#[test]
fn frames_share_their_view_and_their_past() {
    let mut session = session(FOUR_BAR);
    run(&mut session, "expose every 7");
    let frames = motion(&mut session, 20);
    let view = View::of(frames.iter().map(|(scene, _)| scene));
    let draw = |scene: &Scene| svg_with_view(scene, &view, &Options::default());
    let pages: Vec<String> = frames.iter().map(|(scene, _)| draw(scene)).collect();
    let fixed = |page: &str| {
        let document = check(page);
        let ground = with_class(&document, "ground").into_iter().map(|e| e.around);
        (document[0].get("viewBox").map(str::to_owned), ground.collect::<Vec<_>>())
    };
    assert!(pages.iter().all(|page| fixed(page) == fixed(&pages[0])));
    // What was made step by step is what the world shows.
    assert_eq!(pages[19], draw(&Scene::new(session.world())));
}

#[test]
fn animations_play_without_a_script() {
    let frames = motion(&mut session(FOUR_BAR), 90);
    let text = animation(&frames);
    assert_eq!(text, animation(&frames));
    assert!(text.len() < 60_000, "{} bytes", text.len());
    let document = check(&text);
    let tracks: Vec<&Element> = document.iter().filter(|e| e.name.starts_with("animate")).collect();
    assert!(tracks.len() > 8);
    for track in tracks {
        assert_eq!(track.get("repeatCount"), Some("indefinite"));
        let n_values = track.get("values").expect("values").split(';').count();
        assert!(n_values > 1);
        if let Some(times) = track.get("keyTimes") {
            let times: Vec<f64> = times.split(';').filter_map(|t| t.parse().ok()).collect();
            assert_eq!(times.len(), n_values);
            assert_eq!((times[0], times[times.len() - 1]), (0.0, 1.0));
            assert!(times.is_sorted());
        }
    }
}

#[test]
fn what_comes_and_goes_is_seen_while_it_is_there() {
    let mut session = session("point A = (0, 0) frozen, B = (1, 0); motor A B speed 1rev");
    let mut frames = motion(&mut session, 5);
    run(&mut session, "point C = (2, 2); length B C <= 9");
    frames.extend(motion(&mut session, 5));
    run(&mut session, "delete C cascade");
    frames.extend(motion(&mut session, 5));
    let document = check(&animation(&frames));
    let shows: Vec<&Element> =
        document.iter().filter(|e| e.get("attributeName") == Some("visibility")).collect();
    assert_eq!(shows.len(), 2, "the cord and its point");
    for show in shows {
        assert_eq!(show.get("values"), Some("hidden;visible;hidden"));
    }
}

#[test]
fn empty_recordings_and_single_frames_are_pictures() {
    check(&animation(&[]));
    let frames = motion(&mut session(FOUR_BAR), 1);
    assert!(!animation(&frames).contains("<animate"));
}

#[test]
fn ten_laps_are_drawn_as_one_that_closes() {
    let drawn = |n: u32| {
        let mut session = session(FOUR_BAR);
        run(&mut session, &format!("step {n}"));
        let elements = check(&picture_of(session.world()));
        let paths = ["trace-0", "trace-1"].map(|class| {
            let of_class = with_class(&elements, class).into_iter();
            of_class.filter_map(|e| e.get("d").map(str::to_owned)).collect::<Vec<_>>()
        });
        paths.concat()
    };
    let (lap, ten) = (drawn(91), drawn(901));
    assert_eq!((lap.len(), ten.len()), (4, 4), "each path and its legend");
    let is_closed = |path: &&String| path.ends_with('Z');
    assert_eq!(lap.iter().filter(is_closed).count(), 2);
    for (one, all) in lap.iter().zip(&ten) {
        // What the laps begin with, and so where lines are thinned, may differ by rounding.
        assert!(all.len() <= one.len() + 20, "{} and {}", one.len(), all.len());
    }
    assert_eq!(drawn(45).iter().filter(is_closed).count(), 0);
}
