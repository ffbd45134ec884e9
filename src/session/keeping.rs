//! What a session tells its host's journal: each statement as it is carried out, and how far `undo` went
//! back, so that what it writes is as much as what a command changed.

use std::ops::Range;

use super::execution::Flow;
use super::host::{Host, Kept};
use super::quotas::Quota;
use super::undo::told::{Deed, FileRead, Place, Told, Walk, restored_stop};
use super::{Session, transcript};
use crate::lang::ast::Statement;

impl Session {
    /// Tells the host's journal all there is: what follows is told statement by statement.
    pub fn keep_whole(&mut self, host: &mut dyn Host) {
        if host.is_keeping() {
            self.begin_journal(&self.to_script(), host);
        }
    }

    fn begin_journal(&mut self, script: &str, host: &mut dyn Host) {
        let told = &mut self.history.told;
        *told = Place { journal: told.journal + 1, texts: 0, bytes: 0 };
        host.keep(Kept::Whole(script));
    }

    /// Remembers a statement that was typed and carried out, for `history` and the host's journal.
    pub(super) fn note_typed(&mut self, statement: &Statement, flow: Flow, host: &mut dyn Host) {
        if !self.has_stayed(flow) {
            return;
        }
        // Who asks for a turn has it counted from then on.
        let leaves_a_mark = transcript::leaves_a_mark(&statement.command) || self.input.is_change;
        let done = self.input.n_done.and_then(|n| transcript::what_was_done(&statement.command, n));
        let span = match done {
            Some(text) => self.input.add_whole("stopped", &text),
            None => statement.span,
        };
        self.input.note_typed(span, leaves_a_mark);
        if host.is_keeping() && leaves_a_mark {
            self.keep(statement, flow, host);
        }
    }

    /// Tells the host's journal of a statement.
    fn keep(&mut self, statement: &Statement, flow: Flow, host: &mut dyn Host) {
        let files = std::mem::take(&mut self.input.files_read);
        if let Some(walk) = self.input.walk {
            return match walk {
                Walk::Back(_) => self.keep_way_back(host),
                Walk::Forth(n) => self.keep_way_forth(n, host),
            };
        }
        if std::mem::take(&mut self.input.is_unrepeatable) {
            // Who stops once more must not lose what a stopped command did.
            host.forget_stop();
            return self.keep_whole(host);
        }
        let stopped_after = self.input.stopped_after.filter(|_| flow == Flow::Stopped);
        if let Some(way) = self.input.loaded.take() {
            host.forget_stop();
            let n_done = stopped_after.map(|n_done| n_done.saturating_sub(way.n_done_before));
            return match &*files {
                // What it made is all there is.
                [file, others @ ..] => {
                    self.begin_journal(&loaded(file, others, way.reached, n_done), host);
                }
                [] => self.keep_whole(host),
            };
        }
        let deed = Deed { statement: statement.span, stopped_after, files: files.into() };
        let text = deed.text(&self.input.sources);
        let at = self.history.told;
        if self.input.is_change
            && let Some(told) = self.history.journal.told_of_last()
        {
            *told = Some(Told { at, deed });
        }
        self.pass(&text, host);
    }

    /// Tells the host's journal a text that does what was done.
    fn pass(&mut self, text: &str, host: &mut dyn Host) {
        self.history.told.pass(text);
        if self.history.told.bytes > self.quota(Quota::SourceBytes) / 2 {
            // It could not be read any more.
            self.keep_whole(host);
        } else {
            host.keep(Kept::Done(text));
        }
    }

    /// Commands were taken back.
    fn keep_way_back(&mut self, host: &mut dyn Host) {
        let at = self.history.journal.told_of_next().map(|told| told.at);
        match at.filter(|at| at.journal == self.history.told.journal) {
            Some(at) => {
                self.history.told = at;
                host.keep(Kept::First(at.texts));
            }
            None => self.keep_whole(host),
        }
    }

    /// The last `n` commands were done again.
    fn keep_way_forth(&mut self, n: usize, host: &mut dyn Host) {
        host.forget_stop();
        let (mut at, mut texts) = (self.history.told, Vec::new());
        for told in self.history.journal.told_of_last_ones(n).map_while(Option::as_mut) {
            told.at = at;
            let text = told.deed.text(&self.input.sources);
            at.pass(&text);
            texts.push(text);
        }
        if texts.len() < n {
            // One of them cannot be repeated from its text, or is forgotten already.
            return self.keep_whole(host);
        }
        texts.iter().for_each(|text| self.pass(text, host));
    }
}

/// The text that makes what was loaded from a file: that of the file, behind those that it reads itself; up to
/// where `reached` ends where the user stopped it, the statement there when it had done so much.
fn loaded(
    file: &FileRead,
    others: &[FileRead],
    reached: Range<usize>,
    stopped_after: Option<u64>,
) -> String {
    let mut script = String::new();
    others.iter().for_each(|file| script.extend([&*file.restored(), "\n"]));
    match stopped_after {
        None => script.push_str(&file.text),
        // A stop that no statement follows would be taken for one of what is typed next.
        Some(_) if reached.is_empty() => {}
        Some(n_done) => {
            let stop = restored_stop(n_done);
            script.extend([&file.text[..reached.start], &*stop, &file.text[reached]]);
        }
    }
    if !script.ends_with('\n') {
        script.push('\n');
    }
    script
}
