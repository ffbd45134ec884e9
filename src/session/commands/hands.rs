//! Moving points by hand: `drag`, which takes them along, and `pull`, which they follow as far as
//! they can.

use super::run::{Hands, Limits};
use crate::constraint::Point;
use crate::diag::{Diagnostic, Span, format_counted};
use crate::errors;
use crate::lang::ast::{DragTarget, Expr};
use crate::session::execution::{Execution, Flow};
use crate::session::quotas::Quota;
use crate::session::state::State;
use crate::solve::{Budget, Status};
use crate::study::Hand;
use crate::world::{Edit, PointId};

/// What a hand does to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Grip {
    /// Holds it, whatever that tears.
    Firm,
    /// Takes it as far as the constraints allow.
    Soft,
}

impl Grip {
    const fn participle(self) -> &'static str {
        match self {
            Self::Firm => "dragged",
            Self::Soft => "pulled",
        }
    }

    /// The command that does so.
    pub const fn verb(self) -> &'static str {
        match self {
            Self::Firm => "drag",
            Self::Soft => "pull",
        }
    }
}

impl Execution<'_> {
    pub(crate) fn drag(
        &mut self,
        targets: &[DragTarget],
        over: Option<&Expr>,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let (n, hands) = self.hands(targets, over, Grip::Firm)?;
        // A free point is held by the hand that drags it, and let go after.
        let free: Vec<PointId> = hands
            .iter()
            .map(|h| h.point)
            .filter(|&id| !self.state.world.points().is_frozen(id))
            .collect();
        if n == 0 {
            self.history.last_motion.give_up();
        } else {
            self.history.begin_leg(self.state, n, self.depth > 0);
        }
        self.begin_motion();
        for &id in &free {
            self.edit(Edit::Freeze(id, true));
        }
        let is_at_start = self.state.world.clock().frame == 0;
        let (flow, n_done) = if n == 0 {
            (self.drag_at_once(&hands)?, 0)
        } else {
            self.frames(n, Limits::default(), span, Hands { firm: &hands, soft: &[] })?
        };
        for &id in &free {
            self.edit(Edit::Freeze(id, false));
        }
        // The hand moved before the clock left 0: `reset` puts the point back under it.
        if is_at_start && self.state.world.clock().frame > 0 {
            for hand in &hands {
                self.edit(Edit::Start(hand.point, hand.from));
            }
        }
        if n > 0 {
            self.history.last_motion.end_leg(self.state, n, n_done, hands);
        }
        Ok(flow)
    }

    pub(crate) fn pull(
        &mut self,
        targets: &[DragTarget],
        over: Option<&Expr>,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let (n, hands) = self.hands(targets, over, Grip::Soft)?;
        // It cannot be done again without the hand.
        self.history.last_motion.give_up();
        self.begin_motion();
        if n > 0 {
            let soft = Hands { firm: &[], soft: &hands };
            return Ok(self.frames(n, Limits::default(), span, soft)?.0);
        }
        let status = self.settle(&Limits::default())?.status;
        let n_stops = hands.iter().map(Hand::n_pieces).max().unwrap_or(0);
        for k in 0..n_stops {
            self.lead(&stops(&hands, k), Grip::Soft)?;
        }
        self.tell_unless_solved(status, &[]);
        Ok(Flow::On)
    }

    /// Moves points that are held from place to place while the clock stands still.
    fn drag_at_once(&mut self, hands: &[Hand]) -> Result<Flow, Diagnostic> {
        let n_stops = hands.iter().map(Hand::n_pieces).max().unwrap_or(0);
        let mut status = Status::Converged;
        for k in 0..n_stops {
            if self.is_to_stop() {
                self.note_stop(format!(
                    "stopped after {k} of {}",
                    format_counted(n_stops as u64, "place")
                ));
                return Ok(Flow::Stopped);
            }
            status = self.lead(&stops(hands, k), Grip::Firm)?.unwrap_or(status);
            self.n_done += 1;
        }
        let status = self.settle_at_the_end(status)?;
        self.tell_unless_solved(status, hands);
        Ok(Flow::On)
    }

    /// Leads points to places while the clock stands still; gives how solving ended where those
    /// that hold their points left something to solve. Where they stop for good it is settled.
    pub(super) fn lead(
        &mut self,
        places: &[(PointId, Point)],
        grip: Grip,
    ) -> Result<Option<Status>, Diagnostic> {
        match grip {
            Grip::Soft => {
                let State { solver, world, preferences, .. } = &mut *self.state;
                solver.pull(world, &preferences.solve, &Budget::default(), places)?;
                Ok(None)
            }
            Grip::Firm => {
                self.sync();
                for &(point, to) in places {
                    self.edit(Edit::Move(point, to));
                }
                Ok(Some(self.settle_on_the_way()?.status))
            }
        }
    }

    /// The hands of a statement, and how many frames they take.
    fn hands(
        &mut self,
        targets: &[DragTarget],
        over: Option<&Expr>,
        grip: Grip,
    ) -> Result<(u64, Vec<Hand>), Diagnostic> {
        let n_pieces = targets.iter().map(|target| target.places.len() as u64).max().unwrap_or(1);
        let n = match over {
            None => n_pieces,
            Some(n) => {
                let most = self.input.quotas.of(Quota::Frames) as f64;
                self.resolve().count(n, 0.0, most, "frames")?
            }
        };
        if let Some(over) = over.filter(|_| (1..n_pieces).contains(&n)) {
            return Err(Diagnostic::error(
                errors::OUT_OF_RANGE,
                "a path takes a frame for each of its pieces at least",
            )
            .at(over.span, format!("it has {n_pieces} pieces"))
            .help("`over 0` goes through all of them at once"));
        }
        let mut hands: Vec<Hand> = Vec::new();
        for DragTarget { point, places } in targets {
            let id = self.resolve().point(point)?;
            if hands.iter().any(|hand| hand.point == id) {
                let word = grip.participle();
                return Err(Diagnostic::error(
                    errors::TWO_PLACES,
                    format!("one point cannot be {word} to two places"),
                )
                .at(point.span, format!("{word} twice"))
                .help("a path is written `through (x, y), (x, y)`"));
            }
            if grip == Grip::Soft && self.state.world.points().is_frozen(id) {
                let name = self.state.world.points().name(id);
                return Err(Diagnostic::error(
                    errors::FROZEN,
                    format!("`{name}` is frozen: no pull moves it"),
                )
                .at(point.span, "this point is immovable")
                .help(format!("`drag {name} ...` moves it, `thaw {name}` lets it move")));
            }
            let places = places.iter().map(|place| self.resolve().place(place));
            let places: Vec<Point> = places.collect::<Result<_, _>>()?;
            let from = self.state.world.points().at(id);
            hands.push(Hand::new(id, from, &places, n.max(n_pieces)));
        }
        Ok((n, hands))
    }
}

/// Where hands stop at the end of their piece `k`.
fn stops(hands: &[Hand], k: usize) -> Vec<(PointId, Point)> {
    hands.iter().map(|hand| (hand.point, hand.stop(k))).collect()
}
