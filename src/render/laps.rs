//! Paths that come back to themselves: a lap that is drawn once looks like a hundred.

use crate::constraint::{Point, Vector};
use crate::interrupt::tick;
use crate::world::Sample;

/// Samples are the same that are no farther apart than this part of the extent of the path. Laps of a
/// mechanism differ by rounding; neighbouring samples of one lap are farther apart than that.
const SAME: f64 = 1e-9;

/// Comparisons for each sample, after which it is left at what was found.
const PATIENCE: usize = 8;

/// Samples of a path that may be a lap with nothing behind it.
const LEAST_OF_LAP: usize = 24;

/// How large fifth differences are at most where a path is smooth, in parts of the longest step.
const SMOOTH: f64 = 0.05;

/// How much of a path shows all of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Once {
    /// So many samples from the first.
    pub n: usize,
    /// Whether the line goes from the last of these back to the first.
    pub is_closed: bool,
}

impl Once {
    /// These samples of a path, the first once more at the end if the line goes back to it.
    pub fn of(self, samples: &[Sample]) -> impl Iterator<Item = Sample> + '_ {
        let back = samples.first().filter(|_| self.is_closed);
        samples[..self.n].iter().chain(back).copied()
    }
}

/// How much of a path shows all of it: what is left out repeats what is there.
pub fn once(samples: &[Sample]) -> Once {
    let whole = Once { n: samples.len(), is_closed: false };
    let same = SAME * extent(samples);
    let is_same = |i: usize, j: usize| {
        let (a, b) = (samples[i], samples[j]);
        a.missed == b.missed && a.at.distance(b.at) <= same
    };
    let Some(last) = samples.len().checked_sub(1).filter(|_| same > 0.0) else { return whole };
    let mut best = whole;
    let mut patience = PATIENCE * samples.len();
    for k in (0..last).rev() {
        tick(10);
        if !is_same(k, last) {
            continue;
        }
        // So many samples at the end are those of a lap before.
        let period = last - k;
        let is_same_before = |&j: &usize| {
            tick(4);
            is_same(k - j, last - j)
        };
        let n_same = (0..=k).take_while(is_same_before).count();
        let first = k + 1 - n_same;
        let is_closed = first == 0 && period > 2;
        if first == 0 || n_same >= period {
            let n = first + period + usize::from(!is_closed);
            if n < best.n {
                best = Once { n, is_closed };
            }
        }
        patience = patience.saturating_sub(n_same);
        if patience == 0 {
            break;
        }
    }
    if best == whole { Once { is_closed: is_lap(samples, same), ..whole } } else { best }
}

/// Whether samples are one lap to the frame, after which the first would come again: from the last to
/// the first the path goes on as smoothly as anywhere.
fn is_lap(samples: &[Sample], same: f64) -> bool {
    let n = samples.len();
    if n < LEAST_OF_LAP || samples.iter().any(|sample| sample.missed) {
        return false;
    }
    let at = |k: usize| samples[k % n].at;
    // What a polynomial of degree 4 through five samples leaves of the sixth.
    let fifth_difference = |k: usize| {
        let terms = [-1.0, 5.0, -10.0, 10.0, -5.0, 1.0].into_iter().enumerate();
        terms.map(|(i, times)| (at(k + i) - at(k)) * times).fold(Vector::ZERO, |a, b| a + b).norm()
    };
    let (mut inside, mut longest) = (0.0_f64, 0.0_f64);
    for k in 0..n - 5 {
        tick(1);
        inside = inside.max(fifth_difference(k));
        longest = longest.max(at(k).distance(at(k + 1)));
    }
    let across = (n - 5..n).map(fifth_difference).fold(0.0, f64::max);
    inside <= SMOOTH * longest && across <= 2.0 * inside + same
}

/// The larger of the width and the height of what samples cover.
fn extent(samples: &[Sample]) -> f64 {
    let far = Point::new(f64::INFINITY, f64::INFINITY);
    let (mut lo, mut hi) = (far, Point::new(-far.x, -far.y));
    tick(samples.len());
    for Sample { at, .. } in samples {
        (lo.x, lo.y) = (lo.x.min(at.x), lo.y.min(at.y));
        (hi.x, hi.y) = (hi.x.max(at.x), hi.y.max(at.y));
    }
    (hi.x - lo.x).max(hi.y - lo.y).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Vector;

    /// A path that takes a turn in so many frames.
    fn turns(n: u32, per_turn: u32) -> Vec<Sample> {
        let at = |k| Vector::polar(2.0, f64::from(k) * std::f64::consts::TAU / f64::from(per_turn));
        (0..n).map(|k| Sample { at: at(k).to_point(), missed: false }).collect()
    }

    #[test]
    fn a_hundred_laps_are_one() {
        for n in [360, 361, 362, 500, 36_001] {
            assert_eq!(once(&turns(n, 360)), Once { n: 360, is_closed: true }, "{n}");
        }
    }

    #[test]
    fn a_lap_is_closed_if_the_first_sample_would_come_next() {
        for per_turn in [24, 36, 90, 720] {
            for (more, is_closed) in [(-2, false), (-1, false), (0, true)] {
                let n = per_turn + more;
                let path = turns(n as u32, per_turn as u32);
                assert_eq!(once(&path).is_closed, is_closed, "{n} of {per_turn}");
            }
        }
        // A thousandth of a frame too far.
        let at = |k| Vector::polar(2.0, f64::from(k) * std::f64::consts::TAU / 359.999);
        let path: Vec<Sample> =
            (0..360).map(|k| Sample { at: at(k).to_point(), missed: false }).collect();
        assert!(!once(&path).is_closed);
        // An arc, there and back.
        let at = |k| 0.7 * libm::sin(f64::from(k) * std::f64::consts::TAU / 90.0);
        let there_and_back = |n| -> Vec<Sample> {
            let place = |k| Vector::polar(2.0, at(k)).to_point();
            (0..n).map(|k| Sample { at: place(k), missed: false }).collect()
        };
        assert!(once(&there_and_back(90)).is_closed);
        assert!(!once(&there_and_back(89)).is_closed);
    }

    #[test]
    fn what_comes_before_the_laps_stays() {
        let mut path = turns(100, 36);
        for (k, sample) in path[..5].iter_mut().enumerate() {
            sample.at.x += 0.1 * (5 - k) as f64;
        }
        assert_eq!(once(&path), Once { n: 5 + 36 + 1, is_closed: false });
    }

    #[test]
    fn what_was_missed_once_is_no_lap() {
        let mut path = turns(37, 36);
        path[0].missed = true;
        assert_eq!(once(&path).n, 37);
    }

    #[test]
    fn paths_that_do_not_come_back_are_whole() {
        let line: Vec<Sample> = (0..1000)
            .map(|k| Sample { at: Point::new(1e-4 * f64::from(k), 0.0), missed: false })
            .collect();
        assert_eq!(once(&line), Once { n: 1000, is_closed: false });
        assert_eq!(once(&[]), Once { n: 0, is_closed: false });
        assert_eq!(once(&line[..1]), Once { n: 1, is_closed: false });
    }
}
