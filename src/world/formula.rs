//! Expressions bound to what they name: live formulas over points, parameters and time.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::arithmetic::{call, finite, operate};
use super::rate_function::{MovingPoint, rate};
use super::turning::whole_turns;
use super::{ConstraintId, MeasureId, ParameterId, PointId, Turning, Value};
use crate::constraint::{Real, Vec2};
use crate::diag::{Diagnostic, SourceId, Span};
use crate::errors;
use crate::terms::{Function, Member, Operator, Shape, Statistic, Unit};

/// The place of what no text says.
const NOWHERE: Span = Span { source: SourceId(u32::MAX), start: 0, end: 0 };

/// An expression whose names are resolved; cheap to clone.
#[derive(Debug, Clone)]
pub struct Formula(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    node: Node,
    shape: Shape,
    depends: Depends,
    span: Span,
    extent: Extent,
}

/// How long and how deep an expression is. What is shared counts wherever it stands, as whoever goes
/// through the expression meets it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Extent {
    /// How many terms it has; very many count as the largest number.
    pub n_terms: u32,
    /// How many of them stand within each other.
    pub depth: u32,
}

impl Extent {
    /// One term around others.
    fn around(parts: impl IntoIterator<Item = Self>) -> Self {
        let all = parts.into_iter().fold(Self::default(), |all, part| Self {
            n_terms: all.n_terms.saturating_add(part.n_terms),
            depth: all.depth.max(part.depth),
        });
        Self { n_terms: all.n_terms.saturating_add(1), depth: all.depth.saturating_add(1) }
    }
}

/// One node of the tree.
#[derive(Debug)]
pub enum Node {
    /// A number.
    Number(f64, Unit),
    /// A vector from its two coordinates.
    Vector(Formula, Formula),
    /// The value of a parameter.
    Parameter(ParameterId),
    /// The position of a point.
    Point(PointId),
    /// A member of a constraint.
    Member(ConstraintId, Member),
    /// What a measure has kept of its values.
    Statistic(MeasureId, Statistic),
    /// The time of the clock.
    Time,
    /// The negative.
    Negate(Formula),
    /// An arithmetic operation.
    Binary(Operator, Formula, Formula),
    /// The horizontal coordinate.
    X(Formula),
    /// The vertical coordinate.
    Y(Formula),
    /// A function of its arguments.
    Call(Function, Box<[Formula]>),
}

/// What can change the value of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(clippy::struct_excessive_bools)] // Independent facts, joined by "or".
pub struct Depends {
    /// It mentions time, itself or through a parameter.
    pub on_time: bool,
    /// It mentions the position of a point.
    pub on_points: bool,
    /// It mentions a velocity or an acceleration.
    pub on_rates: bool,
    /// It mentions the angle of a motor.
    pub on_angles: bool,
    /// It mentions what a constraint measures, or by how much it is missed.
    pub on_constraints: bool,
    /// It mentions what a measure has kept.
    pub on_measures: bool,
    /// It mentions a parameter.
    pub on_parameters: bool,
}

impl Depends {
    /// Whether anything but the user's own edit of a parameter can change it.
    pub const fn is_live(self) -> bool {
        self.on_time
            || self.on_points
            || self.on_rates
            || self.on_angles
            || self.on_constraints
            || self.on_measures
    }

    /// Whether parameters are looked up for its value: those that it mentions, or those that drive a constraint by
    /// how much of which is missed.
    pub const fn looks_up_parameters(self) -> bool {
        self.on_parameters || self.on_constraints
    }

    /// Whether nothing can change it.
    pub const fn is_constant(self) -> bool {
        !self.is_live() && !self.on_parameters
    }

    /// What can change one or the other.
    #[must_use]
    pub const fn or(self, o: Self) -> Self {
        Self {
            on_time: self.on_time || o.on_time,
            on_points: self.on_points || o.on_points,
            on_rates: self.on_rates || o.on_rates,
            on_angles: self.on_angles || o.on_angles,
            on_constraints: self.on_constraints || o.on_constraints,
            on_measures: self.on_measures || o.on_measures,
            on_parameters: self.on_parameters || o.on_parameters,
        }
    }
}

/// Where a formula finds what it mentions.
pub trait Environment<T: Real> {
    /// The value of a parameter.
    ///
    /// # Errors
    /// Where the parameter's own formula has no value.
    fn parameter(&self, id: ParameterId) -> Result<Value<T>, Diagnostic>;
    /// The position of a point.
    fn position(&self, id: PointId) -> Vec2<T>;
    /// The time.
    fn time(&self) -> T;
    /// The angle with whole turns that a direction of now is nearest to.
    fn expected_turn(&self, turning: Turning) -> f64;
    /// The value of a member of a constraint.
    ///
    /// # Errors
    /// Where a live value of the constraint has none.
    fn member(&self, id: ConstraintId, member: Member) -> Result<T, Diagnostic>;
    /// What a measure has kept of its values.
    ///
    /// # Errors
    /// Where it has none yet.
    fn statistic(&self, id: MeasureId, which: Statistic, span: Span) -> Result<T, Diagnostic>;
    /// Velocity and acceleration of a point; none where they cannot be had.
    fn rates(&self, id: PointId) -> Option<(Vec2<T>, Vec2<T>)>;
}

impl Formula {
    /// Roughly how many bytes it takes, but for the formulas that it is made of: those are shared.
    pub const fn n_bytes(&self) -> usize {
        size_of::<Inner>()
    }

    /// A constant number without a place in a text.
    pub fn constant(value: f64) -> Self {
        Self::new(Node::Number(value, Unit::None), Shape::Number, Depends::default(), NOWHERE)
    }

    /// A node that stands in no text.
    pub(super) fn without_place(node: Node, shape: Shape, depends: Depends) -> Self {
        Self::new(node, shape, depends, NOWHERE)
    }

    /// A node with its shape, what it depends on and its place in the text.
    pub fn new(node: Node, shape: Shape, depends: Depends, span: Span) -> Self {
        let extent = match &node {
            Node::Number(..)
            | Node::Parameter(_)
            | Node::Point(_)
            | Node::Member(..)
            | Node::Statistic(..)
            | Node::Time => Extent::around([]),
            Node::Negate(a) | Node::X(a) | Node::Y(a) => Extent::around([a.extent()]),
            Node::Vector(a, b) | Node::Binary(_, a, b) => Extent::around([a.extent(), b.extent()]),
            Node::Call(_, arguments) => Extent::around(arguments.iter().map(Self::extent)),
        };
        Self(Arc::new(Inner { node, shape, depends, span, extent }))
    }

    /// How long and how deep it is by itself; what it mentions is one term.
    pub fn extent(&self) -> Extent {
        self.0.extent
    }

    /// The tree.
    pub fn node(&self) -> &Node {
        &self.0.node
    }

    /// What it gives.
    pub fn shape(&self) -> Shape {
        self.0.shape
    }

    /// What can change it, without regard to what its parameters depend on.
    pub fn depends(&self) -> Depends {
        self.0.depends
    }

    /// Its place in the text.
    pub fn span(&self) -> Span {
        self.0.span
    }

    /// Whether two handles show the same formula.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// What gives the opposite of what it gives.
    #[must_use]
    pub fn negative(&self) -> Self {
        match self.node() {
            Node::Negate(inner) => inner.clone(),
            _ => Self::new(Node::Negate(self.clone()), self.shape(), self.depends(), self.span()),
        }
    }

    /// Calls `visit` for each point, parameter and member it mentions.
    pub fn mentions(&self, visit: &mut impl FnMut(Mention)) {
        match self.node() {
            Node::Number(..) | Node::Time => {}
            Node::Parameter(id) => visit(Mention::Parameter(*id)),
            Node::Point(id) => visit(Mention::Point(*id)),
            Node::Member(id, member) => visit(Mention::Member(*id, *member)),
            Node::Statistic(id, _) => visit(Mention::Measure(*id)),
            Node::Negate(a) | Node::X(a) | Node::Y(a) => a.mentions(visit),
            Node::Vector(a, b) | Node::Binary(_, a, b) => {
                a.mentions(visit);
                b.mentions(visit);
            }
            Node::Call(_, arguments) => arguments.iter().for_each(|a| a.mentions(visit)),
        }
    }

    /// Calls `visit` for each pair of points between which it measures: a distance, a direction, a
    /// difference, a middle.
    pub fn segments(&self, visit: &mut impl FnMut([PointId; 2])) {
        match self.node() {
            Node::Number(..)
            | Node::Time
            | Node::Parameter(_)
            | Node::Point(_)
            | Node::Member(..)
            | Node::Statistic(..) => {}
            Node::Negate(a) | Node::X(a) | Node::Y(a) => a.segments(visit),
            Node::Vector(a, b) | Node::Binary(_, a, b) => {
                let ends = a.as_point().zip(b.as_point());
                if let (Node::Binary(Operator::Subtract, ..), Some((from, to))) =
                    (self.node(), ends)
                {
                    visit([from, to]);
                }
                a.segments(visit);
                b.segments(visit);
            }
            Node::Call(_, arguments) => {
                // A line stands behind the point whose distance from it is meant.
                let (_, pairs) = arguments.as_rchunks::<2>();
                if arguments.iter().all(|a| a.as_point().is_some()) {
                    pairs.iter().for_each(|[from, to]| visit([from.point(), to.point()]));
                }
                arguments.iter().for_each(|a| a.segments(visit));
            }
        }
    }

    /// The value in an environment.
    ///
    /// # Errors
    /// Points at the part that has no finite value: a division by zero, a root of a negative
    /// number, an overflow.
    #[inline]
    pub fn evaluate<T: Real>(&self, env: &impl Environment<T>) -> Result<Value<T>, Diagnostic> {
        match self.node() {
            Node::Number(n, _) => Ok(Value::Number(T::constant(*n))),
            Node::Time => Ok(Value::Number(env.time())),
            Node::Point(id) => Ok(Value::Vector(env.position(*id))),
            Node::Parameter(id) => env.parameter(*id),
            _ => self.work_out(env),
        }
    }

    /// The value of what is made of other formulas.
    fn work_out<T: Real>(&self, env: &impl Environment<T>) -> Result<Value<T>, Diagnostic> {
        use Value::{Number, Vector};
        let value = match self.node() {
            Node::Number(..) | Node::Time | Node::Point(_) | Node::Parameter(_) => {
                return self.evaluate(env);
            }
            Node::Member(id, member) => Number(env.member(*id, *member)?),
            Node::Statistic(id, which) => Number(env.statistic(*id, *which, self.span())?),
            Node::Vector(x, y) => {
                Vector(Vec2 { x: x.evaluate(env)?.number(), y: y.evaluate(env)?.number() })
            }
            Node::Negate(a) => match a.evaluate(env)? {
                Number(n) => Number(-n),
                Vector(v) => Vector(Vec2 { x: -v.x, y: -v.y }),
            },
            Node::X(a) => Number(a.evaluate(env)?.vector().x),
            Node::Y(a) => Number(a.evaluate(env)?.vector().y),
            Node::Binary(operator, a, b) => {
                let (left, right) = (a.evaluate(env)?, b.evaluate(env)?);
                return operate(*operator, left, right, self.span(), b.span());
            }
            Node::Call(function, arguments) if function.is_rate() => {
                return self.rate(*function, arguments, env);
            }
            Node::Call(function, arguments) if function.counts_turns() => {
                return self.turn(*function, arguments, env);
            }
            Node::Call(function, arguments) => {
                // Few arguments but for `min` and `max`: no allocation then.
                let mut few = [Number(T::constant(0.0)); 4];
                return if let Some(few) = few.get_mut(..arguments.len()) {
                    for (value, argument) in few.iter_mut().zip(arguments) {
                        *value = argument.evaluate(env)?;
                    }
                    call(*function, few, self.span())
                } else {
                    let all =
                        arguments.iter().map(|a| a.evaluate(env)).collect::<Result<Vec<_>, _>>()?;
                    call(*function, &all, self.span())
                };
            }
        };
        finite(value, self.span())
    }

    fn rate<T: Real>(
        &self,
        function: Function,
        arguments: &[Self],
        env: &impl Environment<T>,
    ) -> Result<Value<T>, Diagnostic> {
        let moving = arguments.iter().map(|argument| {
            let id = argument.point();
            let (velocity, acceleration) = env.rates(id)?;
            Some(MovingPoint { at: env.position(id), velocity, acceleration })
        });
        let Some(moving) = moving.collect::<Option<Vec<_>>>() else {
            return Err(Diagnostic::error(
                errors::NOT_A_DRIVER,
                format!("`{}` cannot be had here", function.name()),
            )
            .at(self.span(), "only where a value is looked at")
            .help("use it in `print`, `assert`, or a parameter that these use"));
        };
        rate(function, &moving, self.span())
    }

    fn turn<T: Real>(
        &self,
        function: Function,
        arguments: &[Self],
        env: &impl Environment<T>,
    ) -> Result<Value<T>, Diagnostic> {
        let points: Vec<PointId> = arguments.iter().map(Self::point).collect();
        let places: Vec<_> = points.iter().map(|&id| Value::Vector(env.position(id))).collect();
        let angle = call(function, &places, self.span())?.number();
        let turning = Turning::of(&points).expect("it is bound to two points, or four");
        let turns = whole_turns(env.expected_turn(turning), angle.value());
        finite(Value::Number(angle + T::constant(turns * TAU)), self.span())
    }

    /// Whether it is a count of turns.
    pub fn counts_turns(&self) -> bool {
        matches!(self.node(), Node::Call(function, _) if function.counts_turns())
    }

    /// Whether it is the time.
    pub fn is_time(&self) -> bool {
        matches!(self.node(), Node::Time)
    }

    /// The point, if that is all it is.
    pub fn as_point(&self) -> Option<PointId> {
        match self.node() {
            Node::Point(id) => Some(*id),
            _ => None,
        }
    }

    /// The point, of an argument that is bound to the name of one.
    fn point(&self) -> PointId {
        self.as_point().expect("it is bound to the name of a point")
    }
}

/// What a formula mentions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mention {
    /// A point.
    Point(PointId),
    /// A parameter.
    Parameter(ParameterId),
    /// A member of a constraint.
    Member(ConstraintId, Member),
    /// A measure.
    Measure(MeasureId),
}
