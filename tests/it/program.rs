//! The program as a shell sees it: arguments, exit statuses, pipes, signals, files.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::support::program::{PROGRAM, folder, run, text};

/// A script in batch: its exit status, what it answers, and a part of what it says.
fn check(script: &str, status: i32, answer: &str, says: &str) {
    let folder = folder(&[("a.link", script)]);
    let out = run(folder.path(), &["run", "a.link"], "");
    let said = text(&out.stderr);
    assert_eq!(out.status.code(), Some(status), "of {script:?}: {said}");
    assert_eq!(text(&out.stdout), answer, "of {script:?}");
    assert!(said.contains(says), "of {script:?}: {said}");
}

#[test]
fn exit_statuses_say_how_a_batch_went() {
    check("print 1\n", 0, "1\n", "");
    check("assert 1 = 2\nprint 3", 1, "", "a.link:1:1");
    check("print 1\nlenght A B\nprint 2", 2, "1\n", "did you mean `length`?");
    check("include \"b.link\"", 3, "", "no such file");
    check("point A = (0, 0)\nsvg \"a.link/x.svg\"", 3, "", "cannot write `a.link/x.svg`");
    check("svg \"a.link/x.svg\"", 3, "", "a file is where a folder has to be");
    check("quit\nprint 1", 0, "", "");
    check(
        "point A = (0, 0) frozen, B = (1, 0) frozen\nlength A B = 2\nstep within 1e-9",
        1,
        "",
        "did not reach",
    );
    let folder = folder(&[]);
    let out = run(folder.path(), &["run", "missing.link"], "");
    assert_eq!(out.status.code(), Some(3));
    assert_eq!(
        text(&out.stderr),
        "error[E0701]: cannot read `missing.link`: no such file or folder\n"
    );
    assert_eq!(run(folder.path(), &["run"], "").status.code(), Some(2));
    assert_eq!(run(folder.path(), &["--version"], "").status.code(), Some(0));
}

#[test]
fn a_file_a_text_and_standard_input_run_without_a_command() {
    let folder = folder(&[("a.link", "let r = 3\nr"), ("b.link", "let r = 4\nr")]);
    let answers = |args: &[&str], input: &str| {
        let out = run(folder.path(), args, input);
        assert_eq!(out.status.code(), Some(0), "{args:?}: {}", text(&out.stderr));
        text(&out.stdout)
    };
    assert_eq!(answers(&["a.link", "b.link"], ""), "3\n4\n");
    assert_eq!(answers(&["-"], "1 + 2"), "3\n");
    assert_eq!(answers(&["-e", "let s = 2", "-e", "-s, \"two\""], ""), "-2 two\n");
    // In the world of the last file.
    assert_eq!(answers(&["a.link", "b.link", "-e", "2 * r"], ""), "3\n4\n8\n");
    // Without a terminal the session reads a pipe.
    assert_eq!(answers(&["-i", "a.link"], "r + 1\n"), "3\n4\n");
    // Options stand before the command or behind it, and those of a list add up.
    for args in [&["--set", "r=5", "run", "a.link"][..], &["a.link", "--set", "r=5"]] {
        assert_eq!(answers(args, ""), "5\n");
    }
    let both = ["--set", "r=5", "run", "-e", "let r = 1, s = 1; r, s", "--set", "s=6"];
    assert_eq!(answers(&both, ""), "5 6\n");
}

#[test]
fn mistakes_on_the_command_line_say_what_was_meant() {
    let folder = folder(&[("crank.link", "")]);
    let check = |args: &[&str], status: i32, says: &str| {
        let out = run(folder.path(), args, "");
        let said = text(&out.stderr);
        assert_eq!(out.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(says), "{args:?}: {said}");
    };
    check(&["chek"], 3, "did you mean the command `check`?");
    check(&["cronk.link"], 3, "did you mean the file `crank.link`?");
    check(&["crank"], 3, "did you mean the file `crank.link`?");
    check(&["-e", "nonsense here"], 2, "<argument>:1:1");
    check(&["-e", "assert 1 = 2"], 1, "assertion failed");
    check(&["-e", "quit; nonsense"], 0, "");
    check(&["-i", "run", "crank.link"], 2, "stand behind the command");
    check(&["help", "moter"], 2, "did you mean `motor`?");
    check(&["examples", "fourbar"], 2, "did you mean `four-bar`?");
}

#[test]
fn help_and_examples_come_with_the_program() {
    let folder = folder(&[]);
    let answer = |args: &[&str]| {
        let out = run(folder.path(), args, "");
        assert_eq!(out.status.code(), Some(0), "{args:?}: {}", text(&out.stderr));
        text(&out.stdout)
    };
    assert!(answer(&["help", "motor"]).starts_with("motor O P"));
    // The one of the shell, and the one of the language.
    let run_help = answer(&["help", "run"]);
    assert!(run_help.contains("linkwork run") && run_help.contains("run TIME"), "{run_help}");
    assert!(answer(&["help"]).contains("change a setting, or print them"));
    let list = answer(&["examples"]);
    assert!(list.contains("four-bar ") && list.contains("crankshaft "), "{list}");
    assert!(answer(&["examples", "four-bar"]).starts_with("# The coupler curve"));
    // What an example includes comes with the program too.
    answer(&["examples", "klann", "--run", "--out", "out", "-q"]);
    assert!(folder.path().join("out").exists());
}

#[test]
fn standard_input_is_a_script_too() {
    let folder = folder(&[("lib/leg.link", "print \"leg\"")]);
    let out = run(folder.path(), &["run", "-"], "include \"lib/leg.link\"\nnonsense\nprint 2");
    assert_eq!(out.status.code(), Some(2));
    assert_eq!(text(&out.stdout), "leg\n");
    assert!(text(&out.stderr).contains("<stdin>:2:1"));
}

#[test]
fn a_byte_order_mark_is_no_column() {
    let folder = folder(&[("a.link", "\u{feff}nonsense")]);
    for arguments in [&["run", "a.link"][..], &["run", "-"], &[]] {
        let out = run(folder.path(), arguments, "\u{feff}nonsense");
        assert!(text(&out.stderr).contains(":1:1\n"), "{}", text(&out.stderr));
    }
}

#[test]
fn a_pipe_goes_on_after_a_mistake_as_a_terminal_would() {
    let folder = folder(&[]);
    let typed =
        "let r = 2\nprint s; print \"left out\"\n)\nprint r\nfor i in 1..2 {\n  print i\n}\n";
    let out = run(folder.path(), &[], typed);
    assert_eq!(out.status.code(), Some(2));
    assert_eq!(text(&out.stdout), "2\n1\n2\n");
    let said = text(&out.stderr);
    assert!(said.contains("<stdin>:2:7") && said.contains("<stdin>:3:1"), "{said}");
    let out = run(folder.path(), &[], "print 1\nquit\nprint 2");
    assert_eq!((out.status.code(), text(&out.stdout)), (Some(0), "1\n".to_owned()));
    let out = run(folder.path(), &[], "print (1,\n  2");
    assert_eq!(out.status.code(), Some(2));
    let out = run(folder.path(), &[], "assert 1 = 2\nnonsense\nprint 3");
    assert_eq!((out.status.code(), text(&out.stdout)), (Some(1), "3\n".to_owned()));
    let out = run(folder.path(), &[], "include \"none.link\"\nassert 1 = 2");
    assert_eq!(out.status.code(), Some(3));
}

#[test]
fn a_pipe_is_answered_line_by_line() {
    let folder = folder(&[]);
    let mut command = Command::new(PROGRAM);
    let mut child = command
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("it is piped");
    let mut answers = BufReader::new(child.stdout.take().expect("it is piped"));
    for k in 0..3 {
        writeln!(stdin, "print {k} + 1").expect("it reads");
        let mut line = String::new();
        answers.read_line(&mut line).expect("it answers");
        assert_eq!(line, format!("{}\n", k + 1));
    }
    drop(stdin);
    assert!(child.wait().expect("it ends").success());
}

#[test]
fn a_value_from_outside_is_unused_only_where_no_file_takes_it() {
    let folder = folder(&[
        ("a.link", "let r = 3\nprint r"),
        ("b.link", "let s = 3\nprint s"),
        ("c.link", "print 1"),
    ]);
    let set = ["--set", "r=5", "--set", "s=6", "--set", "t=7"];
    let refused = |files: &[&str]| -> Vec<String> {
        let out = run(folder.path(), &[&["run"], files, &set[..]].concat(), "");
        assert_eq!(out.status.code(), Some(2));
        let is_named = |name: &&str| {
            text(&out.stderr).matches(&format!("no `let` declares `{name}`")).count() == 1
        };
        ["r", "s", "t"].iter().filter(|name| is_named(name)).map(ToString::to_string).collect()
    };
    assert_eq!(refused(&["a.link"]), ["s", "t"]);
    assert_eq!(refused(&["a.link", "b.link"]), ["t"]);
    assert_eq!(refused(&["b.link", "a.link", "c.link"]), ["t"]);
    assert_eq!(refused(&["c.link", "b.link", "b.link"]), ["r", "t"]);
    assert_eq!(refused(&["c.link", "c.link"]), ["r", "s", "t"]);
}

#[test]
fn a_value_from_outside_that_no_script_declares_is_a_mistake() {
    let folder = folder(&[
        ("a.link", "let width = 3\npoint A = (0, 0)\nprint width"),
        ("b.link", "include \"a.link\""),
    ]);
    let with = |args: &[&str], input: &str| {
        let out = run(folder.path(), args, input);
        let said = text(&out.stderr) + &text(&out.stdout);
        (out.status.code().expect("it ends"), said)
    };
    let refuses = |args: &[&str], wanted: &str| {
        let (status, said) = with(args, "");
        assert_eq!(status, 2, "{args:?}: {said}");
        assert!(said.contains(wanted), "{args:?}: {said}");
    };
    for command in ["run", "check", "effects"] {
        refuses(&[command, "a.link", "--set", "widht=5"], "did you mean `width`?");
        refuses(&[command, "a.link", "--json", "--set", "q=5"], "the script declares width");
        assert_eq!(with(&[command, "b.link", "--set", "width=5"], "").0, 0);
    }
    refuses(&["-e", "print 1", "--set", "q=5"], "`let q = 1` in the script declares it");
    refuses(&["run", "-q", "a.link", "--set", "q=5"], "no `let` declares `q`");
    refuses(
        &["examples", "four-bar", "--run", "--set", "nothing=1"],
        "no `let` declares `nothing`",
    );
    // What the script did before stays, and what it printed.
    assert!(with(&["a.link", "--set", "q=1"], "").1.contains("3\n"));
    // A session may declare it yet.
    for args in [&["--set", "q=1"][..], &["-i", "a.link", "--set", "q=1"]] {
        let (status, said) = with(args, "let q = 2\nprint q\n");
        assert_eq!(status, 0, "{said}");
        assert!(said.ends_with("1\n") && !said.contains("declares"), "{said}");
    }
}

#[test]
fn values_from_outside_win_over_a_let() {
    let folder = folder(&[("a.link", "let r = 3, s = 2 * r\nprint r, s\nlet r = 4\nprint r")]);
    let out = run(folder.path(), &["run", "a.link", "--set", "r=90deg / 2"], "");
    assert_eq!(text(&out.stdout), "0.7853981633974483 1.5707963267948966\n0.7853981633974483\n");
    for wrong in ["r", "r=", "=3", "r=s", "r=1; print 2", "r=1, s=2", "1=2", "r=(1, 2)"] {
        let out = run(folder.path(), &["run", "a.link", "--set", wrong], "");
        assert_eq!(out.status.code(), Some(2), "for {wrong:?}");
    }
}

#[test]
fn files_are_included_beside_who_includes_them_and_written_below_the_output_folder() {
    let folder = folder(&[
        ("scripts/a.link", "include \"parts/b.link\"\nsvg \"now.svg\"\nsave \"s/kept.link\""),
        ("scripts/parts/b.link", "include \"c.link\""),
        ("scripts/parts/c.link", "point A = (1, 2)"),
        ("scripts/later.link", "load \"s/kept.link\"\nprint A"),
        ("up.link", "svg \"../x.svg\""),
    ]);
    let out = run(folder.path(), &["run", "scripts/a.link", "--out", "out/deep"], "");
    assert_eq!(out.status.code(), Some(0), "{}", text(&out.stderr));
    let written = folder.path().join("out/deep");
    assert!(fs::read_to_string(written.join("now.svg")).expect("a picture").starts_with("<svg"));
    assert!(written.join("s/kept.link").exists() && !folder.path().join("s").exists());
    assert_eq!(fs::read_dir(&written).expect("a folder").count(), 2, "nothing is left behind");
    let out = run(folder.path(), &["run", "scripts/later.link", "--out", "out/deep"], "");
    assert_eq!(text(&out.stdout), "(1, 2)\n");
    let args = ["run", "up.link", "--out", "out"];
    assert_eq!(run(folder.path(), &args, "").status.code(), Some(2));
    assert!(!folder.path().join("x.svg").exists());
    let out = run(folder.path(), &["run", "up.link", "--out", "out", "--allow-any-path"], "");
    assert_eq!(out.status.code(), Some(0), "{}", text(&out.stderr));
    assert!(folder.path().join("x.svg").exists());
}

/// A crank that turns by 45 degrees a frame, recorded in all three ways.
const RECORDED: &str = "
    point A = (0, 0) frozen, B = (1, 0)
    motor A B speed 1rev
    set dt 1/8
    trace B
    record \"paths.csv\" every 2
    record \"frames/\" every 4
    record \"motion.svg\"
    step 8
";

#[test]
fn recordings_are_written_by_the_end_of_the_script_and_after_a_mistake() {
    for (ending, status) in
        [("", 0), ("record stop", 0), ("nonsense", 2), ("clear", 0), ("quit", 0)]
    {
        let folder = folder(&[("a.link", &format!("{RECORDED}\n{ending}"))]);
        let out = run(folder.path(), &["run", "a.link"], "");
        assert_eq!(out.status.code(), Some(status));
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect("it is there");
        let table = read("paths.csv");
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines.len(), 5, "after {ending:?}: {table}");
        assert_eq!(lines[0], "time,B.x,B.y");
        assert!(lines[4].starts_with("1,"));
        assert!(read("motion.svg").starts_with("<svg"));
        let frames = fs::read_dir(folder.path().join("frames")).expect("frames").count();
        assert_eq!(frames, 2);
        assert!(read("frames/frame-0001.svg").starts_with("<svg"));
    }
}

#[test]
fn the_same_script_writes_the_same_bytes() {
    let folder = folder(&[("a.link", RECORDED)]);
    let written = |out: &str| {
        run(folder.path(), &["run", "a.link", "--out", out], "");
        let file = |name| fs::read(folder.path().join(out).join(name)).expect("it is there");
        ["paths.csv", "motion.svg", "frames/frame-0000.svg"].map(file)
    };
    assert!(written("one") == written("two"));
}

#[test]
fn any_number_of_cores_gives_the_same_bits() {
    // Many islands, and one with many constraints.
    let islands = "for i in 1..1400 {
           point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
           point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
           motor A[i] B[i] radius 1 speed (1 + i / 7)
           length B[i] C[i] = 3.5; length C[i] D[i] = 3
         }
         set dt 1/360; step 3";
    let sheet = "for i in 0..72 { for j in 0..72 { point p[i][j] = (i, j) } }
         for i in 0..72 { for j in 1..72 {
           length p[i][j-1] p[i][j] = 1; length p[j-1][i] p[j][i] = 1
         } }
         for i in 1..72 { for j in 1..72 {
           length p[i-1][j-1] p[i][j] = sqrt(2); length p[i-1][j] p[i][j-1] = 1.4
         } }
         freeze p[0][0], p[72][3]
         drag p[0][0] to (0.1, 0.05) over 1";
    let scenes = [
        islands.to_owned(),
        format!("set method relaxation; {islands}"),
        format!("set method relaxation; set iterations 2; {sheet}"),
    ];
    for scene in scenes {
        let folder = folder(&[("a.link", &format!("{scene}\nsave \"end.link\""))]);
        let [one, many] = ["1", "3"].map(|n| {
            let out = run(folder.path(), &["run", "--threads", n, "a.link"], "");
            assert!(out.status.success(), "{}", text(&out.stderr));
            fs::read(folder.path().join("end.link")).expect("it was saved")
        });

        assert!(one == many, "of {scene}");
    }
}

#[test]
fn nothing_is_coloured_on_a_pipe() {
    let folder = folder(&[]);
    let out = run(folder.path(), &["run", "-"], "solve\nlenght A B");
    assert!(!text(&out.stderr).contains('\u{1b}'));
}

#[cfg(unix)]
mod unix {
    use super::*;

    /// Starts a script that says when it is about to run for ever.
    fn endless(folder: &Path) -> std::process::Child {
        Command::new(PROGRAM)
            .current_dir(folder)
            .args(["run", "a.link"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts")
    }

    /// Runs a script until so many milliseconds after it wrote `begun.svg`.
    fn interrupted(folder: &Path, after: u64) -> Output {
        let child = endless(folder);
        while !folder.join("begun.svg").exists() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        std::thread::sleep(std::time::Duration::from_millis(after));
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(interrupt.expect("there is a kill").success());
        let out = child.wait_with_output().expect("it ends");
        assert_eq!(out.status.code(), Some(130), "{}", text(&out.stderr));
        out
    }

    #[test]
    fn ctrl_c_stops_between_frames_and_keeps_what_was_recorded() {
        let script = format!("{RECORDED}\nsvg \"begun.svg\"\nstep 1e9\nprint \"never\"");
        let folder = folder(&[("a.link", &script)]);
        let out = interrupted(folder.path(), 20);
        let said = text(&out.stderr);
        assert!(said.contains("of 1000000000 frames"), "{said}");
        assert_eq!(text(&out.stdout), "");
        assert!(folder.path().join("paths.csv").exists());
    }

    fn send(signal: &str, to: &std::process::Child) {
        let sent = Command::new("kill").args([signal, &to.id().to_string()]).status();
        assert!(sent.expect("there is a kill").success());
    }

    fn wait_for(file: &Path) {
        while !file.exists() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    }

    #[test]
    fn who_asks_it_to_end_gets_what_was_recorded() {
        for (signal, status) in [("-TERM", 143), ("-HUP", 129)] {
            let script = format!("{RECORDED}\nsvg \"begun.svg\"\nstep 1e9\nprint \"never\"");
            let folder = folder(&[("a.link", &script)]);
            let child = endless(folder.path());
            wait_for(&folder.path().join("begun.svg"));
            send(signal, &child);
            let out = child.wait_with_output().expect("it ends");
            assert_eq!(out.status.code(), Some(status), "{}", text(&out.stderr));
            assert_eq!(text(&out.stdout), "");
            assert!(folder.path().join("paths.csv").exists(), "{signal}");
        }
    }

    #[test]
    fn a_session_in_objects_ends_in_order_too_and_does_nothing_more() {
        for signal in ["-TERM", "-HUP"] {
            let folder = folder(&[]);
            let mut child = Command::new(PROGRAM)
                .current_dir(folder.path())
                .args(["--json", "--no-journal"])
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .spawn()
                .expect("the program starts");
            let mut input = child.stdin.take().expect("piped");
            let lines = format!(
                "{RECORDED}\nsvg \"begun.svg\"\nstep 1e9\nsvg \"late.svg\"\n\
                 {{\"run\": \"svg \\\"later.svg\\\"\"}}"
            );
            writeln!(input, "{lines}").expect("it reads");
            wait_for(&folder.path().join("begun.svg"));
            send(signal, &child);
            let out = child.wait_with_output().expect("it ends");
            let said = text(&out.stdout);
            let status = if signal == "-TERM" { 143 } else { 129 };
            assert_eq!(out.status.code(), Some(status), "{said}");
            assert!(folder.path().join("paths.csv").exists(), "{said}");
            assert!(!folder.path().join("late.svg").exists(), "{said}");
            assert!(!folder.path().join("later.svg").exists(), "{said}");
        }
    }

    #[test]
    fn in_objects_ctrl_c_stops_a_run_and_in_a_session_the_statement_alone() {
        let script = format!("{RECORDED}\nsvg \"begun.svg\"\nstep 1e9\nprint \"then\"");
        for (args, status) in [(&["run", "--json", "a.link"][..], 130), (&["--json"], 0)] {
            let folder = folder(&[("a.link", &script)]);
            let mut child = Command::new(PROGRAM)
                .current_dir(folder.path())
                .env("HOME", folder.path())
                .args(args)
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .spawn()
                .expect("the program starts");
            let mut input = child.stdin.take().expect("piped");
            writeln!(input, "{script}").expect("it reads");
            wait_for(&folder.path().join("begun.svg"));
            std::thread::sleep(std::time::Duration::from_millis(50));
            send("-INT", &child);
            std::thread::sleep(std::time::Duration::from_millis(50));
            drop(input);
            let out = child.wait_with_output().expect("it ends");
            let said = text(&out.stdout);
            assert_eq!(out.status.code(), Some(status), "{said}");
            let step =
                said.lines().find(|line| line.contains("\"text\":\"step 1e9\"")).expect("it");
            // What it did stays.
            assert!(step.contains("\"ok\":true"), "{step}");
            assert_eq!(said.contains("\"text\":\"then\""), status == 0, "{said}");
        }
    }

    #[test]
    fn a_session_that_waits_for_input_ends_in_order_when_it_is_asked_to() {
        let folder = folder(&[]);
        let mut child = Command::new(PROGRAM)
            .current_dir(folder.path())
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut input = child.stdin.take().expect("piped");
        writeln!(input, "{RECORDED}\nstep 3\nsvg \"begun.svg\"").expect("it reads");
        wait_for(&folder.path().join("begun.svg"));
        send("-TERM", &child);
        let out = child.wait_with_output().expect("it ends");
        assert_eq!(out.status.code(), Some(143), "{}", text(&out.stderr));
        assert!(folder.path().join("paths.csv").exists());
    }

    #[test]
    fn ctrl_c_ends_whatever_takes_long() {
        let net = "for i in 1..70 { for k in 1..70 { point p[i][k] = (i + 0.01 * sin(k), k) } }
            for i in 2..70 { for k in 1..70 { length p[i - 1][k] p[i][k] = 1 } }
            for i in 1..70 { for k in 2..70 { length p[i][k - 1] p[i][k] = 1 } }
            freeze p[1][1] p[70][1]";
        for (before, statement) in [
            ("", "for i in 1..1e7 {}; for i in 1..1e7 {}; for i in 1..1e7 {}; for i in 1..1e7 {}"),
            (net, "check"),
            (net, "solve"),
        ] {
            let script = format!("{before}\nsvg \"begun.svg\"\n{statement}\nprint \"never\"");
            let folder = folder(&[("a.link", &script)]);
            let out = interrupted(folder.path(), 50);
            assert_eq!(text(&out.stdout), "", "{statement}");
            assert!(text(&out.stderr).contains("stopped"), "{statement}");
        }
    }

    #[test]
    fn ctrl_c_ends_a_frame_of_very_many_iterations() {
        let script = "point p[0] = (0, 0) frozen
            for i in 1..3000 { point p[i] = (i, 0); length p[i-1] p[i] = 1.001 }
            freeze p[3000]
            set method relaxation
            set iterations 1e9
            svg \"begun.svg\"
            step 1000";
        let folder = folder(&[("a.link", script)]);
        let said = text(&interrupted(folder.path(), 300).stderr);
        assert!(said.contains("stopped after 1 of 1000 frames"), "{said}");
    }

    #[test]
    fn a_reader_that_goes_away_leaves_the_rest_to_be_done() {
        for (end, status) in [("", 0), ("assert 1 = 2", 1), ("nonsense", 2)] {
            let script = format!("for i in 1..100000 {{ print i }}\nsvg \"late.svg\"\n{end}");
            let folder = folder(&[("a.link", &script)]);
            let mut child = endless(folder.path());
            let mut line = String::new();
            let answers = child.stdout.take().expect("piped");
            BufReader::new(answers).read_line(&mut line).expect("a line");
            assert_eq!(line, "1\n");
            let out = child.wait_with_output().expect("it ends");
            let said = text(&out.stderr);
            assert_eq!(out.status.code(), Some(status), "{said}");
            assert!(said.starts_with("note: wrote late.svg\n"), "{said}");
            assert_eq!(said.lines().count() == 1, status == 0, "{said}");
            assert!(folder.path().join("late.svg").exists(), "before {end:?}");
        }
    }

    #[test]
    fn an_answer_that_cannot_be_written_is_a_failure_told_once() {
        let Ok(full) = fs::File::options().write(true).open("/dev/full") else { return };
        let script = "for i in 1..100000 { print i }\nsvg \"late.svg\"";
        let folder = folder(&[("a.link", script)]);
        let out = Command::new(PROGRAM)
            .current_dir(folder.path())
            .args(["run", "a.link"])
            .stdout(full)
            .output()
            .expect("the program starts");
        assert_eq!(out.status.code(), Some(3));
        assert_eq!(text(&out.stderr).matches("cannot write the answer").count(), 1);
        assert!(folder.path().join("late.svg").exists());
    }
}

#[test]
fn what_is_quoted_gives_a_terminal_no_orders() {
    let order = "\u{1b}[2J\u{7}\u{9b}";
    let folder = folder(&[]);
    let missing = format!("{order}.link");
    for args in
        [&["run", &missing][..], &[&format!("--{order}")], &["run", "a", "--threads", order]]
    {
        let out = run(folder.path(), args, "");
        let said = text(&out.stderr);
        assert!(!said.is_empty() && !said.contains(['\u{1b}', '\u{7}', '\u{9b}']), "{said:?}");
    }
    let typed = format!("include \"{order}\"\nhelp {order}\nsave \"{order}/\"\nprint \"{order}\"");
    let out = run(folder.path(), &[], &typed);
    let said = text(&out.stderr);
    assert!(said.contains('\u{fffd}') && !said.contains(['\u{1b}', '\u{7}']), "{said:?}");
    assert_eq!(text(&out.stdout), format!("{order}\n"), "a program gets what was printed");
}
