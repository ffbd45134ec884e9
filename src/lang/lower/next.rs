//! What may stand at the end of a statement that is being typed, by the grammar.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};

use super::errors::expected::keyword;
use super::highlight::clause_words;
use super::is_bare;
use super::prefix::first_word;
use crate::lang::catalogue::{self, ConstraintWord, Slot};
use crate::lang::constraint::Role;
use crate::lang::grammar::{LinkworkParser, Rule};

/// What may stand at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Next {
    /// The word of a command.
    Command,
    /// This word.
    Word(&'static str),
    /// An expression.
    Value,
    /// A name.
    Name(NameOf),
    /// The name of a setting.
    Setting,
    /// The value of the setting of this name.
    ValueOf(String),
    /// The word of a unit.
    Unit,
    /// What `list` lists.
    List,
    /// What `help` knows.
    Topic,
    /// The name of an example.
    Example,
    /// A path in quotes.
    Path,
}

/// What has a name that is expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameOf {
    /// A point.
    Point,
    /// A point, a circle or an arc.
    PointOrCurve,
    /// A constraint.
    Constraint,
    /// What drives: a motor, a constraint with a value, a parameter.
    Driver,
    /// A parameter.
    Parameter,
    /// A definition.
    Definition,
    /// Anything that has a name.
    Anything,
}

/// What may follow the beginning of a statement, up to the word that is being typed.
///
/// ```
/// use linkwork::lang::{NameOf, Next, next};
///
/// assert_eq!(next("freeze "), [Next::Name(NameOf::Point), Next::Word("all")]);
/// assert!(next("crank: motor A B ").contains(&Next::Word("speed")));
/// assert!(next("length A B = ").contains(&Next::Value));
/// ```
pub fn next(statement: &str) -> Vec<Next> {
    let statement = statement.trim_start();
    let Some((prefix, rest)) = split_prefix(statement) else { return vec![Next::Command] };
    let verb = first_word(rest);
    let is_bare = prefix.is_empty() && is_bare(rest);
    let rule = if is_bare { Some(Rule::bare) } else { catalogue::rule(verb) };
    let Some(rule) = rule else { return Vec::new() };
    let said = rest[verb.len()..].trim();
    match verb {
        "list" => return vec![Next::List],
        "help" => return vec![Next::Topic],
        "examples" => return vec![Next::Example],
        "set" if !said.is_empty() && !said.contains(char::is_whitespace) => {
            return vec![Next::ValueOf(said.to_owned())];
        }
        _ => {}
    }
    // A character that nothing takes: the grammar stops there and says what it expected.
    let probe = format!("{rest}\u{1}");
    let Err(error) = LinkworkParser::parse(rule, &probe) else { return Vec::new() };
    let (InputLocation::Pos(at) | InputLocation::Span((at, _))) = error.location;
    let ErrorVariant::ParsingError { positives, .. } = error.variant else { return Vec::new() };
    if at != rest.len() {
        return Vec::new();
    }
    let last = said.rsplit(|c: char| c.is_whitespace()).next().unwrap_or_default();
    let mut found: Vec<Next> = Vec::new();
    for rule in positives {
        for next in meant(rule, verb, last, said.is_empty()) {
            if !found.contains(&next) {
                found.push(next);
            }
        }
    }
    found
}

/// The label and `add` in front of a statement, and the rest; none where no verb has begun.
pub(in crate::lang) fn split_prefix(statement: &str) -> Option<(&str, &str)> {
    let mut rest = statement;
    loop {
        let word = super::prefix::name_end(rest);
        let behind = rest[word..].trim_start();
        if word > 0 && behind.starts_with(':') {
            rest = behind[1..].trim_start();
        } else if &rest[..word] == "add" && behind.len() < rest.len() - word {
            rest = behind;
        } else {
            let prefix = &statement[..statement.len() - rest.len()];
            return (!rest.is_empty()).then_some((prefix, rest));
        }
    }
}

/// What a rule stands for behind `last` in the statement of `verb`.
fn meant(rule: Rule, verb: &str, last: &str, is_first: bool) -> Vec<Next> {
    let name = || name_of(verb, last, is_first).map(Next::Name);
    match rule {
        Rule::number
        | Rule::reference
        | Rule::parens
        | Rule::minus
        | Rule::expr
        | Rule::range
        | Rule::column
        | Rule::against => {
            vec![Next::Value]
        }
        Rule::relation => vec![Next::Word("in")],
        Rule::selection => name().into_iter().chain([Next::Word("all")]).collect(),
        Rule::name
        | Rule::names
        | Rule::pair
        | Rule::drag_target
        | Rule::touching
        | Rule::touched
        | Rule::binding
        | Rule::result_item
        | Rule::fit_range
        | Rule::ident => name().into_iter().collect(),
        Rule::setting => vec![Next::Setting],
        Rule::unit => vec![Next::Unit],
        Rule::string if !matches!(verb, "print" | "sample" | "result" | "trace" | "untrace") => {
            vec![Next::Path]
        }
        _ => {
            let spelt = format!("{rule:?}");
            let word = spelt.strip_prefix("kw_");
            let word = word.and_then(|word| clause_words().get(word)).map(String::as_str);
            word.or_else(|| keyword(rule)).map(Next::Word).into_iter().collect()
        }
    }
}

/// What is named there; none where something new gets a name.
fn name_of(verb: &str, last: &str, is_first: bool) -> Option<NameOf> {
    Some(match verb {
        "use" if is_first => NameOf::Definition,
        "point" | "for" | "define" | "restore" | "use" | "measure" | "result" => return None,
        "rename" if !is_first => return None,
        "let" | "fit" => NameOf::Parameter,
        "freeze" | "thaw" | "move" | "drag" | "pull" | "trace" | "untrace" => NameOf::Point,
        "off" | "on" => NameOf::Constraint,
        "limits" => NameOf::Driver,
        "change" if !is_first => NameOf::Point,
        _ => return of_constraint(verb, last, is_first),
    })
}

/// What a constraint has names of: points, and where its pattern says so circles and arcs.
fn of_constraint(verb: &str, last: &str, is_first: bool) -> Option<NameOf> {
    let Some(word) = ConstraintWord::named(verb) else { return Some(NameOf::Anything) };
    let slots = word.pattern().slots;
    if is_first && slots.contains(&Slot::Defined) {
        return None;
    }
    let may_be_curve = slots.iter().any(|slot| match slot {
        Slot::Touching => true,
        Slot::Point(role) => *role == Role::On && last == role.word(),
        _ => false,
    });
    Some(if may_be_curve { NameOf::PointOrCurve } else { NameOf::Point })
}

#[cfg(test)]
mod tests {
    use super::Next::{Name, Path, Setting, Unit, Value, Word};
    use super::*;

    #[test]
    fn what_may_follow_is_what_the_grammar_says() {
        let check = |statement: &str, wanted: &[Next]| {
            let found = next(statement);
            for next in wanted {
                assert!(found.contains(next), "{statement:?}: {next:?} in {found:?}");
            }
            assert_eq!(found.is_empty(), wanted.is_empty(), "{statement:?}: {found:?}");
        };
        check("", &[Next::Command]);
        check("crank: ", &[Next::Command]);
        check("add ", &[Next::Command]);
        check("motor ", &[Name(NameOf::Point)]);
        check("motor A B ", &[Word("from"), Word("radius"), Word("speed"), Word("phase")]);
        check("motor A B speed ", &[Value]);
        check("glider P on ", &[Name(NameOf::PointOrCurve)]);
        check("glider P on A B ", &[Word("unbounded")]);
        check("point A = ", &[Value]);
        check("point A = (1, 2) ", &[Word("frozen")]);
        check("length A B ", &[Word("in")]);
        check("cog O A, P B ", &[Word("ratio"), Word("teeth")]);
        check("off ", &[Name(NameOf::Constraint)]);
        check("limits ", &[Name(NameOf::Driver)]);
        check("delete ", &[Name(NameOf::Anything)]);
        check("rename ", &[Name(NameOf::Anything)]);
        check("rename A ", &[Word("to")]);
        check("rename A to ", &[]);
        check("use ", &[Name(NameOf::Definition)]);
        check("set ", &[Setting]);
        check("set method ", &[Next::ValueOf("method".to_owned())]);
        check("print A in ", &[Unit]);
        check("A.x in ", &[Unit]);
        check("svg ", &[Path]);
        check("record ", &[Path, Word("stop")]);
        check("trace A ", &[Word("every")]);
        check("drag A ", &[Word("to"), Word("through")]);
        check("expose ", &[Word("off"), Word("every")]);
        check("change crank ", &[Word("speed"), Word("radius")]);
        check("nonsense here ", &[]);
        check("motor ) ", &[]);
    }
}
