//! What a statement begins with: a label, `add`, and the verb that says how to read the rest.

use std::ops::Range;

use crate::diag::{Diagnostic, Span, nearest};
use crate::errors;
use crate::lang::ast::{Function, Name};
use crate::lang::catalogue::{self, Trade};

use super::errors::mistake::brief;
use super::parsed::{Parsed, Thing};
use super::{Cursor, Reader, constraint};
use crate::lang::grammar::Rule;

/// What stands in front of a verb.
#[derive(Default)]
pub(super) struct Prefix {
    pub label: Option<Name>,
    pub add: Option<Span>,
}

impl<'a> Reader<'a> {
    /// Reads `label:` and `add`, in either order; gives what it found and where the verb begins.
    pub(super) fn prefix(&self, head: &Range<usize>) -> Result<(Prefix, usize), Diagnostic> {
        self.prefix_into(head, &mut Vec::new())
    }

    /// As [`Reader::prefix`]; what pest has read of it is laid out in a row.
    pub(super) fn prefix_into(
        &self,
        head: &Range<usize>,
        row: &mut Vec<Thing>,
    ) -> Result<(Prefix, usize), Diagnostic> {
        let text = &self.text[head.clone()];
        let Some(kind) = prefix_of(text) else {
            return Ok((Prefix::default(), head.start));
        };
        if let Some(problem) = self.misused_colon(text, kind, head.start) {
            return Err(problem);
        }
        self.read(Rule::prefix, head.clone(), row)?;
        self.prefix_in(row)
    }

    /// The prefix that a row begins with, and where the verb begins.
    pub(super) fn prefix_in(&self, row: &[Thing]) -> Result<(Prefix, usize), Diagnostic> {
        let mut prefix = Prefix::default();
        let mut cursor = Cursor::new(*self, Parsed::new(self.text, row, 0).inner());
        if cursor.peek() == Some(Rule::name) {
            prefix.label = Some(cursor.name()?);
        }
        prefix.add = cursor.take(Rule::kw_add).map(|pair| cursor.span(pair));
        if cursor.peek() == Some(Rule::name) {
            prefix.label = Some(cursor.name()?);
        }
        let verb = cursor.take(Rule::verb).expect("the grammar has a verb behind a prefix");
        Ok((prefix, verb.start()))
    }

    /// The first word and the rule to read its statement with.
    pub(super) fn verb(
        &self,
        prefix: &Prefix,
        range: &Range<usize>,
    ) -> Result<(&'a str, Rule), Diagnostic> {
        let text = &self.text[range.clone()];
        let word = first_word(text);
        if prefix.label.is_none() && prefix.add.is_none() && is_bare(text) {
            return Ok((word, Rule::bare));
        }
        let Some(rule) = catalogue::rule(word) else {
            return Err(self.unknown_verb(word, prefix, range));
        };
        let is_constraint = constraint::rule(word).is_some();
        let span = self.span(range.start..range.start + word.len());
        if let Some(label) = prefix.label.as_ref().filter(|_| !is_constraint) {
            let problem = Diagnostic::error(errors::LABEL, "only a constraint has a name in front")
                .at(label.span, "this name")
                .also(span, "not a constraint");
            return Err(if rule == Rule::point {
                problem.help("a point is named behind the word: `point A = (0, 0)`")
            } else {
                problem.help("leave the name and the `:` out")
            });
        }
        if let Some(add) = prefix.add.filter(|_| !is_constraint && rule != Rule::point) {
            return Err(Diagnostic::error(
                errors::LABEL,
                "`add` goes before a constraint or `point`",
            )
            .at(add, "")
            .also(span, "neither of them")
            .help(format!("leave it out: `{word} ...`")));
        }
        Ok((word, rule))
    }

    fn misused_colon(&self, text: &str, kind: PrefixKind, start: usize) -> Option<Diagnostic> {
        let PrefixKind::Label { colon } = kind else { return None };
        if !text[colon..].starts_with(":=") {
            return None;
        }
        let name = brief(text[..colon].trim_end());
        let span = self.span(start + colon..start + colon + 2);
        Some(
            Diagnostic::error(errors::UNEXPECTED, "unexpected `:=`")
                .at(span, "not an operator")
                .help(format!("to define a parameter, write `let {name} = ...`")),
        )
    }

    fn unknown_verb(&self, word: &str, prefix: &Prefix, range: &Range<usize>) -> Diagnostic {
        let text = &self.text[range.clone()];
        let span = self.span(range.start..range.start + word.len());
        let rest = text[word.len()..].trim_start();
        if word.is_empty() {
            return self.no_verb(text, prefix, range);
        }
        let is_assigned = assigned_name(text);
        if let Some(name) = is_assigned {
            let span = self.span(range.start..range.start + name.len());
            let name = brief(name);
            return Diagnostic::error(
                errors::ASSIGNMENT,
                format!("`{name} = ...` is not a statement"),
            )
            .at(span, "expected a command")
            .help(format!("to define a parameter, write `let {name} = ...`"))
            .help(format!("to declare a point, write `point {name} = (x, y)`"));
        }
        let shown = brief(word);
        let problem =
            Diagnostic::error(errors::UNKNOWN_COMMAND, format!("unknown command `{shown}`"));
        let expects_constraint = prefix.label.is_some() || prefix.add.is_some();
        let problem = problem
            .at(span, if expects_constraint { "expected a constraint" } else { "not a command" });
        let fits = |word: &str| !expects_constraint || constraint::rule(word).is_some();
        if let Some(trade) = catalogue::trade(word).filter(|trade| fits(trade.command)) {
            let statement = in_our_words(trade, prefix.label.as_ref(), rest);
            let problem = problem.help(format!("`{shown}` {}: `{statement}`", trade.says));
            return called(word, rest).into_iter().fold(problem, Diagnostic::help);
        }
        if let Some(called) = called(word, rest).filter(|_| !expects_constraint) {
            return problem.help(called);
        }
        if let Some(outside) = catalogue::outside(word).filter(|_| !expects_constraint) {
            return problem.help(outside.advice());
        }
        match meant(word, command_words().filter(|word| fits(word))) {
            Some(near) => problem.help(format!("did you mean `{near}`?")),
            None if rest.starts_with('(') => {
                problem.help(format!("to make what a definition says, write `use {shown}(...)`"))
            }
            None => problem.help("`help` lists the commands"),
        }
    }

    /// The statement begins with something that is no word.
    fn no_verb(&self, text: &str, prefix: &Prefix, range: &Range<usize>) -> Diagnostic {
        let has_prefix = prefix.label.is_some() || prefix.add.is_some();
        if text.is_empty() && has_prefix {
            return Diagnostic::error(errors::INCOMPLETE, "the statement is not complete")
                .at(self.span(range.end..range.end), "expected a constraint")
                .help("as in `coupler: length B C = 3.5`");
        }
        let expected = if has_prefix { "expected a constraint" } else { "expected a command" };
        // A block without a head leaves nothing in front of its brace.
        let end = if text.is_empty() { self.text.len() } else { range.end };
        let found = self.found_at(range.start, end);
        let problem = Diagnostic::error(errors::UNEXPECTED, format!("unexpected {}", found.term))
            .at(found.span, expected);
        match self.text.as_bytes()[range.start] {
            b'{' => problem.help("a block stands on the line of its `for` or `define`"),
            b'/' | b'%' => problem.help("a comment begins with `#`"),
            b'?' => problem.help("`help` lists the commands"),
            _ => match found.meaning() {
                Some(meaning) => problem.help(meaning),
                None => problem,
            },
        }
    }
}

/// Whether a statement without a verb is one of values: an expression or a string, or several.
///
/// A first word that is a command is that command, unless it is a function whose arguments
/// follow at once; one that is none and is followed by another word is a misspelt command.
pub fn is_bare(text: &str) -> bool {
    let word = first_word(text);
    if word.is_empty() {
        let begins_value = |char: char| char.is_ascii_digit() || "(-\"".contains(char);
        let begins_fraction = text.len() > 1 && text.starts_with('.') && text.as_bytes()[1] != b'.';
        return text.starts_with(begins_value) || begins_fraction;
    }
    if text[word.len()..].starts_with('(') {
        let mut names = Function::ALL.iter().map(|function| function.name());
        let is_function = names.any(|name| name == word);
        let is_command = catalogue::rule(word).is_some();
        return is_function || (!is_command && near_function(word));
    }
    if catalogue::rule(word).is_some() || word == "add" {
        return false;
    }
    let rest = text[name_end(text)..].trim_start();
    let is_word = rest.starts_with(is_word_char) && first_word(rest) != "in";
    !is_word && (!rest.starts_with(['=', ':', '"']) || rest.starts_with("=="))
}

fn near_function(word: &str) -> bool {
    nearest(word, Function::ALL.iter().map(|function| function.name())).is_some()
}

/// The command that an unknown word was probably meant to be, or the statement to type for a word
/// of the trade.
pub fn nearest_command(word: &str) -> Option<&'static str> {
    if let Some(trade) = catalogue::trade(word) {
        return Some(trade.example);
    }
    meant(word, command_words())
}

fn command_words() -> impl Iterator<Item = &'static str> {
    catalogue::commands().map(|entry| entry.keyword).chain(["add"])
}

/// Letters that say which word is begun with them.
const TELLING_LETTERS: usize = 3;

/// The word that was probably meant: the only one that begins so, or the nearest.
fn meant<'a>(word: &str, words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let words: Vec<&str> = words.collect();
    let is_telling = word.len() >= TELLING_LETTERS;
    let mut begun = words.iter().filter(|other| is_telling && other.starts_with(word));
    match (begun.next(), begun.next()) {
        (Some(only), None) => Some(only),
        _ => nearest(word, words),
    }
}

/// What to type where a function, or the beginning of one, has its values behind it as a command has.
fn called(word: &str, rest: &str) -> Option<String> {
    let mut functions = Function::ALL.iter();
    let is_meant = |name: &str| {
        name == word
            || (word.len() >= TELLING_LETTERS && name.starts_with(word) && !rest.is_empty())
    };
    let function = functions.find(|function| is_meant(function.name()))?;
    let name = function.name();
    let one_by_one = rest.split_whitespace().collect::<Vec<_>>().join(", ");
    let calls = [rest, &one_by_one].map(|values| format!("{name}({values})"));
    let call = calls.into_iter().find(|call| is_short(call) && reads(call));
    match call {
        Some(call) if name == word => Some(format!("values stand in parentheses: `{call}`")),
        Some(call) => Some(format!("did you mean `{call}`?")),
        None if name == word => {
            Some(format!("values stand in parentheses: `{}`", function.usage()))
        }
        None => None,
    }
}

/// The statement to type for a word of the trade: with what was typed behind it if that reads,
/// an example otherwise.
fn in_our_words(trade: &Trade, label: Option<&Name>, rest: &str) -> String {
    let label = label.map_or(String::new(), |label| format!("{label}: "));
    let sign = ["<=", "=", "in"]
        .into_iter()
        .find(|sign| trade.example.split(' ').any(|word| word == *sign));
    let with_sign = sign.and_then(|sign| related(rest, sign));
    // Without its relation a rope would be a rod.
    let as_it_is = (sign != Some("<=") && sign != Some("in")).then(|| rest.to_owned());
    let reworded = [as_it_is, with_sign].into_iter().flatten();
    let mut reworded = reworded.map(|rest| format!("{label}{} {rest}", trade.command));
    reworded
        .find(|text| !rest.is_empty() && is_short(text) && reads(text))
        .unwrap_or_else(|| trade.example.to_owned())
}

/// Longer statements are not repeated in a suggestion.
const LONGEST_STATEMENT: usize = 72;

/// Whether a statement may stand in a suggestion.
pub(super) fn is_short(text: &str) -> bool {
    text.len() < LONGEST_STATEMENT
}

/// What stands behind a verb, with `sign` before the number that it ends in.
fn related(rest: &str, sign: &str) -> Option<String> {
    let (before, number) = rest.rsplit_once([' ', '\t'])?;
    Some(format!("{} {sign} {number}", before.trim_end()))
}

/// Is it one whole statement?
pub(super) fn reads(text: &str) -> bool {
    let mut statements = crate::lang::parse(crate::diag::SourceId(0), text);
    matches!((statements.next(), statements.next()), (Some(Ok(_)), None))
}

#[derive(Clone, Copy)]
enum PrefixKind {
    Label { colon: usize },
    Add,
}

/// What the statement `text` has in front of its verb.
fn prefix_of(text: &str) -> Option<PrefixKind> {
    let name = name_end(text);
    let rest = &text[name..];
    let behind = rest.trim_start_matches([' ', '\t']);
    if name > 0 && behind.starts_with(':') {
        return Some(PrefixKind::Label { colon: text.len() - behind.len() });
    }
    let is_add = first_word(text) == "add" && !behind.starts_with('=');
    is_add.then_some(PrefixKind::Add)
}

/// The name that `text` gives a value to, if it reads `name = ...`.
fn assigned_name(text: &str) -> Option<&str> {
    let (name, rest) = text.split_at(name_end(text));
    let rest = rest.trim_start();
    let is_assigned = rest.starts_with('=') && !rest.starts_with("==");
    (is_assigned && catalogue::rule(name).is_none()).then_some(name)
}

/// The word that `text` begins with; empty if with none.
pub(super) fn first_word(text: &str) -> &str {
    let starts = |char: char| char == '_' || char.is_alphabetic();
    if !text.starts_with(starts) {
        return "";
    }
    &text[..text.find(|char| !is_word_char(char)).unwrap_or(text.len())]
}

/// As the grammar's `word_char`.
pub(in crate::lang) fn is_word_char(char: char) -> bool {
    matches!(char, '_' | '\'') || char.is_ascii_digit() || char.is_alphabetic()
}

/// How far the name goes that `text` begins with, its parts included.
pub(super) fn name_end(text: &str) -> usize {
    let mut end = first_word(text).len();
    if end == 0 {
        return 0;
    }
    loop {
        let rest = &text[end..];
        let member = rest.strip_prefix('.').map_or("", first_word);
        if !member.is_empty() {
            end += 1 + member.len();
        } else if rest.starts_with('[') {
            let Some(index) = bracketed(rest) else { return end };
            end += index;
        } else {
            return end;
        }
    }
}

/// How long the part in brackets is that `text` begins with.
fn bracketed(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' if depth == 1 => return Some(at + 1),
            b']' => depth -= 1,
            _ => {}
        }
    }
    None
}
