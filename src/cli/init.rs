//! The file that is carried out before the first prompt.

use std::path::PathBuf;

use super::folders;
use crate::session::{Host, Session};

/// Carries it out, if there is one; a mistake in it is told, and what stands before it holds.
pub fn run(session: &mut Session, host: &mut dyn Host) {
    let Some(file) = folders::config().map(|folder| folder.join("init.link")) else { return };
    let Ok(text) = std::fs::read_to_string(&file) else { return };
    let folder = file.parent().map(PathBuf::from);
    let source = session.add_source(&file.to_string_lossy(), &text, folder);
    session.run_text(source, host);
}
