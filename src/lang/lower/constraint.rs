//! From the parts of a constraint's statement to its tree.

use crate::diag::Diagnostic;
use crate::lang::ast::{Constraint, Part, Role};
use crate::lang::catalogue::ConstraintWord;
use crate::lang::grammar::Rule;

use super::cursor::{Cursor, Spot};
use super::errors::refusal;

/// The rule for a constraint's keyword.
pub(super) fn rule(word: &str) -> Option<Rule> {
    ConstraintWord::named(word).map(|word| word.pattern().rule)
}

/// The constraint whose statement `rule` has read; nothing if the rule is another's.
pub(in crate::lang) fn lower(rule: Rule, c: &mut Cursor) -> Option<Result<Constraint, Diagnostic>> {
    let word = ConstraintWord::ALL.iter().copied().find(|word| word.pattern().rule == rule)?;
    let parts =
        parts(c, |first, second| refusal::twice(second.word, first.word_span, second.word_span));
    Some(parts.map(|mut parts| {
        parts.sort_by_key(|part| word.pattern().place(part));
        Constraint { word, parts }
    }))
}

/// All parts that follow, in their order; `refuse` says what is wrong with two of one sort.
pub(in crate::lang) fn parts<'a>(
    c: &mut Cursor<'a>,
    refuse: impl Fn(&Spot<'a>, &Spot<'a>) -> Diagnostic,
) -> Result<Vec<Part>, Diagnostic> {
    let mut parts = Vec::new();
    let mut seen: Vec<Spot> = Vec::new();
    while let Some(rule) = c.peek() {
        match rule {
            Rule::name => parts.push(Part::Points(c.names()?)),
            Rule::pair => {
                let pair = c.pair()?;
                parts.push(Part::Points(vec![pair.from, pair.to]));
            }
            Rule::defined => {
                let read = c.take(rule).expect("it is the next thing");
                parts.push(Part::Defined(c.within(read).name()?));
            }
            Rule::touching | Rule::touched => {
                let read = c.take(rule).expect("it is the next thing");
                parts.push(Part::Points(c.within(read).names()?));
            }
            Rule::expr => parts.push(Part::Measure(c.expr()?)),
            _ => {
                let spot = c.spot(rule);
                if let Some(first) = seen.iter().find(|known| known.rule == rule) {
                    return Err(refuse(first, &spot));
                }
                seen.push(spot);
                parts.push(part(rule, c)?);
            }
        }
    }
    Ok(parts)
}

/// The part that `rule` has read: a line, a relation, a value or a mere word.
fn part(rule: Rule, c: &mut Cursor) -> Result<Part, Diagnostic> {
    if rule == Rule::relation {
        let relation = c.relation_if_any()?;
        return Ok(Part::Relation(relation.expect("it is the next thing")));
    }
    let role = role(rule).unwrap_or_else(|| panic!("{rule:?} is no part of a constraint"));
    let read = c.take(rule).expect("it is the next thing");
    let mut inner = c.within(read);
    Ok(match inner.peek() {
        Some(Rule::pair) => Part::Line(role, inner.pair()?),
        Some(Rule::name) => Part::Point(role, inner.name()?),
        Some(_) => {
            let first = inner.expr()?;
            match inner.peek() {
                Some(_) => Part::Values(role, Box::new([first, inner.expr()?])),
                None => Part::Value(role, first),
            }
        }
        None => Part::Flag(role),
    })
}

/// What a part is for, by its rule.
pub(super) fn role(rule: Rule) -> Option<Role> {
    Some(match rule {
        Rule::on_line | Rule::on_curve => Role::On,
        Rule::to_line | Rule::to_point => Role::To,
        Rule::about_line => Role::About,
        Rule::from_line | Rule::from_point => Role::From,
        Rule::through_point => Role::Through,
        Rule::radius => Role::Radius,
        Rule::speed => Role::Speed,
        Rule::phase => Role::Phase,
        Rule::at | Rule::at_point => Role::At,
        Rule::ratio => Role::Ratio,
        Rule::teeth => Role::Teeth,
        Rule::kw_inside => Role::Inside,
        Rule::kw_crossed => Role::Crossed,
        Rule::kw_unbounded => Role::Unbounded,
        _ => return None,
    })
}
