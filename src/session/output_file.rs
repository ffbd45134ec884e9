//! Files that statements write: what each may replace, and when it is written.

use std::io;
use std::path::{Path, PathBuf};

use super::execution::Execution;
use super::file_kind::{FileKind, Parcel, ends_in};
use super::host::{contained, reason};
use crate::diag::{Diagnostic, Kind, Span};
use crate::errors;
use crate::lang::ast::Text;

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
            let message = match kind {
                FileKind::Picture => "this is no name of a picture",
                _ => "this is no name of a table",
            };
            return Err(Diagnostic::error(errors::NOT_A_FILE_NAME, message)
                .at(path.span, format!("expected a name that ends in `{ending}`")));
        }
        let foreign = [".svg", ".csv"].into_iter().find(|ending| ends_in(&path.value, ending));
        if kind == FileKind::Script
            && let Some(ending) = foreign
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
        self.outbox.push(Parcel { file, bytes, kind, span });
    }

    /// Writes the files of a command that succeeded. One that cannot be written keeps no
    /// other back.
    pub fn flush_outbox(&mut self) -> Result<(), Diagnostic> {
        let parcels = std::mem::take(&mut self.outbox);
        let results: Vec<_> = parcels.iter().map(|parcel| self.write_out(parcel)).collect();
        results.into_iter().collect()
    }

    fn write_out(&mut self, parcel: &Parcel) -> Result<(), Diagnostic> {
        let Parcel { file, bytes, kind, span } = parcel;
        // Since the statement that named it another may have put something there.
        self.must_be_replaceable(file, *kind, *span)?;
        let written = self.host.resolve(file).and_then(|at| self.host.write(&at, bytes));
        written.map_err(|e| unwritable(file, *span, &e))
    }
}

fn unwritable(file: &Path, span: Span, error: &io::Error) -> Diagnostic {
    Diagnostic::error(errors::CANNOT_WRITE, format!("cannot write `{}`", file.display()))
        .kind(Kind::Unreadable)
        .at(span, reason(error))
}
