//! Series of values, collected by `sample` for `plot`.

use std::sync::Arc;

/// The series by name, in order of their first values.
pub type SeriesList = Vec<(Arc<str>, Vec<f64>)>;

/// Roughly how many bytes some series hold.
pub fn n_bytes(all: &SeriesList) -> usize {
    all.iter().map(|(name, values)| 64 + name.len() + size_of_val(&**values)).sum()
}

/// Appends a value to a series, or takes its last one away; gives what takes that back: the
/// value that was taken away, or none.
pub fn swap_sample(all: &mut SeriesList, name: &Arc<str>, value: Option<f64>) -> Option<f64> {
    let at = all.iter().position(|(known, _)| known == name);
    let Some(value) = value else {
        let at = at.expect("a value was appended to it before");
        let old = all[at].1.pop();
        if all[at].1.is_empty() {
            all.remove(at);
        }
        return old;
    };
    match at {
        Some(at) => all[at].1.push(value),
        None => all.push((name.clone(), vec![value])),
    }
    None
}
