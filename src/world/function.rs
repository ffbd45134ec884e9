//! The functions of the expression language: names, shapes of their arguments, values.

use crate::constraint::Real;

/// What an argument or a result is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Number,
    /// A vector.
    Vector,
}

impl Shape {
    /// The word for a message.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Vector => "vector",
        }
    }
}

macro_rules! functions {
    ($($variant:ident $name:literal $arguments:literal -> $result:ident, $help:literal;)*) => {
        /// A function; one that takes different numbers of arguments is several.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[allow(missing_docs)]
        pub enum Function { $($variant),* }

        impl Function {
            /// Every function.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name in the language.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }

            /// One letter an argument: `n` number, `v` vector, `p` the name of a point,
            /// `*` for any further numbers.
            pub const fn arguments(self) -> &'static str {
                match self { $(Self::$variant => $arguments),* }
            }

            /// What it gives.
            pub const fn result(self) -> Shape {
                match self { $(Self::$variant => Shape::$result),* }
            }

            /// One line of help.
            pub const fn help(self) -> &'static str {
                match self { $(Self::$variant => $help),* }
            }
        }
    };
}

functions! {
    Sin "sin" "n" -> Number, "sine of an angle in radians";
    Cos "cos" "n" -> Number, "cosine of an angle in radians";
    Tan "tan" "n" -> Number, "tangent of an angle in radians";
    Asin "asin" "n" -> Number, "angle in [-pi/2, pi/2] with this sine";
    Acos "acos" "n" -> Number, "angle in [0, pi] with this cosine";
    Atan "atan" "n" -> Number, "angle in (-pi/2, pi/2) with this tangent";
    Atan2 "atan2" "nn" -> Number, "atan2(y, x): angle of the vector (x, y), in (-pi, pi]";
    Sqrt "sqrt" "n" -> Number, "square root";
    Abs "abs" "n" -> Number, "value without its sign";
    Sign "sign" "n" -> Number, "-1, 0 or 1";
    Min "min" "n*" -> Number, "least of its arguments";
    Max "max" "n*" -> Number, "greatest of its arguments";
    Hypot "hypot" "nn" -> Number, "sqrt(a^2 + b^2)";
    Floor "floor" "n" -> Number, "greatest whole number not above";
    Ceil "ceil" "n" -> Number, "least whole number not below";
    Round "round" "n" -> Number, "nearest whole number, halves away from 0";
    Exp "exp" "n" -> Number, "e to this power";
    Ln "ln" "n" -> Number, "natural logarithm";
    Mod "mod" "nn" -> Number, "mod(a, b): a - b floor(a / b)";
    Norm "norm" "v" -> Number, "length of a vector";
    Dot "dot" "vv" -> Number, "scalar product";
    Cross "cross" "vv" -> Number, "signed area spanned, positive counter-clockwise";
    Rotate "rotate" "vn" -> Vector, "rotate(v, phi): v turned by phi, counter-clockwise";
    Polar "polar" "nn" -> Vector, "polar(r, phi): vector of length r in direction phi";
    Midpoint "midpoint" "vv" -> Vector, "the point half way";
    Distance "distance" "vv" -> Number, "distance(P, Q)";
    DistanceToLine "distance" "vvv" -> Number, "distance(P, A, B): from P to the line AB, positive on the left of A->B";
    Angle "angle" "vv" -> Number, "angle(P, Q): direction of PQ against the x axis, in (-pi, pi]";
    AngleBetween "angle" "vvvv" -> Number, "angle(A, B, C, D): signed angle from AB to CD, in (-pi, pi]";
    Velocity "velocity" "p" -> Vector, "velocity(P): rate of change of P, per time unit";
    Acceleration "acceleration" "p" -> Vector, "acceleration(P): second derivative of P, per time unit squared";
}

impl Function {
    /// The functions with this name, one for each number of arguments.
    pub fn named(name: &str) -> impl Iterator<Item = Self> + '_ {
        Self::ALL.iter().copied().filter(move |f| f.name() == name)
    }

    /// Whether it can be called with this many arguments.
    pub fn takes(self, n_arguments: usize) -> bool {
        match self.arguments().strip_suffix('*') {
            Some(least) => n_arguments >= least.len(),
            None => n_arguments == self.arguments().len(),
        }
    }

    /// The value for numbers; none outside the domain. Only for functions of numbers to a
    /// number.
    pub(super) fn of_numbers<T: Real>(self, a: &[T]) -> Option<T> {
        let x = a[0];
        let v = x.value();
        Some(match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => {
                let t = libm::tan(v);
                let d = 1.0 + t * t;
                x.chain(t, d, 2.0 * t * d)
            }
            Self::Asin => {
                let q = 1.0 - v * v;
                (q >= 0.0).then(|| x.chain(libm::asin(v), 1.0 / q.sqrt(), v / (q * q.sqrt())))?
            }
            Self::Acos => {
                let q = 1.0 - v * v;
                (q >= 0.0).then(|| x.chain(libm::acos(v), -1.0 / q.sqrt(), -v / (q * q.sqrt())))?
            }
            Self::Atan => {
                let q = 1.0 + v * v;
                x.chain(libm::atan(v), 1.0 / q, -2.0 * v / (q * q))
            }
            Self::Atan2 => x.atan2(a[1]),
            Self::Sqrt => (v >= 0.0).then(|| x.sqrt())?,
            Self::Abs => x.chain(v.abs(), sign(v), 0.0),
            Self::Sign => x.chain(sign(v), 0.0, 0.0),
            Self::Min => {
                a.iter().copied().reduce(|p, q| if q.value() < p.value() { q } else { p })?
            }
            Self::Max => {
                a.iter().copied().reduce(|p, q| if q.value() > p.value() { q } else { p })?
            }
            Self::Hypot => {
                // The value by the function that cannot overflow, the slopes by the formula.
                let r = libm::hypot(v, a[1].value());
                let root = (x * x + a[1] * a[1]).sqrt();
                if root.value() == r { root } else { root + T::constant(r - root.value()) }
            }
            Self::Floor => x.chain(v.floor(), 0.0, 0.0),
            Self::Ceil => x.chain(v.ceil(), 0.0, 0.0),
            Self::Round => x.chain(v.round(), 0.0, 0.0),
            Self::Exp => {
                let e = libm::exp(v);
                x.chain(e, e, e)
            }
            Self::Ln => (v > 0.0).then(|| x.chain(libm::log(v), 1.0 / v, -1.0 / (v * v)))?,
            Self::Mod => {
                let b = a[1].value();
                if b == 0.0 {
                    return None;
                }
                let q = (v / b).floor();
                let m = x - T::constant(q) * a[1];
                // The rounded quotient may leave the remainder a step outside [0, b).
                let wrapped = v.rem_euclid(b.abs());
                let wrapped = if b < 0.0 && wrapped != 0.0 { wrapped + b } else { wrapped };
                m + T::constant(wrapped - m.value())
            }
            _ => unreachable!("{} takes a vector or a point", self.name()),
        })
    }
}

fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}
