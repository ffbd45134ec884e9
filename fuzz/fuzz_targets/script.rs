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

/// An outside whose patience ends, whose clock goes on when it is looked at, and which has no
/// files: nothing is read, and what is written goes nowhere.
struct Impatient {
    n_asked: Cell<u32>,
    patience: u32,
}

/// How often it may be asked to go on, or the time, in one script: after each statement, between
/// frames, between chunks of iterations.
const PATIENCE: u32 = 300;
/// The most statements at the outermost level, and the most points and constraints.
const MOST_STATEMENTS: usize = 60;
const MOST_THINGS: usize = 200;
/// A frame of a billion iterations is what was asked for; it cannot be stopped on its way.
const UNSTOPPABLE: &str = "iterations";

impl Host for Impatient {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_interrupted(&self) -> bool {
        self.asked() > self.patience
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

    fn seconds(&self) -> Option<f64> {
        Some(f64::from(self.asked()) * 1e-3)
    }
}

impl Impatient {
    /// How often it was asked something, this time included.
    fn asked(&self) -> u32 {
        self.n_asked.set(self.n_asked.get().saturating_add(1));
        self.n_asked.get()
    }
}

fn session(patience: u32) -> Session {
    Session::new(Box::new(Impatient { n_asked: Cell::new(0), patience }))
}

fuzz_target!(|text: &str| {
    if text.contains(UNSTOPPABLE) {
        return;
    }
    let mut session = session(PATIENCE);
    let source = session.add_source("fuzz", text, None);
    for statement in parse(source, text).take(MOST_STATEMENTS) {
        let Ok(statement) = statement else { continue };
        let result = session.execute(&statement);
        assert!(
            session.world().points().ids().all(|p| session.world().points().at(p).is_finite()),
            "{result:?}"
        );
        let world = session.world();
        if world.points().column().len().max(world.n_constraints()) > MOST_THINGS {
            return;
        }
    }
    let kept = session.to_script();
    // What is kept lets no time pass.
    let mut again = self::session(u32::MAX);
    let source = again.add_source("kept", &kept, None);
    if let Err(why) = again.execute_all(source) {
        panic!("{}: {:?}\n{kept}", why.message, why.labels);
    }
    assert_eq!(again.to_script(), kept);
});
