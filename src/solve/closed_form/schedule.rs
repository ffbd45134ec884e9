//! Values of an island that follow time alone, for the frames of all lanes.

use super::abreast::{Abreast, WIDE};
use super::direction::angle;
use super::length::bar;
use crate::constraint::{
    Constraint, ConstraintKind as _, Field, LARGEST, Point, PointIdx, Register, sines_and_cosines,
};
use crate::world::{Clock, ConstraintId, ParameterId, Timetable, World};

/// The values that drive an island, and the frames for which they are known.
pub(super) struct Schedule {
    table: Timetable<WIDE>,
    /// The instant after which the frames come that are to be found next.
    clock: Clock,
    constraints: Vec<Scheduled>,
    /// The numbers in the island of those that are lengths, ascending.
    lengths: Vec<u32>,
    /// Whether a motor turns, so that something moves in each frame.
    is_turned: bool,
    /// Where it set out: the instant, and the constraints then.
    start: (Clock, Vec<Constraint>),
}

/// A constraint whose values follow time.
struct Scheduled {
    /// Its number in the island.
    c: usize,
    /// As it is after the last frame that was looked at.
    now: Constraint,
    /// Its values, and where they are in the table.
    values: Vec<(Field, Register)>,
    step: Driven,
}

/// What a constraint says to its step.
pub(super) enum Driven {
    /// Where a point is, as numbers that drive the frame.
    Place { to: PointIdx, drive: u32 },
    /// At which angle a link is, how long it is, less than nothing where it is named from its end, and
    /// in which sense the angle turns it.
    Angle { link: f64, sense: f64, drive: u32 },
    /// How long a bar is, of the lengths that follow time the one of this number.
    Length { k: usize },
}

/// Where a constraint says that its point is.
pub(super) fn place(constraint: &Constraint) -> Point {
    match constraint {
        Constraint::Coordinate(coordinate) => coordinate.target,
        _ => Point::new(f64::NAN, f64::NAN),
    }
}

impl Schedule {
    /// The schedule of an island in a world that is known ahead, which looks at some parameters besides. `driven` is
    /// what each of its constraints says by itself; none if one that follows time says nothing so.
    pub fn new(
        mut driven: Vec<Option<Driven>>,
        constraints: &[Constraint],
        ids: &[ConstraintId],
        world: &World,
        also: &[ParameterId],
        is_turned: bool,
    ) -> Option<Self> {
        let live = world.driven();
        let numbers = (0..ids.len()).filter(|&c| live.binary_search(&ids[c]).is_ok());
        let numbers: Vec<usize> = numbers.collect();
        let table = world.timetable(numbers.iter().map(|&c| ids[c]), also.iter().copied());
        let mut lengths = Vec::new();
        let mut scheduled = Vec::with_capacity(numbers.len());
        let own = table.values().chunk_by(|a, b| a.constraint == b.constraint);
        for (c, own) in numbers.into_iter().zip(own) {
            let mut step = driven[c].take()?;
            if let Driven::Length { k } = &mut step {
                *k = lengths.len();
                lengths.push(c as u32);
            }
            let values = own.iter().map(|value| (value.field, value.register)).collect();
            scheduled.push(Scheduled { c, now: constraints[c].clone(), values, step });
        }
        let clock = *world.clock();
        let start = (clock, Vec::new());
        Some(Self { table, clock, constraints: scheduled, lengths, is_turned, start })
    }

    /// The numbers in the island of the lengths among them, ascending.
    pub fn lengths(&self) -> &[u32] {
        &self.lengths
    }

    /// The longest of these in a frame.
    pub fn longest(&self, l: usize) -> f64 {
        if self.lengths.is_empty() {
            return 0.0;
        }
        let lengths = self.constraints.iter().filter(|it| matches!(it.step, Driven::Length { .. }));
        let values = lengths.flat_map(|it| &it.values).map(|(_, at)| self.table.get(*at)[l]);
        values.fold(0.0, f64::max)
    }

    /// Whether it has nothing to look at.
    pub fn is_empty(&self) -> bool {
        self.table.is_empty()
    }

    /// How many constraints it has.
    pub fn n_constraints(&self) -> usize {
        self.constraints.len()
    }

    /// Goes on by all lanes; gives how many of their frames may be found so. `at` is where a point is
    /// before the first.
    #[inline(always)]
    pub fn turn_on(
        &mut self,
        at: impl Fn(PointIdx) -> Point,
        abreast: &mut Abreast<WIDE>,
    ) -> usize {
        self.table.evaluate(&self.clock);
        self.clock.frame += WIDE as u64;
        let mut n_known = self.table.first_failure();
        let mut moves = [self.is_turned; WIDE];
        for constraint in &mut self.constraints {
            n_known = n_known.min(constraint.turn_on(&self.table, &at, abreast, &mut moves));
        }
        // Where nothing moves an island, it goes to sleep.
        n_known.min(moves.iter().position(|moves| !moves).unwrap_or(WIDE))
    }

    /// The last `n` frames do not count: the constraints are those after the others.
    pub fn take_back(&mut self, n: usize, constraints: &[Constraint]) {
        self.clock.frame -= n as u64;
        self.constraints.iter_mut().for_each(|it| it.now.clone_from(&constraints[it.c]));
    }

    /// Gives constraints the values that they have in a frame.
    pub fn show(&self, l: usize, constraints: &mut [Constraint]) {
        for constraint in &self.constraints {
            constraint.give(l, &self.table, &mut constraints[constraint.c]);
        }
    }

    /// The same to those of a world, which have these handles.
    pub fn hand_over(&self, l: usize, ids: &[ConstraintId], world: &mut World) {
        for constraint in &self.constraints {
            let there = world.constraint_state_mut(ids[constraint.c]);
            constraint.give(l, &self.table, there);
        }
    }

    /// Tells those of a world, which have these handles, the values that these have.
    pub fn tell(&self, constraints: &[Constraint], ids: &[ConstraintId], world: &mut World) {
        for constraint in &self.constraints {
            let there = world.constraint_state_mut(ids[constraint.c]);
            for &(field, _) in &constraint.values {
                if let Some(value) = constraints[constraint.c].get(field) {
                    there.set(field, value);
                }
            }
        }
    }

    /// Sets out from where an island is.
    pub fn set_out(&mut self, constraints: &[Constraint]) {
        let own = self.constraints.iter().map(|it| constraints[it.c].clone());
        self.start = (self.clock, own.collect());
    }

    /// Goes back to where it set out.
    pub fn go_back(&mut self, constraints: &mut [Constraint]) {
        let (clock, start) = &self.start;
        self.clock = *clock;
        for (own, start) in self.constraints.iter_mut().zip(start) {
            own.now.clone_from(start);
            constraints[own.c].clone_from(start);
        }
    }
}

impl Scheduled {
    /// Takes in what its values are in each lane; gives how many of them, from the first on, it may have,
    /// and tells in which it changes.
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "one loop over all lanes")]
    fn turn_on(
        &mut self,
        table: &Timetable<WIDE>,
        at: &impl Fn(PointIdx) -> Point,
        abreast: &mut Abreast<WIDE>,
        moves: &mut [bool; WIDE],
    ) -> usize {
        let mut n_known = WIDE;
        let mut go_to = |l: usize, now: &mut Constraint| {
            let mut is_sound = true;
            let mut has_changed = false;
            for &(field, register) in &self.values {
                let value = table.get(register)[l];
                is_sound &= value.abs() <= LARGEST;
                has_changed |= now.get(field) != Some(value);
                now.set(field, value);
            }
            if !(is_sound && now.traits().flaw.is_none()) {
                n_known = n_known.min(l);
            }
            moves[l] |= has_changed;
            has_changed
        };
        match self.step {
            Driven::Place { to, drive } => {
                let turned = &mut abreast.turned[drive as usize];
                let mut before = at(to);
                for l in 0..WIDE {
                    let is_moved = go_to(l, &mut self.now);
                    let place = place(&self.now);
                    let way = if is_moved { place.distance(before) } else { 0.0 };
                    turned.set(l, place.to_vector(), way);
                    before = place;
                }
            }
            Driven::Angle { link, sense, drive } => {
                let turned = &mut abreast.turned[drive as usize];
                let mut angles = [0.0; WIDE];
                let mut before = angle(&self.now);
                for l in 0..WIDE {
                    go_to(l, &mut self.now);
                    let now = angle(&self.now);
                    angles[l] = sense * now;
                    turned.way[l] = (now - before).abs() * link.abs();
                    before = now;
                }
                let [sines, cosines] = sines_and_cosines(&angles);
                [turned.x, turned.y] = [cosines, sines].map(|parts| parts.map(|part| link * part));
            }
            Driven::Length { k } => {
                let length = |now: &Constraint| bar(now).map_or(f64::NAN, |(_, length)| length);
                let timed = &mut abreast.lengths[k];
                let mut before = length(&self.now);
                for l in 0..WIDE {
                    go_to(l, &mut self.now);
                    let now = length(&self.now);
                    (timed.now[l], timed.changed[l]) = (now, (now - before).abs());
                    before = now;
                }
            }
        }
        n_known
    }

    /// Gives a constraint the values that this one has in a frame.
    fn give(&self, l: usize, table: &Timetable<WIDE>, to: &mut Constraint) {
        for &(field, register) in &self.values {
            to.set(field, table.get(register)[l]);
        }
    }
}
