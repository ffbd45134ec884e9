//! Questions that take some work: `limits`, `effects`, `accuracy`.

use super::{Diagnostic, Session};
use crate::diag::Span;
use crate::lang::ast::{Name, Promise};

impl Session {
    pub(super) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`limits` is not there yet").at(name.span, ""))
    }
    pub(super) fn effects(&mut self) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`effects` is not there yet"))
    }
    pub(super) fn accuracy(&mut self, _promise: &Promise, span: Span) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`accuracy` is not there yet").at(span, ""))
    }
}
