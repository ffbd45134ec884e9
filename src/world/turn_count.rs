//! The counts of how far directions have turned: begun, followed from pose to pose, set back.

use super::turning::{TurnCounts, TurnsAhead};
use super::{ConstraintId, PointId, TurnCount, Turning, World};
use crate::constraint::{Carried, ConstraintKind as _, Point, Winding};

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
