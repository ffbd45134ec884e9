//! What a word behind `linkwork` was probably meant to be that names no file.

use std::path::{Path, PathBuf};

use super::args::command_names;
use crate::diag::{Diagnostic, nearest};

/// Adds what a word that names no file was probably meant to be: a file that is there, or a
/// command.
pub fn explain(file: &Path, problem: Diagnostic) -> Diagnostic {
    let word = file.to_string_lossy();
    let commands = command_names();
    let near_command = nearest(&word, commands.iter().map(String::as_str));
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).into_iter().flatten();
    let is_script = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "link");
    let mut there: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()).filter(is_script))
        .map(|path| path.strip_prefix(".").unwrap_or(&path).to_string_lossy().into_owned())
        .collect();
    there.sort_unstable();
    let with_ending = format!("{word}.link");
    let near_file = there
        .iter()
        .find(|name| **name == with_ending)
        .map(String::as_str)
        .or_else(|| nearest(&word, there.iter().map(String::as_str)));
    let problem = match near_command {
        Some(command) => problem.help(format!("did you mean the command `{command}`?")),
        None => problem,
    };
    match near_file {
        Some(name) => problem.help(format!("did you mean the file `{name}`?")),
        None => problem,
    }
}
