//! Which share of each pixel an area covers, exactly for straight edges.
//!
//! Each edge adds to the pixels that it crosses how much area it has on its right, so that sums along
//! rows give the covered shares: the way of the font renderers (R. Levien, font-rs, 2016).

use std::ops::Range;

use super::image::{Paint, Pixels};
use crate::constraint::Point;
use crate::interrupt::tick;

/// What of overlapping areas counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// All of it.
    NonZero,
    /// What an odd number of them covers.
    EvenOdd,
}

/// The shares of pixels that were covered since the last time something was painted.
pub struct Coverage {
    width: usize,
    height: usize,
    /// Differences along rows, two more than there are pixels in each.
    steps: Vec<f32>,
    /// The rows that are touched.
    rows: Range<usize>,
}

impl Coverage {
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, steps: vec![0.0; (width + 2) * height], rows: height..0 }
    }

    /// Adds the area within a chain of points, closed.
    pub fn add(&mut self, points: &[Point]) {
        let Some(last) = points.last() else { return };
        let mut from = *last;
        for &to in points {
            self.add_edge(from, to);
            from = to;
        }
    }

    /// Adds a convex area, whichever way round it is given: overlapping ones are one.
    pub fn add_convex(&mut self, points: &mut [Point]) {
        let area: f64 = points
            .iter()
            .zip(points.iter().cycle().skip(1))
            .map(|(p, q)| p.to_vector().cross(q.to_vector()))
            .sum();
        if area < 0.0 {
            points.reverse();
        }
        self.add(points);
    }

    fn add_edge(&mut self, from: Point, to: Point) {
        if from.y == to.y || !from.is_finite() || !to.is_finite() {
            return;
        }
        let (sign, top, bottom) = if from.y < to.y { (1.0, from, to) } else { (-1.0, to, from) };
        let first = top.y.max(0.0);
        let last = bottom.y.min(self.height as f64);
        if first >= last {
            return;
        }
        let slope = (bottom.x - top.x) / (bottom.y - top.y);
        let rows = first as usize..last.ceil() as usize;
        self.rows = self.rows.start.min(rows.start)..self.rows.end.max(rows.end);
        for row in rows {
            let (upper, lower) = (first.max(row as f64), last.min((row + 1) as f64));
            let x = |y: f64| (top.x + slope * (y - top.y)).clamp(0.0, self.width as f64);
            let (a, b) = (x(upper), x(lower));
            self.add_within_row(row, a.min(b), a.max(b), (sign * (lower - upper)) as f32);
        }
    }

    /// Adds the part of an edge in one row, from `left` to `right`, of this signed height.
    fn add_within_row(&mut self, row: usize, left: f64, right: f64, height: f32) {
        let steps = &mut self.steps[row * (self.width + 2)..][..self.width + 2];
        let first = left as usize;
        let end = (right.ceil() as usize).max(first + 1);
        if end == first + 1 {
            // Within one pixel: how much of it lies on the right.
            let share = (1.0 - (0.5 * (left + right) - first as f64)) as f32;
            steps[first] += height * share;
            steps[first + 1] += height * (1.0 - share);
            return;
        }
        // The area on its right grows quadratically where it enters and leaves, in between evenly.
        let per_column = 1.0 / (right - left);
        let covered = |x: f64| {
            let inside = (x - left).max(0.0);
            let beyond = (x - right).max(0.0);
            0.5 * per_column * (inside * inside - beyond * beyond)
        };
        let mut area = 0.0;
        let mut share = 0.0;
        for (step, column) in steps[first..=end].iter_mut().zip(first..) {
            let next_area = covered((column + 1) as f64);
            let next = next_area - area;
            *step += height * (next - share) as f32;
            (area, share) = (next_area, next);
        }
    }

    /// Paints what was added, and forgets it; gives the rows that it may have touched.
    pub fn paint(&mut self, paint: Paint, rule: Rule, onto: &mut Pixels) -> Range<usize> {
        let rows = std::mem::replace(&mut self.rows, self.height..0);
        for row in rows.clone() {
            tick(self.width);
            let steps = &mut self.steps[row * (self.width + 2)..][..self.width + 2];
            let pixels = onto.row_mut(row);
            let mut sum = 0.0;
            for (step, pixel) in steps.iter().zip(pixels.chunks_exact_mut(3)) {
                sum += step;
                let share = match rule {
                    Rule::NonZero => sum.abs().min(1.0),
                    Rule::EvenOdd => (sum - 2.0 * (0.5 * sum).round()).abs(),
                };
                // Less than half a step of a colour is rounding.
                if share > 0.002 {
                    let alpha = share * paint.opacity;
                    for (below, over) in pixel.iter_mut().zip(paint.rgb) {
                        let (below_, over) = (f32::from(*below), f32::from(over));
                        *below = (below_ + (over - below_) * alpha).round() as u8;
                    }
                }
            }
            steps.fill(0.0);
        }
        rows
    }
}
