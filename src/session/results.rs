//! What a run was for: the values that `result` said.

use crate::diag::format_number;

/// What a run was for, by name; of what was said twice the last.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Results(Vec<(String, f64)>);

impl Results {
    /// Takes in a value; what had its name before is forgotten, but for its place.
    pub(super) fn set(&mut self, name: String, value: f64) {
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// The names and values, in the order in which they were said first.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// The value of this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// Whether nothing was said.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Roughly how many bytes it holds.
    pub(super) fn n_bytes(&self) -> usize {
        self.0.iter().map(|(name, _)| 32 + name.len()).sum()
    }
}

/// A result as it is printed.
pub(super) fn line(name: &str, value: f64) -> String {
    format!("{name} = {}", format_number(value))
}
