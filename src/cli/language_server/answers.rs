//! What an editor is told of a document.

use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::places::{offset, range};
use crate::cli::files;
use crate::diag::{Diagnostic, Severity, SourceId, Sources, Span};
use crate::lang::format;
use crate::session::{Candidate, Completion, Host, Session};

/// A loop that takes longer is left: the editor waits.
const PATIENCE: Duration = Duration::from_millis(300);

/// Reads what is included from below a folder; nothing is written.
struct Reader {
    folder: PathBuf,
    begun: Instant,
    printed: String,
}

impl Reader {
    fn new(folder: PathBuf) -> Self {
        Self { folder, begun: Instant::now(), printed: String::new() }
    }
}

impl Host for Reader {
    fn print(&mut self, line: &str) {
        self.printed.push_str(line);
        self.printed.push('\n');
    }

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_listening(&self) -> bool {
        false
    }

    fn is_interrupted(&self) -> bool {
        self.begun.elapsed() > PATIENCE
    }

    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        let place = folder.join(path);
        if files::is_below(&self.folder, &place)? {
            return Ok(place);
        }
        Err(io::ErrorKind::PermissionDenied.into())
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        files::read(path)
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        None
    }
}

/// What is wrong with a document.
pub fn problems(text: &str, address: &str) -> Vec<Value> {
    let (session, source, problems) = reviewed(text, address);
    problems.iter().map(|problem| problem_of(problem, source, text, session.sources())).collect()
}

fn reviewed(text: &str, address: &str) -> (Session, SourceId, Vec<Diagnostic>) {
    let mut session = Session::new();
    let folder = folder_of(address);
    let source = session.add_source(address, text, Some(folder.clone()));
    let problems = session.review(source, &mut Reader::new(folder));
    (session, source, problems)
}

/// The folder of a document, for what it includes.
fn folder_of(address: &str) -> PathBuf {
    let path = decoded(address.strip_prefix("file://").unwrap_or_default());
    Path::new(&path).parent().map(Path::to_path_buf).unwrap_or_default()
}

/// An address with its `%20` read.
fn decoded(address: &str) -> String {
    let mut bytes = Vec::with_capacity(address.len());
    let mut rest = address.as_bytes();
    while let Some((&first, behind)) = rest.split_first() {
        let code = behind.get(..2).filter(|_| first == b'%');
        let code = code.and_then(|code| u8::from_str_radix(str::from_utf8(code).ok()?, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &behind[2..] } else { behind };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn problem_of(problem: &Diagnostic, source: SourceId, text: &str, sources: &Sources) -> Value {
    // What goes wrong in a file that is included is marked where it is.
    let labels = problem.labels.iter().filter(|label| label.primary).map(|label| label.span);
    let places = labels.chain(problem.via.iter().copied());
    let place = places.into_iter().find(|place| place.source == source);
    let place = place.unwrap_or(Span::new(source, 0..0));
    let mut message = problem.to_string();
    if let Some(elsewhere) = problem.place().filter(|at| at.source != source)
        && let (Some(file), Some(at)) = (sources.get(elsewhere.source), sources.place(elsewhere))
    {
        message = format!("{}:{}:{}: {message}", file.name, at.line, at.column);
    }
    for said in problem.notes.iter().chain(&problem.helps) {
        message = format!("{message}\n{said}");
    }
    let severity = match problem.severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Note => 3,
    };
    let mut told = json!({
        "range": range(text, place),
        "severity": severity,
        "source": "linkwork",
        "message": message,
    });
    if let Some(code) = problem.code {
        told["code"] = code.to_string().into();
    }
    told
}

/// What `help` says of the word at a place.
pub fn hover(text: &str, position: &Value) -> Value {
    let at = offset(text, position);
    let is_part = |char: char| char.is_alphanumeric() || char == '_';
    let start = text[..at].rfind(|char| !is_part(char)).map_or(0, |k| k + 1);
    let start = text.ceil_char_boundary(start);
    let end = text[at..].find(|char| !is_part(char)).map_or(text.len(), |len| at + len);
    let word = &text[start..end];
    let mut reader = Reader::new(PathBuf::new());
    let mut session = Session::new();
    let source = session.add_source("hover", &format!("help {word}"), None);
    if word.is_empty() || session.execute_all(source, &mut reader).is_err() {
        return Value::Null;
    }
    let value = format!("```text\n{}```", reader.printed);
    let range = range(text, Span::new(SourceId(0), start..end));
    json!({ "contents": { "kind": "markdown", "value": value }, "range": range })
}

/// What may stand at a place.
pub fn completion(text: &str, params: &Value) -> Value {
    let at = offset(text, &params["position"]);
    let address = params["textDocument"]["uri"].as_str().unwrap_or_default();
    let (session, ..) = reviewed(&text[..at], address);
    let mut completion = Completion::default();
    completion.refresh(&session);
    let offer = completion.offer(&text[..at]);
    let place = range(text, Span::new(SourceId(0), offer.start..at));
    let item = |word: &Candidate| json!({ "label": word.shown, "textEdit": { "range": place, "newText": word.text } });
    offer.candidates.iter().map(item).collect()
}

/// The document in canonical form; as it is where it cannot be read.
pub fn formatting(text: &str) -> Value {
    match format(SourceId(0), text) {
        Ok(wanted) if wanted != text => {
            let whole = range(text, Span::new(SourceId(0), 0..text.len()));
            json!([{ "range": whole, "newText": wanted }])
        }
        _ => json!([]),
    }
}
