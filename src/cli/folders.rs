//! Where the program keeps what is the user's own, by the rules of the XDG base directories.

use std::path::PathBuf;

use super::environment;

/// The folder of what goes on from session to session: history, journals.
pub fn state() -> Option<PathBuf> {
    folder("XDG_STATE_HOME", ".local/state")
}

/// The folder of what the user has set up.
pub fn config() -> Option<PathBuf> {
    folder("XDG_CONFIG_HOME", ".config")
}

fn folder(variable: &str, below_home: &str) -> Option<PathBuf> {
    let given =
        environment::variable(variable).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = || environment::variable("HOME").map(|home| PathBuf::from(home).join(below_home));
    Some(given.or_else(home)?.join("linkwork"))
}
