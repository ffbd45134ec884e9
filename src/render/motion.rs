//! How a figure moves: values over time, as few as a straight line between them allows.

/// How a figure moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Of the whole, seconds.
    pub duration: f64,
    /// What changes.
    pub tracks: Vec<Track>,
}

/// How one thing about a figure changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// What it is.
    pub change: Change,
    /// When, as parts of the duration; empty if evenly spaced.
    pub times: Vec<f64>,
    /// What to, as SVG writes it.
    pub values: Vec<String>,
}

/// What a track changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// Where the figure stands. Goes before its turn.
    Place,
    /// How it is turned, on top of where it stands.
    Turn,
    /// Whether it is there.
    Visibility,
    /// An attribute of one of its shapes.
    Shape(usize, &'static str),
}

impl Change {
    /// The shape it is about, if it is not about the whole figure.
    pub const fn shape(self) -> Option<usize> {
        match self {
            Self::Shape(k, _) => Some(k),
            _ => None,
        }
    }
}

/// The fewest of the rows of `values` (one a frame, `n` numbers each) from which straight
/// lines in `times` give all the others within `tolerance`: the frames to keep, first and
/// last among them. One pass, in the manner of a swinging door.
pub fn keys(times: &[f64], values: &[f64], n: usize, tolerance: f64) -> Vec<usize> {
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
}
