//! Motors that cannot go on: noticing it, saying so, and what happens then.

use crate::constraint::geometry::wrap;
use crate::constraint::{ConstraintKind as _, Field};
use crate::diag::format_degrees;
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::preferences::AtDeadPoint;
use crate::session::undo::recorder::{Recorder, Reel};
use crate::solve::{Halt, Memory, Method};
use crate::world::{ConstraintId, Edit, Entity, Formula, Moment};

/// A way back to the beginning of a frame, while frames may have to be taken back: all that
/// frames change, as it was before one of them. From there the frames since are done again, to
/// the same bits. One is kept after 0, 1, 2, 4, 8 ... frames: looking at the whole scene before
/// each would cost more than moving what moves in it. Frames that a limit of time may cut short are
/// not the same when done again: with one, it is kept before each.
pub(crate) struct WayBack {
    /// The first frame that could be taken back.
    first: u64,
    /// The frame that this is the beginning of.
    pub frame: u64,
    moment: Moment,
    memory: Memory,
    reels: Vec<Reel>,
}

/// How a run goes on after a frame that was not solved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Next {
    /// The frame counts.
    On,
    /// The frame is to be taken back and done again, with these motors turning back.
    Again(Vec<ConstraintId>),
    /// The frame is to be taken back and the run is over.
    Stop,
}

impl Execution<'_> {
    /// Keeps a way back from frame `k`, which is about to begin, where that is due or `always`.
    pub(crate) fn keep_way_back(&mut self, way_back: &mut Option<WayBack>, k: u64, always: bool) {
        if self.state.preferences.dead_points == AtDeadPoint::Hold
            || !self.state.world.has_running_motors()
        {
            *way_back = None;
            return;
        }
        let first = way_back.as_ref().map_or(k, |way| way.first);
        let is_due =
            way_back.as_ref().is_none_or(|way| k - first >= 2 * (way.frame - first) || always);
        if is_due {
            *way_back = Some(self.way_back(first, k));
        }
    }

    /// A way back from frame `k`, which is about to begin; `first` was the first that there was one
    /// from.
    pub(super) fn way_back(&self, first: u64, k: u64) -> WayBack {
        WayBack {
            first,
            frame: k,
            moment: self.state.world.moment(),
            memory: self.state.solver.memory(),
            reels: self.state.recorders.iter().map(Recorder::mark).collect(),
        }
    }

    /// Puts everything as it was before the frame that a way back is kept of.
    pub(crate) fn go_back(&mut self, way: WayBack) {
        self.state.world.go_to(way.moment);
        self.state.solver.set_memory(way.memory);
        for (recorder, reel) in self.state.recorders.iter_mut().zip(way.reels) {
            recorder.wind(reel);
        }
    }

    /// Looks for motors that met a dead point in frame `k` of `n`, which was not solved, and
    /// says what is to be done then.
    pub(crate) fn met(&mut self, has_way_back: bool, k: u64, n: u64) -> Next {
        let halted = self.state.solver.halted();
        if self.host.takes_findings() {
            let frame = self.state.world.clock().frame;
            let told = halted.iter().filter(|(_, halt)| self.tell_halt(*halt).is_some());
            for (id, halt) in told.copied().collect::<Vec<_>>() {
                let name = self.state.world.name_of(Entity::Constraint(id));
                self.host.find_out(&Finding::Halted(name, frame, halt));
            }
        }
        let met: Vec<(ConstraintId, String)> =
            halted.into_iter().filter_map(|(id, halt)| Some((id, self.tell_halt(halt)?))).collect();
        if met.is_empty() {
            return Next::On;
        }
        let frame = self.state.world.clock().frame;
        let told: Vec<String> = met
            .iter()
            .map(|(id, what)| {
                let name = self.state.world.name_of(Entity::Constraint(*id));
                format!("{name} {what}")
            })
            .collect();
        let told = told.join(", ");
        match self.state.preferences.dead_points {
            AtDeadPoint::Stop if has_way_back => {
                self.note(format!("{told}: stopped after {} of {n} frames", k - 1));
                Next::Stop
            }
            AtDeadPoint::Reverse if has_way_back => {
                self.note(format!("{told} in frame {frame}; it turns back"));
                Next::Again(met.into_iter().map(|(id, _)| id).collect())
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
        let at = |angle: f64| format_degrees(wrap(angle));
        match halt {
            Halt::DeadPoint(angle) => Some(format!("meets a dead point at {}", at(angle))),
            Halt::Stop(angle, by) => {
                let by = self.state.world.name_of(Entity::Constraint(by));
                Some(format!("is stopped by {by} at {}", at(angle)))
            }
            // Only a best fit says that something moves along with it that cannot.
            Halt::Unclear(angle) if self.state.preferences.solve.method == Method::Auto => {
                Some(format!("cannot go on beyond {}", at(angle)))
            }
            Halt::Unclear(_) => None,
        }
    }

    /// Makes a motor turn back. A speed that is an expression is the negative of it from here on.
    pub(crate) fn reverse(&mut self, id: ConstraintId) {
        let Some(mut record) = self.state.world.constraint(id).cloned() else { return };
        if let Some(speed) = record.constraint.get(Field::Speed) {
            record.constraint.set(Field::Speed, -speed);
            if let Some(formula) = record.driver(Field::Speed).map(Formula::negative) {
                record.replace_drivers(&[Field::Speed], vec![(Field::Speed, formula)]);
            }
            self.edit(Edit::Constraint(id, Some(Box::new(record))));
        }
    }
}
