//! How a figure moves: values over time, as few as a straight line between them allows.

use crate::interrupt::tick;

/// What a look at a number of a frame takes, in ticks.
const NUMBER: usize = 10;

/// How a figure moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Keyframes {
    /// Of the whole, seconds.
    pub duration: f64,
    /// What changes.
    pub tracks: Vec<AttributeTrack>,
}

impl Keyframes {
    /// Whether the figure is not there in the first frame.
    pub fn is_hidden_at_first(&self) -> bool {
        let is_hidden = |track: &AttributeTrack| track.values.first().is_some_and(|v| v == HIDDEN);
        self.tracks
            .iter()
            .any(|track| track.change == AnimatedAttribute::Visibility && is_hidden(track))
    }
}

const VISIBLE: &str = "visible";
const HIDDEN: &str = "hidden";

/// How one thing about a figure changes.
#[derive(Debug, Clone, PartialEq)]
pub struct AttributeTrack {
    /// What it is.
    pub change: AnimatedAttribute,
    /// When, as parts of the duration; empty if evenly spaced.
    pub times: Vec<f64>,
    /// What to, as SVG writes it.
    pub values: Vec<String>,
}

/// What a track changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimatedAttribute {
    /// Where the figure stands. Goes before its turn.
    Place,
    /// How it is turned, on top of where it stands.
    Turn,
    /// Whether it is there.
    Visibility,
    /// An attribute of one of its shapes.
    Shape(usize, &'static str),
}

impl AnimatedAttribute {
    /// The shape it is about, if it is not about the whole figure.
    pub const fn shape(self) -> Option<usize> {
        match self {
            Self::Shape(k, _) => Some(k),
            _ => None,
        }
    }
}

/// The track of some numbers a frame; none if they do not change.
pub fn track(
    change: AnimatedAttribute,
    times: &[f64],
    rows: &[f64],
    n: usize,
    tolerance: f64,
    write: impl Fn(&[f64]) -> String,
) -> Option<AttributeTrack> {
    tick(NUMBER * rows.len());
    let still = |(k, value): (usize, &f64)| (value - rows[k % n]).abs() <= tolerance;
    if rows.iter().enumerate().all(still) {
        return None;
    }
    let kept = keys(times, rows, n, tolerance);
    // Without times frames are evenly spaced; better all of them than most with their times.
    let is_even = is_even(times);
    if is_even && 3 * kept.len() > 2 * times.len() {
        let values = rows.chunks(n).map(write).collect();
        return Some(AttributeTrack { change, times: Vec::new(), values });
    }
    let values = kept.iter().map(|&k| write(&rows[k * n..(k + 1) * n])).collect();
    Some(AttributeTrack { change, times: kept.iter().map(|&k| times[k]).collect(), values })
}

fn is_even(times: &[f64]) -> bool {
    let step = 1.0 / (times.len().max(2) - 1) as f64;
    times.iter().enumerate().all(|(k, &t)| (t - k as f64 * step).abs() < 1e-3 * step)
}

/// The track of something that comes and goes; none if it is always there.
pub fn visibility(times: &[f64], is_there: &[bool]) -> Option<AttributeTrack> {
    if is_there.iter().all(|&there| there) {
        return None;
    }
    let mut track = AttributeTrack {
        change: AnimatedAttribute::Visibility,
        times: Vec::new(),
        values: Vec::new(),
    };
    for (k, &there) in is_there.iter().enumerate() {
        if k == 0 || there != is_there[k - 1] {
            track.times.push(times[k]);
            track.values.push(if there { VISIBLE } else { HIDDEN }.to_owned());
        }
    }
    Some(track)
}

/// The fewest of the rows of `values` (one a frame, `n` numbers each) from which straight
/// lines in `times` give all the others within `tolerance`: the frames to keep, first and
/// last among them. One pass, in the manner of a swinging door.
fn keys(times: &[f64], values: &[f64], n: usize, tolerance: f64) -> Vec<usize> {
    let n_frames = times.len();
    if n_frames < 2 {
        return (0..n_frames).collect();
    }
    let row = |k: usize| &values[k * n..(k + 1) * n];
    let mut kept = vec![0];
    let mut anchor = 0;
    let mut slopes = vec![(f64::NEG_INFINITY, f64::INFINITY); n];
    for k in 1..n_frames {
        let slope = |from: usize, i: usize, off: f64| {
            (row(k)[i] - row(from)[i] + off) / (times[k] - times[from])
        };
        let is_on_line = (0..n).all(|i| {
            let s = slope(anchor, i, 0.0);
            slopes[i].0 <= s && s <= slopes[i].1
        });
        if !is_on_line {
            anchor = k - 1;
            kept.push(anchor);
            slopes.fill((f64::NEG_INFINITY, f64::INFINITY));
        }
        for (i, (low, high)) in slopes.iter_mut().enumerate() {
            *low = low.max(slope(anchor, i, -tolerance));
            *high = high.min(slope(anchor, i, tolerance));
        }
    }
    kept.push(n_frames - 1);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_frames_give_all_others() {
        let check = |name: &str, f: &dyn Fn(f64) -> [f64; 2], at_most: usize| {
            let times: Vec<f64> = (0..=600).map(|k| f64::from(k) / 600.0).collect();
            let values: Vec<f64> = times.iter().flat_map(|&t| f(t)).collect();
            let kept = keys(&times, &values, 2, 0.05);
            assert!(kept.len() <= at_most, "{name}: {}", kept.len());
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, 600));
            for pair in kept.windows(2) {
                let (a, b) = (pair[0], pair[1]);
                for k in a..=b {
                    let part = (times[k] - times[a]) / (times[b] - times[a]);
                    for i in 0..2 {
                        let (p, q) = (values[2 * a + i], values[2 * b + i]);
                        let off = p + part * (q - p) - values[2 * k + i];
                        assert!(off.abs() <= 0.0501, "{name} at frame {k}: {off}");
                    }
                }
            }
        };
        check("still", &|_| [3.0, 4.0], 2);
        check("even", &|t| [100.0 * t, -7.0 * t], 2);
        check("circle", &|t| [200.0 * libm::cos(6.3 * t), 200.0 * libm::sin(6.3 * t)], 250);
        check("jump", &|t| [if t < 0.5 { 0.0 } else { 90.0 }, 0.0], 4);
    }

    #[test]
    fn what_stands_still_has_no_track() {
        let times = [0.0, 0.5, 1.0];
        let write = |row: &[f64]| format!("{row:?}");
        assert_eq!(
            track(
                AnimatedAttribute::Place,
                &times,
                &[1.0, 2.0, 1.0, 2.01, 1.0, 2.0],
                2,
                0.06,
                write
            ),
            None
        );
        let moved = track(
            AnimatedAttribute::Place,
            &times,
            &[1.0, 2.0, 2.0, 2.0, 3.0, 2.0],
            2,
            0.06,
            write,
        );
        assert_eq!(moved.map(|t| t.values.join(";")), Some("[1.0, 2.0];[3.0, 2.0]".to_owned()));
    }

    #[test]
    fn what_comes_and_goes_is_hidden_between() {
        let shown =
            visibility(&[0.0, 0.25, 0.5, 1.0], &[false, true, true, false]).expect("a track");
        assert_eq!(shown.values, ["hidden", "visible", "hidden"]);
        assert_eq!(shown.times, [0.0, 0.25, 1.0]);
        assert_eq!(visibility(&[0.0, 1.0], &[true, true]), None);
    }
}
