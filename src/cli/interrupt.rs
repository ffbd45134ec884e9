//! Ctrl-C, and what else asks the program to stop: flags that are polled while it works.
//!
//! Ctrl-C stops the command under way, and ends the program when it is pressed again before that came
//! to be. What asks the program to end (SIGTERM, SIGHUP) stops the command too, and then ends
//! everything in order: recordings are written. Where input is waited for there is no command to be
//! stopped: Ctrl-C ends the program at once.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// Exit status of a process that Ctrl-C ended, as a shell reports it.
pub const STATUS: u8 = 130;

static IS_ASKED: AtomicBool = AtomicBool::new(false);
/// Whether Ctrl-C, where input is waited for, is no wish to end.
static IS_PATIENT: AtomicBool = AtomicBool::new(false);
/// Who waits for input, if anybody does: a [`Wait`] as a number, or 0.
static WAIT: AtomicU8 = AtomicU8::new(0);
/// The exit status of a program that was asked to end, or 0.
static ENDING: AtomicU8 = AtomicU8::new(0);

/// How input is waited for. Nothing is under way meanwhile: Ctrl-C ends the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Wait {
    /// There is nothing to be put in order: whatever asks the program to end does so at once.
    Blocked = 1,
    /// It looks by itself whether the program was asked to end.
    Looking,
    /// Some signal wakes it, and then it looks.
    Prompt,
}

impl Wait {
    fn is_on(self) -> bool {
        WAIT.load(Ordering::Relaxed) == self as u8
    }

    fn during<T>(self, wait: impl FnOnce() -> T) -> T {
        WAIT.store(self as u8, Ordering::SeqCst);
        if IS_PATIENT.load(Ordering::Relaxed) {
            // What came after the last input was done was no wish to stop the next.
            forget();
        }
        let result = wait();
        WAIT.store(0, Ordering::Relaxed);
        result
    }
}

/// From here on Ctrl-C sets the flag; while input is waited for, or the flag is set already, it ends
/// the process. Where no handler can be installed, Ctrl-C goes on ending the process.
///
/// To be called before there are other threads.
pub fn listen() {
    endings::listen();
    drop(ctrlc::set_handler(|| {
        if is_ending() {
            // It only woke who waited.
            return;
        }
        // In this order, and in the other where it is waited: what comes as a wait begins is seen by one.
        let was_asked = IS_ASKED.swap(true, Ordering::SeqCst);
        let is_waiting = WAIT.load(Ordering::SeqCst) != 0;
        if is_waiting && IS_PATIENT.load(Ordering::Relaxed) {
            IS_ASKED.store(false, Ordering::SeqCst);
            return;
        }
        if was_asked || is_waiting {
            std::process::exit(STATUS.into());
        }
    }));
}

/// From here on Ctrl-C ends nothing where input is waited for, nor stops what is read next: it was meant for
/// the program that gives the input, and goes to both.
pub fn be_patient() {
    IS_PATIENT.store(true, Ordering::Relaxed);
}

/// Whether Ctrl-C was pressed since it was last forgotten, or the program was asked to end.
pub fn is_asked() -> bool {
    IS_ASKED.load(Ordering::Relaxed) || is_ending()
}

/// Whether the program was asked to end.
pub fn is_ending() -> bool {
    ending().is_some()
}

/// The exit status of a program that was asked to end, if it was.
pub fn ending() -> Option<u8> {
    Some(ENDING.load(Ordering::Relaxed)).filter(|status| *status != 0)
}

/// Forgets that Ctrl-C was pressed.
pub fn forget() {
    IS_ASKED.store(false, Ordering::SeqCst);
}

/// Waits for what nothing can wake, before there is anything to lose: who stops it ends the process.
pub fn while_waiting<T>(wait: impl FnOnce() -> T) -> T {
    Wait::Blocked.during(wait)
}

/// Waits at a prompt that a signal wakes.
pub fn at_prompt<T>(wait: impl FnOnce() -> T) -> T {
    Wait::Prompt.during(wait)
}

/// How long a wait goes on before it looks whether the program was asked to end.
const LOOK: Duration = Duration::from_millis(50);

/// What another thread sends next; none where that has ended, or the program was asked to end.
pub fn next_from<T>(sent: &Receiver<T>) -> Option<T> {
    Wait::Looking.during(|| {
        loop {
            match sent.recv_timeout(LOOK) {
                Ok(next) => return Some(next),
                Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) if is_ending() => return None,
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    })
}

#[cfg(unix)]
mod endings {
    //! SIGTERM and SIGHUP, waited for by a thread of their own: no handler has to be quick.

    use std::sync::atomic::Ordering;
    use std::thread;
    use std::time::Duration;

    use nix::sys::signal::{SigSet, Signal, kill};
    use nix::unistd::Pid;

    use super::{ENDING, Wait};

    /// What a shell adds to the number of a signal for the exit status.
    const BY_SIGNAL: u8 = 128;
    /// How long who waits gets to wake up before it is woken again.
    const AGAIN: Duration = Duration::from_millis(20);

    pub fn listen() {
        let signals: SigSet = [Signal::SIGTERM, Signal::SIGHUP].into_iter().collect();
        // Threads that begin later block them too, so that they come to who waits for them.
        if signals.thread_block().is_err() {
            return;
        }
        thread::spawn(move || {
            let Ok(signal) = signals.wait() else { return };
            ENDING.store(BY_SIGNAL + signal as u8, Ordering::Relaxed);
            while Wait::Prompt.is_on() {
                let _ = kill(Pid::this(), Signal::SIGINT);
                thread::sleep(AGAIN);
            }
            // Asked once more, it does not go on.
            let _ = Wait::Blocked.is_on() || signals.wait().is_ok();
            std::process::exit(ENDING.load(Ordering::Relaxed).into());
        });
    }
}

#[cfg(not(unix))]
mod endings {
    //! There are no such signals here.

    pub fn listen() {}
}
