//! Extremes of a value between the frames at which it was measured.
//!
//! Where it is known how fast the value changes, two frames make a polynomial of degree 5 that has
//! their values and both derivatives (Hermite). At 360 frames a turn it is off by some 1e-15 of the
//! span. Where only values are known, the last seven make one of degree 6 (Newton).

/// A value, and when it was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The time.
    pub time: f64,
    /// The value.
    pub value: f64,
}

/// A value and its place in time.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Extremum {
    pub value: f64,
    pub time: f64,
}

/// A value with its derivatives in time.
pub(super) struct Knot {
    pub time: f64,
    pub value: f64,
    pub rates: [f64; 2],
}

/// By how much of its height over the frames next to it an extremum may depend on the degree of the
/// polynomial: at 36 frames a turn a sine is far below, and a corner far above.
const SMOOTH: f64 = 0.05;
/// How many values make a polynomial where nothing else is known.
const WINDOW: usize = 7;
/// How large the last term may be against the second: of what is not smooth they are alike.
const LAST_TERM: f64 = 1e-2;
/// Halvings that lead to a root as near as numbers go.
const HALVINGS: u32 = 60;

/// The extremum between two knots, where the rate changes its sign and the value is smooth.
pub(super) fn between(from: &Knot, to: &Knot) -> Option<Extremum> {
    let h = to.time - from.time;
    let [d0, d1] = [h * from.rates[0], h * to.rates[0]];
    let turns = d0 * d1 < 0.0;
    if !turns {
        return None;
    }
    let [dd0, dd1] = [h * h * from.rates[1], h * h * to.rates[1]];
    let rise = to.value - from.value;
    let (a, b, c) = (rise - d0 - 0.5 * dd0, d1 - d0 - dd0, dd1 - dd0);
    let quintic = [
        d0,
        0.5 * dd0,
        10.0 * a - 4.0 * b + 0.5 * c,
        -15.0 * a + 7.0 * b - c,
        6.0 * a - 3.0 * b + 0.5 * c,
    ];
    let cubic = [d0, 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise, 0.0, 0.0];
    let at = |[a, b, c, d, e]: [f64; 5], s: f64| s * (a + s * (b + s * (c + s * (d + s * e))));
    let slope = |s: f64| {
        let [a, b, c, d, e] = quintic;
        a + s * (2.0 * b + s * (3.0 * c + s * (4.0 * d + s * 5.0 * e)))
    };
    let s = root(slope, 0.0, 1.0);
    let height = at(quintic, s);
    let over = if d0 > 0.0 { height - rise.max(0.0) } else { rise.min(0.0) - height };
    let doubt = (height - at(cubic, s)).abs();
    // False for what is not a number.
    let is_smooth = over > 0.0 && doubt <= SMOOTH * over;
    is_smooth.then(|| Extremum { value: from.value + height, time: h.mul_add(s, from.time) })
}

/// Where a function changes its sign between two places at which it has different ones.
fn root(f: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    let is_up = f(hi) > 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (lo + hi);
        if (f(middle) > 0.0) == is_up {
            hi = middle;
        } else {
            lo = middle;
        }
    }
    0.5 * (lo + hi)
}

/// Gives the extremes between the last values that were not looked at before: between the last two,
/// and once there are enough values between all of them.
pub(super) fn within_last(readings: &[Reading], found: &mut impl FnMut(Extremum)) {
    let Some(window) = readings.last_chunk::<WINDOW>() else { return };
    let is_first = readings.len() == WINDOW;
    let Some(polynomial) = Newton::through(window) else { return };
    let from = if is_first { 0 } else { WINDOW - 2 };
    for pair in window[from..].windows(2) {
        let [lo, hi] = [pair[0].time, pair[1].time].map(|time| polynomial.place(time));
        let slope = |u: f64| polynomial.at(u).1;
        if slope(lo) * slope(hi) < 0.0 {
            let u = root(slope, lo, hi);
            found(Extremum { value: polynomial.at(u).0, time: polynomial.time(u) });
        }
    }
}

/// A polynomial through some values, time counted from the middle of them in halves of their length.
struct Newton {
    middle: f64,
    half: f64,
    places: [f64; WINDOW],
    coefficients: [f64; WINDOW],
}

impl Newton {
    /// The polynomial, if the values are those of something smooth.
    fn through(window: &[Reading; WINDOW]) -> Option<Self> {
        let (first, last) = (window[0].time, window[WINDOW - 1].time);
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        let places = window.map(|reading| (reading.time - middle) / half);
        let mut coefficients = window.map(|reading| reading.value);
        for order in 1..WINDOW {
            for k in (order..WINDOW).rev() {
                let rise = coefficients[k] - coefficients[k - 1];
                coefficients[k] = rise / (places[k] - places[k - order]);
            }
        }
        let is_smooth = coefficients[WINDOW - 1].abs() <= LAST_TERM * coefficients[2].abs();
        is_smooth.then_some(Self { middle, half, places, coefficients })
    }

    fn place(&self, time: f64) -> f64 {
        (time - self.middle) / self.half
    }

    fn time(&self, place: f64) -> f64 {
        self.half.mul_add(place, self.middle)
    }

    /// Its value at a place, and its slope there.
    fn at(&self, u: f64) -> (f64, f64) {
        let mut value = self.coefficients[WINDOW - 1];
        let mut slope = 0.0;
        for k in (0..WINDOW - 1).rev() {
            let from = u - self.places[k];
            slope = slope * from + value;
            value = value * from + self.coefficients[k];
        }
        (value, slope)
    }
}
