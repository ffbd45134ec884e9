//! A program that runs beside this one and times itself: a line in, a line out.
//!
//! It is sent the scene as one line of JSON and answers `ready`, or why not; then `run FROM N`,
//! which it answers by the seconds of the processor it took and the frames it did not solve, and `pose`, which it
//! answers by all coordinates.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use crate::peer::{Peer, Run};
use crate::work::{Place, Relation, Work};

/// A program that has not answered by then is taken to be lost.
const PATIENCE: Duration = Duration::from_secs(90);

pub struct Beside {
    child: Child,
    to: ChildStdin,
    from: Receiver<String>,
}

/// The scene as plain data.
fn scene(work: &Work) -> Value {
    let relations: Vec<Value> = (work.relations.iter())
        .map(|relation| match relation {
            Relation::Length(a, b, l) => json!(["length", a, b, l]),
            Relation::Equal([a, b, c, d]) => json!(["equal", a, b, c, d]),
            Relation::OnLine(p, [a, b]) => json!(["online", p, a, b]),
        })
        .collect();
    json!({
        "points": work.start,
        "ground": work.ground,
        "driven": work.driven,
        "offsets": work.offsets,
        "relations": relations,
    })
}

/// Why a program has no more to say, in a few words.
fn reason(answer: &str) -> String {
    if answer.contains("OOM") { "out of memory" } else { "broke down" }.to_owned()
}

impl Beside {
    /// Starts a program, given with its arguments, on a work.
    pub fn start(command: &str, work: &Work) -> Result<Self, String> {
        let mut words = command.split_whitespace();
        let mut child = Command::new(words.next().ok_or("no command")?)
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| e.to_string())?;
        let to = child.stdin.take().ok_or("no way to talk to it")?;
        let out = child.stdout.take().ok_or("no way to hear it")?;
        let (send, from) = channel();
        thread::spawn(move || {
            for line in BufReader::new(out).lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        });
        let mut beside = Self { child, to, from };
        match beside.ask(&scene(work).to_string())?.as_str() {
            "ready" => Ok(beside),
            why => Err(reason(why)),
        }
    }

    fn ask(&mut self, line: &str) -> Result<String, String> {
        writeln!(self.to, "{line}").and_then(|()| self.to.flush()).map_err(|_| "broke down")?;
        self.from.recv_timeout(PATIENCE).map_err(|_| "broke down or too slow".to_owned())
    }
}

impl Peer for Beside {
    fn run(&mut self, from: usize, n: usize) -> Result<Run, String> {
        let answer = self.ask(&format!("run {from} {n}"))?;
        let broken = || reason(&answer);
        let (seconds, failed) = answer.split_once(' ').ok_or_else(broken)?;
        Ok(Run {
            seconds: seconds.parse().map_err(|_| broken())?,
            n_failed: failed.parse().map_err(|_| broken())?,
        })
    }

    fn pose(&mut self) -> Vec<Place> {
        let answer = self.ask("pose").unwrap_or_default();
        serde_json::from_str(&answer).unwrap_or_default()
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
