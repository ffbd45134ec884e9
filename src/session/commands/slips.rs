//! Values of a constraint that are likely slips: said once of each place in a text, with what to type.

use crate::constraint::{Constraint, ConstraintKind as _, Field, Period};
use crate::diag::{Diagnostic, Span, format_number};
use crate::lang::ast::{Expr, Node, Part, Range, Relation, Role, Unit};
use crate::session::execution::Execution;
use crate::world::Formula;

/// No angle that is meant in radians is larger than that, a little more than one turn.
const LARGEST_ANGLE: f64 = 7.0;
/// A distance whose size is below this part of what is asked for has no side.
const NO_SIDE: f64 = 1e-9;

impl Execution<'_> {
    /// Says what these parts, of a constraint that is about to be made or changed so, likely slipped
    /// in.
    pub(super) fn note_slips(
        &mut self,
        constraint: &Constraint,
        parts: &[Part],
        drivers: &[(Field, Formula)],
    ) {
        for part in parts {
            match (constraint, part) {
                (Constraint::Orientation(c), Part::Relation(relation))
                    if c.period == Period::Whole =>
                {
                    ends(relation).into_iter().flatten().for_each(|end| self.note_degrees(end));
                }
                (Constraint::Motor(_), Part::Value(Role::Phase, value)) => {
                    self.note_degrees(value);
                }
                (Constraint::Distance(c), Part::Relation(Relation::Equal(value)))
                    if drivers.is_empty() =>
                {
                    let points = self.state.world.points();
                    let [p, a, b] = c.points.map(|p| points.column()[p as usize]);
                    let now = (b - a).unit().map_or(0.0, |e| e.cross(p - a));
                    let asked = constraint.get(Field::Lo).unwrap_or_default();
                    if now * asked < 0.0 && now.abs() > NO_SIDE * asked.abs() {
                        self.note_side(now, asked, value.span);
                    }
                }
                _ => {}
            }
        }
    }

    /// Says that a plain number is a large angle.
    fn note_degrees(&mut self, value: &Expr) {
        let number = match &value.node {
            Node::Negate(inner) => &inner.node,
            node => node,
        };
        if let Node::Number(number) = number
            && number.unit == Unit::None
            && number.written > LARGEST_ANGLE
        {
            let text = self.resolve().text(value.span).to_owned();
            let note = Diagnostic::note_only(format!(
                "a plain number is an angle in radians: did you mean `{text}deg`?"
            ));
            self.note_slip(note, value.span, "more than a whole turn");
        }
    }

    /// Says that a point is to change to the other side of a line.
    fn note_side(&mut self, now: f64, asked: f64, span: Span) {
        let side = |distance: f64| if distance > 0.0 { "left" } else { "right" };
        let note = Diagnostic::note_only(format!(
            "a distance is positive on the left of its line, and this point is on the {} now: did \
             you mean `{}`?",
            side(now),
            format_number(-asked)
        ));
        self.note_slip(note, span, &format!("this is on the {}", side(asked)));
    }

    /// Says what is likely a slip, but not in each round of a loop.
    fn note_slip(&mut self, note: Diagnostic, at: Span, label: &str) {
        if self.slips.insert(at) {
            self.warn(&note.at(at, label));
        }
    }
}

/// The expressions of a relation.
const fn ends(relation: &Relation) -> [Option<&Expr>; 2] {
    match relation {
        Relation::Equal(e)
        | Relation::Less(e)
        | Relation::LessEqual(e)
        | Relation::Greater(e)
        | Relation::GreaterEqual(e) => [Some(e), None],
        Relation::In(Range { from, to }) => [Some(from), Some(to)],
    }
}
