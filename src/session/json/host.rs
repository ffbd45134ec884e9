//! A host that speaks in objects: what goes through it becomes JSON, one object a line.

use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::objects;
use crate::diag::{Diagnostic, Sources};
use crate::interrupt::Wish;
use crate::session::finding::Finding;
use crate::session::host::{Clock, Done, Host};
use crate::session::spool::Spool;

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
        Self { host, n_statements: 0 }
    }

    /// Says one more.
    pub(super) fn put(&mut self, object: &Value) {
        self.host.print(&object.to_string());
    }
}

impl Host for Objects<'_> {
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

    fn is_interrupted(&self) -> bool {
        self.host.is_interrupted()
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        self.host.wish_to_stop()
    }

    fn forget_stop(&mut self) {
        self.host.forget_stop();
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        self.host.resolve(path)
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        self.host.read(path)
    }

    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        self.host.find(folder, path)
    }

    fn opening(&mut self, path: &Path) -> io::Result<Option<Vec<u8>>> {
        self.host.opening(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.host.write(path, bytes)
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.host.write_in_pieces(path, content)
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        self.host.spool()
    }

    fn seconds(&self) -> Option<f64> {
        self.host.seconds()
    }

    fn clock(&self) -> Option<Clock> {
        self.host.clock()
    }
}
