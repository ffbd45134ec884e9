//! The functions that an expression can call: their names and how many arguments they take.

/// A function of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Function {
    /// `sin(a)`
    Sin,
    /// `cos(a)`
    Cos,
    /// `tan(a)`
    Tan,
    /// `asin(a)`
    Asin,
    /// `acos(a)`
    Acos,
    /// `atan(a)`
    Atan,
    /// `atan2(y, x)`
    Atan2,
    /// `sqrt(a)`
    Sqrt,
    /// `abs(a)`
    Abs,
    /// `sign(a)`
    Sign,
    /// `min(a, b, ...)`
    Min,
    /// `max(a, b, ...)`
    Max,
    /// `hypot(a, b)`
    Hypot,
    /// `floor(a)`
    Floor,
    /// `ceil(a)`
    Ceil,
    /// `round(a)`
    Round,
    /// `exp(a)`
    Exp,
    /// `ln(a)`
    Ln,
    /// `mod(a, b)`
    Mod,
    /// `norm(v)`
    Norm,
    /// `dot(v, w)`
    Dot,
    /// `cross(v, w)`
    Cross,
    /// `rotate(v, phi)`
    Rotate,
    /// `polar(r, phi)`
    Polar,
    /// `midpoint(P, Q)`
    Midpoint,
    /// `distance(P, Q)`, `distance(P, A, B)`
    Distance,
    /// `angle(P, Q)`, `angle(A, B, C, D)`
    Angle,
    /// `velocity(P)`
    Velocity,
    /// `acceleration(P)`
    Acceleration,
}

use Function as F;

impl Function {
    /// Every function, in the order of the reference.
    pub const ALL: [Self; 29] = [
        F::Sin,
        F::Cos,
        F::Tan,
        F::Asin,
        F::Acos,
        F::Atan,
        F::Atan2,
        F::Sqrt,
        F::Abs,
        F::Sign,
        F::Min,
        F::Max,
        F::Hypot,
        F::Floor,
        F::Ceil,
        F::Round,
        F::Exp,
        F::Ln,
        F::Mod,
        F::Norm,
        F::Dot,
        F::Cross,
        F::Rotate,
        F::Polar,
        F::Midpoint,
        F::Distance,
        F::Angle,
        F::Velocity,
        F::Acceleration,
    ];

    /// The function called `word`.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == word)
    }

    /// How it is written.
    pub fn name(self) -> &'static str {
        let usage = self.usages()[0];
        &usage[..usage.find('(').unwrap_or(usage.len())]
    }

    /// The ways to call it.
    pub const fn usages(self) -> &'static [&'static str] {
        match self {
            F::Sin => &["sin(a)"],
            F::Cos => &["cos(a)"],
            F::Tan => &["tan(a)"],
            F::Asin => &["asin(a)"],
            F::Acos => &["acos(a)"],
            F::Atan => &["atan(a)"],
            F::Atan2 => &["atan2(y, x)"],
            F::Sqrt => &["sqrt(a)"],
            F::Abs => &["abs(a)"],
            F::Sign => &["sign(a)"],
            F::Min => &["min(a, b, ...)"],
            F::Max => &["max(a, b, ...)"],
            F::Hypot => &["hypot(a, b)"],
            F::Floor => &["floor(a)"],
            F::Ceil => &["ceil(a)"],
            F::Round => &["round(a)"],
            F::Exp => &["exp(a)"],
            F::Ln => &["ln(a)"],
            F::Mod => &["mod(a, b)"],
            F::Norm => &["norm(v)"],
            F::Dot => &["dot(v, w)"],
            F::Cross => &["cross(v, w)"],
            F::Rotate => &["rotate(v, phi)"],
            F::Polar => &["polar(r, phi)"],
            F::Midpoint => &["midpoint(P, Q)"],
            F::Distance => &["distance(P, Q)", "distance(P, A, B)"],
            F::Angle => &["angle(P, Q)", "angle(A, B, C, D)"],
            F::Velocity => &["velocity(P)"],
            F::Acceleration => &["acceleration(P)"],
        }
    }

    /// Can it be called with `n` arguments?
    pub fn takes(self, n: usize) -> bool {
        match self {
            F::Min | F::Max => n >= 1,
            _ => self.usages().iter().any(|usage| usage.matches(',').count() + 1 == n),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_found_by_its_name() {
        for function in Function::ALL {
            assert_eq!(Function::named(function.name()), Some(function));
        }
        assert_eq!(Function::named("sine"), None);
    }

    #[test]
    fn counts_of_arguments_follow_the_usages() {
        let check = |function: Function, n_wanted: &[usize]| {
            let n_taken: Vec<usize> = (0..6).filter(|&n| function.takes(n)).collect();
            assert_eq!(n_taken, n_wanted, "for {}", function.name());
        };
        check(Function::Sin, &[1]);
        check(Function::Atan2, &[2]);
        check(Function::Distance, &[2, 3]);
        check(Function::Angle, &[2, 4]);
        check(Function::Min, &[1, 2, 3, 4, 5]);
    }
}
