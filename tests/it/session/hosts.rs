//! Hosts that stand before others: what lies outside of a session is asked of the one behind, and what
//! is said stays where it was said.

use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Clock, Host, Kept, Spool, Wish};

/// Notes what it is asked, and answers in its own way.
#[derive(Default)]
struct Probe {
    asked: RefCell<Vec<&'static str>>,
}

impl Probe {
    fn note(&self, what: &'static str) {
        self.asked.borrow_mut().push(what);
    }
}

impl Host for Probe {
    fn print(&mut self, _line: &str) {
        self.note("print");
    }

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {
        self.note("tell");
    }

    fn is_keeping(&self) -> bool {
        self.note("is_keeping");
        true
    }

    fn keep(&mut self, _kept: Kept<'_>) {
        self.note("keep");
    }

    fn is_interrupted(&self) -> bool {
        self.note("is_interrupted");
        true
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        self.note("wish_to_stop");
        Some(Rc::new(|| true))
    }

    fn forget_stop(&mut self) {
        self.note("forget_stop");
    }

    fn resolve(&self, _path: &Path) -> io::Result<PathBuf> {
        self.note("resolve");
        Ok("resolved".into())
    }

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        self.note("read");
        Ok("text".to_owned())
    }

    fn find(&self, _folder: &Path, _path: &Path) -> io::Result<PathBuf> {
        self.note("find");
        Ok("found".into())
    }

    fn opening(&mut self, _path: &Path) -> io::Result<Option<Vec<u8>>> {
        self.note("opening");
        Ok(Some(vec![7]))
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        self.note("write");
        Ok(())
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        self.note("spool");
        Ok(Box::new(Vec::new()))
    }

    fn seconds(&self) -> Option<f64> {
        self.note("seconds");
        Some(3.0)
    }

    fn clock(&self) -> Option<Clock> {
        self.note("clock");
        Some(Rc::new(|| 3.0))
    }
}

/// Says nothing on; all else is that of the host behind.
struct Before<'a>(&'a mut dyn Host);

impl Host for Before<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&*self.0)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut *self.0)
    }

    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}
}

/// Nothing is behind it.
struct Alone;

impl Host for Alone {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}
}

/// What everything that lies outside is answered with.
fn ask_all(host: &mut dyn Host) -> String {
    let path = Path::new("a");
    host.print("line");
    host.tell(&Diagnostic::note_only("note"), &Sources::new());
    host.keep(Kept::Done("step"));
    host.forget_stop();
    let wish = host.wish_to_stop().map(|wish| wish());
    let clock = host.clock().map(|clock| clock());
    format!(
        "{:?}",
        (
            (host.is_keeping(), host.is_interrupted(), wish, clock, host.seconds()),
            (host.resolve(path).ok(), host.find(path, path).ok(), host.read(path).ok()),
            (host.opening(path).ok(), host.write(path, b"it").is_ok(), host.spool().is_ok()),
        )
    )
}

#[test]
fn what_lies_outside_is_asked_of_the_host_behind() {
    let (mut probe, mut behind) = (Probe::default(), Probe::default());
    let answers = ask_all(&mut probe);
    assert_eq!(ask_all(&mut Before(&mut Before(&mut behind))), answers);
    // All of it, and nothing of what was said.
    let mut asked = probe.asked.into_inner();
    asked.retain(|what| !["print", "tell"].contains(what));
    assert_eq!(behind.asked.into_inner(), asked);
    assert_eq!(asked.len(), 13);
}

#[test]
fn with_nothing_behind_there_is_nothing_outside() {
    assert_eq!(
        ask_all(&mut Alone),
        "((false, false, None, None, None), (Some(\"a\"), Some(\"a/a\"), None), \
         (Some(None), false, true))"
    );
}
