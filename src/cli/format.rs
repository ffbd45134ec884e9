//! `linkwork fmt`: sets scripts in canonical form.

use std::io;
use std::path::Path;

use super::args::FormatArguments;
use super::run::ExitStatus;
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Sources};
use crate::errors;
use crate::lang::format;
use crate::session::reason;

/// Sets each script in canonical form, past those that cannot be read.
pub fn format_all(arguments: &FormatArguments) -> ExitStatus {
    let statuses = arguments.files.iter().map(|file| format_one(file, arguments.check));
    statuses.fold(ExitStatus::Fine, |worst, status| if worst < status { status } else { worst })
}

fn format_one(file: &Path, is_check: bool) -> ExitStatus {
    let is_stdin = file == Path::new("-");
    let name = if is_stdin { "<stdin>".into() } else { file.to_string_lossy() };
    let text = if is_stdin {
        interrupt::while_waiting(|| files::read_text(io::stdin().lock()))
    } else {
        files::read(file)
    };
    let text = match text {
        Ok(text) => text,
        Err(e) => return unreadable(&format!("cannot read `{name}`: {}", reason(&e)), false),
    };
    let mut sources = Sources::new();
    let source = sources.add(&*name, &*text);
    let wanted = match format(source, &text) {
        Ok(wanted) => wanted,
        Err(problems) => {
            problems.iter().for_each(|problem| output::show(problem, &sources));
            return ExitStatus::Mistake;
        }
    };
    if is_check {
        if wanted == text {
            return ExitStatus::Fine;
        }
        output::answer(&name);
        return ExitStatus::BrokenPromise;
    }
    if is_stdin {
        // The last line end is that of the answer.
        output::answer(wanted.strip_suffix('\n').unwrap_or(&wanted));
        return ExitStatus::Fine;
    }
    match if wanted == text { Ok(()) } else { files::write(file, wanted.as_bytes()) } {
        Ok(()) => ExitStatus::Fine,
        Err(e) => unreadable(&format!("cannot write `{name}`: {}", reason(&e)), true),
    }
}

fn unreadable(message: &str, is_write: bool) -> ExitStatus {
    let code = if is_write { errors::CANNOT_WRITE } else { errors::CANNOT_READ };
    output::show(&Diagnostic::error(code, message), &Sources::new());
    ExitStatus::Unreadable
}
