//! What the program makes of the terminal it finds: none, a dumb one, a narrow one, one without
//! colours; of the user's pager and first file.

use std::collections::HashSet;
use std::fs;
use std::io::Write;
use std::process::{Command, Stdio};

use tempfile::tempdir;

use super::screen::{Start, Terminal};

fn is_coloured(terminal: &Terminal) -> bool {
    let text = String::from_utf8_lossy(&terminal.bytes()).into_owned();
    let mut codes = text.split("\x1b[").skip(1);
    codes.any(|code| {
        code.find(|c: char| !c.is_ascii_digit() && c != ';')
            .is_some_and(|end| &code[end..=end] == "m")
    })
}

#[test]
fn without_colours_nothing_is_coloured_and_nothing_hinted() {
    let home = tempdir().expect("a folder");
    let start = Start { env: &[("NO_COLOR", "1")], ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for_prompt();
    terminal.type_in("motor A ");
    terminal.press("\r");
    terminal.wait_for("expected");
    terminal.wait_for_prompt();
    assert!(!terminal.screen().contains("radius R]\n> motor"), "{}", terminal.screen());
    assert!(!is_coloured(&terminal));
    terminal.press("for i in 1..2 {\r");
    terminal.wait_for_line("...   ");
}

#[test]
fn a_dumb_terminal_gets_letters_only() {
    let home = tempdir().expect("a folder");
    let start = Start { env: &[("TERM", "dumb"), ("PAGER", "sed s/^/paged/")], ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for("> ");
    terminal.press("1 + 2\rhelp\rpoint A = (0, 0), B = (1, 0); show\rnonsense\r");
    terminal.wait_for("unknown name");
    let text = String::from_utf8_lossy(&terminal.bytes()).into_owned();
    assert!(!text.contains('\x1b') && !text.contains("paged"), "{text:?}");
    assert!(text.contains("\r\n3\r\n"), "{text:?}");
}

#[test]
fn a_narrow_terminal_shows_all_of_it() {
    let home = tempdir().expect("a folder");
    let start = Start { size: (24, 40), ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for("> ");
    terminal.press("point A = (0, 0) frozen, B = (1, 0), CCC = (1 2)\r");
    terminal.wait_for("expected");
    terminal.wait_for_prompt();
    terminal.press("motor A ");
    terminal.wait_for("> motor A ");
    terminal.clear();
    terminal.enter("1 + 2");
    terminal.wait_for("\n3\n");
}

#[test]
fn what_does_not_fit_is_broken_at_words() {
    let home = tempdir().expect("a folder");
    let narrow = Start { size: (500, 40), ..Start::default() };
    let terminal = Terminal::start(home.path(), &narrow);
    terminal.wait_for_prompt();
    let statements = [
        "point Aaaaaaaa = (0, 0) frozen, Bbbbbbbb = (1, 0)",
        "length Aaaaaaaa Bbbbbbbb = 1",
        "ponit A",
        "A = 3",
        "list",
        "show Aaaaaaaa",
        "help",
        "help motor",
        "examples",
        "effects",
        "history",
        "check",
    ];
    statements.iter().for_each(|statement| terminal.enter(statement));
    terminal.enter("\"the end\"");
    let screen = terminal.screen();
    let row = "  drag          draw points along\n                straight lines,";
    assert!(screen.contains(row), "{screen}");
    let message = "  = help: to define a parameter, write\n          `let A = ...`";
    assert!(screen.contains(message), "{screen}");
    assert!(screen.contains("`examples`\n    show what there is"), "{screen}");
    // What no terminal says has the same words: none was broken.
    let whole = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(["-e", "help; help motor; examples"])
        .output()
        .expect("it runs");
    let whole = String::from_utf8_lossy(&whole.stdout);
    let words: HashSet<&str> = whole.split_whitespace().collect();
    let said = &screen[screen.find("> help\n").expect("the list")..];
    let said = &said[..said.find("> effects\n").expect("what follows")];
    let broken: Vec<&str> = said
        .split_whitespace()
        .filter(|word| !words.contains(word) && !["help", "examples", ">"].contains(word))
        .collect();
    assert!(broken.is_empty(), "{broken:?} in\n{screen}");
}

#[test]
fn long_answers_go_to_the_pager_and_short_ones_do_not() {
    let home = tempdir().expect("a folder");
    let pager = ("PAGER", "sed s/^/paged:/");
    let start = Start { env: &[pager], ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for_prompt();
    terminal.press("help motor\r");
    terminal.wait_for("motor O P");
    terminal.press("help\r");
    terminal.wait_for("paged:");
    terminal.wait_for_prompt();
    assert!(!String::from_utf8_lossy(&terminal.bytes()).contains("paged:motor O P"));
    drop(terminal);
    for start in [
        Start { env: &[pager], args: &["--no-pager"], ..Start::default() },
        // No pager, and not `less`, which would wait for a key.
        Start { env: &[("PAGER", "")], ..Start::default() },
    ] {
        let terminal = Terminal::start(home.path(), &start);
        terminal.wait_for_prompt();
        terminal.press("help\r");
        terminal.wait_for("says more");
        terminal.wait_for_prompt();
        assert!(!String::from_utf8_lossy(&terminal.bytes()).contains("paged:"));
    }
}

#[test]
fn a_long_run_shows_how_far_it_is_and_a_short_one_does_not() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    terminal.enter("point A = (0, 0) frozen, B = (1, 0); motor A B");
    terminal.enter("step 10");
    assert!(!terminal.screen().contains('%'));
    terminal.begin("step 1e9");
    terminal.wait_for(" %, ");
    terminal.wait_for("left");
    terminal.press("\x03");
    terminal.wait_for("stopped after");
    terminal.wait_for_prompt();
    assert!(!terminal.screen().contains('%'), "{}", terminal.screen());
}

#[test]
fn the_users_own_file_begins_a_session() {
    let home = tempdir().expect("a folder");
    let folder = home.path().join(".config/linkwork");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("init.link"), "let mine = 42\nlenght").expect("a file");
    let terminal = Terminal::session(home.path());
    terminal.wait_for("init.link:2:1");
    terminal.enter("mine");
    terminal.wait_for("\n42\n");
    drop(terminal);
    let terminal =
        Terminal::start(home.path(), &Start { args: &["--no-init"], ..Start::default() });
    terminal.wait_for_prompt();
    terminal.press("mine\r");
    terminal.wait_for("unknown name `mine`");
}

#[test]
fn a_session_goes_on_where_a_file_ended() {
    let home = tempdir().expect("a folder");
    fs::write(home.path().join("a.link"), "let r = 3\nassert 1 = 2").expect("a file");
    let start = Start { args: &["-i", "a.link", "-e", "let r = 4"], ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for("assertion failed");
    terminal.wait_for_prompt();
    terminal.enter("r + 0");
    terminal.wait_for("\n3\n");
}

#[test]
fn an_example_is_run_and_played_with() {
    let home = tempdir().expect("a folder");
    let start = Start { args: &["examples", "klann", "-i"], ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for_prompt();
    terminal.enter("list definitions");
    terminal.wait_for("define dyad(");
}

#[test]
fn without_a_terminal_there_is_no_prompt_no_greeting_and_no_order() {
    let home = tempdir().expect("a folder");
    let mut program = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .current_dir(home.path())
        .env("HOME", home.path())
        .env("TERM", "xterm-kitty")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let typed = "1 + 2\nnonsense\npoint A = (0, 0), B = (1, 0); length A B\nshow\nhelp\n";
    program.stdin.take().expect("a pipe").write_all(typed.as_bytes()).expect("it reads");
    let done = program.wait_with_output().expect("it ends");
    let out = String::from_utf8(done.stdout).expect("text");
    assert!(
        out.starts_with("3\n")
            && out.contains(['\u{2580}', '\u{2584}'])
            && out.contains("says more"),
        "{out}"
    );
    let said = String::from_utf8(done.stderr).expect("text");
    for text in [&out, &said] {
        assert!(
            !text.contains('\x1b') && !text.contains("Ctrl-D") && !text.contains("> 1"),
            "{text}"
        );
    }
    assert_eq!(done.status.code(), Some(2));
    // Nothing of a session is kept.
    assert!(!home.path().join(".local").exists());
}

#[test]
fn all_that_is_said_of_a_scene_fits_forty_columns() {
    let home = tempdir().expect("a folder");
    let narrow = Start { size: (200, 40), ..Start::default() };
    let terminal = Terminal::start(home.path(), &narrow);
    terminal.wait_for_prompt();
    let statements = [
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)",
        "crank: motor A B speed 1rev; coupler: length B C = 3.5; length C D = 3",
        "trace C; solve; step 60",
        "list; show coupler; C; crank",
        "effects; check; limits crank; set; why coupler",
        "length B C = 9; solve",
        "sample \"s\" = 1, 2, 3; plot; show",
    ];
    statements.iter().for_each(|statement| terminal.enter(statement));
    terminal.enter("\"the end\"");
    let text = String::from_utf8_lossy(&terminal.bytes()).into_owned();
    assert!(text.contains("us a frame, "), "{text}");
    // No line was broken by the terminal within a word: what is wider than it is one word.
    let mut screen =
        vt100::Parser::new(500.try_into().expect("rows"), 400.try_into().expect("columns"), 0);
    screen.process(&terminal.bytes());
    let said = screen.screen().contents();
    let is_typed =
        |line: &str| line.starts_with("> ") || statements.iter().any(|it| it.contains(line));
    for line in said.lines().filter(|line| !is_typed(line.trim_end())) {
        assert!(line.chars().count() <= 40 || !line.trim().contains(' '), "{line:?} in\n{said}");
    }
}
