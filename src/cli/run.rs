//! Running scripts in batch, and the session.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::sync_channel;

use super::args::{HostArguments, Scripts, ViewArguments};
use super::lines::Lines;
use super::process_host::ProcessHost;
use super::{files, init, interrupt, journal, lone_word, output};
use crate::diag::{Diagnostic, Kind, SourceId, Sources, format_counted};
use crate::errors;
use crate::lang::Growing;
use crate::session::{
    Flow, Host, Objects, Outcome, Quota, Session, Transcript, Undeclared, answer_request,
    is_request, reason,
};

/// What the process says of how it went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitStatus {
    /// Everything was done.
    Fine = 0,
    /// An `assert` failed, or what a run promised did not hold.
    BrokenPromise = 1,
    /// A statement asked for something that cannot be done.
    Mistake = 2,
    /// A file could not be read or written.
    Unreadable = 3,
    /// The user stopped it.
    Interrupted = interrupt::STATUS as isize,
}

impl ExitStatus {
    pub fn of(problem: &Diagnostic) -> Self {
        match problem.kind {
            Kind::Promise => Self::BrokenPromise,
            Kind::Mistake => Self::Mistake,
            Kind::Unreadable => Self::Unreadable,
            Kind::Interrupted => Self::Interrupted,
        }
    }
}

impl From<ExitStatus> for ExitCode {
    fn from(status: ExitStatus) -> Self {
        Self::from(status as u8)
    }
}

/// Runs scripts up to the first error.
///
/// Texts and the prompt follow in the world of the last file.
pub fn batch(scripts: &Scripts, host: &HostArguments) -> ExitStatus {
    let mut undeclared: Option<Undeclared> = None;
    let mut take_undeclared = |session: &Session| {
        let here = Undeclared::in_session(session);
        undeclared = Some(match undeclared.take() {
            Some(others) => others.and(here),
            None => here,
        });
    };
    let goes_on = !scripts.eval.is_empty() || scripts.interactive;
    let (last, others) = match scripts.files.split_last() {
        Some((last, others)) if goes_on => (Some(last), others),
        _ => (None, &scripts.files[..]),
    };
    for (k, file) in others.iter().enumerate() {
        let mut session = begin(host);
        let mut process = ProcessHost::new(host, files::folder_of(file));
        let mut talk = Talk::new(&mut process, host);
        let status = script(file, &mut session, talk.host());
        if status != ExitStatus::Fine {
            return status;
        }
        take_undeclared(&session);
        if k + 1 == scripts.files.len() {
            // The process ends and its memory with it: taking a large scene apart piece by
            // piece first would take as long as solving it.
            std::mem::forget(session);
        }
    }
    if goes_on {
        let mut session = begin(host);
        let status = texts(last.map(PathBuf::as_path), scripts, &mut session, host);
        if status != ExitStatus::Fine {
            return status;
        }
        if !scripts.interactive {
            take_undeclared(&session);
        }
    }
    let mut process = ProcessHost::new(host, Path::new("."));
    undeclared.map_or(ExitStatus::Fine, |undeclared| {
        refuse(&undeclared, Talk::going_on(&mut process, host).host())
    })
}

/// Tells of parameters that were given values and that no script declares; the status of that.
pub fn refuse(undeclared: &Undeclared, host: &mut dyn Host) -> ExitStatus {
    let mut status = ExitStatus::Fine;
    for problem in undeclared.problems() {
        host.tell(&problem, &Sources::new());
        status = ExitStatus::of(&problem);
    }
    status
}

/// Carries out a file, then texts of the command line, all in one world.
fn texts(
    file: Option<&Path>,
    scripts: &Scripts,
    session: &mut Session,
    host: &HostArguments,
) -> ExitStatus {
    let folder = file.map_or(Path::new("."), files::folder_of);
    let read = |session: &mut Session, host: &mut dyn Host| {
        let file = file.map(|file| add(file, session, host)).transpose()?;
        let mut sources = Vec::from_iter(file);
        for text in &scripts.eval {
            sources.push(session.add_source("<argument>", text, Some(PathBuf::new())));
        }
        Ok(sources)
    };
    play(read, session, &mut ProcessHost::new(host, folder), host, scripts.interactive)
}

/// Carries out the texts that `read` gives in one world, up to the first mistake; then goes on at the
/// prompt, or ends.
pub fn play(
    read: impl FnOnce(&mut Session, &mut dyn Host) -> Result<Vec<SourceId>, ExitStatus>,
    session: &mut Session,
    process: &mut ProcessHost,
    host: &HostArguments,
    is_interactive: bool,
) -> ExitStatus {
    let follow = is_interactive.then_some(host);
    if host.json && is_interactive {
        return kept(process, host, |process, news| {
            play_to(read, session, Talk::Json(Objects::new(process)), follow, news)
        });
    }
    play_to(read, session, Talk::new(process, host), follow, None)
}

/// As [`play`]; goes on where it is said how.
fn play_to(
    read: impl FnOnce(&mut Session, &mut dyn Host) -> Result<Vec<SourceId>, ExitStatus>,
    session: &mut Session,
    mut talk: Talk,
    follow: Option<&HostArguments>,
    news: Option<Diagnostic>,
) -> ExitStatus {
    let sources = match read(session, talk.host()) {
        Ok(sources) => sources,
        Err(status) => return status,
    };
    let mut status = ExitStatus::Fine;
    let mut has_left = false;
    for source in sources {
        let outcome = session.run_text(source, talk.host());
        status = status_of(&outcome);
        has_left = outcome.flow == Flow::Quit;
        if status != ExitStatus::Fine || has_left {
            break;
        }
    }
    if let Some(host) = follow.filter(|_| !has_left) {
        return match talk {
            Talk::Plain(process) => converse(session, process, host),
            Talk::Json(objects) => converse_in_objects(session, objects, news),
        };
    }
    match (status, end(session, talk.host())) {
        (ExitStatus::Fine, status) | (status, _) => status,
    }
}

/// What the status of a text is.
fn status_of(Outcome { flow, failure }: &Outcome) -> ExitStatus {
    match (failure, flow) {
        (Some(problem), _) => ExitStatus::of(problem),
        (None, Flow::Stopped) => ExitStatus::Interrupted,
        (None, _) => ExitStatus::Fine,
    }
}

/// Ends a session: recordings are written.
fn end(session: &mut Session, host: &mut dyn Host) -> ExitStatus {
    match session.finish(host) {
        Ok(()) => ExitStatus::Fine,
        Err(problem) => {
            host.tell(&problem, session.sources());
            ExitStatus::of(&problem)
        }
    }
}

/// Runs one script, `-` from standard input, and says what went wrong.
pub fn script(file: &Path, session: &mut Session, host: &mut dyn Host) -> ExitStatus {
    match add(file, session, host) {
        Ok(source) => status_of(&session.run_script(source, host)),
        Err(status) => status,
    }
}

/// Reads a script, `-` from standard input.
///
/// # Errors
/// The status where it cannot be read, which was said.
fn add(file: &Path, session: &mut Session, host: &mut dyn Host) -> Result<SourceId, ExitStatus> {
    let is_stdin = file == Path::new("-");
    let name = if is_stdin { "<stdin>".into() } else { file.to_string_lossy() };
    let text = if is_stdin { read_stdin() } else { interrupt::while_waiting(|| files::read(file)) };
    match text {
        Ok(text) => {
            let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
            Ok(session.add_source(&name, &text, Some(folder)))
        }
        Err(e) => {
            let why = reason(&e);
            let message = format!("cannot read `{name}`: {why}");
            let mut problem = Diagnostic::error(errors::CANNOT_READ, message);
            if e.kind() == io::ErrorKind::NotFound {
                problem = lone_word::explain(file, problem);
            }
            host.tell(&problem, session.sources());
            Err(ExitStatus::Unreadable)
        }
    }
}

fn read_stdin() -> io::Result<String> {
    let (to, text) = sync_channel(1);
    std::thread::spawn(move || drop(to.send(files::read_text(io::stdin().lock()))));
    interrupt::next_from(&text).unwrap_or_else(|| Err(io::ErrorKind::Interrupted.into()))
}

/// An empty session.
pub(super) fn begin(host: &HostArguments) -> Session {
    if let Some(n) = host.threads {
        crate::solve::limit_cores(n.into());
    }
    let mut session = Session::new();
    for &(quota, most) in &host.limits {
        session.limit(quota, most);
        if quota == Quota::SourceBytes {
            files::limit_bytes(most);
        }
    }
    for axis in &host.set {
        session.override_parameter(&axis.name, axis.values[0]);
    }
    session
}

/// Whom a session talks to: people, or a program.
pub enum Talk<'a> {
    /// People: text, at a terminal with a prompt.
    Plain(&'a mut ProcessHost),
    /// A program: objects.
    Json(Objects<'a>),
}

impl<'a> Talk<'a> {
    /// As the user wishes.
    pub fn new(process: &'a mut ProcessHost, host: &HostArguments) -> Self {
        if host.json { Self::Json(Objects::new(process)) } else { Self::Plain(process) }
    }

    /// As the user wishes, after what was said already.
    pub fn going_on(process: &'a mut ProcessHost, host: &HostArguments) -> Self {
        if host.json { Self::Json(Objects::going_on(process)) } else { Self::Plain(process) }
    }

    /// Who is told.
    pub fn host(&mut self) -> &mut dyn Host {
        match self {
            Self::Plain(process) => *process,
            Self::Json(objects) => objects,
        }
    }
}

/// Runs a session: a prompt on a terminal, statements typed ahead on a pipe, or a program's.
pub fn session(host: &HostArguments) -> ExitStatus {
    let mut process = ProcessHost::new(host, Path::new("."));
    if host.json {
        return kept(&mut process, host, |process, news| {
            converse_in_objects(&mut begin(host), Objects::new(process), news)
        });
    }
    converse(&mut begin(host), &mut process, host)
}

/// A session that a page looks at, after a script if there is one.
pub fn view(arguments: &ViewArguments) -> ExitStatus {
    let host = &arguments.host;
    let mut session = begin(host);
    let folder = arguments.file.as_deref().map_or(Path::new("."), files::folder_of);
    let mut process = ProcessHost::new(host, folder);
    if let Some(file) = &arguments.file {
        match add(file, &mut session, &mut process) {
            Ok(source) if session.run_text(source, &mut process).flow == Flow::Quit => {
                return end(&mut session, &mut process);
            }
            Ok(_) => {}
            Err(status) => return status,
        }
    }
    match process.open_view(arguments.port) {
        Ok(address) => output::answer(&address),
        Err(e) => {
            let why = format!("no page can be shown: {}", reason(&e));
            output::show(&Diagnostic::error(errors::NO_PAGE, why), session.sources());
            return ExitStatus::Unreadable;
        }
    }
    output::flush();
    converse(&mut session, &mut process, host)
}

fn converse(session: &mut Session, process: &mut ProcessHost, host: &HostArguments) -> ExitStatus {
    process.may_view = true;
    let status = if io::stdin().is_terminal() {
        prompt(session, process, host);
        ExitStatus::Fine
    } else {
        typed_ahead(
            session,
            process,
            |lines, session, process| process.meanwhile(session, &mut |_| (), || lines.next()),
            |piece, transcript, session, process| transcript.enter(piece, session, process),
        )
    };
    match end(session, process) {
        ExitStatus::Fine => status,
        broken => broken,
    }
}

/// A session for a program: statements and requests, answered by objects.
fn converse_in_objects(
    session: &mut Session,
    mut objects: Objects,
    news: Option<Diagnostic>,
) -> ExitStatus {
    begin_journal_of(session, &mut objects, news);
    output::flush();
    let answer =
        |piece: &str, transcript: &mut Transcript, session: &mut Session, objects: &mut _| {
            let mut outcome = if is_request(piece) {
                transcript.skip(piece);
                answer_request(piece, session, objects)
            } else {
                transcript.enter(piece, session, objects)
            };
            if outcome.flow == Flow::Stopped && !interrupt::is_ending() {
                // Who stopped this may ask for something else.
                interrupt::forget();
                outcome.flow = Flow::On;
            }
            outcome
        };
    if !io::stdin().is_terminal() {
        interrupt::be_patient();
    }
    let status = typed_ahead(session, &mut objects, |lines, _, _| lines.next(), answer);
    match end(session, &mut objects) {
        ExitStatus::Fine => status,
        broken => broken,
    }
}

/// A session at a terminal.
fn prompt(session: &mut Session, process: &mut ProcessHost, host: &HostArguments) {
    crate::repl::greet();
    if !host.no_init {
        init::run(session, process);
    }
    kept(process, host, |process, news| {
        begin_journal_of(session, process, news);
        crate::repl::converse(session, process);
    });
}

/// A conversation of which a journal is kept, unless the user wants none: each statement is written down
/// before the next is read. It is told what the last one left that did not end in order.
fn kept<T>(
    process: &mut ProcessHost,
    host: &HostArguments,
    converse: impl FnOnce(&mut ProcessHost, Option<Diagnostic>) -> T,
) -> T {
    if host.no_journal {
        return converse(process, None);
    }
    let news = journal::remains().map(|remains| {
        Diagnostic::note_only(format!(
            "the last session did not end in order; to bring back its {}: load \"{}\"",
            format_counted(remains.n_lines as u64, "line"),
            remains.path.display()
        ))
    });
    process.begin_journal();
    let result = converse(process, news);
    process.end_journal();
    result
}

/// Tells what the last conversation left, and writes down what this one begins with.
fn begin_journal_of(session: &mut Session, host: &mut dyn Host, news: Option<Diagnostic>) {
    if let Some(news) = news {
        host.tell(&news, &Sources::new());
    }
    if host.is_keeping() && session.to_script() != Session::new().to_script() {
        session.keep_whole(host);
    }
}

/// Statements from a pipe, carried out as they come: goes on after an error as a terminal would,
/// and says at the end what the first one was.
fn typed_ahead<H: Host>(
    session: &mut Session,
    host: &mut H,
    next: impl Fn(&mut Lines, &mut Session, &mut H) -> io::Result<Vec<u8>>,
    answer: impl Fn(&str, &mut Transcript, &mut Session, &mut H) -> Outcome,
) -> ExitStatus {
    let mut transcript = Transcript::new("<stdin>");
    let mut status = ExitStatus::Fine;
    let mut piece = Growing::default();
    let mut is_first = true;
    let most = files::most_bytes();
    let mut lines = Lines::of_stdin(most);
    let unreadable = |e: &io::Error, session: &Session, host: &mut H| {
        let message = format!("cannot read standard input: {}", reason(e));
        host.tell(&Diagnostic::error(errors::CANNOT_READ, message), session.sources());
        ExitStatus::Unreadable
    };
    loop {
        let line = match next(&mut lines, session, host) {
            Ok(line) => line,
            Err(e) => return unreadable(&e, session, host),
        };
        let is_end = line.is_empty();
        let mark = files::BYTE_ORDER_MARK;
        let typed_line = if is_first { line.strip_prefix(mark) } else { None };
        let typed_line = String::from_utf8_lossy(typed_line.unwrap_or(&line));
        let is_alone = piece.n_bytes() == 0 && is_request(&typed_line);
        let is_whole = piece.add(&typed_line) || is_alone;
        is_first = false;
        if !is_end && !is_whole {
            // A block that never ends would be all of the memory.
            if piece.n_bytes() as u64 > most {
                return unreadable(&io::ErrorKind::FileTooLarge.into(), session, host);
            }
            continue;
        }
        let Outcome { flow, failure } = answer(&piece.take(), &mut transcript, session, host);
        output::flush();
        if status == ExitStatus::Fine {
            status = failure.as_ref().map_or(ExitStatus::Fine, ExitStatus::of);
        }
        match flow {
            Flow::On if is_end => return status,
            Flow::On => {}
            Flow::Quit => return status,
            Flow::Stopped => return ExitStatus::Interrupted,
        }
    }
}
