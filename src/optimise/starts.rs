//! Where searches begin: places that fill a box evenly, always the same.

use super::Best;

/// Places that are looked at before any search, for each number.
const LOOKS: usize = 12;
/// Searches that begin at the best of these.
const MOST: usize = 4;

/// The place of a number in the additive sequence of the generalised golden ratio (M. Roberts, The
/// unreasonable effectiveness of quasirandom sequences, 2018).
fn place(k: usize, n: usize) -> Vec<f64> {
    // The root above 1 of x^(n + 1) = x + 1, by the iteration that defines it.
    let mut ratio = 2.0_f64;
    for _ in 0..60 {
        ratio = libm::pow(1.0 + ratio, 1.0 / (n as f64 + 1.0));
    }
    let step = |j: usize| libm::pow(ratio, -(j as f64 + 1.0));
    (0..n).map(|j| (0.5 + k as f64 * step(j)).fract()).collect()
}

/// Where to begin: at `first`, and at the best of some places all over the box.
pub(super) fn starts(first: &[f64], mut value: impl FnMut(&[f64]) -> Option<f64>) -> Vec<Vec<f64>> {
    let n = first.len();
    let places = (1..=LOOKS * n).map(|k| place(k, n));
    let mut looked: Vec<Best> =
        places.filter_map(|at| Some(Best { value: value(&at)?, at })).collect();
    looked.sort_by(|a, b| a.value.total_cmp(&b.value));
    looked.truncate(MOST);
    std::iter::once(first.to_vec()).chain(looked.into_iter().map(|best| best.at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_the_box() {
        for n in 1..4 {
            let places: Vec<Vec<f64>> = (1..=200).map(|k| place(k, n)).collect();
            for j in 0..n {
                for part in 0..10 {
                    let (lo, hi) = (f64::from(part) / 10.0, f64::from(part + 1) / 10.0);
                    let inside = places.iter().filter(|at| (lo..hi).contains(&at[j])).count();
                    assert!((15..=25).contains(&inside), "{inside} of 200 in {lo}..{hi}");
                }
            }
        }
    }
}
