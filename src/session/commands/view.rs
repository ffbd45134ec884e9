//! `view`: a page at which the session is looked at.

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::session::execution::Execution;
use crate::session::host::reason;

impl Execution<'_> {
    /// Lets a page look at the session, and says where it is.
    pub(crate) fn view(&mut self, span: Span) -> Result<(), Diagnostic> {
        match self.host.view() {
            Ok(address) => self.host.print(&address),
            Err(e) => {
                let why = match e.kind() {
                    std::io::ErrorKind::Unsupported => "there is no session here to look at".into(),
                    _ => reason(&e),
                };
                return Err(Diagnostic::error(errors::NO_PAGE, "no page can be shown")
                    .at(span, why)
                    .help("`linkwork view FILE` begins a session with one"));
            }
        }
        Ok(())
    }
}
