//! The file that is carried out before the first prompt.

use std::path::PathBuf;

use crate::session::{Host, Session};

/// Where the user's own beginning of each session is kept.
fn file() -> Option<PathBuf> {
    let config = std::env::var_os("XDG_CONFIG_HOME").map(PathBuf::from);
    let home = || std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".config"));
    let folder = config.filter(|path| path.is_absolute()).or_else(home)?;
    Some(folder.join("linkwork/init.link"))
}

/// Carries it out, if there is one; a mistake in it is told, and what stands before it holds.
pub fn run(session: &mut Session, host: &mut dyn Host) {
    let Some(file) = file() else { return };
    let Ok(text) = std::fs::read_to_string(&file) else { return };
    let folder = file.parent().map(PathBuf::from);
    let source = session.add_source(&file.to_string_lossy(), &text, folder);
    session.run_text(source, host);
}
