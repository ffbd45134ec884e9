//! A bar on a terminal that shows how much of a long piece of work is done.

use std::cell::Cell;
use std::io::{self, IsTerminal, Write};

/// The bar; nothing on what is not a terminal.
#[derive(Debug, Default)]
pub struct ProgressBar {
    /// What it shows, per cent.
    shown: Cell<Option<u32>>,
}

/// Its length, in characters.
const LENGTH: usize = 40;

impl ProgressBar {
    /// Shows a share from 0 to 1; at 1 it goes away.
    pub fn show(&self, share: f64) {
        let per_cent = (100.0 * share.clamp(0.0, 1.0)) as u32;
        if self.shown.get() == Some(per_cent) || !io::stderr().is_terminal() {
            return;
        }
        self.shown.set(Some(per_cent));
        let text = if per_cent >= 100 {
            format!("\r{:1$}\r", "", LENGTH + 8)
        } else {
            let n = LENGTH * per_cent as usize / 100;
            format!("\r[{}{}] {per_cent:>3} %", "#".repeat(n), " ".repeat(LENGTH - n))
        };
        let mut err = io::stderr().lock();
        // A bar that cannot be seen is not missed.
        drop(err.write_all(text.as_bytes()).and_then(|()| err.flush()));
    }
}
