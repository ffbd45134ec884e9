//! A session that is killed is brought back.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

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
fn what_is_read_taken_back_or_told_by_a_clock_is_kept() {
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
fn what_a_stopped_command_did_is_there_too() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    LINES.iter().for_each(|line| terminal.enter(line));
    terminal.enter("untrace all");
    terminal.begin("for i in 1..1000 { let q = i; for j in 1..1000 { step 500 } }");
    // Some rounds are done, however fast it is.
    terminal.wait("progress", |it| {
        let share =
            it.line().split_once(" %").and_then(|(bar, _)| bar.rsplit(' ').next()?.parse().ok());
        share.is_some_and(|percent: u32| percent > 0)
    });
    terminal.press("\x03");
    terminal.wait_for("stopped");
    terminal.wait_for_prompt();
    terminal.enter("let after = 1");
    terminal.enter("save \"s.link\"");
    terminal.kill();
    let saved = fs::read_to_string(home.path().join("s.link")).expect("it was saved");
    assert!(!saved.contains("let q = 1\n"), "it was stopped too soon:\n{saved}");
    assert_eq!(brought_back(home.path()), saved);
}

/// A session for a program, and what it says.
struct Spoken {
    program: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

impl Spoken {
    fn begin(home: &Path, args: &[&str]) -> Self {
        let mut program = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .args(args)
            .current_dir(home)
            .env_clear()
            .env("HOME", home)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let to = program.stdin.take().expect("a pipe");
        let from = BufReader::new(program.stdout.take().expect("a pipe"));
        Self { program, to, from }
    }

    /// Says a line; gives what is said until it is carried out.
    fn say(&mut self, line: &str) -> String {
        self.say_until(line, "statement")
    }

    /// Says a line; gives what is said up to an object of this type.
    fn say_until(&mut self, line: &str, last: &str) -> String {
        writeln!(self.to, "{line}").expect("it listens");
        let mut said = String::new();
        let last = format!("\"type\":\"{last}\"");
        while !said.contains(&last) {
            assert!(self.from.read_line(&mut said).expect("it speaks") > 0, "{said}");
        }
        said
    }

    fn kill(mut self) {
        self.program.kill().expect("it runs");
        self.program.wait().expect("it ends");
    }
}

#[test]
fn sessions_of_programs_are_brought_back_too() {
    let home = tempdir().expect("a folder");
    fs::write(home.path().join("first.link"), "let first = 1").expect("a file");
    for (args, first) in
        [(&["--json"][..], None), (&["--json", "-i", "first.link"], Some("let first = 1"))]
    {
        let mut program = Spoken::begin(home.path(), args);
        if first.is_some() {
            program.say("");
        }
        let lines: Vec<&str> =
            first.into_iter().chain(["point A = (0, 0) frozen, B = (1, 0)", "let r = 3"]).collect();
        lines.iter().skip(usize::from(first.is_some())).for_each(|line| drop(program.say(line)));
        program.kill();
        assert_eq!(brought_back(home.path()), typed(&lines), "{args:?}");
        // The next one says so, in its way, and leaves nothing.
        let mut next = Spoken::begin(home.path(), &["--json"]);
        assert!(next.say("1").contains("did not end in order"));
        drop(next.to);
        assert!(next.program.wait().expect("it ends").success());
        let [told] = &journals(home.path())[..] else { panic!("{:?}", journals(home.path())) };
        fs::remove_file(told).expect("it is there");
    }
    let mut asked = Spoken::begin(home.path(), &["--json"]);
    asked.say("let r = 3");
    asked.say_until(r#"{"run": "let s = 4\nlet t = 5; nonsense\nlet u = 6"}"#, "done");
    asked.kill();
    let lines = ["let r = 3", "let s = 4", "let t = 5"];
    assert_eq!(brought_back(home.path()), typed(&lines));
    journals(home.path()).iter().for_each(|path| fs::remove_file(path).expect("it is there"));
    let mut silent = Spoken::begin(home.path(), &["--json", "--no-journal"]);
    silent.say("let r = 3");
    silent.kill();
    assert_eq!(journals(home.path()).len(), 0);
}

#[test]
fn what_was_being_written_when_a_session_ended_is_cut_off() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    LINES.iter().for_each(|line| terminal.enter(line));
    terminal.kill();
    let [journal] = &journals(home.path())[..] else { panic!("{:?}", journals(home.path())) };
    let whole = fs::read_to_string(journal).expect("a journal");
    for torn in [
        &b"restore file \"long.link\" = \"let r = 3"[..],
        b"for i in 1..3 {\n",
        b"restore stop = 0\n",
        b"let r = \"\xff\xfe",
        b"\0\0\0\0",
    ] {
        fs::write(journal, [whole.as_bytes(), torn].concat()).expect("it is there");
        let mut next = Spoken::begin(home.path(), &["--json"]);
        assert!(next.say("1").contains("to bring back its 9 lines"));
        drop(next.to);
        assert!(next.program.wait().expect("it ends").success());
        let [told] = &journals(home.path())[..] else { panic!("{:?}", journals(home.path())) };
        assert_eq!(fs::read_to_string(told).expect("it was told of"), whole);
        fs::rename(told, journal).expect("it is there");
    }
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
