//! Questions that take some work: `accuracy`.

use super::{Diagnostic, Session};
use crate::diag::Span;
use crate::lang::ast::Promise;

impl Session {
    pub(super) fn accuracy(&mut self, _promise: &Promise, span: Span) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`accuracy` is not there yet").at(span, ""))
    }
}
