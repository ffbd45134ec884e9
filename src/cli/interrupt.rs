//! Ctrl-C as a flag that is polled between frames.

use std::sync::atomic::{AtomicBool, Ordering};

/// Exit status of a process that Ctrl-C ended, as a shell reports it.
pub const STATUS: u8 = 130;

static IS_ASKED: AtomicBool = AtomicBool::new(false);
static IS_WAITING: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C sets the flag; while input is waited for, it ends the process. Where no
/// handler can be installed, Ctrl-C goes on ending the process.
pub fn listen() {
    drop(ctrlc::set_handler(|| {
        IS_ASKED.store(true, Ordering::Relaxed);
        if IS_WAITING.load(Ordering::Relaxed) {
            std::process::exit(STATUS.into());
        }
    }));
}

/// Whether Ctrl-C was pressed since it was last forgotten.
pub fn is_asked() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}

/// Forgets that Ctrl-C was pressed.
pub fn forget() {
    IS_ASKED.store(false, Ordering::Relaxed);
}

/// Waits for something that Ctrl-C cannot wake: it ends the process instead.
pub fn while_waiting<T>(wait: impl FnOnce() -> T) -> T {
    IS_WAITING.store(true, Ordering::Relaxed);
    let result = wait();
    IS_WAITING.store(false, Ordering::Relaxed);
    result
}
