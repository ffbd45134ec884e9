//! What the program says to programs: objects of one schema, which docs/json.md has.

use serde_json::{Value, json};

use crate::support::program::{folder, run, text};

const FOUR_BAR: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
coupler: length B C = 3.5
rocker: length C D = 3
";

/// The objects that the program says, a line each.
#[track_caller]
fn objects(args: &[&str], input: &str) -> (Option<i32>, Vec<Value>) {
    let folder = folder(&[("four-bar.link", FOUR_BAR)]);
    let out = run(folder.path(), args, input);
    assert_eq!(text(&out.stderr), "", "all is said in objects");
    let read = |line: &str| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"));
    (out.status.code(), text(&out.stdout).lines().map(read).collect())
}

fn kinds(objects: &[Value]) -> Vec<&str> {
    objects.iter().map(|object| object["type"].as_str().expect("a type")).collect()
}

fn find<'a>(objects: &'a [Value], kind: &str) -> &'a Value {
    objects.iter().find(|object| object["type"] == kind).unwrap_or_else(|| panic!("no {kind}"))
}

/// Statements that find all that can be found.
const ALL: &str = "let r = 2; define pin(P) { point Q = P }
trace C as \"before\"; list traces; set dt 1/36; measure m = C.x; step 36; result span = m.span
print r, C in deg
list
show coupler; show A; show r
check
limits crank
effects
fit r in 1..3 to minimise (r - 2.5)^2
length A D = 9
check
svg \"now.svg\"
change coupler = 1
step 20
record \"frames/\"; step 2; record stop
help motor
list points extra
";

#[test]
fn each_statement_ends_with_an_object() {
    let (status, found) = objects(&["--json"], &format!("{FOUR_BAR}{ALL}"));
    assert_eq!(status, Some(2), "two are mistakes");
    let statements = found.iter().filter(|object| object["type"] == "statement");
    let said: Vec<(&str, bool)> = statements
        .map(|object| (object["text"].as_str().expect("a text"), object["ok"] == true))
        .collect();
    // Behind a mistake the rest of its line is left out.
    let wanted = format!("{FOUR_BAR}{ALL}").matches(['\n', ';']).count();
    assert_eq!(said.len(), wanted, "{said:?}");
    let wrong: Vec<&str> = said.iter().filter(|(_, is_ok)| !is_ok).map(|(text, _)| *text).collect();
    assert_eq!(wrong.len(), 2, "{wrong:?}");
    assert_eq!(found.last().expect("objects")["ok"], false);
}

#[test]
fn the_page_has_every_type_and_every_field() {
    let page = include_str!("../../docs/json.md");
    let (_, table) = page.split_once("| type | when | fields |").expect("the table");
    let (_, mut found) = objects(&["--json"], &format!("{FOUR_BAR}{ALL}"));
    let requests =
        ["traces", "measures", "svg", "script"].map(|what| format!("{{\"get\": \"{what}\"}}\n"));
    let requests = format!("{FOUR_BAR}trace C as \"path\"; measure m = C.x\n{}", requests.concat());
    found.extend(objects(&["--json"], &requests).1);
    let columns = ["traces", "measures"].map(|kind| find(&found, kind)[kind][0].clone());
    found.extend(columns.map(|mut object| {
        let kind = if object.get("point").is_some() { "traces" } else { "measures" };
        object["type"] = json!(kind);
        object
    }));
    let mut seen: Vec<&str> = kinds(&found);
    seen.sort_unstable();
    seen.dedup();
    let missing: Vec<&str> = [
        "check",
        "done",
        "effects",
        "error",
        "file",
        "fit",
        "limits",
        "linkwork",
        "list",
        "measures",
        "note",
        "print",
        "receipt",
        "result",
        "script",
        "show",
        "statement",
        "svg",
        "traces",
        "warning",
    ]
    .into_iter()
    .filter(|kind| !seen.contains(kind))
    .collect();
    assert!(missing.is_empty(), "{missing:?} were not tried");
    for object in &found {
        let kind = object["type"].as_str().expect("a type");
        let row = table.lines().find(|line| {
            let cell = line.split('|').nth(1).unwrap_or_default();
            cell.contains(&format!("`{kind}`"))
        });
        let row = row.unwrap_or_else(|| panic!("docs/json.md has no `{kind}`"));
        for field in object.as_object().expect("an object").keys().filter(|it| *it != "type") {
            assert!(
                row.contains(&format!("`{field}`")),
                "no `{field}` of `{kind}` in docs/json.md"
            );
        }
    }
}

#[test]
fn a_mistake_has_its_place_by_byte_and_line() {
    let typed = "let ä = 1 # ö\nlength A B\n";
    let (_, found) = objects(&["--json", "-e", typed], "");
    let place = &find(&found, "error")["places"][0];
    assert_eq!(place["file"], "<argument>");
    assert_eq!((&place["line"], &place["column"]), (&json!(2), &json!(8)));
    let bytes = place["start"].as_u64().expect("bytes") as usize
        ..place["end"].as_u64().expect("bytes") as usize;
    assert_eq!(&typed[bytes], "A");
    assert_eq!(find(&found, "error")["code"], "E0201");
    let statement = found.last().expect("objects");
    assert_eq!((&statement["text"], &statement["ok"]), (&json!("length A B"), &json!(false)));
}

#[test]
fn values_are_those_of_the_session() {
    let (status, found) = objects(&["run", "--json", "-e", "print 0.1 + 0.2, (1, -2), \"x\""], "");
    assert_eq!(status, Some(0));
    let print = find(&found, "print");
    assert_eq!(print["text"], "0.30000000000000004 (1, -2) x");
    assert_eq!(print["values"], json!([0.1 + 0.2, [1.0, -2.0]]));
}

#[test]
fn what_cannot_be_read_is_an_object_too() {
    let (status, found) = objects(&["run", "--json", "nowhere.link"], "");
    assert_eq!(status, Some(3));
    assert_eq!(kinds(&found), ["linkwork", "error"]);
    assert_eq!(found[1]["code"], "E0701");
}

#[test]
fn the_numbers_of_a_fit_and_the_name_of_a_path_are_data() {
    let script = "let r = 1.5, s = 2; point A = (0, 0) frozen, B = (1, 0); length A B = r
        trace B as \"half\"; measure d = B.x in ms; step 2
        fit r in 1..2, s in 0..4 to minimise d.span + (s - 3)^2 + 1000 * r over 1
        list traces";
    let requests = "{\"get\": \"traces\"}\n{\"get\": \"measures\"}\n";
    let (status, found) = objects(&["--json"], &format!("{script}\n{requests}"));
    assert_eq!(status, Some(0));
    let fit = find(&found, "fit");
    let number = |name: &str| fit["parameters"][name].as_f64().expect("a number");
    assert!(number("r") == 1.0 && (number("s") - 3.0).abs() < 1e-4, "{fit}");
    assert_eq!((&fit["at_ends"], &fit["goal"]), (&json!(["r"]), &json!("minimise")));
    assert!((fit["before"].as_f64().expect("a number") - 1501.0).abs() < 1e-6, "{fit}");
    assert!(fit["runs"].as_u64().expect("a count") > 10 && fit["seconds"].is_number(), "{fit}");
    // Who reads objects need not read prose.
    let prose = found.iter().filter(|object| object["type"] == "note");
    assert!(prose.clone().all(|note| !note["message"].to_string().contains("runs")), "{found:?}");
    let listed = &find(&found, "list")["traces"][0];
    let traced = &find(&found, "traces")["traces"][0];
    assert_eq!((&listed["label"], &traced["label"]), (&json!("half"), &json!("half")));
    let measured = &find(&found, "measures")["measures"][0];
    assert_eq!((&measured["name"], &measured["unit"]), (&json!("d"), &json!("ms")));
    let column = |name: &str| measured[name].as_array().expect("a column").clone();
    assert_eq!((column("time").len(), column("value").len()), (2, 2));
    assert!((column("value")[1].as_f64().expect("a number") - 1500.0).abs() < 1e-6);
}

#[test]
fn what_examines_a_script_says_an_object_a_line() {
    for command in ["check", "effects", "accuracy"] {
        let (_, found) = objects(&[command, "--json", "-q", "four-bar.link"], "");
        assert!(!found.is_empty() && (command == "accuracy" || found.len() == 1), "{found:?}");
        for object in &found {
            assert_eq!((&object["type"], &object["version"]), (&json!(command), &json!(1)));
        }
    }
}

#[test]
fn a_script_that_fails_is_an_object_to_those_who_examine_it() {
    let folder = folder(&[("wrong.link", "point A = (0, 0)\nlenght A B\n")]);
    for command in ["check", "effects", "accuracy"] {
        let out = run(folder.path(), &[command, "--json", "wrong.link"], "");
        assert_eq!((out.status.code(), &*text(&out.stderr)), (Some(2), ""), "of {command}");
        let error: Value = serde_json::from_str(&text(&out.stdout)).expect("an object");
        let place = &error["places"][0];
        assert_eq!((&error["type"], &error["version"]), (&json!("error"), &json!(1)));
        assert_eq!((&error["code"], &place["line"]), (&json!("E0101"), &json!(2)));
    }
    let (status, found) = objects(&["run", "--json", "four-bar.link", "--set", "nobody=1"], "");
    let last = found.last().expect("objects");
    assert_eq!((status, &last["type"], &last["code"]), (Some(2), &json!("error"), &json!("E0201")));
    let openings = found.iter().filter(|object| object["type"] == "linkwork");
    assert_eq!(openings.count(), 1);
}

#[test]
fn requests_are_answered_up_to_done() {
    let requests = [
        json!({ "id": 7, "run": format!("{FOUR_BAR}trace B; set dt 1/4; step 4\nprint time") }),
        json!({ "id": "t", "get": "traces" }),
        json!({ "id": null, "run": "let r = 2\nlenght A B\nlet r = 3" }),
        json!({ "run": "print r; for i in 1..3 {" }),
        json!({ "get": "nothing" }),
        json!({ "id": 1 }),
    ];
    let lines = requests.map(|request| format!("{request}\n")).concat();
    let (status, found) = objects(&["--json"], &format!("{lines}{{\"run\"\nprint r\n"));
    assert_eq!(status, Some(2));
    let done: Vec<(&Value, &Value)> = found
        .iter()
        .filter(|object| object["type"] == "done")
        .map(|object| (&object["id"], &object["ok"]))
        .collect();
    let (yes, no, null) = (json!(true), json!(false), Value::Null);
    let (seven, t, one) = (json!(7), json!("t"), json!(1));
    let wanted = [
        (&seven, &yes),
        (&t, &yes),
        (&null, &no),
        (&null, &no),
        (&null, &no),
        (&one, &no),
        (&null, &no),
    ];
    assert_eq!(done, wanted);
    let trace = &find(&found, "traces")["traces"][0];
    assert_eq!(trace["ended"], false);
    assert_eq!((&trace["point"], trace["x"].as_array().map(Vec::len)), (&json!("B"), Some(4)));
    assert_eq!(found.iter().filter(|object| object["code"] == "E0120").count(), 3);
    // Up to the mistake, and no farther.
    let last = found.iter().rev().find(|object| object["type"] == "print").expect("a line");
    assert_eq!(last["text"], "2");
}

#[test]
fn lines_are_counted_through_requests() {
    let input = "point Z = (1, 2)\n{\"run\": \"print 1\\nprint 2\"}\nnonsense\n";
    let (_, found) = objects(&["--json"], input);
    let place = &find(&found, "error")["places"][0];
    assert_eq!(place["line"], 3, "{place}");
}

#[test]
fn a_dead_point_and_a_miss_are_data() {
    let script = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (0, 2), C = (3, 2)
        crank: motor A B radius 2 speed 1rev; length B C = 3; length C D = 1.5
        solve; set dt 1/36; step 36";
    let (_, found) = objects(&["--json", "-e", script], "");
    let halt = find(&found, "halt");
    assert_eq!((&halt["driver"], &halt["why"]), (&json!("crank"), &json!("dead-point")));
    // The crank is at its end where coupler and rocker lie in one line: the law of cosines.
    let cosine: f64 = (4.0 + 16.0 - 4.5 * 4.5) / 16.0;
    let angle = halt["angle"].as_f64().expect("a number");
    assert!((angle.cos() - cosine).abs() < 1e-6, "{angle}");
    let receipt = find(&found, "receipt");
    assert!(receipt["missed"].as_u64().expect("a count") > 0);
    assert!(receipt["first_missed"].as_u64().expect("a frame") > 0);
}

#[test]
fn the_example_of_the_page_is_what_is_said() {
    let page = include_str!("../../docs/json.md");
    let (_, example) = page.split_once("```console\n").expect("the example");
    let (example, _) = example.split_once("```").expect("its end");
    let wanted: Vec<Value> = example
        .lines()
        .filter(|line| line.starts_with('{'))
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let args = ["--json", "-e", "point A = (0, 0), B = (3, 4)", "-e", "distance(A, B)"];
    let (_, mut found) = objects(&args, "");
    found[0]["release"] = wanted[0]["release"].clone();
    assert_eq!(found, wanted);
}

#[test]
fn a_path_says_whether_it_grows() {
    let requests = format!(
        "{FOUR_BAR}trace C as \"before\"; step 2; trace C as \"after\"; step 2; list traces\n\
         {{\"get\": \"traces\"}}\n"
    );
    let (_, found) = objects(&["--json"], &requests);
    for kind in ["list", "traces"] {
        let traces = find(&found, kind)["traces"].as_array().expect("traces").clone();
        let told: Vec<_> =
            traces.iter().map(|it| (it["label"].clone(), it["ended"].clone())).collect();
        let wanted = [(json!("before"), json!(true)), (json!("after"), json!(false))];
        assert_eq!(told, wanted, "of {kind}");
    }
}
