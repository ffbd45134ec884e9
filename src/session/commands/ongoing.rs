//! A command whose end is not known when it begins: a hand that moves a point, or time that passes
//! until somebody says that it is enough.
//!
//! What it does is what a statement would have done that said all of it beforehand: `step 40`, or
//! `pull C through (1, 2), (2, 2) over 2`. When it ends that statement is written, as one command
//! that can be taken back; carried out in a world as it was before, it gives the same bits.

use std::fmt::Write;

use super::hands::Grip;
use super::passage::{Passage, Passed};
use super::run::{Frames, Hands, Limits};
use crate::constraint::Point;
use crate::diag::{Diagnostic, format_number};
use crate::errors;
use crate::interrupt;
use crate::lang::ast::Statement;
use crate::lang::parse;
use crate::session::Session;
use crate::session::execution::{Execution, Flow};
use crate::session::host::Host;
use crate::session::preferences::AtDeadPoint;
use crate::session::resolve::unbind::NOWHERE;
use crate::solve::Status;
use crate::study::Hand;
use crate::world::{Edit, PointId};

/// What goes on until it is told to end.
pub struct Ongoing {
    held: Option<Held>,
    /// Frames, where time passes.
    passage: Option<Passage>,
    is_timed: bool,
    stage: Stage,
    /// Whether the clock had not yet left 0.
    was_at_start: bool,
    /// How the pose was found where time stands still.
    status: Status,
}

/// How far it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    New,
    Begun,
    /// It was taken back on its way: what it did is done again when it ends.
    Lost,
}

/// A point in a hand, and the way it was led.
struct Held {
    point: PointId,
    grip: Grip,
    from: Point,
    places: Vec<Point>,
}

impl Held {
    /// The hand as it is in the frame that leads to the last place.
    fn hand(&self, is_whole_way: bool) -> Hand {
        let n = self.places.len();
        if is_whole_way {
            return Hand::new(self.point, self.from, &self.places, n as u64);
        }
        let before = if n > 1 { self.places[n - 2] } else { self.from };
        Hand::new(self.point, before, &self.places[n - 1..], 1)
    }
}

impl Ongoing {
    /// Time is to pass.
    pub const fn time() -> Self {
        Self {
            held: None,
            passage: None,
            is_timed: true,
            stage: Stage::New,
            was_at_start: false,
            status: Status::Converged,
        }
    }

    /// The point that a hand holds, if one does.
    pub fn point(&self) -> Option<PointId> {
        self.held.as_ref().map(|held| held.point)
    }

    /// Whether time passes.
    pub const fn is_timed(&self) -> bool {
        self.is_timed
    }

    /// How many places or frames it went through.
    pub fn len(&self) -> u64 {
        let n_places = self.held.as_ref().map_or(0, |held| held.places.len() as u64);
        self.passage.as_ref().map_or(n_places, |passage| passage.n_passed)
    }

    /// Whether nothing happened yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Frames that an ongoing command may last: it ends much sooner.
const NO_END: u64 = 1 << 40;

impl Session {
    /// A hand takes hold of a point: a frozen one it will lead, a loose one it will pull.
    ///
    /// # Errors
    /// Where there is no such point.
    pub fn take_hold(&self, point: PointId, is_timed: bool) -> Result<Ongoing, Diagnostic> {
        let points = self.world().points();
        if point.idx() >= points.column().len() || !points.is_alive(point) {
            return Err(Diagnostic::error(errors::UNKNOWN_NAME, "there is no such point"));
        }
        let grip = if points.is_frozen(point) { Grip::Firm } else { Grip::Soft };
        let held = Held { point, grip, from: points.at(point), places: Vec::new() };
        Ok(Ongoing { held: Some(held), is_timed, ..Ongoing::time() })
    }

    /// One step more: to the next place, through the next frame, or both. Nothing else may be asked
    /// of the session until the command is [ended](Self::end_ongoing).
    ///
    /// # Errors
    /// What went wrong. The command is then to be ended; what it did before counts.
    pub fn go_on(
        &mut self,
        ongoing: &mut Ongoing,
        to: Option<Point>,
        host: &mut dyn Host,
    ) -> Result<Flow, Diagnostic> {
        let mut command = self.command(host);
        let wish = command.deadline.wish(command.host);
        let before = ongoing.len();
        let step = interrupt::listening(wish, || command.step_on(ongoing, to));
        if !matches!(step, Ok(Ok(_))) {
            command.history.roll_back(command.state);
            ongoing.forget_since(before);
        }
        step.unwrap_or_else(|_| {
            command.state.solver.begin_anew();
            command.hold_time(NOWHERE)?;
            Ok(Flow::Stopped)
        })
    }

    /// Ends it: what it did becomes one statement of the text `name`, and one command. Gives that
    /// statement, or none where nothing happened.
    ///
    /// # Errors
    /// Where what it did was lost on its way and cannot be done again.
    pub fn end_ongoing(
        &mut self,
        mut ongoing: Ongoing,
        name: &str,
        host: &mut dyn Host,
    ) -> Result<Option<String>, Diagnostic> {
        if ongoing.is_empty() {
            self.give_up(&ongoing);
            return Ok(None);
        }
        if ongoing.is_to_be_settled() {
            self.settle_ongoing(&mut ongoing, host);
        }
        let text = ongoing.statement(self);
        let source = self.add_piece(name, &text, 1, Some(std::path::PathBuf::new()));
        let statement = parse(source, &text).next().expect("there is a statement")?;
        if ongoing.stage == Stage::Lost {
            self.execute(&statement, host)?;
        } else {
            self.command(host).finish_ongoing(ongoing, &statement)?;
        }
        self.note_typed(&statement, Flow::On, host);
        Ok(Some(text))
    }

    /// Settles where a hand has led; what goes wrong is told when all of it is done again.
    fn settle_ongoing(&mut self, ongoing: &mut Ongoing, host: &mut dyn Host) {
        let mut command = self.command(host);
        let wish = command.deadline.wish(command.host);
        match interrupt::listening(wish, || command.settle_at_the_end(ongoing.status)) {
            Ok(Ok(status)) => ongoing.status = status,
            failed => {
                command.history.roll_back(command.state);
                if failed.is_err() {
                    command.state.solver.begin_anew();
                }
                ongoing.forget_since(ongoing.len());
            }
        }
    }

    /// Takes back what it did.
    pub fn give_up(&mut self, ongoing: &Ongoing) {
        if ongoing.stage == Stage::Begun {
            self.history.roll_back(&mut self.state);
        }
    }
}

impl Ongoing {
    /// Whether a hand that held its point has led it where not everything holds.
    fn is_to_be_settled(&self) -> bool {
        let is_firm = self.held.as_ref().is_some_and(|held| held.grip == Grip::Firm);
        is_firm && !self.is_timed && self.stage == Stage::Begun && self.status != Status::Converged
    }

    /// It was taken back: what it did up to here is to be done again.
    fn forget_since(&mut self, n_done: u64) {
        self.stage = Stage::Lost;
        if let Some(held) = &mut self.held {
            held.places.truncate(n_done as usize);
        }
        if let Some(passage) = &mut self.passage {
            passage.n_passed = n_done;
        }
    }

    /// The statement that does the same.
    fn statement(&self, session: &Session) -> String {
        let n = self.len();
        let Some(held) = &self.held else { return format!("step {n}") };
        let name = session.world().points().name(held.point);
        let mut text = format!("{} {name}", held.grip.verb());
        text.push_str(if held.places.len() == 1 { " to " } else { " through " });
        for (k, place) in held.places.iter().enumerate() {
            let comma = if k > 0 { ", " } else { "" };
            // Writing to a string cannot fail.
            let _ = write!(text, "{comma}({}, {})", format_number(place.x), format_number(place.y));
        }
        let _ = write!(text, " over {}", if self.is_timed { n } else { 0 });
        text
    }
}

impl Execution<'_> {
    fn step_on(&mut self, ongoing: &mut Ongoing, to: Option<Point>) -> Result<Flow, Diagnostic> {
        if std::mem::replace(&mut ongoing.stage, Stage::Begun) == Stage::New {
            self.begin_ongoing(ongoing)?;
        }
        if let (Some(held), Some(to)) = (&mut ongoing.held, to) {
            held.places.push(to);
        }
        if ongoing.is_timed {
            return self.frame_of(ongoing);
        }
        let Some(held) = &ongoing.held else { return Ok(Flow::On) };
        let Some(&to) = held.places.last() else { return Ok(Flow::On) };
        ongoing.status = self.lead(&[(held.point, to)], held.grip)?.unwrap_or(ongoing.status);
        Ok(Flow::On)
    }

    fn begin_ongoing(&mut self, ongoing: &mut Ongoing) -> Result<(), Diagnostic> {
        let is_soft = ongoing.held.as_ref().is_some_and(|held| held.grip == Grip::Soft);
        if is_soft || !ongoing.is_timed {
            self.history.last_motion.give_up();
        } else {
            self.history.begin_leg(self.state, NO_END, false);
        }
        ongoing.was_at_start = self.state.world.clock().frame == 0;
        if ongoing.is_timed {
            ongoing.passage = Some(self.begin_frames(NO_END, Limits::default(), NOWHERE)?);
        } else {
            self.begin_motion();
            if is_soft {
                ongoing.status = self.settle(&Limits::default())?.status;
            }
        }
        Ok(())
    }

    /// The next frame of time that passes.
    fn frame_of(&mut self, ongoing: &mut Ongoing) -> Result<Flow, Diagnostic> {
        let Ongoing { held, passage, .. } = ongoing;
        let passage = passage.as_mut().expect("frames have begun");
        let is_whole_way = self.state.preferences.dead_points != AtDeadPoint::Hold;
        let hand: Vec<Hand> = held.iter().map(|held| held.hand(is_whole_way)).collect();
        let hands = match held {
            Some(Held { grip: Grip::Firm, .. }) => Hands { firm: &hand, soft: &[] },
            _ => Hands { firm: &[], soft: &hand },
        };
        let begun = self.host.seconds();
        let frames = Frames { n: passage.n_passed + 1, hands };
        let passed = self.pass_one(passage, frames)?;
        passage.summary.add_time(begun, self.host.seconds());
        if let (Some(held), false) = (held, passed == Passed::On) {
            held.places.pop();
        }
        Ok(if passed == Passed::On { Flow::On } else { Flow::Stopped })
    }

    /// What comes after the last step.
    fn finish_ongoing(mut self, ongoing: Ongoing, statement: &Statement) -> Result<(), Diagnostic> {
        let n = ongoing.len();
        let hands: Vec<Hand> = ongoing
            .held
            .iter()
            .map(|held| Hand::new(held.point, held.from, &held.places, held.places.len() as u64))
            .collect();
        let is_firm = ongoing.held.as_ref().is_some_and(|held| held.grip == Grip::Firm);
        let firm = if is_firm { &hands[..] } else { &[] };
        if let Some(mut passage) = ongoing.passage {
            passage.write_at(statement.span);
            self.end_frames(passage, Hands { firm, soft: &[] })?;
        } else {
            self.tell_unless_solved(ongoing.status, firm);
        }
        if ongoing.was_at_start && self.state.world.clock().frame > 0 {
            for hand in firm {
                self.edit(Edit::Start(hand.point, hand.from));
            }
        }
        if ongoing.is_timed && (is_firm || ongoing.held.is_none()) {
            self.history.last_motion.end_leg(self.state, n, n, firm.to_vec());
        }
        self.complete(statement);
        Ok(())
    }
}
