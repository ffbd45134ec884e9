//! Expressions bound to what they name: live formulas over points, parameters and time.

use std::rc::Rc;

use super::{Function, ParameterId, PointId, Shape};
use crate::constraint::{Place, Real};
use crate::diag::{Diagnostic, SourceId, Span};

/// The place of what no text says.
const NOWHERE: Span = Span { source: SourceId(u32::MAX), start: 0, end: 0 };

/// An expression whose names are resolved; cheap to clone.
#[derive(Debug, Clone)]
pub struct Formula(Rc<Inner>);

#[derive(Debug)]
struct Inner {
    node: Node,
    shape: Shape,
    depends: Depends,
    span: Span,
}

/// One node of the tree.
#[derive(Debug)]
pub enum Node {
    /// A number.
    Number(f64),
    /// A vector from its two coordinates.
    Vector(Formula, Formula),
    /// The value of a parameter.
    Parameter(ParameterId),
    /// The position of a point.
    Point(PointId),
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

/// An arithmetic operation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

impl Operator {
    /// The sign in the language.
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
        }
    }
}

/// What can change the value of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(clippy::struct_excessive_bools)] // Four independent facts, joined by "or".
pub struct Depends {
    /// It mentions time, itself or through a parameter.
    pub on_time: bool,
    /// It mentions the position of a point.
    pub on_points: bool,
    /// It mentions a velocity or an acceleration.
    pub on_rates: bool,
    /// It mentions a parameter.
    pub on_parameters: bool,
}

impl Depends {
    /// Whether anything but the user's own edit of a parameter can change it.
    pub const fn is_live(self) -> bool {
        self.on_time || self.on_points || self.on_rates
    }

    /// Whether nothing can change it.
    pub const fn is_constant(self) -> bool {
        !self.is_live() && !self.on_parameters
    }

    #[must_use]
    pub(super) const fn or(self, o: Self) -> Self {
        Self {
            on_time: self.on_time || o.on_time,
            on_points: self.on_points || o.on_points,
            on_rates: self.on_rates || o.on_rates,
            on_parameters: self.on_parameters || o.on_parameters,
        }
    }
}

/// A value of an expression over any kind of number.
#[derive(Debug, Clone, Copy)]
pub enum Value<T = f64> {
    /// A number.
    Number(T),
    /// A vector.
    Vector(Place<T>),
}

impl<T: Real> Value<T> {
    /// What it is.
    pub const fn shape(&self) -> Shape {
        match self {
            Self::Number(_) => Shape::Number,
            Self::Vector(_) => Shape::Vector,
        }
    }

    /// Whether it holds neither an infinity nor not-a-number.
    pub fn is_finite(self) -> bool {
        match self {
            Self::Number(n) => n.value().is_finite(),
            Self::Vector(v) => v.x.value().is_finite() && v.y.value().is_finite(),
        }
    }

    /// The number; formulas are checked for shape when they are bound.
    pub fn number(self) -> T {
        match self {
            Self::Number(n) => n,
            Self::Vector(_) => unreachable!("shapes are checked when a formula is bound"),
        }
    }

    /// The vector; formulas are checked for shape when they are bound.
    pub fn vector(self) -> Place<T> {
        match self {
            Self::Vector(v) => v,
            Self::Number(_) => unreachable!("shapes are checked when a formula is bound"),
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
    fn position(&self, id: PointId) -> Place<T>;
    /// The time.
    fn time(&self) -> T;
    /// Velocity and acceleration of a point; none where they cannot be had.
    fn rates(&self, id: PointId) -> Option<(Place<T>, Place<T>)>;
}

impl Formula {
    /// A constant number without a place in a text.
    pub fn constant(value: f64) -> Self {
        Self::new(Node::Number(value), Shape::Number, Depends::default(), NOWHERE)
    }

    /// A node with its shape, what it depends on and its place in the text.
    pub fn new(node: Node, shape: Shape, depends: Depends, span: Span) -> Self {
        Self(Rc::new(Inner { node, shape, depends, span }))
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
        Rc::ptr_eq(&self.0, &other.0)
    }

    /// Calls `visit` for each point and parameter it mentions.
    pub fn mentions(&self, visit: &mut impl FnMut(Mention)) {
        match self.node() {
            Node::Number(_) | Node::Time => {}
            Node::Parameter(id) => visit(Mention::Parameter(*id)),
            Node::Point(id) => visit(Mention::Point(*id)),
            Node::Negate(a) | Node::X(a) | Node::Y(a) => a.mentions(visit),
            Node::Vector(a, b) | Node::Binary(_, a, b) => {
                a.mentions(visit);
                b.mentions(visit);
            }
            Node::Call(_, arguments) => arguments.iter().for_each(|a| a.mentions(visit)),
        }
    }

    /// The value in an environment.
    ///
    /// # Errors
    /// Points at the part that has no finite value: a division by zero, a root of a negative
    /// number, an overflow.
    pub fn evaluate<T: Real>(&self, env: &impl Environment<T>) -> Result<Value<T>, Diagnostic> {
        use Value::{Number, Vector};
        let value = match self.node() {
            Node::Number(n) => return Ok(Number(T::constant(*n))),
            Node::Time => return Ok(Number(env.time())),
            Node::Point(id) => return Ok(Vector(env.position(*id))),
            Node::Parameter(id) => return env.parameter(*id),
            Node::Vector(x, y) => {
                Vector(Place { x: x.evaluate(env)?.number(), y: y.evaluate(env)?.number() })
            }
            Node::Negate(a) => match a.evaluate(env)? {
                Number(n) => Number(-n),
                Vector(v) => Vector(Place { x: -v.x, y: -v.y }),
            },
            Node::X(a) => Number(a.evaluate(env)?.vector().x),
            Node::Y(a) => Number(a.evaluate(env)?.vector().y),
            Node::Binary(operator, a, b) => {
                self.operate(*operator, a.evaluate(env)?, b.evaluate(env)?, b)?
            }
            Node::Call(function, arguments) => self.call(*function, arguments, env)?,
        };
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Diagnostic::error("this has no finite value").at(self.span(), "overflows"))
        }
    }

    fn operate<T: Real>(
        &self,
        operator: Operator,
        a: Value<T>,
        b: Value<T>,
        right: &Self,
    ) -> Result<Value<T>, Diagnostic> {
        use Value::{Number, Vector};
        let scaled = |k: T, v: Place<T>| Vector(Place { x: k * v.x, y: k * v.y });
        Ok(match (operator, a, b) {
            (Operator::Add, Number(a), Number(b)) => Number(a + b),
            (Operator::Subtract, Number(a), Number(b)) => Number(a - b),
            (Operator::Multiply, Number(a), Number(b)) => Number(a * b),
            (Operator::Add, Vector(a), Vector(b)) => Vector(Place { x: a.x + b.x, y: a.y + b.y }),
            (Operator::Subtract, Vector(a), Vector(b)) => Vector(a - b),
            (Operator::Multiply, Number(k), Vector(v))
            | (Operator::Multiply, Vector(v), Number(k)) => scaled(k, v),
            (Operator::Divide, _, Number(b)) if b.value() == 0.0 => {
                return Err(Diagnostic::error("division by zero").at(right.span(), "this is 0"));
            }
            (Operator::Divide, Number(a), Number(b)) => Number(a / b),
            (Operator::Divide, Vector(v), Number(b)) => Vector(Place { x: v.x / b, y: v.y / b }),
            (Operator::Power, Number(a), Number(b)) => match power(a, b) {
                Some(p) => Number(p),
                None => {
                    return Err(Diagnostic::error("this power has no value").at(
                        self.span(),
                        "a negative number to a broken power, or 0 to a negative",
                    ));
                }
            },
            _ => unreachable!("shapes are checked when a formula is bound"),
        })
    }

    fn call<T: Real>(
        &self,
        function: Function,
        arguments: &[Self],
        env: &impl Environment<T>,
    ) -> Result<Value<T>, Diagnostic> {
        use Value::{Number, Vector};
        let number = |k: usize| Ok::<_, Diagnostic>(arguments[k].evaluate(env)?.number());
        let vector = |k: usize| Ok::<_, Diagnostic>(arguments[k].evaluate(env)?.vector());
        Ok(match function {
            Function::Norm => Number(length(vector(0)?)),
            Function::Dot => Number(dot(vector(0)?, vector(1)?)),
            Function::Cross => Number(cross(vector(0)?, vector(1)?)),
            Function::Rotate => {
                let (v, phi) = (vector(0)?, number(1)?);
                let (s, c) = (phi.sin(), phi.cos());
                Vector(Place { x: v.x * c - v.y * s, y: v.x * s + v.y * c })
            }
            Function::Polar => {
                let (r, phi) = (number(0)?, number(1)?);
                Vector(Place { x: r * phi.cos(), y: r * phi.sin() })
            }
            Function::Midpoint => {
                let (p, q, half) = (vector(0)?, vector(1)?, T::constant(0.5));
                Vector(Place { x: half * (p.x + q.x), y: half * (p.y + q.y) })
            }
            Function::Distance => Number(length(vector(1)? - vector(0)?)),
            Function::DistanceToLine => {
                let (p, a, b) = (vector(0)?, vector(1)?, vector(2)?);
                let l = length(b - a);
                if l.value() == 0.0 {
                    return Err(Diagnostic::error("the two points of the line coincide")
                        .at(self.span(), "no line to measure from"));
                }
                Number(cross(b - a, p - a) / l)
            }
            Function::Angle => {
                let v = vector(1)? - vector(0)?;
                self.angle_of(v.x, v.y)?
            }
            Function::AngleBetween => {
                let u = vector(1)? - vector(0)?;
                let v = vector(3)? - vector(2)?;
                self.angle_of(dot(u, v), cross(u, v))?
            }
            Function::Velocity | Function::Acceleration => {
                let Node::Point(id) = arguments[0].node() else {
                    unreachable!("a rate is bound to the name of a point")
                };
                let Some((velocity, acceleration)) = env.rates(*id) else {
                    return Err(Diagnostic::error(format!(
                        "`{}` cannot be had here",
                        function.name()
                    ))
                    .at(self.span(), "only where a value is looked at")
                    .help("use it in `print`, `assert`, or a parameter that these use"));
                };
                Vector(if function == Function::Velocity { velocity } else { acceleration })
            }
            _ => {
                // Two numbers at most, but for `min` and `max`.
                let mut few = [T::constant(0.0); 2];
                let value = if arguments.len() <= 2 {
                    for (k, slot) in few.iter_mut().enumerate().take(arguments.len()) {
                        *slot = number(k)?;
                    }
                    function.of_numbers(&few[..arguments.len()])
                } else {
                    let all = (0..arguments.len()).map(number).collect::<Result<Vec<T>, _>>()?;
                    function.of_numbers(&all)
                };
                match value {
                    Some(value) => Number(value),
                    None => {
                        let given = few[usize::from(function == Function::Mod)].value();
                        return Err(Diagnostic::error(format!(
                            "`{}` has no value at {}",
                            function.name(),
                            crate::diag::format_number(given)
                        ))
                        .at(self.span(), "outside its domain"));
                    }
                }
            }
        })
    }

    fn angle_of<T: Real>(&self, x: T, y: T) -> Result<Value<T>, Diagnostic> {
        if x.value() == 0.0 && y.value() == 0.0 {
            return Err(Diagnostic::error("two points coincide, so there is no direction")
                .at(self.span(), "no angle"));
        }
        Ok(Value::Number(y.atan2(x)))
    }
}

/// What a formula mentions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mention {
    /// A point.
    Point(PointId),
    /// A parameter.
    Parameter(ParameterId),
}

fn dot<T: Real>(a: Place<T>, b: Place<T>) -> T {
    a.x * b.x + a.y * b.y
}

fn cross<T: Real>(a: Place<T>, b: Place<T>) -> T {
    a.x * b.y - a.y * b.x
}

/// The length of a vector; the value never overflows before its result does.
fn length<T: Real>(v: Place<T>) -> T {
    let squares = v.norm();
    let exact = crate::constraint::Vector::new(v.x.value(), v.y.value()).norm();
    if squares.value() == exact { squares } else { squares.chain(exact, 1.0, 0.0) }
}

/// a^b; none where it has no real value.
fn power<T: Real>(a: T, b: T) -> Option<T> {
    let (x, p) = (a.value(), b.value());
    if (x == 0.0 && p < 0.0) || (x < 0.0 && p != p.trunc()) {
        return None;
    }
    let v = libm::pow(x, p);
    // As a function of the base with a constant power, then of the power with a constant base.
    let by_base = a.chain(v, slope(p, x, p - 1.0), slope(p * (p - 1.0), x, p - 2.0));
    if b.is_constant() || x <= 0.0 {
        return Some(by_base);
    }
    let e = b * a.chain(libm::log(x), 1.0 / x, -1.0 / (x * x));
    Some(e.chain(v, v, v))
}

/// k x^p, 0 where k is.
fn slope(k: f64, x: f64, p: f64) -> f64 {
    if k == 0.0 { 0.0 } else { k * libm::pow(x, p) }
}
