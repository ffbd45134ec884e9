//! Every command of the language with what `help` says of it.

mod constraints;
mod outside;
mod topics;
mod trade;

use super::commands::{FAMILIES, Verb};
use super::grammar::Rule;
pub use constraints::{ConstraintWord, Pattern, Slot};
pub use outside::{OUTSIDE, Outside, outside};
pub use trade::{TRADE, Trade, trade, trade_words};

/// A command, or a subject that `help` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// The word a statement begins with, or the subject.
    pub keyword: &'static str,
    /// Under which heading it stands.
    pub section: Section,
    /// How it is written; `[...]` may be left out, `...` is more of the same.
    pub usage: &'static str,
    /// What it does, in one line.
    pub summary: &'static str,
    /// What else there is to know; may be empty.
    pub help: &'static str,
    /// Statements that show it; each line parses.
    pub example: &'static str,
}

/// The headings, in the order of the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Section {
    /// Points and parameters.
    Points,
    /// The constraints.
    Constraints,
    /// Changing what is there.
    Changing,
    /// Letting it move.
    Running,
    /// Asking questions.
    Looking,
    /// Measuring.
    Measuring,
    /// Pictures and data.
    Pictures,
    /// Building big things from small ones.
    Building,
    /// Subjects that are no commands.
    Topics,
}

impl Section {
    /// Every heading, in order.
    pub const ALL: [Self; 9] = [
        Self::Points,
        Self::Constraints,
        Self::Changing,
        Self::Running,
        Self::Looking,
        Self::Measuring,
        Self::Pictures,
        Self::Building,
        Self::Topics,
    ];

    /// The heading.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Points => "points and parameters",
            Self::Constraints => "constraints",
            Self::Changing => "changing a live mechanism",
            Self::Running => "running",
            Self::Looking => "looking",
            Self::Measuring => "measuring",
            Self::Pictures => "pictures and data",
            Self::Building => "building big things",
            Self::Topics => "subjects",
        }
    }
}

/// Every command, in the order of the reference.
pub fn commands() -> impl Iterator<Item = &'static Entry> {
    let [making, others @ ..] = FAMILIES;
    let constraints = ConstraintWord::ALL.iter().map(|word| &word.pattern().entry);
    let entries = |verbs: &'static [Verb]| verbs.iter().map(|verb| &verb.entry);
    entries(making).chain(constraints).chain(others.into_iter().flat_map(entries))
}

/// The rule that reads statements beginning with a word.
pub(super) fn rule(word: &str) -> Option<Rule> {
    let verb = FAMILIES.into_iter().flatten().find(|verb| verb.entry.keyword == word);
    let constraint = || ConstraintWord::named(word).map(|word| word.pattern().rule);
    verb.map(|verb| verb.rule).or_else(constraint)
}

/// Every subject that `help` knows besides the commands.
pub fn topics() -> impl Iterator<Item = &'static Entry> {
    topics::TOPICS.iter()
}

/// The command or subject called `word`.
pub fn entry(word: &str) -> Option<&'static Entry> {
    commands().chain(topics()).find(|entry| entry.keyword == word)
}

/// The command or subject that says what a word means which begins none.
pub fn about(word: &str) -> Option<&'static Entry> {
    let has_part = |of: &&ConstraintWord| {
        let slots = of.pattern().slots.iter();
        let mut roles = slots.filter_map(|slot| match slot {
            Slot::Value(role) | Slot::Flag(role) => Some(role.word()),
            _ => None,
        });
        roles.any(|role| role == word)
    };
    if let Some(of) = ConstraintWord::ALL.iter().find(has_part) {
        return Some(&of.pattern().entry);
    }
    entry(match word {
        "frozen" => "point",
        "to" | "through" | "over" => "drag",
        "all" => "freeze",
        "in" => "relations",
        "cascade" => "delete",
        "within" => "assert",
        "every" => "trace",
        "stop" => "record",
        "as" => "use",
        "pi" | "tau" | "time" => "expressions",
        "units" | "deg" | "rad" | "rev" | "rpm" | "s" | "ms" => "numbers",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::SourceId;
    use crate::lang::parse;

    #[test]
    fn every_example_parses() {
        for entry in commands().chain(topics()) {
            for statement in parse(SourceId(0), entry.example) {
                let problem = statement.err().map(|problem| problem.message.clone());
                assert_eq!(problem, None, "in the example of `{}`", entry.keyword);
            }
        }
    }

    #[test]
    fn usages_begin_with_their_keyword() {
        for entry in commands() {
            let word = entry.usage.split(' ').next();
            assert_eq!(word, Some(entry.keyword));
        }
    }

    #[test]
    fn keywords_are_told_once() {
        let mut keywords: Vec<_> = commands().chain(topics()).map(|entry| entry.keyword).collect();
        keywords.sort_unstable();
        let n_all = keywords.len();
        keywords.dedup();
        assert_eq!(keywords.len(), n_all);
    }
}
