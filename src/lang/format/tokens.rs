//! The words and signs of one statement, and the blanks between them.

use std::ops::Range;

use crate::lang::layout::string_end;
use crate::lang::lower::{Signs, is_word_char};

/// A line of a statement.
#[derive(Debug, Default)]
pub(super) struct Row {
    pub code: String,
    pub comment: String,
    /// Does it begin with a closing bracket?
    pub closes: bool,
}

/// A word, a string or a sign.
#[derive(Debug, Clone, Copy)]
struct Token<'a> {
    text: &'a str,
    at: usize,
    /// Where the next one on its line begins.
    behind: usize,
    /// What follows it.
    rest: &'a str,
    /// Did blanks stand before it?
    is_apart: bool,
}

/// The lines of the statement at `head`, without indents.
pub(super) fn rows(text: &str, head: &Range<usize>, signs: &Signs) -> Vec<Row> {
    let mut rows = vec![Row::default()];
    let mut spacing =
        Spacing { signs, open: Vec::new(), range: None, last: None, operator: "", is_wide: true };
    let mut at = head.start;
    let mut is_apart = false;
    while at < head.end {
        let rest = &text[at..head.end];
        let len = token_len(rest);
        let behind = head.end - rest[len..].trim_start_matches([' ', '\t']).len();
        let token = Token { text: &rest[..len], at, behind, rest: &rest[len..], is_apart };
        at += len;
        is_apart = token.text.trim().is_empty();
        let row = rows.last_mut().expect("there is one from the start");
        match token.text.as_bytes()[0] {
            b'\n' => {
                if !row.code.is_empty() || !row.comment.is_empty() {
                    rows.push(Row::default());
                }
                spacing.last = None;
            }
            b'#' => row.comment.push_str(token.text),
            _ if is_apart => {}
            b'\\' => row.code.push_str(" \\"),
            first => {
                row.closes |= row.code.is_empty() && matches!(first, b')' | b']');
                if spacing.is_gap_before(token) {
                    row.code.push(' ');
                }
                row.code.push_str(token.text);
                spacing.pass(token);
            }
        }
    }
    rows
}

/// What has been written so far, as far as blanks depend on it.
struct Spacing<'a> {
    signs: &'a Signs,
    /// The brackets that are open.
    open: Vec<&'a str>,
    /// How many were open at the `..` whose upper end is being written.
    range: Option<usize>,
    /// The last token of this line.
    last: Option<Token<'a>>,
    /// The operator before the last operand, if there is one.
    operator: &'a str,
    /// Did the last operator get a blank before it?
    is_wide: bool,
}

impl<'a> Spacing<'a> {
    fn pass(&mut self, token: Token<'a>) {
        match token.text {
            "[" | "(" => self.open.push(token.text),
            "]" | ")" => drop(self.open.pop()),
            ".." => self.range = Some(self.open.len()),
            "," => self.range = None,
            _ => {}
        }
        if self.signs.is_binary(token.at) {
            self.is_wide = self.is_wide(token);
            self.operator = token.text;
        } else if !self.last.is_some_and(|last| self.signs.is_binary(last.at)) {
            self.operator = "";
        }
        self.last = Some(token);
    }

    /// Does a blank stand between the last token and this?
    fn is_gap_before(&self, next: Token<'_>) -> bool {
        let Some(last) = self.last else { return false };
        match (last.text, next.text) {
            (_, "," | ")" | "]" | ":" | "..") | ("(" | "[" | "..", _) => false,
            ("," | ":", _) => true,
            _ if is_relation(last.text) || is_relation(next.text) => true,
            _ if self.signs.is_unary(last.at) => false,
            _ if self.signs.is_binary(last.at) => self.is_wide,
            _ if self.signs.is_binary(next.at) => self.is_wide(next),
            _ if self.signs.is_unary(next.at) => true,
            (")" | "]", word) if word.starts_with(is_word_char) => true,
            _ => next.is_apart,
        }
    }

    /// Does an operator behind the last token have blanks around it? Not that of a power, in an
    /// index, or in a range, nor the stroke of a fraction of two numbers that no product comes before: `1/360`.
    fn is_wide(&self, operator: Token<'_>) -> bool {
        let is_number = |at| self.signs.is_number(at);
        let is_fraction = self.last.is_some_and(|last| is_number(last.at))
            && is_number(operator.behind)
            && !matches!(self.operator, "*" | "/" | "^");
        match operator.text {
            "^" => false,
            "/" if is_fraction => false,
            _ if leads_to_dots(operator.rest) => false,
            _ => self.open.last() != Some(&"[") && self.range != Some(self.open.len()),
        }
    }
}

/// Does `rest` go on to the `..` of a range, within the brackets that are open and the value that
/// is being written?
fn leads_to_dots(rest: &str) -> bool {
    let mut depth = 0;
    for (at, char) in rest.char_indices() {
        match char {
            '.' if depth == 0 && rest[at..].starts_with("..") => return true,
            '(' | '[' => depth += 1,
            ' ' if depth == 0 && rest[at..].starts_with(" in ") => return false,
            ')' | ']' | ',' | '=' | '<' | '>' | '"' | '#' if depth == 0 => return false,
            ')' | ']' => depth -= 1,
            _ => {}
        }
    }
    false
}

fn is_relation(text: &str) -> bool {
    matches!(text, "=" | "<=" | ">=" | "<" | ">")
}

/// How long the token is that `rest` begins with: blanks within a line are one, a line end is.
fn token_len(rest: &str) -> usize {
    let first = rest.chars().next().expect("something is left");
    let while_ = |keep: fn(char) -> bool| rest.find(|c| !keep(c)).unwrap_or(rest.len());
    match first {
        '\n' => 1,
        '#' => rest.find('\n').unwrap_or(rest.len()),
        '"' => string_end(rest.as_bytes(), 0).unwrap_or_else(|end| end),
        _ if first.is_whitespace() => while_(|c| c.is_whitespace() && c != '\n'),
        _ if ["..", "<=", ">="].iter().any(|sign| rest.starts_with(sign)) => 2,
        _ if is_word_char(first) || first == '.' => word_len(rest),
        _ => first.len_utf8(),
    }
}

/// Words, numbers and members: letters, digits, and single dots in between.
fn word_len(rest: &str) -> usize {
    let mut len = 0;
    for char in rest.chars() {
        let is_dot = char == '.' && !rest[len..].starts_with("..");
        if !is_word_char(char) && !is_dot {
            break;
        }
        len += char.len_utf8();
    }
    len
}
