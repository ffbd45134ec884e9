//! The process as a session sees it while it works for pages.

use std::io::{self, Write};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use super::shared::Shared;
use crate::diag::{Diagnostic, Sources};
use crate::session::{Host, Wish};

/// Files, clock and journal are those of the process; a page may stop what it asked for.
pub struct PageHost<'a> {
    pub process: &'a mut (dyn Host + Send),
    pub shared: Arc<Shared>,
    /// Where the page is.
    pub address: &'a str,
}

impl Host for PageHost<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&*self.process)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut *self.process)
    }

    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_interrupted(&self) -> bool {
        self.shared.is_stopped() || self.process.is_interrupted()
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        let (shared, process) = (self.shared.clone(), self.process.wish_to_stop());
        Some(Rc::new(move || shared.is_stopped() || process.as_ref().is_some_and(|wish| wish())))
    }

    fn forget_stop(&mut self) {
        self.shared.forget_stop();
        self.process.forget_stop();
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.process.write_in_pieces(path, content)
    }

    fn view(&mut self) -> io::Result<String> {
        Ok(self.address.to_owned())
    }
}
