//! `linkwork watch` runs a script again when it is saved, and survives what happens to files.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than anything here takes; only a failure waits for it.
const PATIENCE: Duration = Duration::from_mins(1);

struct Watching {
    program: Child,
    printed: Receiver<Vec<u8>>,
    seen: String,
}

impl Watching {
    fn begin(folder: &Path, file: &str) -> Self {
        let mut program = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .args(["watch", file])
            .current_dir(folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let mut out = program.stdout.take().expect("a pipe");
        let (send, printed) = channel();
        thread::spawn(move || {
            let mut piece = [0; 256];
            while let Ok(n @ 1..) = out.read(&mut piece) {
                if send.send(piece[..n].to_vec()).is_err() {
                    return;
                }
            }
        });
        Self { program, printed, seen: String::new() }
    }

    /// Waits until a text is printed, and forgets what stands before it.
    fn wait_for(&mut self, wanted: &str) {
        let begun = Instant::now();
        while !self.seen.contains(wanted) {
            assert!(begun.elapsed() < PATIENCE, "no {wanted:?} in {:?}", self.seen);
            if let Ok(piece) = self.printed.recv_timeout(Duration::from_millis(100)) {
                assert!(!piece.contains(&0x1b), "what is no terminal is not cleared");
                self.seen.push_str(&String::from_utf8_lossy(&piece));
            }
        }
        let (_, behind) = self.seen.split_once(wanted).expect("it is there");
        self.seen = behind.to_owned();
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        drop(self.program.kill());
        drop(self.program.wait());
    }
}

#[test]
fn a_script_runs_again_at_each_save() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("it can be written");
    };
    write("a.link", "include \"b.link\"\nprint \"first\"\n");
    write("b.link", "print \"from b\"\n");
    let mut watching = Watching::begin(folder.path(), "a.link");
    watching.wait_for("from b\nfirst\n");
    write("b.link", "print \"b is another\"\n");
    watching.wait_for("b is another\nfirst\n");
    // A mistake, and a file that is gone, are survived.
    write("a.link", "lenght A B\n");
    write("a.link", "print \"mended\"\n");
    watching.wait_for("mended\n");
    fs::remove_file(folder.path().join("a.link")).expect("it is there");
    write("a.link", "print \"back again\"\n");
    watching.wait_for("back again\n");
}
