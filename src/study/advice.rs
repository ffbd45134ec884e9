//! The one setting to use, given what is wanted.

use super::report::{RungResult, Study};

/// What is wanted of a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish {
    /// No error above this.
    pub within: Option<f64>,
    /// No more seconds a frame than this.
    pub in_time: Option<f64>,
}

/// What to use.
#[derive(Debug, Clone, PartialEq)]
pub enum Advice {
    /// The row, by its place, that grants the wish.
    Use(usize),
    /// None does; the one that comes nearest, if there is any.
    Nearest(Option<usize>),
}

impl Study {
    /// The setting that grants a wish: the fastest of those that are accurate enough, or the
    /// most accurate of those that are fast enough, and of equals the fastest.
    pub fn advice(&self, wish: Wish) -> Advice {
        let error = |row: &RungResult| row.error(self.measure).max(self.floor);
        let is_accurate =
            |row: &RungResult| wish.within.is_none_or(|most| row.error(self.measure) <= most);
        let is_fast =
            |row: &RungResult| wish.in_time.is_none_or(|most| row.seconds_per_frame <= most);
        let by_time = |row: &RungResult| (row.seconds_per_frame, error(row));
        let by_error = |row: &RungResult| (error(row), row.seconds_per_frame);
        let best = |may: &dyn Fn(&RungResult) -> bool, key: &dyn Fn(&RungResult) -> (f64, f64)| {
            let rows = self.rows.iter().enumerate().filter(|(_, row)| may(row));
            let rows = rows.map(|(k, row)| (k, key(row)));
            rows.min_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)))
                .map(|(k, _)| k)
        };
        let grants = |row: &RungResult| is_accurate(row) && is_fast(row);
        let found =
            if wish.within.is_some() { best(&grants, &by_time) } else { best(&grants, &by_error) };
        match (found, wish.within) {
            (Some(k), _) => Advice::Use(k),
            // As accurate as there is time for; without such, the fastest.
            (None, _) if wish.in_time.is_some() => {
                Advice::Nearest(best(&is_fast, &by_error).or_else(|| best(&|_| true, &by_time)))
            }
            (None, _) => Advice::Nearest(best(&|_| true, &by_error)),
        }
    }
}
