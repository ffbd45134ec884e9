//! A point in the hand of a page, and the places that it is led to.

use super::message::ClientId;
use crate::constraint::Point;
use crate::session::Session;
use crate::world::PointId;

/// A point that a page holds.
#[derive(Debug)]
pub(super) struct Grip {
    pub client: ClientId,
    pub point: PointId,
    /// Its name: another point may have the handle once it is gone.
    name: String,
    /// Where it was led last.
    pub place: Option<Point>,
    /// Whether it is to be led there still.
    pub is_to_move: bool,
}

impl Grip {
    /// Of a point that is there.
    pub fn new(client: ClientId, point: PointId, session: &Session) -> Self {
        let name = session.world().points().name(point).to_owned();
        Self { client, point, name, place: None, is_to_move: false }
    }

    /// Whether what is held is still there.
    pub fn holds(&self, session: &Session) -> bool {
        let points = session.world().points();
        points.is_alive(self.point) && points.name(self.point) == self.name
    }
}

/// Part of a px that nobody can point at.
const FINEST: f64 = 0.05;

/// A place with as many digits as can be pointed at where so many px are a world unit: its statement
/// is then one that can be read.
pub(super) fn rounded(place: Point, scale: f64) -> Point {
    let mut factor = 1.0;
    while factor * FINEST < scale && factor < 1e12 {
        factor *= 10.0;
    }
    let round = |x: f64| {
        let whole = (x * factor).round();
        // Beyond that every digit is needed.
        if whole.abs() < 1e15 { whole / factor } else { x }
    };
    Point::new(round(place.x), round(place.y))
}
