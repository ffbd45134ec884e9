//! Traces, ghosts, pictures and recordings.

use std::path::PathBuf;

use crate::diag::{Diagnostic, Kind, Span};
use crate::errors;
use crate::lang::ast::{Expose, Expr, Name, Selection, Text};
use crate::render::{Animation, Scene, View, svg, svg_with_view};
use crate::session::execution::Execution;
use crate::session::file_kind::{FileKind, Parcel, ends_in};
use crate::session::preferences::Preferences;
use crate::session::resolve::scope::ALL;
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
    pub(crate) fn keep_frame(&mut self, missed: bool) {
        if !self.state.world.traces().is_empty() {
            self.state.world.sample_traces(missed);
        }
        if let Some(every) = self.state.preferences.expose_every
            && self.state.world.clock().frame.is_multiple_of(every)
        {
            let ghost = self.state.world.expose();
            // Running is taken back as a whole, ghosts included.
            self.state.world.apply(ghost);
        }
        for recorder in &mut self.state.recorders {
            recorder.take(&self.state.world);
        }
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
        let recorder = Box::new(Recorder::new(file, path.span, every, format));
        self.change(Change::Recorder(self.state.recorders.len(), Some(recorder)));
        Ok(())
    }

    pub(crate) fn record_stop(&mut self, span: Span) -> Result<(), Diagnostic> {
        if self.state.recorders.is_empty() {
            return Err(
                Diagnostic::error(errors::RECORDING, "nothing is being recorded").at(span, "")
            );
        }
        if self.stop_recording() {
            return Ok(());
        }
        Err(Diagnostic::error(errors::INTERRUPTED, "stopped before the recording was written")
            .kind(Kind::Interrupted)
            .at(span, "it goes on")
            .help("`undo` takes back a run that was too long, and what was recorded of it"))
    }

    /// Ends all recordings and hands over their files, unless the user stops that: false then,
    /// and they are as they were.
    pub(crate) fn stop_recording(&mut self) -> bool {
        if self.state.recorders.is_empty() {
            return true;
        }
        let options =
            self.state.picture_options(self.run.as_ref().or(self.history.last_run.as_ref()));
        // Who stopped a run still wants what it recorded.
        let was_stopped = self.host.is_interrupted();
        let host = &self.host;
        let is_stopped = || host.is_interrupted() && !was_stopped;
        let n_before = self.outbox.len();
        let mut bare = Vec::new();
        for recorder in &self.state.recorders {
            match recorder.format {
                Format::Table => {
                    if recorder.has_times_only() {
                        bare.push(recorder.span);
                    }
                    self.outbox.push(parcel(recorder, recorder.path.clone(), recorder.table()));
                }
                Format::Frames => {
                    let view = View::of(recorder.scenes().map(|(scene, _)| scene));
                    for (k, (scene, _)) in recorder.scenes().enumerate() {
                        if is_stopped() {
                            break;
                        }
                        let picture = svg_with_view(scene, &view, &options);
                        let path = recorder.path.join(frame_name(k));
                        self.outbox.push(parcel(recorder, path, picture));
                    }
                }
                Format::Movie => {
                    let view = View::of(recorder.scenes().map(|(scene, _)| scene));
                    let mut movie = Animation::new(view, &options);
                    for (scene, time) in recorder.scenes() {
                        if is_stopped() {
                            break;
                        }
                        movie.push(scene, time);
                    }
                    self.outbox.push(parcel(recorder, recorder.path.clone(), movie.finish()));
                }
            }
        }
        if is_stopped() {
            self.outbox.truncate(n_before);
            return false;
        }
        for table in bare {
            self.warn(
                &Diagnostic::warning("no point was traced, so the table holds times only")
                    .at(table, "")
                    .help("`trace C` adds the columns of a point"),
            );
        }
        self.drop_recordings();
        true
    }

    /// Ends all recordings as they are.
    pub(crate) fn drop_recordings(&mut self) {
        for idx in (0..self.state.recorders.len()).rev() {
            self.change(Change::Recorder(idx, None));
        }
    }
}

/// What a frame of a recording is called in its folder.
fn frame_name(frame: usize) -> String {
    format!("frame-{frame:04}.svg")
}

fn parcel(recorder: &Recorder, file: PathBuf, text: String) -> Parcel {
    let (kind, span) = (recorder.format.kind(), recorder.span);
    Parcel { file, bytes: text.into_bytes(), kind, span }
}
