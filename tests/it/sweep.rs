//! `linkwork sweep`: every variant has its row, whoever runs it and however often it was stopped.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::{fs, io};

use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Grid, Host, Sweep, SweepScript, parse_axis};
use serde_json::Value;

use crate::support::program::{PROGRAM, folder, run, text};

/// The largest height of a slider's crank is its radius; a rod that is too short stops it.
const SLIDER: &str = "let r = 1, l = 3
point O = (0, 0) frozen, P = (r, 0), S = (r + l, 0), E = (20, 0) frozen
crank: motor O P radius r speed 1rev
rod: length P S = l
glider S on O E unbounded
set dt 1/36
measure y = P.y
measure x = S.x
step 36
result height = y.max, stroke = x.span
";

fn sweep(folder: &Path, args: &[&str]) -> Output {
    run(folder, &[&["sweep", "slider.link"], args].concat(), "")
}

/// All that was said.
fn text_of(out: &Output) -> String {
    text(&out.stdout) + &text(&out.stderr)
}

#[track_caller]
fn fine(out: &Output) {
    assert_eq!(out.status.code(), Some(0), "{}", text(&out.stderr));
}

fn table(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).expect("the table is there")
}

/// The cells of the rows, without the heading.
fn rows(table: &str) -> Vec<Vec<&str>> {
    table.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

#[test]
fn each_variant_has_its_row() {
    let folder = folder(&[("slider.link", SLIDER)]);
    fine(&sweep(folder.path(), &["--set", "r=0.5..1:0.25", "--set", "l=2,3"]));
    let table = table(folder.path(), "sweep.csv");
    let heading = "variant,r,l,height,stroke,status,residual,missed,dead_points,error\n";
    assert!(table.starts_with(heading), "{table}");
    let rows = rows(&table);
    assert_eq!(rows.len(), 6);
    let grid = [(0.5, 2.0), (0.5, 3.0), (0.75, 2.0), (0.75, 3.0), (1.0, 2.0), (1.0, 3.0)];
    for (k, (row, (r, l))) in rows.iter().zip(grid).enumerate() {
        let number = |at: usize| row[at].parse::<f64>().expect("a number");
        assert_eq!((row[0], number(1), number(2)), (k.to_string().as_str(), r, l));
        // The slider goes from l - r to l + r, whatever the rod.
        assert!((number(3) - r).abs() < 1e-9 && (number(4) - 2.0 * r).abs() < 1e-9, "{row:?}");
        assert_eq!((row[5], row[7], row[8], row[9]), ("converged", "0", "0", ""));
        assert!(number(6) <= 1e-12);
    }
}

#[test]
fn each_row_is_what_a_run_with_its_values_says() {
    let script = SLIDER.replace("step 36", "trace S; set measures sampled; step 36");
    for script in [SLIDER, &script] {
        let folder = folder(&[("slider.link", script)]);
        fine(&sweep(folder.path(), &["--set", "r=0.4..1:0.3", "--set", "l=3,0.5"]));
        let table = table(folder.path(), "sweep.csv");
        for row in rows(&table) {
            let [r, l] = [1, 2].map(|at| format!("{}={}", ["", "r", "l"][at], row[at]));
            let run = run(folder.path(), &["run", "slider.link", "--set", &r, "--set", &l], "");
            fine(&run);
            let wanted = format!("height = {}\nstroke = {}\n", row[3], row[4]);
            assert_eq!(text(&run.stdout), wanted, "of {row:?}");
        }
    }
}

#[test]
fn rows_are_those_of_frames_one_by_one() {
    let four_bar = "let a = 1, b = 3.5, c = 3
point A = (0, 0) frozen, D = (4, 0) frozen, B = (a, 0.1), C = (3, 3), E = (1, 2)
crank: motor A B radius a speed 1rev
length B C = b; length C D = c; length B E = 1.5; length C E = 2.5
solve
set dt 1/90
measure mu = angle(B, C, D, C) in deg
measure far = distance(A, E) + sqrt(C.x - 1.2)
step 270
result least = mu.min, greatest = mu.max, at = mu.at_max, mean = far.mean, span = far.span
";
    // Ghosts are kept frame by frame.
    let one_by_one = four_bar.replace("set dt", "expose every 1000000; set dt");
    let folder = folder(&[("slider.link", four_bar), ("one.link", &one_by_one)]);
    let grid = ["--set", "a=0.6..1.6:0.11", "--set", "b=2.9..4.1:0.17", "--set", "c=2.8,3.3"];
    fine(&sweep(folder.path(), &[&grid[..], &["--to", "at-once.csv"]].concat()));
    let args = [&["sweep", "one.link"], &grid[..], &["--to", "one-by-one.csv"]].concat();
    fine(&run(folder.path(), &args, ""));
    let [at_once, one_by_one] =
        ["at-once", "one-by-one"].map(|name| table(folder.path(), &format!("{name}.csv")));
    assert_eq!(at_once, one_by_one);
    let n = |status: &str| rows(&at_once).iter().filter(|row| row[9] == status).count();
    assert!(n("converged") > 40 && n("error") > 10, "{at_once}");
}

#[test]
fn what_goes_wrong_is_in_its_row() {
    let script = SLIDER.replace("step 36", "step 36; assert l > 1.5");
    let folder = folder(&[("slider.link", &script)]);
    let out = sweep(folder.path(), &["--set", "l=0.5,1.25,2"]);
    fine(&out);
    let told = text(&out.stderr);
    assert!(
        told.contains(
            "3 rows in sweep.csv: 2 ended in an error, 1 missed the tolerance, 1 met dead points"
        ),
        "{told}"
    );
    let table = table(folder.path(), "sweep.csv");
    let rows = rows(&table);
    assert_eq!(rows[0][4], "error");
    assert_ne!(rows[0][7], "0", "a rod of half the radius stops the crank");
    assert!(rows[0][8].contains("line 9"), "{:?}", rows[0]);
    assert_eq!((rows[1][4], rows[1][7], rows[2][4]), ("error", "0", "converged"));
    // What came after the mistake is missing.
    assert_eq!((rows[1][2], rows[2][3].is_empty()), ("", false));
}

#[test]
fn the_table_is_the_same_on_any_number_of_cores_and_in_parts() {
    let folder = folder(&[("slider.link", SLIDER)]);
    let grid = ["--set", "r=0.5..1:0.05", "--set", "l=2..3:0.1"];
    let with = |args: &[&str]| fine(&sweep(folder.path(), &[&grid, args].concat()));
    with(&["-j", "1", "--to", "one.csv"]);
    with(&["-j", "3", "--to", "three.csv"]);
    let whole = table(folder.path(), "one.csv");
    assert_eq!(whole, table(folder.path(), "three.csv"));
    let mut lines: Vec<(usize, String)> = Vec::new();
    for part in 1..=4 {
        let name = format!("part-{part}.csv");
        with(&["--shard", &format!("{part}/4"), "--to", &name]);
        let table = table(folder.path(), &name);
        assert_eq!(table.lines().next(), whole.lines().next());
        lines.extend(table.lines().skip(1).map(|line| {
            let number = line.split(',').next().expect("a cell");
            (number.parse().expect("a number"), line.to_owned())
        }));
    }
    lines.sort();
    let joined: Vec<&str> = lines.iter().map(|(_, line)| line.as_str()).collect();
    assert_eq!(joined, whole.lines().skip(1).collect::<Vec<_>>());
}

#[test]
fn a_sweep_goes_on_to_the_byte_wherever_it_was_cut() {
    let folder = folder(&[("slider.link", SLIDER)]);
    for json in [&[][..], &["--json"]] {
        let with = |args: &[&str]| {
            let grid = ["--set", "r=0.5..1:0.1", "--set", "l=2,3"];
            sweep(folder.path(), &[&grid, json, args].concat())
        };
        fine(&with(&["--to", "whole"]));
        let whole = fs::read(folder.path().join("whole")).expect("the table");
        for cut in [0, 1, 20, whole.len() / 3, whole.len() / 2, whole.len() - 1, whole.len()] {
            fs::write(folder.path().join("cut"), &whole[..cut]).expect("a table");
            fine(&with(&["--resume", "--to", "cut"]));
            let found = fs::read(folder.path().join("cut")).expect("the table");
            assert!(found == whole, "cut at {cut}: {}", String::from_utf8_lossy(&found));
        }
        fine(&with(&["--resume", "--to", "new"]));
        assert!(fs::read(folder.path().join("new")).expect("the table") == whole);
        for name in ["whole", "cut", "new"] {
            fs::remove_file(folder.path().join(name)).expect("it is there");
        }
    }
}

#[test]
fn a_table_that_is_there_is_not_lost() {
    let folder = folder(&[
        ("slider.link", SLIDER),
        ("mine.csv", "a,b\n1,2\n"),
        ("notes.txt", "not a line"),
        ("lines.txt", "some lines\nof text\n"),
    ]);
    let refused = |args: &[&str], wanted: &str| {
        let out = sweep(folder.path(), args);
        assert_eq!(out.status.code(), Some(2));
        assert!(text(&out.stderr).contains(wanted), "{}", text(&out.stderr));
    };
    fine(&sweep(folder.path(), &["--set", "r=1,2"]));
    let before = table(folder.path(), "sweep.csv");
    refused(&["--set", "r=1,2"], "`--resume` goes on with it");
    refused(&["--set", "r=1,3", "--resume"], "of another sweep");
    refused(&["--set", "l=3,4", "--resume"], "of another sweep");
    refused(&["--set", "r=1,2", "--shard", "2/2", "--resume"], "of another sweep");
    refused(&["--set", "r=1,2", "--resume", "--to", "mine.csv"], "of another sweep");
    for json in [&[][..], &["--json"]] {
        for (name, text) in [
            ("mine.csv", "a,b\n1,2\n"),
            ("notes.txt", "not a line"),
            ("lines.txt", "some lines\nof text\n"),
        ] {
            let out = sweep(
                folder.path(),
                &[&["--set", "r=1,2", "--resume", "--to", name], json].concat(),
            );
            let said = text_of(&out);
            assert!(out.status.code() == Some(2) && said.contains("of another sweep"), "{said}");
            assert_eq!(table(folder.path(), name), text);
        }
    }
    let (second_row, _) = before.match_indices('\n').nth(1).expect("two lines");
    let heading_and_row = &before[..=second_row];
    // A row that was begun is cut off only where it is the next one.
    for (name, behind) in [("whole", "3"), ("begun", "1,7"), ("other", "my notes")] {
        let rows = if name == "begun" { heading_and_row } else { &before };
        let mine = format!("{rows}{behind}");
        fs::write(folder.path().join(name), &mine).expect("a file");
        refused(&["--set", "r=1,2", "--resume", "--to", name], "of another sweep");
        assert_eq!(table(folder.path(), name), mine);
    }
    refused(&["--set", "r=1,2", "--resume", "--to", "-"], "a table in a file");
    assert_eq!(table(folder.path(), "sweep.csv"), before);
    fine(&sweep(folder.path(), &["--set", "r=1,2", "--force"]));
}

#[test]
fn what_was_there_before_is_not_counted_as_run() {
    let script = SLIDER.replace("step 36", "step 36; assert l > 1.5");
    let folder = folder(&[("slider.link", &script)]);
    let grid = ["--set", "l=0.5,1.25,2,1.3"];
    let note = |args: &[&str]| {
        let out = sweep(folder.path(), &[&grid, args].concat());
        fine(&out);
        text(&out.stderr)
    };
    let told = note(&[]);
    assert!(
        told.contains(
            "4 rows in sweep.csv: 3 ended in an error, 1 missed the tolerance, 1 met dead points"
        ),
        "{told}"
    );
    let whole = table(folder.path(), "sweep.csv");
    let (third, _) = whole.match_indices('\n').nth(2).expect("three lines");
    fs::write(folder.path().join("sweep.csv"), &whole[..=third]).expect("a table");
    let told = note(&["--resume"]);
    assert!(
        told.contains("4 rows in sweep.csv, 2 of them run now: 1 ended in an error\n"),
        "{told}"
    );
    let told = note(&["--resume"]);
    assert!(told.contains("4 rows in sweep.csv, 0 of them run now\n"), "{told}");
    assert_eq!(table(folder.path(), "sweep.csv"), whole);
}

/// A host that counts what is read.
#[derive(Default)]
struct Counting {
    n_reads: u64,
}

impl Host for Counting {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        self.n_reads += 1;
        Ok("let size = 3".to_owned())
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn each_variant_is_run_once() {
    let text = "include \"size.link\"\nassert size > 2\nresult twice = 2 * size\n";
    let script = SweepScript::read("sweep", text, PathBuf::new(), Vec::new()).expect("a script");
    let axes = vec![parse_axis("size=1..9").expect("values")];
    let mut host = Counting::default();
    let sweep = Sweep::begin(script, Grid { axes }, &mut host).expect("it begins");
    // The first that comes to its end shows the columns.
    assert_eq!(host.n_reads, 3);
    for number in 0..sweep.n_variants() {
        let variant = sweep.variant(number, &mut host).expect("it is run");
        let twice = (number >= 2).then_some(2.0 * (number + 1) as f64);
        assert_eq!((variant.number, variant.results.get("twice")), (number, twice));
    }
    assert_eq!(host.n_reads, 9);
}

#[test]
#[cfg(target_os = "linux")]
fn a_table_that_cannot_be_written_ends_the_sweep() {
    let folder = folder(&[("slider.link", SLIDER)]);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("it takes nothing");
    let out = Command::new(PROGRAM)
        .current_dir(folder.path())
        .args(["sweep", "slider.link", "--set", "r=1,2", "--to", "-"])
        .stdout(full)
        .output()
        .expect("it ends");
    assert_eq!(out.status.code(), Some(3));
    assert!(text(&out.stderr).contains("cannot write `standard output`"), "{}", text(&out.stderr));
    // Who reads no further has read enough.
    let mut child = Command::new(PROGRAM)
        .current_dir(folder.path())
        .args(["sweep", "slider.link", "--set", "r=1..2:0.001", "--to", "-", "--quiet"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
}

#[test]
fn objects_say_what_rows_say() {
    let folder = folder(&[("slider.link", SLIDER)]);
    let out = sweep(folder.path(), &["--set", "r=0.5,1", "--json", "--to", "-"]);
    fine(&out);
    let found = objects(&out);
    assert_eq!(
        found.iter().map(|it| &it["type"]).collect::<Vec<_>>(),
        ["linkwork", "variant", "variant", "sweep"]
    );
    for (k, object) in found[1..3].iter().enumerate() {
        assert_eq!(object["variant"].as_u64(), Some(k as u64));
        let r = object["parameters"]["r"].as_f64().expect("a number");
        assert!((object["results"]["height"].as_f64().expect("a number") - r).abs() < 1e-9);
        are_documented(object);
    }
    let end = &found[3];
    are_documented(end);
    assert_eq!((&end["rows"], &end["of"], &end["failed"]), (&2.into(), &2.into(), &0.into()));
    let columns = end["columns"].as_array().expect("names");
    assert_eq!(columns[..4], ["variant", "r", "height", "stroke"]);
}

/// What was said, an object a line, and nothing beside it.
#[track_caller]
fn objects(out: &Output) -> Vec<Value> {
    assert_eq!(text(&out.stderr), "", "all is said in objects");
    let read = |line| serde_json::from_str(line).expect("an object");
    text(&out.stdout).lines().map(read).collect()
}

/// Holds the fields of an object to its row of the page.
#[track_caller]
fn are_documented(object: &Value) {
    let page = include_str!("../../docs/json.md");
    let kind = object["type"].as_str().expect("a type");
    let row = page.lines().find(|line| line.starts_with(&format!("| `{kind}`")));
    let row = row.unwrap_or_else(|| panic!("no `{kind}` in docs/json.md"));
    for field in object.as_object().expect("an object").keys().filter(|it| *it != "type") {
        assert!(row.contains(&format!("`{field}`")), "no `{field}` of `{kind}` in docs/json.md");
    }
}

#[test]
fn what_is_wrong_is_an_object_with_its_place() {
    let script = SLIDER.replace("step 36", "step 36; assert l > 1.5");
    let folder = folder(&[("slider.link", &script)]);
    fine(&sweep(folder.path(), &["--set", "l=1.25,2", "--json"]));
    let rows = table(folder.path(), "sweep.jsonl");
    let first: Value =
        serde_json::from_str(rows.lines().next().expect("a row")).expect("an object");
    are_documented(&first);
    assert!(first["error"].as_str().expect("a text").starts_with("line 9: "), "{first}");
    let place = &first["problem"]["places"][0];
    let bytes = ["start", "end"].map(|end| place[end].as_u64().expect("bytes") as usize);
    assert_eq!((&place["line"], &script[bytes[0]..bytes[1]]), (&9.into(), "assert l > 1.5"));
    let check = |args: &[&str], status: i32, code: &str| {
        let out = sweep(folder.path(), &[args, &["--json"]].concat());
        assert_eq!(out.status.code(), Some(status), "of {args:?}");
        let found = objects(&out);
        let [opening, error] = &found[..] else { panic!("of {args:?}: {found:?}") };
        assert_eq!((&opening["type"], &error["type"]), (&"linkwork".into(), &"error".into()));
        assert_eq!(error["code"], code, "of {args:?}");
    };
    check(&["--set", "rr=1,2"], 2, "E0201");
    check(&["--set", "l=1.25,2"], 2, "E0709");
    fs::write(folder.path().join("slider.link"), "let r = 1\nlenght A B\n").expect("a script");
    check(&["--set", "r=1,2"], 2, "E0101");
    fs::remove_file(folder.path().join("slider.link")).expect("it is there");
    check(&["--set", "r=1,2"], 3, "E0701");
}

#[test]
fn a_contact_sheet_shows_each_variant() {
    let folder = folder(&[("slider.link", SLIDER)]);
    fine(&sweep(folder.path(), &["--set", "r=0.5..1:0.1", "--pictures"]));
    let sheet = table(folder.path(), "sweep.svg");
    assert_eq!(sheet.matches("<image ").count(), 6);
    assert!(sheet.contains(">r = 0.7</text>"), "{sheet}");
    roxmltree::Document::parse(&sheet).expect("it is well formed");
}

#[test]
fn a_wish_that_cannot_be_is_told_with_what_to_type() {
    let folder = folder(&[("slider.link", SLIDER), ("plain.link", "print 1\n")]);
    let check = |args: &[&str], status: i32, wanted: &str| {
        let out = run(folder.path(), args, "");
        let told = text(&out.stderr);
        assert_eq!(out.status.code(), Some(status), "of {args:?}: {told}");
        assert!(told.contains(wanted), "of {args:?}: {told}");
        assert!(!folder.path().join("sweep.csv").exists(), "of {args:?}");
    };
    check(&["sweep", "slider.link", "--set", "rr=1,2"], 2, "did you mean `r`?");
    check(&["sweep", "slider.link", "--set", "width=1,2"], 2, "the script declares");
    check(&["sweep", "plain.link", "--set", "r=1,2"], 2, "`let r = 1` in the script declares it");
    check(&["sweep", "slider.link", "--set", "r=1", "--set", "r=2"], 2, "given twice");
    let many = ["sweep", "slider.link", "--set", "r=1..20000", "--set", "l=1..20000"];
    check(&many, 2, "`--force` runs them all the same");
    check(&["sweep", "slider.link", "--set", "r=2..1"], 2, "LEAST..MOST:STEP");
    check(&["sweep", "slider.link", "--set", "r=1", "--shard", "3/2"], 2, "2/8");
    check(&["sweep", "nowhere.link", "--set", "r=1"], 3, "nowhere.link");
    check(&["run", "slider.link", "--set", "r=1,2"], 2, "`linkwork sweep` takes them");
    fs::write(folder.path().join("slider.link"), "let r = 1\nlenght A B\n").expect("a script");
    check(&["sweep", "slider.link", "--set", "r=1,2"], 2, "did you mean `length`?");
}

#[test]
fn a_file_that_is_included_may_declare_what_is_swept() {
    let folder = folder(&[
        ("slider.link", "include \"size.link\"\nresult twice = 2 * size\n"),
        ("size.link", "let size = 3\n"),
    ]);
    fine(&sweep(folder.path(), &["--set", "size=1,2"]));
    assert_eq!(rows(&table(folder.path(), "sweep.csv"))[1][2], "4");
}
