//! The mechanism as it stands, as frames tell it: a fixed layout in bytes.

use crate::constraint::Point;
use crate::render::Placement;
use crate::session::{Offence, Session, Standing};

/// What a frame tells of the mechanism, whoever looks at it.
#[derive(Debug, Clone)]
pub struct Pose {
    /// Positions by handle.
    pub at: Vec<Point>,
    /// What the clock shows.
    pub time: f64,
    /// The largest residual, as the tolerance means it.
    pub residual: f64,
    /// What is off.
    pub off: Vec<Offence>,
}

impl Pose {
    /// That of a session now.
    pub fn of(session: &Session) -> Self {
        let world = session.world();
        let Standing { residual, off } = session.standing();
        Self { at: world.points().column().to_vec(), time: world.clock().time(), residual, off }
    }

    /// The frame for who has a drawing, little-endian: its number and the drawing's, time and
    /// residual, positions, then the number, the place and the turn of each figure that is news.
    pub fn frame(&self, seq: u64, topology: u32, news: &[(u32, Placement)]) -> Vec<u8> {
        let mut frame = Vec::with_capacity(24 + 16 * (self.at.len() + news.len()));
        frame.extend(seq.to_le_bytes());
        frame.extend(topology.to_le_bytes());
        frame.extend(self.time.to_le_bytes());
        frame.extend((self.residual as f32).to_le_bytes());
        for at in &self.at {
            frame.extend(at.x.to_le_bytes());
            frame.extend(at.y.to_le_bytes());
        }
        for (figure, placement) in news {
            frame.extend(figure.to_le_bytes());
            for number in [placement.at.x, placement.at.y, placement.turn] {
                frame.extend((number as f32).to_le_bytes());
            }
        }
        frame
    }
}
