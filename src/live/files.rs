//! Files that a page asks for. They are made of a copy of the session, which is not touched.

use std::io;
use std::path::Path;

use serde_json::{Value, json};

use super::request::FileWish;
use crate::diag::Diagnostic;
use crate::render::{Options, svg};
use crate::session::{Answer, Clock, Flow, Host, Session};
use crate::world::{Entity, World};

/// Points whose paths a table has where none is traced.
const MOST_TRACED: usize = 200;

/// A file, or why there is none.
pub fn file(wish: &FileWish, session: &Session, host: &mut dyn Host) -> Result<Value, String> {
    Ok(match wish {
        FileWish::Still => {
            let picture = svg(&session.scene(), &Options::default());
            text_file("mechanism.svg", "image/svg+xml", &picture)
        }
        FileWish::Script => text_file("mechanism.link", "text/plain", &session.to_script()),
        FileWish::Moving(n) => {
            let name = "motion.svg";
            let text = recorded(session, host, name, &[], *n).map_err(|why| why.to_string())?;
            text_file(name, "image/svg+xml", &text)
        }
        FileWish::Table(n) => {
            let name = "paths.csv";
            let traces = if session.world().traces().is_empty() {
                all_points(session.world())
            } else {
                Vec::new()
            };
            let text = recorded(session, host, name, &traces, *n).map_err(|why| why.to_string())?;
            text_file(name, "text/csv", &text)
        }
        FileWish::Written(name) => {
            let path = Path::new(name);
            let text = host.read_back(path).map_err(|why| match why.kind() {
                io::ErrorKind::NotFound => "no statement wrote that".to_owned(),
                _ => crate::session::reason(&why),
            })?;
            let name = path.file_name().map_or_else(|| name.clone(), |n| n.display().to_string());
            let mime = match path.extension().and_then(|ending| ending.to_str()) {
                Some("svg") => "image/svg+xml",
                Some("csv") => "text/csv",
                _ => "text/plain",
            };
            text_file(&name, mime, &text)
        }
    })
}

fn text_file(name: &str, mime: &str, text: &str) -> Value {
    json!({ "name": name, "mime": mime, "text": text })
}

/// The names of the points, those that may move first.
fn all_points(world: &World) -> Vec<String> {
    let points = world.points();
    let mut ids: Vec<_> = points.ids().collect();
    ids.sort_by_key(|&id| points.is_frozen(id));
    ids.truncate(MOST_TRACED);
    ids.into_iter().map(|id| world.name_of(Entity::Point(id)).to_owned()).collect()
}

/// What a recording of so many frames from now on takes, on a copy.
fn recorded(
    session: &Session,
    host: &mut dyn Host,
    name: &str,
    traces: &[String],
    n_frames: u64,
) -> Result<String, Diagnostic> {
    let mut copy = session.copy()?;
    let mut answer = Interruptible { answer: Answer::default(), host };
    let begin = traces
        .iter()
        .map(|point| format!("trace {point}"))
        .chain([format!("record \"{name}\"")])
        .collect::<Vec<_>>()
        .join("\n");
    for text in [begin, format!("step {n_frames}"), "record stop".to_owned()] {
        let source = copy.add_source("<file>", &text, None);
        if copy.execute_all(source, &mut answer)? == Flow::Stopped {
            return Err(Diagnostic::note_only("stopped"));
        }
    }
    let bytes = answer.answer.files.remove(Path::new(name)).unwrap_or_default();
    Ok(String::from_utf8(bytes).unwrap_or_default())
}

/// Keeps what is written in memory, and may be stopped.
struct Interruptible<'a> {
    answer: Answer,
    host: &'a mut dyn Host,
}

impl Host for Interruptible<'_> {
    fn print(&mut self, line: &str) {
        self.answer.print(line);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &crate::diag::Sources) {
        self.answer.tell(what, sources);
    }

    fn is_interrupted(&self) -> bool {
        self.host.is_interrupted()
    }

    fn wish_to_stop(&self) -> Option<crate::session::Wish> {
        self.host.wish_to_stop()
    }

    fn read(&mut self, path: &Path) -> std::io::Result<String> {
        self.answer.read(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> std::io::Result<()> {
        self.answer.write(path, bytes)
    }

    fn seconds(&self) -> Option<f64> {
        self.host.seconds()
    }

    fn clock(&self) -> Option<Clock> {
        self.host.clock()
    }
}
