//! How a line looks: colours for its pieces, and the mark of lines that go on.

use crate::lang::Class;
use crate::session::{CONTINUATION, Piece};

const RESET: &str = "\x1b[0m";
const FAINT: &str = "\x1b[90m";

/// What switches the look of a piece on; none where it looks like other text.
fn style(piece: &Piece) -> Option<&'static str> {
    if piece.is_unknown {
        return Some("\x1b[4;31m");
    }
    match piece.class {
        Class::Command => Some("\x1b[1m"),
        Class::Clause => Some("\x1b[36m"),
        Class::Function => Some("\x1b[34m"),
        Class::Number => Some("\x1b[33m"),
        Class::Text => Some("\x1b[32m"),
        Class::Comment => Some(FAINT),
        Class::Name | Class::NewName | Class::Sign => None,
    }
}

/// Letters of a statement that are shown.
const MOST_LETTERS: usize = 70;

/// A statement of a page, as a line above the prompt.
pub fn of_page(statement: &str) -> String {
    let line = statement.lines().next().unwrap_or_default();
    let is_long = line.chars().count() > MOST_LETTERS || line.len() < statement.len();
    let shown: String = line.chars().take(MOST_LETTERS).collect();
    format!("page: {shown}{}\n", if is_long { " ..." } else { "" })
}

/// A text with the colours of its pieces, and the marks of its lines behind the first.
pub fn coloured(text: &str, pieces: &[Piece]) -> String {
    let mut shown = String::with_capacity(2 * text.len());
    let mut at = 0;
    for piece in pieces {
        push_plain(&mut shown, &text[at..piece.range.start], !pieces.is_empty());
        let part = &text[piece.range.clone()];
        match style(piece) {
            Some(style) => shown.extend([style, part, RESET]),
            None => shown.push_str(part),
        }
        at = piece.range.end;
    }
    push_plain(&mut shown, &text[at..], !pieces.is_empty());
    shown
}

/// Adds what has no look of its own: blanks, and with them the beginnings of lines.
fn push_plain(shown: &mut String, plain: &str, is_coloured: bool) {
    let mut rest = plain;
    while let Some(newline) = rest.find('\n') {
        shown.push_str(&rest[..=newline]);
        rest = &rest[newline + 1..];
        if let Some(behind) = rest.strip_prefix("    ") {
            if is_coloured {
                shown.extend([FAINT, CONTINUATION, RESET]);
            } else {
                shown.push_str(CONTINUATION);
            }
            rest = behind;
        }
    }
    shown.push_str(rest);
}

/// A text that is less than what is typed.
pub fn faint(text: &str) -> String {
    format!("{FAINT}{text}{RESET}")
}

/// A text without the blanks that its continuation lines begin with.
pub fn without_marks(text: &str) -> String {
    let blanks = " ".repeat(CONTINUATION.len());
    let mut lines = text.split('\n');
    let first = lines.next().unwrap_or_default();
    let is_marked = lines.clone().all(|line| line.starts_with(&blanks) || line.trim().is_empty());
    if !is_marked {
        return text.to_owned();
    }
    let rest = lines.map(|line| line.strip_prefix(&blanks).unwrap_or_default());
    std::iter::once(first).chain(rest).collect::<Vec<_>>().join("\n")
}
