//! An angle followed beyond half a turn.

use super::content::add_all;
use super::geometry::wrap;

/// A direction with the whole turns it has made, as of the last accepted pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Winding {
    /// Whole turns.
    pub turns: i64,
    /// The direction, radians, in (-pi, pi].
    pub angle: f64,
}

impl Winding {
    /// A direction that has made no turns.
    pub const fn new(angle: f64) -> Self {
        Self { turns: 0, angle }
    }

    /// The angle that `direction` stands for, radians, without the whole turns: less than
    /// half a turn from the accepted one.
    #[allow(clippy::inline_always, reason = "it becomes part of loops over frames")]
    #[inline(always)]
    pub fn near(self, direction: f64) -> f64 {
        self.angle + wrap(direction - self.angle)
    }

    /// Whole turns and direction.
    pub const fn to_numbers(self) -> [f64; 2] {
        [self.turns as f64, self.angle]
    }

    /// The winding that [`to_numbers`](Self::to_numbers) gave.
    pub const fn from_numbers([turns, angle]: [f64; 2]) -> Self {
        Self { turns: turns as i64, angle }
    }

    /// The bits of both numbers.
    pub fn content(self, word: &mut impl FnMut(u64)) {
        add_all(self.to_numbers(), word);
    }

    /// Takes over a direction, counting a turn where it passed pi.
    #[allow(clippy::inline_always, reason = "it becomes part of loops over frames")]
    #[inline(always)]
    pub fn follow(&mut self, direction: f64) {
        let angle = self.near(direction);
        self.angle = wrap(angle);
        if self.angle != angle {
            let turn = ((angle - self.angle) / std::f64::consts::TAU).round();
            self.turns = self.turns.saturating_add(turn as i64);
        }
    }
}
