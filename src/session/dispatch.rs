//! Which command does what.

use super::execution::{Execution, Flow};
use super::quotas::{Quota, Quotas};
use super::state::State;
use super::undo::history::History;
use super::undo::told::Walk;
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::interrupt::{self, Stopped};
use crate::lang::ast::{
    Building, Changing, Command, Drawing, Expr, Looking, Making, Measuring, Running, Statement,
};

impl Execution<'_> {
    /// Carries out a statement as part of the command under way; again as far only as it came when it
    /// was stopped, where that is said.
    pub(super) fn dispatch(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        let Some(n_done) = self.input.next_stop.take() else {
            return self.dispatch_whole(statement);
        };
        let outer = self.most_done.replace(self.n_done + n_done);
        let flow = self.dispatch_whole(statement);
        self.most_done = outer;
        match flow? {
            Flow::Stopped if !self.is_to_stop() => Ok(Flow::On),
            flow => Ok(flow),
        }
    }

    fn dispatch_whole(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        self.n_statements += 1;
        self.input.quotas.check(Quota::Statements, self.n_statements, statement.span)?;
        interrupt::rest();
        let flow = self.perform(statement).map_err(|problem| {
            // What fails elsewhere, in a live expression, was reached from here.
            let is_elsewhere = problem.place().is_some_and(|place| !statement.span.holds(place));
            if is_elsewhere && problem.via.is_empty() {
                problem.reached_from(statement.span)
            } else {
                problem
            }
        })?;
        self.begin_counts();
        if self.input.walk.is_none() {
            // What a walk through the history brought back was allowed before; nothing takes that back.
            self.hold_quotas(statement.span)?;
        }
        // What was recorded is yet to be written, and that may be stopped by itself.
        let is_written_next = matches!(statement.command, Command::Drawing(Drawing::RecordStop));
        if flow == Flow::On && !is_written_next && self.is_to_stop() {
            self.note_stop("stopped");
            return Ok(Flow::Stopped);
        }
        if flow == Flow::On {
            self.n_done += 1;
        }
        Ok(flow)
    }

    /// Refuses what has grown beyond what is allowed; asked after each statement and each frame.
    pub(super) fn hold_quotas(&self, span: Span) -> Result<(), Diagnostic> {
        let (world, quotas) = (&self.state.world, &self.input.quotas);
        let n_points = world.points().len() as u64;
        quotas.check(Quota::Points, n_points, span)?;
        quotas.check(Quota::Constraints, world.n_constraints() as u64, span)?;
        quotas.check(Quota::GhostPoints, world.ghosts().len() as u64 * n_points, span)?;
        // Who has printed too much may still do other things.
        let n_printed = self.host.n_printed();
        if n_printed > self.n_printed_before {
            quotas.check(Quota::PrintedBytes, n_printed, span)?;
        }
        self.hold_time(span)
    }

    fn perform(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        let span = statement.span;
        match &statement.command {
            Command::Making(it) => return self.making(it, span),
            Command::Constrain(declaration) => self.constrain(declaration, span)?,
            Command::Changing(it) => return self.changing(it, span),
            Command::Running(it) => return self.running(it, span),
            Command::Looking(it) => return self.looking(it, span),
            Command::Measuring(it) => self.measuring(it, span)?,
            Command::Drawing(it) => return self.drawing(it, span),
            Command::Building(it) => return self.building(it, span),
        }
        Ok(Flow::On)
    }

    fn making(&mut self, it: &Making, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Making::Let(bindings) => self.let_parameters(bindings)?,
            Making::Point(declarations) => self.make_points(declarations)?,
            Making::Freeze(selection) => self.freeze(selection, true)?,
            Making::Thaw(selection) => self.freeze(selection, false)?,
            Making::Move { point, to } => self.move_point(point, to)?,
            Making::Pull { targets, over } => return self.pull(targets, over.as_ref(), span),
            Making::Drag { targets, over } => return self.drag(targets, over.as_ref(), span),
        }
        Ok(Flow::On)
    }

    fn changing(&mut self, it: &Changing, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Changing::Delete { names, cascade } => self.delete(names, *cascade)?,
            Changing::Off(names) => self.switch(names, false)?,
            Changing::On(names) => self.switch(names, true)?,
            Changing::Rename { from, to } => self.rename(from, to)?,
            Changing::Change { name, parts } => self.change_thing(name, parts)?,
            Changing::Settings(which) => self.show_settings(which.as_ref())?,
            Changing::Set { setting, value, targets } => self.set(setting, value, targets)?,
            Changing::Undo(n) => self.walk(n.as_ref(), span, &UNDO)?,
            Changing::Redo(n) => self.walk(n.as_ref(), span, &REDO)?,
            Changing::Reset => self.reset()?,
            Changing::Clear => self.clear(),
        }
        Ok(Flow::On)
    }

    fn running(&mut self, it: &Running, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Running::Step { frames, promise } => return self.step(frames.as_ref(), promise, span),
            Running::Run { time, promise } => return self.run(time, promise, span),
            Running::Relax(n) => return self.relax(n.as_ref()),
            Running::Solve(promise) => self.solve(promise, span)?,
        }
        Ok(Flow::On)
    }

    fn looking(&mut self, it: &Looking, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Looking::List(what) => self.list(*what),
            Looking::Show(None) => self.sketch(),
            Looking::Show(Some(name)) => self.show(name)?,
            Looking::Print(items) => self.print(items)?,
            Looking::Bare(items) => self.bare(items)?,
            Looking::Check => self.check(),
            Looking::Why(name) => self.why(name)?,
            Looking::Limits(name) => self.limits(name)?,
            Looking::Effects => self.effects(),
            Looking::Accuracy(promise) => return self.accuracy(promise, span),
            Looking::Assert { left, relation, within } => {
                self.assert(left, relation, within.as_ref(), span)?;
            }
            Looking::Help(topic) => self.help(topic.as_ref())?,
            Looking::History => self.tell_history(),
            Looking::Examples(name) => self.examples(name.as_ref())?,
            Looking::View => self.view(span)?,
            Looking::Quit => return Ok(Flow::Quit),
        }
        Ok(Flow::On)
    }

    fn measuring(&mut self, it: &Measuring, span: Span) -> Result<(), Diagnostic> {
        match it {
            Measuring::Measure { name, value, unit } => self.measure(name, value, *unit, span),
            Measuring::Fit { ranges, goal, over } => self.fit(ranges, goal, over.as_ref(), span),
            Measuring::Result(items) => self.say_results(items),
        }
    }

    fn drawing(&mut self, it: &Drawing, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Drawing::Trace { names, label, every } => {
                self.trace(names, label.as_ref(), every.as_ref())?;
            }
            Drawing::UntraceLabel(label) => self.untrace_label(label)?,
            Drawing::Untrace(selection) => self.untrace(selection)?,
            Drawing::Expose(expose) => self.expose(expose)?,
            Drawing::Svg { path, parts } => self.svg(path, parts)?,
            Drawing::Record { path, columns, every, parts } => {
                self.record(path, columns, every.as_ref(), parts)?;
            }
            Drawing::Export { path, parts } => self.export(path, parts, span)?,
            Drawing::Sample { series, values } => self.sample(series, values)?,
            Drawing::Plot { path, curves: None, parts } => {
                self.plot(path.as_ref(), parts, span)?;
            }
            Drawing::Plot { path, curves: Some(curves), parts } => {
                self.plot_measures(path.as_ref(), curves, parts)?;
            }
            Drawing::RecordStop => self.record_stop(span)?,
        }
        Ok(Flow::On)
    }

    fn building(&mut self, it: &Building, span: Span) -> Result<Flow, Diagnostic> {
        match it {
            Building::For { variable, range, body } => {
                return self.repeat(variable, range, body, span);
            }
            Building::Define(definition) => self.define(definition),
            Building::Use { definition, arguments, instance } => {
                return self.use_definition(definition, arguments, instance.as_ref(), span);
            }
            Building::Include(path) => return self.include(path, span),
            Building::Save(path) => self.save(path)?,
            Building::SaveHistory(path) => self.save_history(path)?,
            Building::Load(path) => return self.load(path, span),
            Building::Restore { what, name, values } => {
                self.restore(what, name.as_ref(), values, span)?;
            }
            Building::RestoreFile { path, text } => self.restore_file(path, text),
        }
        Ok(Flow::On)
    }

    /// Goes back or forth in the history.
    fn walk(&mut self, n: Option<&Expr>, span: Span, way: &Way) -> Result<(), Diagnostic> {
        self.must_stand_alone(way.word, span)?;
        let n = n.map_or(Ok(1), |n| self.resolve().count(n, 1.0, 1e6, "commands"))?;
        let mut n_done = 0;
        let mut is_stopped = false;
        while n_done < n && !is_stopped {
            match (way.step)(self.history, self.state, &self.input.quotas) {
                Ok(Some(label)) => {
                    self.note((way.told)(&label));
                    n_done += 1;
                    is_stopped = self.is_asked_to_stop();
                }
                Ok(None) => break,
                Err(stopped) if n_done == 0 => interrupt::go_on(stopped),
                Err(_) => is_stopped = true,
            }
        }
        if let Err(late) = self.hold_time(span) {
            let back = way.back();
            interrupt::undisturbed(|| {
                for _ in 0..n_done {
                    drop((back.step)(self.history, self.state, &self.input.quotas));
                }
            });
            return Err(late);
        }
        if n_done > 0 {
            self.input.walk = Some((way.walk)(n_done as usize));
        }
        if is_stopped {
            self.input.n_done = Some(n_done);
            return Ok(());
        }
        if n_done == 0 {
            return Err(Diagnostic::error(
                errors::NOTHING_TO_UNDO,
                format!("nothing to {}", way.word),
            )
            .at(span, ""));
        }
        if n_done < n {
            let commands = if n_done == 1 { "command" } else { "commands" };
            self.note(format!("only {n_done} {commands} could be {}", way.done));
        }
        Ok(())
    }

    /// Some commands are transactions on the history itself and cannot be part of another.
    pub(super) fn must_stand_alone(&self, word: &str, span: Span) -> Result<(), Diagnostic> {
        if self.depth == 0 {
            return Ok(());
        }
        Err(Diagnostic::error(errors::ALONE, format!("`{word}` cannot be part of another command"))
            .at(span, "inside of a `for`, a definition or an included file"))
    }
}

/// A way through the history, and how it is told.
struct Way {
    word: &'static str,
    step: fn(&mut History, &mut State, &Quotas) -> Result<Option<String>, Stopped>,
    walk: fn(usize) -> Walk,
    told: fn(&str) -> String,
    done: &'static str,
}

impl Way {
    /// The way back.
    fn back(&self) -> &'static Self {
        if matches!((self.walk)(0), Walk::Back(_)) { &REDO } else { &UNDO }
    }
}

const UNDO: Way = Way {
    word: "undo",
    step: History::undo,
    walk: Walk::Back,
    told: |label| format!("undid `{label}`"),
    done: "taken back",
};

const REDO: Way = Way {
    word: "redo",
    step: History::redo,
    walk: Walk::Forth,
    told: |label| format!("did `{label}` again"),
    done: "done again",
};
