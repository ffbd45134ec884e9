//! Files that wait to be written until their command has succeeded.

use std::io;
use std::path::{Path, PathBuf};

use super::file_kind::FileKind;
use super::host::reason;
use super::undo::recorder::Recorder;
use crate::diag::{Diagnostic, Kind, Span};
use crate::errors;
use crate::render::Options;

/// A file to be written when the command has succeeded.
#[derive(Debug)]
pub struct Parcel {
    /// Where, as the statement says.
    pub file: PathBuf,
    /// What it is to hold.
    pub content: Content,
    /// What it is.
    pub kind: FileKind,
    /// The statement's path, for errors.
    pub span: Span,
}

/// What a file is to hold.
#[derive(Debug)]
pub enum Content {
    /// These bytes.
    Bytes(Vec<u8>),
    /// What a recording took, with what its pictures carry along.
    Recording(Box<(Recorder, Options)>),
}

/// What is wrong where a file cannot be written.
pub fn unwritable(file: &Path, span: Span, error: &io::Error) -> Diagnostic {
    Diagnostic::error(errors::CANNOT_WRITE, format!("cannot write `{}`", file.display()))
        .kind(Kind::Unreadable)
        .at(span, reason(error))
}
