//! How much of a long piece of work is done, and how long the rest will take: one line on a
//! terminal, gone when anything else is said.

use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Work that is over sooner shows none.
const SHORT: Duration = Duration::from_millis(500);
/// Between two changes of what is shown.
const PAUSE: Duration = Duration::from_millis(100);
/// Of the bar, in characters: with what stands behind it, it fits 40 columns.
const LENGTH: usize = 16;

static IS_SHOWN: AtomicBool = AtomicBool::new(false);

/// The progress of one piece of work at a time.
#[derive(Debug, Default)]
pub struct ProgressBar {
    begun: Cell<Option<Instant>>,
    shown: Cell<Option<Instant>>,
}

impl ProgressBar {
    /// Shows a share from 0, where work begins, to 1, where it is done.
    pub fn show(&self, share: f64) {
        if !is_terminal() {
            return;
        }
        let now = Instant::now();
        if share <= 0.0 {
            self.begun.set(Some(now));
            return;
        }
        if share >= 1.0 {
            self.begun.set(None);
            clear();
            return;
        }
        let Some(begun) = self.begun.get() else { return self.begun.set(Some(now)) };
        let is_due = self.shown.get().is_none_or(|shown| now - shown >= PAUSE);
        if now - begun < SHORT || !is_due {
            return;
        }
        self.shown.set(Some(now));
        draw(&line(share, (now - begun).as_secs_f64()));
    }
}

/// What is shown of work of which a share was done in so many seconds.
fn line(share: f64, seconds: f64) -> String {
    let n = (LENGTH as f64 * share) as usize;
    let left = duration(seconds * (1.0 - share) / share);
    let (done, rest) = ("#".repeat(n), " ".repeat(LENGTH - n));
    format!("[{done}{rest}] {:>2} %, {left} left", (100.0 * share) as u32)
}

fn duration(seconds: f64) -> String {
    // What takes longer than some hundred years is not waited for.
    let whole = seconds.ceil().min(4e9) as u64;
    match whole {
        0..=99 => format!("{whole} s"),
        100..=5999 => format!("{} min", whole.div_ceil(60)),
        6000..=359_999 => format!("{} h", whole.div_ceil(3600)),
        _ => format!("{} days", whole.div_ceil(86400)),
    }
}

fn draw(text: &str) {
    let mut err = io::stderr().lock();
    IS_SHOWN.store(true, Ordering::Relaxed);
    // A bar that cannot be seen is not missed.
    drop(write!(err, "\r{text:<39}").and_then(|()| err.flush()));
}

/// Takes away what is shown, before anything else is said.
pub fn clear() {
    if IS_SHOWN.swap(false, Ordering::Relaxed) {
        let mut err = io::stderr().lock();
        drop(write!(err, "\r{:<39}\r", "").and_then(|()| err.flush()));
    }
}

fn is_terminal() -> bool {
    static IS_TERMINAL: OnceLock<bool> = OnceLock::new();
    *IS_TERMINAL.get_or_init(|| io::stderr().is_terminal())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shown_fits_forty_columns() {
        assert_eq!(line(0.25, 2.0), "[####            ] 25 %, 6 s left");
        for (share, seconds) in [(1e-9, 0.6), (0.999, 1e5), (0.33333, 0.7)] {
            assert!(line(share, seconds).chars().count() < 40, "{}", line(share, seconds));
        }
    }
}
