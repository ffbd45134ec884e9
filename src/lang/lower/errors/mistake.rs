//! What is wrong where the grammar stops: what was found, and what to type instead.

use std::borrow::Cow;
use std::ops::Range;

use pest::error::{Error, ErrorVariant, InputLocation};

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::Unit;
use crate::lang::catalogue::{self, ConstraintWord};

use super::expected::{Expected, PATH};
use super::refusal;
use crate::lang::grammar::Rule;
use crate::lang::lower::Reader;
use crate::lang::lower::prefix::{first_word, is_short, is_word_char, reads};

impl Reader<'_> {
    /// What to say when `rule` does not fit the bytes `range`.
    pub fn syntax_error(
        &self,
        error: &Error<Rule>,
        rule: Rule,
        range: &Range<usize>,
    ) -> Diagnostic {
        let (InputLocation::Pos(at) | InputLocation::Span((at, _))) = error.location;
        let stopped_at = range.start + at;
        let at = self.start_of_sign(range.start, stopped_at);
        let ErrorVariant::ParsingError { positives, .. } = &error.variant else {
            // Little stack was left to begin with, and pest stopped before it ran out.
            return refusal::too_long(self.span(range.clone()));
        };
        let is_bare = rule == Rule::bare;
        let word = if is_bare { "print" } else { first_word(&self.text[range.clone()]) };
        let before = self.text[range.start..at].trim_end();
        let expected = Expected::new(positives, word, before == word);
        if let Some(problem) = self.point_left_out(word, before, range, &expected) {
            return problem;
        }
        let found = self.found_at(at, range.end);
        let message = match found.what {
            Found::End if rule == Rule::prefix || is_bare => {
                "the statement is not complete".to_owned()
            }
            Found::End => format!("`{word}` is not complete"),
            _ => format!("unexpected {}", found.term),
        };
        let label =
            if at < stopped_at { "not expected here".to_owned() } else { expected.to_string() };
        let code = if found.what == Found::End { errors::INCOMPLETE } else { errors::UNEXPECTED };
        let problem = Diagnostic::error(code, message).at(found.span, label);
        let misspelt = expected.near(found.word(self)).or_else(|| {
            // Taken for a name, it was meant to be the keyword that is now missing.
            expected.near(last_word(before).filter(|word| word.len() > 2)?)
        });
        let behind = &self.text[found.span.range().end..range.end];
        let short = misspelt.is_none() || found.word(self).len() <= 2;
        let other_points = other_points(word, before, found.word(self), behind, &expected);
        let statement = &self.text[range.clone()];
        let reworded = if is_bare {
            compared(before, found.term.trim_matches('`'), behind)
        } else {
            let rest = &self.text[found.span.range().start..range.end];
            without_parentheses(statement, word)
                .or_else(|| with_word(before, &expected, rest))
                .or_else(|| as_position(statement, word))
        };
        let help = match (misspelt, other_points.filter(|_| short)) {
            _ if reworded.is_some() => reworded,
            (_, Some(name)) => Some(format!(
                "a constraint keeps its points: `delete {}`, and state it anew with others",
                brief(name)
            )),
            (Some(near), None) => Some(format!("did you mean `{near}`?")),
            (None, None) => self.hint(&found, &expected, word, before, range.end),
        };
        let problem = match help {
            Some(help) => problem.help(help),
            None => problem,
        };
        let problem = match self.line_held_open(range.start, at) {
            Some(comma) => problem.also(comma, "this comma holds the statement open"),
            None => problem,
        };
        match catalogue::entry(word).filter(|_| !is_bare) {
            Some(entry) => problem.help(format!("usage: `{}`", entry.usage)),
            None => problem,
        }
    }

    /// The word of a part that was taken for a point, since a point is missing before it:
    /// `motor B radius 1`.
    fn point_left_out(
        &self,
        verb: &str,
        before: &str,
        range: &Range<usize>,
        expected: &Expected,
    ) -> Option<Diagnostic> {
        let pattern = ConstraintWord::named(verb)?.pattern();
        let word = last_word(before)?;
        let is_part = pattern.entry.usage.split([' ', '[', ']', '|']).any(|part| part == word)
            && word.starts_with(char::is_lowercase);
        if !is_part || word == verb || expected.has("a value") || expected.has("a point") {
            return None;
        }
        let end = range.start + before.len();
        let span = self.span(end - word.len()..end);
        Some(
            Diagnostic::error(errors::UNEXPECTED, format!("unexpected `{word}`"))
                .at(span, "expected a point")
                .help(format!("usage: `{}`", pattern.entry.usage)),
        )
    }

    /// Where the sign begins that `at` is in: of `==` the first `=` is read as one of its own.
    fn start_of_sign(&self, start: usize, at: usize) -> usize {
        let begins_sign = |from: usize| {
            let rest = self.text.get(from..).unwrap_or("");
            SIGNS.iter().any(|sign| sign.len() > at - from && rest.starts_with(sign))
        };
        let before = (start.max(at.saturating_sub(2))..at).find(|&from| begins_sign(from));
        before.unwrap_or(at)
    }

    /// What to type instead of what was found behind `before`.
    fn hint(
        &self,
        found: &FoundAt,
        expected: &Expected,
        verb: &str,
        before: &str,
        end: usize,
    ) -> Option<String> {
        let word = found.word(self);
        let behind = &self.text[found.span.range().end..end];
        let is_number = word.starts_with(|char: char| char.is_ascii_digit());
        let help = match &*found.term {
            "`=`" if before == verb && verb != "let" => format!(
                "`{verb}` is a command; to give a parameter of that name a value, write \
                 `let {verb} = ...`"
            ),
            "`=`" if verb == "set" => format!("leave the `=` out: `{} ...`", brief(before)),
            "`.`" if behind.starts_with(is_word_char) => {
                "only vectors have components: `(x, y).x`".to_owned()
            }
            "`+`" if expected.has("a value") => "leave the `+` out".to_owned(),
            _ if expected.terms == ["`..`"] => "a range is written `a..b`".to_owned(),
            _ if verb == "plot"
                && expected.has(PATH)
                && !self.text[found.span.range().start..end].contains(".svg") =>
            {
                "`plot` draws what `sample` collects: `sample \"error\" = distance(A, B)`"
                    .to_owned()
            }
            _ if verb == "fit" && expected.has(PATH) && !word.is_empty() => {
                format!("say which: `to minimise {word}{0}`, or `to maximise ...`", brief(behind))
            }
            _ if expected.has(PATH) && !word.is_empty() => {
                format!(
                    "a path stands in quotes: `{verb} \"{}\"`",
                    brief(&format!("{word}{behind}"))
                )
            }
            _ if expected.has("a relation") && is_number => {
                let value = &self.text[found.span.range().start..end];
                format!("did you mean `{} = {}`?", brief(before), brief(value))
            }
            _ if verb == "change" && last_word(before) == Some("to") => {
                "a value stands behind `=`: `change coupler = 4`".to_owned()
            }
            _ if expected.has("`to`") && verb == "distance" => {
                "for the distance of two points, write `length A B`".to_owned()
            }
            _ if expected.has("`frozen`")
                && catalogue::trade(word).is_some_and(|trade| trade.command == "freeze") =>
            {
                "did you mean `frozen`?".to_owned()
            }
            _ if expected.has("`,`") && expected.has("`)`") && found.what == Found::Word => {
                "a comma stands between two values".to_owned()
            }
            _ if word.starts_with('\'') => "a string stands in double quotes: `\"...\"`".to_owned(),
            _ if before.ends_with(|char: char| char.is_ascii_digit())
                && Unit::ALL.iter().any(|unit| unit.suffix() == word) =>
            {
                format!(
                    "the unit stands right behind its number: `{}{word}`",
                    brief(last_number(before))
                )
            }
            _ => return found.meaning().map(str::to_owned),
        };
        Some(help)
    }

    /// What stands at `at` in a statement that ends at `end`.
    pub fn found_at(&self, at: usize, end: usize) -> FoundAt {
        let statement = &self.text[..end];
        let rest = &statement[at..];
        let Some(first) = rest.chars().next() else {
            let end = statement.trim_end().len();
            return FoundAt { what: Found::End, term: String::new(), span: self.span(end..end) };
        };
        let (what, len) = if first == '"' {
            (Found::String, rest.find('\n').unwrap_or(rest.len()))
        } else if is_word_char(first) {
            (Found::Word, word_len(rest))
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
            (Found::Sign, sign.map_or(first.len_utf8(), |sign| sign.len()))
        };
        let term = match what {
            Found::String => "string".to_owned(),
            Found::Sign => match odd_char(first) {
                Some(odd) => odd.to_owned(),
                None => format!("`{}`", brief(&rest[..len])),
            },
            _ => format!("`{}`", brief(&rest[..len])),
        };
        FoundAt { what, term, span: self.span(at..at + len) }
    }

    /// The comma at the end of the line above `at`, if the line of `at` begins with a verb:
    /// then it was probably meant to be a statement of its own.
    fn line_held_open(&self, start: usize, at: usize) -> Option<Span> {
        let before = &self.text[start..at];
        let newline = before.rfind('\n')?;
        let line = before[newline..].trim_start();
        catalogue::rule(first_word(line))?;
        let comma = before[..newline].trim_end().strip_suffix(',')?.len() + start;
        Some(self.span(comma..comma + 1))
    }
}

/// Signs of more than one character that are, or look as if they were, of the language.
const SIGNS: [&str; 16] = [
    "...", "..", ":=", "==", "<=", ">=", "=<", "=>", "!=", "<>", "**", "&&", "||", "+=", "-=", "//",
];

/// What stands where the grammar expected something else.
pub(crate) struct FoundAt {
    what: Found,
    /// As a message calls it.
    pub term: String,
    pub span: Span,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Found {
    End,
    Word,
    String,
    Sign,
}

impl FoundAt {
    fn word<'a>(&self, reader: &Reader<'a>) -> &'a str {
        if self.what == Found::Word { &reader.text[self.span.range()] } else { "" }
    }

    /// What a sign of another language is called here.
    pub fn meaning(&self) -> Option<&'static str> {
        Some(match self.term.trim_matches('`') {
            "==" => "one `=` compares, and one gives a value",
            ":=" => "write `=`",
            "=<" => "write `<=`",
            "=>" => "write `>=`",
            "!=" | "<>" => "the relations are `=`, `<`, `<=`, `>`, `>=` and `in a..b`",
            "**" => "a power is written `a^b`",
            "%" => "the remainder is `mod(a, b)`",
            ".." => "a range stands behind `in`",
            "..." => "a range is written `a..b`",
            "//" => "a comment begins with `#`",
            "+=" | "-=" => "write out the new value behind a single `=`",
            "." => "a digit stands behind a decimal point: `2.0`, or `2`",
            "[" => "an index stands right behind its name: `p[3]`",
            "{" => "a block belongs to `for` and `define` only",
            "\u{201c}" | "\u{201d}" | "\u{201e}" | "\u{2018}" | "\u{2019}" => {
                "a string stands in straight quotes: `\"...\"`"
            }
            "\u{2212}" | "\u{2013}" | "\u{2014}" => "a minus is the `-` of the keyboard",
            "\u{d7}" | "\u{b7}" => "a product is written `a * b`",
            "\u{b0}" => "degrees are written `90deg`",
            NO_BREAK_SPACE | ODD_BLANK => "type a space of the keyboard in its place",
            _ => return None,
        })
    }
}

const NO_BREAK_SPACE: &str = "no-break space";
const ODD_BLANK: &str = "odd blank";

/// What asks whether a comparison holds that stands there as a value.
fn compared(left: &str, sign: &str, right: &str) -> Option<String> {
    let sign = match sign {
        "=" | "<" | "<=" | ">" | ">=" => sign,
        "==" => "=",
        "=<" => "<=",
        "=>" => ">=",
        _ => return None,
    };
    let statement = format!("assert {left} {sign} {}", right.trim());
    let is_one = is_short(&statement) && reads(&statement);
    is_one.then(|| format!("to ask whether that holds, write `{statement}`"))
}

/// What to type where a command has its parts in parentheses, as functions have.
fn without_parentheses(statement: &str, word: &str) -> Option<String> {
    let inside = statement.strip_prefix(word)?.trim_start().strip_prefix('(')?;
    let (inside, behind) = inside.split_once(')')?;
    if inside.contains('(') {
        // Each pair would be tried within the trial of the one around it.
        return None;
    }
    let blanks = inside.replace(',', " ");
    let mut reworded = [inside, &blanks].into_iter().map(|inside| {
        let words = format!("{word} {inside} {behind}");
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    });
    let statement = reworded.find(|statement| is_short(statement) && reads(statement))?;
    Some(format!("a command has no parentheses: `{statement}`"))
}

/// The statement with the only word or sign that could stand before its rest.
fn with_word(before: &str, expected: &Expected, rest: &str) -> Option<String> {
    let [word] = &expected.terms[..] else { return None };
    let word = word.strip_prefix('`')?.strip_suffix('`')?;
    let rests = [Some(rest.to_owned()), vector(rest)].into_iter().flatten();
    let blank = if word == "," { "" } else { " " };
    let mut statements = rests.map(|rest| format!("{before}{blank}{word} {rest}"));
    let statement = statements.find(|statement| is_short(statement) && reads(statement))?;
    Some(format!("did you mean `{statement}`?"))
}

/// The statement with a position in parentheses where two numbers stand behind its `=` or `to`.
fn as_position(statement: &str, verb: &str) -> Option<String> {
    let sign = match verb {
        "point" => " = ",
        "move" | "drag" | "pull" => " to ",
        _ => return None,
    };
    let (before, numbers) = statement.split_once(sign)?;
    let statement = format!("{before}{sign}{}", vector(numbers)?);
    let is_one = is_short(&statement) && reads(&statement);
    is_one.then(|| format!("a position is a vector: `{statement}`"))
}

/// Two numbers as a vector.
fn vector(text: &str) -> Option<String> {
    let mut numbers = text.split([' ', '\t', ',']).filter(|number| !number.is_empty());
    let (x, y) = (numbers.next()?, numbers.next()?);
    let are_numbers = [x, y].iter().all(|number| number.parse::<f64>().is_ok());
    (are_numbers && numbers.next().is_none()).then(|| format!("({x}, {y})"))
}

/// The name in a `change` that gives other points, as the statement does that makes a constraint:
/// two names stand behind it.
fn other_points<'a>(
    verb: &str,
    before: &'a str,
    found: &str,
    behind: &str,
    expected: &Expected,
) -> Option<&'a str> {
    let is_name = |text: &str| text.starts_with(|char: char| char.is_alphabetic() || char == '_');
    let name = before.strip_prefix(verb)?.trim();
    let second = first_word(behind.trim_start().trim_start_matches(',').trim_start());
    let are_points = is_name(found) && is_name(second) && !expected.has(&format!("`{second}`"));
    (verb == "change" && is_name(name) && !name.contains(' ') && are_points).then_some(name)
}

/// How long the word or number is that `text` begins with.
fn word_len(text: &str) -> usize {
    let word = |from: usize| {
        let len = text[from..].find(|char| !is_word_char(char));
        len.map_or(text.len(), |len| from + len)
    };
    let len = word(0);
    let decimals = text[len..]
        .strip_prefix('.')
        .is_some_and(|rest| rest.starts_with(|char: char| char.is_ascii_digit()));
    if decimals && text.starts_with(|char: char| char.is_ascii_digit()) {
        word(len + 1)
    } else {
        len
    }
}

/// The beginning of a word, if it is too long for a message.
pub(crate) fn brief(word: &str) -> Cow<'_, str> {
    match word.char_indices().nth(40) {
        Some((end, _)) => Cow::Owned(format!("{}...", &word[..end])),
        None => Cow::Borrowed(word),
    }
}

fn odd_char(char: char) -> Option<&'static str> {
    match char {
        '\u{a0}' | '\u{202f}' | '\u{2007}' => Some(NO_BREAK_SPACE),
        _ if char.is_whitespace() => Some(ODD_BLANK),
        _ if char.is_control() => Some("control character"),
        _ => None,
    }
}

/// The word that `text` ends with.
fn last_word(text: &str) -> Option<&str> {
    let word = text.rsplit(|char| !is_word_char(char)).next()?;
    (!first_word(word).is_empty()).then_some(word)
}

/// The digits that `text` ends with.
fn last_number(text: &str) -> &str {
    text.rsplit(|char: char| !char.is_ascii_digit() && char != '.').next().unwrap_or("")
}
