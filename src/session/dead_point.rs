//! Motors that cannot go on: noticing it, saying so, and what happens then.

use super::Session;
use super::limits_of::degrees;
use super::subject::Parts;
use crate::constraint::geometry::wrap;
use crate::constraint::{Constraint, Field, Point, Relation as _, Turns};
use crate::solve::mobility::{End, dead_end};
use crate::solve::{Memory, Method, Status};
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

/// What is remembered of the world before each frame while motors run; nothing otherwise.
pub(super) struct Lookout {
    motors: Vec<Running>,
    x: Vec<Point>,
    /// All that a frame changes, where it may have to be taken back.
    before: Option<(Box<Motion>, Box<Memory>)>,
}

/// A motor that runs.
struct Running {
    id: ConstraintId,
    turned: Turns,
    /// How what it drives stood before the frame; none if it was not looked at yet.
    status: Option<Status>,
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
    /// The motors that run.
    pub(super) fn lookout(&self) -> Lookout {
        let motors = self.world.constraints().filter_map(|(id, record)| {
            let Constraint::Motor(motor) = &record.constraint else { return None };
            let is_running = record.is_on
                && (motor.get(Field::Speed) != Some(0.0) || record.driver(Field::Speed).is_some());
            is_running.then(|| Running { id, turned: motor.turned(), status: None })
        });
        Lookout { motors: motors.collect(), x: Vec::new(), before: None }
    }

    /// Remembers the world before a frame.
    pub(super) fn look_out(&self, lookout: &mut Lookout) {
        if lookout.motors.is_empty() {
            return;
        }
        lookout.x.clear();
        lookout.x.extend_from_slice(self.world.points().column());
        for running in &mut lookout.motors {
            running.status = self.solver.status_of_constraint(running.id);
            if let Some(record) = self.world.constraint(running.id)
                && let Constraint::Motor(motor) = &record.constraint
            {
                running.turned = motor.turned();
            }
        }
        if self.preferences.dead_points != AtDeadPoint::Hold {
            let motion = Box::new(self.world.motion());
            lookout.before = Some((motion, Box::new(self.solver.memory())));
        }
    }

    /// Looks for motors that met a dead point in frame `k` of `n`, which was not solved, and
    /// does what is to be done then.
    pub(super) fn met(&mut self, lookout: &Lookout, k: u64, n: u64) -> Next {
        let met: Vec<(ConstraintId, String, String)> = lookout
            .motors
            .iter()
            .filter_map(|running| {
                let (what, at) = self.dead_point(lookout, running)?;
                Some((running.id, what, at))
            })
            .collect();
        if met.is_empty() {
            return Next::On;
        }
        let frame = self.world.clock().frame;
        let told: Vec<String> = met
            .iter()
            .map(|(id, what, at)| {
                let name = self.world.name_of(Entity::Constraint(*id));
                format!("{name} {what} {at}")
            })
            .collect();
        let told = told.join(", ");
        match (self.preferences.dead_points, &lookout.before) {
            (AtDeadPoint::Stop, Some((motion, memory))) => {
                self.take_back(motion, memory);
                self.note(format!("{told}: stopped after {} of {n} frames", k - 1));
                Next::Stop
            }
            (AtDeadPoint::Reverse, Some((motion, memory))) => {
                if let Some((id, ..)) = met.iter().find(|(id, ..)| !self.can_reverse(*id)) {
                    let name = self.world.name_of(Entity::Constraint(*id));
                    self.note(format!(
                        "{told} in frame {frame}; the speed of {name} is an expression and \
                         cannot be reversed"
                    ));
                    return Next::On;
                }
                self.take_back(motion, memory);
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

    /// What a motor met in the frame that was just tried, and where; none if it did not.
    fn dead_point(&self, lookout: &Lookout, running: &Running) -> Option<(String, String)> {
        let now = self.solver.status_of_constraint(running.id)?;
        if now == Status::Converged || running.status.is_some_and(|s| s != Status::Converged) {
            return None;
        }
        let mut parts = Parts::of(&self.world);
        let place = parts.place(running.id)?;
        let mut way = 0.0;
        for other in &lookout.motors {
            let Some(k) = parts.place(other.id) else { continue };
            let Constraint::Motor(motor) = &mut parts.constraints[k] else { continue };
            if k == place {
                way = motor.turned().total() - other.turned.total();
            }
            motor.set_turned(other.turned);
        }
        if way == 0.0 {
            return None;
        }
        let found = parts.with(&lookout.x, |scene| dead_end(scene, place, way));
        match found {
            Some(End::DeadPoint(angle)) => {
                Some(("meets a dead point at".to_owned(), degrees(wrap(angle))))
            }
            Some(End::Stop(angle, by)) => {
                let by = self.world.name_of(Entity::Constraint(parts.ids[by]));
                Some((format!("is stopped by {by} at"), degrees(wrap(angle))))
            }
            // Something else moves along with it.
            _ if now == Status::BestFit
                && running.status.is_some()
                && self.preferences.solve.method == Method::Auto =>
            {
                let Constraint::Motor(motor) = &parts.constraints[place] else { return None };
                Some(("cannot go on beyond".to_owned(), degrees(motor.angle())))
            }
            _ => None,
        }
    }

    fn take_back(&mut self, motion: &Motion, memory: &Memory) {
        self.world.apply(Edit::Motion(Box::new(motion.clone())));
        self.solver.set_memory(memory.clone());
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
