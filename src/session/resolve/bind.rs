//! Expressions of the language become values, or formulas that stay live.

use super::scope::{Meaning, Resolver};
use super::scopes::{Bound, lost};
use crate::constraint::{LARGEST, Point, Vec2};
use crate::diag::{Diagnostic, Span, format_count, format_number};
use crate::errors;
use crate::lang::ast::{Axis, Expr, Node as Syntax};
use crate::terms::{Operator, Shape, Unit};
use crate::world::{Depends, Entity, Formula, Node, Rates, Value, operate};

/// What an expression was bound to; constants are folded, so that only what can change
/// makes a tree.
#[derive(Debug, Clone)]
pub enum Term {
    /// A value that cannot change, and the unit that it is said in.
    Constant(Value, Unit),
    /// A formula over points, parameters or time.
    Live(Formula),
}

/// What names in an expression become.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Their values now.
    Now,
    /// Themselves: the expression stays live.
    Live,
}

/// A number that may be driven by an expression.
#[derive(Debug, Clone)]
pub struct Driven {
    /// Its value now.
    pub value: f64,
    /// The unit that it is said in, if it cannot.
    pub unit: Unit,
    /// The expression, if it can change.
    pub formula: Option<Formula>,
}

impl Term {
    pub(super) fn shape(&self) -> Shape {
        match self {
            Self::Constant(value, _) => value.shape(),
            Self::Live(formula) => formula.shape(),
        }
    }

    /// A value without a unit.
    pub(super) const fn plain(value: Value) -> Self {
        Self::Constant(value, Unit::None)
    }

    /// The formula, of a constant too.
    pub fn into_formula(self, span: Span) -> Formula {
        let constant = |node, shape| Formula::new(node, shape, Depends::default(), span);
        let number = |n, unit| constant(Node::Number(n, unit), Shape::Number);
        match self {
            Self::Live(formula) => formula,
            Self::Constant(Value::Number(n), unit) => number(n, unit),
            Self::Constant(Value::Vector(v), _) => {
                let [x, y] = [v.x, v.y].map(|n| number(n, Unit::None));
                constant(Node::Vector(x, y), Shape::Vector)
            }
        }
    }

    pub(super) fn depends(&self) -> Depends {
        match self {
            Self::Constant(..) => Depends::default(),
            Self::Live(formula) => formula.depends(),
        }
    }
}

impl Resolver<'_> {
    /// The value of an expression now.
    pub(crate) fn value(&mut self, expr: &Expr) -> Result<Value, Diagnostic> {
        match self.bind(expr, Mode::Now)? {
            Term::Constant(value, _) => Ok(value),
            Term::Live(formula) => unreachable!("{formula:?} was to be evaluated"),
        }
    }

    /// The value of an expression that has to be a number.
    pub(crate) fn number(&mut self, expr: &Expr) -> Result<f64, Diagnostic> {
        match self.value(expr)? {
            Value::Number(n) => Ok(n),
            Value::Vector(_) => Err(wanted(expr, Shape::Number)),
        }
    }

    /// The value of an expression that has to be a place.
    pub(crate) fn place(&mut self, expr: &Expr) -> Result<Point, Diagnostic> {
        match self.value(expr)? {
            Value::Vector(v) => {
                let at = Point::new(v.x, v.y);
                if at.is_in_reach() { Ok(at) } else { Err(too_large(expr, Value::Vector(v))) }
            }
            Value::Number(_) => Err(wanted(expr, Shape::Vector)
                .help("a place is written `(x, y)`, or named by a point")),
        }
    }

    /// The value of an expression that has to be a whole number from `least` to `most`.
    pub(crate) fn count(
        &mut self,
        expr: &Expr,
        least: f64,
        most: f64,
        of: &str,
    ) -> Result<u64, Diagnostic> {
        let value = self.number(expr)?;
        let n = value.round();
        if (n - value).abs() > 1e-9 * value.abs().max(1.0) {
            return Err(Diagnostic::error(
                errors::OUT_OF_RANGE,
                format!("expected a whole number of {of}"),
            )
            .at(expr.span, format!("this is {}", format_number(value))));
        }
        if n < least || n > most {
            return Err(Diagnostic::error(
                errors::OUT_OF_RANGE,
                format!("expected {} to {} {of}", format_number(least), format_count(most)),
            )
            .at(expr.span, format!("this is {}", format_count(value))));
        }
        Ok(n as u64)
    }

    /// A live expression, its constant parts folded.
    pub(crate) fn live(&mut self, expr: &Expr) -> Result<Term, Diagnostic> {
        let term = self.bind(expr, Mode::Live)?;
        if let Term::Live(formula) = &term {
            self.refuse_too_long(formula, expr.span)?;
        }
        Ok(term)
    }

    /// A live number with its value now.
    pub(crate) fn driven(&mut self, expr: &Expr) -> Result<Driven, Diagnostic> {
        match self.measured_as(expr, Shape::Number)? {
            (Value::Number(value), unit, formula) => Ok(Driven { value, unit, formula }),
            (Value::Vector(_), ..) => unreachable!("the shape was asked for"),
        }
    }

    /// A value for a constraint, with the expression that drives it.
    pub(crate) fn driver(
        &mut self,
        expr: &Expr,
        shape: Shape,
    ) -> Result<(Value, Option<Formula>), Diagnostic> {
        let (value, _, formula) = self.measured_as(expr, shape)?;
        Ok((value, formula))
    }

    /// A value of this shape, the unit that it is said in, and the expression if it can change.
    fn measured_as(
        &mut self,
        expr: &Expr,
        shape: Shape,
    ) -> Result<(Value, Unit, Option<Formula>), Diagnostic> {
        let (value, unit, formula) = self.measured_within(expr)?;
        if value.shape() != shape {
            return Err(wanted(expr, shape));
        }
        Ok((value, unit, formula))
    }

    /// A value that a constraint may have or hold, with the expression behind it if it can change.
    pub(crate) fn measure(&mut self, expr: &Expr) -> Result<(Value, Option<Formula>), Diagnostic> {
        let (value, _, formula) = self.measured_within(expr)?;
        Ok((value, formula))
    }

    fn measured_within(
        &mut self,
        expr: &Expr,
    ) -> Result<(Value, Unit, Option<Formula>), Diagnostic> {
        let measured = self.measured(expr)?;
        if measured.0.is_within(LARGEST) || self.state.is_restoring {
            return Ok(measured);
        }
        Err(too_large(expr, measured.0))
    }

    fn measured(&mut self, expr: &Expr) -> Result<(Value, Unit, Option<Formula>), Diagnostic> {
        match self.live(expr)? {
            Term::Constant(value, unit) => Ok((value, unit, None)),
            Term::Live(formula) => {
                self.refuse_what_follows(&formula, expr.span)?;
                let value = match self.state.world.evaluate(&formula, None) {
                    // The one that it had last is put back after.
                    Err(_) if self.state.is_restoring => Value::zero(formula.shape()),
                    value => value?,
                };
                Ok((value, Unit::None, Some(formula)))
            }
        }
    }

    /// The value of an expression, or the formula that it is.
    pub(super) fn bind(&mut self, expr: &Expr, mode: Mode) -> Result<Term, Diagnostic> {
        let number = |n| Ok(Term::plain(Value::Number(n)));
        match &expr.node {
            Syntax::Number(n) => Ok(Term::Constant(Value::Number(n.value()), n.unit)),
            Syntax::Pi => number(std::f64::consts::PI),
            Syntax::Tau => number(std::f64::consts::TAU),
            Syntax::Time => match mode {
                Mode::Now => number(self.state.world.clock().time()),
                Mode::Live => {
                    let depends = Depends { on_time: true, ..Depends::default() };
                    Ok(Term::Live(Formula::new(Node::Time, Shape::Number, depends, expr.span)))
                }
            },
            Syntax::Name(name) => {
                let (meaning, axis) = self.meaning(name)?;
                let term = self.bind_name(meaning, name.span, mode)?;
                match axis {
                    Some(axis) => component(term, axis, expr.span),
                    None => Ok(term),
                }
            }
            Syntax::Negate(inner) => Ok(match self.bind(inner, mode)? {
                Term::Constant(Value::Number(n), unit) => Term::Constant(Value::Number(-n), unit),
                Term::Constant(Value::Vector(v), _) => {
                    Term::plain(Value::Vector(Vec2 { x: -v.x, y: -v.y }))
                }
                Term::Live(f) => {
                    let (shape, depends) = (f.shape(), f.depends());
                    Term::Live(Formula::new(Node::Negate(f), shape, depends, expr.span))
                }
            }),
            Syntax::Binary(op, sides) => {
                let left = self.bind(&sides[0], mode)?;
                let right = self.bind(&sides[1], mode)?;
                binary(*op, left, right, expr, sides)
            }
            Syntax::Vector(parts) => {
                let x = self.bind(&parts[0], mode)?;
                let y = self.bind(&parts[1], mode)?;
                for (term, part) in [(&x, &parts[0]), (&y, &parts[1])] {
                    if term.shape() != Shape::Number {
                        return Err(wanted(part, Shape::Number));
                    }
                }
                if let (Term::Constant(x, _), Term::Constant(y, _)) = (&x, &y) {
                    let v = Vec2 { x: x.number(), y: y.number() };
                    return Ok(Term::plain(Value::Vector(v)));
                }
                let depends = x.depends().or(y.depends());
                let node =
                    Node::Vector(x.into_formula(parts[0].span), y.into_formula(parts[1].span));
                Ok(Term::Live(Formula::new(node, Shape::Vector, depends, expr.span)))
            }
            Syntax::Component(inner, axis) => {
                let term = self.bind(inner, mode)?;
                component(term, *axis, expr.span)
            }
            Syntax::Call(function, arguments) => self.bind_call(*function, arguments, expr, mode),
        }
    }

    fn bind_name(&mut self, meaning: Meaning, span: Span, mode: Mode) -> Result<Term, Diagnostic> {
        let entity = match meaning {
            Meaning::Bound(Bound::Number(n, unit)) => {
                return Ok(Term::Constant(Value::Number(n), unit));
            }
            Meaning::Bound(Bound::Formula(formula)) => {
                return match mode {
                    Mode::Live => Ok(Term::Live(formula)),
                    Mode::Now => self.evaluate(&formula).map(Term::plain),
                };
            }
            Meaning::Bound(Bound::Lost) => return Err(lost(span)),
            Meaning::Member(id, member) => return self.bind_member(id, member, span, mode),
            Meaning::Statistic(id, which) => {
                return self.bind_statistic(id, which, span, mode);
            }
            Meaning::Bound(Bound::Point(id)) => Entity::Point(id),
            Meaning::Entity(entity) => entity,
        };
        let (node, shape, depends) = match entity {
            Entity::Point(id) => {
                if mode == Mode::Now {
                    let p = self.state.world.points().at(id);
                    return Ok(Term::plain(Value::Vector(Vec2 { x: p.x, y: p.y })));
                }
                let depends = Depends { on_points: true, ..Depends::default() };
                (Node::Point(id), Shape::Vector, depends)
            }
            Entity::Parameter(id) => {
                let parameter = self.state.world.parameter(id).expect("a named parameter lives");
                let shape = parameter.formula.shape();
                if mode == Mode::Now
                    && !parameter.depends.is_live()
                    && let Some(value) = parameter.value
                {
                    return Ok(Term::plain(value));
                }
                let depends = Depends { on_parameters: true, ..Depends::default() };
                (Node::Parameter(id), shape, depends)
            }
            Entity::Constraint(_) | Entity::Measure(_) => {
                let (name, noun) = (self.state.world.name_of(entity), entity.noun());
                let problem =
                    Diagnostic::error(errors::WRONG_SORT, format!("`{name}` is a {noun}"))
                        .at(span, "expected a point, a parameter or a number");
                let is_measure = matches!(entity, Entity::Measure(_));
                let statistics =
                    format!("`{name}.last` is its last value, `{name}.max` its greatest");
                return Err(if is_measure { problem.help(statistics) } else { problem });
            }
        };
        let formula = Formula::new(node, shape, depends, span);
        match mode {
            Mode::Live => Ok(Term::Live(formula)),
            Mode::Now => self.evaluate(&formula).map(Term::plain),
        }
    }

    /// The value of a formula now, velocities included if it needs them.
    pub(crate) fn evaluate(&mut self, formula: &Formula) -> Result<Value, Diagnostic> {
        if self.state.world.depends(formula).on_rates {
            let rates = self.rates()?;
            self.state.world.evaluate(formula, Some(&rates))
        } else {
            self.state.world.evaluate(formula, None)
        }
    }

    fn rates(&mut self) -> Result<Rates, Diagnostic> {
        self.state.look(crate::solve::Solver::rates)
    }
}

fn component(term: Term, axis: Axis, span: Span) -> Result<Term, Diagnostic> {
    let letter = if axis == Axis::X { "x" } else { "y" };
    match term {
        Term::Constant(Value::Vector(v), _) => {
            Ok(Term::plain(Value::Number(if axis == Axis::X { v.x } else { v.y })))
        }
        Term::Live(f) if f.shape() == Shape::Vector => {
            let depends = f.depends();
            let node = if axis == Axis::X { Node::X(f) } else { Node::Y(f) };
            Ok(Term::Live(Formula::new(node, Shape::Number, depends, span)))
        }
        _ => Err(Diagnostic::error(errors::NO_MEMBER, format!("a number has no `.{letter}`"))
            .at(span, "only a vector has components")),
    }
}

fn binary(
    operator: Operator,
    left: Term,
    right: Term,
    expr: &Expr,
    sides: &[Expr; 2],
) -> Result<Term, Diagnostic> {
    use Shape::{Number, Vector};
    let shape = match (operator, left.shape(), right.shape()) {
        (_, Number, Number) => Number,
        (Operator::Add | Operator::Subtract, Vector, Vector)
        | (Operator::Multiply, Number, Vector)
        | (Operator::Multiply | Operator::Divide, Vector, Number) => Vector,
        (_, a, b) => {
            let sorts = if a == b {
                format!("two {}s", a.noun())
            } else {
                format!("a {} and a {}", a.noun(), b.noun())
            };
            let sign = operator.sign();
            let problem = Diagnostic::error(
                errors::MIXED_SORTS,
                format!("`{sign}` does not go between {sorts}"),
            )
            .at(expr.span, "")
            .also(sides[0].span, format!("a {}", a.noun()))
            .also(sides[1].span, format!("a {}", b.noun()));
            return Err(match (operator, a, b) {
                (Operator::Multiply, Vector, Vector) => {
                    problem.help("`dot(v, w)` and `cross(v, w)` multiply vectors")
                }
                (Operator::Power, Vector, Number) => {
                    problem.help("`dot(v, v)` is the square of a vector's length")
                }
                _ => problem,
            });
        }
    };
    if let (Term::Constant(a, left), Term::Constant(b, right)) = (&left, &right) {
        let value = operate(operator, *a, *b, expr.span, sides[1].span)?;
        let unit = if shape == Number { operator.unit(*left, *right) } else { Unit::None };
        return Ok(Term::Constant(value, unit));
    }
    let depends = left.depends().or(right.depends());
    let [left, right] =
        [(left, &sides[0]), (right, &sides[1])].map(|(t, of)| t.into_formula(of.span));
    let node = Node::Binary(operator, left, right);
    Ok(Term::Live(Formula::new(node, shape, depends, expr.span)))
}

/// The error for a value that poses cannot be worked out with.
fn too_large(expr: &Expr, value: Value) -> Diagnostic {
    let size = match value {
        Value::Number(n) => n.abs(),
        Value::Vector(v) => v.x.abs().max(v.y.abs()),
    };
    Diagnostic::error(errors::OUT_OF_RANGE, "this is too large to work with")
        .at(expr.span, format!("{}, no more than {}", format_number(size), format_number(LARGEST)))
}

/// The error for an expression of the other shape.
pub(super) fn wanted(expr: &Expr, shape: Shape) -> Diagnostic {
    let is = if shape == Shape::Number { Shape::Vector } else { Shape::Number };
    Diagnostic::error(errors::MIXED_SORTS, format!("expected a {}", shape.noun()))
        .at(expr.span, format!("this is a {}", is.noun()))
}
