//! What drives an island in a frame, between its beginning and its end.

use super::motion::{self, Rates};
use crate::constraint::{Constraint, ConstraintKind, Field, Jet, Point, Real, Turns, Vector};
use crate::solve::island::Island;
use crate::solve::velocity;

/// The values that change in a frame, at both of its ends.
pub(crate) struct Ends {
    constraints: Vec<(u32, Constraint, Constraint)>,
    points: Vec<(u32, Point, Point)>,
    /// The unwrapped angles and the like at the beginning.
    states: Vec<(u32, Vec<f64>)>,
}

impl Ends {
    /// The ends of the frame an island is in: its present values, and those before.
    pub fn of_frame(island: &mut Island) -> Self {
        let constraints = island.inputs.constraints_before(&island.constraints).into_iter();
        let constraints =
            constraints.map(|(c, before)| (c, before, island.constraints[c as usize].clone()));
        let points = island.inputs.points.iter();
        let points = points.map(|&(p, before)| (p, before, island.x[p as usize]));
        let (constraints, points) = (constraints.collect(), points.collect());
        let states = island.stateful.iter();
        let states = states.filter_map(|&c| Some((c, island.constraints[c as usize].state()?)));
        Self { constraints, points, states: states.collect() }
    }

    /// Puts the island's values where they are at instant `t` of the frame: 0 is its beginning, 1
    /// its end, and what drives it goes on beyond that.
    pub fn interpolate(&self, island: &mut Island, t: f64) {
        for (c, before, after) in &self.constraints {
            between(&mut island.constraints[*c as usize], before, after, t);
        }
        for (p, before, after) in &self.points {
            island.x[*p as usize] =
                if t == 1.0 { *after } else { *before + (*after - *before) * t };
        }
    }

    /// Velocities and accelerations of the free points at the present pose, per frame.
    pub fn motion(&self, island: &mut Island) -> Vec<Rates> {
        let n_free = island.n_free;
        let drive = |c: usize, field: Field, value: f64| self.rate(c, field, value);
        let hand = |p: usize| {
            let of_point = self.points.iter().find(|(q, ..)| *q as usize == p);
            of_point.map_or(Vector::ZERO, |(_, before, after)| *after - *before)
        };
        let mut motion = motion::point_by_point(island, &drive, &hand)
            .unwrap_or_else(|| velocity::motion(island, &drive, &hand));
        motion.truncate(n_free);
        motion
    }

    /// How a value of a constraint changes in the frame.
    fn rate(&self, c: usize, field: Field, value: f64) -> Jet {
        let place = self.constraints.binary_search_by_key(&(c as u32), |(c, ..)| *c);
        let Ok(place) = place else {
            return Jet::constant(if field == Field::Speed { 0.0 } else { value });
        };
        let (_, before, after) = &self.constraints[place];
        if let (Field::Speed, Constraint::Motor(before), Constraint::Motor(after)) =
            (field, before.stated(), after.stated())
        {
            return Jet::constant(after.turned().total() - before.turned().total());
        }
        match (before.get(field), after.get(field)) {
            (Some(a), Some(b)) if a.is_finite() && b.is_finite() => Jet::new(value, b - a, 0.0),
            _ => Jet::constant(value),
        }
    }

    /// Takes back what was unwrapped in between.
    pub fn restore_states(&self, island: &mut Island) {
        for (c, state) in &self.states {
            island.constraints[*c as usize].set_state(state);
        }
    }
}

/// Sets the values of a constraint to those at instant `t`.
fn between(now: &mut Constraint, before: &Constraint, after: &Constraint, t: f64) {
    // Those of wheels are no part of a motion in between: wheels go on with other values from where
    // they stand, and those of the end of a frame act from its beginning on.
    if now.traits().is_wheel {
        return;
    }
    // A speed is no part of a motion in between: what it did to the angle is.
    for field in now.fields().filter(|field| *field != Field::Speed) {
        if let (Some(a), Some(b)) = (before.get(field), after.get(field)) {
            let is_between = t != 1.0 && a.is_finite() && b.is_finite();
            let value = if is_between { a + (b - a) * t } else { b };
            now.set(field, value);
        }
    }
    if let (Constraint::Motor(now), Constraint::Motor(before), Constraint::Motor(after)) =
        (now.stated_mut(), before.stated(), after.stated())
    {
        let (from, to) = (before.turned(), after.turned());
        let way = (to.total() - from.total()) * t;
        now.set_turned(if t == 1.0 { to } else { from.plus(Turns::from_radians(way)) });
    }
}
