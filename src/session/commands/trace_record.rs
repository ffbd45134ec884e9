//! Traces, ghosts and recordings.

use std::sync::Arc;

use crate::diag::{Diagnostic, Span, suggest};
use crate::errors;
use crate::lang::ast::{Column, Expose, Expr, Name, PicturePart, Selection, Text};
use crate::render::Options;
use crate::session::commands::picture::must_be_built_in;
use crate::session::execution::Execution;
use crate::session::file_kind::ends_in;
use crate::session::output_file::frame_name;
use crate::session::parcel::{Content, Parcel, unwritable};
use crate::session::preferences::Preferences;
use crate::session::quotas::Quota;
use crate::session::resolve::scope::ALL;
use crate::session::spool::Tape;
use crate::session::undo::journal::Change;
use crate::session::undo::recorder::{Format, Recorder, kind_of};
use crate::world::{Edit, PointId, SampleList, Trace};

impl Execution<'_> {
    fn every(&mut self, every: Option<&Expr>) -> Result<u64, Diagnostic> {
        every.map_or(Ok(1), |n| self.resolve().count(n, 1.0, 1e9, "frames"))
    }

    pub(crate) fn trace(
        &mut self,
        names: &[Name],
        label: Option<&Text>,
        every: Option<&Expr>,
    ) -> Result<(), Diagnostic> {
        let every = self.every(every)?;
        if let (Some(label), [_, second, ..]) = (label, names) {
            return Err(Diagnostic::error(errors::NAME_TAKEN, "a name is that of one path")
                .at(label.span, "")
                .also(second.span, "this would be another")
                .help("write a `trace ... as ...` for each"));
        }
        for name in names {
            let point = self.resolve().point(name)?;
            match label {
                Some(label) => self.trace_as(point, label, every)?,
                None => self.trace_point(point, every),
            }
        }
        Ok(())
    }

    /// The place in the list of the path of a point that still grows.
    fn growing_trace(&self, point: PointId) -> Option<usize> {
        let mut traces = self.state.world.traces().iter();
        traces.position(|trace| trace.point == point && !trace.is_ended)
    }

    /// Changes what is said of a path; its places stay.
    fn change_trace(&mut self, k: usize, change: impl FnOnce(&mut Trace)) {
        let mut trace = self.state.world.traces()[k].clone();
        change(&mut trace);
        self.edit(Edit::Trace(k, None));
        self.edit(Edit::Trace(k, Some(Box::new(trace))));
    }

    fn trace_point(&mut self, point: PointId, every: u64) {
        match self.growing_trace(point) {
            Some(k) if self.state.world.traces()[k].every == every => {}
            Some(k) => self.change_trace(k, |trace| trace.every = every),
            None => self.begin_trace(point, None, every),
        }
    }

    /// Begins a path with a name, and ends the one of the same point that grows.
    fn trace_as(&mut self, point: PointId, label: &Text, every: u64) -> Result<(), Diagnostic> {
        if label.value.trim().is_empty() || label.value.contains(char::is_control) {
            return Err(Diagnostic::error(errors::NAME_TAKEN, "a path needs a name")
                .at(label.span, "a line of text, not empty"));
        }
        let growing = self.growing_trace(point);
        let has_label = |trace: &Trace| trace.label.as_ref() == Some(&label.value);
        if let Some(k) = self.state.world.traces().iter().position(has_label) {
            if growing != Some(k) {
                let text = &label.value;
                return Err(Diagnostic::error(
                    errors::NAME_TAKEN,
                    format!("there is a path `{text}` already"),
                )
                .at(label.span, "this name is taken")
                .help(format!("`untrace {label}` removes it")));
            }
            self.trace_point(point, every);
            return Ok(());
        }
        if let Some(k) = growing {
            self.change_trace(k, |trace| trace.is_ended = true);
        }
        self.begin_trace(point, Some(label.value.clone()), every);
        Ok(())
    }

    fn begin_trace(&mut self, point: PointId, label: Option<Arc<str>>, every: u64) {
        let trace = Trace { point, label, every, is_ended: false, samples: SampleList::default() };
        self.edit(Edit::Trace(self.state.world.traces().len(), Some(Box::new(trace))));
    }

    pub(crate) fn untrace(&mut self, selection: &Selection) -> Result<(), Diagnostic> {
        if *selection == Selection::All {
            self.remove_traces(|_| true);
            return Ok(());
        }
        let Selection::Names(names) = selection else { return Ok(()) };
        for name in names {
            let point = self.resolve().point(name);
            let point = point.map_err(|problem| self.resolve().or_word(problem, name, ALL))?;
            if !self.remove_traces(|trace| trace.point == point) {
                let text = self.state.world.points().name(point);
                return Err(Diagnostic::error(
                    errors::NOT_TRACED,
                    format!("`{text}` is not traced"),
                )
                .at(name.span, "no trace to end"));
            }
        }
        Ok(())
    }

    pub(crate) fn untrace_label(&mut self, label: &Text) -> Result<(), Diagnostic> {
        if self.remove_traces(|trace| trace.label.as_ref() == Some(&label.value)) {
            return Ok(());
        }
        let labels = self.state.world.traces().iter().filter_map(|trace| trace.label.as_deref());
        let problem = Diagnostic::error(errors::NOT_TRACED, "no path has this name")
            .at(label.span, "no trace to end");
        Err(suggest(problem, &label.value, labels).help("`list traces` shows them"))
    }

    /// Removes some paths; whether there were any.
    fn remove_traces(&mut self, is_one: impl Fn(&Trace) -> bool) -> bool {
        let traces = self.state.world.traces().iter().enumerate();
        let found: Vec<usize> = traces.filter(|(_, it)| is_one(it)).map(|(k, _)| k).collect();
        found.iter().rev().for_each(|&k| self.edit(Edit::Trace(k, None)));
        !found.is_empty()
    }

    pub(crate) fn expose(&mut self, expose: &Expose) -> Result<(), Diagnostic> {
        let every = match expose {
            Expose::Now => {
                let ghost = self.state.world.expose();
                self.edit(ghost);
                return Ok(());
            }
            Expose::Every(n) => Some(self.resolve().count(n, 1.0, 1e9, "frames")?),
            Expose::Off => None,
        };
        let new = Preferences { expose_every: every, ..self.state.preferences.clone() };
        self.change(Change::Preferences(Box::new(new)));
        Ok(())
    }

    /// Keeps what this frame leaves behind: traces, ghosts, recordings.
    pub(crate) fn keep_frame(&mut self, missed: bool, span: Span) -> Result<(), Diagnostic> {
        if !self.state.world.traces().is_empty() {
            self.state.world.sample_traces(missed);
        }
        self.measure_frame(!missed).map_err(|why| self.in_frame(why))?;
        if let Some(every) = self.state.preferences.expose_every
            && self.state.world.clock().frame.is_multiple_of(every)
        {
            let ghost = self.state.world.expose();
            // Running is taken back as a whole, ghosts included.
            self.state.world.apply(ghost);
        }
        self.take_rows(span)?;
        let mut n_taped = 0;
        for recorder in &mut self.state.recorders {
            recorder.take(&self.state.world).map_err(|e| unwritable(&recorder.path, span, &e))?;
            n_taped += recorder.n_taped();
        }
        let quotas = &self.input.quotas;
        let n_samples =
            self.state.world.traces().iter().map(|trace| trace.samples.len()).sum::<usize>();
        quotas.check(Quota::TraceSamples, n_samples as u64, span)?;
        self.check_readings(span)?;
        let quotas = &self.input.quotas;
        let n_frames = self.state.recorders.iter().map(Recorder::n_frames).sum::<usize>();
        quotas.check(Quota::RecordedFrames, n_frames as u64, span)?;
        quotas.check(Quota::RecordedBytes, n_taped, span)?;
        self.hold_quotas(span)
    }

    pub(crate) fn record(
        &mut self,
        path: &Text,
        columns: &[Column],
        every: Option<&Expr>,
        parts: &[PicturePart],
    ) -> Result<(), Diagnostic> {
        let every = self.every(every)?;
        let look = self.look(parts)?;
        let format = if path.value.ends_with('/') {
            Format::Frames
        } else if ends_in(&path.value, ".svg") {
            Format::Movie
        } else if ends_in(&path.value, ".gif") {
            must_be_built_in(path)?;
            Format::Gif
        } else if ends_in(&path.value, ".csv") {
            Format::Table
        } else {
            self.output_path(path)?;
            let problem =
                Diagnostic::error(errors::NOT_A_FILE_NAME, "what is this recording to become?")
                    .at(path.span, "expected a name that ends in `/`, `.svg`, `.gif` or `.csv`");
            let still = ends_in(&path.value, ".png");
            return Err(if still {
                problem.help(format!("`svg \"{}\"` writes one picture", path.value))
            } else {
                problem.help(format!("`record \"{}/\"` makes a folder of frames", path.value))
            });
        };
        if format == Format::Table
            && let Some(part) = parts.first()
        {
            return Err(Diagnostic::error(
                errors::NOT_A_FILE_NAME,
                "a table does not look like anything",
            )
            .at(path.span, format!("`{part}` is for pictures"))
            .help("leave it out, or record an `.svg`"));
        }
        if let Some(column) = columns.first().filter(|_| format != Format::Table) {
            return Err(Diagnostic::error(errors::NOT_A_FILE_NAME, "only a table has columns")
                .at(path.span, "expected a name that ends in `.csv`")
                .also(column.value.span, "the first column"));
        }
        let columns = self.table_columns(columns)?;
        let kind = if columns.is_empty() { format.kind() } else { kind_of(&columns) };
        let file = match format {
            Format::Frames => {
                let folder = self.output_path(path)?;
                self.must_be_replaceable(&folder.join(frame_name(0)), format.kind(), path.span)?;
                folder
            }
            Format::Movie | Format::Gif | Format::Table => self.output_file(path, kind)?,
        };
        if self.state.recorders.iter().any(|r| r.path == file) {
            return Err(Diagnostic::error(
                errors::RECORDING,
                format!("`{}` is being recorded already", path.value),
            )
            .at(path.span, "")
            .help("`record stop` ends and writes all recordings"));
        }
        let spool = self.host.spool().map_err(|e| unwritable(&file, path.span, &e))?;
        let tape = Tape::new(spool);
        let mut recorder = Recorder::new(file, path.span, every, format, look, tape);
        recorder.columns = columns.into();
        if !recorder.columns.is_empty() {
            // The row of now: what is counted in it is counted from now on.
            self.begin_counts();
            self.take_row(&mut recorder, path.span)?;
        }
        let k = self.state.recorders.len();
        self.change(Change::Recorder(k, Some(Box::new(recorder))));
        Ok(())
    }

    pub(crate) fn record_stop(&mut self, span: Span) -> Result<(), Diagnostic> {
        if self.state.recorders.is_empty() {
            return Err(
                Diagnostic::error(errors::RECORDING, "nothing is being recorded").at(span, "")
            );
        }
        self.stop_recording();
        Ok(())
    }

    /// Ends all recordings; they are written when the command has succeeded.
    pub(crate) fn stop_recording(&mut self) {
        if self.state.recorders.is_empty() {
            return;
        }
        let run = self.run.as_ref().or_else(|| self.history.run_to(&self.state.world));
        let options = self.state.picture_options(run);
        for mut recorder in self.state.recorders.clone() {
            recorder.name_columns(&self.state.world);
            if recorder.format == Format::Table && recorder.has_times_only() {
                self.warn(
                    &Diagnostic::warning("no point was traced, so the table holds times only")
                        .at(recorder.span, "")
                        .help("`trace C` adds the columns of a point"),
                );
            }
            let (file, kind, span) = (recorder.path.clone(), recorder.kind(), recorder.span);
            let options = Options { receipt: options.receipt.clone(), ..recorder.look.clone() };
            let content = Content::Recording(Box::new((recorder, options)));
            self.outbox.push(Parcel { file, content, kind, span });
        }
        self.drop_recordings();
    }

    /// Ends all recordings as they are.
    pub(crate) fn drop_recordings(&mut self) {
        for idx in (0..self.state.recorders.len()).rev() {
            self.change(Change::Recorder(idx, None));
        }
    }
}
