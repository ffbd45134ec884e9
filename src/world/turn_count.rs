//! How far directions have turned: a count for each that is asked for, followed from pose to pose.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::{ConstraintId, PointId, World};
use crate::constraint::{Carried, ConstraintKind as _, Point, Winding};

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
    by_motors: BTreeMap<Turning, f64>,
    /// The motors that turn what is counted, in the order of the counts.
    motors: Vec<[Option<ConstraintId>; 2]>,
    /// The revision of the world at which these were the motors.
    revision: Option<u64>,
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
    fn pairs(&self) -> ([PointId; 2], Option<[PointId; 2]>) {
        match *self {
            Self::Direction(pair) => (pair, None),
            Self::Between([a, b, c, d]) => ([c, d], Some([a, b])),
        }
    }

    /// The angle in (-pi, pi] with all points at these places; none where two coincide.
    fn angle(&self, x: &[Point]) -> Option<f64> {
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
    fn near(expected: f64, angle: f64) -> Winding {
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

impl World {
    /// The counts there are.
    pub fn turn_counts(&self) -> impl Iterator<Item = (Turning, &TurnCount)> {
        self.turn_counts.iter().map(|(turning, count)| (*turning, count))
    }

    /// Whether something is counted already.
    pub fn counts(&self, turning: Turning) -> bool {
        self.turn_counts.contains_key(&turning)
    }

    /// How far something has turned as of the last accepted pose; where it is not counted yet,
    /// what its count would begin with.
    pub fn turn_count(&self, turning: Turning) -> TurnCount {
        self.turn_counts.get(&turning).copied().unwrap_or_else(|| {
            let winding = self
                .first_count(turning, self.points.column(), |motor| Some(self.motor_angle(motor)));
            TurnCount { winding, start: None }
        })
    }

    /// The angle with whole turns that the direction of now is nearest to: as of the last accepted
    /// pose, and motors have turned on since.
    pub(super) fn expected_turn(&self, turning: Turning) -> f64 {
        let ahead = self.turns_ahead.by_motors.get(&turning);
        self.turn_count(turning).total() + ahead.copied().unwrap_or_default()
    }

    /// A count that begins at a pose: without turns, but for those of motors that turn it.
    fn first_count(
        &self,
        turning: Turning,
        x: &[Point],
        motor_angle: impl Fn(ConstraintId) -> Option<f64>,
    ) -> Winding {
        let angle = turning.angle(x).unwrap_or(0.0);
        let motors = self.motors_of(turning);
        if motors == [None; 2] {
            return Winding::new(angle);
        }
        let (pair, against) = turning.pairs();
        let of = |motor: Option<ConstraintId>, pair| {
            let turned = motor.and_then(&motor_angle);
            turned.or_else(|| Turning::Direction(pair).angle(x)).unwrap_or(0.0)
        };
        let expected = of(motors[0], pair) - against.map_or(0.0, |pair| of(motors[1], pair));
        TurnCount::near(expected, angle)
    }

    /// The motors that turn exactly a direction, and the one it turns against.
    fn motors_of(&self, turning: Turning) -> [Option<ConstraintId>; 2] {
        let motor_of = |pair: [PointId; 2]| {
            let mut motors = self.constraints().filter(|(_, record)| {
                let points = record.constraint.points();
                record.is_on
                    && points == pair.map(|id| id.0)
                    && record.constraint.traits().carried == Carried::ByClock
            });
            motors.next().map(|(id, _)| id)
        };
        let (pair, against) = turning.pairs();
        [motor_of(pair), against.and_then(motor_of)]
    }

    /// Begins a frame; gives the angles of the motors that turn what is counted, for
    /// [`note_turns`](Self::note_turns).
    pub(super) fn angles_before(&mut self) -> Vec<f64> {
        if self.turn_counts.is_empty() {
            return Vec::new();
        }
        if self.turns_ahead.revision != Some(self.revision) {
            self.turns_ahead.motors = self.turn_counts.keys().map(|&t| self.motors_of(t)).collect();
            self.turns_ahead.revision = Some(self.revision);
        }
        self.angles_of_motors()
    }

    fn angles_of_motors(&self) -> Vec<f64> {
        let angle = |motor: Option<ConstraintId>| motor.map_or(0.0, |id| self.motor_angle(id));
        self.turns_ahead.motors.iter().map(|&[of, against]| angle(of) - angle(against)).collect()
    }

    /// Notes by how much motors have turned what is counted in this frame.
    pub(super) fn note_turns(&mut self, before: &[f64]) {
        if before.is_empty() {
            return;
        }
        let turned: Vec<f64> =
            self.angles_of_motors().iter().zip(before).map(|(now, before)| now - before).collect();
        let counted = self.turn_counts.keys().copied().zip(turned);
        self.turns_ahead.by_motors = counted.filter(|(_, by)| *by != 0.0).collect();
    }

    /// Counts on: the pose is accepted.
    pub fn follow_turns(&mut self) {
        if self.turn_counts.is_empty() {
            return;
        }
        let ahead = std::mem::take(&mut self.turns_ahead.by_motors);
        for (turning, count) in &mut self.turn_counts {
            if let Some(angle) = turning.angle(&self.points.at) {
                let ahead = ahead.get(turning).copied().unwrap_or_default();
                count.winding = TurnCount::near(count.total() + ahead, angle);
            }
        }
        self.dependencies.note_change();
    }

    /// The clock leaves 0: `reset` brings back the counts of now.
    pub(super) fn note_first_turns(&mut self) {
        self.turn_counts.values_mut().for_each(|count| count.start = Some(count.winding));
    }

    /// The counts that `reset` brings back; one that was begun later begins at the start.
    pub(super) fn turn_counts_at_start(&self) -> TurnCounts {
        let start = |(&turning, count): (&Turning, &TurnCount)| {
            let winding = count.start.unwrap_or_else(|| {
                self.first_count(turning, self.points.start_column(), |motor| {
                    self.motor_angle_at_start(motor)
                })
            });
            (turning, TurnCount { winding, start: None })
        };
        self.turn_counts.iter().map(start).collect()
    }

    pub(super) fn swap_turn_count(
        &mut self,
        turning: Turning,
        count: Option<TurnCount>,
    ) -> Option<TurnCount> {
        self.turns_ahead = TurnsAhead::default();
        self.dependencies.note_change();
        match count {
            Some(count) => self.turn_counts.insert(turning, count),
            None => self.turn_counts.remove(&turning),
        }
    }
}

/// Whether two sets of counts are the same to the bit.
pub(super) fn are_same_counts(a: &TurnCounts, b: &TurnCounts) -> bool {
    let bits = |winding: Winding| winding.to_numbers().map(f64::to_bits);
    let is_same = |((t, a), (u, b)): ((&Turning, &TurnCount), (&Turning, &TurnCount))| {
        t == u && bits(a.winding) == bits(b.winding) && a.start.map(bits) == b.start.map(bits)
    };
    a.len() == b.len() && a.iter().zip(b).all(is_same)
}
