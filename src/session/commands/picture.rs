//! `svg`: a picture of what is now, and how pictures look.

use std::path::PathBuf;

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{PicturePart, Text};
use crate::render::raster::{IS_BUILT_IN, png};
use crate::render::{Options, svg};
use crate::session::execution::Execution;
use crate::session::file_kind::{FileKind, ends_in};
use crate::session::output_file::wrong_ending;
use crate::session::parcel::unwritable;

/// The widest picture, px: in pixels it takes a quarter of a gigabyte.
const WIDEST: f64 = 8192.0;
/// The narrowest, px.
const NARROWEST: f64 = 16.0;
/// Pixels for each px of a picture whose width is not said: lines stay sharp where it is enlarged.
const PIXELS: f32 = 2.0;

impl Execution<'_> {
    pub(crate) fn svg(&mut self, path: &Text, parts: &[PicturePart]) -> Result<(), Diagnostic> {
        let (file, kind) = self.still_file(path).map_err(|problem| {
            if !path.value.ends_with('/') {
                return problem;
            }
            problem.help(format!("`record \"{}\"` writes a folder of frames", path.value))
        })?;
        let look = self.look(parts)?;
        let run = self.run.as_ref().or_else(|| self.history.run_to(&self.state.world));
        let options = Options { receipt: self.state.picture_options(run).receipt, ..look };
        let picture = svg(&self.state.scene(), &options);
        self.queue_still(file, kind, picture, &options, path.span)
    }

    /// Where a still picture is written, and what its ending says that it is.
    pub(crate) fn still_file(&mut self, path: &Text) -> Result<(PathBuf, FileKind), Diagnostic> {
        let kind = if ends_in(&path.value, ".png") { FileKind::Pixels } else { FileKind::Picture };
        let file = self.output_file(path, kind).map_err(|problem| {
            let is_name = !path.value.is_empty() && !path.value.ends_with('/');
            if is_name && !ends_in(&path.value, ".svg") && kind == FileKind::Picture {
                wrong_ending(path, &[".svg", ".png"])
            } else {
                problem
            }
        })?;
        if kind == FileKind::Pixels {
            must_be_built_in(path)?;
        }
        Ok((file, kind))
    }

    /// Keeps a picture to be written when the command has succeeded.
    pub(crate) fn queue_still(
        &mut self,
        file: PathBuf,
        kind: FileKind,
        picture: String,
        options: &Options,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let bytes = if kind == FileKind::Pixels {
            let scale = if options.width.is_some() { 1.0 } else { PIXELS };
            png(picture, scale, &options.receipt).map_err(|e| unwritable(&file, span, &e))?
        } else {
            picture.into_bytes()
        };
        self.queue_file(file, kind, bytes, span);
        Ok(())
    }

    /// How a picture is to look.
    pub(crate) fn look(&mut self, parts: &[PicturePart]) -> Result<Options, Diagnostic> {
        let mut look = Options::default();
        for part in parts {
            match part {
                PicturePart::Width(px) => {
                    let px = self.resolve().count(px, NARROWEST, WIDEST, "px")?;
                    look.width = Some(px as u32);
                }
                PicturePart::Dark => look.is_dark = true,
                PicturePart::Transparent => look.is_transparent = true,
                PicturePart::WithoutNames => look.without_names = true,
                PicturePart::Title(text) => {
                    look.title = Some(text.value.to_string()).filter(|title| !title.is_empty());
                }
            }
        }
        Ok(look)
    }
}

/// Refuses pictures in pixels where the program is built without them.
pub fn must_be_built_in(path: &Text) -> Result<(), Diagnostic> {
    if IS_BUILT_IN {
        return Ok(());
    }
    Err(Diagnostic::error(errors::NO_PIXELS, "this program is built without pictures in pixels")
        .at(path.span, "`.png` and `.gif` take the feature `pictures`")
        .help("end the name in `.svg`, which every program writes")
        .help("`cargo install linkwork --features pictures` builds one with them"))
}
