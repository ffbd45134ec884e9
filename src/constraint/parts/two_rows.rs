//! Two linearised equations met at once.

use crate::constraint::{PointIdx, Row, Vector};

/// Rows nearer to parallel than this, as one less the cosine between them, are taken for one: the
/// difference of what they ask for would be divided by it.
const PARALLEL: f64 = 1e-6;

/// The shortest displacement that satisfies both of two linearised equations: the general form of
/// the paper's `A_a` for a vector equation that is not linear. Where the two ask for the same
/// direction, what is nearest to both.
pub(crate) fn correct(rows: &[Row; 2], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
    let norms = rows.each_ref().map(|row| row.norm_squared(w).sqrt());
    let [first, second] = rows;
    if norms[0] == 0.0 || norms[1] == 0.0 {
        return if norms[0] == 0.0 { second } else { first }.correct(w, move_by);
    }
    let gradient = |row: &Row, p| {
        let term = row.terms().find(|(q, _)| *q == p);
        term.map_or(Vector::ZERO, |(_, g)| g)
    };
    let product: f64 = first.terms().map(|(p, g)| w[p as usize] * g.dot(gradient(second, p))).sum();
    let cosine = product / (norms[0] * norms[1]);
    // The unit rows have the Gram matrix (1, c; c, 1): its eigenvectors are their sum and their
    // difference.
    let [f, h] = [first.f / norms[0], second.f / norms[1]];
    let along = |value: f64, eigenvalue: f64| {
        if eigenvalue > PARALLEL { 0.5 * value / eigenvalue } else { 0.0 }
    };
    let (sum, difference) = (along(f + h, 1.0 + cosine), along(f - h, 1.0 - cosine));
    let k = [-(sum + difference) / norms[0], -(sum - difference) / norms[1]];
    let others = second.terms().filter(|(p, _)| !first.terms().any(|(q, _)| q == *p));
    for (p, _) in first.terms().chain(others).filter(|&(p, _)| w[p as usize] > 0.0) {
        move_by(p, (gradient(first, p) * k[0] + gradient(second, p) * k[1]) * w[p as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corrected(rows: [Row; 2], w: &[f64]) -> [Vector; 2] {
        let mut d = [Vector::ZERO; 2];
        correct(&rows, w, &mut |p, v| d[p as usize] += v);
        d
    }

    #[test]
    fn both_are_met_by_the_shortest_way() {
        // x = 3 and x + y = 1, then the second for another point too.
        let [ex, diagonal] = [Vector::new(1.0, 0.0), Vector::new(1.0, 1.0)];
        let rows = [Row::new(-3.0).with(0, ex), Row::new(-1.0).with(0, diagonal)];
        assert!((corrected(rows, &[1.0])[0] - Vector::new(3.0, -2.0)).norm() < 1e-14);
        let rows = [rows[0], rows[1].with(1, diagonal)];
        let [a, b] = corrected(rows, &[1.0, 2.0]);
        // The rest of -2 is shared by y of the first and both of the second, by weight.
        assert!((a - Vector::new(3.0, -0.4)).norm() < 1e-14, "{a:?}");
        assert!((b - Vector::new(-0.8, -0.8)).norm() < 1e-14, "{b:?}");
    }

    #[test]
    fn rows_that_ask_for_one_direction_are_met_halfway() {
        let g = Vector::new(0.0, 1.0);
        let rows = [Row::new(-1.0).with(0, g), Row::new(-6.0).with(0, g * 2.0)];
        assert_eq!(corrected(rows, &[1.0])[0], Vector::new(0.0, 2.0));
    }
}
