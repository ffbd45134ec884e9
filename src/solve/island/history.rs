//! Where the points were at the last frames, and where that lets us expect them.

use crate::constraint::{Point, Vector};

/// Extrapolation to the next of equally spaced frames, by how many past ones are used.
const WEIGHTS: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [2.0, -1.0, 0.0, 0.0], [3.0, -3.0, 1.0, 0.0], [4.0, -6.0, 4.0, -1.0]];

/// The last converged poses of the free points of an island, one a frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct History {
    /// Poses in a ring, one after the other: four, or as many as the motion is expected from;
    /// none until a frame was solved.
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

    /// Keeps the pose that a frame begins with; `degree` is the highest up to which the motion
    /// of a point is smooth.
    pub fn begin(&mut self, free: &[Point], degree: u8) {
        self.begin_with(free.iter().copied(), degree);
    }

    /// The same, of places that come one by one.
    pub fn begin_with(&mut self, free: impl ExactSizeIterator<Item = Point>, degree: u8) {
        let n = free.len();
        let n_poses = if degree > 1 { 4 } else { 2 };
        if self.poses.len() != n_poses * n || self.n_points != n {
            *self = Self::with_past(&self.to_past(), n, n_poses);
        }
        self.poses[self.head * n..][..n].iter_mut().zip(free).for_each(|(to, at)| *to = at);
    }

    /// Keeps the pose that a frame begins with, and no other.
    pub fn begin_anew(&mut self, free: &[Point]) {
        let mut poses = std::mem::take(&mut self.poses);
        poses.clear();
        poses.extend_from_slice(free);
        *self = Self { poses, n_points: free.len(), ..Self::default() };
    }

    /// How many poses the ring has: 1, 2 or 4.
    fn n_poses(&self) -> usize {
        (self.poses.len() / self.n_points.max(1)).max(1)
    }

    /// The pose the frame began with.
    pub fn origin(&self) -> &[Point] {
        self.past(0)
    }

    /// The pose of `k` frames before that.
    pub fn past(&self, k: usize) -> &[Point] {
        let (n, n_poses) = (self.n_points, self.n_poses());
        &self.poses[((self.head + n_poses - k) & (n_poses - 1)) * n..][..n]
    }

    /// Puts the points where they are expected at the end of the frame; `degree` is the
    /// degree up to which the motion of each is smooth. False if nothing is known.
    pub fn predict(&self, degree: &[u8], free: &mut [Point]) -> bool {
        if self.n_past == 0 {
            return false;
        }
        let past = [0, 1, 2, 3].map(|k| self.past(k.min(self.n_past)));
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

    /// Where a point is expected whose motion is smooth; none if nothing is known.
    pub fn expect(&self, p: usize) -> Option<Point> {
        let here = *self.past(0).get(p).filter(|_| self.n_past > 0)?;
        let mut d = Vector::ZERO;
        for (k, weight) in WEIGHTS[self.n_past].iter().enumerate().skip(1).take(self.n_past) {
            d += (self.past(k)[p] - here) * *weight;
        }
        Some(here + d)
    }

    /// How far a point went in the last frame; 0 where nothing is known.
    pub fn last_way(&self, p: usize) -> f64 {
        if self.n_past > 0 { self.past(0)[p].distance(self.past(1)[p]) } else { 0.0 }
    }

    /// The frame was solved: its beginning is past.
    pub fn advance(&mut self) {
        let n_poses = self.n_poses();
        self.head = (self.head + 1) & (n_poses - 1);
        self.n_past = (self.n_past + 1).min(n_poses - 1);
    }

    /// The past poses, the latest first, for keeping.
    pub fn to_past(&self) -> Vec<Point> {
        let mut past = Vec::with_capacity(self.n_past * self.n_points);
        (1..=self.n_past).for_each(|k| past.extend_from_slice(self.past(k)));
        past
    }

    /// The history with these past poses of `n_free` points, the latest first.
    pub fn from_past(past: &[Point], n_free: usize) -> Self {
        if past.is_empty() { Self::default() } else { Self::with_past(past, n_free, 4) }
    }

    fn with_past(past: &[Point], n_points: usize, n_poses: usize) -> Self {
        let poses = vec![Point::ORIGIN; n_poses * n_points];
        let mut history = Self { poses, n_points, head: n_poses - 1, n_past: 0 };
        if n_points == 0 || !past.len().is_multiple_of(n_points) {
            return history;
        }
        for (k, pose) in past.chunks_exact(n_points).take(n_poses - 1).enumerate() {
            let at = history.head - 1 - k;
            history.poses[at * n_points..][..n_points].copy_from_slice(pose);
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
            history.begin(&[Point::new((k * k * k) as f64, 0.0)], degree);
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
            history.begin(&[Point::new(f64::from(k * k), 1.0)], 3);
            history.advance();
        }
        let mut kept = History::from_past(&history.to_past(), 1);
        let mut both = [[Point::ORIGIN]; 2];
        for (history, free) in [&mut history, &mut kept].into_iter().zip(&mut both) {
            history.begin(&[Point::new(36.0, 1.0)], 3);
            assert!(history.predict(&[3], free));
        }
        assert_eq!(both[0], both[1]);
        assert_eq!(both[0][0].x, 49.0);
    }
}
