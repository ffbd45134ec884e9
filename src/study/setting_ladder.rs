//! The ladder: every method with the settings that are tried.

use crate::solve::{Method, Settings};

/// A method with one setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rung {
    /// The method.
    pub method: Method,
    /// How far it goes.
    pub step: Step,
}

/// How far a method goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// No more iterations than this between two frames.
    Iterations(u32),
    /// Until the largest residual is below this.
    Tolerance(f64),
}

/// The numbers of iterations that are tried.
const ITERATIONS: [u32; 8] = [1, 2, 5, 10, 30, 100, 300, 1000];
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: std::ops::RangeInclusive<i32> = 2..=12;

/// Every method over its settings, the coarsest first.
pub fn ladder() -> Vec<Rung> {
    let rungs = |method: Method| -> Vec<Rung> {
        if method.goes_to_tolerance() {
            TOLERANCES.map(|k| Rung { method, step: Step::Tolerance(power_of_ten(k)) }).collect()
        } else {
            ITERATIONS.map(|n| Rung { method, step: Step::Iterations(n) }).to_vec()
        }
    };
    Method::ALL.into_iter().flat_map(rungs).collect()
}

/// The double nearest to 10^-k.
fn power_of_ten(k: i32) -> f64 {
    format!("1e-{k}").parse().expect("it is written as a number")
}

impl Rung {
    /// The settings of this rung, where it does not say what `base` says.
    pub fn settings(&self, base: &Settings) -> Settings {
        let mut settings = Settings { method: self.method, ..*base };
        match self.step {
            Step::Iterations(n) => settings.iterations = n,
            Step::Tolerance(tolerance) => settings.tolerance = tolerance,
        }
        settings
    }

    /// The setting alone: `30`, `1e-6`.
    pub fn setting(&self) -> String {
        match self.step {
            Step::Iterations(n) => n.to_string(),
            Step::Tolerance(tolerance) => format!("{tolerance:e}"),
        }
    }

    /// The statements that choose it.
    pub fn statements(&self) -> [String; 2] {
        let setting = match self.step {
            Step::Iterations(n) => format!("set iterations {n}"),
            Step::Tolerance(tolerance) => format!("set tolerance {tolerance:e}"),
        };
        [format!("set method {}", self.method.word()), setting]
    }
}

impl std::fmt::Display for Rung {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{} {}", self.method.word(), self.setting())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ladder_has_every_method_from_coarse_to_fine() {
        let ladder = ladder();
        assert_eq!(ladder.len(), 6 * 8 + 2 * 11);
        let text = |rung: &Rung| rung.to_string();
        assert_eq!(text(&ladder[0]), "auto 1e-2");
        assert_eq!(text(&ladder[10]), "auto 1e-12");
        assert_eq!(text(&ladder[11]), "relaxation 1");
        assert_eq!(ladder[3].statements(), ["set method auto", "set tolerance 1e-5"]);
    }
}
