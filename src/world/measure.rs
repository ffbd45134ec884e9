//! Measuring: what a frame adds to the measures, and what they say.

use super::environments::{Here, Moving};
use super::{Depends, Extremes, MeasureId, Rates, Tally, World};
use crate::constraint::Jet;
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::terms::Statistic;

/// How a frame is measured.
pub struct Measuring<'a> {
    /// Whether extremes are looked for between frames.
    pub extremes: Extremes,
    /// Whether the pose meets all constraints.
    pub is_met: bool,
    /// Gives how all points move at the present pose; asked at most once.
    pub rates: &'a mut dyn FnMut(&mut World) -> Result<Rates, Diagnostic>,
}

impl World {
    /// A statistic of a measure.
    ///
    /// # Errors
    /// Where it has no value yet.
    pub(super) fn statistic(
        &self,
        id: MeasureId,
        which: Statistic,
        span: Span,
    ) -> Result<f64, Diagnostic> {
        let measure = self.measure(id).expect("a mentioned measure lives");
        measure.tally.get(which).ok_or_else(|| {
            let name = &measure.name;
            Diagnostic::error(errors::NOT_MEASURED, format!("`{name}` has no value yet"))
                .at(span, format!("no `{}` of no values", which.word()))
                .help("a solved pose gives one, and each frame: `step`")
        })
    }

    /// Whether some measure has no value yet.
    pub fn has_empty_measures(&self) -> bool {
        self.measures().any(|(_, measure)| measure.tally.readings().is_empty())
    }

    /// Whether there is something to measure.
    pub const fn has_measures(&self) -> bool {
        self.n_measures > 0
    }

    /// How many values all measures keep.
    pub fn n_readings(&self) -> usize {
        self.measures().map(|(_, measure)| measure.tally.readings().len()).sum()
    }

    /// Empties all measures.
    pub fn forget_readings(&mut self) {
        for k in 0..self.measures.n_handles() {
            if let Some(measure) = self.measures.get_mut(k) {
                measure.tally = Tally::default();
            }
        }
    }

    /// Measures the pose of now; of all measures, or of those that have no value yet.
    ///
    /// # Errors
    /// Where one has no value now.
    pub fn take_readings(
        &mut self,
        only_empty: bool,
        how: &mut Measuring,
    ) -> Result<(), Diagnostic> {
        let mut rates = None;
        for k in 0..self.measures.n_handles() {
            let Some(measure) = self.measures.get(k) else { continue };
            if !only_empty || measure.tally.readings().is_empty() {
                self.take_reading(MeasureId::new(k), &mut rates, how)?;
            }
        }
        Ok(())
    }

    /// Measures the pose of now; `rates` is how all points move, once that was asked for.
    ///
    /// # Errors
    /// Where it has no value now.
    pub fn take_reading(
        &mut self,
        id: MeasureId,
        rates: &mut Option<Rates>,
        how: &mut Measuring,
    ) -> Result<(), Diagnostic> {
        let time = self.clock.time();
        let measure = self.measure(id).expect("a listed measure lives");
        if measure.tally.readings().last().is_some_and(|last| last.time >= time) {
            return Ok(());
        }
        let depends = self.depends(&measure.formula);
        if depends.looks_up_parameters() {
            self.refresh_parameters();
        }
        if depends.on_rates {
            known(rates, self, how)?;
        }
        let measure = self.measure(id).expect("it lives");
        let scale = measure.unit.scale();
        let here = Here::new(self, rates.as_ref().filter(|_| depends.on_rates));
        let value = measure.formula.evaluate(&here)?.number() / scale;
        let is_refined = how.extremes == Extremes::Refined && how.is_met;
        let derivatives = if is_refined && is_followed(depends) && measure.tally.may_turn(value) {
            let rates = known(rates, self, how)?;
            // What has no derivative is no reason to have no value.
            let formula = &self.measure(id).expect("it lives").formula;
            let Jet { d, dd, .. } = formula.evaluate(&Moving::new(self, rates))?.number();
            let derivatives = [d / scale, dd / scale];
            derivatives.iter().all(|it| it.is_finite()).then_some(derivatives)
        } else {
            None
        };
        let tally = &mut self.measures.get_mut(id.idx()).expect("it lives").tally;
        tally.add(time, value, derivatives);
        if is_refined && !is_followed(depends) {
            tally.look_between();
        }
        self.dependencies.note_change();
        Ok(())
    }
}

/// How all points move at the present pose, asked for once.
fn known<'a>(
    rates: &'a mut Option<Rates>,
    world: &mut World,
    how: &mut Measuring,
) -> Result<&'a Rates, Diagnostic> {
    if rates.is_none() {
        *rates = Some((how.rates)(world)?);
    }
    Ok(rates.as_ref().expect("it was asked for"))
}

/// Whether the velocities of points tell how fast a value changes.
const fn is_followed(depends: Depends) -> bool {
    !depends.on_rates && !depends.on_constraints
}
