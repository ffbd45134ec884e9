//! A constraint with values that are measured on the pose.
//!
//! `length A B = 2 * distance(C, D)` is one equation between four points. A constraint of any kind
//! stands behind it; what its values are at a pose is told by a [`Program`], and its rows go on
//! into the points that the program looks at.

use std::sync::Arc;

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::program::{Program, ROUNDING, Register, Slope, with_room};
use crate::constraint::parts::two_rows::{Pair, Shortest};
use crate::constraint::{
    Constraint, ConstraintKind, Field, Jet, Point, PointIdx, Real, Row, Stateful, Traits, Vec2,
    Vector,
};

/// No kind has more rows than this, if it has values at all.
const MOST_ROWS: usize = 2;
/// No kind has more values than this that can be measured.
const MOST_VALUES: usize = 4;

/// A constraint, some of whose values are measured on the pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The constraint; what is measured is 0 there, or an open end.
    base: Constraint,
    /// The points of the constraint in the order of its statement, then the others that the
    /// program looks at.
    points: Box<[PointIdx]>,
    program: Arc<Program>,
    /// Which values of the constraint are measured, and which results of the program they are.
    values: Box<[(Field, Register)]>,
    /// What the program is given from outside.
    inputs: Box<[f64]>,
    /// Whether its rows are linear in all its points.
    is_affine: bool,
}

impl Measured {
    /// A constraint with values that a program measures on `points`: those of the constraint and
    /// then others, each of them once. A point of the constraint that occurs twice is known to the
    /// program by its first place.
    ///
    /// # Panics
    /// For more values than a kind has.
    pub fn new(
        base: Constraint,
        points: Vec<PointIdx>,
        program: Program,
        values: Vec<(Field, Register)>,
        inputs: Vec<f64>,
    ) -> Self {
        assert!(values.len() <= MOST_VALUES && base.n_rows() <= MOST_ROWS);
        debug_assert!(points.starts_with(base.points()));
        let mut base = base;
        let register = |wanted| values.iter().find(|(f, _)| *f == wanted).map(|(_, r)| *r);
        let is_one = register(Field::Lo) == register(Field::Hi);
        for &(field, _) in &values {
            // What follows from the pose is no part of what it is.
            let value = match field {
                Field::Lo if !is_one => f64::NEG_INFINITY,
                Field::Hi if !is_one => f64::INFINITY,
                _ => 0.0,
            };
            base.set(field, value);
        }
        // A part or an angle enters a row times something else, other values as they are.
        let is_factor = |f: &Field| matches!(f, Field::Ratio | Field::Radius | Field::Phase);
        let has_factor = values.iter().any(|(field, _)| is_factor(field));
        let is_affine = base.traits().is_linear
            && !has_factor
            && program.is_affine(values.iter().map(|(_, register)| *register));
        let (points, values, inputs) = (points.into(), values.into(), inputs.into());
        Self { base, points, program: Arc::new(program), values, inputs, is_affine }
    }

    /// The constraint behind it.
    pub const fn base(&self) -> &Constraint {
        &self.base
    }

    /// The same, to be carried on.
    pub(super) const fn base_mut(&mut self) -> &mut Constraint {
        &mut self.base
    }

    /// How many numbers its program is given from outside.
    pub fn n_inputs(&self) -> usize {
        self.inputs.len()
    }

    /// The constraint behind it with its values as they are at a pose.
    pub fn at(&self, x: &[Point]) -> Constraint {
        self.look(x, |results| self.base_with(results))
    }

    /// Puts the points of the constraint behind it where its own are.
    pub(super) fn share_points(&mut self) {
        let n = self.base.points().len();
        self.base.set_points(&self.points[..n]);
    }

    /// Whether a value is measured on the pose.
    pub fn is_measured(&self, field: Field) -> bool {
        self.values.iter().any(|(measured, _)| *measured == field)
    }

    /// Evaluates the program at a pose.
    fn look<R>(&self, x: &[Point], look: impl FnOnce(&[f64]) -> R) -> R {
        let point = |k: usize| {
            let at = x[self.points[k] as usize];
            Vec2 { x: at.x, y: at.y }
        };
        self.program.evaluate(point, |k| self.inputs[k], look)
    }

    fn base_with(&self, results: &[f64]) -> Constraint {
        let mut base = self.base.clone();
        for &(field, register) in &self.values {
            base.set(field, results[register as usize]);
        }
        base
    }

    /// Whether all that is measured has a value.
    fn has_values(&self, results: &[f64]) -> bool {
        self.values.iter().all(|(_, register)| results[*register as usize].is_finite())
    }

    /// The derivative of each row of the constraint by each measured value.
    fn by_values(&self, base: &Constraint, x: &[Point]) -> [[f64; MOST_VALUES]; MOST_ROWS] {
        let mut all = [[0.0; MOST_VALUES]; MOST_ROWS];
        let still = |p: PointIdx| Vec2::constant(x[p as usize].to_vector());
        for (k, &(moving, _)) in self.values.iter().enumerate() {
            // Time stands still: no motor turns.
            let field = |field: Field, value: f64| match field {
                Field::Speed => Jet::constant(0.0),
                _ if field == moving => Jet::new(value, 1.0, 0.0),
                _ => Jet::constant(value),
            };
            let mut row = 0;
            equations_of(base, &still, &field, &mut |f: Jet| {
                all[row][k] = f.d;
                row += 1;
            });
        }
        all
    }

    /// The shortest displacement that meets two rows, linearised. The rows of a vector that is
    /// measured are not at right angles.
    fn shortest(&self, x: &[Point], w: &[f64]) -> Shortest {
        // One between frozen points is measured as if they all could move.
        let is_free = self.points.iter().any(|&p| w[p as usize] > 0.0);
        let weight = |p: PointIdx| if is_free { w[p as usize] } else { 1.0 };
        let mut pair = Pair::default();
        let [of_first, of_both, of_second] = &mut pair.products;
        with_room(self.points.len(), Vector::ZERO, |first| {
            let mut n = 0;
            self.jacobian(x, &mut |row| {
                pair.values[n] = row.f;
                for (k, (p, g)) in row.terms().enumerate() {
                    if n == 0 {
                        first[k] = g;
                        *of_first += weight(p) * g.norm_squared();
                    } else {
                        *of_both += weight(p) * g.dot(first[k]);
                        *of_second += weight(p) * g.norm_squared();
                    }
                }
                n += 1;
            });
        });
        pair.shortest()
    }

    /// The places of its points, each once.
    fn places(&self) -> impl Iterator<Item = (usize, PointIdx)> + '_ {
        // Only the constraint behind it may say a point twice.
        let stated = self.base.points();
        let is_first = move |k: usize, p: PointIdx| k >= stated.len() || !stated[..k].contains(&p);
        let places = self.points.iter().copied().enumerate();
        places.filter(move |&(k, p)| is_first(k, p))
    }

    /// Gives a row between all its points.
    fn give(&self, like: Row, slopes: &[Slope], row: &mut impl FnMut(Row)) {
        with_room(self.points.len(), (0, Vector::ZERO), |terms| {
            let mut n = 0;
            for (k, p) in self.places() {
                terms[n] = (p, slopes[k].gradient());
                n += 1;
            }
            let of_terms = Row::of_terms(like.f, &terms[..n]);
            row(Row { is_active: like.is_active, ..of_terms });
        });
    }

    /// Gives rows that are as far from being met as can be, and say of no point what to do.
    fn give_none(&self, row: &mut impl FnMut(Row)) {
        with_room(self.points.len(), Slope::default(), |slopes| {
            for _ in 0..self.base.n_rows() {
                self.give(Row::new(f64::INFINITY), slopes, row);
            }
        });
    }
}

impl ConstraintKind for Measured {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        self.base.n_rows()
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.look(x, |results| {
            if self.has_values(results) {
                self.base_with(results).residual(x)
            } else {
                f64::INFINITY
            }
        })
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let shortest = (self.n_rows() == MOST_ROWS).then(|| self.shortest(x, w));
        let mut part = 0;
        self.jacobian(x, &mut |row| {
            match &shortest {
                _ if !row.f.is_finite() => {}
                Some(shortest) => {
                    let tau = -shortest.multipliers[part];
                    for (p, g) in row.terms().filter(|&(p, _)| w[p as usize] > 0.0) {
                        move_by(p, g * (w[p as usize] * tau));
                    }
                }
                None => row.correct(w, move_by),
            }
            part += 1;
        });
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        self.look(x, |results| {
            if !self.has_values(results) {
                return self.give_none(row);
            }
            let base = self.base_with(results);
            let by_values = self.by_values(&base, x);
            let mut part = 0;
            rows_of(&base, x, &mut |of_base| {
                with_room(self.points.len(), Slope::default(), |slopes| {
                    if of_base.is_active {
                        for (p, g) in of_base.terms() {
                            let place = self.points.iter().position(|&q| q == p);
                            slopes[place.expect("it holds it")].add(g, g.norm());
                        }
                        let values = self.values.iter().zip(&by_values[part]);
                        let mut weights = [(0, 0.0); MOST_VALUES];
                        for (to, ((_, register), &by_value)) in weights.iter_mut().zip(values) {
                            *to = (*register, by_value);
                        }
                        let weights = &weights[..self.values.len()];
                        self.program.pull_back(results, weights, slopes);
                    }
                    // An equation that nothing changes holds or does not, but for its rounding.
                    let is_still = slopes.iter().all(|slope| slope.gradient() == Vector::ZERO);
                    let rounding = |of: f64| ROUNDING * of.abs();
                    let holds = || results.iter().any(|&r| of_base.f.abs() <= rounding(r));
                    let f = if is_still && holds() { 0.0 } else { of_base.f };
                    self.give(Row { f, ..of_base }, slopes, row);
                });
                part += 1;
            });
        });
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let point = |k: usize| x(self.points[k]);
        let input = |k: usize| field(Field::Input(k as u16), self.inputs[k]);
        self.program.evaluate(point, input, |results: &[T]| {
            let values =
                || self.values.iter().map(|&(f, register)| (f, results[register as usize]));
            if !values().all(|(_, value)| value.value().is_finite()) {
                return (0..self.n_rows()).for_each(|_| equation(T::constant(f64::INFINITY)));
            }
            let mut base = self.base.clone();
            for (field, value) in values() {
                base.set(field, value.value());
            }
            let of_base = |of: Field, value: f64| {
                let measured = values().find(|(measured, _)| *measured == of);
                measured.map_or_else(|| field(of, value), |(_, value)| value)
            };
            equations_of(&base, x, &of_base, equation);
        });
    }

    fn get(&self, field: Field) -> Option<f64> {
        match field {
            Field::Input(k) => self.inputs.get(k as usize).copied(),
            _ => self.base.get(field),
        }
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        match field {
            Field::Input(k) => match self.inputs.get_mut(k as usize) {
                Some(input) => {
                    *input = value;
                    true
                }
                None => false,
            },
            _ => !self.is_measured(field) && self.base.set(field, value),
        }
    }

    fn nominal_length(&self) -> f64 {
        self.base.nominal_length()
    }

    fn traits(&self) -> Traits {
        let traits = self.base.traits();
        let flaw = traits.flaw.filter(|flaw| !self.is_measured(flaw.field()));
        Traits { n_firm_rows: 0, is_linear: self.is_affine, flaw, ..traits }
    }

    fn violation(&self, x: &[Point], w: &[f64]) -> f64 {
        let mut norm = 0.0;
        self.jacobian(x, &mut |row| norm = Vector::new(norm, row.distance(w)).norm());
        let is_vector = self.n_rows() == MOST_ROWS && norm.is_finite();
        if is_vector { self.shortest(x, w).length } else { norm }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { base, points: _, program, values, inputs, is_affine: _ } = self;
        base.content(word);
        program.content(word);
        for &(field, register) in values {
            let place = Field::ALL.iter().position(|f| *f == field);
            word(place.map_or(u64::MAX, |place| place as u64) << 32 | u64::from(register));
        }
        add_all(inputs.iter().copied(), word);
    }
}

impl Stateful for Measured {
    fn state(&self) -> Option<Vec<f64>> {
        self.base.state()
    }

    fn set_state(&mut self, state: &[f64]) {
        self.base.set_state(state);
    }

    fn captured(&self) -> Vec<f64> {
        self.base.captured()
    }

    fn set_captured(&mut self, captured: &[f64]) {
        self.base.set_captured(captured);
    }

    fn pick_up(&mut self, x: &[Point]) {
        self.base.pick_up(x);
    }

    fn advance(&mut self, dt: f64) -> bool {
        self.base.advance(dt)
    }

    fn accept(&mut self, x: &[Point]) {
        let mut here = self.at(x);
        here.accept(x);
        if let Some(state) = here.state() {
            self.base.set_state(&state);
        }
    }
}

/// The rows of a constraint that may be of any kind. Its type does not depend on who asks: a
/// constraint stands behind another one.
fn rows_of(base: &Constraint, x: &[Point], mut row: &mut dyn FnMut(Row)) {
    base.jacobian(x, &mut row);
}

/// The same for its equations.
fn equations_of<T: Real>(
    base: &Constraint,
    x: &dyn Fn(PointIdx) -> Vec2<T>,
    field: &dyn Fn(Field, f64) -> T,
    mut equation: &mut dyn FnMut(T),
) {
    base.equations(&x, &field, &mut equation);
}
