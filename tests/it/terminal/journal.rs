//! A session that is killed is brought back.

use std::fs;
use std::path::{Path, PathBuf};

use linkwork::Session;
use tempfile::tempdir;

use super::screen::{Start, Terminal};

fn journals(home: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(home.join(".local/state/linkwork/journal")).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort_unstable();
    paths
}

/// What a journal brings back.
fn brought_back(home: &Path) -> String {
    let [journal] = &journals(home)[..] else { panic!("{:?}", journals(home)) };
    let mut session = Session::new();
    session.run(&fs::read_to_string(journal).expect("a journal")).expect("it can be loaded");
    session.to_script()
}

/// The session that these lines make.
fn typed(lines: &[&str]) -> String {
    let mut session = Session::new();
    lines.iter().for_each(|line| drop(session.run(line).expect("a line")));
    session.to_script()
}

const LINES: [&str; 8] = [
    "point A = (0, 0) frozen, B = (1, 0), C = (2, 2)",
    "crank: motor A B speed 1rev",
    "length B C = 2",
    "let r = 3",
    "step 7",
    "drag A to (1, 0) over 5",
    "trace C; step 2",
    "set dt 1/30",
];

#[test]
fn whenever_a_session_is_killed_all_that_was_carried_out_is_there() {
    for n in 1..=LINES.len() {
        let home = tempdir().expect("a folder");
        let terminal = Terminal::session(home.path());
        LINES[..n].iter().for_each(|line| terminal.enter(line));
        // What is being typed is lost.
        terminal.press("delete ");
        terminal.kill();
        assert_eq!(brought_back(home.path()), typed(&LINES[..n]), "after {n} lines");
    }
}

#[test]
fn what_cannot_be_repeated_is_kept_as_what_came_of_it() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    LINES.iter().for_each(|line| terminal.enter(line));
    fs::write(home.path().join("part.link"), "point D = (5, 5)").expect("a file");
    for line in ["undo 2", "include \"part.link\"", "step 3 in 20ms", "print D", "save \"s.link\""]
    {
        terminal.enter(line);
    }
    fs::remove_file(home.path().join("part.link")).expect("it was there");
    terminal.enter("let after = 1");
    terminal.enter("save \"s.link\"");
    terminal.kill();
    let saved = fs::read_to_string(home.path().join("s.link")).expect("it was saved");
    assert_eq!(brought_back(home.path()), saved);
}

#[test]
fn the_next_session_says_so_once_and_an_end_in_order_leaves_nothing() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    terminal.enter("let r = 3");
    // A second session at the same time is none of its business.
    let other = Terminal::session(home.path());
    assert!(!other.screen().contains("did not end"), "{}", other.screen());
    other.press("quit\r");
    other.end();
    terminal.kill();

    let wide = Start { size: (24, 200), ..Start::default() };
    let terminal = Terminal::start(home.path(), &wide);
    terminal.wait_for("the last session did not end in order");
    terminal.wait_for_prompt();
    let screen = terminal.screen();
    let load =
        screen.lines().find_map(|line| line.split_once("bring back its 1 line: ")).expect("how").1;
    terminal.enter(load);
    terminal.enter("r + 0");
    terminal.wait_for("\n3\n");
    terminal.press("quit\r");
    terminal.end();

    let terminal = Terminal::session(home.path());
    assert!(!terminal.screen().contains("did not end"), "{}", terminal.screen());
    drop(terminal);
    let start = Start { args: &["--no-journal"], ..Start::default() };
    let n_before = journals(home.path()).len();
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for_prompt();
    terminal.enter("let r = 3");
    assert_eq!(journals(home.path()).len(), n_before);
}
