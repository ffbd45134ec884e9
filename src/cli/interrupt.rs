//! Ctrl-C as a flag that is polled between frames.

use std::sync::atomic::{AtomicBool, Ordering};

static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C sets the flag instead of ending the process. Where no handler can be
/// installed, Ctrl-C goes on ending the process.
pub fn listen() {
    drop(ctrlc::set_handler(|| IS_ASKED.store(true, Ordering::Relaxed)));
}

/// Whether Ctrl-C was pressed since it was last forgotten.
pub fn is_asked() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}

/// Forgets that Ctrl-C was pressed.
pub fn forget() {
    IS_ASKED.store(false, Ordering::Relaxed);
}
