//! `accuracy`: what accuracy costs in time on this very scene.

use std::path::{Path, PathBuf};

use crate::diag::{Diagnostic, Span, format_rounded, format_seconds};
use crate::errors;
use crate::lang::ast::Promise;
use crate::session::execution::{Execution, Flow};
use crate::session::file_kind::FileKind;
use crate::session::host::NO_CLOCK;
use crate::session::json::study_alone;
use crate::session::resolve::unbind::NOWHERE;
use crate::study::{
    Advice, CSV_HEADING, RepeatableMotion, RungResult, Study, StudyHost, Wish, csv, ladder,
    picture, study, table,
};

/// The files that a study writes.
const FILES: [(&str, FileKind); 2] =
    [("accuracy.csv", FileKind::Table(CSV_HEADING)), ("accuracy.svg", FileKind::Picture)];

/// How long a study takes at most, roughly, seconds: longer and nobody would ask.
const SECONDS: f64 = 30.0;
/// Frames studied unless the user says how many.
const MOST_FRAMES: u64 = 720;
/// Frames from now on where nothing has moved yet.
const FRAMES: u64 = 360;
/// A motion that is shorter than this is gone on with.
const FEW_FRAMES: u64 = 10;

/// How a study is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Telling {
    /// A table to read.
    Table,
    /// A list of objects for a program.
    Json,
}

impl Execution<'_> {
    pub(crate) fn accuracy(&mut self, promise: &Promise, span: Span) -> Result<Flow, Diagnostic> {
        let limits = self.promised(promise)?;
        let study = self.study(None, span)?;
        if limits.tolerance.is_none() && limits.seconds.is_none() {
            self.tell_study(&study, Telling::Table, span);
        } else {
            let wish = Wish { within: limits.tolerance, in_time: limits.seconds };
            study.notes.iter().for_each(|text| self.note(text.clone()));
            self.advise(&study, wish);
        }
        Ok(if study.is_stopped { Flow::Stopped } else { Flow::On })
    }

    /// Studies the motion so far, or of what is to come, over `n_frames` if given.
    pub fn study_accuracy(
        mut self,
        n_frames: Option<u64>,
        telling: Telling,
    ) -> Result<Flow, Diagnostic> {
        let study = self.study(n_frames, NOWHERE)?;
        self.tell_study(&study, telling, NOWHERE);
        self.flush_outbox(study.is_stopped)?;
        Ok(if study.is_stopped { Flow::Stopped } else { Flow::On })
    }

    fn study(&mut self, n_frames: Option<u64>, span: Span) -> Result<Study, Diagnostic> {
        if self.state.world.constraints().all(|(_, record)| !record.is_on) {
            return Err(self.nothing_to_solve(span));
        }
        if self.host.seconds().is_none() {
            return Err(Diagnostic::error(errors::NO_CLOCK, NO_CLOCK)
                .at(span, "`accuracy` measures what accuracy costs in time"));
        }
        for (name, kind) in FILES {
            self.must_be_replaceable(Path::new(name), kind, span)?;
        }
        let motion = self.repeatable_motion(n_frames);
        let (host, deadline) = (&*self.host, self.deadline);
        let host = StudyHost {
            now: &|| host.seconds().unwrap_or_default(),
            stop: &|| host.is_interrupted() || deadline.has_passed(host),
            progress: &|share| host.progress(share),
            seconds: SECONDS,
        };
        let study = study(&motion, &ladder(), &host)?;
        self.hold_time(span)?;
        Ok(study)
    }

    /// What is wrong, and what to type, where no constraint is switched on.
    fn nothing_to_solve(&self, span: Span) -> Diagnostic {
        let problem = Diagnostic::error(
            errors::NO_MOTION,
            "this scene has no motion whose accuracy could be studied",
        );
        match self.state.world.constraints().next() {
            Some((_, record)) => problem
                .at(span, "all of its constraints are switched off")
                .help(format!("switch some on again, such as `on {}`", record.name)),
            None => {
                problem.at(span, "it has no constraint that the solver would have to hold").help(
                    "make a mechanism and let it move: `motor A B speed 1rev`, `length B C = 3`, \
                 `step 360`, then `accuracy`",
                )
            }
        }
    }

    /// The motion to study.
    fn repeatable_motion(&mut self, n_frames: Option<u64>) -> RepeatableMotion {
        let motion = if let Some(motion) = self.history.repeatable_motion(self.state) {
            let goes_on = motion.n_frames < FEW_FRAMES && motion.is_without_hands();
            let n = if goes_on { FRAMES } else { motion.n_frames };
            motion.with_frames(n)
        } else {
            self.note("nothing has moved since the scene last changed: studied is what comes next");
            let memory = self.state.solver.memory();
            RepeatableMotion::ahead(&self.state.world, memory, self.state.preferences.solve, FRAMES)
        };
        match n_frames {
            Some(n) => motion.with_frames(n),
            None if motion.n_frames > MOST_FRAMES => {
                self.note(format!(
                    "studied are the first {MOST_FRAMES} of {} frames",
                    motion.n_frames
                ));
                motion.with_frames(MOST_FRAMES)
            }
            None => motion,
        }
    }

    fn tell_study(&mut self, study: &Study, telling: Telling, span: Span) {
        match telling {
            Telling::Table => table(study).iter().for_each(|line| self.host.print(line)),
            Telling::Json => study_alone(study).iter().for_each(|line| self.host.print(line)),
        }
        let notes = study.notes.iter().cloned().chain(study.cut_notes());
        notes.for_each(|text| self.note(text));
        if study.is_stopped {
            self.note("stopped: this is what was found so far");
        }
        self.note(study.summary());
        let title = self.title(span);
        let texts = [csv(study), picture(study, &title)];
        for ((name, kind), text) in FILES.into_iter().zip(texts) {
            self.queue_file(PathBuf::from(name), kind, text.into_bytes(), span);
        }
    }

    /// What a picture of this scene is called: after the script that made it.
    fn title(&self, span: Span) -> String {
        let source = if span.source == NOWHERE.source {
            self.input.sources.first()
        } else {
            self.input.sources.get(span.source)
        };
        let stem = source.and_then(|s| Path::new(&*s.name).file_stem());
        let name = stem.map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        if name.is_empty() || name.starts_with("line ") || name.starts_with('<') {
            "what accuracy costs in time".to_owned()
        } else {
            format!("{name}: what accuracy costs in time")
        }
    }

    fn advise(&mut self, study: &Study, wish: Wish) {
        let describe = |row: &RungResult| {
            format!(
                "{} {}, {} a frame",
                study.measure.words(),
                format_rounded(row.error(study.measure)),
                format_seconds(row.seconds_per_frame)
            )
        };
        match study.advice(wish) {
            Advice::Use(k) => {
                let row = &study.rows[k];
                let [method, setting] = row.rung.statements();
                self.host.print(&format!("{method:<28}# {}", describe(row)));
                self.host.print(&setting);
            }
            Advice::Nearest(Some(k)) => {
                let row = &study.rows[k];
                let [method, setting] = row.rung.statements();
                self.host.print(&format!("# no setting does that; nearest: {}", describe(row)));
                self.host.print(&method);
                self.host.print(&setting);
            }
            Advice::Nearest(None) => self.host.print("# no setting could be run to its end"),
        }
    }
}
