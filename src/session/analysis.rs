//! Questions that take some work: `check`, `why`, `limits`, `effects`.

use super::{Diagnostic, Session};
use crate::lang::ast::Name;

impl Session {
    pub(super) fn check(&mut self) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`check` is not there yet"))
    }
    pub(super) fn why(&mut self, name: &Name) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`why` is not there yet").at(name.span, ""))
    }
    pub(super) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`limits` is not there yet").at(name.span, ""))
    }
    pub(super) fn effects(&mut self) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`effects` is not there yet"))
    }
}
