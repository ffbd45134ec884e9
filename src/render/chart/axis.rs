//! Axes: what part of the numbers they show, where each number lies, and which are written.

/// One axis of a chart.
#[derive(Debug, Clone, Default)]
pub struct ChartAxis {
    /// What it measures.
    pub label: String,
    /// Equal ratios, not equal differences, are equally long; numbers up to 0 have no place.
    pub is_log: bool,
    /// How its numbers are written.
    pub unit: AxisUnit,
}

/// How the numbers of an axis are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum AxisUnit {
    /// As they are.
    #[default]
    None,
    /// As times: `10 µs`.
    Seconds,
}

/// A number of an axis that has a line; those that are written have a label, which is SVG.
pub struct Tick {
    pub at: f64,
    pub label: Option<String>,
}

/// From numbers to places on the page.
pub struct Scale {
    is_log: bool,
    unit: AxisUnit,
    /// What is shown; of a logarithmic scale, in decades.
    lo: f64,
    hi: f64,
    /// Where these lie.
    from: f64,
    to: f64,
}

/// Numbers on a linear axis, about.
const N_TICKS: f64 = 7.0;

/// Beyond this numbers have no place on a linear axis: their differences are no numbers.
const LARGEST: f64 = 1e300;

fn has_place(is_log: bool, value: f64) -> bool {
    if is_log { value.is_finite() && value > 0.0 } else { value.abs() <= LARGEST }
}

impl Scale {
    /// The scale that shows all of the data between two places on the page.
    pub fn new(axis: &ChartAxis, data: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let is_log = axis.is_log;
        let data = data.filter(|&v| has_place(is_log, v));
        let data = data.map(|v| if is_log { libm::log10(v) } else { v });
        let (mut lo, mut hi) =
            data.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        if lo > hi {
            (lo, hi) = (0.0, 1.0);
        }
        if hi - lo < 1e-9 * hi.abs().max(1e-300) {
            // Half a unit more or less is no other number where numbers are large.
            let more = f64::max(0.5, 1e-9 * hi.abs());
            (lo, hi) = (lo - more, hi + more);
        }
        if is_log && hi - lo < 1.0 {
            // A decade at least, so that a number is written.
            (lo, hi) = (lo.floor(), hi.ceil());
        }
        Self { is_log, unit: axis.unit, lo, hi, from, to }
    }

    /// Leaves this share of the length free at both ends.
    pub fn keep_clear(&mut self, share: f64) {
        let more = share * (self.hi - self.lo);
        self.lo -= more;
        self.hi += more;
    }

    /// Where a number lies, if it has a place.
    pub fn place(&self, value: f64) -> Option<f64> {
        has_place(self.is_log, value)
            .then(|| self.at(if self.is_log { libm::log10(value) } else { value }))
    }

    fn at(&self, value: f64) -> f64 {
        self.from + (value - self.lo) / (self.hi - self.lo) * (self.to - self.from)
    }

    /// The numbers that have a line.
    pub fn ticks(&self) -> Vec<Tick> {
        if self.is_log { self.decades() } else { self.steps() }
    }

    fn decades(&self) -> Vec<Tick> {
        let (lo, hi) = (self.lo.ceil() as i32, self.hi.floor() as i32);
        let n = f64::from((hi - lo).max(0) + 1);
        // Labels an inch apart are enough.
        let room = (self.to - self.from).abs() / (self.hi - self.lo);
        let every = if n <= 1.0 { 1 } else { (26.0 / room).ceil().max(1.0) as i32 };
        let mut ticks = Vec::new();
        for k in lo - 1..=hi {
            let label = (k >= lo && k.rem_euclid(every) == 0).then(|| self.unit.power_of_ten(k));
            if k >= lo {
                ticks.push(Tick { at: self.at(f64::from(k)), label });
            }
            if room > 60.0 {
                let fine = (2..=9).map(|m| f64::from(k) + libm::log10(f64::from(m)));
                let fine = fine.filter(|v| (self.lo..=self.hi).contains(v));
                ticks.extend(fine.map(|v| Tick { at: self.at(v), label: None }));
            }
        }
        ticks
    }

    fn steps(&self) -> Vec<Tick> {
        let rough = (self.hi - self.lo) / N_TICKS;
        let decade = libm::pow(10.0, libm::log10(rough).floor());
        let nice = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * decade >= rough);
        let step = nice.unwrap_or(10.0) * decade;
        let n_places = (-libm::log10(step).floor()).max(0.0) as usize;
        let (first, last) = ((self.lo / step).ceil() as i64, (self.hi / step).floor() as i64);
        let tick = |k: i64| {
            let value = k as f64 * step;
            Tick { at: self.at(value), label: Some(self.unit.write(value, n_places)) }
        };
        (first..=last).map(tick).collect()
    }
}

impl AxisUnit {
    fn power_of_ten(self, k: i32) -> String {
        match self {
            Self::None if (0..=3).contains(&k) => format!("{}", 10_i32.pow(k.unsigned_abs())),
            Self::None => {
                let sign = if k < 0 { "\u{2212}" } else { "" };
                let size = k.unsigned_abs();
                format!("10<tspan dy=\"-5\" font-size=\"9.5\">{sign}{size}</tspan>")
            }
            Self::Seconds => {
                let (unit, least) = match k {
                    0.. => ("s", 0),
                    -3..0 => ("ms", -3),
                    -6..-3 => ("\u{b5}s", -6),
                    _ => ("ns", -9),
                };
                if k < least {
                    return format!(
                        "0.{}1 ns",
                        "0".repeat((least - k - 1).unsigned_abs() as usize)
                    );
                }
                format!("{} {unit}", 10_i64.pow((k - least).unsigned_abs()))
            }
        }
    }

    fn write(self, value: f64, n_places: usize) -> String {
        let value = if value == 0.0 { 0.0 } else { value };
        let text = format!("{value:.n_places$}").replace('-', "\u{2212}");
        match self {
            Self::None => text,
            Self::Seconds => format!("{text} s"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(is_log: bool, unit: AxisUnit, data: &[f64]) -> Scale {
        let axis = ChartAxis { label: String::new(), is_log, unit };
        Scale::new(&axis, data.iter().copied(), 0.0, 600.0)
    }

    fn labels(is_log: bool, unit: AxisUnit, data: &[f64]) -> Vec<String> {
        scale(is_log, unit, data).ticks().into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn times_are_written_with_their_unit() {
        let found = labels(true, AxisUnit::Seconds, &[5e-7, 2e-3]);
        assert_eq!(found, ["1 \u{b5}s", "10 \u{b5}s", "100 \u{b5}s", "1 ms"]);
    }

    #[test]
    fn linear_steps_are_round() {
        assert_eq!(
            labels(false, AxisUnit::None, &[0.0, 30.0]),
            ["0", "5", "10", "15", "20", "25", "30"]
        );
        assert_eq!(labels(false, AxisUnit::None, &[0.0, 0.4])[1], "0.1");
    }

    #[test]
    fn odd_data_still_make_an_axis() {
        for data in [
            &[][..],
            &[0.0],
            &[-1.0, f64::NAN],
            &[1e-300, 1e300],
            &[3.0, 3.0],
            &[1e17, 1e17],
            &[-1e300, -1e300],
            &[-1e300, 1e300],
            &[-1e308, 1e308],
        ] {
            for is_log in [false, true] {
                assert!(labels(is_log, AxisUnit::None, data).len() < 60, "of {data:?}");
                let scale = scale(is_log, AxisUnit::None, data);
                let on_the_page = |at: f64| (-1e-6..600.000_001).contains(&at);
                assert!(data.iter().filter_map(|&v| scale.place(v)).all(on_the_page), "{data:?}");
                assert!(scale.ticks().iter().all(|tick| on_the_page(tick.at)), "{data:?}");
            }
        }
    }
}
