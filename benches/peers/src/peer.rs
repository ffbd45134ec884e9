//! What every peer can do.

use cpu_time::ProcessTime;

use crate::work::Place;

/// How a number of frames went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Run {
    /// Time of the processor, of all threads.
    pub seconds: f64,
    /// Frames of which the peer itself says that it did not solve them.
    pub n_failed: usize,
}

/// One program set up for one work.
pub trait Peer {
    /// Drives the driven points to where they are in frame `k` and solves; whether the peer
    /// says that it did.
    fn frame(&mut self, _k: usize) -> bool {
        unreachable!("a peer has frames or runs of them")
    }

    /// Frames `from + 1` to `from + n`, timed.
    ///
    /// # Errors
    /// The peer broke down.
    fn run(&mut self, from: usize, n: usize) -> Result<Run, String> {
        let begun = ProcessTime::now();
        let n_failed = (from + 1..=from + n).filter(|&k| !self.frame(k)).count();
        Ok(Run { seconds: begun.elapsed().as_secs_f64(), n_failed })
    }

    /// Whether it can only run whole blocks of frames, and is fast enough to.
    fn needs_whole_blocks(&self) -> bool {
        false
    }

    /// Where the points are now.
    fn pose(&mut self) -> Vec<Place>;
}
