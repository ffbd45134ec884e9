//! A host of one's own: what a session prints, warns of and writes goes where the program wants
//! it, time comes from a real clock, and the program may stop a run.
//!
//! `cargo run --example own_host`

use std::cell::Cell;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use linkwork::diag::{Diagnostic, Paint, Severity, Sources, render};
use linkwork::session::Flow;
use linkwork::{Host, Session};

/// Keeps answers and files in memory, and stops whatever asks too often.
struct Memory {
    answers: Vec<String>,
    warnings: Vec<String>,
    files: BTreeMap<PathBuf, Vec<u8>>,
    begun: Instant,
    /// Asked between frames, and it takes a shared reference: hence the cell.
    patience: Cell<u32>,
}

impl Host for Memory {
    fn print(&mut self, line: &str) {
        self.answers.push(line.to_owned());
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if what.severity == Severity::Warning {
            self.warnings.push(render(what, sources, Paint::Plain));
        }
    }

    fn is_interrupted(&self) -> bool {
        self.patience.set(self.patience.get().saturating_sub(1));
        self.patience.get() == 0
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        let bytes = self.files.get(path).ok_or(io::ErrorKind::NotFound)?;
        String::from_utf8(bytes.clone()).map_err(|_| io::ErrorKind::InvalidData.into())
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.files.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        Some(self.begun.elapsed().as_secs_f64())
    }
}

/// A crank on a leash that is too short for a whole turn.
const SCRIPT: &str = r#"
point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
length B C = 2.2
length C D = 2.2
set dt 1/360
print "C starts at", C
svg "leash.svg"
step 100000
"#;

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut host = Memory {
        answers: Vec::new(),
        warnings: Vec::new(),
        files: BTreeMap::new(),
        begun: Instant::now(),
        patience: Cell::new(2000),
    };
    // The session is lent its host statement by statement: both can be looked at in between.
    let mut session = Session::new();
    let source = session.add_source("leash.link", SCRIPT, None);
    let flow = session.execute_all(source, &mut host)?;
    assert_eq!(flow, Flow::Stopped, "the host lost its patience");
    println!("stopped at frame {}", session.world().clock().frame);

    host.patience.set(u32::MAX);
    let source = session.add_source("question", "reset; limits crank", None);
    session.execute_all(source, &mut host)?;

    host.answers.iter().for_each(|line| println!("{line}"));
    host.warnings.iter().for_each(|warning| println!("{warning}"));
    for (path, bytes) in &host.files {
        println!("{}: {} bytes", path.display(), bytes.len());
    }
    Ok(())
}
