//! Questions that take some work: `limits`.

use super::{Diagnostic, Session};
use crate::lang::ast::Name;

impl Session {
    pub(super) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        Err(Diagnostic::error("`limits` is not there yet").at(name.span, ""))
    }
}
