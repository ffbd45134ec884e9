//! How often it is tried whether frames can pass at once.

/// When to try whether frames can pass at once: where they cannot, ever more rarely.
pub(super) struct Pace {
    /// Frames to be done one by one before the next try; none if there is to be none.
    wait: Option<u64>,
    /// How many these were when it was tried last.
    waited: u64,
}

impl Pace {
    /// The most frames between two tries.
    const LONGEST: u64 = 64;

    pub fn new(may_stretch: bool) -> Self {
        Self { wait: may_stretch.then_some(0), waited: 0 }
    }

    /// Whether it is to be tried before the next frame.
    pub fn is_due(&mut self) -> bool {
        match &mut self.wait {
            Some(0) => true,
            Some(wait) => {
                *wait -= 1;
                false
            }
            None => false,
        }
    }

    /// Takes in how many frames passed at once.
    pub fn note(&mut self, n_frames: u64) {
        self.waited = if n_frames > 0 { 0 } else { (2 * self.waited).clamp(1, Self::LONGEST) };
        self.wait = Some(self.waited);
    }
}
