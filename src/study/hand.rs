//! Points that are moved along by hand, frame by frame.

use std::sync::Arc;

use crate::constraint::Point;
use crate::world::{Edit, PointId, World};

/// A point that is moved along a path of straight pieces, in each by the same way each frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Hand {
    /// The point.
    pub point: PointId,
    /// Where it is taken up.
    pub from: Point,
    /// The ends of the pieces, each with the share of the frames after which it is reached.
    ends: Arc<[(f64, Point)]>,
}

impl Hand {
    /// A path through places, in so many frames: no fewer than there are places. The pieces get
    /// frames by their length, one at least.
    pub fn new(point: PointId, from: Point, places: &[Point], n_frames: u64) -> Self {
        let n_pieces = places.len() as u64;
        let begins = std::iter::once(&from).chain(places);
        let lengths: Vec<f64> = begins.zip(places).map(|(a, b)| a.distance(*b)).collect();
        let whole: f64 = lengths.iter().sum();
        let (mut way, mut frame) = (0.0, 0);
        let ends = (1..).zip(places).zip(&lengths).map(|((k, place), length)| {
            way += length;
            let share = if whole > 0.0 { way / whole } else { k as f64 / n_pieces as f64 };
            let wanted = (share * n_frames as f64).round() as u64;
            // Those that follow need a frame each.
            frame = wanted.max(frame + 1).min((n_frames + k).saturating_sub(n_pieces));
            (frame as f64 / n_frames as f64, *place)
        });
        Self { point, from, ends: ends.collect() }
    }

    /// Where the point is after `share` of the frames.
    pub fn at(&self, share: f64) -> Point {
        let last = self.ends.len() - 1;
        let k = self.ends[..last].iter().position(|(end, _)| share <= *end).unwrap_or(last);
        let (begin, from) = if k == 0 { (0.0, self.from) } else { self.ends[k - 1] };
        let (end, to) = self.ends[k];
        let way = to - from;
        let part = (share - begin) / (end - begin);
        if part >= 1.0 { from + way } else { from + way * part }
    }

    /// The place that ends piece `k`, or the last one.
    pub fn stop(&self, k: usize) -> Point {
        self.ends[k.min(self.ends.len() - 1)].1
    }

    /// How many pieces the path has.
    pub fn n_pieces(&self) -> usize {
        self.ends.len()
    }
}

/// Moves points to where hands have them after `share` of the frames.
#[inline]
pub fn move_by(hands: &[Hand], share: f64, world: &mut World) {
    for hand in hands {
        world.apply(Edit::Move(hand.point, hand.at(share)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_get_frames_by_their_length() {
        let [a, b, c, d] =
            [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 7.0)].map(|(x, y)| Point::new(x, y));
        let at = |n: u64, k: u64| Hand::new(PointId(0), a, &[b, c, d], n).at(k as f64 / n as f64);
        for (n, k, wanted) in [
            (9, 1, (1.0, 0.0)),
            (9, 2, (2.0, 0.0)),
            (9, 3, (2.0, 1.0)),
            (9, 9, (2.0, 7.0)),
            (3, 1, (2.0, 0.0)),
            (3, 2, (2.0, 1.0)),
            (3, 3, (2.0, 7.0)),
            (4, 3, (2.0, 4.0)),
        ] {
            assert_eq!(at(n, k), Point::new(wanted.0, wanted.1), "frame {k} of {n}");
        }
    }

    #[test]
    fn a_path_that_leads_nowhere_takes_its_frames_too() {
        let hand = Hand::new(PointId(0), Point::ORIGIN, &[Point::ORIGIN; 2], 5);
        assert!((0..=5).all(|k| hand.at(f64::from(k) / 5.0) == Point::ORIGIN));
    }
}
