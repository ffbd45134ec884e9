//! Any text as a whole script: whatever it asks for, the world stays finite, an error leaves it
//! as it was, and what is saved loads as the same.
#![no_main]

use std::cell::Cell;
use std::io;
use std::path::{Path, PathBuf};

use libfuzzer_sys::fuzz_target;
use linkwork::diag::{Diagnostic, Sources};
use linkwork::lang::parse;
use linkwork::session::{Host, Session};

/// An outside whose patience ends.
struct Impatient(Cell<u32>);

/// How often it may be asked to go on in one script: frames, chunks of iterations.
const PATIENCE: u32 = 300;

impl Host for Impatient {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_interrupted(&self) -> bool {
        self.0.set(self.0.get() + 1);
        self.0.get() > PATIENCE
    }

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        Err(io::Error::from(io::ErrorKind::NotFound))
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn written(&self, path: &Path) -> PathBuf {
        path.to_path_buf()
    }

    fn seconds(&self) -> f64 {
        f64::from(self.0.get()) * 1e-3
    }
}

fn session() -> Session {
    Session::new(Box::new(Impatient(Cell::new(0))))
}

fuzz_target!(|text: &str| {
    let mut session = session();
    let source = session.add_source("fuzz", text, None);
    for statement in parse(source, text).take(60) {
        let Ok(statement) = statement else { continue };
        let result = session.execute(&statement);
        assert!(
            session.world().points().ids().all(|p| session.world().points().at(p).is_finite()),
            "{result:?}"
        );
        if session.world().points().column().len() > 400 || session.world().n_constraints() > 400 {
            return;
        }
    }
    let kept = session.to_script();
    let mut again = self::session();
    let source = again.add_source("kept", &kept, None);
    if let Err(why) = again.execute_all(source) {
        panic!("{}: {:?}\n{kept}", why.message, why.labels);
    }
    assert_eq!(again.to_script(), kept);
});
