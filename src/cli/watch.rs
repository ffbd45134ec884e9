//! `linkwork watch`: runs a script again whenever it, or a file that it reads, is saved.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use super::args::{HostArguments, WatchArguments};
use super::process_host::ProcessHost;
use super::run::{self, ExitStatus};
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Sources};
use crate::render::Sketch;
use crate::session::{Clock, Host, Kept, Spool, Wish};

/// How long a change goes unnoticed at most: short beside the time it takes to look up.
const PAUSE: Duration = Duration::from_millis(100);

/// Runs the script again and again, until the user stops it.
pub fn watch(arguments: &WatchArguments) -> ExitStatus {
    let file = &arguments.file;
    loop {
        output::clear_page();
        let mut host = WatchingHost::new(&arguments.host, files::folder_of(file));
        host.watch(file);
        let mut session = run::begin(&arguments.host);
        run::script(file, &mut session, &mut host);
        if !arguments.host.quiet {
            let files = host.seen.len();
            let what = if files == 1 {
                "it changes".to_owned()
            } else {
                format!("one of {files} files changes")
            };
            output::remark(&format!("-- {} runs again when {what}; Ctrl-C ends", file.display()));
        }
        output::flush();
        while !host.has_changed() {
            if interrupt::is_asked() {
                return ExitStatus::Interrupted;
            }
            sleep(PAUSE);
        }
    }
}

/// A process that notes which files are read, and when they were written.
struct WatchingHost {
    process: ProcessHost,
    seen: BTreeMap<PathBuf, Stamp>,
}

/// When a file was written and how long it is; none while it is missing.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(file: &Path) -> Stamp {
    let about = std::fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl WatchingHost {
    fn new(arguments: &HostArguments, folder: &Path) -> Self {
        Self { process: ProcessHost::new(arguments, folder), seen: BTreeMap::new() }
    }

    /// Notes how a file is before it is read: a change that comes while it is read is one.
    fn watch(&mut self, file: &Path) {
        self.seen.entry(file.to_path_buf()).or_insert_with(|| stamp(file));
    }

    fn has_changed(&self) -> bool {
        self.seen.iter().any(|(file, seen)| stamp(file) != *seen)
    }
}

impl Host for WatchingHost {
    fn print(&mut self, line: &str) {
        self.process.print(line);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.process.tell(what, sources);
    }

    fn page(&self) -> (usize, usize) {
        self.process.page()
    }

    fn draw(&mut self, sketch: &Sketch) {
        self.process.draw(sketch);
    }

    fn n_printed(&self) -> u64 {
        self.process.n_printed()
    }

    fn is_listening(&self) -> bool {
        self.process.is_listening()
    }

    fn is_keeping(&self) -> bool {
        self.process.is_keeping()
    }

    fn keep(&mut self, kept: Kept<'_>) {
        self.process.keep(kept);
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        self.process.wish_to_stop()
    }

    fn forget_stop(&mut self) {
        self.process.forget_stop();
    }

    fn is_interrupted(&self) -> bool {
        self.process.is_interrupted()
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        self.process.resolve(path)
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        self.watch(path);
        self.process.read(path)
    }

    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        self.process.find(folder, path)
    }

    fn opening(&mut self, path: &Path) -> io::Result<Option<Vec<u8>>> {
        self.process.opening(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.process.write(path, bytes)
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.process.write_in_pieces(path, content)
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        self.process.spool()
    }

    fn progress(&self, share: f64) {
        self.process.progress(share);
    }

    fn seconds(&self) -> Option<f64> {
        self.process.seconds()
    }

    fn clock(&self) -> Option<Clock> {
        self.process.clock()
    }
}
