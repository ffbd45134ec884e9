//! The lines typed so far, kept across sessions.

use std::path::{Path, PathBuf};

use super::editor::LineEditor;
use crate::cli::folders;

/// Where the history is kept across sessions.
pub fn file() -> Option<PathBuf> {
    let folder = folders::state()?;
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.join("history"))
}

/// Brings back the lines of earlier sessions.
pub fn recall(editor: &mut LineEditor, file: Option<&Path>) {
    if let Some(file) = file {
        // There is none at the first start.
        drop(editor.load_history(file));
    }
}

/// Keeps a line, and on disk at once, so that a crash loses nothing.
pub fn keep(editor: &mut LineEditor, line: &str, file: Option<&Path>) {
    if !line.trim().is_empty()
        && matches!(editor.add_history_entry(line), Ok(true))
        && let Some(file) = file
    {
        // A history that cannot be kept is no reason to stop.
        drop(editor.append_history(file));
    }
}
