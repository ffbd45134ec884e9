//! The command under way: what it works on, and what is needed for as long as it runs.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::deadline::Deadline;
use super::host::Host;
use super::input::Input;
use super::parcel::Parcel;
use super::quotas::Quota;
use super::resolve::scope::Resolver;
use super::resolve::scopes::Scopes;
use super::state::State;
use super::summary::Summary;
use super::undo::history::History;
use super::undo::journal::Change;
use crate::diag::{Diagnostic, Span};
use crate::interrupt;
use crate::lang::ast::Statement;
use crate::solve::Memory;
use crate::world::Edit;

/// What an edit of the world takes, in ticks.
const EDIT: usize = 100;

/// How a statement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// The next statement is to follow.
    On,
    /// The user wants to leave.
    Quit,
    /// The user stopped the command; what it did so far stays.
    Stopped,
}

/// A command on its way, with the parts of the session that it may touch and the host that it
/// talks to. What only it needs ends with it, however it ends.
pub struct Execution<'a> {
    /// What it changes.
    pub state: &'a mut State,
    /// What it was read from.
    pub input: &'a mut Input,
    /// What takes it back.
    pub history: &'a mut History,
    /// Who it talks to.
    pub host: &'a mut dyn Host,
    /// The blocks and instances around the statement.
    pub scopes: Scopes,
    /// Statements carried out so far.
    pub n_statements: u64,
    /// How far it came: statements, rounds without one, frames and the like that are done. It is the
    /// same when the command is done again, however fast the machine is.
    pub n_done: u64,
    /// Bytes that were printed before it.
    pub n_printed_before: u64,
    /// How far it is to come, where a stop is repeated.
    pub most_done: Option<u64>,
    /// Rounds of the loops under way, multiplied.
    pub n_rounds: f64,
    /// How deep `include`, `use` and `for` are nested now.
    pub depth: usize,
    /// Files being included, the outermost first.
    pub included: Vec<PathBuf>,
    /// Files to be written when the command has succeeded.
    pub outbox: Vec<Parcel>,
    /// What has run so far.
    pub run: Option<Summary>,
    /// Where likely slips were found.
    pub slips: BTreeSet<Span>,
    /// When it must be done.
    pub deadline: Deadline,
    /// Whether work is under way whose progress is told: what is part of it tells none.
    is_telling_progress: bool,
}

impl<'a> Execution<'a> {
    /// A command that has done nothing yet.
    pub fn new(
        state: &'a mut State,
        input: &'a mut Input,
        history: &'a mut History,
        host: &'a mut dyn Host,
    ) -> Self {
        let deadline = Deadline::after(input.quotas.seconds(), host);
        let n_printed_before = host.n_printed();
        input.is_change = false;
        input.n_done = None;
        history.begin(state);
        Self {
            state,
            input,
            history,
            host,
            scopes: Scopes::default(),
            n_statements: 0,
            n_done: 0,
            n_printed_before,
            most_done: None,
            n_rounds: 1.0,
            depth: 0,
            included: Vec::new(),
            outbox: Vec::new(),
            run: None,
            slips: BTreeSet::new(),
            deadline,
            is_telling_progress: false,
        }
    }

    /// Carries out one statement, whole or not at all.
    pub fn carry_out(mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        let wish = self.deadline.wish(self.host);
        let work = || {
            let flow = self.dispatch(statement)?;
            self.solve_where_live(statement)?;
            Ok(flow)
        };
        let Ok(result) = interrupt::listening(wish, work) else {
            self.history.roll_back(self.state);
            self.state.solver.begin_anew();
            self.hold_time(statement.span)?;
            self.note("stopped; it changed nothing");
            return Ok(Flow::Stopped);
        };
        let result = result.and_then(|flow| {
            let written = self.flush_outbox(flow == Flow::Stopped);
            written.map_err(|problem| self.hold_time(statement.span).err().unwrap_or(problem))?;
            Ok(flow)
        });
        match result {
            Ok(flow) => {
                self.input.stopped_after = (flow == Flow::Stopped).then_some(self.n_done);
                self.complete(statement);
                Ok(flow)
            }
            Err(problem) => {
                self.history.roll_back(self.state);
                Err(problem)
            }
        }
    }

    /// Solves after a statement that stands by itself, where the user wants that after each edit.
    pub fn solve_where_live(&mut self, statement: &Statement) -> Result<(), Diagnostic> {
        if self.state.preferences.is_live && statement.command.is_edit() {
            self.solve_after_edit()?;
        }
        Ok(())
    }

    /// The command has done all that its statement says: it can be taken back from here on.
    pub fn complete(&mut self, statement: &Statement) {
        self.history.last_motion.end(self.state.world.revision());
        self.report_run();
        let label = || self.input.label(statement.span);
        self.input.is_change = self.history.commit(self.state, label, &self.input.quotas);
    }

    /// Ends recordings that still run and writes them.
    pub fn finish(mut self) -> Result<(), Diagnostic> {
        self.stop_recording();
        self.flush_outbox(self.is_asked_to_stop())?;
        self.history.commit(self.state, String::new, &self.input.quotas);
        Ok(())
    }

    /// What names and expressions mean where the statement stands.
    pub fn resolve(&mut self) -> Resolver<'_> {
        Resolver::new(self.state, &mut self.scopes, &self.input.sources, &self.input.quotas)
    }

    /// Makes a change that belongs to the command.
    pub fn change(&mut self, change: Change) {
        self.history.change(self.state, change);
    }

    /// Makes an edit of the world that belongs to the command.
    pub fn edit(&mut self, edit: Edit) {
        interrupt::tick(EDIT);
        self.history.edit(self.state, edit);
    }

    /// Counts from now on how far that turns which a statement asked for.
    pub fn begin_counts(&mut self) {
        for turning in self.scopes.take_turnings() {
            let world = &self.state.world;
            let is_there = turning.points().iter().all(|&id| world.points().is_alive(id));
            if is_there && !world.counts(turning) {
                let count = world.turn_count(turning);
                self.edit(Edit::TurnCount(Box::new((turning, Some(count)))));
            }
        }
    }

    /// Lets the solver take in what was edited, as part of the command.
    pub fn sync(&mut self) {
        self.history.sync(self.state);
    }

    /// Sets what the solver remembers, as part of the command.
    pub fn set_memory(&mut self, memory: Memory) {
        self.history.set_memory(self.state, memory);
    }

    /// Keeps all that running changes, before time passes or the solver moves points.
    pub fn begin_motion(&mut self) {
        self.history.begin_motion(self.state);
    }

    /// Whether it is to stop where it is, what it did so far to stay: it was asked to, or it came as far
    /// as it had come when it was.
    pub fn is_to_stop(&self) -> bool {
        self.is_asked_to_stop() || self.most_done.is_some_and(|most| self.n_done >= most)
    }

    /// Whether the user wants it to stop, or its time is up.
    pub fn is_asked_to_stop(&self) -> bool {
        self.host.is_interrupted() || self.deadline.has_passed(self.host)
    }

    /// Refuses to have taken longer than is allowed, unless the user has stopped it.
    pub fn hold_time(&self, span: Span) -> Result<(), Diagnostic> {
        if !self.deadline.has_passed(self.host) || self.host.is_interrupted() {
            return Ok(());
        }
        self.input.quotas.check(Quota::Seconds, u64::MAX, span)
    }

    /// Tells how far it came, where the user stopped it.
    pub fn note_stop(&mut self, text: impl Into<String>) {
        if self.host.is_interrupted() {
            self.note(text);
        }
    }

    /// Gives an answer of several lines. One that is left by the user ends the command.
    pub fn print_all(&mut self, lines: &[String]) {
        self.host.print_all(lines);
        // However long it was.
        interrupt::tick(usize::MAX);
    }

    /// Tells the user something that is not an answer.
    pub fn note(&mut self, text: impl Into<String>) {
        self.warn(&Diagnostic::note_only(text));
    }

    /// Warns the user.
    pub fn warn(&mut self, warning: &Diagnostic) {
        self.host.tell(warning, &self.input.sources);
    }

    /// Long work begins; gives whether its progress is told, which is not so where it is part of
    /// longer work.
    pub fn begin_work(&mut self) -> bool {
        let is_told = !std::mem::replace(&mut self.is_telling_progress, true);
        if is_told {
            self.host.progress(0.0);
        }
        is_told
    }

    /// Work ends whose progress was told.
    pub fn end_work(&mut self) {
        self.is_telling_progress = false;
        self.host.progress(1.0);
    }
}
