//! Files that the program reads and writes: whose they are, where they lie, and that they are whole.

use std::fs;
use std::path::Path;

use crate::support::program::{folder, run, text};

/// Files of others, by the name that a statement would give them.
const FOREIGN: [(&str, &[u8]); 7] = [
    ("photo.jpg", b"\xff\xd8\xff"),
    ("notes.txt", b"na\xefve\n"),
    ("mine.link", b"point A = (1, 2)  # by hand\n"),
    ("drawing.svg", b"<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n"),
    ("measured.csv", b"time,x,y\n0,1,2\n"),
    ("accuracy.csv", b"method,error\n"),
    ("frames/frame-0000.svg", b"<?xml version=\"1.0\"?>\n"),
];

/// A scene in which something moves.
const SCENE: &str = "point A = (0, 0) frozen, B = (1, 0)\nmotor A B speed 1rev\ntrace B\n";

fn script_and(statements: &str) -> String {
    format!("{SCENE}{statements}\n")
}

#[test]
fn files_of_others_survive() {
    for (statement, name) in [
        ("save \"photo.jpg\"", "photo.jpg"),
        ("save \"notes.txt\"", "notes.txt"),
        ("save \"mine.link\"", "mine.link"),
        ("svg \"mine.link\"", "mine.link"),
        ("svg \"drawing.svg\"", "drawing.svg"),
        ("sample \"a\" = 1; plot \"drawing.svg\"", "drawing.svg"),
        ("record \"drawing.svg\"", "drawing.svg"),
        ("record \"measured.csv\"", "measured.csv"),
        ("record \"frames/\"", "frames/frame-0000.svg"),
        ("accuracy", "accuracy.csv"),
    ] {
        let folder = folder(&[]);
        for (name, bytes) in FOREIGN {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, bytes).expect("a file");
        }
        let out = run(folder.path(), &["run", "-"], &script_and(&format!("{statement}\nstep 3")));
        assert_eq!(out.status.code(), Some(2), "of {statement}: {}", text(&out.stderr));
        let said = text(&out.stderr);
        let why = if statement == "svg \"mine.link\"" { "`.svg`" } else { "did not write it" };
        assert!(said.contains(why) && said.contains(":4:"), "of {statement}: {said}");
        for (name, bytes) in FOREIGN {
            let kept = fs::read(folder.path().join(name)).expect("it is still there");
            assert!(kept == bytes, "{statement} took {name}");
        }
        if !statement.starts_with("svg \"mine") {
            let forced = ["run", "--force", "-"];
            let out = run(folder.path(), &forced, &script_and(&format!("{statement}\nstep 3")));
            assert_eq!(out.status.code(), Some(0), "of {statement}: {}", text(&out.stderr));
            let (_, old) = FOREIGN.iter().find(|(known, _)| *known == name).expect("one of them");
            let new = fs::read(folder.path().join(name)).expect("it is there");
            assert!(new != *old, "{statement} with --force");
        }
    }
}

#[test]
fn a_script_writes_its_own_files_again() {
    let all = "save \"s.link\"; save \"s\"; svg \"s.svg\"; sample \"a\" = 1; plot \"p.SVG\"
        record \"frames/\"; record \"m.svg\"; record \"t.csv\"; step 3; record stop; step 3; accuracy";
    let folder = folder(&[("a.link", &script_and(all))]);
    for _ in 0..2 {
        let out = run(folder.path(), &["run", "a.link", "--out", "out"], "");
        assert_eq!(out.status.code(), Some(0), "{}", text(&out.stderr));
    }
    // A point more is traced, and a file is empty.
    fs::write(folder.path().join("out/s.svg"), "").expect("a file");
    let more = script_and("trace A\nrecord \"t.csv\"; step 3; svg \"s.svg\"");
    let out = run(folder.path(), &["run", "-", "--out", "out"], &more);
    assert_eq!(out.status.code(), Some(0), "{}", text(&out.stderr));
    let table = fs::read_to_string(folder.path().join("out/t.csv")).expect("a table");
    assert!(table.starts_with("time,B.x,B.y,A.x,A.y\n"), "{table}");
}

#[test]
fn endings_say_what_is_written() {
    for statement in
        ["svg \"a.csv\"", "svg \"a\"", "plot \"a.link\"", "save \"a.svg\"", "save \"a.CSV\""]
    {
        let folder = folder(&[]);
        let out = run(folder.path(), &["run", "-"], &format!("sample \"a\" = 1\n{statement}"));
        assert_eq!(out.status.code(), Some(2), "of {statement}: {}", text(&out.stderr));
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "of {statement}");
    }
}

#[test]
fn reads_stay_below_the_folder_of_the_script() {
    let folder = folder(&[
        ("secret.link", "print \"secret\""),
        ("own/lib/leg.link", "include \"../foot.link\""),
        ("own/foot.link", "print \"foot\""),
        ("own/up.link", "include \"../secret.link\""),
        ("own/leg.link", "include \"lib/leg.link\""),
        ("own/load.link", "load \"../secret.link\""),
        ("own/near.link", "include \"secret.link\""),
        ("own/out-is-not-there.link", "include \"../secret.link\""),
    ]);
    let absolute = format!("include \"{}\"", folder.path().join("secret.link").display());
    fs::write(folder.path().join("own/absolute.link"), absolute).expect("a script");
    let check = |args: &[&str], status: i32, answer: &str| {
        let out = run(folder.path(), &[&["run"], args].concat(), "");
        assert_eq!(out.status.code(), Some(status), "of {args:?}: {}", text(&out.stderr));
        assert_eq!(text(&out.stdout), answer, "of {args:?}");
    };
    check(&["own/leg.link", "--out", "x"], 0, "foot\n");
    for name in ["own/up.link", "own/load.link", "own/absolute.link"] {
        check(&[name, "--out", "x"], 2, "");
        check(&[name, "--allow-any-path"], 0, "secret\n");
        check(&[name, "--out", "x", "-I", "."], 0, "secret\n");
    }
    check(&["own/near.link", "--out", "x"], 3, "");
    check(&["own/near.link", "--out", "x", "-I", "own/lib", "-I", "."], 0, "secret\n");
    // At a prompt, where one is is the folder.
    let typed = |text: &str| run(&folder.path().join("own"), &[], text).status.code();
    assert_eq!(
        (typed("include \"foot.link\""), typed("include \"../secret.link\"")),
        (Some(0), Some(2))
    );
}

#[test]
fn what_is_no_script_is_not_shown() {
    let folder = folder(&[("key.txt", "PASSWORD=swordfish\n"), ("more.txt", "print 1\nswordfish")]);
    let said = |text_in: &str| text(&run(folder.path(), &["run", "-"], text_in).stderr);
    for statement in ["include \"key.txt\"", "load \"key.txt\""] {
        let told = said(statement);
        assert!(told.contains("key.txt` is no script") && !told.contains("swordfish"), "{told}");
        assert!(!told.contains("PASSWORD"), "{told}");
    }
    assert!(said("include \"more.txt\"").contains("more.txt:2:1"));
}

#[test]
fn only_files_are_read_and_not_without_end() {
    let folder = folder(&[]);
    fs::create_dir(folder.path().join("f.link")).expect("a folder");
    let out = run(folder.path(), &["run", "-"], "include \"f.link\"");
    assert!(text(&out.stderr).contains("this is a folder"), "{}", text(&out.stderr));
    if Path::new("/dev/zero").exists() {
        let out = run(folder.path(), &["run", "/dev/zero"], "");
        assert_eq!(out.status.code(), Some(3));
        assert!(text(&out.stderr).contains("source-bytes"), "{}", text(&out.stderr));
        let endless = ["run", "-", "--allow-any-path"];
        let out = run(folder.path(), &endless, "include \"/dev/zero\"");
        assert!(text(&out.stderr).contains("this is no regular file"), "{}", text(&out.stderr));
    }
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::process::{Command, Stdio};

    use super::*;
    use crate::support::program::PROGRAM;

    #[test]
    fn links_do_not_lead_out_of_the_output_folder() {
        let folder = folder(&[("else/old.svg", ""), ("out/in/x", "")]);
        let at = |name: &str| folder.path().join(name);
        symlink(at("else"), at("out/dir")).expect("a link");
        symlink(at("else/old.svg"), at("out/old.svg")).expect("a link");
        symlink(at("else/none.svg"), at("out/none.svg")).expect("a link");
        symlink(at("out/in"), at("out/near")).expect("a link");
        symlink(at("out"), at("outlet")).expect("a link");
        for (name, status) in
            [("dir/a", 2), ("dir/deep/a", 2), ("old", 2), ("none", 2), ("near/a", 0), ("b", 0)]
        {
            for out in ["out", "outlet"] {
                let typed = format!("svg \"{name}.svg\"");
                let done = run(folder.path(), &["run", "-", "--out", out], &typed);
                assert_eq!(done.status.code(), Some(status), "{name}: {}", text(&done.stderr));
            }
        }
        assert_eq!(fs::read_dir(at("else")).expect("a folder").count(), 1);
        assert_eq!(fs::read(at("else/old.svg")).expect("a file"), b"");
        let anywhere = ["run", "-", "--out", "out", "--allow-any-path"];
        assert!(run(folder.path(), &anywhere, "svg \"old.svg\"").status.success());
        assert!(at("out/old.svg").is_symlink(), "a link stays one");
        assert!(fs::read(at("else/old.svg")).expect("a file").starts_with(b"<svg"));
    }

    #[test]
    fn links_do_not_lead_reads_out_of_the_folder() {
        let folder =
            folder(&[("secret.link", "print \"secret\""), ("own/a.link", "include \"b.link\"")]);
        symlink(folder.path().join("secret.link"), folder.path().join("own/b.link"))
            .expect("a link");
        let out = run(folder.path(), &["run", "own/a.link", "--out", "own"], "");
        assert_eq!((out.status.code(), text(&out.stdout)), (Some(2), String::new()));
    }

    #[test]
    fn files_are_as_readable_as_the_user_wants_new_ones_to_be() {
        let folder = folder(&[]);
        let mode = |umask: &str| {
            let script = format!("umask {umask}; echo 'svg \"{umask}.svg\"' | \"$0\" run -");
            let mut shell = Command::new("sh");
            shell.current_dir(folder.path()).args(["-c", &script, PROGRAM]);
            assert!(shell.status().expect("a shell").success());
            let file = folder.path().join(format!("{umask}.svg"));
            fs::metadata(file).expect("a picture").permissions().mode() & 0o777
        };
        assert_eq!([mode("022"), mode("077"), mode("002")], [0o644, 0o600, 0o664]);
        let file = folder.path().join("022.svg");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).expect("it is ours");
        assert_eq!(mode("022"), 0o640, "a file stays as readable as it was");
    }

    #[test]
    fn what_a_killed_run_left_is_removed_and_what_another_writes_is_not() {
        let folder =
            folder(&[(".linkwork-dead", "half"), (".linkwork-live", "half"), (".linkwork", "")]);
        let live = fs::File::open(folder.path().join(".linkwork-live")).expect("a file");
        live.try_lock().expect("nobody holds it");
        assert!(run(folder.path(), &["run", "-"], "svg \"a.svg\"").status.success());
        let left = |name: &str| folder.path().join(name).exists();
        assert!(!left(".linkwork-dead") && left(".linkwork-live") && left(".linkwork"));
    }

    #[test]
    fn of_two_programs_that_write_one_file_the_last_whole_one_stays() {
        let script = format!("point A = (0, 0)\n{}", "svg \"a.svg\"\n".repeat(20));
        let folder = folder(&[("a.link", &script)]);
        let start = || {
            let mut command = Command::new(PROGRAM);
            command.current_dir(folder.path()).args(["run", "a.link"]).stdout(Stdio::null());
            command.spawn().expect("the program starts")
        };
        let others = [start(), start(), start()];
        for mut other in others {
            assert!(other.wait().expect("it ends").success());
        }
        let picture = fs::read_to_string(folder.path().join("a.svg")).expect("a picture");
        assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
    }

    #[test]
    fn a_recording_lies_on_disk_and_is_gone_with_a_program_that_is_killed() {
        let script = script_and(
            "record \"t.csv\"; record \"m.svg\"; step 10000; svg \"begun.svg\"\nstep 1e9",
        );
        let folder = folder(&[("a.link", &script)]);
        let mut command = Command::new(PROGRAM);
        command.current_dir(folder.path()).args(["run", "a.link"]).stderr(Stdio::null());
        let mut child = command.spawn().expect("the program starts");
        while !folder.path().join("begun.svg").exists() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        if let Ok(open) = fs::read_dir(format!("/proc/{}/fd", child.id())) {
            let sizes = open.flatten().filter(|file| {
                let leads_here =
                    fs::read_link(file.path()).is_ok_and(|to| to.starts_with(folder.path()));
                leads_here && fs::metadata(file.path()).is_ok_and(|it| it.len() > 100_000)
            });
            assert_eq!(sizes.count(), 2, "10000 rows and 10000 poses");
        }
        child.kill().expect("it runs");
        child.wait().expect("it ends");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2, "nothing is left");
    }
}
