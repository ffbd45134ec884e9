//! Constraints, parameters and measures as the user made them, kept apart from what the solver runs on.

use super::{Depends, Formula, NameText, Tally, Value};
use crate::constraint::{Bounds, Constraint, ConstraintKind, Field, Flaw, LARGEST, Traits};
use crate::diag::{Diagnostic, format_number};
use crate::errors;
use crate::terms::Unit;

/// A constraint with its name and what drives its values.
#[derive(Debug, Clone)]
pub struct Record {
    /// Its name.
    pub name: NameText,
    /// The relation, over handles of points, with its values as of now.
    pub constraint: Constraint,
    /// Whether it is in the active list.
    pub is_on: bool,
    /// What few constraints have, out of the way of all the others.
    extra: Option<Box<Extra>>,
}

/// The live expressions behind values of a constraint.
pub type Drivers = Vec<(Field, Formula)>;

#[derive(Debug, Clone, Default)]
struct Extra {
    drivers: Drivers,
    /// Where values are measured on the pose: the expressions behind the others, and behind what
    /// those that are measured are given from outside.
    live: Option<Drivers>,
    rho: Option<f64>,
    /// The units that its values were typed in, where they are plain numbers.
    units: Vec<(Field, Unit)>,
}

impl Record {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let live = self.extra.as_ref().and_then(|extra| extra.live.as_ref());
        let formulas = self.drivers().iter().chain(live.into_iter().flatten());
        size_of::<Self>() + formulas.map(|(_, formula)| formula.n_bytes()).sum::<usize>()
    }

    /// A constraint that is switched on, driven by these expressions.
    pub fn new(name: NameText, constraint: Constraint, mut drivers: Drivers) -> Self {
        in_order(&mut drivers);
        let extra = (!drivers.is_empty()).then(|| Box::new(Extra { drivers, ..Extra::default() }));
        Self { name, constraint, is_on: true, extra }
    }

    /// The live expressions behind some of its values, in the order of the values.
    pub fn drivers(&self) -> &[(Field, Formula)] {
        self.extra.as_ref().map_or(&[], |extra| &extra.drivers)
    }

    /// The expressions that are evaluated before the constraints are solved. What is measured on the
    /// pose is none of them: it is solved with the pose.
    pub fn live(&self) -> &[(Field, Formula)] {
        let extra = self.extra.as_ref();
        extra.map_or(&[], |extra| extra.live.as_ref().unwrap_or(&extra.drivers))
    }

    /// Puts a constraint in the place of the one there is, with the expressions that are evaluated
    /// for it where those are not all that its statement gives.
    pub(super) fn bind(&mut self, constraint: Constraint, live: Option<Drivers>) {
        self.constraint = constraint;
        if let Some(extra) = &mut self.extra {
            extra.live = live;
        }
    }

    /// Puts other expressions in the place of those behind these values.
    pub fn replace_drivers(&mut self, fields: &[Field], new: Drivers) {
        if self.extra.is_some() || !new.is_empty() {
            let drivers = &mut self.extra.get_or_insert_default().drivers;
            drivers.retain(|(field, _)| !fields.contains(field));
            drivers.extend(new);
            in_order(drivers);
        }
    }

    /// The paper's rho of this constraint alone.
    pub fn rho(&self) -> Option<f64> {
        self.extra.as_ref()?.rho
    }

    /// Gives it a rho of its own.
    pub fn set_rho(&mut self, rho: f64) {
        self.extra.get_or_insert_default().rho = Some(rho);
    }

    /// The unit that a value was typed in.
    pub fn unit(&self, field: Field) -> Unit {
        let units = self.extra.as_ref().map_or(&[][..], |extra| &extra.units);
        units.iter().find(|(f, _)| *f == field).map_or(Unit::None, |(_, unit)| *unit)
    }

    /// Notes the units of values that are given anew, in the place of those of all these.
    pub fn set_units(&mut self, fields: &[Field], new: Vec<(Field, Unit)>) {
        if self.extra.is_some() || !new.is_empty() {
            let units = &mut self.extra.get_or_insert_default().units;
            units.retain(|(field, _)| !fields.contains(field));
            units.extend(new);
        }
    }

    /// The expression behind a value, if it is live.
    pub fn driver(&self, field: Field) -> Option<&Formula> {
        self.drivers().iter().find(|(f, _)| *f == field).map(|(_, formula)| formula)
    }

    /// What is wrong with the values that its live expressions gave it: no pose could have
    /// such a length, such an interval, such wheels.
    pub fn flaw(&self) -> Option<Diagnostic> {
        self.live()
            .iter()
            .find_map(|(field, formula)| self.excess(*field, formula))
            .or_else(|| self.flaw_of_kind())
    }

    /// A live value that is too large to work with.
    fn excess(&self, field: Field, formula: &Formula) -> Option<Diagnostic> {
        let value = self.constraint.get(field).filter(|value| value.abs() > LARGEST)?;
        let (value, most) = (format_number(value), format_number(LARGEST));
        Some(
            Diagnostic::error(
                errors::OUT_OF_RANGE,
                format!("a value in `{}` is too large to work with", self.name),
            )
            .at(formula.span(), format!("this is now {value}, no more than {most}")),
        )
    }

    fn flaw_of_kind(&self) -> Option<Diagnostic> {
        let Traits { flaw, bounds, .. } = self.constraint.traits();
        let flaw = flaw?;
        let ends = bounds.filter(|_| flaw == Flaw::EmptyRange);
        let field = match ends {
            Some(_) if self.driver(Field::Lo).is_some() => Field::Lo,
            _ => flaw.field(),
        };
        let problem = Diagnostic::error(
            errors::NONSENSE_VALUE,
            format!("{} in `{}`", flaw.noun(), self.name),
        );
        let problem = match self.driver(field) {
            Some(formula) => {
                let value = self.constraint.get(field).map_or_else(String::new, format_number);
                problem.at(formula.span(), format!("this is now {value}"))
            }
            None => problem,
        };
        Some(match ends {
            Some(Bounds { lo, hi }) => {
                let ends = format!("{}..{}", format_number(lo), format_number(hi));
                problem.note(format!("the range is {ends}"))
            }
            None => problem,
        })
    }
}

/// Whatever the order in which they were stated: a constraint that is made again has them in the
/// same one.
fn in_order(drivers: &mut Drivers) {
    drivers.sort_by_key(|(field, _)| *field);
}

/// A named value.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: NameText,
    /// What it stands for.
    pub formula: Formula,
    /// The value now; none while it needs velocities, which are computed when asked for.
    pub value: Option<Value>,
    /// What can change it, its own parameters included.
    pub depends: Depends,
}

impl Parameter {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of::<Self>() + self.formula.n_bytes()
    }
}

/// A value that is followed from frame to frame.
#[derive(Debug, Clone)]
pub struct Measure {
    /// Its name.
    pub name: NameText,
    /// What it measures, a number.
    pub formula: Formula,
    /// What its values are counted in.
    pub unit: Unit,
    /// Its values so far.
    pub tally: Tally,
}

impl Measure {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of::<Self>() + self.formula.n_bytes() + self.tally.n_bytes()
    }
}

/// Rows by handle, in order of creation, in pieces that stay where they are: room for a
/// hundred thousand is neither made in advance nor copied when it grows.
#[derive(Debug, Clone)]
pub(super) struct Table<T> {
    pieces: Vec<Vec<Option<T>>>,
    n_handles: usize,
}

/// Rows of a piece of a table.
const PIECE: usize = 256;

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self { pieces: Vec::new(), n_handles: 0 }
    }
}

impl<T> Table<T> {
    pub fn n_handles(&self) -> usize {
        self.n_handles
    }

    pub fn get(&self, idx: usize) -> Option<&T> {
        self.pieces.get(idx / PIECE)?.get(idx % PIECE)?.as_ref()
    }

    pub fn get_mut(&mut self, idx: usize) -> Option<&mut T> {
        self.pieces.get_mut(idx / PIECE)?.get_mut(idx % PIECE)?.as_mut()
    }

    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (usize, &T)> {
        let pieces = self.pieces.iter().enumerate();
        pieces.flat_map(|(p, piece)| {
            let rows = piece.iter().enumerate();
            rows.filter_map(move |(k, row)| row.as_ref().map(|row| (PIECE * p + k, row)))
        })
    }

    /// Makes it as long as that: rows beyond are empty.
    pub fn set_handles(&mut self, n: usize) {
        while self.n_handles < n {
            if self.n_handles.is_multiple_of(PIECE) {
                // The first piece grows with what is in it: most scenes are small.
                let room = if self.n_handles == 0 { 0 } else { PIECE };
                self.pieces.push(Vec::with_capacity(room));
            }
            self.pieces[self.n_handles / PIECE].push(None);
            self.n_handles += 1;
        }
        if self.n_handles > n {
            self.pieces.truncate(n.div_ceil(PIECE));
            if let Some(last) = self.pieces.last_mut() {
                debug_assert!(last.iter().skip((n - 1) % PIECE + 1).all(Option::is_none), "a row");
                last.truncate((n - 1) % PIECE + 1);
            }
            self.n_handles = n;
        }
    }

    /// Puts a row in a place, or empties it; gives what was there.
    pub fn swap(&mut self, idx: usize, row: Option<T>) -> Option<T> {
        self.set_handles(self.n_handles.max(idx + 1));
        std::mem::replace(&mut self.pieces[idx / PIECE][idx % PIECE], row)
    }
}
