//! The statement that would make a thing as it is now: for `list`, `show` and `save`.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use crate::constraint::geometry::wrap;
use crate::constraint::{Bounds, Constraint, ConstraintKind as _, Field, Period, PointIdx};
use crate::diag::{SourceId, Span, format_number, format_rounded};
use crate::lang::ast::{
    Axis, BinaryOp, Command, Constraint as Stated, ConstraintDecl, Expr, Function as Word, Ident,
    Name, Node as Syntax, Pair, Range, Relation, Text,
};
use crate::world::{
    ConstraintId, Entity, Formula, Node, Operator, ParameterId, PointId, Record, World,
};

/// The place of what no text says.
pub(crate) const NOWHERE: Span = Span { source: SourceId(u32::MAX), start: 0, end: 0 };

pub(crate) fn ident(text: &str) -> Ident {
    Ident { text: Arc::from(text), span: NOWHERE }
}

/// A name with this text, indices and members included.
pub(crate) fn named(text: &str) -> Name {
    Name { head: ident(text), parts: Box::default(), span: NOWHERE }
}

pub(crate) fn expr(node: Syntax) -> Expr {
    Expr { node, span: NOWHERE }
}

pub(crate) fn literal(value: f64) -> Expr {
    Expr::literal(value, NOWHERE)
}

pub(crate) fn vector(x: f64, y: f64) -> Expr {
    expr(Syntax::Vector(Box::new([literal(x), literal(y)])))
}

/// A string with this content.
pub(crate) fn quoted(text: &str) -> Text {
    Text { value: Arc::from(text), span: NOWHERE }
}

/// The text of a command.
pub(crate) fn text_of(command: &Command) -> String {
    command.to_string()
}

/// A world whose things are to be said.
pub(crate) struct Unbind<'a> {
    world: &'a World,
}

impl<'a> Unbind<'a> {
    /// The statements of a world.
    pub const fn of(world: &'a World) -> Self {
        Self { world }
    }

    fn point_name(&self, p: PointIdx) -> Name {
        named(self.world.points().name(PointId(p)))
    }

    fn pair_of(&self, from: PointIdx, to: PointIdx) -> Pair {
        Pair { from: self.point_name(from), to: self.point_name(to) }
    }

    /// The expression behind a value of a constraint: what drives it, or the number itself.
    fn field(&self, record: &Record, field: Field, value: f64) -> Expr {
        record.driver(field).map_or_else(|| literal(value), |formula| self.unbind(formula))
    }

    /// What its statement asks of the measured value of a constraint.
    pub(crate) fn relation(&self, record: &Record, bounds: Bounds, is_angle: bool) -> Relation {
        let (lo, hi) = (record.driver(Field::Lo), record.driver(Field::Hi));
        let is_one = match (lo, hi) {
            (None, None) => bounds.is_equality(),
            (Some(lo), Some(hi)) => lo.is_same(hi),
            _ => false,
        };
        let (least, most) = if is_angle { (-PI, PI) } else { (f64::NEG_INFINITY, f64::INFINITY) };
        if is_one {
            Relation::Equal(self.field(record, Field::Lo, bounds.lo))
        } else if lo.is_none() && bounds.lo == least {
            Relation::LessEqual(self.field(record, Field::Hi, bounds.hi))
        } else if hi.is_none() && bounds.hi == most {
            Relation::GreaterEqual(self.field(record, Field::Lo, bounds.lo))
        } else {
            Relation::In(Range {
                from: self.field(record, Field::Lo, bounds.lo),
                to: self.field(record, Field::Hi, bounds.hi),
            })
        }
    }

    /// The statement of a constraint, with its name in front.
    pub(crate) fn constraint_statement(&self, record: &Record) -> Command {
        let number =
            |field| self.field(record, field, record.constraint.get(field).unwrap_or_default());
        let constraint = match &record.constraint {
            Constraint::Coordinate(c) => Stated::Coordinate {
                point: self.point_name(c.points[0]),
                at: match record.driver(Field::X) {
                    Some(formula) => self.unbind(formula),
                    None => vector(c.target.x, c.target.y),
                },
            },
            Constraint::Coincidence(c) => {
                let [a, b] = c.points;
                Stated::Coincidence(self.pair_of(a, b))
            }
            Constraint::Equivalence(c) => {
                let [a, b, p, q] = c.points;
                Stated::Equivalence(self.pair_of(a, b), self.pair_of(p, q))
            }
            Constraint::Equal(c) => {
                let [a, b, p, q] = c.points;
                let is_plain = c.bounds == Bounds::exactly(0.0) && record.drivers().is_empty();
                let relation = (!is_plain).then(|| self.relation(record, c.bounds, false));
                Stated::Equal(self.pair_of(a, b), self.pair_of(p, q), relation)
            }
            Constraint::Length(c) => {
                let [a, b] = c.points;
                Stated::Length(self.pair_of(a, b), Some(self.relation(record, c.bounds, false)))
            }
            Constraint::Orientation(c) => {
                let [a, b, p, q] = c.points;
                let (one, other) = (self.pair_of(a, b), self.pair_of(p, q));
                match c.period {
                    Period::Half if c.bounds == Bounds::exactly(FRAC_PI_2) => {
                        Stated::Perpendicular(one, other)
                    }
                    Period::Half => Stated::Parallel(one, other),
                    Period::Whole => {
                        let relation = self.relation(record, c.bounds, true);
                        Stated::Orientation(one, other, Some(relation))
                    }
                }
            }
            Constraint::Motor(c) => {
                let [o, p] = c.points;
                Stated::Motor {
                    arm: self.pair_of(o, p),
                    radius: Some(number(Field::Radius)),
                    speed: Some(number(Field::Speed)),
                    phase: Some(number(Field::Phase)),
                }
            }
            Constraint::Glider(c) => {
                let [p, a, b] = c.points;
                Stated::Glider {
                    point: self.point_name(p),
                    on: self.pair_of(a, b),
                    unbounded: !c.bounded,
                }
            }
            Constraint::Hinge(c) => {
                let [p, a, b] = c.points;
                Stated::Hinge {
                    point: self.point_name(p),
                    on: self.pair_of(a, b),
                    at: number(Field::Ratio),
                }
            }
            Constraint::Cog(_) | Constraint::CogVelocity(_) => {
                let points = record.constraint.points();
                let (first, second) = (&points[..2], &points[2..]);
                Stated::Cog {
                    first: self.pair_of(first[0], first[1]),
                    second: self.pair_of(second[0], second[1]),
                    ratio: number(Field::Ratio),
                    inside: false,
                }
            }
            Constraint::Distance(c) => {
                let [p, a, b] = c.points;
                Stated::Distance {
                    point: self.point_name(p),
                    line: self.pair_of(a, b),
                    relation: Some(self.relation(record, c.bounds, false)),
                }
            }
            Constraint::Rigid(_) => {
                let points = record.constraint.points();
                Stated::Rigid(points.iter().map(|&p| self.point_name(p)).collect())
            }
            Constraint::Rack(c) => {
                let [o, a, p, q] = c.points;
                Stated::Rack { wheel: self.pair_of(o, a), on: self.pair_of(p, q) }
            }
        };
        let label = Some(named(&record.name));
        Command::Constrain(Box::new(ConstraintDecl { label, constraint }))
    }

    pub(crate) fn constraint_text(&self, record: &Record) -> String {
        text_of(&self.constraint_statement(record))
    }

    pub(crate) fn parameter_text(&self, id: ParameterId) -> String {
        let parameter = self.world.parameter(id).expect("a listed parameter lives");
        let value = self.unbind(&parameter.formula);
        let binding = crate::lang::ast::Binding { name: named(&parameter.name), value };
        text_of(&Command::Let(vec![binding]))
    }

    /// What else there is to know of a constraint.
    pub(crate) fn constraint_details(&self, id: ConstraintId) -> Vec<String> {
        let record = self.world.constraint(id).expect("a listed constraint lives");
        let x = self.world.points().column();
        let angle = |phi: f64| format!("{} deg", format_rounded(phi.to_degrees()));
        let at = |p: PointIdx| x[p as usize];
        match &record.constraint {
            Constraint::Length(c) => {
                let [a, b] = c.points;
                vec![format!("length now {}", format_number(at(a).distance(at(b))))]
            }
            Constraint::Motor(c) => vec![
                format!("angle now {}", angle(wrap(c.angle()))),
                format!("turned {} rev", format_number(c.turned().total() / std::f64::consts::TAU)),
            ],
            Constraint::Orientation(c) => {
                let [a, b, p, q] = c.points.map(at);
                vec![format!("angle now {}", angle((b - a).angle_to(q - p)))]
            }
            _ => Vec::new(),
        }
    }

    /// A formula as the language writes it.
    pub(crate) fn unbind(&self, formula: &Formula) -> Expr {
        let two = |a: &Formula, b: &Formula| Box::new([self.unbind(a), self.unbind(b)]);
        expr(match formula.node() {
            Node::Number(n) => return literal(*n),
            Node::Time => Syntax::Time,
            Node::Point(id) => Syntax::Name(named(self.world.points().name(*id))),
            Node::Parameter(id) => Syntax::Name(named(self.world.name_of(Entity::Parameter(*id)))),
            Node::Vector(x, y) => Syntax::Vector(two(x, y)),
            Node::Negate(a) => Syntax::Negate(Box::new(self.unbind(a))),
            Node::Binary(op, a, b) => Syntax::Binary(sign_of(*op), two(a, b)),
            Node::X(a) => Syntax::Component(Box::new(self.unbind(a)), Axis::X),
            Node::Y(a) => Syntax::Component(Box::new(self.unbind(a)), Axis::Y),
            Node::Call(function, arguments) => {
                let word = Word::named(function.name()).expect("both lists have the same names");
                Syntax::Call(word, arguments.iter().map(|a| self.unbind(a)).collect())
            }
        })
    }
}

fn sign_of(operator: Operator) -> BinaryOp {
    match operator {
        Operator::Add => BinaryOp::Add,
        Operator::Subtract => BinaryOp::Subtract,
        Operator::Multiply => BinaryOp::Multiply,
        Operator::Divide => BinaryOp::Divide,
        Operator::Power => BinaryOp::Power,
    }
}
