//! Whatever takes long is left when the user wants that, and leaves the world whole.
//!
//! Time is counted in how often a statement asks whether the user wants to stop, never by a clock:
//! a statement that takes twice as long has to ask twice as often, and once the answer is yes it
//! asks no more than a few times until it has ended.

use std::cell::Cell;
use std::io;
use std::path::Path;

use crate::support::compare::check_same;
use crate::support::talk::Talking;
use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Flow, Host, Kept, Quota, Session, Transcript};

/// How often a statement may go on asking after it was told to stop.
const MOST_AFTER: u64 = 8;

/// A statement that takes long, and what comes before it, by size.
struct Case {
    what: &'static str,
    size: usize,
    before: fn(usize) -> String,
    statement: fn(usize) -> String,
}

fn nothing(_: usize) -> String {
    String::new()
}

fn rods(n: usize) -> String {
    format!(
        "point p[0] = (0, 0) frozen
         for i in 1..{n} {{ point p[i] = (i, mod(i, 2)); length p[i - 1] p[i] }}"
    )
}

/// A net of `n` by `n` points that hangs from two of them, off by a little.
fn net(n: usize) -> String {
    format!(
        "for i in 1..{n} {{ for k in 1..{n} {{ point p[i][k] = (i + 0.01 * sin(k), k) }} }}
         for i in 2..{n} {{ for k in 1..{n} {{ length p[i - 1][k] p[i][k] = 1 }} }}
         for i in 1..{n} {{ for k in 2..{n} {{ length p[i][k - 1] p[i][k] = 1 }} }}
         freeze p[1][1] p[{n}][1]"
    )
}

const CASES: [Case; 16] = [
    Case {
        what: "a loop without statements",
        size: 1000,
        before: nothing,
        statement: |n| format!("for i in 1..{n} {{}}"),
    },
    Case {
        what: "reading a long block",
        size: 8000,
        before: nothing,
        statement: |n| format!("for i in 1..0 {{ {} }}", "let q = 1\n".repeat(n)),
    },
    Case { what: "making islands", size: 8000, before: rods, statement: |_| "solve".to_owned() },
    Case { what: "solving a net", size: 16, before: net, statement: |_| "solve".to_owned() },
    Case { what: "what a net can do", size: 12, before: net, statement: |_| "check".to_owned() },
    Case {
        what: "how far a driver goes",
        size: 150,
        before: |n| format!("{}; crank: motor p[0] p[1] speed 1rev; freeze p[{n}]", rods(n)),
        statement: |_| "limits crank".to_owned(),
    },
    Case { what: "a picture", size: 1500, before: rods, statement: |_| "svg \"a.svg\"".to_owned() },
    Case {
        what: "a chart",
        size: 20_000,
        before: |n| format!("for i in 1..{n} {{ sample \"s\" = sin(i) }}"),
        statement: |_| "plot \"s.svg\"".to_owned(),
    },
    Case { what: "a file", size: 1500, before: rods, statement: |_| "save \"a.link\"".to_owned() },
    Case {
        what: "a search for the best numbers",
        size: 200,
        before: |_| {
            "let r = 1.5; point A = (0, 0) frozen, B = (1.5, 0)
             motor A B radius r speed 1rev; measure d = B.x"
                .to_owned()
        },
        statement: |n| format!("fit r in 1..2 to minimise d.span over {n}"),
    },
    Case {
        what: "strokes",
        size: 3000,
        before: rods,
        statement: |_| "export \"a.svg\"".to_owned(),
    },
    Case {
        what: "parts",
        size: 1500,
        before: rods,
        statement: |_| "export \"a.dxf\" scale 9 width 2 hole 1".to_owned(),
    },
    Case {
        what: "a path",
        size: 40_000,
        before: |n| {
            format!(
                "point A = (0, 0) frozen, B = (1, 0); motor A B speed sqrt(2)
                 trace B; step {n}"
            )
        },
        statement: |_| "svg \"a.svg\"".to_owned(),
    },
    Case {
        what: "what is off",
        size: 1500,
        before: |n| {
            format!("{}; freeze all; for i in 1..{n} {{ move p[i] to (2 * i, 0) }}", rods(n))
        },
        statement: |_| "svg \"a.svg\"".to_owned(),
    },
    Case {
        what: "freezing all",
        size: 30_000,
        before: |n| format!("for i in 1..{n} {{ point p[i] = (i, 0) }}"),
        statement: |_| "freeze all".to_owned(),
    },
    Case { what: "a list", size: 2000, before: rods, statement: |_| "list".to_owned() },
];

/// Carries out a statement that may ask `most` times before the user wants to stop; gives how it
/// ended and how often it asked.
fn asked(talking: &mut Talking, statement: &str, most: Option<u64>) -> (Flow, u64) {
    talking.talk.n_polls.set(0);
    talking.talk.most_polls = most;
    let flow = talking.execute(statement).expect("it does not fail");
    (flow, talking.talk.n_polls.get())
}

#[test]
fn what_takes_twice_as_long_asks_twice_as_often() {
    for Case { what, size, before, statement } in CASES {
        let [once, twice] = [size, 2 * size].map(|n| {
            let mut talking = Talking::after(&before(n));
            asked(&mut talking, &statement(n), None).1
        });
        assert!(once >= 2, "{what}: asked {once} times");
        assert!(2 * twice >= 3 * once, "{what}: asked {once} times, and {twice} of twice the size");
    }
}

#[test]
fn what_is_stopped_ends_soon_and_is_done_whole_or_not_at_all() {
    for Case { what, size, before, statement } in CASES {
        let (before, statement) = (before(size), statement(size));
        let mut whole = Talking::after(&before);
        let n = asked(&mut whole, &statement, None).1;
        for most in [0, n / 2, n - 2] {
            let mut talking = Talking::after(&before);
            let script = talking.script();
            let (flow, n_asked) = asked(&mut talking, &statement, Some(most));
            assert_eq!(flow, Flow::Stopped, "{what}");
            assert!(
                n_asked <= most + MOST_AFTER,
                "{what}: asked {n_asked} times, told after {most}"
            );
            let is_done = talking.script() == whole.script()
                && talking.talk.files.len() == whole.talk.files.len();
            if !is_done {
                check_same(&talking.script(), &script, what);
                assert!(talking.talk.files.is_empty(), "{what}");
            }
            assert_eq!(asked(&mut talking, &statement, None).0, Flow::On, "{what}");
            check_same(&talking.script(), &whole.script(), &format!("{what}, then not stopped"));
        }
    }
}

/// A statement on a clock that goes on by a second whenever it is looked at.
fn timed(talking: &mut Talking, statement: &str, most: u64) -> (Result<Flow, Diagnostic>, u64) {
    talking.talk.tick = 1.0;
    talking.session.limit(Quota::Seconds, most);
    let before = talking.talk.n_looks.get();
    let result = talking.execute(statement);
    (result, talking.talk.n_looks.get() - before)
}

#[test]
fn a_command_whose_time_is_up_is_left_and_taken_back() {
    const CRANK: &str = "point p[0] = (0, 0) frozen, p[1] = (1, 0); motor p[0] p[1] speed 1rev";
    const OTHERS: [(&str, &str, &str); 7] = [
        ("a loop", "", "for i in 1..1000 { let q = i }"),
        ("frames", "expose every 100", "step 1000"),
        ("frames at once", "", "step 100000"),
        ("a hand", "", "drag p[1] through (1, 1), (0, 1), (1, 1), (0, 1) over 0"),
        ("sweeps", "", "relax 10000"),
        (
            "a way back",
            "let a = 1; let a = 2; let a = 3; let a = 4; let a = 5; let a = 6",
            "undo 6",
        ),
        ("a study", "step 20", "accuracy"),
    ];
    let others =
        OTHERS.map(|(what, before, it)| (what, format!("{CRANK}\n{before}"), it.to_owned()));
    // Reading is no part of a command.
    let cases = CASES.into_iter().filter(|it| it.what != "reading a long block");
    let cases = cases.map(|it| (it.what, (it.before)(it.size), (it.statement)(it.size)));
    for (what, scene, last) in cases.chain(others) {
        let mut whole = Talking::after(&scene);
        let (result, n_looks) = timed(&mut whole, &last, u64::MAX - 1);
        assert_eq!(result.expect(what), Flow::On);
        let mut n_refused = 0;
        for most in [n_looks / 3, n_looks - 2] {
            let mut talking = Talking::after(&scene);
            let (script, n_files) = (talking.script(), talking.talk.files.len());
            let (result, n_looked) = timed(&mut talking, &last, most);
            // A study looks at the clock for each of its rungs.
            let most_after = if what == "a study" { 100 } else { MOST_AFTER };
            assert!(n_looked <= most + most_after, "{what}: looked {n_looked} times of {most}");
            let Err(problem) = result else {
                // It was told when all that was left were its files.
                check_same(&talking.script(), &whole.script(), what);
                continue;
            };
            n_refused += 1;
            assert_eq!(&*problem.message, "the limit `seconds` is exceeded", "{what}");
            check_same(&talking.script(), &script, what);
            assert_eq!(talking.talk.files.len(), n_files, "{what}");
            assert!(!talking.talk.said.contains("stopped"), "{what}: {}", talking.talk.said);
            let (result, _) = timed(&mut talking, &last, u64::MAX - 1);
            assert_eq!(result.expect(what), Flow::On);
            check_same(&talking.script(), &whole.script(), &format!("{what}, then with time"));
        }
        assert!(n_refused > 0, "{what}");
    }
}

#[test]
fn a_run_that_is_stopped_within_a_frame_ends_with_the_last_whole_one() {
    let scene = format!("{}; crank: motor p[16][1] p[16][2] speed 1rev; set dt 1/1000", net(16));
    let mut whole = Talking::after(&scene);
    let n = asked(&mut whole, "step 4", None).1;
    let mut frames = Vec::new();
    for most in [n / 3, n / 2, n - 2] {
        let mut talking = Talking::after(&scene);
        assert_eq!(asked(&mut talking, "step 4", Some(most)).0, Flow::Stopped);
        let frame = talking.world().clock().frame;
        frames.push(frame);
        talking.talk.most_polls = None;
        let mut other = Talking::after(&scene);
        if frame > 0 {
            other.run(&format!("step {frame}"));
        }
        check_same(&talking.script(), &other.script(), "the last whole frame");
        talking.run("step");
        other.run("step");
        check_same(&talking.script(), &other.script(), "the frame after it");
    }
    assert!(frames.iter().any(|frame| (1..4).contains(frame)), "{frames:?}");
}

#[test]
fn a_loop_counts_as_far_as_numbers_do() {
    let mut talking = Talking::default();
    for (range, place) in [
        ("1e16..1e16+4", "1e16"),
        ("9007199254740990..9007199254740993", "9007199254740993"),
        ("-1e300..1", "-1e300"),
    ] {
        let problem = talking.execute(&format!("for i in {range} {{}}")).expect_err(range);
        assert_eq!(&*problem.message, "a loop cannot count so far");
        assert_eq!(talking.session.sources().slice(problem.place().expect("a place")), place);
    }
    let last = talking.ask("for i in 9007199254740989..9007199254740991 { print i }");
    assert_eq!(last, ["9007199254740989", "9007199254740990", "9007199254740991"]);
}

/// Somebody who stops a long run, and presses Ctrl-C once more while the journal is told of it.
#[derive(Default)]
struct Hasty {
    n_polls: Cell<u64>,
    /// Whether Ctrl-C was pressed; the program ends where it is pressed again.
    is_asked: Cell<bool>,
    is_ended: bool,
    kept: String,
}

impl Host for Hasty {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_keeping(&self) -> bool {
        true
    }

    fn keep(&mut self, kept: Kept<'_>) {
        match kept {
            Kept::Done(text) => self.kept.extend([text, "\n"]),
            Kept::First(_) => panic!("nothing is taken back"),
            Kept::Whole(script) => {
                self.is_ended |= self.is_asked.replace(true);
                script.clone_into(&mut self.kept);
            }
        }
    }

    fn is_interrupted(&self) -> bool {
        self.n_polls.update(|n| n + 1);
        if self.n_polls.get() == 100 {
            self.is_asked.set(true);
        }
        self.is_asked.get()
    }

    fn forget_stop(&mut self) {
        self.is_asked.set(false);
    }

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        Err(io::ErrorKind::NotFound.into())
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[test]
fn who_stops_a_run_and_presses_again_loses_nothing_of_it() {
    // What depends on the clock is written down whole.
    for run in ["for i in 1..1e6 { step }", "for i in 1..1e6 { step in 1s }"] {
        let (mut session, mut hasty) = (Session::new(), Hasty::default());
        let mut typed = Transcript::new("typed");
        typed.enter("point A = (0, 0) frozen, B = (1, 0)", &mut session, &mut hasty);
        typed.enter("motor A B speed 1rev", &mut session, &mut hasty);
        let outcome = typed.enter(run, &mut session, &mut hasty);
        assert_eq!(outcome.flow, Flow::Stopped);
        assert!(session.world().clock().frame > 0);
        let mut again = Session::new();
        again.run(&hasty.kept).expect("it can be loaded");
        assert_eq!(again.to_script(), session.to_script(), "{run}");
        assert!(!hasty.is_ended, "the run had stopped when it was pressed again");
    }
}

/// A scene that runs while it is loaded.
const LOADED: &str = "point A = (0, 0) frozen, D = (4, 0) frozen; point B = (1, 0)
    # A remark.
    point C = (3, 3); motor A B speed 1rev; length B C = 3.5; step 4; length C D = 3; relax 20
    for i in 1..20 { step 3; include \"part.link\" }
    set live on; point E = (5, 5); length D E = 2; let q = 1; length C E = 4; set live off
    step 40; let late = 1";

/// Types statements, each stopped after so many looks at whether it is to; what the journal brings back
/// is the session as it is.
fn assert_kept(statements: &[(&str, u64)]) {
    let mut talking = Talking::default();
    talking.talk.journal = Some(vec![String::new()]);
    let part = "for i in 1..100 { step 3 }\nlet q = 1\nrelax 300\nstep 500\n";
    talking.talk.files.insert("part.link".into(), part.to_owned());
    talking.talk.files.insert("scene.link".into(), LOADED.to_owned());
    talking.talk.files.insert("nothing.link".into(), "# nothing\n".to_owned());
    let mut typed = Transcript::new("typed");
    for (statement, most) in statements {
        talking.talk.n_polls.set(0);
        talking.talk.most_polls = Some(*most);
        typed.enter(statement, &mut talking.session, &mut talking.talk);
    }
    let journal = talking.talk.journal.clone().expect("it is kept").concat();
    let mut loaded = Talking::default();
    loaded.talk.files.insert("journal.link".into(), journal.clone());
    loaded.run("load \"journal.link\"");
    check_same(&loaded.script(), &talking.script(), &format!("{statements:?}\n{journal}"));
    assert!(!journal.contains("restore version"), "it was written whole:\n{journal}");
}

#[test]
fn a_stop_is_repeated_where_it_was() {
    const SCENE: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3); \
        motor A B speed 1rev; length B C = 3.5; length C D = 3; define foot(P, d) { point Q = P + (d, 0); length P Q }";
    for stopped in [
        "step 5000",
        "run 50; let r = 3",
        "trace C; step 5000",
        "for i in 1..1000 { step 3; let q[i] = i }",
        "for i in 1..1000 { step 40 }",
        "for i in 1..1000 { point p[i] = (i, 0); length D p[i] <= 2000 }",
        "for i in 1..10 { for k in 1..100 { use foot(C, k) as f[i][k]; step 2 } }",
        "for i in 1..100000 { }",
        "include \"part.link\"",
        "for i in 1..5 { include \"part.link\"; step 9 }",
        "relax 100000",
        "freeze C; off length1; drag C to (3, 2) over 1000",
        "off length1; freeze C; drag C through (3, 2), (3, 4), (2, 2), (1, 1) over 0",
        "set dead-points reverse; step 3000",
        "solve",
        "load \"scene.link\"",
        "load \"part.link\"",
        "load \"nothing.link\"",
        "let late = 1",
    ] {
        for most in [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 17, 23, 40, 150, 400, 1000] {
            assert_kept(&[(SCENE, u64::MAX), (stopped, most), ("step 3; let after = 2", u64::MAX)]);
        }
    }
}

#[test]
fn a_frame_that_is_left_on_its_way_is_kept_as_it_is() {
    let mut talking = Talking::default();
    talking.talk.journal = Some(vec![String::new()]);
    let mut typed = Transcript::new("typed");
    for (text, most) in [
        ("point A = (0, 0) frozen, B = (1, 0), C = (3, 0); motor A B speed 1rev", u64::MAX),
        ("length B C = 2; set method relaxation; set iterations 100000", u64::MAX),
        ("step 30", 3),
        ("let after = 1", u64::MAX),
    ] {
        talking.talk.n_polls.set(0);
        talking.talk.most_polls = Some(most);
        typed.enter(text, &mut talking.session, &mut talking.talk);
    }
    let journal = talking.talk.journal.take().expect("it is kept").concat();
    check_same(&Talking::after(&journal).script(), &talking.script(), "its journal");
}

#[test]
fn commands_that_are_taken_back_or_done_again_are_so_whole_or_not_at_all() {
    for walk in ["undo", "redo"] {
        let ready = || {
            let mut talking = Talking::after(&rods(20_000));
            if walk == "redo" {
                talking.run("undo");
            }
            talking
        };
        let mut whole = ready();
        let n = asked(&mut whole, walk, None).1;
        assert!(n > 3, "`{walk}` asked {n} times");
        for most in [0, 1, n / 2, n - 2] {
            let mut talking = ready();
            let before = talking.script();
            let (flow, n_asked) = asked(&mut talking, walk, Some(most));
            assert_eq!(flow, Flow::Stopped, "`{walk}` told after {most}");
            assert!(n_asked <= most + MOST_AFTER, "`{walk}` asked {n_asked}, told after {most}");
            talking.talk.most_polls = None;
            if talking.script() == before {
                talking.run(walk);
            }
            check_same(&talking.script(), &whole.script(), walk);
            talking.run(if walk == "undo" { "redo" } else { "undo" });
            check_same(&talking.script(), &before, &format!("`{walk}` taken back"));
        }
    }
}

#[test]
fn of_many_commands_that_are_taken_back_those_stay_back_that_were() {
    let lines: Vec<String> = (0..20).map(|k| format!("let r = {k}")).collect();
    let lines = lines.join("\n");
    for most in 0..12 {
        assert_kept(&[(&lines, u64::MAX), ("undo 10", most), ("let after = r", u64::MAX)]);
        assert_kept(&[(&lines, u64::MAX), ("undo 10", u64::MAX), ("redo 9", most)]);
    }
}

#[test]
fn what_is_solved_after_each_edit_is_kept_so() {
    assert_kept(&[
        (
            "point A = (0, 0) frozen, B = (1, 0), C = (2, 2), D = (4, 0) frozen; set live on",
            u64::MAX,
        ),
        ("length A B = 1.5; length B C = 2; length C D = 2.5", u64::MAX),
        ("move A to (0.2, 0.1)", u64::MAX),
        ("for i in 1..3 { move A to (0.1 * i, 0); length A B <= 3 + i }", u64::MAX),
        ("for i in 1..300 { move A to (0.001 * i, 0) }", 40),
        ("move D to (40, 0)", u64::MAX),
        ("move D to (5, 0)", u64::MAX),
    ]);
}

#[test]
fn a_recording_that_is_stopped_is_still_to_be_written() {
    let crank = "point A = (0, 0) frozen, B = (1, 0); motor A B speed 1rev";
    for (file, n_frames, has_what) in [
        ("t.csv", 5000, "a line a frame"),
        ("t.svg", 5000, "a picture that moves"),
        ("t/", 4, "a picture a frame"),
    ] {
        // It is asked while it is made ready, before the first rows are written, and then now and then.
        for most_polls in 0..=3 {
            let mut talking =
                Talking::after(&format!("{crank}; record \"{file}\"; step {n_frames}"));
            let before = talking.script();
            talking.talk.n_polls.set(0);
            talking.talk.most_polls = Some(most_polls);
            match talking.execute("record stop") {
                Ok(flow) => assert_eq!(flow, Flow::Stopped, "{file}, {most_polls}"),
                Err(problem) => {
                    let told = "stopped before the recording was written";
                    assert_eq!(&*problem.message, told, "{file}");
                }
            }
            let n_written = talking.talk.files.len();
            assert!(n_written == 0 || file == "t/" && n_written < n_frames, "{file}");
            check_same(&talking.script(), &before, file);
            talking.talk.most_polls = None;
            talking.run("record stop");
            let written: Vec<&String> = talking.talk.files.values().collect();
            let is_whole = match has_what {
                "a line a frame" => written[0].lines().count() == n_frames + 1,
                "a picture a frame" => written.len() == n_frames,
                _ => written[0].ends_with("</svg>\n"),
            };
            assert!(is_whole, "{file} is {has_what}");
        }
    }
}
