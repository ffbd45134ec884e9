//! The functions of the expression language: how they are called and what they give.

use super::Shape;

macro_rules! functions {
    ($($variant:ident $usage:literal $arguments:literal -> $result:ident, $help:literal;)*) => {
        /// A function; one that takes different numbers of arguments is several.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Function {
            $(
                #[doc = concat!("`", $usage, "`")]
                $variant,
            )*
        }

        impl Function {
            /// Every function, in the order of the reference.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// How it is called.
            pub const fn usage(self) -> &'static str {
                match self { $(Self::$variant => $usage),* }
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
    Sin "sin(a)" "n" -> Number, "sine of an angle in radians";
    Cos "cos(a)" "n" -> Number, "cosine of an angle in radians";
    Tan "tan(a)" "n" -> Number, "tangent of an angle in radians";
    Asin "asin(a)" "n" -> Number, "angle in [-pi/2, pi/2] with this sine";
    Acos "acos(a)" "n" -> Number, "angle in [0, pi] with this cosine";
    Atan "atan(a)" "n" -> Number, "angle in (-pi/2, pi/2) with this tangent";
    Atan2 "atan2(y, x)" "nn" -> Number, "atan2(y, x): angle of the vector (x, y), in (-pi, pi]";
    Sqrt "sqrt(a)" "n" -> Number, "square root";
    Abs "abs(a)" "n" -> Number, "value without its sign";
    Sign "sign(a)" "n" -> Number, "-1, 0 or 1";
    Min "min(a, b, ...)" "n*" -> Number, "least of its arguments";
    Max "max(a, b, ...)" "n*" -> Number, "greatest of its arguments";
    Hypot "hypot(a, b)" "nn" -> Number, "sqrt(a^2 + b^2)";
    Floor "floor(a)" "n" -> Number, "greatest whole number not above";
    Ceil "ceil(a)" "n" -> Number, "least whole number not below";
    Round "round(a)" "n" -> Number, "nearest whole number, halves away from 0";
    Exp "exp(a)" "n" -> Number, "e to this power";
    Ln "ln(a)" "n" -> Number, "natural logarithm";
    Clamp "clamp(x, lo, hi)" "nnn" -> Number, "clamp(x, lo, hi): x, but no less than lo and no more than hi";
    Triangle "triangle(x)" "n" -> Number, "0 at even x, 1 at odd x, straight between: there and back";
    Mod "mod(a, b)" "nn" -> Number, "mod(a, b): a - b floor(a / b)";
    Norm "norm(v)" "v" -> Number, "length of a vector";
    Dot "dot(v, w)" "vv" -> Number, "scalar product";
    Cross "cross(v, w)" "vv" -> Number, "signed area spanned, positive counter-clockwise";
    Rotate "rotate(v, phi)" "vn" -> Vector, "rotate(v, phi): v turned by phi, counter-clockwise";
    Polar "polar(r, phi)" "nn" -> Vector, "polar(r, phi): vector of length r in direction phi";
    Midpoint "midpoint(P, Q)" "vv" -> Vector, "the point half way";
    Distance "distance(P, Q)" "vv" -> Number, "distance(P, Q)";
    DistanceToLine "distance(P, A, B)" "vvv" -> Number, "distance(P, A, B): from P to the line AB, positive on the left of A->B";
    Angle "angle(P, Q)" "vv" -> Number, "angle(P, Q): direction of PQ against the x axis, in (-pi, pi]";
    AngleBetween "angle(A, B, C, D)" "vvvv" -> Number, "angle(A, B, C, D): signed angle from AB to CD, in (-pi, pi]";
    Turn "turn(A, B)" "pp" -> Number, "turn(A, B): direction of AB against the x axis, whole turns counted";
    TurnBetween "turn(A, B, C, D)" "pppp" -> Number, "turn(A, B, C, D): signed angle from AB to CD, whole turns counted";
    Velocity "velocity(P)" "p" -> Vector, "velocity(P): rate of change of P, per time unit";
    Acceleration "acceleration(P)" "p" -> Vector, "acceleration(P): second derivative of P, per time unit squared";
    Omega "omega(A, B)" "pp" -> Number, "omega(A, B): angular velocity of the direction AB, radians per time unit";
    Alpha "alpha(A, B)" "pp" -> Number, "alpha(A, B): angular acceleration of the direction AB, radians per time unit squared";
    InstantCentre "ic(A, B, C, D)" "pppp" -> Vector, "ic(A, B, C, D): instant centre of the bodies that hold the lines AB and CD: where both move alike";
    Curvature "curvature(P)" "p" -> Number, "curvature(P): of the path of P, positive where it turns counter-clockwise";
}

impl Function {
    /// Its name.
    pub fn name(self) -> &'static str {
        let usage = self.usage();
        usage.split_once('(').map_or(usage, |(name, _)| name)
    }

    /// Whether it is an angle whose whole turns are counted.
    pub const fn counts_turns(self) -> bool {
        matches!(self, Self::Turn | Self::TurnBetween)
    }

    /// Whether it is had from velocities, which follow from the constraints.
    pub const fn is_rate(self) -> bool {
        matches!(
            self,
            Self::Velocity
                | Self::Acceleration
                | Self::Omega
                | Self::Alpha
                | Self::InstantCentre
                | Self::Curvature
        )
    }

    /// The functions with this name, one for each number of arguments.
    pub fn named(name: &str) -> impl Iterator<Item = Self> + '_ {
        let is_called =
            move |usage: &str| usage.strip_prefix(name).is_some_and(|rest| rest.starts_with('('));
        Self::ALL.iter().copied().filter(move |function| is_called(function.usage()))
    }

    /// Whether it can be called with this many arguments.
    pub fn takes(self, n_arguments: usize) -> bool {
        match self.arguments().strip_suffix('*') {
            Some(least) => n_arguments >= least.len(),
            None => n_arguments == self.arguments().len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_found_by_its_name_and_its_arguments() {
        for &function in Function::ALL {
            let n = function.arguments().len();
            let called: Vec<_> = Function::named(function.name()).filter(|f| f.takes(n)).collect();
            assert_eq!(called, [function]);
        }
        assert_eq!(Function::named("sine").next(), None);
    }

    #[test]
    fn counts_of_arguments_follow_the_usages() {
        for function in Function::ALL {
            let n = function.usage().matches(',').count() + 1;
            assert!(function.takes(n), "{}", function.usage());
            let takes_any = function.usage().contains("...");
            assert_eq!(function.takes(n + 1), takes_any, "{}", function.usage());
        }
    }
}
