//! A host that speaks in objects: what goes through it becomes JSON, one object a line.

use std::io;
use std::path::Path;

use serde_json::Value;

use super::objects;
use crate::diag::{Diagnostic, Sources};
use crate::session::finding::Finding;
use crate::session::host::{Done, Host};

/// Objects in front of a host: its files, its clock and its wish to stop are that host's, and what it
/// prints are objects.
pub struct Objects<'a> {
    host: &'a mut dyn Host,
    n_statements: u64,
}

impl<'a> Objects<'a> {
    /// Begins a stream of objects.
    pub fn new(host: &'a mut dyn Host) -> Self {
        host.print(&objects::opening().to_string());
        Self::going_on(host)
    }

    /// Goes on with a stream that was begun.
    pub fn going_on(host: &'a mut dyn Host) -> Self {
        Self { host, n_statements: 0 }
    }

    /// Says one more.
    pub(super) fn put(&mut self, object: &Value) {
        self.host.print(&object.to_string());
    }
}

impl Host for Objects<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&*self.host)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut *self.host)
    }

    fn print(&mut self, line: &str) {
        self.put(&objects::line(line));
    }

    fn n_printed(&self) -> u64 {
        self.host.n_printed()
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.put(&objects::diagnostic(what, sources));
    }

    fn takes_findings(&self) -> bool {
        true
    }

    fn find_out(&mut self, finding: &Finding) {
        self.put(&objects::finding(finding));
    }

    fn done(&mut self, done: &Done) {
        self.n_statements += 1;
        let text = done.sources.slice(done.span);
        let place = objects::place(done.span, done.sources);
        self.put(&objects::statement(self.n_statements, text, &place, done.is_ok, done.world));
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.host.write_in_pieces(path, content)
    }
}
