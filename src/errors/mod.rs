//! Every kind of error: its code, and what `help E0123` says of it.
//!
//! A kind is one way to go wrong and one way out of it; messages of one kind differ in the words
//! that fit the place. A code never changes its meaning: programs and notes of users keep it.

mod constraints;
mod files;
mod names;
mod running;
mod text;
mod values;

pub use constraints::*;
pub use files::*;
pub use names::*;
pub use running::*;
pub use text::*;
pub use values::*;

use crate::diag::Code;

/// A kind of error, explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    /// The code that messages of this kind carry.
    pub code: Code,
    /// What is wrong, in one line.
    pub title: &'static str,
    /// Why it is wrong and what to do.
    pub help: &'static str,
    /// Statements of which the last goes wrong so; empty where that takes more than statements.
    pub wrong: &'static str,
    /// The same, put right; may be empty.
    pub right: &'static str,
}

/// Declares kinds of errors: a constant for each code, and the table of them.
macro_rules! kinds {
    ($($number:literal $name:ident {
        title: $title:literal,
        help: $help:expr,
        wrong: $wrong:expr,
        right: $right:expr,
    })+) => {
        $(
            #[doc = $title]
            pub const $name: $crate::diag::Code = $crate::diag::Code::new($number);
        )+

        pub(super) const KINDS: &[$crate::errors::Kind] = &[
            $($crate::errors::Kind {
                code: $name,
                title: $title,
                help: $help,
                wrong: $wrong,
                right: $right,
            },)+
        ];
    };
}
use kinds;

/// Every kind, in the order of the codes.
pub fn all() -> impl Iterator<Item = &'static Kind> {
    let tables = [
        text::KINDS,
        names::KINDS,
        values::KINDS,
        constraints::KINDS,
        running::KINDS,
        files::KINDS,
    ];
    tables.into_iter().flatten()
}

/// The kind with a code as a user types it: `E0201`, `e201`.
///
/// ```
/// use linkwork::errors;
///
/// let kind = errors::explained("E0201").expect("it is known");
/// assert_eq!(kind.code, errors::UNKNOWN_NAME);
/// ```
pub fn explained(word: &str) -> Option<&'static Kind> {
    let number = word.strip_prefix(['E', 'e'])?.parse().ok()?;
    all().find(|kind| kind.code == Code::new(number))
}
