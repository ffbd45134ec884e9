//! Bytes that are put aside while a recording is made, because memory is too small for them.

use std::fmt::Debug;
use std::io;
use std::sync::{Arc, Mutex, PoisonError};

/// A place for bytes. They go with it when it goes.
pub trait Spool: Debug + Send {
    /// Adds bytes at the end.
    ///
    /// # Errors
    /// Where there is no room.
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Gives bytes that were added from a place on.
    ///
    /// # Errors
    /// Where they cannot be read.
    fn read(&mut self, from: u64, bytes: &mut [u8]) -> io::Result<()>;

    /// Takes back what was added behind the first bytes.
    fn truncate(&mut self, n_bytes: u64);
}

impl Spool for Vec<u8> {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.extend_from_slice(bytes);
        Ok(())
    }

    fn read(&mut self, from: u64, bytes: &mut [u8]) -> io::Result<()> {
        let there =
            usize::try_from(from).ok().and_then(|from| self.get(from..)?.get(..bytes.len()));
        bytes.copy_from_slice(there.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }

    fn truncate(&mut self, n_bytes: u64) {
        self.truncate(n_bytes as usize);
    }
}

/// Numbers on a spool. An undo leaves them there for a redo; what failed is cut off.
#[derive(Debug, Clone)]
pub struct Tape(Arc<Mutex<Reels>>);

#[derive(Debug)]
struct Reels {
    spool: Box<dyn Spool>,
    n_bytes: u64,
}

impl Tape {
    /// A tape on an empty spool.
    pub fn new(spool: Box<dyn Spool>) -> Self {
        Self(Arc::new(Mutex::new(Reels { spool, n_bytes: 0 })))
    }

    /// Puts numbers on it; gives where they are.
    pub fn put(&self, numbers: &[f64]) -> io::Result<u64> {
        let mut reels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let at = reels.n_bytes;
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        reels.spool.append(&bytes)?;
        reels.n_bytes += bytes.len() as u64;
        Ok(at)
    }

    /// So many numbers from a place on.
    pub fn get(&self, at: u64, n: usize) -> io::Result<Vec<f64>> {
        let mut bytes = vec![0; n * size_of::<f64>()];
        let mut reels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        reels.spool.read(at, &mut bytes)?;
        let (numbers, _) = bytes.as_chunks();
        Ok(numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
    }

    /// Takes back what was put on it behind the first bytes.
    pub fn cut(&self, n_bytes: u64) {
        let mut reels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if n_bytes < reels.n_bytes {
            reels.n_bytes = n_bytes;
            reels.spool.truncate(n_bytes);
        }
    }

    /// Bytes on it.
    pub fn n_bytes(&self) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).n_bytes
    }
}
