//! Which points of a mechanism make up a part: those of a rod or a rigid body, and what is hinged on them.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::constraint::{Constraint, ConstraintKind as _, Field, PointIdx};
use crate::interrupt::tick;
use crate::world::{PointId, Record, World};

/// What a look at a constraint or at the hinges of a pair takes, in ticks.
const LOOK: usize = 20;

/// What holds points together.
#[derive(Debug)]
pub struct Member {
    /// The name of the first constraint that does.
    pub name: String,
    /// In the order in which they were found.
    pub points: Vec<PointIdx>,
}

/// The members of a mechanism that are switched on, in the order in which they were made, none of which
/// lies within another; what stands still altogether is ground, and no member.
pub fn members(world: &World) -> Vec<Member> {
    let hinges = Hinges::of(world);
    let is_frozen = |&p: &PointIdx| world.points().is_frozen(PointId(p));
    let all = on(world).filter_map(|record| {
        let points = held_together(record)?;
        let moves = !points.iter().all(is_frozen);
        moves.then(|| Member { name: record.name.to_string(), points: hinges.with_pins(points) })
    });
    outermost(all.collect())
}

fn on(world: &World) -> impl Iterator<Item = &Record> {
    world.constraints().map(|(_, record)| record).filter(|record| {
        tick(LOOK);
        record.is_on
    })
}

/// The points that a constraint holds as one body; none if it is no part.
fn held_together(record: &Record) -> Option<Vec<PointIdx>> {
    match record.constraint.stated() {
        Constraint::Length(length) if length.bounds.is_equality() => {
            stays(record, &[Field::Lo, Field::Hi]).then(|| length.points.to_vec())
        }
        Constraint::Motor(motor) => stays(record, &[Field::Radius]).then(|| motor.crank().to_vec()),
        Constraint::Rigid(rigid) => Some(rigid.points().to_vec()),
        _ => None,
    }
}

/// Whether these values of a constraint are the same in every pose.
fn stays(record: &Record, fields: &[Field]) -> bool {
    let is_live =
        |&field: &Field| record.driver(field).is_some_and(|formula| formula.depends().is_live());
    !fields.iter().any(is_live)
}

/// The pins that divide segments in ratios that stay: by one end of the segment, then by the other.
struct Hinges(HashMap<PointIdx, BTreeMap<PointIdx, Vec<PointIdx>>>);

impl Hinges {
    fn of(world: &World) -> Self {
        let mut pins: HashMap<PointIdx, BTreeMap<PointIdx, Vec<PointIdx>>> = HashMap::new();
        for record in on(world) {
            if let Constraint::Hinge(hinge) = record.constraint.stated()
                && stays(record, &[Field::Ratio])
            {
                let [pin, a, b] = hinge.points;
                for (end, other) in [(a, b), (b, a)] {
                    pins.entry(end).or_default().entry(other).or_default().push(pin);
                }
            }
        }
        Self(pins)
    }

    /// The same points and all that are hinged on two of them, or on what is so.
    fn with_pins(&self, mut points: Vec<PointIdx>) -> Vec<PointIdx> {
        let mut known: BTreeSet<PointIdx> = points.iter().copied().collect();
        let mut k = 0;
        while let Some(&end) = points.get(k) {
            if let Some(others) = self.0.get(&end) {
                tick(LOOK * others.len().min(known.len()));
                let pins: Vec<PointIdx> = if others.len() < known.len() {
                    let of_known = others.iter().filter(|(other, _)| known.contains(other));
                    of_known.flat_map(|(_, pins)| pins).copied().collect()
                } else {
                    known.iter().filter_map(|other| others.get(other)).flatten().copied().collect()
                };
                points.extend(pins.into_iter().filter(|&pin| known.insert(pin)));
            }
            k += 1;
        }
        points
    }
}

/// Those of which no other has all the points; of those with the same points the first.
fn outermost(members: Vec<Member>) -> Vec<Member> {
    let sorted = |member: &Member| {
        let mut points = member.points.clone();
        points.sort_unstable();
        points
    };
    let points: Vec<Vec<PointIdx>> = members.iter().map(sorted).collect();
    let mut largest_first: Vec<usize> = (0..members.len()).collect();
    largest_first.sort_by_key(|&k| std::cmp::Reverse(points[k].len()));
    let mut with: HashMap<PointIdx, Vec<usize>> = HashMap::new();
    let mut is_kept = vec![false; members.len()];
    for k in largest_first {
        // All that have all of its points have the one that the fewest have.
        let others = |p: &PointIdx| with.get(p).map_or(&[][..], Vec::as_slice);
        let fewest = points[k].iter().map(others).min_by_key(|others| others.len());
        let holds_all = |&other: &usize| {
            tick(LOOK * points[k].len());
            points[k].iter().all(|p| points[other].binary_search(p).is_ok())
        };
        if fewest.is_some_and(|others| others.iter().any(holds_all)) {
            continue;
        }
        is_kept[k] = true;
        for &p in &points[k] {
            with.entry(p).or_default().push(k);
        }
    }
    members
        .into_iter()
        .zip(is_kept)
        .filter_map(|(member, is_kept)| is_kept.then_some(member))
        .collect()
}
