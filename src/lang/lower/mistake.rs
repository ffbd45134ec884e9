//! From the rules that pest expected to what a user would call them.

use std::ops::Range;

use pest::error::{Error, ErrorVariant, InputLocation};

use crate::diag::{Diagnostic, Span, nearest};
use crate::lang::ast::Unit;
use crate::lang::catalogue;

use super::grammar::Rule;
use super::opening::{first_word, is_word_char};
use super::{Reader, constraint, verb};

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
            panic!("only pest itself makes errors")
        };
        let word = first_word(&self.text[range.clone()]);
        let before = self.text[range.start..at].trim_end();
        let expected = Expected::new(positives, word, before == word);
        let found = self.found_at(at, range.end);
        let message = match found.what {
            Found::End if rule == Rule::prefix => "the statement is not complete".to_owned(),
            Found::End => format!("`{word}` is not complete"),
            _ => format!("unexpected {}", found.term),
        };
        let label =
            if at < stopped_at { "not expected here".to_owned() } else { expected.to_string() };
        let problem = Diagnostic::error(message).at(found.span, label);
        let misspelt = expected.near(found.word(self)).or_else(|| {
            // Taken for a name, it was meant to be the keyword that is now missing.
            expected.near(last_word(before).filter(|word| word.len() > 2)?)
        });
        let help = match misspelt {
            Some(near) => Some(format!("did you mean `{near}`?")),
            None => self.hint(&found, &expected, word, before, range.end),
        };
        let problem = match help {
            Some(help) => problem.help(help),
            None => problem,
        };
        let problem = match self.line_held_open(range.start, at) {
            Some(comma) => problem.also(comma, "this comma holds the statement open"),
            None => problem,
        };
        match catalogue::entry(word) {
            Some(entry) => problem.help(format!("usage: `{}`", entry.usage)),
            None => problem,
        }
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
            "`=`" if verb == "set" => format!("leave the `=` out: `{before} ...`"),
            "`.`" if behind.starts_with(is_word_char) => {
                "only vectors have components: `(x, y).x`".to_owned()
            }
            "`+`" if expected.has("a value") => "leave the `+` out".to_owned(),
            _ if expected.terms == ["`..`"] => "a range is written `a..b`".to_owned(),
            _ if expected.terms == [PATH] && !word.is_empty() => {
                format!("a path stands in quotes: `{verb} \"{word}{behind}\"`")
            }
            _ if expected.has("a relation") && is_number => format!("did you mean `= {word}`?"),
            _ if expected.has("`to`") && verb == "distance" => {
                "for the distance of two points, write `length A B`".to_owned()
            }
            _ if word.starts_with('\'') => "a string stands in double quotes: `\"...\"`".to_owned(),
            _ if before.ends_with(|char: char| char.is_ascii_digit())
                && Unit::ALL.iter().any(|unit| unit.suffix() == word) =>
            {
                format!("the unit stands right behind its number: `{}{word}`", last_number(before))
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
            let len = rest.find(|char| !is_word_char(char)).unwrap_or(rest.len());
            (Found::Word, len)
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
            (Found::Sign, sign.map_or(first.len_utf8(), |sign| sign.len()))
        };
        let term = match what {
            Found::String => "string".to_owned(),
            Found::Sign => match odd_char(first) {
                Some(odd) => odd.to_owned(),
                None => format!("`{}`", &rest[..len]),
            },
            _ => format!("`{}`", &rest[..len]),
        };
        FoundAt { what, term, span: self.span(at..at + len) }
    }

    /// The comma at the end of the line above `at`, if the line of `at` begins with a verb:
    /// then it was probably meant to be a statement of its own.
    fn line_held_open(&self, start: usize, at: usize) -> Option<Span> {
        let before = &self.text[start..at];
        let newline = before.rfind('\n')?;
        let line = before[newline..].trim_start();
        verb::rule(first_word(line))?;
        let comma = before[..newline].trim_end().strip_suffix(',')?.len() + start;
        Some(self.span(comma..comma + 1))
    }
}

/// Signs of more than one character that are, or look as if they were, of the language.
const SIGNS: [&str; 16] = [
    "...", "..", ":=", "==", "<=", ">=", "=<", "=>", "!=", "<>", "**", "&&", "||", "+=", "-=", "//",
];

/// What stands where the grammar expected something else.
pub(super) struct FoundAt {
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

/// What a command that names a file expects.
const PATH: &str = "a path in quotes";

/// What could have stood there, in a user's terms.
struct Expected {
    terms: Vec<String>,
    keywords: Vec<&'static str>,
}

impl Expected {
    fn new(rules: &[Rule], verb: &str, is_first: bool) -> Self {
        let has = |rule| rules.contains(&rule);
        let is_value = has(Rule::expr) || has(Rule::number) || has(Rule::range);
        let mut expected = Self { terms: Vec::new(), keywords: Vec::new() };
        for &rule in rules {
            match rule {
                // A value could go on with any of these; that says nothing.
                Rule::operator
                | Rule::member
                | Rule::index
                | Rule::open_bracket
                | Rule::arguments
                | Rule::EOI => {}
                Rule::number
                | Rule::reference
                | Rule::parens
                | Rule::minus
                | Rule::expr
                | Rule::range => expected.add("a value"),
                Rule::name | Rule::ident if is_value => {}
                // Behind a name: it could be a function's.
                Rule::open_paren if is_value || rules.len() > 1 => {}
                Rule::relation => {
                    expected.add("a relation");
                    expected.keywords.push("in");
                }
                Rule::string => expected.add(if verb == "print" { "a string" } else { PATH }),
                Rule::name
                | Rule::names
                | Rule::ident
                | Rule::pair
                | Rule::binding
                | Rule::point_decl
                | Rule::drag_target => expected.add(noun(verb, is_first)),
                Rule::selection => {
                    expected.add(noun(verb, is_first));
                    expected.add("`all`");
                    expected.keywords.push("all");
                }
                _ => match token(rule) {
                    Some(token) => expected.add(&format!("`{token}`")),
                    None => {
                        if let Some(keyword) = keyword(rule) {
                            expected.add(&format!("`{keyword}`"));
                            expected.keywords.push(keyword);
                        }
                    }
                },
            }
        }
        if has(Rule::EOI) {
            expected.add("the end of the statement");
        } else if expected.terms.is_empty() {
            expected.add("an operator");
        }
        expected
    }

    fn has(&self, term: &str) -> bool {
        self.terms.iter().any(|known| known == term)
    }

    fn add(&mut self, term: &str) {
        if !self.has(term) {
            self.terms.push(term.to_owned());
        }
    }

    /// The expected keyword that `word` is a misspelling of.
    fn near(&self, word: &str) -> Option<&'static str> {
        if word.is_empty() || self.keywords.contains(&word) {
            return None;
        }
        nearest(word, self.keywords.iter().copied())
    }
}

impl std::fmt::Display for Expected {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("expected ")?;
        for (position, term) in self.terms.iter().enumerate() {
            match position {
                0 => {}
                _ if position + 1 == self.terms.len() => f.write_str(" or ")?,
                _ => f.write_str(", ")?,
            }
            f.write_str(term)?;
        }
        Ok(())
    }
}

/// What the statement of `verb` has names of.
fn noun(verb: &str, is_first: bool) -> &'static str {
    match verb {
        "freeze" | "thaw" | "move" | "drag" | "point" | "trace" | "untrace" => "a point",
        "let" => "a parameter",
        "set" if is_first => "a setting",
        "off" | "on" => "a constraint",
        "help" => "a command",
        "use" | "define" if is_first => "a definition",
        _ if constraint::rule(verb).is_some() => "a point",
        _ => "a name",
    }
}

/// How a mark is written, or a clause begins; nothing for a keyword.
fn token(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::comma => ",",
        Rule::colon => ":",
        Rule::dots => "..",
        Rule::equals => "=",
        Rule::less => "<",
        Rule::less_equal => "<=",
        Rule::greater => ">",
        Rule::greater_equal => ">=",
        Rule::open_paren | Rule::parameters => "(",
        Rule::close_paren => ")",
        Rule::close_bracket => "]",
        _ => return None,
    })
}

/// The word of a keyword's rule, or the one that a clause begins with.
fn keyword(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::radius | Rule::kw_radius => "radius",
        Rule::speed | Rule::kw_speed => "speed",
        Rule::phase | Rule::kw_phase => "phase",
        Rule::at | Rule::kw_at => "at",
        Rule::ratio | Rule::kw_ratio => "ratio",
        Rule::every | Rule::kw_every => "every",
        Rule::within | Rule::kw_within => "within",
        Rule::in_time | Rule::kw_in => "in",
        Rule::kw_frozen => "frozen",
        Rule::kw_to => "to",
        Rule::kw_over => "over",
        Rule::kw_on => "on",
        Rule::kw_unbounded => "unbounded",
        Rule::kw_inside => "inside",
        Rule::kw_cascade => "cascade",
        Rule::kw_for => "for",
        Rule::kw_stop => "stop",
        Rule::kw_off => "off",
        Rule::kw_as => "as",
        Rule::kw_all => "all",
        Rule::kw_add => "add",
        _ => return None,
    })
}
