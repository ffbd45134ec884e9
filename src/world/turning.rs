//! Angles that go on past a half turn: what is counted, and how far it has turned.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::{ConstraintId, PointId};
use crate::constraint::{Point, Winding};

/// What is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Turning {
    /// The turning of the direction from one point to another.
    Direction([PointId; 2]),
    /// The turning of the direction from the third point to the fourth against that from the first
    /// to the second.
    Between([PointId; 4]),
}

/// How far a direction has turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnCount {
    /// As of the last pose that was accepted.
    pub(crate) winding: Winding,
    /// What `reset` brings back; none while the clock has not left 0, and where the count was
    /// begun later.
    pub(crate) start: Option<Winding>,
}

/// The counts of a world.
pub(super) type TurnCounts = BTreeMap<Turning, TurnCount>;

/// What the counts of a frame that is being solved go by.
#[derive(Debug, Clone, Default)]
pub(super) struct TurnsAhead {
    /// By how much motors have turned what is counted since the last accepted pose, radians; empty
    /// where none has.
    pub by_motors: BTreeMap<Turning, f64>,
    /// The motors that turn what is counted, in the order of the counts.
    pub motors: Vec<[Option<ConstraintId>; 2]>,
    /// The revision of the world at which these were the motors.
    pub revision: Option<u64>,
}

impl Turning {
    /// What is counted between two points, or four.
    pub fn of(points: &[PointId]) -> Option<Self> {
        match *points {
            [a, b] => Some(Self::Direction([a, b])),
            [a, b, c, d] => Some(Self::Between([a, b, c, d])),
            _ => None,
        }
    }

    /// The points, in the order in which they are named.
    pub fn points(&self) -> &[PointId] {
        match self {
            Self::Direction(points) => points,
            Self::Between(points) => points,
        }
    }

    /// The direction that turns, and the one it turns against; none for the x axis.
    pub(super) fn pairs(&self) -> ([PointId; 2], Option<[PointId; 2]>) {
        match *self {
            Self::Direction(pair) => (pair, None),
            Self::Between([a, b, c, d]) => ([c, d], Some([a, b])),
        }
    }

    /// The angle in (-pi, pi] with all points at these places; none where two coincide.
    pub(super) fn angle(&self, x: &[Point]) -> Option<f64> {
        let vector = |[a, b]: [PointId; 2]| x[b.idx()] - x[a.idx()];
        let (pair, against) = self.pairs();
        let v = vector(pair);
        let u = against.map(vector);
        let has_directions = v.norm() > 0.0 && u.is_none_or(|u| u.norm() > 0.0);
        has_directions.then(|| u.map_or_else(|| v.angle(), |u| u.angle_to(v)))
    }
}

impl TurnCount {
    /// The count nearest to an angle with its whole turns, of a direction in (-pi, pi].
    pub(super) fn near(expected: f64, angle: f64) -> Winding {
        Winding { turns: whole_turns(expected, angle) as i64, angle }
    }

    /// The angle with its whole turns, radians.
    pub fn total(&self) -> f64 {
        total(self.winding)
    }
}

/// The whole turns that take an angle nearest to an expected one.
pub(super) fn whole_turns(expected: f64, angle: f64) -> f64 {
    ((expected - angle) / TAU).round()
}

fn total(winding: Winding) -> f64 {
    (winding.turns as f64).mul_add(TAU, winding.angle)
}

/// Whether two sets of counts are the same to the bit.
pub(super) fn are_same_counts(a: &TurnCounts, b: &TurnCounts) -> bool {
    let bits = |winding: Winding| winding.to_numbers().map(f64::to_bits);
    let is_same = |((t, a), (u, b)): ((&Turning, &TurnCount), (&Turning, &TurnCount))| {
        t == u && bits(a.winding) == bits(b.winding) && a.start.map(bits) == b.start.map(bits)
    };
    a.len() == b.len() && a.iter().zip(b).all(is_same)
}
