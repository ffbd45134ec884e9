//! What recordings take, in a file.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use crate::session::Spool;

/// A file without a name, written and read in large pieces.
#[derive(Debug)]
pub struct FileSpool {
    file: File,
    /// Bytes in the file.
    n_written: u64,
    /// What comes behind them.
    pending: Vec<u8>,
    /// A piece of the file, and where it begins.
    piece: (u64, Vec<u8>),
}

/// Bytes of a piece.
const PIECE: usize = 1 << 16;

impl FileSpool {
    /// An empty spool in an empty file.
    pub const fn new(file: File) -> Self {
        Self { file, n_written: 0, pending: Vec::new(), piece: (0, Vec::new()) }
    }

    fn write_pending(&mut self) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(self.n_written))?;
        self.file.write_all(&self.pending)?;
        self.n_written += self.pending.len() as u64;
        self.pending.clear();
        Ok(())
    }
}

impl Spool for FileSpool {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.pending.extend_from_slice(bytes);
        if self.pending.len() >= PIECE { self.write_pending() } else { Ok(()) }
    }

    fn read(&mut self, from: u64, bytes: &mut [u8]) -> io::Result<()> {
        if !self.pending.is_empty() {
            self.write_pending()?;
        }
        let (begins, piece) = &self.piece;
        let end = from + bytes.len() as u64;
        if from < *begins || end > begins + piece.len() as u64 {
            let n = (bytes.len().max(PIECE) as u64).min(self.n_written.saturating_sub(from));
            let mut piece = vec![0; n as usize];
            self.file.seek(SeekFrom::Start(from))?;
            self.file.read_exact(&mut piece)?;
            self.piece = (from, piece);
        }
        let (begins, piece) = &self.piece;
        let there = piece.get((from - begins) as usize..).and_then(|rest| rest.get(..bytes.len()));
        bytes.copy_from_slice(there.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }

    fn truncate(&mut self, n_bytes: u64) {
        self.piece = (0, Vec::new());
        self.pending.truncate(n_bytes.saturating_sub(self.n_written) as usize);
        if n_bytes < self.n_written {
            self.n_written = n_bytes;
            // What stays behind the end is written over.
            drop(self.file.set_len(n_bytes));
        }
    }
}
