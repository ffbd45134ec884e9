//! The statement that would make a thing as it is now: for `list`, `show` and `save`.

use std::f64::consts::PI;
use std::sync::Arc;

use super::said::{Said, TEETH, field_of, flag_of, word_of};
use crate::constraint::geometry::wrap;
use crate::constraint::{Bounds, Constraint, ConstraintKind as _, Field, PointIdx, Quantity};
use crate::diag::{SourceId, Span, format_number, format_rounded};
use crate::lang::ast::{
    Axis, Command, Constraint as Stated, ConstraintDecl, Expr, Ident, Making, Measuring, Name,
    Node as Syntax, Pair, Part, Range, Relation, Role, Text,
};
use crate::lang::catalogue::Slot;
use crate::terms::Unit;
use crate::world::{
    ConstraintId, Entity, Formula, Measure, Node, ParameterId, PointId, Record, World,
};

/// The place of what no text says.
pub(crate) const NOWHERE: Span = Span { source: SourceId(u32::MAX), start: 0, end: 0 };

/// Expressions that are asked for the unit of one: parameters may follow each other for long, and two
/// may follow the same.
const MOST_ASKED: u32 = 500;

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

/// Whether two numbers are one to the bit: what is left out has to come back, the sign of 0 too.
fn is_same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
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

    fn curve_name(&self, curve: u32) -> Name {
        named(self.world.name_of(Entity::Constraint(ConstraintId(curve))))
    }

    /// What touches what: a line by its points, circles and arcs by their names.
    fn touching(&self, record: &Record) -> Vec<Vec<Name>> {
        let Constraint::Touch(touch) = record.constraint.stated() else { return Vec::new() };
        let line = touch.line().map(|ends| ends.map(|p| self.point_name(p)).to_vec());
        let curves = touch.curves().iter().map(|&curve| vec![self.curve_name(curve)]);
        line.into_iter().chain(curves).collect()
    }

    /// The expression behind a value of a constraint: what drives it, or the number itself.
    fn field(&self, record: &Record, field: Field, value: f64) -> Expr {
        match record.driver(field) {
            Some(formula) => self.unbind(formula),
            None => Expr::literal_in(value, record.unit(field), NOWHERE),
        }
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
        let word = word_of(&record.constraint);
        let mut groups = Said::of(&record.constraint).groups.into_iter();
        let mut touching = self.touching(record).into_iter();
        if let Constraint::Touch(touch) = record.constraint.stated() {
            // What touches is said by itself: a point that slides is left, or one behind `at`.
            let left = if touch.is_glider() { touch.points().to_vec() } else { Vec::new() };
            let left = touch.at().map_or(left, |p| vec![p]);
            groups = vec![left].into_iter();
        }
        let mut names = || groups.next().into_iter().flatten().map(|p| self.point_name(p));
        let slots = word.pattern().slots.iter();
        let parts = slots.filter_map(|slot| {
            Some(match *slot {
                Slot::Points(_) | Slot::AllPoints => Part::Points(names().collect()),
                Slot::Line(role) => {
                    let mut ends = names();
                    Part::Line(role, Pair { from: ends.next()?, to: ends.next()? })
                }
                Slot::Defined => Part::Defined(named(&record.name)),
                Slot::Point(Role::On) => {
                    let curve = record.constraint.curves().first()?;
                    Part::Point(Role::On, self.curve_name(*curve))
                }
                Slot::Point(role) => Part::Point(role, names().next()?),
                Slot::Touching => Part::Points(touching.next()?),
                Slot::Measure => Part::Measure(self.held(record)?),
                Slot::Relation { .. } if record.constraint.get(Field::ValueY).is_some() => {
                    Part::Relation(Relation::Equal(self.place_of(record)?))
                }
                Slot::Relation { default } => {
                    Part::Relation(self.relation_if_needed(record, default)?)
                }
                Slot::Gearing => {
                    let teeth = TEETH.map(|field| Some((field, record.constraint.get(field)?)));
                    if let [Some(first), Some(second)] = teeth {
                        let teeth = [first, second].map(|(f, n)| self.field(record, f, n));
                        return Some(Part::Values(Role::Teeth, Box::new(teeth)));
                    }
                    Part::Value(Role::Ratio, self.value_of(record, Field::Ratio))
                }
                Slot::Optional(role, default) => {
                    let value = record.constraint.get(field_of(role))?;
                    let is_live = record.driver(field_of(role)).is_some();
                    if default.is_some_and(|default| is_same(default, value)) && !is_live {
                        return None;
                    }
                    Part::Value(role, self.value_of(record, field_of(role)))
                }
                Slot::Value(role) => Part::Value(role, self.value_of(record, field_of(role))),
                Slot::Place(role) => Part::Value(role, self.place_of(record)?),
                Slot::Flag(role) => {
                    let flags = record.constraint.traits().flags;
                    return flags.contains(&flag_of(role)).then_some(Part::Flag(role));
                }
            })
        });
        let constraint = Stated { word, parts: parts.collect() };
        let is_named_within = word.pattern().slots.contains(&Slot::Defined);
        let label = (!is_named_within).then(|| named(&record.name));
        Command::Constrain(Box::new(ConstraintDecl { label, constraint }))
    }

    /// The place that a constraint asks for.
    fn place_of(&self, record: &Record) -> Option<Expr> {
        self.of_fields(record, [Field::X, Field::Y])
    }

    /// What a constraint holds.
    fn held(&self, record: &Record) -> Option<Expr> {
        if record.constraint.get(Field::ValueY).is_some() {
            return self.of_fields(record, [Field::Value, Field::ValueY]);
        }
        Some(self.value_of(record, Field::Value))
    }

    fn of_fields(&self, record: &Record, fields: [Field; 2]) -> Option<Expr> {
        let [x, y] = fields.map(|field| record.constraint.get(field));
        let driver = record.driver(fields[0]).map(|formula| self.unbind(formula));
        driver.or_else(|| Some(vector(x?, y?)))
    }

    fn value_of(&self, record: &Record, field: Field) -> Expr {
        self.field(record, field, record.constraint.get(field).unwrap_or_default())
    }

    /// The relation of a statement, but where it would be the same without.
    fn relation_if_needed(&self, record: &Record, default: Option<f64>) -> Option<Relation> {
        let traits = record.constraint.traits();
        let bounds = traits.bounds?;
        let is_default = |default| is_same(default, bounds.lo) && is_same(default, bounds.hi);
        let is_meant = default.is_some_and(is_default) && record.drivers().is_empty();
        let is_angle = traits.quantity == Quantity::Angle;
        (!is_meant).then(|| self.relation(record, bounds, is_angle))
    }

    pub(crate) fn constraint_text(&self, record: &Record) -> String {
        text_of(&self.constraint_statement(record))
    }

    pub(crate) fn parameter_text(&self, id: ParameterId) -> String {
        let parameter = self.world.parameter(id).expect("a listed parameter lives");
        let value = self.unbind(&parameter.formula);
        let binding = crate::lang::ast::Binding { name: named(&parameter.name), value };
        text_of(&Making::Let(vec![binding]).into())
    }

    /// The statement that begins a measure.
    pub(crate) fn measure_statement(&self, measure: &Measure) -> Command {
        let (name, value) = (named(&measure.name), self.unbind(&measure.formula));
        Measuring::Measure { name, value, unit: measure.unit }.into()
    }

    /// What else there is to know of a constraint.
    pub(crate) fn constraint_details(&self, id: ConstraintId) -> Vec<String> {
        let record = self.world.constraint(id).expect("a listed constraint lives");
        let x = self.world.points().column();
        let angle = |phi: f64| format!("{} deg", format_rounded(phi.to_degrees()));
        let at = |p: PointIdx| x[p as usize];
        match record.constraint.stated() {
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

    fn component(&self, of: &Formula, axis: Axis) -> Syntax {
        let of = self.unbind(of);
        match of.node {
            Syntax::Name(name) => {
                let letter = if axis == Axis::X { "x" } else { "y" };
                Syntax::Name(named(&format!("{name}.{letter}")))
            }
            _ => Syntax::Component(Box::new(of), axis),
        }
    }

    /// The unit that the value of a formula is best said in.
    pub(crate) fn unit(&self, formula: &Formula) -> Unit {
        self.unit_within(formula, &mut { MOST_ASKED })
    }

    /// The same, if it is found by asking no more than so many others.
    fn unit_within(&self, formula: &Formula, left: &mut u32) -> Unit {
        let Some(less) = left.checked_sub(1) else { return Unit::None };
        *left = less;
        match formula.node() {
            Node::Number(_, unit) => *unit,
            Node::Negate(a) => self.unit_within(a, left),
            Node::Binary(op, a, b) => {
                let a = self.unit_within(a, left);
                op.unit(a, self.unit_within(b, left))
            }
            Node::Parameter(id) => {
                let parameter = self.world.parameter(*id);
                parameter.map_or(Unit::None, |it| self.unit_within(&it.formula, left))
            }
            _ => Unit::None,
        }
    }

    /// A formula as the language writes it.
    pub(crate) fn unbind(&self, formula: &Formula) -> Expr {
        let two = |a: &Formula, b: &Formula| Box::new([self.unbind(a), self.unbind(b)]);
        expr(match formula.node() {
            Node::Number(n, unit) => return Expr::literal_in(*n, *unit, NOWHERE),
            Node::Time => Syntax::Time,
            Node::Point(id) => Syntax::Name(named(self.world.points().name(*id))),
            Node::Parameter(id) => Syntax::Name(named(self.world.name_of(Entity::Parameter(*id)))),
            Node::Member(id, member) => {
                let name = self.world.name_of(Entity::Constraint(*id));
                Syntax::Name(named(&format!("{name}.{}", member.word())))
            }
            Node::Statistic(id, which) => {
                let name = self.world.name_of(Entity::Measure(*id));
                Syntax::Name(named(&format!("{name}.{}", which.word())))
            }
            Node::Vector(x, y) => Syntax::Vector(two(x, y)),
            Node::Negate(a) => Syntax::Negate(Box::new(self.unbind(a))),
            Node::Binary(op, a, b) => Syntax::Binary(*op, two(a, b)),
            Node::X(a) => self.component(a, Axis::X),
            Node::Y(a) => self.component(a, Axis::Y),
            Node::Call(function, arguments) => {
                Syntax::Call(*function, arguments.iter().map(|a| self.unbind(a)).collect())
            }
        })
    }
}
