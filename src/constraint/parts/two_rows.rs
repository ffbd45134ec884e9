//! Two linearised equations met at once.

use crate::constraint::{PointIdx, Row, Vector};

/// Two rows with a smaller square of the sine between them are taken for one. It is known to 1e-16: at
/// the bound, where they are at a millionth of a radian, the displacement is known to 1e-4, and the
/// next one mends that. A larger bound leaves unmet what can be met; a much smaller one follows
/// rounding.
const PARALLEL: f64 = 1e-12;

/// Two equations, by what the shortest displacement that meets them depends on.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pair {
    /// Their values.
    pub values: [f64; 2],
    /// The products of their gradients in the metric of the weights: of the first with itself, of
    /// both, of the second with itself.
    pub products: [f64; 3],
}

/// The displacement `-W J^T m` that meets two equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shortest {
    /// Its length in the metric of the weights.
    pub length: f64,
    /// The numbers m.
    pub multipliers: [f64; 2],
}

impl Pair {
    fn of(rows: &[Row; 2], w: &[f64]) -> Self {
        let [first, second] = rows;
        let product: f64 =
            first.terms().map(|(p, g)| w[p as usize] * g.dot(gradient(second, p))).sum();
        let products = [first.norm_squared(w), product, second.norm_squared(w)];
        Self { values: [first.f, second.f], products }
    }

    /// The shortest displacement that meets both. Where the two are one what they ask for together
    /// is met, and what they contradict each other in is a part of the length as it is.
    pub fn shortest(&self) -> Shortest {
        let ([f, g], [a, b, c]) = (self.values, self.products);
        if !(a * c).is_finite() {
            // Squares beyond what numbers hold lead nowhere.
            return Shortest { length: Vector::new(f, g).norm(), multipliers: [0.0; 2] };
        }
        let det = a * c - b * b;
        if det > PARALLEL * a * c {
            let multipliers = [(c * f - b * g) / det, (a * g - b * f) / det];
            let squared = f * multipliers[0] + g * multipliers[1];
            return Shortest { length: squared.max(0.0).sqrt(), multipliers };
        }
        // The direction of the values that can be changed, and the other.
        let half = 0.5 * (a - c);
        let along = Vector::polar(1.0, 0.5 * libm::atan2(b, half));
        let size = 0.5 * (a + c) + Vector::new(half, b).norm();
        let f = Vector::new(f, g);
        if size == 0.0 {
            return Shortest { length: f.norm(), multipliers: [0.0; 2] };
        }
        let part = f.dot(along);
        let length = Vector::new(part / size.sqrt(), f.dot(along.perp())).norm();
        let multipliers = along * (part / size);
        Shortest { length, multipliers: [multipliers.x, multipliers.y] }
    }
}

fn gradient(row: &Row, p: PointIdx) -> Vector {
    row.terms().find(|(q, _)| *q == p).map_or(Vector::ZERO, |(_, g)| g)
}

/// The shortest displacement that satisfies both of two linearised equations: the general form of
/// the paper's `A_a` for a vector equation that is not linear. Where the two ask for the same
/// direction, what is nearest to both.
pub(crate) fn correct(rows: &[Row; 2], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
    let [first, second] = rows;
    let [k, l] = Pair::of(rows, w).shortest().multipliers;
    let others = second.terms().filter(|(p, _)| !first.terms().any(|(q, _)| q == *p));
    for (p, _) in first.terms().chain(others).filter(|&(p, _)| w[p as usize] > 0.0) {
        move_by(p, (gradient(first, p) * k + gradient(second, p) * l) * -w[p as usize]);
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

    /// x = 3 and x cos a + y sin a = 1: the point where two lines meet at an angle a.
    #[test]
    fn lines_meet_where_they_do_however_nearly_parallel() {
        for angle in [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5_f64] {
            let g = Vector::new(libm::cos(angle), libm::sin(angle));
            // The second in another unit, which changes nothing.
            for unit in [1.0, 1e9] {
                let rows = [
                    Row::new(-3.0).with(0, Vector::new(1.0, 0.0)),
                    Row::new(-unit).with(0, g * unit),
                ];
                let meet = Vector::new(3.0, (1.0 - 3.0 * g.x) / g.y);
                // The determinant is the square of the sine, and known to the last bit of 1.
                let known = 4.0 * f64::EPSILON / (g.y * g.y) * meet.norm();
                assert!((corrected(rows, &[1.0])[0] - meet).norm() <= known, "at {angle}");
                let length = Pair::of(&rows, &[1.0]).shortest().length;
                assert!((length - meet.norm()).abs() <= known, "at {angle}: {length}");
            }
        }
    }

    #[test]
    fn a_row_that_nothing_moves_leaves_the_other_as_it_is() {
        let rows = [Row::new(-2.0).with(0, Vector::new(0.0, 1.0)), Row::new(5.0)];
        assert_eq!(corrected(rows, &[1.0])[0], Vector::new(0.0, 2.0));
        assert_eq!(Pair::of(&rows, &[1.0]).shortest().length, 29.0_f64.sqrt());
    }

    #[test]
    fn rows_that_ask_for_one_direction_are_met_halfway() {
        let g = Vector::new(0.0, 1.0);
        let rows = [Row::new(-1.0).with(0, g), Row::new(-3.0).with(0, g)];
        assert!((corrected(rows, &[1.0])[0] - Vector::new(0.0, 2.0)).norm() < 1e-15);
    }
}
