//! Pictures in terminals that can show more than letters, and which of them can.

mod iterm;
mod kitty;
mod png;
#[cfg(unix)]
mod question;
mod sixel;

#[cfg(unix)]
use std::io::Write as _;
use std::io::{self, IsTerminal};
#[cfg(unix)]
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

use clap::ValueEnum;

use super::environment;
use crate::render::{Drawable, Pixels};
#[cfg(unix)]
use question::Asked;
pub use question::{forget as forget_answer, is_due as is_answer_due, take_typed};

/// How pictures are shown in a terminal.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Graphics {
    /// As the terminal can: by its environment, or by what it answers.
    #[default]
    Auto,
    /// In letters, two pixels each.
    None,
    /// By the protocol of kitty, which Ghostty and Konsole know too.
    Kitty,
    /// By that of iTerm2, which `WezTerm` knows too.
    Iterm,
    /// As sixels: foot, mlterm, Windows Terminal, xterm.
    Sixel,
}

static WISH: OnceLock<Graphics> = OnceLock::new();

/// Has pictures shown so from here on; set once, from the command line.
pub fn set(wish: Graphics) {
    WISH.get_or_init(|| wish);
}

/// How a terminal takes pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Protocol {
    Kitty,
    Iterm,
    Sixel,
}

/// What is known of the terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Screen {
    protocol: Option<Protocol>,
    /// Width and height of a letter, pixels.
    cell: [usize; 2],
}

/// The size of a letter where nobody says it. Where a picture is told the columns it takes, a finer
/// one loses nothing.
const CELL: [usize; 2] = [10, 20];
const FINE_CELL: [usize; 2] = [16, 32];

/// What shows a picture, for a terminal of so many columns and rows; none where letters have to do.
pub fn picture(
    of: Drawable,
    [n_columns, n_rows]: [usize; 2],
    wants_colours: bool,
) -> Option<Vec<u8>> {
    let screen = screen(wants_colours);
    let protocol = screen.protocol?;
    let [wide, high] = screen.cell;
    let pixels = Pixels::of(&of.svg(), [n_columns * wide, n_rows * high]);
    let columns = pixels.size()[0].div_ceil(wide);
    Some(match protocol {
        Protocol::Kitty => kitty::picture(&pixels, columns),
        Protocol::Iterm => iterm::picture(&pixels, columns),
        Protocol::Sixel => sixel::picture(&pixels),
    })
}

/// What is known of the terminal; it is asked once.
fn screen(wants_colours: bool) -> Screen {
    static KNOWN: Mutex<Option<Screen>> = Mutex::new(None);
    let letters = Screen { protocol: None, cell: CELL };
    let fine = |protocol| Screen { protocol: Some(protocol), cell: FINE_CELL };
    if !io::stdout().is_terminal() {
        return letters;
    }
    match WISH.get().copied().unwrap_or_default() {
        Graphics::None => letters,
        Graphics::Kitty => fine(Protocol::Kitty),
        Graphics::Iterm => fine(Protocol::Iterm),
        Graphics::Sixel => Screen { protocol: Some(Protocol::Sixel), cell: CELL },
        Graphics::Auto if !wants_colours => letters,
        Graphics::Auto => {
            let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(screen) = *known {
                return screen;
            }
            match by_environment(&environment::text) {
                Told::Protocol(protocol) => *known.insert(fine(protocol)),
                Told::Letters => *known.insert(letters),
                // Who types already is not to lose a letter: the next picture asks.
                Told::Nothing => ask().map_or(letters, |screen| *known.insert(screen)),
            }
        }
    }
}

/// What the environment says of the terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Told {
    Protocol(Protocol),
    Letters,
    Nothing,
}

fn by_environment(variable: &dyn Fn(&str) -> Option<String>) -> Told {
    let is = |name: &str, value: &str| variable(name).is_some_and(|it| it == value);
    let term = variable("TERM").unwrap_or_default();
    let is_there = |name: &str| variable(name).is_some();
    if term.is_empty() || term == "linux" || term.starts_with("eterm") || is_there("INSIDE_EMACS") {
        return Told::Letters;
    }
    // What runs within another shows what that one can; the environment tells of the other.
    if is_there("TMUX") || is_there("STY") || term.starts_with("screen") || term.starts_with("tmux")
    {
        return Told::Nothing;
    }
    if is_there("KITTY_WINDOW_ID") || term.contains("kitty") || term.contains("ghostty") {
        return Told::Protocol(Protocol::Kitty);
    }
    if is("TERM_PROGRAM", "iTerm.app")
        || is("LC_TERMINAL", "iTerm2")
        || is("TERM_PROGRAM", "WezTerm")
    {
        return Told::Protocol(Protocol::Iterm);
    }
    Told::Nothing
}

/// A terminal that says nothing is asked so often.
#[cfg(unix)]
const MOST_SILENT: u32 = 2;

/// Asks the terminal; none where that cannot be done now, or may be worth another try.
#[cfg(unix)]
fn ask() -> Option<Screen> {
    static N_SILENT: AtomicU32 = AtomicU32::new(0);
    drop(io::stdout().flush());
    match question::ask() {
        Asked::Answered(answer) => {
            let protocol = answer.has_sixel.then_some(Protocol::Sixel);
            Some(Screen { protocol, cell: answer.cell.unwrap_or(CELL) })
        }
        Asked::Silent if N_SILENT.fetch_add(1, Ordering::Relaxed) + 1 >= MOST_SILENT => {
            Some(Screen { protocol: None, cell: CELL })
        }
        Asked::Silent | Asked::NotNow => None,
    }
}

#[cfg(not(unix))]
fn ask() -> Option<Screen> {
    Some(Screen { protocol: None, cell: CELL })
}

#[cfg(not(unix))]
mod question {
    //! Nothing is asked.

    pub fn is_due() -> bool {
        false
    }

    pub fn forget() {}

    pub fn take_typed() -> String {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminals_are_known_by_their_environment() {
        let told = |variables: &[(&str, &str)]| {
            by_environment(&|name| {
                variables.iter().find(|(it, _)| *it == name).map(|(_, value)| (*value).to_owned())
            })
        };
        let kitty = Told::Protocol(Protocol::Kitty);
        assert_eq!(told(&[("TERM", "xterm-kitty")]), kitty);
        assert_eq!(told(&[("TERM", "xterm-ghostty")]), kitty);
        assert_eq!(told(&[("TERM", "xterm-256color"), ("KITTY_WINDOW_ID", "1")]), kitty);
        let iterm = Told::Protocol(Protocol::Iterm);
        assert_eq!(told(&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "iTerm.app")]), iterm);
        assert_eq!(told(&[("TERM", "xterm-256color"), ("LC_TERMINAL", "iTerm2")]), iterm);
        assert_eq!(told(&[("TERM", "xterm-256color")]), Told::Nothing);
        // Within tmux the terminal around it is not the one that shows.
        let within = [("TERM", "tmux-256color"), ("KITTY_WINDOW_ID", "1"), ("TMUX", "/tmp/1")];
        assert_eq!(told(&within), Told::Nothing);
        for letters in ["", "linux", "eterm-color"] {
            assert_eq!(told(&[("TERM", letters)]), Told::Letters);
        }
    }
}
