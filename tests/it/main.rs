//! What the library and the program promise, as one crate: a test is a line in a module, not a
//! binary of its own.

// A test compares with what any platform gives: nothing of it has to keep its bits.
#![allow(clippy::disallowed_methods)]

mod architecture;
mod circles;
mod edge_values;
mod editors;
mod errors;
mod examples;
mod exports;
mod expressions;
mod files;
mod fits;
mod format;
mod front_door;
mod golden;
mod guide;
mod habits;
mod hard_cases;
mod interrupts;
mod json;
mod language_server;
mod laps;
mod laws;
mod long_texts;
mod looks;
mod measures;
mod mobility;
mod motors;
mod pictures;
mod program;
mod quotas;
mod readme;
mod recordings;
mod render;
mod reproducible;
mod scripts;
mod session;
mod slips;
mod solve;
mod study;
mod support;
mod sweep;
mod tables;
#[cfg(unix)]
mod terminal;
mod touches;
mod view;
mod watch;
mod well_formed;
mod words;
mod work;
