//! What a measure keeps of its values: all of them, and their extremes between frames.

use super::smooth::{Extremum, Knot, Reading, between, within_last};
use super::trace::Tail;
use crate::terms::Statistic;

/// Whether extremes are looked for between frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extremes {
    /// Where the value is smooth: from how fast it changes.
    #[default]
    Refined,
    /// The values of frames are all there is.
    Sampled,
}

impl Extremes {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Refined, Self::Sampled];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Refined => "refined",
            Self::Sampled => "sampled",
        }
    }
}

/// The values of a measure.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    readings: Vec<Reading>,
    totals: Totals,
}

/// What is worked out of the values as they come.
#[derive(Debug, Clone, Copy, Default)]
struct Totals {
    min: Extremum,
    max: Extremum,
    /// The integral over time, each frame's value joined to the next by a straight line.
    area: f64,
    /// First and second derivative at the last value, where they were asked for.
    rates: Option<[f64; 2]>,
}

impl Totals {
    /// Its numbers, in an order of their own.
    fn to_numbers(self) -> [f64; 8] {
        let Self { min, max, area, rates } = self;
        let [first, second] = rates.unwrap_or_default();
        let has_rates = f64::from(u8::from(rates.is_some()));
        [min.value, min.time, max.value, max.time, area, has_rates, first, second]
    }

    /// What [`to_numbers`](Self::to_numbers) gave.
    fn from_numbers(numbers: &[f64; 8]) -> Self {
        let &[min, at_min, max, at_max, area, has_rates, first, second] = numbers;
        Self {
            min: Extremum { value: min, time: at_min },
            max: Extremum { value: max, time: at_max },
            area,
            rates: (has_rates == 1.0).then_some([first, second]),
        }
    }

    fn include(&mut self, found: Extremum) {
        if found.value < self.min.value {
            self.min = found;
        }
        if found.value > self.max.value {
            self.max = found;
        }
    }
}

/// A tally as it was: what it had worked out, and how many values it had, or has again.
#[derive(Debug, Clone)]
pub(super) struct TallyMark {
    totals: Totals,
    readings: Tail<Vec<Reading>>,
}

/// Two steps that differ by so much of their size, or more, may have an extremum next to them: the
/// steps on both sides of one, and those next to these, differ by two thirds of their size at least.
const BENDING: f64 = 0.3;

impl Tally {
    /// All values, in order of time.
    pub fn readings(&self) -> &[Reading] {
        &self.readings
    }

    /// A statistic of the values; none where there is no value yet.
    pub fn get(&self, which: Statistic) -> Option<f64> {
        let Totals { min, max, area, .. } = self.totals;
        if which == Statistic::Count {
            return Some(self.readings.len() as f64);
        }
        let (first, last) = (self.readings.first()?, self.readings.last()?);
        Some(match which {
            Statistic::Min => min.value,
            Statistic::Max => max.value,
            Statistic::Span => max.value - min.value,
            Statistic::AtMin => min.time,
            Statistic::AtMax => max.time,
            Statistic::First => first.value,
            Statistic::Mean if last.time > first.time => area / (last.time - first.time),
            Statistic::Last | Statistic::Mean => last.value,
            Statistic::Count => unreachable!("it is counted above"),
        })
    }

    /// Whether there may be an extremum next to the last value, were `value` the next one, that is
    /// greater or less than all so far: it is then worth to know how fast the value changes.
    pub(super) fn may_turn(&self, value: f64) -> bool {
        let [.., before, last] = self.readings[..] else { return true };
        let step = value - last.value;
        let bend = step - (last.value - before.value);
        let reach = 2.0 * (step.abs() + bend.abs());
        let Totals { min, max, .. } = self.totals;
        bend.abs() > BENDING * step.abs()
            && (value + reach >= max.value || value - reach <= min.value)
    }

    /// Takes in the value at a later time, with its derivatives where they are known.
    pub(super) fn add(&mut self, time: f64, value: f64, rates: Option<[f64; 2]>) {
        let new = Extremum { value, time };
        match self.readings.last() {
            None => self.totals = Totals { min: new, max: new, ..Totals::default() },
            Some(last) => {
                self.totals.area += 0.5 * (time - last.time) * (value + last.value);
                self.totals.include(new);
                if let (Some(before), Some(now)) = (self.totals.rates, rates) {
                    let from = Knot { time: last.time, value: last.value, rates: before };
                    let to = Knot { time, value, rates: now };
                    between(&from, &to).into_iter().for_each(|found| self.totals.include(found));
                }
            }
        }
        self.totals.rates = rates;
        self.readings.push(Reading { time, value });
    }

    /// Looks for extremes between the last values from these alone, where nobody can say how fast
    /// the value changes.
    pub(super) fn look_between(&mut self) {
        let Self { readings, totals } = self;
        within_last(readings, &mut |found| totals.include(found));
    }

    /// All of it as numbers, to be saved; empty if it is.
    pub fn to_numbers(&self) -> Vec<f64> {
        if self.readings.is_empty() {
            return Vec::new();
        }
        let readings = self.readings.iter().flat_map(|it| [it.time, it.value]);
        self.totals.to_numbers().into_iter().chain(readings).collect()
    }

    /// What [`to_numbers`](Self::to_numbers) gave; none if these are no such numbers.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let (totals, rest) = numbers.split_first_chunk()?;
        let (pairs, rest) = rest.as_chunks::<2>();
        let readings: Vec<Reading> =
            pairs.iter().map(|&[time, value]| Reading { time, value }).collect();
        let is_sound = rest.is_empty()
            && !readings.is_empty()
            && readings.is_sorted_by(|a, b| a.time < b.time);
        is_sound.then(|| Self { readings, totals: Totals::from_numbers(totals) })
    }

    /// It as it is, to go back to.
    pub(super) fn mark(&self) -> TallyMark {
        TallyMark { totals: self.totals, readings: Tail::mark(&self.readings) }
    }

    /// Puts it back as it was; gives what takes that back.
    pub(super) fn swap(&mut self, mark: TallyMark) -> TallyMark {
        let totals = std::mem::replace(&mut self.totals, mark.totals);
        TallyMark { totals, readings: mark.readings.swap(&mut self.readings) }
    }

    /// Whether it is as it was.
    pub(super) fn is_at(&self, mark: &TallyMark) -> bool {
        let bits = |totals: Totals| totals.to_numbers().map(f64::to_bits);
        mark.readings.is_all_of(&self.readings) && bits(self.totals) == bits(mark.totals)
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.readings)
    }
}

impl TallyMark {
    /// No value.
    pub fn empty() -> Self {
        Self { totals: Totals::default(), readings: Tail::cleared() }
    }

    /// Whether values come back with it.
    pub fn has_readings(&self) -> bool {
        !self.readings.then().is_empty()
    }

    /// Roughly how many bytes it holds, but for itself.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&**self.readings.then())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tally of a function with its derivatives, over so many steps of `h`; with those where it
    /// asks for them, or everywhere.
    fn tally_of(f: impl Fn(f64) -> [f64; 3], h: f64, n: u32, is_asked: bool) -> (Tally, u32) {
        let mut tally = Tally::default();
        let mut n_asked = 0;
        for k in 0..=n {
            let t = f64::from(k) * h;
            let [value, first, second] = f(t);
            let is_wanted = !is_asked || tally.may_turn(value);
            n_asked += u32::from(is_wanted);
            tally.add(t, value, is_wanted.then_some([first, second]));
        }
        (tally, n_asked)
    }

    fn wave(t: f64) -> [f64; 3] {
        let (s, c) = libm::sincos(t + 0.3);
        let (s3, c3) = libm::sincos(3.0 * t);
        [s + 0.2 * s3, c + 0.6 * c3, -s - 1.8 * s3]
    }

    #[test]
    fn rates_are_asked_for_next_to_extremes_only_and_nothing_is_missed() {
        for offset in 0..40 {
            let f = |t: f64| wave(t + 0.01 * f64::from(offset));
            let h = std::f64::consts::TAU / 360.0;
            let (asked, n_asked) = tally_of(f, h, 720, true);
            let (told, _) = tally_of(f, h, 720, false);
            for which in Statistic::ALL {
                assert_eq!(asked.get(which), told.get(which), "{which:?}");
            }
            assert!(n_asked < 80, "{n_asked} of 721");
        }
    }

    #[test]
    fn an_extremum_lies_between_two_frames() {
        let h = std::f64::consts::TAU / 360.0;
        let sine = |t: f64| {
            let (s, c) = libm::sincos(t);
            [s, c, -s]
        };
        // A quarter turn is not a whole number of frames from here.
        let (tally, _) = tally_of(|t| sine(t + 0.4 * h), h, 360, true);
        let top = std::f64::consts::FRAC_PI_2 - 0.4 * h;
        assert!((tally.get(Statistic::Max).unwrap() - 1.0).abs() < 1e-15);
        assert!((tally.get(Statistic::AtMax).unwrap() - top).abs() < 1e-9);
        assert!((tally.get(Statistic::Min).unwrap() + 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_corner_is_left_as_it_was_measured() {
        // It runs against a stop between two frames.
        let stop = |t: f64| if t < 0.55 { [t, 1.0, 0.0] } else { [0.55, 0.0, 0.0] };
        let (tally, _) = tally_of(stop, 0.1, 10, false);
        assert_eq!(tally.get(Statistic::Max), Some(0.55));
        let jump = |t: f64| [f64::from(u8::from(t > 0.55)), 0.0, 0.0];
        let (tally, _) = tally_of(jump, 0.1, 10, false);
        assert_eq!(
            [Statistic::Min, Statistic::Max].map(|it| tally.get(it)),
            [Some(0.0), Some(1.0)]
        );
    }

    #[test]
    fn values_alone_tell_an_extremum_of_what_is_smooth() {
        let h = std::f64::consts::TAU / 360.0;
        for offset in 0..20 {
            let mut tally = Tally::default();
            for k in 0..=360 {
                let t = f64::from(k) * h;
                tally.add(t, libm::sin(t + 0.05 * f64::from(offset) * h), None);
                tally.look_between();
            }
            assert!((tally.get(Statistic::Max).unwrap() - 1.0).abs() < 1e-13);
            assert!((tally.get(Statistic::Min).unwrap() + 1.0).abs() < 1e-13);
        }
        let mut tally = Tally::default();
        for k in 0..20 {
            tally.add(f64::from(k), f64::from(u8::from(k > 9)), None);
            tally.look_between();
        }
        assert_eq!(
            [Statistic::Min, Statistic::Max].map(|it| tally.get(it)),
            [Some(0.0), Some(1.0)]
        );
    }

    #[test]
    fn numbers_bring_it_back() {
        let (tally, _) = tally_of(wave, 0.1, 30, true);
        let back = Tally::from_numbers(&tally.to_numbers()).expect("its own numbers");
        assert_eq!(back.to_numbers(), tally.to_numbers());
        assert!(Tally::default().to_numbers().is_empty());
        assert!(Tally::from_numbers(&[1.0; 9]).is_none());
    }
}
