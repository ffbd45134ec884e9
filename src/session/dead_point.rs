//! Motors that cannot go on: noticing it, saying so, and what happens then.

use super::Session;
use super::limits_of::degrees;
use crate::constraint::geometry::wrap;
use crate::constraint::{Field, Relation as _};
use crate::solve::{Halt, Memory, Method};
use crate::world::{ConstraintId, Edit, Entity, Motion};

/// What happens where a motor cannot go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtDeadPoint {
    /// The run ends with the last frame that was solved.
    Stop,
    /// The motor turns on; the points stay as near as they can until they can follow again.
    #[default]
    Hold,
    /// The motor turns back.
    Reverse,
}

impl AtDeadPoint {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Stop, Self::Hold, Self::Reverse];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Hold => "hold",
            Self::Reverse => "reverse",
        }
    }
}

/// All that a frame changes, as it was before; kept only where the frame may have to be taken
/// back.
pub(super) struct Before {
    motion: Motion,
    memory: Memory,
}

/// How a run goes on after a frame that was not solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// The frame counts.
    On,
    /// The frame was taken back and is to be done again.
    Again,
    /// The frame was taken back and the run is over.
    Stop,
}

impl Session {
    /// What a frame that may have to be taken back is about to change.
    pub(super) fn before_frame(&mut self) -> Option<Before> {
        let may_be_taken_back =
            self.preferences.dead_points != AtDeadPoint::Hold && self.world.has_running_motors();
        may_be_taken_back
            .then(|| Before { motion: self.world.motion(), memory: self.solver.memory() })
    }

    /// Looks for motors that met a dead point in frame `k` of `n`, which was not solved, and
    /// does what is to be done then.
    pub(super) fn met(&mut self, before: Option<Before>, k: u64, n: u64) -> Next {
        let halted = self.solver.halted();
        let met: Vec<(ConstraintId, String)> =
            halted.into_iter().filter_map(|(id, halt)| Some((id, self.tell_halt(halt)?))).collect();
        if met.is_empty() {
            return Next::On;
        }
        let frame = self.world.clock().frame;
        let told: Vec<String> = met
            .iter()
            .map(|(id, what)| {
                let name = self.world.name_of(Entity::Constraint(*id));
                format!("{name} {what}")
            })
            .collect();
        let told = told.join(", ");
        match (self.preferences.dead_points, before) {
            (AtDeadPoint::Stop, Some(before)) => {
                self.take_back(before);
                self.note(format!("{told}: stopped after {} of {n} frames", k - 1));
                Next::Stop
            }
            (AtDeadPoint::Reverse, Some(before)) => {
                if let Some((id, ..)) = met.iter().find(|(id, ..)| !self.can_reverse(*id)) {
                    let name = self.world.name_of(Entity::Constraint(*id));
                    self.note(format!(
                        "{told} in frame {frame}; the speed of {name} is an expression and \
                         cannot be reversed"
                    ));
                    return Next::On;
                }
                self.take_back(before);
                met.iter().for_each(|(id, ..)| self.reverse(*id));
                self.note(format!("{told} in frame {frame}; it turns back"));
                Next::Again
            }
            _ => {
                self.note(format!(
                    "{told} in frame {frame}; the best fit is held until it can go on"
                ));
                Next::On
            }
        }
    }

    /// What a motor met in the frame that was just tried, and where; none if nothing that is
    /// worth telling.
    fn tell_halt(&self, halt: Halt) -> Option<String> {
        let at = |angle: f64| degrees(wrap(angle));
        match halt {
            Halt::DeadPoint(angle) => Some(format!("meets a dead point at {}", at(angle))),
            Halt::Stop(angle, by) => {
                let by = self.world.name_of(Entity::Constraint(by));
                Some(format!("is stopped by {by} at {}", at(angle)))
            }
            // Only a best fit says that something moves along with it that cannot.
            Halt::Unclear(angle) if self.preferences.solve.method == Method::Auto => {
                Some(format!("cannot go on beyond {}", at(angle)))
            }
            Halt::Unclear(_) => None,
        }
    }

    fn take_back(&mut self, before: Before) {
        self.world.apply(Edit::Motion(Box::new(before.motion)));
        self.solver.set_memory(before.memory);
    }

    /// Whether a motor's speed is a number, not an expression.
    fn can_reverse(&self, id: ConstraintId) -> bool {
        self.world.constraint(id).is_some_and(|record| record.driver(Field::Speed).is_none())
    }

    fn reverse(&mut self, id: ConstraintId) {
        let Some(mut record) = self.world.constraint(id).cloned() else { return };
        if let Some(speed) = record.constraint.get(Field::Speed) {
            record.constraint.set(Field::Speed, -speed);
            self.edit(Edit::Constraint(id, Some(Box::new(record))));
        }
    }
}
