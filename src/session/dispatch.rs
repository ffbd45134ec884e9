//! Which command does what.

use super::execution::{Execution, Flow};
use super::quotas::MOST_STATEMENTS;
use super::state::State;
use super::undo::history::History;
use crate::diag::{Diagnostic, Span};
use crate::lang::ast::{Command, Expr, Statement};

impl Execution<'_> {
    /// Carries out a statement as part of the command under way.
    pub(super) fn dispatch(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        self.n_statements += 1;
        if self.n_statements > MOST_STATEMENTS {
            return Err(Diagnostic::error("this command never seems to end")
                .at(statement.span, "20 million statements were carried out")
                .help("split it into several commands"));
        }
        let flow = self.perform(statement).map_err(|problem| {
            // What fails elsewhere, in a live expression, was reached from here.
            let is_elsewhere = problem.place().is_some_and(|place| !statement.span.holds(place));
            if is_elsewhere && problem.via.is_empty() {
                problem.reached_from(statement.span)
            } else {
                problem
            }
        })?;
        if flow == Flow::On && self.host.is_interrupted() {
            self.note("stopped");
            return Ok(Flow::Stopped);
        }
        Ok(flow)
    }

    fn perform(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        let span = statement.span;
        match &statement.command {
            Command::Let(bindings) => self.let_parameters(bindings)?,
            Command::Point(declarations) => self.make_points(declarations)?,
            Command::Freeze(selection) => self.freeze(selection, true)?,
            Command::Thaw(selection) => self.freeze(selection, false)?,
            Command::Move { point, to } => self.move_point(point, to)?,
            Command::Drag { targets, over } => return self.drag(targets, over.as_ref(), span),
            Command::Constrain(declaration) => self.constrain(declaration, span)?,
            Command::Delete { names, cascade } => self.delete(names, *cascade)?,
            Command::Off(names) => self.switch(names, false)?,
            Command::On(names) => self.switch(names, true)?,
            Command::Change { name, parts } => self.change_thing(name, parts)?,
            Command::Settings(which) => self.show_settings(which.as_ref())?,
            Command::Set { setting, value, targets } => self.set(setting, value, targets)?,
            Command::Undo(n) => self.walk(n.as_ref(), span, &UNDO)?,
            Command::Redo(n) => self.walk(n.as_ref(), span, &REDO)?,
            Command::Reset => self.reset()?,
            Command::Clear => self.clear(),
            Command::Step { frames, promise } => return self.step(frames.as_ref(), promise, span),
            Command::Run { time, promise } => return self.run(time, promise, span),
            Command::Relax(n) => return self.relax(n.as_ref()),
            Command::Solve(promise) => self.solve(promise, span)?,
            Command::List(what) => self.list(*what),
            Command::Show(name) => self.show(name)?,
            Command::Print(items) => self.print(items)?,
            Command::Check => self.check(),
            Command::Why(name) => self.why(name)?,
            Command::Limits(name) => self.limits(name)?,
            Command::Effects => self.effects(),
            Command::Accuracy(promise) => return self.accuracy(promise, span),
            Command::Assert { left, relation, within } => {
                self.assert(left, relation, within.as_ref(), span)?;
            }
            Command::Help(topic) => self.help(topic.as_ref())?,
            Command::Trace { names, every } => self.trace(names, every.as_ref())?,
            Command::Untrace(selection) => self.untrace(selection)?,
            Command::Expose(expose) => self.expose(expose)?,
            Command::Svg(path) => self.svg(path)?,
            Command::Record { path, every } => self.record(path, every.as_ref())?,
            Command::Sample { series, values } => self.sample(series, values)?,
            Command::Plot { path, parts } => self.plot(path, parts)?,
            Command::RecordStop => self.record_stop(span)?,
            Command::For { variable, range, body } => {
                return self.repeat(variable, range, body, span);
            }
            Command::Define(definition) => self.define(definition),
            Command::Use { definition, arguments, instance } => {
                return self.use_definition(definition, arguments, instance.as_ref(), span);
            }
            Command::Include(path) => return self.include(path, span),
            Command::Save(path) => self.save(path)?,
            Command::Load(path) => return self.load(path, span),
            Command::Restore { what, name, values } => {
                self.restore(what, name.as_ref(), values, span)?;
            }
            Command::Quit => return Ok(Flow::Quit),
        }
        Ok(Flow::On)
    }

    /// Goes back or forth in the history.
    fn walk(&mut self, n: Option<&Expr>, span: Span, way: &Walk) -> Result<(), Diagnostic> {
        self.must_stand_alone(way.word, span)?;
        let n = n.map_or(Ok(1), |n| self.resolve().count(n, 1.0, 1e6, "commands"))?;
        let mut n_done = 0;
        while n_done < n
            && let Some(label) = (way.step)(self.history, self.state)
        {
            self.note((way.told)(&label));
            n_done += 1;
        }
        if n_done == 0 {
            return Err(Diagnostic::error(format!("nothing to {}", way.word)).at(span, ""));
        }
        if n_done < n {
            self.note(format!("only {n_done} commands could be {}", way.done));
        }
        Ok(())
    }

    /// Some commands are transactions on the history itself and cannot be part of another.
    pub(super) fn must_stand_alone(&self, word: &str, span: Span) -> Result<(), Diagnostic> {
        if self.depth == 0 {
            return Ok(());
        }
        Err(Diagnostic::error(format!("`{word}` cannot be part of another command"))
            .at(span, "inside of a `for`, a definition or an included file"))
    }
}

/// A way through the history, and how it is told.
struct Walk {
    word: &'static str,
    step: fn(&mut History, &mut State) -> Option<String>,
    told: fn(&str) -> String,
    done: &'static str,
}

const UNDO: Walk = Walk {
    word: "undo",
    step: History::undo,
    told: |label| format!("undid `{label}`"),
    done: "taken back",
};

const REDO: Walk = Walk {
    word: "redo",
    step: History::redo,
    told: |label| format!("did `{label}` again"),
    done: "done again",
};
