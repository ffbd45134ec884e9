//! Variables of the environment. One that is empty is as if it were not there: `NAME= command` takes one back
//! for a single command. Only an empty `PAGER` says something: that there is to be none.

use std::ffi::OsString;

/// What a variable says.
pub fn variable(name: &str) -> Option<OsString> {
    std::env::var_os(name).filter(|value| !value.is_empty())
}

/// What a variable says, where that is text.
pub fn text(name: &str) -> Option<String> {
    variable(name)?.into_string().ok()
}

/// Whether a variable is there and says nothing.
pub fn is_empty(name: &str) -> bool {
    std::env::var_os(name).is_some_and(|value| value.is_empty())
}

/// The name of a variable that says something.
pub fn if_set(name: &'static str) -> Option<&'static str> {
    variable(name).map(|_| name)
}
