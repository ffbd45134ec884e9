//! The samples of a path, shared between the frames of a recording.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::world::{Sample, SampleList};

/// The first `n` samples of a list that only ever grows, so that a thousand frames of a path
/// take the room of one.
#[derive(Debug, Clone)]
pub struct Samples {
    list: Arc<Mutex<SampleList>>,
    n: usize,
}

impl Samples {
    /// A list of its own.
    pub fn new(samples: &SampleList) -> Self {
        Self { n: samples.len(), list: Arc::new(Mutex::new(samples.clone())) }
    }

    /// These samples and what `samples` has beyond them; none unless it begins with these.
    /// Paths are cut short or grow, so that the last sample answers for those before.
    pub fn grown(&self, samples: &SampleList) -> Option<Self> {
        if samples.len() < self.n {
            return None;
        }
        let mut list = self.list();
        if self.n > 0 && list[self.n - 1] != samples[self.n - 1] {
            return None;
        }
        // Another scene may have grown the same list in another way.
        let n_known = list.len().min(samples.len());
        if (self.n..n_known).any(|k| list[k] != samples[k]) {
            return None;
        }
        list.extend((n_known..samples.len()).map(|k| samples[k]));
        Some(Self { list: self.list.clone(), n: samples.len() })
    }

    /// How many there are.
    pub const fn len(&self) -> usize {
        self.n
    }

    /// One of them, by its place in order of time.
    pub fn at(&self, k: usize) -> Sample {
        self.list()[k]
    }

    /// Looks at what there is to see of them, in order of time: laps that repeat come twice at most. Nothing
    /// else may be asked of samples meanwhile: the list may be theirs, too.
    pub fn read<T>(&self, look: impl FnOnce(&[Sample]) -> T) -> T {
        look(&self.list().seen(self.n))
    }

    /// How many of those that are seen of all are among the first `n`.
    pub fn n_seen(&self, n: usize) -> usize {
        self.list().n_seen(n, self.n)
    }

    fn list(&self) -> MutexGuard<'_, SampleList> {
        // A list only ever grows: whoever panicked, it is whole.
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Point;

    fn samples(xs: &[f64]) -> SampleList {
        xs.iter().map(|&x| Sample { at: Point::new(x, 0.0), missed: false }).collect()
    }

    #[test]
    fn growing_shares_and_another_past_does_not() {
        let one = Samples::new(&samples(&[1.0, 2.0]));
        let two = one.grown(&samples(&[1.0, 2.0, 3.0])).expect("it begins with these");
        assert!(Arc::ptr_eq(&two.list, &one.list));
        assert_eq!((one.len(), two.len()), (2, 3));
        assert!(one.grown(&samples(&[1.0, 5.0, 6.0])).is_none());
        assert!(one.grown(&samples(&[1.0])).is_none());
        // The list went on with 3 already: a path that went on otherwise needs its own.
        assert!(one.grown(&samples(&[1.0, 2.0, 9.0])).is_none());
        one.read(|one| assert_eq!(one.iter().map(|s| s.at.x).collect::<Vec<_>>(), [1.0, 2.0]));
    }
}
