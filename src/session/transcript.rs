//! A text from its first statement to its last: a script as a whole, or what is typed piece by
//! piece, past mistakes.

use std::borrow::Cow;
use std::path::PathBuf;

use super::execution::Flow;
use super::host::Host;
use super::{Session, next_of};
use crate::diag::{Diagnostic, SourceId, Span};
use crate::lang::ast::Command;
use crate::lang::parse;

/// How a text went. The host was told what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// How its last statement ended.
    pub flow: Flow,
    /// What was wrong with the first statement that failed, if one did.
    pub failure: Option<Diagnostic>,
}

impl Session {
    /// Carries out a text up to the first error.
    pub fn run_text(&mut self, source: SourceId, host: &mut dyn Host) -> Outcome {
        match self.execute_all(source, host) {
            Ok(flow) => Outcome { flow, failure: None },
            Err(problem) => {
                host.tell(&problem, self.sources());
                self.tell_done(self.input.reached, false, host);
                Outcome { flow: Flow::On, failure: Some(problem) }
            }
        }
    }

    /// Carries out a script up to the first error and ends the session. What was recorded up to
    /// there is not lost.
    pub fn run_script(&mut self, source: SourceId, host: &mut dyn Host) -> Outcome {
        let mut outcome = self.run_text(source, host);
        if let Err(problem) = self.finish(host)
            && outcome.failure.as_ref() != Some(&problem)
        {
            host.tell(&problem, self.sources());
            outcome.failure.get_or_insert(problem);
        }
        outcome
    }
}

/// What a session asks for a statement with.
pub const PROMPT: &str = "> ";

/// What it asks for the rest of one with.
pub const CONTINUATION: &str = "... ";

/// A text that is typed piece by piece.
#[derive(Debug)]
pub struct Transcript {
    name: &'static str,
    n_lines: usize,
    /// Whether somebody sees each answer before they go on.
    is_conversation: bool,
    /// Whether all that stands behind a mistake is left out.
    ends_at_a_mistake: bool,
    /// Whether the pose was solved when it was looked at last.
    was_solved: bool,
}

impl Transcript {
    /// Lines went by that are told by others.
    pub fn skip(&mut self, piece: &str) {
        self.n_lines += piece.lines().count().max(1);
    }

    /// A text that errors call `name`.
    pub const fn new(name: &'static str) -> Self {
        Self {
            name,
            n_lines: 0,
            is_conversation: false,
            ends_at_a_mistake: false,
            was_solved: true,
        }
    }

    /// A conversation: who types is told when an edit leaves the pose unsolved.
    pub const fn conversation(name: &'static str) -> Self {
        Self { is_conversation: true, ..Self::new(name) }
    }

    /// A request of a program: what stands behind a mistake was not written for what is then.
    pub const fn request(name: &'static str) -> Self {
        Self { ends_at_a_mistake: true, ..Self::new(name) }
    }

    /// Carries out a piece. After a mistake the rest of its line is left out, as it was typed
    /// in the belief that what stands before it works; the next line is carried out again, but for
    /// a request.
    pub fn enter(&mut self, piece: &str, session: &mut Session, host: &mut dyn Host) -> Outcome {
        let folder = Some(PathBuf::new());
        let source = session.add_piece(self.name, piece, self.n_lines + 1, folder);
        self.skip(piece);
        let mut outcome = Outcome { flow: Flow::On, failure: None };
        let mut left_out = 0;
        let mut statements = parse(source, piece);
        while let Some(statement) = next_of(&mut statements, host).transpose() {
            let Ok(statement) = statement else {
                outcome.flow = Flow::Stopped;
                break;
            };
            let span = match &statement {
                Ok(statement) => statement.span,
                Err(problem) => problem.place().unwrap_or(Span::new(source, 0..0)),
            };
            if (span.start as usize) < left_out {
                continue;
            }
            let statement = statement.map_err(|problem| session.advise(problem));
            let is_edit = statement.as_ref().is_ok_and(|statement| statement.command.is_edit());
            let result = statement.and_then(|statement| {
                let flow = session.execute(&statement, host)?;
                if flow != Flow::Quit {
                    session.note_typed(&statement, flow, host);
                }
                Ok(flow)
            });
            match result {
                Ok(Flow::On) => {
                    self.look_at_pose(is_edit, session, host);
                    session.tell_done(span, true, host);
                }
                Ok(flow) => {
                    session.tell_done(span, session.has_stayed(flow), host);
                    outcome.flow = flow;
                    break;
                }
                Err(problem) => {
                    host.tell(&problem, session.sources());
                    session.tell_done(span, false, host);
                    outcome.failure.get_or_insert(problem);
                    if self.ends_at_a_mistake {
                        break;
                    }
                    left_out = line_end(piece, span);
                }
            }
        }
        outcome
    }
}

/// Whether a statement changes what there is, and does not only say or write it.
pub(super) fn leaves_a_mark(command: &Command) -> bool {
    match command {
        Command::Looking(_) => false,
        Command::Drawing(it) => it.leaves_a_mark(),
        Command::Building(it) => it.leaves_a_mark(),
        Command::Changing(it) => it.leaves_a_mark(),
        Command::Measuring(it) => it.is_edit(),
        Command::Making(_) | Command::Constrain(_) | Command::Running(_) => true,
    }
}

/// The statement that does what a statement did which was stopped after so many frames or iterations,
/// where there is one.
pub(super) fn what_was_done(command: &Command, n: u64) -> Option<String> {
    match command {
        Command::Running(it) => it.stopped_after(n),
        Command::Changing(it) => it.stopped_after(n),
        _ => None,
    }
}

impl Transcript {
    /// Says once that an edit left the pose unsolved, until it is solved again.
    fn look_at_pose(&mut self, is_edit: bool, session: &Session, host: &mut dyn Host) {
        if !self.is_conversation {
            return;
        }
        let unsolved = session.unsolved();
        if let Some(note) = unsolved.as_ref().filter(|_| is_edit && self.was_solved) {
            host.tell(note, session.sources());
        }
        self.was_solved = unsolved.is_none();
    }
}

fn line_end(text: &str, span: Span) -> usize {
    let rest = text.get(span.end as usize..).unwrap_or_default();
    text.len() - rest.find('\n').map_or(0, |at| rest.len() - at)
}

/// What a copy of a session says without its prompts: where a line begins with one, such lines and
/// those that go on from them are taken, and what the session answered is left out.
///
/// ```
/// use linkwork::session::without_prompts;
///
/// let copied = "> let r = 3\n> for i in 1..2 {\n...   print r\n... }\n3\n3\n";
/// assert_eq!(without_prompts(copied), "let r = 3\nfor i in 1..2 {\n  print r\n}");
/// assert_eq!(without_prompts("let r = 3\nstep"), "let r = 3\nstep");
/// ```
pub fn without_prompts(text: &str) -> Cow<'_, str> {
    let behind = |line, mark: &str| {
        if line == mark.trim_end() { Some("") } else { str::strip_prefix(line, mark) }
    };
    if !text.lines().any(|line| behind(line.trim_start(), PROMPT).is_some()) {
        return Cow::Borrowed(text);
    }
    let mut lines = Vec::new();
    let mut goes_on = false;
    for line in text.lines() {
        // Lines of a paste may have been set in.
        let rest = behind(line.trim_start(), PROMPT);
        goes_on = rest.is_some() || (goes_on && behind(line.trim_start(), CONTINUATION).is_some());
        if goes_on {
            lines.extend(rest.or_else(|| behind(line.trim_start(), CONTINUATION)));
        }
    }
    Cow::Owned(lines.join("\n"))
}
