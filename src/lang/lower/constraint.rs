//! From the parts of a constraint's statement to its tree.

use crate::diag::Diagnostic;
use crate::lang::ast::Constraint;

use super::cursor::Cursor;
use super::grammar::Rule;

/// The rule for a constraint's keyword.
pub(super) fn rule(word: &str) -> Option<Rule> {
    Some(match word {
        "coordinate" => Rule::coordinate,
        "coincidence" => Rule::coincidence,
        "equivalence" => Rule::equivalence,
        "equal" => Rule::equal,
        "length" => Rule::length,
        "orientation" => Rule::orientation,
        "motor" => Rule::motor,
        "glider" => Rule::glider,
        "hinge" => Rule::hinge,
        "cog" => Rule::cog,
        "distance" => Rule::distance,
        "parallel" => Rule::parallel,
        "perpendicular" => Rule::perpendicular,
        "rigid" => Rule::rigid,
        "rack" => Rule::rack,
        _ => return None,
    })
}

/// The constraint whose statement `rule` has read; nothing if the rule is another's.
pub(super) fn lower(rule: Rule, c: &mut Cursor) -> Option<Result<Constraint, Diagnostic>> {
    let constraint = match rule {
        Rule::coordinate => coordinate(c),
        Rule::coincidence => c.pair().map(Constraint::Coincidence),
        Rule::equivalence => equivalence(c),
        Rule::equal => equal(c),
        Rule::length => length(c),
        Rule::orientation => orientation(c),
        Rule::motor => motor(c),
        Rule::glider => glider(c),
        Rule::hinge => hinge(c),
        Rule::cog => cog(c),
        Rule::distance => distance(c),
        Rule::parallel => parallel(c),
        Rule::perpendicular => perpendicular(c),
        Rule::rigid => c.names().map(Constraint::Rigid),
        Rule::rack => rack(c),
        _ => return None,
    };
    Some(constraint)
}

type Lowered = Result<Constraint, Diagnostic>;

fn coordinate(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Coordinate { point: c.name()?, at: c.expr()? })
}

fn equivalence(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Equivalence(c.pair()?, c.pair()?))
}

fn equal(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Equal(c.pair()?, c.pair()?, c.relation_if_any()?))
}

fn length(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Length(c.pair()?, c.relation_if_any()?))
}

fn orientation(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Orientation(c.pair()?, c.pair()?, c.relation_if_any()?))
}

fn motor(c: &mut Cursor) -> Lowered {
    let arm = c.pair()?;
    let [radius, speed, phase] = c.clauses([Rule::radius, Rule::speed, Rule::phase])?;
    Ok(Constraint::Motor { arm, radius, speed, phase })
}

fn glider(c: &mut Cursor) -> Lowered {
    let (point, on) = (c.name()?, c.pair()?);
    Ok(Constraint::Glider { point, on, unbounded: c.flag(Rule::kw_unbounded) })
}

fn hinge(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Hinge { point: c.name()?, on: c.pair()?, at: c.expr()? })
}

fn cog(c: &mut Cursor) -> Lowered {
    let (first, second, ratio) = (c.pair()?, c.pair()?, c.expr()?);
    Ok(Constraint::Cog { first, second, ratio, inside: c.flag(Rule::kw_inside) })
}

fn distance(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Distance { point: c.name()?, line: c.pair()?, relation: c.relation_if_any()? })
}

fn parallel(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Parallel(c.pair()?, c.pair()?))
}

fn perpendicular(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Perpendicular(c.pair()?, c.pair()?))
}

fn rack(c: &mut Cursor) -> Lowered {
    Ok(Constraint::Rack { wheel: c.pair()?, on: c.pair()? })
}
