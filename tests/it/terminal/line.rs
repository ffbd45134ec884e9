//! The line: colours, hints, completion, continuation, pastes, history, Ctrl-C.

use tempfile::tempdir;
use vt100::Color;

use super::screen::{Start, Terminal};

const CTRL_C: &str = "\x03";
const CTRL_D: &str = "\x04";
const UP: &str = "\x1b[A";
const RIGHT: &str = "\x1b[C";

/// A session with a little of everything that has a name.
fn session(home: &std::path::Path) -> Terminal {
    let terminal = Terminal::session(home);
    terminal.enter("point A = (0, 0) frozen, B = (1, 0), p[1] = (0, 1)");
    terminal.enter("crank: motor A B; let cr = 3");
    terminal.enter("circle c = A radius 2");
    terminal.enter("define pair(A, d) { point P = A + (d, 0) }");
    terminal
}

#[test]
fn what_is_typed_is_coloured_by_the_grammar() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.type_in("length A X = 35 # why");
    let (plain, colour) = (Color::Default, Color::Idx);
    terminal.wait("the end of the line", |it| it.look("# why").0 == colour(8));
    assert_eq!(terminal.look("length"), (plain, true, false));
    assert_eq!(terminal.look("A "), (plain, false, false));
    assert_eq!(terminal.look("X"), (colour(1), false, true));
    assert_eq!(terminal.look("35"), (colour(3), false, false));
    // A letter more makes a function of a name; a word that is being typed is not marked.
    terminal.clear();
    terminal.type_in("print si");
    assert_eq!(terminal.look("si"), (plain, false, false));
    terminal.press("n(B.x), \"a # b\"");
    terminal.wait_for_line("> print sin(B.x), \"a # b\"");
    assert_eq!(terminal.look("sin").0, colour(4));
    assert_eq!(terminal.look("\"a # b\"").0, colour(2));
}

#[test]
fn the_rest_of_the_shape_and_what_was_typed_before_are_hinted() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.press("glider B ");
    terminal.wait_for("glider B on A B|CURVE [unbounded]");
    assert_eq!(terminal.look("on A B|CURVE").0, Color::Idx(8));
    // It is no part of the line.
    terminal.wait_for_line("> glider B ");
    terminal.clear();
    terminal.press("crank: mo");
    // What was typed before can be taken as it is.
    terminal.wait_for("> crank: motor A B; let cr = 3");
    terminal.press(RIGHT);
    terminal.wait_for_line("> crank: motor A B; let cr = 3");
    terminal.clear();
    terminal.press("use pair(");
    terminal.wait_for("use pair(A, d) [as NAME]");
}

#[test]
fn every_position_is_completed_by_what_fits_it() {
    let home = tempdir().expect("a folder");
    std::fs::write(home.path().join("part.link"), "").expect("a file");
    let terminal = session(home.path());
    for (typed, completed) in [
        ("mot", "motor "),
        ("bar: leng", "bar: length "),
        ("thaw p", "thaw p[1]"),
        ("off cr", "off crank"),
        ("glider B on c", "glider B on c"),
        ("motor A B ra", "motor A B radius "),
        ("motor A B radius 1 sp", "motor A B radius 1 speed "),
        ("length A B = 2 * cra", "length A B = 2 * crank"),
        ("print crank.an", "print crank.angle"),
        ("print crank.angle in re", "print crank.angle in rev"),
        ("point Q = (0, 0) fr", "point Q = (0, 0) frozen "),
        ("set met", "set method"),
        ("set method ne", "set method ne"),
        ("set method new", "set method newton"),
        ("set dead-points st", "set dead-points stop"),
        ("list par", "list parameters"),
        ("help hin", "help hinge"),
        ("examples peau", "examples peaucellier"),
        ("use pa", "use pair("),
        ("include \"pa", "include \"part.link"),
        ("for i in 1..2 { fre", "for i in 1..2 { freeze "),
        ("step 3; un", "step 3; un"),
        ("step 3; und", "step 3; undo "),
        ("dista", "distance"),
    ] {
        terminal.type_in(typed);
        terminal.press("\t");
        terminal.wait_for_line(&format!("> {completed}"));
        terminal.clear();
    }
    // Where there are several, they are listed; definitions with their arguments.
    terminal.press("use \t");
    terminal.wait_for_line("> use pair(");
    terminal.clear();
    terminal.press("off c\t\t");
    terminal.wait_for("c      crank");
}

#[test]
fn a_statement_goes_on_with_a_prompt_of_its_own() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.press("for i in 1..2 {\r");
    terminal.wait_for_line("...   ");
    terminal.press("print i,\r");
    terminal.wait_for_line("...   ");
    terminal.press("  2 * i\r}");
    terminal.wait_for_line("...   }");
    terminal.press("\r");
    terminal.wait_for("1 2\n2 4\n");
    terminal.wait_for_prompt();
    // A blank line ends it as it is.
    terminal.press("point Z = (1,\r");
    terminal.wait_for_line("...   ");
    terminal.press("\r");
    terminal.wait_for("is never closed");
    terminal.wait_for_prompt();
    // Or Ctrl-C gives it up.
    terminal.press("point Z = (1,\r");
    terminal.wait_for_line("...   ");
    terminal.press("\x03");
    terminal.wait_for_prompt();
    // It comes back as one.
    terminal.press(&format!("{UP}{UP}"));
    terminal.wait_for("for i in 1..2 {");
}

#[test]
fn a_command_behind_an_open_bracket_is_one_of_its_own() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.press("point Y = (0, 0\r");
    terminal.wait_for_line("...   ");
    terminal.press("point Z = (7, 11)\r");
    terminal.wait_for("is never closed");
    terminal.wait_for_prompt();
    terminal.press("Z.x + Z.y\rY\r");
    terminal.wait_for("\n18\n");
    terminal.wait_for("unknown name `Y`");
}

#[test]
fn what_is_typed_while_a_command_runs_is_the_next_line() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.begin("step 3e5");
    terminal.press("for i in 1..2 {\r");
    terminal.wait_for_line("...   ");
    terminal.press("print 7 * i\r}\r");
    terminal.wait_for("7\n14\n");
}

#[test]
fn a_pasted_transcript_is_typed_without_its_prompts_and_answers() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    let pasted = "> let r = 3\r> for i in 1..2 {\r...   print r * i\r... }\r30\r60\r> r";
    terminal.press(&format!("\x1b[200~{pasted}\x1b[201~"));
    terminal.wait_for("60\n> r");
    terminal.press("\r");
    terminal.wait_for("3\n6\n3\n> ");
    // One without prompts is typed as it stands.
    terminal.press("\x1b[200~let s = 4\rprint s + r\x1b[201~\r");
    terminal.wait_for("\n7\n> ");
}

#[test]
fn ctrl_c_clears_says_how_to_leave_and_stops_what_runs() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.type_in("length A");
    terminal.press(CTRL_C);
    terminal.wait_for_prompt();
    assert!(!terminal.screen().contains("or Ctrl-D leaves"), "{}", terminal.screen());
    terminal.press(CTRL_C);
    terminal.wait_for("`quit` or Ctrl-D leaves");
    // In a block, the whole of it.
    terminal.press("for i in 1..2 {\r");
    terminal.wait_for_line("...   ");
    terminal.press(CTRL_C);
    terminal.wait_for_prompt();
    // What runs.
    terminal.press("step 1e9\r");
    terminal.wait_for(" %, ");
    terminal.press(CTRL_C);
    terminal.wait_for("of 1000000000 frames");
    terminal.wait_for_prompt();
    terminal.enter("time");
    terminal.press(CTRL_D);
    assert_eq!(terminal.end().code(), Some(0));
}

#[test]
fn what_was_typed_is_there_in_the_next_session() {
    let home = tempdir().expect("a folder");
    let terminal = Terminal::session(home.path());
    terminal.enter("let r = 3");
    terminal.enter("nonsense");
    terminal.enter("let r = r0");
    terminal.enter("history");
    terminal.wait_for("> history\nlet r = 3\n> ");
    terminal.enter("save \"typed.link\" history");
    let typed = std::fs::read_to_string(home.path().join("typed.link")).expect("it is written");
    assert!(typed.ends_with("\nlet r = 3\nhistory\n"), "{typed}");
    terminal.press("quit\r");
    assert_eq!(terminal.end().code(), Some(0));
    let terminal = Terminal::session(home.path());
    terminal.press(&format!("{UP}{UP}{UP}{UP}"));
    terminal.wait_for_line("> let r = r0");
    terminal.clear();
    terminal.press("let");
    terminal.wait_for("> let r = r0");
}

#[test]
fn a_terminal_that_changes_its_size_shows_the_line_anew() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    let line = "length A B = 1 + 2 + 3 + 4 + 5 + 6";
    terminal.type_in(line);
    terminal.resize(24, 30);
    terminal.press(" + 7");
    terminal.wait_for("+ 5 + 6 + 7");
    terminal.press("\r");
    terminal.enter("1 + 2");
    terminal.wait_for("\n3\n> ");
}

#[test]
fn keys_are_those_of_vi_where_the_user_has_them_so() {
    let home = tempdir().expect("a folder");
    std::fs::write(home.path().join(".inputrc"), "set editing-mode vi\n").expect("a file");
    let terminal = Terminal::start(home.path(), &Start::default());
    terminal.wait_for_prompt();
    terminal.type_in("1 + 3");
    // Back to the first letter, which is deleted.
    terminal.press("\x1b");
    std::thread::sleep(std::time::Duration::from_millis(700));
    terminal.press("0x");
    terminal.wait_for(">  + 3");
}

#[test]
fn ctrl_c_leaves_a_search_a_list_and_a_paste() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    // The search of the history.
    terminal.press("\x12crank");
    terminal.wait_for("reverse-i-search");
    terminal.press(CTRL_C);
    terminal.wait_for_prompt();
    // A list of what completes a word.
    terminal.press("off c\t\t");
    terminal.wait_for("c      crank");
    terminal.press(CTRL_C);
    terminal.wait_for_prompt();
    // A paste that is not carried out yet.
    terminal.press("\x1b[200~for i in 1..2 {\r  step\r\x1b[201~");
    terminal.wait_for("step");
    terminal.press(CTRL_C);
    terminal.wait_for_prompt();
    terminal.enter("time");
    terminal.wait_for("> time\n0\n");
}

#[test]
fn ctrl_c_stops_whatever_takes_long_and_takes_back_what_is_half_done() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    for (long, said) in [
        ("for i in 1..1e7 { let n = i }", "stopped"),
        ("drag A to (1, 0) over 1e9", "stopped after"),
    ] {
        terminal.begin(long);
        // It is under way for a while.
        std::thread::sleep(std::time::Duration::from_millis(300));
        terminal.press(CTRL_C);
        terminal.wait(long, |it| it.line() == "> " && it.screen().contains(said));
        terminal.enter("print \"next\"");
        terminal.press("\x0c");
        terminal.wait_for_prompt();
    }
    assert!(!terminal.screen().contains("unknown"), "{}", terminal.screen());
}

#[test]
fn a_terminal_may_change_its_size_while_something_runs() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    terminal.press("step 1e9\r");
    terminal.wait_for(" %, ");
    terminal.resize(24, 40);
    std::thread::sleep(std::time::Duration::from_millis(300));
    terminal.press(CTRL_C);
    terminal.wait_for("stopped after");
    terminal.wait_for_prompt();
    // What is said now fits the new width, its caret in place.
    terminal.press("point Q = (1, 2), R = (3, 4), SSSS = (5 6)\r");
    terminal.wait_for("expected");
    terminal.wait_for_prompt();
    let screen = terminal.screen();
    let (_, said) = screen.rsplit_once("error[").expect("an error");
    let is_short = |line: &str| line.starts_with("> ") || line.chars().count() <= 40;
    assert!(said.lines().all(is_short), "{screen}");
}

#[test]
fn two_sessions_at_once_both_keep_what_is_typed() {
    let home = tempdir().expect("a folder");
    let first = Terminal::session(home.path());
    let second = Terminal::session(home.path());
    first.enter("let mine = 1");
    second.enter("let yours = 2");
    for terminal in [first, second] {
        terminal.press("quit\r");
        terminal.end();
    }
    let terminal = Terminal::session(home.path());
    for known in ["let mine = 1", "let yours = 2"] {
        terminal.press(&known[..6]);
        terminal.wait_for(known);
        terminal.clear();
    }
}

#[test]
fn long_blocks_are_pasted_whole() {
    let home = tempdir().expect("a folder");
    let terminal = session(home.path());
    let lines: Vec<String> = (0..120).map(|i| format!("  point q[{i}] = (k, {i})\r")).collect();
    let lines = lines.concat();
    for piece in format!("\x1b[200~for k in 1..1 {{\r{lines}}}\x1b[201~").as_bytes().chunks(500) {
        terminal.press(&String::from_utf8_lossy(piece));
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    terminal.press("\r");
    terminal.wait_for_prompt();
    terminal.enter("q[119]");
    terminal.wait_for("(1, 119)");
}
