//! `fit`: the numbers of parameters with which a motion does something best.

use super::run::Limits;
use crate::constraint::Point;
use crate::diag::{Diagnostic, Span, format_count, format_number, format_rounded, format_seconds};
use crate::errors;
use crate::lang::ast::{Expr, FitRange, Goal, Text};
use crate::optimise::{Best, least_squares, minimum};
use crate::session::curve::{WRITES_ONE, read_curve};
use crate::session::execution::Execution;
use crate::session::finding::{Finding, Fit};
use crate::session::quotas::Quota;
use crate::session::undo::told::FileRead;
use crate::terms::Shape;
use crate::world::{Entity, Formula, NameText, ParameterId};

/// A parameter that is fitted.
struct Fitted {
    id: ParameterId,
    name: NameText,
    lo: f64,
    hi: f64,
    /// What it is now.
    now: f64,
}

impl Fitted {
    /// The number at a place from 0 to 1.
    fn number(&self, place: f64) -> f64 {
        place.mul_add(self.hi - self.lo, self.lo)
    }

    /// The place of what it is now, or the nearest.
    fn place(&self) -> f64 {
        ((self.now - self.lo) / (self.hi - self.lo)).clamp(0.0, 1.0)
    }
}

/// What came of a search.
struct Found {
    best: Option<Best>,
    n_runs: u64,
    /// What there was at first; none where that is not solved.
    before: Option<f64>,
    /// Whether there were different values.
    differs: bool,
}

/// The most parameters: a search among more takes longer than anyone waits.
const MOST: usize = 12;

impl Execution<'_> {
    pub(crate) fn fit(
        &mut self,
        ranges: &[FitRange],
        goal: &Goal,
        over: Option<&Expr>,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let fitted = self.fitted(ranges)?;
        let most = self.input.quotas.of(Quota::Frames) as f64;
        let n_frames = match over {
            Some(n) => Some(self.resolve().count(n, 0.0, most, "frames")?),
            None => None,
        };
        let begun = self.host.seconds();
        let (found, what) = match goal {
            Goal::Minimise(value) => (self.best_of(&fitted, value, 1.0, n_frames)?, value.span),
            Goal::Maximise(value) => (self.best_of(&fitted, value, -1.0, n_frames)?, value.span),
            Goal::Path(file) => (self.nearest_path(&fitted, file, n_frames)?, file.span),
        };
        let Some(best) = found.best.as_ref().filter(|_| found.differs) else {
            return Err(no_minimum(&found, span, what));
        };
        self.take_best(&fitted, best)?;
        let seconds = begun.and_then(|begun| Some(self.host.seconds()? - begun));
        self.tell_best(&fitted, goal, &found, best, seconds);
        Ok(())
    }

    fn fitted(&mut self, ranges: &[FitRange]) -> Result<Vec<Fitted>, Diagnostic> {
        if let Some(range) = ranges.get(MOST) {
            return Err(Diagnostic::error(errors::TOO_MUCH, "too many numbers to look for")
                .at(range.name.span, format!("no more than {MOST}")));
        }
        let mut all: Vec<Fitted> = Vec::new();
        for FitRange { name, range } in ranges {
            let entity = self.resolve().entity(name).map_err(|problem| {
                problem.or_help(format!("`let {name} = 1` declares it; then something follows it"))
            });
            let Entity::Parameter(id) = entity? else {
                return Err(Diagnostic::error(errors::WRONG_SORT, "`fit` looks for parameters")
                    .at(name.span, "expected the name of a parameter")
                    .help("`let a = 3`, and `length A B = a` follows it"));
            };
            if all.iter().any(|other| other.id == id) {
                return Err(Diagnostic::error(errors::NAME_TAKEN, "this one is fitted already")
                    .at(name.span, "said twice"));
            }
            let parameter = self.state.world.parameter(id).expect("it is named").clone();
            let is_number =
                parameter.formula.shape() == Shape::Number && parameter.depends.is_constant();
            if !is_number {
                let name_text = &parameter.name;
                return Err(Diagnostic::error(
                    errors::WRONG_SORT,
                    format!("`{name_text}` is not a number by itself"),
                )
                .at(name.span, "it follows something else")
                .help("fit what it follows, or give it a number first: `let a = 3`"));
            }
            let (lo, hi) = (self.resolve().number(&range.from)?, self.resolve().number(&range.to)?);
            if lo >= hi {
                let place = range.from.span.to(range.to.span);
                let problem = Diagnostic::error(errors::OUT_OF_RANGE, "this range has no inside");
                return Err(if lo > hi {
                    problem
                        .at(place, "expected the least number first")
                        .help(format!("`{name} in {}..{}`", range.to, range.from))
                } else {
                    let name = &parameter.name;
                    problem
                        .at(place, "its ends are one number")
                        .help(format!("`let {name} = {}` gives it that number", range.from))
                });
            }
            let now = parameter.value.map_or(lo, crate::world::Value::number);
            all.push(Fitted { id, name: parameter.name, lo, hi, now });
        }
        Ok(all)
    }

    /// The least value, or with the other sign the greatest.
    fn best_of(
        &mut self,
        fitted: &[Fitted],
        value: &Expr,
        sign: f64,
        n_frames: Option<u64>,
    ) -> Result<Found, Diagnostic> {
        let formula: Formula = self.resolve().live(value)?.into_formula(value.span);
        if formula.shape() != Shape::Number {
            return Err(Diagnostic::error(errors::MIXED_SORTS, "expected a number")
                .at(value.span, "this is a vector")
                .help(format!("its length, `norm({value})`, or a part of it, `.x`")));
        }
        let trial = self.trial(n_frames.unwrap_or(0), None, value.span)?;
        let mut run = |numbers: &[_]| self.run_trial(&trial, numbers)?.value(&formula);
        let mut values = Values::default();
        let before = run(&now(fitted));
        let mut ask = |at: &[f64]| {
            let value = sign * run(&numbers(fitted, at))?;
            values.note(value);
            Some(value)
        };
        let first: Vec<f64> = fitted.iter().map(Fitted::place).collect();
        let best = minimum(&first, &mut ask);
        let best = best.map(|best| Best { value: sign * best.value, ..best });
        Ok(values.found(best, before))
    }

    /// The numbers with which a point comes nearest to a path.
    fn nearest_path(
        &mut self,
        fitted: &[Fitted],
        file: &Text,
        n_frames: Option<u64>,
    ) -> Result<Found, Diagnostic> {
        let FileRead { text, .. } =
            self.read_back(file).map_err(|problem| problem.help(WRITES_ONE))?;
        let curve = read_curve(&self.state.world, &text, file.span)?;
        let n_needed = curve.places.iter().map(|(frame, _)| *frame).max().unwrap_or(0);
        if n_frames.is_some_and(|n| n < n_needed) {
            return Err(Diagnostic::error(errors::NOT_A_PATH, "the path is longer than the run")
                .at(file.span, format!("its last place is that of frame {n_needed}"))
                .help(format!("`over {n_needed}`, or none, follows all of it")));
        }
        let trial = self.trial(n_needed, Some(curve.point), file.span)?;
        let off = |places: &[Point]| -> Option<Vec<f64>> {
            let mut off = Vec::with_capacity(2 * curve.places.len());
            for (frame, wanted) in &curve.places {
                let v = *places.get(*frame as usize)? - *wanted;
                off.extend([v.x, v.y]);
            }
            Some(off)
        };
        let n_places = curve.places.len().max(1) as f64;
        let rms = |square: f64| (square / n_places).sqrt();
        let mut run = |numbers: &[_]| off(&self.run_trial(&trial, numbers)?.path());
        let before = run(&now(fitted)).map(|off| rms(off.iter().map(|it| it * it).sum()));
        let mut values = Values::default();
        let mut ask = |at: &[f64]| {
            let off = run(&numbers(fitted, at))?;
            values.note(off.iter().map(|it| it * it).sum());
            Some(off)
        };
        let first: Vec<f64> = fitted.iter().map(Fitted::place).collect();
        let best = least_squares(&first, &mut ask);
        let best = best.map(|best| Best { value: rms(best.value), ..best });
        Ok(values.found(best, before))
    }

    /// Gives the parameters the best numbers and solves the pose, as each trial did.
    fn take_best(&mut self, fitted: &[Fitted], best: &Best) -> Result<(), Diagnostic> {
        for (it, (id, number)) in fitted.iter().zip(numbers(fitted, &best.at)) {
            self.set_parameter(id, it.name.clone(), Formula::constant(number))?;
        }
        self.begin_motion();
        self.settle(&Limits::default())?;
        Ok(())
    }

    fn tell_best(
        &mut self,
        fitted: &[Fitted],
        goal: &Goal,
        found: &Found,
        best: &Best,
        seconds: Option<f64>,
    ) {
        let (goal, what) = match goal {
            Goal::Minimise(value) => ("minimise", value.to_string()),
            Goal::Maximise(value) => ("maximise", value.to_string()),
            Goal::Path(_) => ("to", "root mean square distance".to_owned()),
        };
        let numbers = numbers(fitted, &best.at);
        let numbers = fitted.iter().zip(&numbers).map(|(it, (_, n))| (it.name.to_string(), *n));
        let ends = fitted.iter().zip(&best.at).filter(|(_, at)| **at <= 0.0 || **at >= 1.0);
        let fit = Fit {
            parameters: numbers.collect(),
            at_ends: ends.clone().map(|(it, _)| it.name.to_string()).collect(),
            goal,
            what,
            value: best.value,
            before: found.before,
            n_runs: found.n_runs,
            seconds,
        };
        if self.host.takes_findings() {
            self.host.find_out(&Finding::Fitted(&fit));
        } else {
            fit.lines().into_iter().for_each(|line| self.note(line));
        }
        for (it, at) in ends {
            let end = format_number(it.number(*at));
            let text = format!("`{}` is at the end of its range, {end}", it.name);
            self.warn(&Diagnostic::warning(text).help("a wider range may hold something better"));
        }
    }
}

impl Fit {
    /// It in words: the numbers, and how good they are.
    fn lines(&self) -> [String; 2] {
        let numbers = self.parameters.iter();
        let numbers: Vec<String> =
            numbers.map(|(name, number)| format!("{name} = {}", format_number(*number))).collect();
        let before = self.before.map_or_else(
            || "not solved before".to_owned(),
            |before| format!("{} before", format_rounded(before)),
        );
        let time =
            self.seconds.map_or_else(String::new, |it| format!(" in {}", format_seconds(it)));
        let (what, value) = (&self.what, format_rounded(self.value));
        let n_runs = format_count(self.n_runs as f64);
        [numbers.join(", "), format!("{what} = {value}, {before}; {n_runs} runs{time}")]
    }
}

/// The numbers that the parameters have now.
fn now(fitted: &[Fitted]) -> Vec<(ParameterId, f64)> {
    fitted.iter().map(|it| (it.id, it.now)).collect()
}

/// The numbers that places from 0 to 1 stand for.
fn numbers(fitted: &[Fitted], at: &[f64]) -> Vec<(ParameterId, f64)> {
    fitted.iter().zip(at).map(|(it, at)| (it.id, it.number(*at))).collect()
}

/// The values that a search met.
#[derive(Default)]
struct Values {
    n: u64,
    ends: Option<[f64; 2]>,
}

impl Values {
    fn note(&mut self, value: f64) {
        self.n += 1;
        let [lo, hi] = self.ends.unwrap_or([value; 2]);
        self.ends = Some([lo.min(value), hi.max(value)]);
    }

    fn found(&self, best: Option<Best>, before: Option<f64>) -> Found {
        let differs = self.ends.is_some_and(|[lo, hi]| lo < hi);
        Found { best, n_runs: self.n, before, differs }
    }
}

/// Why there is no best.
fn no_minimum(found: &Found, span: Span, what: Span) -> Diagnostic {
    if found.best.is_none() {
        return Diagnostic::error(errors::NO_MINIMUM, "none of these numbers gives a motion")
            .at(span, "each was unsolved in some frame, or has no value")
            .help(
                "narrow the ranges to what can be assembled: `limits NAME` says how far it goes",
            );
    }
    Diagnostic::error(errors::NO_MINIMUM, "this is the same for all numbers in these ranges")
        .at(what, "nothing to choose by")
        .help("name what follows the parameters: `measure d = ...`, then `... to minimise d.span`")
}
