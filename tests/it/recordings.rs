//! Recordings: what they hold after commands that failed or were taken back, and where it lies.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Host, Session, Spool};

use crate::support::talk::Talking;

/// A crank with a rod, traced and recorded in all three ways.
const RECORDED: &str = "point A = (0, 0) frozen, B = (1, 0), C = (3, 0)
    motor A B speed 1rev; length B C = 2
    trace B; expose every 4
    record \"t.csv\"; record \"m.svg\"; record \"f/\" every 2
    step 3\n";

/// The files of a session to whose recording these statements are added, mistakes and all.
fn files(statements: &str) -> BTreeMap<PathBuf, String> {
    let mut talking = Talking::after(RECORDED);
    talking.type_in(statements);
    talking.run("record stop");
    talking.talk.files
}

#[test]
fn what_failed_or_was_taken_back_is_in_no_recording() {
    let whole = files("step 5; step 4");
    assert_eq!(whole[Path::new("t.csv")].lines().count(), 13);
    assert!(whole.len() == 8 && whole.contains_key(Path::new("f/frame-0005.svg")));
    for statements in [
        "step 5\nfor i in 1..3 { step 2; print nobody }\nstep 4",
        "step 5; step 7; undo; step 4",
        "step 9; undo; step 5; step 4",
        "step 5; step 4; undo 2; redo 2",
        "for i in 1..5 { trace C; step 1; print nobody }\nstep 5; trace C; step 2; undo 2; step 4",
        "step 5; step 4; record stop; undo",
    ] {
        assert!(files(statements) == whole, "after {statements}");
    }
}

#[test]
fn a_point_that_is_traced_later_has_a_column_of_its_own() {
    let table = files("trace C; step 2; untrace B; step 1").remove(Path::new("t.csv"));
    let table = table.expect("a table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "time,B.x,B.y,C.x,C.y");
    assert!(lines[1..4].iter().all(|line| line.ends_with(",,")), "{table}");
    assert!(lines[4..6].iter().all(|line| !line.contains(",,")), "{table}");
    assert!(lines[6].contains(",,,"), "{table}");
}

#[test]
fn a_point_that_is_called_otherwise_stays_in_its_column() {
    let heading = |statements: &str| {
        let table = files(statements).remove(Path::new("t.csv")).expect("a table");
        let lines: Vec<&str> = table.lines().collect();
        assert!(lines[1..].iter().all(|line| !line.contains(",,")), "{table}");
        lines[0].to_owned()
    };
    assert_eq!(heading("rename B to hand; step 2"), "time,hand.x,hand.y");
    assert_eq!(heading("step; rename B to hand; step; undo 2"), "time,B.x,B.y");
    assert_eq!(heading("rename B to hand; step; undo 2; step"), "time,B.x,B.y");
    // Another point of the old name is another point.
    let table = files("rename B to hand; point B = (7, 8); trace B; step 2");
    let table = &table[Path::new("t.csv")];
    assert!(table.starts_with("time,hand.x,hand.y,B.x,B.y\n"), "{table}");
    assert!(table.ends_with(",7,8\n"), "{table}");
    // One that is made again goes on where it was.
    assert_eq!(heading("delete B cascade; point B = (1, 1); trace B; step"), "time,B.x,B.y");
}

#[test]
fn a_legend_calls_a_path_as_its_point_is_called() {
    let movie = files("trace C; step; rename B to hand; step").remove(Path::new("m.svg"));
    let movie = movie.expect("a picture");
    let captions = movie.split("class=\"caption\"").skip(1);
    let words = captions.filter_map(|rest| Some(rest.split_once('>')?.1.split_once('<')?.0));
    let words: Vec<&str> = words.collect();
    assert!(words.contains(&"hand") && !words.contains(&"B"), "{words:?}");
}

/// A disk on which there is room for so many bytes.
#[derive(Debug)]
struct SmallDisk(usize, Vec<u8>);

impl Spool for SmallDisk {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.1.len() + bytes.len() > self.0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        Spool::append(&mut self.1, bytes)
    }

    fn read(&mut self, from: u64, bytes: &mut [u8]) -> io::Result<()> {
        Spool::read(&mut self.1, from, bytes)
    }

    fn truncate(&mut self, n_bytes: u64) {
        Spool::truncate(&mut self.1, n_bytes);
    }
}

/// A host with such a disk.
struct Outside(BTreeMap<PathBuf, String>);

impl Host for Outside {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        Err(io::ErrorKind::NotFound.into())
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let text = String::from_utf8(bytes.to_vec()).expect("a text");
        self.0.insert(path.to_path_buf(), text);
        Ok(())
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        Ok(Box::new(SmallDisk(1000, Vec::new())))
    }

    fn seconds(&self) -> Option<f64> {
        None
    }
}

#[test]
fn a_full_disk_ends_the_command_and_loses_nothing() {
    let (mut session, mut host) = (Session::new(), Outside(BTreeMap::new()));
    let mut run = |session: &mut Session, text: &str| {
        let source = session.add_source("test", text, None);
        session.execute_all(source, &mut host).map(|_| host.0.clone())
    };
    run(&mut session, "point A = (0, 0); trace A; record \"t.csv\"; step 3")
        .expect("there is room");
    let before = session.to_script();
    let problem = run(&mut session, "step 100").expect_err("the disk is full");
    assert_eq!(&*problem.message, "cannot write `t.csv`");
    assert_eq!(problem.labels[0].text, "the disk is full");
    assert_eq!(session.to_script(), before);
    let files = run(&mut session, "step 2; record stop").expect("there is room");
    assert_eq!(files[Path::new("t.csv")].lines().count(), 6);
}
