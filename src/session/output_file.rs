//! Files that statements write: what each may replace, and when it is written.

use std::io::{self, Write};
use std::path::{Display, Path, PathBuf};

use super::execution::Execution;
use super::file_kind::{ENDINGS, FileKind, ends_in};
use super::finding::Finding;
use super::host::contained;
use super::input::Input;
use super::parcel::{Content, Parcel, unwritable};
use super::quotas::Quota;
use super::undo::recorder::{Format, Recorder};
use crate::diag::{Diagnostic, Kind, Span};
use crate::errors;
use crate::interrupt::{Stopped, listening};
use crate::lang::ast::Text;
use crate::render::{Options, svg_with_view};

/// Files written by one command that are told one by one.
const MOST_FILES_NAMED: usize = 5;

impl Execution<'_> {
    /// Where an output path leads that is to be one file of a kind. Refused where its ending says
    /// another, where the host does not let scripts write, and where it would replace what this
    /// program did not write.
    pub fn output_file(&mut self, path: &Text, kind: FileKind) -> Result<PathBuf, Diagnostic> {
        let file = self.output_path(path)?;
        if path.value.ends_with('/') || file.file_name().is_none() {
            return Err(Diagnostic::error(errors::NOT_A_FILE_NAME, "this is no file")
                .at(path.span, "expected a file name, this names a folder"));
        }
        if let Some(ending) = kind.ending()
            && !ends_in(&path.value, ending)
        {
            return Err(wrong_ending(path, &[ending]));
        }
        let foreign = ENDINGS.into_iter().map(|(ending, _)| ending);
        let foreign = foreign.filter(|&ending| ending != ".link");
        if kind == FileKind::Script
            && let Some(ending) = foreign.into_iter().find(|ending| ends_in(&path.value, ending))
        {
            return Err(Diagnostic::error(errors::NOT_A_FILE_NAME, "`save` writes a script")
                .at(path.span, format!("a name that ends in `{ending}` says something else"))
                .help("end it in `.link`"));
        }
        self.must_be_replaceable(&file, kind, path.span)?;
        Ok(file)
    }

    /// Where an output path leads; refused where the host does not let scripts write.
    pub fn output_path(&self, path: &Text) -> Result<PathBuf, Diagnostic> {
        let given = Path::new(&*path.value);
        if path.value.is_empty() || path.value.contains('\0') {
            return Err(Diagnostic::error(errors::NOT_A_FILE_NAME, "this is not a file name")
                .at(path.span, "nothing to write to"));
        }
        match self.host.resolve(given) {
            // The same file by another name is the same file.
            Ok(_) => Ok(contained(given).unwrap_or_else(|_| given.to_path_buf())),
            Err(e) if e.kind() == io::ErrorKind::PermissionDenied => Err(Diagnostic::error(
                errors::OUTSIDE,
                "files are written below the output folder only",
            )
            .at(path.span, "this path leads elsewhere")
            .help("name the file alone: the output folder is `--out`, or where you are")
            .help("`--allow-any-path` on the command line permits it")),
            Err(e) => Err(unwritable(Path::new(&*path.value), path.span, &e)),
        }
    }

    /// Refuses to write a file in the place of one that this program did not write.
    pub fn must_be_replaceable(
        &mut self,
        file: &Path,
        kind: FileKind,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let there = self.host.resolve(file).and_then(|at| self.host.opening(&at));
        match there {
            Ok(None) => Ok(()),
            Ok(Some(opening)) if kind.wrote(&opening) => Ok(()),
            Ok(Some(_)) => {
                let message =
                    format!("`{}` is there, and linkwork did not write it", file.display());
                Err(Diagnostic::error(errors::FOREIGN_FILE, message)
                    .at(span, "it would be lost")
                    .help("choose another name, or remove the file first")
                    .help("`--force` on the command line replaces it"))
            }
            Err(e) => Err(unwritable(file, span, &e)),
        }
    }

    /// Keeps a file to be written when the command has succeeded; the last one of a name wins.
    pub fn queue_file(&mut self, file: PathBuf, kind: FileKind, bytes: Vec<u8>, span: Span) {
        self.outbox.retain(|other| other.file != file);
        self.outbox.push(Parcel { file, content: Content::Bytes(bytes), kind, span });
    }

    /// Writes the files of a command that succeeded. One that cannot be written keeps no
    /// other back. Who stopped a run still wants what it recorded: it is written whatever is asked.
    pub fn flush_outbox(&mut self, was_stopped: bool) -> Result<(), Diagnostic> {
        if self.outbox.is_empty() {
            return Ok(());
        }
        let parcels = std::mem::take(&mut self.outbox);
        let write = |parcel: &Parcel| {
            let Parcel { file, content, span, kind } = parcel;
            match content {
                Content::Bytes(bytes) => self.write_file(file, *kind, *span, bytes),
                Content::Recording(recording) => {
                    self.write_recording(&recording.0, &recording.1, was_stopped)
                }
            }
        };
        let results: Vec<_> = parcels.iter().map(write).collect();
        let done = parcels.iter().zip(&results).filter(|(_, result)| result.is_ok());
        let written: Vec<PathBuf> =
            done.filter_map(|(parcel, _)| self.host.resolve(&parcel.file).ok()).collect();
        self.tell_written(&written);
        results.into_iter().collect()
    }

    /// Tells what was written: each, or of many the last.
    fn tell_written(&mut self, written: &[PathBuf]) {
        if self.host.takes_findings() {
            written.iter().for_each(|file| self.host.find_out(&Finding::Wrote(file)));
            return;
        }
        match written {
            [others @ .., last] if others.len() >= MOST_FILES_NAMED => {
                let n = written.len();
                self.note(format!("wrote {n} files, the last is {}", plain(last)));
            }
            _ => {
                for file in written {
                    self.note(format!("wrote {}", plain(file)));
                }
            }
        }
    }

    fn write_file(
        &mut self,
        file: &Path,
        kind: FileKind,
        span: Span,
        bytes: &[u8],
    ) -> Result<(), Diagnostic> {
        self.write_in_pieces(file, kind, span, &mut |out| out.write_all(bytes))
    }

    /// Writes a file, unless it is one too many or too long.
    fn write_in_pieces(
        &mut self,
        file: &Path,
        kind: FileKind,
        span: Span,
        content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Diagnostic> {
        // Since the statement that named it another may have put something there.
        self.must_be_replaceable(file, kind, span)?;
        let Input { quotas, n_files, n_file_bytes, .. } = &mut *self.input;
        quotas.check(Quota::Files, *n_files + 1, span)?;
        *n_files += 1;
        let most = quotas.of(Quota::FileBytes);
        let host = &mut *self.host;
        let written = host.resolve(file).and_then(|at| {
            host.write_in_pieces(&at, &mut |out| {
                content(&mut Measured { out, n_bytes: &mut *n_file_bytes, most })
            })
        });
        quotas.check(Quota::FileBytes, *n_file_bytes, span)?;
        written.map_err(|e| unwritable(file, span, &e))
    }

    fn write_recording(
        &mut self,
        recorder: &Recorder,
        options: &Options,
        was_stopped: bool,
    ) -> Result<(), Diagnostic> {
        let Recorder { path, span, format, .. } = recorder;
        let (span, kind) = (*span, recorder.kind());
        let failed = |e: io::Error| unwritable(path, span, &e);
        let stopped = || {
            Diagnostic::error(errors::INTERRUPTED, "stopped before the recording was written")
                .kind(Kind::Interrupted)
                .at(span, "this one")
                .help("`undo` takes back a run that was too long, and what was recorded of it")
        };
        let wish = if was_stopped { None } else { self.deadline.wish(self.host) };
        let is_stopped = || wish.as_ref().is_some_and(|wish| wish());
        match format {
            Format::Table => {
                let table = &mut |out: &mut dyn Write| recorder.write_table(out, is_stopped);
                self.write_in_pieces(path, kind, span, table)
                    .map_err(|problem| if is_stopped() { stopped() } else { problem })
            }
            Format::Frames => {
                let view = listening(wish.clone(), || recorder.view(options.width));
                let view = view.map_err(|Stopped| stopped())?.map_err(failed)?;
                for frame in 0..recorder.n_frames() {
                    if is_stopped() {
                        return Err(stopped());
                    }
                    let scene = recorder.scene(frame).map_err(failed)?;
                    let picture = svg_with_view(&scene, &view, options);
                    let file = path.join(frame_name(frame));
                    self.write_file(&file, kind, span, picture.as_bytes())?;
                }
                Ok(())
            }
            Format::Gif => {
                // Drawn before it is written: the file needs the host, and so does the question.
                let mut bytes = Vec::new();
                let draw = || recorder.write_gif(&mut bytes, options, is_stopped);
                let drawn = listening(wish.clone(), draw).map_err(|Stopped| stopped())?;
                if !drawn.map_err(failed)? {
                    return Err(stopped());
                }
                self.write_file(path, kind, span, &bytes)
            }
            Format::Movie => {
                let movie = listening(wish.clone(), || recorder.movie(options));
                let movie = movie.map_err(|Stopped| stopped())?.map_err(failed)?;
                self.write_file(path, kind, span, movie.as_bytes())
            }
        }
    }
}

/// What is wrong where a name has none of the endings that its statement writes; where another
/// statement writes it, that one is told.
pub fn wrong_ending(path: &Text, endings: &[&str]) -> Diagnostic {
    let listed: Vec<String> = endings.iter().map(|ending| format!("`{ending}`")).collect();
    let problem = Diagnostic::error(errors::NOT_A_FILE_NAME, "the ending says what is written")
        .at(path.span, format!("expected a name that ends in {}", listed.join(" or ")));
    match ENDINGS.into_iter().find(|(ending, _)| ends_in(&path.value, ending)) {
        Some((_, word)) => problem.help(format!("`{word} \"{}\"` writes that", path.value)),
        None if !path.value.contains('.') && !path.value.is_empty() => {
            problem.help(format!("for example `\"{}{}\"`", path.value, endings[0]))
        }
        None => problem,
    }
}

/// A path without the folder that it begins in anyway.
fn plain(file: &Path) -> Display<'_> {
    file.strip_prefix(".").unwrap_or(file).display()
}

/// What a frame of a recording is called in its folder.
pub fn frame_name(frame: usize) -> String {
    format!("frame-{frame:04}.svg")
}

/// Counts what is written, and takes no more than there may be.
struct Measured<'a> {
    out: &'a mut dyn Write,
    n_bytes: &'a mut u64,
    most: u64,
}

impl Write for Measured<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        *self.n_bytes += bytes.len() as u64;
        if *self.n_bytes > self.most {
            return Err(io::ErrorKind::QuotaExceeded.into());
        }
        self.out.write_all(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
