//! Takes what a session says while a page has it do something, for the page.

use std::io;
use std::path::Path;

use serde_json::{Value, json};

use super::units::to_utf16;
use crate::diag::{Diagnostic, Paint, Severity, SourceId, Sources, render};
use crate::session::Host;

/// A host that keeps what is said, and hands on the rest.
pub struct Listener<'a> {
    inner: &'a mut dyn Host,
    /// What was said, as the page is told.
    pub said: Vec<Value>,
    /// Files that were written, where [`Host::resolve`] puts them.
    pub wrote: Vec<String>,
    /// The text that the page sent, if places in it are to be told.
    pub source: Option<SourceId>,
    n_bytes: u64,
}

/// Bytes of an answer beyond which no more lines are taken.
const MOST_BYTES: u64 = 1 << 20;

impl<'a> Listener<'a> {
    /// Nothing was said yet.
    pub fn new(inner: &'a mut dyn Host) -> Self {
        Self { inner, said: Vec::new(), wrote: Vec::new(), source: None, n_bytes: 0 }
    }
}

/// A note, a warning or an error, as a page is told; with its place if it lies in `source`.
pub fn told(what: &Diagnostic, sources: &Sources, source: Option<SourceId>) -> Value {
    let kind = match what.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let mut told = json!({
        "kind": kind,
        "text": render(what, sources, Paint::Plain),
        "message": &*what.message,
    });
    if let Some(code) = &what.code {
        told["code"] = json!(code.to_string());
    }
    if !what.helps.is_empty() {
        told["helps"] = json!(what.helps);
    }
    let place = what.place().filter(|place| Some(place.source) == source);
    if let Some((place, text)) = place.and_then(|it| Some((it, &sources.get(it.source)?.text))) {
        told["from"] = json!(to_utf16(text, place.range().start));
        told["to"] = json!(to_utf16(text, place.range().end));
    }
    told
}

/// What answers a wish that is not granted.
pub fn refused(why: &str) -> Value {
    json!({ "ok": false, "said": [{ "kind": "error", "text": why }] })
}

impl Host for Listener<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&*self.inner)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut *self.inner)
    }

    fn print(&mut self, line: &str) {
        let before = self.n_bytes;
        self.n_bytes += line.len() as u64 + 1;
        if self.n_bytes <= MOST_BYTES {
            self.said.push(json!({ "kind": "line", "text": line }));
        } else if before <= MOST_BYTES {
            self.said
                .push(json!({ "kind": "warning", "text": "the rest is too long to be shown" }));
        }
    }

    fn n_printed(&self) -> u64 {
        self.n_bytes
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.said.push(told(what, sources, self.source));
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.inner.write(path, bytes)?;
        self.wrote.push(path.display().to_string());
        Ok(())
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.inner.write_in_pieces(path, content)?;
        self.wrote.push(path.display().to_string());
        Ok(())
    }

    fn view(&mut self) -> io::Result<String> {
        self.inner.view()
    }
}
