//! Parts that statements of several commands have.

use std::sync::Arc;

use super::expr::{Expr, Name};
use crate::diag::Span;

/// Some names, or every one there is.
#[derive(Debug, Clone, PartialEq)]
pub enum Selection {
    /// `all`
    All,
    /// At least one name.
    Names(Vec<Name>),
}

/// What a run promises for each of its frames: a broken one is a failure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Promise {
    /// `within e`: the tolerance that each frame reaches.
    pub within: Option<Expr>,
    /// `in e`: the wall time that no frame exceeds.
    pub in_time: Option<Expr>,
}

/// A string literal.
#[derive(Debug, Clone)]
pub struct Text {
    /// What it says, escapes resolved.
    pub value: Arc<str>,
    /// With its quotes.
    pub span: Span,
}

impl PartialEq for Text {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
