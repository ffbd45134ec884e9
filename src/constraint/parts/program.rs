//! What is measured on a pose: expressions over points, as a list of operations.
//!
//! Each operation works on the results of earlier ones, so that what several values mention is
//! worked out once. A value that does not exist, as the root of a negative number, is not a number.

use super::content::add_all;
use super::function::{length, of_unit_circle, power, value_of};
use super::sines::sines_and_cosines;
use crate::constraint::{Jet, Real, Vec2, Vector};
use crate::interrupt::tick;
use crate::terms::{Function, Operator};
use std::array;
use std::f64::consts::TAU;

/// The place of a result in the list of operations.
pub type Register = u32;

/// One operation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Operation {
    /// A number.
    Constant(f64),
    /// A number that is given from outside, by its place among the inputs.
    Input(u32),
    /// The horizontal coordinate of a point, by its place in the list of points.
    X(u32),
    /// The vertical one.
    Y(u32),
    /// The negative.
    Negate(Register),
    /// An arithmetic operation on numbers.
    Binary(Operator, Register, Register),
    /// The length of the vector with these coordinates.
    Norm(Register, Register),
    /// A function of one number.
    Of(Function, Register),
    /// A function of two numbers.
    OfTwo(Function, Register, Register),
    /// The angle that differs from the first by whole turns and is nearest to the second.
    NearestTurn(Register, Register),
    /// The first, the lower end of a range up to the second; there is none in an empty range.
    LowerEnd(Register, Register),
}

/// Operations, each on the results of those before it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    operations: Vec<Operation>,
}

/// What an operation takes, in ticks.
const OPERATION: usize = 4;

/// Results that find room without being asked for.
const ROOM: usize = 32;

impl Program {
    /// Adds an operation on results that there are already; gives the place of its result.
    pub fn push(&mut self, operation: Operation) -> Register {
        self.operations.push(operation);
        self.operations.len() as Register - 1
    }

    /// Whether it has no operations.
    pub const fn is_empty(&self) -> bool {
        self.operations.is_empty()
    }

    /// The results that no operation works on. What is not a number makes all that follows from it none.
    pub fn ends(&self) -> Vec<Register> {
        let mut is_end = vec![true; self.operations.len()];
        for operation in &self.operations {
            match *operation {
                Operation::Constant(_)
                | Operation::Input(_)
                | Operation::X(_)
                | Operation::Y(_) => {}
                Operation::Negate(a) | Operation::Of(_, a) => is_end[a as usize] = false,
                Operation::Binary(_, a, b)
                | Operation::Norm(a, b)
                | Operation::OfTwo(_, a, b)
                | Operation::NearestTurn(a, b)
                | Operation::LowerEnd(a, b) => {
                    (is_end[a as usize], is_end[b as usize]) = (false, false);
                }
            }
        }
        (0..).zip(is_end).filter(|(_, is_end)| *is_end).map(|(register, _)| register).collect()
    }

    /// Evaluates it; `point` and `input` are by their places. `look` gets all results.
    pub fn evaluate<T: Real, R>(
        &self,
        point: impl Fn(usize) -> Vec2<T>,
        input: impl Fn(usize) -> T,
        look: impl FnOnce(&[T]) -> R,
    ) -> R {
        tick(OPERATION * self.operations.len());
        with_room(self.operations.len(), T::constant(0.0), |results| {
            for (k, operation) in self.operations.iter().enumerate() {
                let at = |register: Register| results[register as usize];
                results[k] = match *operation {
                    Operation::Constant(value) => T::constant(value),
                    Operation::Input(k) => input(k as usize),
                    Operation::X(p) => point(p as usize).x,
                    Operation::Y(p) => point(p as usize).y,
                    Operation::Negate(a) | Operation::Of(_, a) => operation.apply(at(a), at(a)),
                    Operation::Binary(_, a, b)
                    | Operation::Norm(a, b)
                    | Operation::OfTwo(_, a, b)
                    | Operation::NearestTurn(a, b)
                    | Operation::LowerEnd(a, b) => operation.apply(at(a), at(b)),
                };
            }
            look(results)
        })
    }

    /// Evaluates it for several poses and inputs side by side; `point` and `input` are by their places, and
    /// `results` are those of all operations. Each has the bits that it has by itself.
    #[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
    #[inline(always)]
    pub(crate) fn evaluate_each<const N: usize>(
        &self,
        point: impl Fn(usize) -> [[f64; N]; 2],
        input: impl Fn(usize) -> [f64; N],
        results: &mut Vec<[f64; N]>,
    ) {
        tick(OPERATION * self.operations.len());
        results.clear();
        // Sines and cosines of one angle are mostly wanted both.
        let mut turned: Option<(Register, [[f64; N]; 2])> = None;
        for operation in &self.operations {
            let at = |register: Register| results[register as usize];
            let found = match *operation {
                Operation::Constant(value) => [value; N],
                Operation::Input(k) => input(k as usize),
                Operation::X(p) => point(p as usize)[0],
                Operation::Y(p) => point(p as usize)[1],
                Operation::Of(function, a) => match of_unit_circle(function) {
                    Some(which) => {
                        let known = turned.filter(|(angle, _)| *angle == a);
                        let (_, both) = known.unwrap_or_else(|| (a, sines_and_cosines(&at(a))));
                        turned = Some((a, both));
                        both[which]
                    }
                    None => operation.apply_each(at(a), at(a)),
                },
                Operation::Negate(a) => operation.apply_each(at(a), at(a)),
                Operation::Binary(_, a, b)
                | Operation::Norm(a, b)
                | Operation::OfTwo(_, a, b)
                | Operation::NearestTurn(a, b)
                | Operation::LowerEnd(a, b) => operation.apply_each(at(a), at(b)),
            };
            results.push(found);
        }
    }

    /// Adds the derivatives of the sum of some results, each times its weight, to the slopes of
    /// the points; `results` are all of them at the pose.
    pub fn pull_back(&self, results: &[f64], weights: &[(Register, f64)], slopes: &mut [Slope]) {
        with_room(self.operations.len(), Adjoint::default(), |adjoint: &mut [Adjoint]| {
            for &(register, weight) in weights {
                adjoint[register as usize].add(Adjoint { value: weight, size: weight.abs() }, 1.0);
            }
            for (k, operation) in self.operations.iter().enumerate().rev() {
                let s = adjoint[k];
                if s.value == 0.0 {
                    continue;
                }
                let at = |register: Register| results[register as usize];
                match *operation {
                    Operation::Constant(_) | Operation::Input(_) => {}
                    Operation::X(p) => slopes[p as usize].add(Vector::new(s.value, 0.0), s.size),
                    Operation::Y(p) => slopes[p as usize].add(Vector::new(0.0, s.value), s.size),
                    Operation::Negate(a) | Operation::Of(_, a) => {
                        let moving = Jet::new(at(a), 1.0, 0.0);
                        adjoint[a as usize].add(s, operation.apply(moving, moving).d);
                    }
                    Operation::Binary(_, a, b)
                    | Operation::Norm(a, b)
                    | Operation::OfTwo(_, a, b)
                    | Operation::NearestTurn(a, b)
                    | Operation::LowerEnd(a, b) => {
                        let still = [at(a), at(b)].map(Jet::constant);
                        let moving = [at(a), at(b)].map(|v| Jet::new(v, 1.0, 0.0));
                        adjoint[a as usize].add(s, operation.apply(moving[0], still[1]).d);
                        adjoint[b as usize].add(s, operation.apply(still[0], moving[1]).d);
                    }
                }
            }
        });
    }

    /// Whether some results are sums of coordinates, each times a number that no point changes.
    pub fn is_affine(&self, wanted: impl IntoIterator<Item = Register>) -> bool {
        // Of each result: whether points change it, and whether it is such a sum.
        let mut known: Vec<(bool, bool)> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            let at = |register: Register| known[register as usize];
            let still = |registers: &[Register]| registers.iter().all(|&r| !at(r).0);
            let of = match *operation {
                Operation::Constant(_) | Operation::Input(_) => (false, true),
                Operation::X(_) | Operation::Y(_) => (true, true),
                Operation::Negate(a) => at(a),
                Operation::Binary(Operator::Add | Operator::Subtract, a, b) => {
                    (at(a).0 || at(b).0, at(a).1 && at(b).1)
                }
                Operation::Binary(Operator::Multiply, a, b) if still(&[a]) => at(b),
                Operation::Binary(Operator::Multiply | Operator::Divide, a, b) if still(&[b]) => {
                    at(a)
                }
                Operation::Binary(_, a, b)
                | Operation::Norm(a, b)
                | Operation::OfTwo(_, a, b)
                | Operation::NearestTurn(a, b)
                | Operation::LowerEnd(a, b) => (!still(&[a, b]), still(&[a, b])),
                Operation::Of(_, a) => (!still(&[a]), still(&[a])),
            };
            known.push(of);
        }
        wanted.into_iter().all(|register| known[register as usize].1)
    }

    /// The bits of all operations.
    pub fn content(&self, word: &mut impl FnMut(u64)) {
        for operation in &self.operations {
            let (tag, a, b) = match *operation {
                Operation::Constant(value) => {
                    add_all([value], word);
                    (0, 0, 0)
                }
                Operation::Input(k) => (1, k, 0),
                Operation::X(p) => (2, p, 0),
                Operation::Y(p) => (3, p, 0),
                Operation::Negate(a) => (4, a, 0),
                Operation::Norm(a, b) => (5, a, b),
                Operation::NearestTurn(a, b) => (6, a, b),
                Operation::LowerEnd(a, b) => (7, a, b),
                Operation::Binary(operator, a, b) => (0x100 + operator as u64, a, b),
                Operation::Of(function, a) => (0x200 + function as u64, a, 0),
                Operation::OfTwo(function, a, b) => (0x300 + function as u64, a, b),
            };
            word(tag);
            word(u64::from(a) << 32 | u64::from(b));
        }
    }
}

impl Operation {
    /// The result for operands; that of one operand gets it twice. Not a number where an operand is
    /// none, also where the result would not depend on it, and where it overflows: so it is where
    /// expressions are evaluated.
    fn apply<T: Real>(self, a: T, b: T) -> T {
        let none = || T::constant(f64::NAN);
        if a.value().is_nan() || b.value().is_nan() {
            return none();
        }
        let result = self.apply_to_numbers(a, b);
        if result.value().is_finite() { result } else { none() }
    }

    /// The same for several operands.
    #[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
    #[inline(always)]
    fn apply_each<const N: usize>(self, a: [f64; N], b: [f64; N]) -> [f64; N] {
        let finite = |of: f64| if of.is_finite() { of } else { f64::NAN };
        // What is not a number makes these none, and so does what is divided by 0.
        match self {
            Self::Negate(_) => array::from_fn(|l| finite(-a[l])),
            Self::Binary(Operator::Add, ..) => array::from_fn(|l| finite(a[l] + b[l])),
            Self::Binary(Operator::Subtract, ..) => array::from_fn(|l| finite(a[l] - b[l])),
            Self::Binary(Operator::Multiply, ..) => array::from_fn(|l| finite(a[l] * b[l])),
            Self::Binary(Operator::Divide, ..) => array::from_fn(|l| finite(a[l] / b[l])),
            Self::Norm(..) => array::from_fn(|l| finite(length(Vec2 { x: a[l], y: b[l] }))),
            _ => array::from_fn(|l| self.apply(a[l], b[l])),
        }
    }

    fn apply_to_numbers<T: Real>(self, a: T, b: T) -> T {
        let none = || T::constant(f64::NAN);
        match self {
            Self::Negate(_) => -a,
            Self::Binary(Operator::Add, ..) => a + b,
            Self::Binary(Operator::Subtract, ..) => a - b,
            Self::Binary(Operator::Multiply, ..) => a * b,
            Self::Binary(Operator::Divide, ..) if b.value() == 0.0 => none(),
            Self::Binary(Operator::Divide, ..) => a / b,
            Self::Binary(Operator::Power, ..) => power(a, b).unwrap_or_else(none),
            Self::NearestTurn(..) => {
                let turns = ((b.value() - a.value()) / TAU).round();
                a + T::constant(turns * TAU)
            }
            Self::LowerEnd(..) if a.value() > b.value() => none(),
            Self::Norm(..) => length(Vec2 { x: a, y: b }),
            Self::Of(function, _) => value_of(function, &[a]).unwrap_or_else(none),
            Self::OfTwo(function, ..) => value_of(function, &[a, b]).unwrap_or_else(none),
            Self::LowerEnd(..) | Self::Constant(_) | Self::Input(_) | Self::X(_) | Self::Y(_) => a,
        }
    }
}

/// What is less than this part of what it was worked out from is nothing but rounding. A part comes
/// through some ten operations, each with a rounding of its own; with 4 units of the last place the
/// law of cosines, which says nothing of a triangle, took a freedom away at every other pose.
pub(in crate::constraint) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The derivative by a result, and how large the parts were that it was added up from: results are
/// shared, so that they may cancel long before they come to a point.
#[derive(Debug, Clone, Copy, Default)]
struct Adjoint {
    value: f64,
    size: f64,
}

impl Adjoint {
    /// Adds what comes of another through a derivative.
    fn add(&mut self, other: Self, derivative: f64) {
        self.value += other.value * derivative;
        self.size += other.size * derivative.abs();
    }
}

/// The derivative by a point, and how large the parts were that it was added up from.
#[derive(Debug, Clone, Copy, Default)]
pub struct Slope {
    gradient: Vector,
    size: f64,
}

impl Slope {
    /// Adds a part, which was itself added up from parts of this size.
    pub fn add(&mut self, part: Vector, size: f64) {
        self.gradient += part;
        self.size += size;
    }

    /// The derivative; 0 where the parts cancel but for their rounding: dividing by that would
    /// throw the point across the plane.
    pub fn gradient(self) -> Vector {
        let is_rounding = self.gradient.norm() <= ROUNDING * self.size;
        if is_rounding { Vector::ZERO } else { self.gradient }
    }
}

/// Lends a list of this length to `work`; a short one costs nothing.
pub(crate) fn with_room<T: Copy, R>(n: usize, empty: T, work: impl FnOnce(&mut [T]) -> R) -> R {
    if n <= ROOM {
        let mut room = [empty; ROOM];
        work(&mut room[..n])
    } else {
        work(&mut vec![empty; n])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x^2 y + sin(x) over the coordinates of one point.
    fn program() -> (Program, Register) {
        let mut program = Program::default();
        let [x, y] = [Operation::X(0), Operation::Y(0)].map(|o| program.push(o));
        let square = program.push(Operation::Binary(Operator::Multiply, x, x));
        let product = program.push(Operation::Binary(Operator::Multiply, square, y));
        let sine = program.push(Operation::Of(Function::Sin, x));
        let sum = program.push(Operation::Binary(Operator::Add, product, sine));
        (program, sum)
    }

    #[test]
    fn values_and_derivatives_are_those_of_the_formula() {
        let (program, sum) = program();
        let (x, y) = (0.7_f64, 1.3);
        let still = Vec2 { x, y };
        program.evaluate(
            |_| still,
            |_| 0.0,
            |results| {
                assert!((results[sum as usize] - (x * x * y + libm::sin(x))).abs() < 1e-15);
                let mut slopes = [Slope::default()];
                program.pull_back(results, &[(sum, 2.0)], &mut slopes);
                let wanted = Vector::new(2.0 * (2.0 * x * y + libm::cos(x)), 2.0 * x * x);
                assert!((slopes[0].gradient() - wanted).norm() < 1e-14);
            },
        );
        let moving = Vec2 { x: Jet::new(x, 1.0, 0.0), y: Jet::constant(y) };
        let second = program.evaluate(|_| moving, |_| Jet::constant(0.0), |r| r[sum as usize].dd);
        assert!((second - (2.0 * y - libm::sin(x))).abs() < 1e-14);
    }
}
