//! Where the points were at the last frames, and where that lets us expect them.

use crate::constraint::{Point, Vector};

/// Extrapolation to the next of equally spaced frames, by how many past ones are used.
const WEIGHTS: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [2.0, -1.0, 0.0, 0.0], [3.0, -3.0, 1.0, 0.0], [4.0, -6.0, 4.0, -1.0]];

/// The last converged poses of the free points of an island, one a frame.
#[derive(Debug, Clone, Default)]
pub(super) struct History {
    /// Four poses in a ring, one after the other; only one where nothing is to be expected from
    /// them, none until a frame was solved.
    poses: Vec<Point>,
    /// The points of a pose.
    n_points: usize,
    /// Which of them the present frame began with.
    head: usize,
    /// How many before that are known.
    n_past: usize,
}

impl History {
    /// The bytes it keeps.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.poses)
    }

    /// How many poses before the present one are known.
    pub fn n_past(&self) -> usize {
        self.n_past
    }

    /// Forgets all but the present pose: what comes next does not follow from what was.
    pub fn forget(&mut self) {
        self.n_past = 0;
    }

    /// Keeps the pose that a frame begins with.
    pub fn begin(&mut self, free: &[Point]) {
        let n = free.len();
        if self.poses.len() != 4 * n {
            *self = Self { poses: vec![Point::ORIGIN; 4 * n], n_points: n, ..Self::default() };
        }
        self.poses[self.head * n..][..n].copy_from_slice(free);
    }

    /// Keeps the pose that a frame begins with, and no other.
    pub fn begin_anew(&mut self, free: &[Point]) {
        let mut poses = std::mem::take(&mut self.poses);
        poses.clear();
        poses.extend_from_slice(free);
        *self = Self { poses, n_points: free.len(), ..Self::default() };
    }

    /// The pose the frame began with.
    pub fn origin(&self) -> &[Point] {
        self.past(0)
    }

    /// The pose of `k` frames before that.
    pub fn past(&self, k: usize) -> &[Point] {
        let n = self.n_points;
        &self.poses[((self.head + 4 - k) & 3) * n..][..n]
    }

    /// Puts the points where they are expected at the end of the frame; `degree` is the
    /// degree up to which the motion of each is smooth. False if nothing is known.
    pub fn predict(&self, degree: &[u8], free: &mut [Point]) -> bool {
        if self.n_past == 0 {
            return false;
        }
        let past = [self.past(0), self.past(1), self.past(2), self.past(3)];
        for (k, (to, degree)) in free.iter_mut().zip(degree).enumerate() {
            let weights = &WEIGHTS[self.n_past.min(*degree as usize)];
            // Differences to the present place, so that nothing is lost far from the origin.
            let here = past[0][k];
            let mut d = Vector::ZERO;
            for (pose, weight) in past[1..].iter().zip(&weights[1..]) {
                d += (pose[k] - here) * *weight;
            }
            *to = here + d;
        }
        true
    }

    /// The frame was solved: its beginning is past.
    pub fn advance(&mut self) {
        self.head = (self.head + 1) & 3;
        self.n_past = (self.n_past + 1).min(3);
    }

    /// The past poses, the latest first, for keeping.
    pub fn to_past(&self) -> Vec<Point> {
        (1..=self.n_past).flat_map(|k| self.past(k).iter().copied()).collect()
    }

    /// The history with these past poses of `n_free` points, the latest first.
    pub fn from_past(past: &[Point], n_free: usize) -> Self {
        if past.is_empty() || n_free == 0 {
            return Self::default();
        }
        let poses = vec![Point::ORIGIN; 4 * n_free];
        let mut history = Self { poses, n_points: n_free, head: 3, n_past: 0 };
        for (k, pose) in past.chunks_exact(n_free).take(3).enumerate() {
            history.poses[(2 - k) * n_free..][..n_free].copy_from_slice(pose);
            history.n_past = k + 1;
        }
        history
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(n: usize, degree: u8) -> Option<f64> {
        let mut history = History::default();
        for k in 0..n {
            history.begin(&[Point::new((k as f64).powi(3), 0.0)]);
            if k + 1 < n {
                history.advance();
            }
        }
        let mut free = [Point::ORIGIN];
        history.predict(&[degree], &mut free).then_some(free[0].x)
    }

    #[test]
    fn a_cubic_motion_is_expected_where_it_goes() {
        assert_eq!(after(1, 3), None);
        assert_eq!(after(6, 3), Some(216.0));
        assert_eq!(after(6, 1), Some(2.0 * 125.0 - 64.0));
    }

    #[test]
    fn a_kept_history_expects_the_same() {
        let mut history = History::default();
        for k in 0..6 {
            history.begin(&[Point::new(f64::from(k * k), 1.0)]);
            history.advance();
        }
        let mut kept = History::from_past(&history.to_past(), 1);
        let mut both = [[Point::ORIGIN]; 2];
        for (history, free) in [&mut history, &mut kept].into_iter().zip(&mut both) {
            history.begin(&[Point::new(36.0, 1.0)]);
            assert!(history.predict(&[3], free));
        }
        assert_eq!(both[0], both[1]);
        assert_eq!(both[0][0].x, 49.0);
    }
}
