//! Pictures in terminals that show more than letters: the bytes that go there are decoded again.

use std::fs;
use std::process::Command;

use linkwork::Session;
use linkwork::render::{Drawable, Pixels, Scene};
use miniz_oxide::inflate::decompress_to_vec_zlib;
use tempfile::tempdir;

use super::screen::{Start, Terminal};

const FOUR_BAR: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3); \
                        motor A B; length B C = 3.5; length C D = 3; solve";

/// Columns and rows of a terminal, less those that stay free under a picture.
const PAGE: [usize; 2] = [80, 21];

/// What the scale below a drawing takes, px.
const SCALE_HEIGHT: f64 = 34.0;

/// A picture, a colour for each pixel.
struct Picture {
    width: usize,
    colours: Vec<[u8; 3]>,
}

impl From<Pixels> for Picture {
    fn from(pixels: Pixels) -> Self {
        let [width, _] = pixels.size();
        let colours = pixels.rgb().chunks(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
        Self { width, colours }
    }
}

impl Picture {
    fn is_paper(&self, x: usize, y: usize) -> bool {
        self.colours.get(y * self.width + x).is_none_or(|colour| *colour == self.colours[0])
    }
}

/// The mechanism as it is to be seen, letters so large.
fn wanted(wide: usize, high: usize) -> Picture {
    let mut session = Session::new();
    session.run(FOUR_BAR).expect("a four-bar");
    let svg = Drawable::Scene(&Scene::new(session.world())).svg();
    Pixels::of(&svg, [wide * PAGE[0], high * PAGE[1]]).into()
}

#[track_caller]
fn assert_same(shown: &Picture, wanted: &Picture, most: u8) {
    assert_eq!((shown.width, shown.colours.len()), (wanted.width, wanted.colours.len()));
    let differs = |k: &usize| {
        let pairs = shown.colours[*k].into_iter().zip(wanted.colours[*k]);
        pairs.map(|(a, b)| a.abs_diff(b)).max() > Some(most)
    };
    let n = (0..shown.colours.len()).filter(differs).count();
    assert_eq!(n, 0, "of {} pixels", shown.colours.len());
}

/// A session with a four-bar.
fn session(env: &[(&str, &str)], args: &[&str]) -> Terminal {
    let home = tempdir().expect("a folder");
    let all = [&["--no-journal"], args].concat();
    let terminal = Terminal::start(home.path(), &Start { env, args: &all, ..Start::default() });
    terminal.wait_for_prompt();
    terminal.press(&format!("{FOUR_BAR}\r"));
    terminal.wait_for("converged");
    terminal.wait_for_prompt();
    terminal
}

/// What stands between the first `from` and the next `to`.
fn between<'a>(bytes: &'a [u8], from: &[u8], to: &[u8]) -> Option<(&'a [u8], &'a [u8])> {
    let find = |text: &[u8], what: &[u8]| text.windows(what.len()).position(|it| it == what);
    let start = find(bytes, from)? + from.len();
    let end = start + find(&bytes[start..], to)?;
    Some((&bytes[start..end], &bytes[end + to.len()..]))
}

/// The bytes that letters stand for (RFC 4648).
fn from_base64(text: &[u8]) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => u32::from(letter - b'A'),
        b'a'..=b'z' => u32::from(letter - b'a') + 26,
        b'0'..=b'9' => u32::from(letter - b'0') + 52,
        b'+' => 62,
        b'/' => 63,
        _ => panic!("no letter of base 64: {letter}"),
    };
    let text: Vec<u8> = text.iter().copied().filter(|letter| *letter != b'=').collect();
    let bytes = text.chunks(4).flat_map(|four| {
        let bits = four.iter().fold(0, |bits, &letter| bits << 6 | value(letter));
        let bits = bits << (6 * (4 - four.len()));
        bits.to_be_bytes()[1..four.len()].to_vec()
    });
    bytes.collect()
}

/// A PNG of three channels whose rows are unfiltered.
fn from_png(png: &[u8]) -> Picture {
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let word = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four")) as usize;
    let (width, height) = (word(16), word(20));
    let mut packed = Vec::new();
    let mut at = 8;
    while at < png.len() {
        let n = word(at);
        if &png[at + 4..at + 8] == b"IDAT" {
            packed.extend(&png[at + 8..at + 8 + n]);
        }
        at += n + 12;
    }
    let rows = decompress_to_vec_zlib(&packed).expect("a stream of zlib");
    assert_eq!(rows.len(), height * (3 * width + 1));
    let colours = rows.chunks(3 * width + 1).flat_map(|row| row[1..].chunks(3));
    Picture { width, colours: colours.map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect() }
}

/// Sixels as the manual of the VT340 has them.
fn from_sixels(text: &[u8]) -> Picture {
    let mut rest = &text[text.iter().position(|b| *b == b'"').expect("the size")..];
    let numbers = |rest: &mut &[u8]| -> Vec<usize> {
        let end = rest[1..].iter().position(|b| !b.is_ascii_digit() && *b != b';');
        let end = end.map_or(rest.len(), |end| end + 1);
        let text = std::str::from_utf8(&rest[1..end]).expect("digits");
        let found = text.split(';').filter_map(|n| n.parse().ok()).collect();
        *rest = &rest[end..];
        found
    };
    let size = numbers(&mut rest);
    let (width, height) = (size[2], size[3]);
    let mut palette = vec![[0; 3]; 256];
    let mut colours = vec![[0; 3]; width * height];
    let (mut colour, mut x, mut y, mut n) = (0, 0, 0, 1);
    while let Some(&byte) = rest.first() {
        match byte {
            b'#' => match numbers(&mut rest)[..] {
                [number] => colour = number,
                [number, 2, r, g, b] => palette[number] = [r, g, b].map(|p| (p * 255 / 100) as u8),
                ref other => panic!("no colour: {other:?}"),
            },
            b'!' => n = numbers(&mut rest)[0],
            b'?'..=b'~' => {
                for column in x..x + n {
                    for row in (0..6).filter(|row| (byte - b'?') >> row & 1 == 1) {
                        colours[(y + row) * width + column] = palette[colour];
                    }
                }
                x += n;
                n = 1;
                rest = &rest[1..];
            }
            b'$' | b'-' => {
                y += if byte == b'-' { 6 } else { 0 };
                x = 0;
                rest = &rest[1..];
            }
            other => panic!("no sixel: {other}"),
        }
    }
    Picture { width, colours }
}

/// The PNG in the orders of kitty's protocol.
fn of_kitty(bytes: &[u8]) -> Picture {
    let mut text = Vec::new();
    let mut rest = bytes;
    while let Some((order, behind)) = between(rest, b"\x1b_G", b"\x1b\\") {
        let at = order.iter().position(|b| *b == b';').expect("what is told of it");
        assert!(order.len() - at <= 4097);
        text.extend(&order[at + 1..]);
        rest = behind;
    }
    from_png(&from_base64(&text))
}

#[test]
fn kitty_gets_the_picture_as_it_is() {
    let terminal = session(&[("TERM", "xterm-kitty")], &[]);
    terminal.enter("show");
    assert_same(&of_kitty(&terminal.bytes()), &wanted(16, 32), 0);
    // A chart as well.
    let n = terminal.bytes().len();
    terminal.enter("sample \"s\" = 1, 2; plot");
    let chart = of_kitty(&terminal.bytes()[n..]);
    assert!(chart.colours.contains(&[0; 3]));
}

#[test]
fn iterm_gets_the_picture_as_it_is() {
    let terminal = session(&[("TERM_PROGRAM", "iTerm.app")], &[]);
    terminal.enter("show");
    let bytes = terminal.bytes();
    let (order, _) = between(&bytes, b"\x1b]1337;File=", b"\x07").expect("a picture");
    let at = order.iter().position(|b| *b == b':').expect("what is told of it");
    assert_same(&from_png(&from_base64(&order[at + 1..])), &wanted(16, 32), 0);
}

#[test]
fn a_terminal_that_says_it_can_gets_sixels() {
    let terminal = session(&[], &[]);
    ask(&terminal);
    terminal.press(ANSWER);
    terminal.wait_for_prompt();
    // Whoever is too slow for the first question is in time for the next, or has answered by then.
    if between(&terminal.bytes(), b"\x1bP", b"\x1b\\").is_none() {
        ask(&terminal);
        terminal.press(ANSWER);
        terminal.wait_for_prompt();
    }
    let bytes = terminal.bytes();
    let (sixels, _) = between(&bytes, b"\x1bP", b"\x1b\\").expect("a picture");
    // Colours are in hundredths, and the rarest take that of a neighbour.
    assert_same(&from_sixels(sixels), &wanted(9, 18), 20);
    // What answered is not asked again.
    let n = bytes.len();
    terminal.enter("show");
    assert!(!asks(&terminal, n));
    // The answer is nothing that was typed.
    terminal.enter("1 + 2");
    terminal.wait_for("\n3\n");
}

/// What a terminal with letters of 9 times 18 pixels says that shows sixels.
const ANSWER: &str = "\x1b[6;18;9t\x1b[?62;4;22c";

/// Whether what came out behind so many bytes asks what the terminal is.
fn asks(terminal: &Terminal, n: usize) -> bool {
    terminal.bytes()[n..].windows(3).any(|three| three == b"\x1b[c")
}

/// Shows the mechanism, and waits for the question or a picture.
fn ask(terminal: &Terminal) {
    terminal.type_in("show");
    let n = terminal.bytes().len();
    terminal.press("\r");
    let shows = |it: &Terminal| between(&it.bytes()[n..], b"\x1bP", b"\x1b\\").is_some();
    terminal.wait("the question", |it| asks(it, n) || shows(it));
}

#[test]
fn what_is_typed_while_a_terminal_is_asked_is_not_lost() {
    let terminal = session(&[], &[]);
    ask(&terminal);
    // Some of it is read with the answer, the rest by the prompt.
    terminal.press("2 * 4\rfor i in 5..5 {\r");
    terminal.press(&format!("10 * i{ANSWER} }}"));
    terminal.wait_for("\n8\n");
    terminal.wait("the rest of the line", |it| it.line().ends_with("10 * i }"));
    terminal.press("\r");
    terminal.wait_for("\n50\n");
}

#[test]
fn an_answer_that_comes_late_is_not_typed() {
    let check = |before: &str, after: &str, wanted: &str| {
        let terminal = session(&[], &[]);
        ask(&terminal);
        // Nobody waits for it any more.
        terminal.wait("blocks", |it| it.screen().contains(['\u{2580}', '\u{2584}']));
        terminal.wait_for_prompt();
        terminal.type_in(before);
        terminal.press(ANSWER);
        terminal.press(after);
        terminal.wait_for_line(&format!("> {before}{after}"));
        terminal.press("\r");
        terminal.wait_for(wanted);
    };
    check("", "1 + 2", "\n3\n");
    check("1 + ", "4", "\n5\n");
}

#[test]
fn an_answer_that_comes_while_a_command_runs_is_not_typed() {
    let terminal = session(&[], &[]);
    ask(&terminal);
    terminal.wait("blocks", |it| it.screen().contains(['\u{2580}', '\u{2584}']));
    terminal.wait_for_prompt();
    terminal.begin("for i in 1..200 { step 100 }");
    terminal.press(&format!("{ANSWER}6 * 7"));
    terminal.wait_for_line("> 6 * 7");
    terminal.press("\r");
    terminal.wait_for("\n42\n");
}

#[test]
fn where_letters_are_drawn_the_picture_has_lines() {
    let mut session = Session::new();
    session.run(FOUR_BAR).expect("a four-bar");
    let scene = Scene::new(session.world());
    let lines = Drawable::Scene(&scene).sketch(PAGE[0], PAGE[1]).lines();
    let picture = wanted(16, 32);
    let svg = Drawable::Scene(&scene).svg();
    let side = |name: &str| {
        let (_, behind) = svg.split_once(&format!(" {name}=\"")).expect("a side");
        behind.split('"').next().expect("a number").parse::<f64>().expect("a number")
    };
    // Below the drawing is the scale, which letters leave out.
    let (width, height) = (side("width"), side("height") - SCALE_HEIGHT);
    let block = (width / PAGE[0] as f64).max(height / (2 * PAGE[1]) as f64);
    let fine = block * picture.width as f64 / width;
    // Empty rows above are left out in letters.
    let is_met = |above: usize| {
        let mut blocks = lines.iter().enumerate().flat_map(|(row, line)| {
            let is_block = |c: char| ('\u{2580}'..='\u{2588}').contains(&c);
            let columns = line.chars().enumerate().filter(move |(_, c)| is_block(*c));
            columns.map(move |(column, _)| (column, row + above))
        });
        blocks.all(|(column, row)| {
            let from = |n: f64| (n * fine - 0.5 * fine).max(0.0) as usize;
            let to = |n: f64| (n * fine + 0.5 * fine) as usize;
            let (column, row) = (column as f64, 2.0 * row as f64);
            let mut xs = from(column)..to(column + 1.0);
            xs.any(|x| (from(row)..to(row + 2.0)).any(|y| !picture.is_paper(x, y)))
        })
    };
    assert!(lines.len() > 8 && (0..6).any(is_met), "{lines:?}");
}

#[test]
fn a_terminal_that_does_not_answer_gets_letters() {
    let terminal = session(&[], &[]);
    terminal.enter("show");
    terminal.wait("blocks", |it| it.screen().contains(['\u{2580}', '\u{2584}']));
    terminal.enter("1 + 2");
    terminal.wait_for("\n3\n");
    // What is typed meanwhile is not lost.
    let terminal = session(&[], &[]);
    terminal.press("show\r1 + 3\r");
    terminal.wait_for("\n4\n");
}

#[test]
fn whoever_wants_letters_gets_them() {
    let is_graphic = |bytes: &[u8]| {
        [&b"\x1b_G"[..], b"\x1bP", b"\x1b]1337", b"\x1b[c"]
            .iter()
            .any(|order| bytes.windows(order.len()).any(|it| it == *order))
    };
    let check = |env: &[(&str, &str)], args: &[&str]| {
        let terminal = session(env, args);
        terminal.press("show\r");
        terminal.wait("blocks", |it| it.screen().contains(['\u{2580}', '\u{2584}']));
        terminal.wait_for_prompt();
        assert!(!is_graphic(&terminal.bytes()), "{env:?} {args:?}");
    };
    check(&[("TERM", "xterm-kitty"), ("LINKWORK_GRAPHICS", "none")], &[]);
    // A variable that is empty is none.
    let terminal = session(&[("TERM", "xterm-kitty"), ("LINKWORK_GRAPHICS", "")], &[]);
    terminal.enter("show");
    assert!(is_graphic(&terminal.bytes()));
    check(&[("TERM", "xterm-kitty")], &["--graphics", "none"]);
    check(&[("TERM", "xterm-kitty"), ("NO_COLOR", "1")], &[]);
    // What is no terminal gets none, whatever is wanted.
    let shown = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .env("TERM", "xterm-kitty")
        .args(["--graphics", "kitty", "-e", FOUR_BAR, "-e", "show"])
        .output()
        .expect("it runs");
    assert!(!shown.stdout.contains(&0x1b) && shown.stdout.len() > 100);
}

#[test]
fn each_watched_run_ends_with_a_picture() {
    let home = tempdir().expect("a folder");
    let file = home.path().join("a.link");
    fs::write(&file, FOUR_BAR).expect("a file");
    let env = [("TERM", "xterm-kitty")];
    let start = Start { args: &["watch", "a.link"], env: &env, ..Start::default() };
    let terminal = Terminal::start(home.path(), &start);
    terminal.wait_for("runs again when it changes");
    assert_same(&of_kitty(&terminal.bytes()), &wanted(16, 32), 0);
    let n = terminal.bytes().len();
    fs::write(&file, format!("{FOUR_BAR}; step 10")).expect("a file");
    let ends = |it: &Terminal| between(&it.bytes()[n..], b"\x1b_G", b"Ctrl-C ends").is_some();
    terminal.wait("another picture", ends);
    terminal.press("\x03");
    assert_eq!(terminal.end().code(), Some(130));
}
