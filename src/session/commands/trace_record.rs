//! Traces, ghosts, pictures and recordings.

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{Expose, Expr, Name, Selection, Text};
use crate::render::{Scene, svg};
use crate::session::execution::Execution;
use crate::session::file_kind::{FileKind, ends_in};
use crate::session::output_file::frame_name;
use crate::session::parcel::{Content, Parcel, unwritable};
use crate::session::preferences::Preferences;
use crate::session::quotas::Quota;
use crate::session::resolve::scope::ALL;
use crate::session::spool::Tape;
use crate::session::undo::journal::Change;
use crate::session::undo::recorder::{Format, Recorder};
use crate::world::{Edit, Trace};

impl Execution<'_> {
    fn every(&mut self, every: Option<&Expr>) -> Result<u64, Diagnostic> {
        every.map_or(Ok(1), |n| self.resolve().count(n, 1.0, 1e9, "frames"))
    }

    pub(crate) fn trace(&mut self, names: &[Name], every: Option<&Expr>) -> Result<(), Diagnostic> {
        let every = self.every(every)?;
        for name in names {
            let point = self.resolve().point(name)?;
            let traces = self.state.world.traces();
            match traces.iter().position(|t| t.point == point) {
                Some(k) if traces[k].every == every => {}
                Some(k) => {
                    // The path so far stays; only its pace changes.
                    let mut trace = traces[k].clone();
                    trace.every = every;
                    self.edit(Edit::Trace(k, None));
                    self.edit(Edit::Trace(k, Some(Box::new(trace))));
                }
                None => {
                    let trace = Trace { point, every, samples: Vec::new() };
                    let k = traces.len();
                    self.edit(Edit::Trace(k, Some(Box::new(trace))));
                }
            }
        }
        Ok(())
    }

    pub(crate) fn untrace(&mut self, selection: &Selection) -> Result<(), Diagnostic> {
        if *selection == Selection::All {
            for k in (0..self.state.world.traces().len()).rev() {
                self.edit(Edit::Trace(k, None));
            }
            return Ok(());
        }
        let Selection::Names(names) = selection else { return Ok(()) };
        for name in names {
            let point = self.resolve().point(name);
            let point = point.map_err(|problem| self.resolve().or_word(problem, name, ALL))?;
            let Some(k) = self.state.world.traces().iter().position(|t| t.point == point) else {
                let text = self.state.world.points().name(point);
                return Err(Diagnostic::error(
                    errors::NOT_TRACED,
                    format!("`{text}` is not traced"),
                )
                .at(name.span, "no trace to end"));
            };
            self.edit(Edit::Trace(k, None));
        }
        Ok(())
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

    pub(crate) fn svg(&mut self, path: &Text) -> Result<(), Diagnostic> {
        let file = self.output_file(path, FileKind::Picture).map_err(|problem| {
            if !path.value.ends_with('/') {
                return problem;
            }
            problem.help(format!("`record \"{}\"` writes a folder of frames", path.value))
        })?;
        let scene = Scene::new(&self.state.world);
        let picture = svg(
            &scene,
            &self.state.picture_options(self.run.as_ref().or(self.history.last_run.as_ref())),
        );
        self.queue_file(file, FileKind::Picture, picture.into_bytes(), path.span);
        Ok(())
    }

    pub(crate) fn record(&mut self, path: &Text, every: Option<&Expr>) -> Result<(), Diagnostic> {
        let every = self.every(every)?;
        let format = if path.value.ends_with('/') {
            Format::Frames
        } else if ends_in(&path.value, ".svg") {
            Format::Movie
        } else if ends_in(&path.value, ".csv") {
            Format::Table
        } else {
            self.output_path(path)?;
            return Err(Diagnostic::error(
                errors::NOT_A_FILE_NAME,
                "what is this recording to become?",
            )
            .at(path.span, "expected a name that ends in `/`, `.svg` or `.csv`")
            .help(format!("`record \"{}/\"` makes a folder of frames", path.value)));
        };
        let file = match format {
            Format::Frames => {
                let folder = self.output_path(path)?;
                self.must_be_replaceable(&folder.join(frame_name(0)), format.kind(), path.span)?;
                folder
            }
            Format::Movie | Format::Table => self.output_file(path, format.kind())?,
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
        let recorder = Box::new(Recorder::new(file, path.span, every, format, tape));
        self.change(Change::Recorder(self.state.recorders.len(), Some(recorder)));
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
        let options =
            self.state.picture_options(self.run.as_ref().or(self.history.last_run.as_ref()));
        for recorder in self.state.recorders.clone() {
            if recorder.format == Format::Table && recorder.has_times_only() {
                self.warn(
                    &Diagnostic::warning("no point was traced, so the table holds times only")
                        .at(recorder.span, "")
                        .help("`trace C` adds the columns of a point"),
                );
            }
            let (file, kind, span) = (recorder.path.clone(), recorder.format.kind(), recorder.span);
            let content = Content::Recording(Box::new((recorder, options.clone())));
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
