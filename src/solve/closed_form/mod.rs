//! The pose of an island as a list of steps, each of which says outright where a point is: on a
//! crank, at a place, where two circles meet, where a hinge divides a bar, on a body two points of which
//! are known.
//!
//! An island that falls apart into such steps is compiled when it is first followed, and again
//! once a value that a step holds was changed. A frame runs the list. It has no start and no
//! iterations, so what it gives does not depend on the poses before but for one thing: on which
//! side each point is, where it has two places. (A few bodies that none of this finds are found from where the
//! frames before let them be expected.) A point keeps its side as long as no pose on the
//! way is singular, and that is proved for each frame: from how far cranks and hands went follows
//! how far each point went at most, and so how near any pose on the way can have been to the one
//! where the two places meet. Where that cannot be proved, or a constraint is not met, the frame
//! is left to [`frame`](super::frame), which follows the motion.
//!
//! Where many frames pass, they are found [side by side](Lanes) by the same steps.

#![allow(
    clippy::inline_always,
    clippy::needless_bitwise_bool,
    clippy::manual_range_contains,
    reason = "steps become part of the loop over frames, and their conditions part of its vectors"
)]

mod abreast;
mod block;
mod body;
mod circles;
mod cluster;
mod compile;
mod direction;
mod equation;
mod found;
mod lanes;
mod length;
mod line;
mod nearest;
mod parts;
mod ray;
mod rolling;
mod run;
mod schedule;
mod sum;
mod together;
mod wheel;

use crate::constraint::{Heading, PointIdx};
use abreast::Abreast;
pub(crate) use abreast::WIDE;
use block::Block;
use body::{Bar, Body};
use circles::Circles;
pub(crate) use compile::Given;
use direction::Direction;
use equation::Firm;
pub(crate) use found::Found;
pub(crate) use lanes::Lanes;
use length::Length;
use line::{CircleLine, Crossing, Line};
use nearest::{Nearest, Radius};
use ray::Ray;
use schedule::Schedule;
use sum::Sum;
use wheel::Wheel;

/// What finds an island's pose.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(crate) struct ClosedForm {
    /// The steps, each after those it depends on.
    steps: Vec<Step>,
    /// What drives some of them.
    cranks: Vec<Crank>,
    /// Up to which degree the motion of any point is smooth enough to extrapolate: poses are kept
    /// for those who do.
    pub degree: u8,
    /// What drives a frame by itself, and what it comes to.
    one: Abreast<1>,
    /// How many constraints a frame evaluates.
    n_constraints: u32,
    /// How large the island is at least, for the bodies in it.
    pub extent: f64,
    /// The constraints that turn wheels, by the numbers of these.
    wheels: Vec<u32>,
    /// Whether some steps begin where the frames before let points be expected.
    pub has_blocks: bool,
    /// Whether what steps know of the pose is of the present one.
    knows_pose: bool,
    /// Whether the lengths of steps are those of the present values, and none of them just changed.
    knows_lengths: bool,
    /// The bars whose lengths steps hold for good, ascending.
    held: Vec<u32>,
    /// Whether one of these changed: the list is to be compiled anew.
    is_outdated: bool,
    /// The values that follow time, while frames pass that are known ahead.
    schedule: Option<Box<Schedule>>,
}

/// What is known of the list of an island.
#[derive(Default)]
pub(crate) enum Compiled {
    /// It was not asked for yet, or is lent.
    #[default]
    NotYet,
    /// Some of its points have no closed form.
    Impossible,
    /// The list.
    List(Box<ClosedForm>),
}

/// A step: where a point is, from points that are known.
enum Step {
    /// On the crank of this number.
    Crank(u32),
    /// At a place that the constraint of this number says.
    Place {
        /// The point that is found.
        to: PointIdx,
        /// The constraint.
        constraint: u32,
        /// Which of the numbers that drive the frame are its own.
        drive: u32,
    },
    /// Where two circles meet.
    Circles(Circles),
    /// Where a circle meets a line that stands still.
    CircleLine(CircleLine<true>),
    /// Where a circle meets a line that may move.
    CircleMovingLine(CircleLine<false>),
    /// Where two lines cross.
    Crossing(Crossing),
    /// At the end of a slotted link.
    Ray(Ray),
    /// At the end of a link at an angle to another.
    Direction(Direction),
    /// On a wheel that another turns.
    Wheel(Wheel),
    /// Where a constraint adds up other points to.
    Sum(Sum),
    /// On a body.
    Body(Box<Body>),
    /// On bodies that are found together.
    Block(Box<Block>),
    /// Nowhere new: a bar between points that are found, which is to hold there.
    Bar(Bar),
    /// Nowhere new: a constraint whose points are found together, which is to hold there.
    Firm(Firm),
    /// On circles, where they are nearest to; nothing follows from these.
    Nearest(Vec<Nearest>),
}

impl Step {
    /// The points on circles, of a step that finds such.
    fn into_nearest(self) -> Vec<Nearest> {
        match self {
            Self::Nearest(points) => points,
            _ => Vec::new(),
        }
    }
}

/// A point on a crank.
struct Crank {
    /// The point that is found.
    to: PointIdx,
    /// The centre.
    from: PointIdx,
    /// The motor, as a constraint of the island.
    motor: u32,
    /// Where it pointed at the beginning of the frame.
    before: Heading,
}
