//! What the grammar lets through and the language does not.

use crate::diag::{Diagnostic, Span, nearest};
use crate::errors;
use crate::lang::ast::{Function, Ident, Unit};
use crate::lang::layout::{Flaw, MAX_NESTING};

use super::mistake::brief;
use crate::lang::lower::Reader;

impl Reader<'_> {
    pub fn flaw(&self, flaw: Flaw) -> Diagnostic {
        let mark = |at: usize| &self.text[at..=at];
        let at = |at: usize| self.span(at..at + 1);
        match flaw {
            Flaw::Unclosed { opener, .. } => {
                Diagnostic::error(errors::BRACKET, format!("`{}` is never closed", mark(opener)))
                    .at(at(opener), "opened here")
                    .help(format!("add `{}`", closing(mark(opener))))
            }
            Flaw::CutOff { opener, semicolon } => {
                Diagnostic::error(errors::BRACKET, format!("`{}` is not closed", mark(opener)))
                    .at(at(semicolon), "the statement ends here")
                    .also(at(opener), "opened here")
                    .help(format!("add `{}` before the `;`", closing(mark(opener))))
            }
            Flaw::Unopened { closer } => {
                let word = mark(closer);
                Diagnostic::error(errors::BRACKET, format!("unexpected `{word}`"))
                    .at(at(closer), "nothing is open here")
            }
            Flaw::Mismatched { opener, closer } => {
                let wanted = closing(mark(opener));
                Diagnostic::error(
                    errors::BRACKET,
                    format!("expected `{wanted}`, found `{}`", mark(closer)),
                )
                .at(at(closer), format!("expected `{wanted}`"))
                .also(at(opener), "to close this")
            }
            Flaw::OpenString { quote, end } => {
                Diagnostic::error(errors::OPEN_STRING, "the string is not closed")
                    .at(self.span(quote..end), "a string ends on its line")
                    .help("add `\"`; for a line end in it write `\\n`")
            }
            Flaw::TooDeep { opener } => {
                Diagnostic::error(errors::TOO_NESTED, "too many brackets within each other")
                    .at(at(opener), format!("number {} that is open here", MAX_NESTING + 1))
                    .help("give a part of it a name with `let` or `define`")
            }
            Flaw::AfterBlock { at } => {
                let end = self.text[at..].find('\n').map_or(self.text.len(), |len| at + len);
                let found = self.found_at(at, end);
                Diagnostic::error(errors::UNEXPECTED, format!("unexpected {}", found.term))
                    .at(found.span, "expected the end of the line or `;`")
                    .help("begin a new statement on a new line")
            }
        }
    }

    pub fn missing_block(&self, verb: &str, end: usize) -> Diagnostic {
        let end = self.text[..end].trim_end().len();
        Diagnostic::error(errors::BLOCK, format!("`{verb}` has no block"))
            .at(self.span(end..end), "expected `{`")
            .help("the `{` stands on the same line")
    }

    pub fn needless_block(&self, verb: &str, brace: usize) -> Diagnostic {
        Diagnostic::error(errors::BLOCK, "unexpected `{`")
            .at(self.span(brace..brace + 1), format!("`{verb}` has no block"))
            .help("a block belongs to `for` and `define` only")
    }

    pub fn unknown_escape(&self, at: usize, escaped: char) -> Diagnostic {
        let span = self.span(at..at + 1 + escaped.len_utf8());
        Diagnostic::error(errors::UNKNOWN_ESCAPE, format!("unknown escape `\\{escaped}`"))
            .at(span, "expected `\\\"`, `\\\\` or `\\n`")
            .help("for a backslash write `\\\\`; in a path use `/`")
    }
}

pub(crate) fn reserved(ident: &Ident) -> Result<(), Diagnostic> {
    let meaning = match &*ident.text {
        "pi" => "3.14159...",
        "tau" => "6.28318...",
        "time" => "the clock",
        _ => return Ok(()),
    };
    Err(Diagnostic::error(errors::RESERVED_NAME, format!("`{}` is a reserved name", ident.text))
        .at(ident.span, format!("always {meaning}"))
        .help("choose another name"))
}

pub(crate) fn too_long(span: Span) -> Diagnostic {
    Diagnostic::error(errors::TOO_NESTED, "the expression is too long or too deeply nested")
        .at(span, "")
        .help("give a part of it a name with `let`")
}

pub(crate) fn too_large(span: Span) -> Diagnostic {
    Diagnostic::error(errors::NUMBER_TOO_LARGE, "the number is too large")
        .at(span, "beyond 1.7976931348623157e308")
}

pub(crate) fn twice(word: &str, first: Span, second: Span) -> Diagnostic {
    Diagnostic::error(errors::TWICE, format!("`{word}` is given twice"))
        .at(second, "the second time")
        .also(first, "the first time")
}

pub(crate) fn part_twice(first: Span, second: Span) -> Diagnostic {
    Diagnostic::error(errors::TWICE, "the same part is changed twice")
        .at(second, "the second time")
        .also(first, "the first time")
}

pub(crate) fn parameter_twice(first: &Ident, second: &Ident) -> Diagnostic {
    Diagnostic::error(errors::TWICE, format!("two parameters are called `{}`", brief(&second.text)))
        .at(second.span, "the second one")
        .also(first.span, "the first one")
}

pub(crate) fn no_parts(word: &Ident, span: Span) -> Diagnostic {
    Diagnostic::error(errors::NO_MEMBER, format!("`{}` is a number and has no parts", word.text))
        .at(span, "")
}

pub(crate) fn no_component(member: &str, span: Span) -> Diagnostic {
    Diagnostic::error(errors::NO_MEMBER, format!("a vector has no part `{}`", brief(member)))
        .at(span, "expected `.x` or `.y`")
}

pub(crate) fn not_a_function(span: Span) -> Diagnostic {
    Diagnostic::error(errors::NOT_A_FUNCTION, "only a function can be called")
        .at(span, "a name, not a function")
        .help("to multiply, write `*` before the parenthesis")
}

pub(crate) fn unknown_function(word: &Ident) -> Diagnostic {
    let shown = brief(&word.text);
    let problem =
        Diagnostic::error(errors::UNKNOWN_FUNCTION, format!("unknown function `{shown}`"))
            .at(word.span, "not a function");
    let near = match &*word.text {
        "log" => Some("ln"),
        "pow" => return problem.help("a power is written `a^b`"),
        "length" | "len" | "magnitude" => Some("norm"),
        "deg" | "degrees" | "radians" => {
            return problem.help("an angle in degrees is written `90deg`");
        }
        "arctan" => Some("atan"),
        "arcsin" => Some("asin"),
        "arccos" => Some("acos"),
        word => nearest(word, Function::ALL.iter().map(|function| function.name())),
    };
    match near {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem
            .help("`help functions` lists them")
            .help(format!("to multiply, write `{shown} * (...)`")),
    }
}

pub(crate) fn wrong_count(word: &Ident, n: usize, span: Span) -> Diagnostic {
    let name = &*word.text;
    let given = match n {
        0 => "none is given".to_owned(),
        1 => "1 is given".to_owned(),
        _ => format!("{n} are given"),
    };
    let usages = Function::named(name).map(|function| format!("`{}`", function.usage()));
    let usages: Vec<_> = usages.collect();
    Diagnostic::error(errors::ARGUMENTS, format!("wrong number of arguments of `{name}`"))
        .at(span, given)
        .help(format!("usage: {}", usages.join(" or ")))
}

pub(crate) fn unknown_unit(word: &Ident) -> Diagnostic {
    let problem =
        Diagnostic::error(errors::UNKNOWN_UNIT, format!("unknown unit `{}`", brief(&word.text)))
            .at(word.span, "expected `deg`, `rad`, `rev`, `rpm`, `s` or `ms`");
    match nearest(&word.text, Unit::ALL.map(Unit::suffix)) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem,
    }
}

pub(crate) fn unknown_list(word: &Ident, known: &[&str]) -> Diagnostic {
    let problem = Diagnostic::error(
        errors::UNKNOWN_LIST,
        format!("there is no list of `{}`", brief(&word.text)),
    )
    .at(
        word.span,
        "expected `points`, `constraints`, `traces`, `parameters`, `measures` or `definitions`",
    );
    match nearest(&word.text, known.iter().copied()) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None if &*word.text == "all" => problem.help("`list` alone lists all of it"),
        None => problem.help(format!("to see one thing, write `show {}`", brief(&word.text))),
    }
}

fn closing(opening: &str) -> &'static str {
    match opening {
        "(" => ")",
        "[" => "]",
        _ => "}",
    }
}
