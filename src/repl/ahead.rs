//! What was typed ahead of the prompt, while the terminal was being asked something.

use crate::lang::is_incomplete;

/// Lines that were entered, and the beginning of the next.
#[derive(Debug, Default)]
pub struct Ahead(String);

impl Ahead {
    /// More was typed.
    pub fn push(&mut self, typed: &str) {
        self.0.push_str(typed);
    }

    /// The next that was entered, to its end.
    pub fn next_entered(&mut self) -> Option<String> {
        let ends = self.0.match_indices('\n').map(|(at, _)| at);
        let end = ends.into_iter().find(|&end| !is_incomplete(&self.0[..end]))?;
        let rest = self.0.split_off(end + 1);
        let mut entered = std::mem::replace(&mut self.0, rest);
        entered.truncate(end);
        Some(entered)
    }

    /// What is not entered yet.
    pub fn take_begun(&mut self) -> String {
        std::mem::take(&mut self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_entered_whole() {
        let mut ahead = Ahead::default();
        ahead.push("let r = 3\nfor i in 1..2 {\n");
        assert_eq!(ahead.next_entered().as_deref(), Some("let r = 3"));
        assert_eq!(ahead.next_entered(), None);
        ahead.push("r }\n\npri");
        assert_eq!(ahead.next_entered().as_deref(), Some("for i in 1..2 {\nr }"));
        assert_eq!(ahead.next_entered().as_deref(), Some(""));
        assert_eq!((ahead.next_entered(), ahead.take_begun()), (None, "pri".to_owned()));
        assert_eq!(ahead.take_begun(), "");
    }
}
