//! Questions that take some work: `limits`, `effects`.

use super::{Diagnostic, Session};
use crate::lang::ast::Name;

impl Session {
    pub(super) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`limits` is not there yet").at(name.span, ""))
    }
    pub(super) fn effects(&mut self) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`effects` is not there yet"))
    }
}
