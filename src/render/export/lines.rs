//! Straight strokes, so that a pen passes each place once and is seldom lifted.

use std::collections::{HashMap, HashSet, VecDeque};
use std::f64::consts::PI;

use crate::constraint::{Point, Vector};
use crate::interrupt::tick;

/// Lines are one where they are no farther apart than this, mm.
const NEAR: f64 = 1e-3;
/// Directions are one that differ by no more, radians.
const ALIKE: f64 = 1e-6;
/// What a look at a line takes, in ticks.
const LOOK: usize = 50;

/// A stretch of a straight line.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// Its place among all.
    number: usize,
    /// Its direction, from 0 to half a turn.
    angle: f64,
    /// How far the straight line through it passes the origin.
    offset: f64,
    ends: [Point; 2],
}

impl Line {
    /// None between points at one place.
    fn new(number: usize, [a, b]: [Point; 2]) -> Option<Self> {
        if a.distance(b) < NEAR {
            return None;
        }
        let angle = (b - a).angle();
        let is_back = !(-ALIKE..PI - ALIKE).contains(&angle);
        let (angle, ends) = match (is_back, angle < 0.0) {
            (false, _) => (angle, [a, b]),
            (true, true) => (angle + PI, [b, a]),
            (true, false) => (angle - PI, [b, a]),
        };
        let offset = Vector::polar(1.0, angle).cross(a.to_vector());
        Some(Self { number, angle, offset, ends })
    }

    /// How far along a direction its ends lie.
    fn along(&self, direction: Vector) -> [f64; 2] {
        self.ends.map(|end| end.to_vector().dot(direction))
    }
}

/// Chains of straight lines that cover what these lines cover, each place once.
pub fn chains(lines: &[[Point; 2]]) -> Vec<Vec<Point>> {
    joined(&merged(lines))
}

/// The same with those that lie on each other, or go on straight where another ends, made one.
fn merged(lines: &[[Point; 2]]) -> Vec<[Point; 2]> {
    tick(LOOK * lines.len());
    let numbered = lines.iter().enumerate();
    let mut lines: Vec<Line> =
        numbered.filter_map(|(number, &ends)| Line::new(number, ends)).collect();
    let mut merged: Vec<Line> = Vec::new();
    lines.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    for alike in runs(&mut lines, |line| line.angle, ALIKE) {
        alike.sort_by(|a, b| a.offset.total_cmp(&b.offset));
        let direction = Vector::polar(1.0, alike[0].angle);
        for level in runs(alike, |line| line.offset, NEAR) {
            level.sort_by(|a, b| a.along(direction)[0].total_cmp(&b.along(direction)[0]));
            let n_before = merged.len();
            for line in level {
                tick(LOOK);
                let [from, to] = line.along(direction);
                match merged[n_before..].last_mut() {
                    Some(last) if from <= last.along(direction)[1] + NEAR => {
                        last.number = last.number.min(line.number);
                        if to > last.along(direction)[1] {
                            last.ends[1] = line.ends[1];
                        }
                    }
                    _ => merged.push(*line),
                }
            }
        }
    }
    merged.sort_by_key(|line| line.number);
    merged.into_iter().map(|line| line.ends).collect()
}

/// Pieces of a sorted list: in each, what is measured differs from that of the first by no more than `most`.
fn runs<T>(
    mut rest: &mut [T],
    measure: impl Fn(&T) -> f64,
    most: f64,
) -> impl Iterator<Item = &mut [T]> {
    std::iter::from_fn(move || {
        let least = measure(rest.first()?);
        let n = rest.partition_point(|it| measure(it) <= least + most);
        let (run, after) = std::mem::take(&mut rest).split_at_mut(n);
        rest = after;
        Some(run)
    })
}

/// The same in chains: each goes on from where a line ends to one that ends there too.
fn joined(lines: &[[Point; 2]]) -> Vec<Vec<Point>> {
    let place = |p: Point| [p.x, p.y].map(|value| (value / NEAR).round() as i64);
    let mut at: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    // The first of them is taken first.
    for (k, ends) in lines.iter().enumerate().rev() {
        ends.iter().for_each(|&end| at.entry(place(end)).or_default().push(k));
    }
    // Where an odd number of lines meets a chain has to begin or to end.
    let odd: HashSet<[i64; 2]> =
        at.iter().filter(|(_, here)| here.len() % 2 == 1).map(|(place, _)| *place).collect();
    let is_odd = |end: &Point| odd.contains(&place(*end));
    let mut starts: Vec<usize> = (0..lines.len()).collect();
    starts.sort_by_key(|&k| !lines[k].iter().any(is_odd));
    let mut is_drawn = vec![false; lines.len()];
    let mut go_on = |is_drawn: &mut [bool], end: Point| {
        let here = at.get_mut(&place(end))?;
        while let Some(k) = here.pop() {
            tick(LOOK);
            if !std::mem::replace(&mut is_drawn[k], true) {
                let [a, b] = lines[k];
                return Some(if place(a) == place(end) { b } else { a });
            }
        }
        None
    };
    let mut chains = Vec::new();
    for k in starts {
        if std::mem::replace(&mut is_drawn[k], true) {
            continue;
        }
        let [a, b] = lines[k];
        let [a, b] = if is_odd(&a) || !is_odd(&b) { [a, b] } else { [b, a] };
        let mut chain = VecDeque::from([a, b]);
        while let Some(next) = go_on(&mut is_drawn, chain[chain.len() - 1]) {
            chain.push_back(next);
        }
        while let Some(next) = go_on(&mut is_drawn, chain[0]) {
            chain.push_front(next);
        }
        chains.push(chain.into());
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(all: &[[f64; 4]]) -> Vec<[Point; 2]> {
        all.iter().map(|&[a, b, c, d]| [Point::new(a, b), Point::new(c, d)]).collect()
    }

    #[test]
    fn each_place_is_passed_once() {
        let check = |all: &[[f64; 4]], wanted: &[&[(f64, f64)]]| {
            let wanted: Vec<Vec<Point>> = wanted
                .iter()
                .map(|chain| chain.iter().map(|&(x, y)| Point::new(x, y)).collect())
                .collect();
            assert_eq!(chains(&lines(all)), wanted, "{all:?}");
        };
        // The same line there and back, a part of it, and one that goes on from it.
        let whole: &[(f64, f64)] = &[(0.0, 0.0), (6.0, 0.0)];
        check(
            &[
                [0.0, 0.0, 4.0, 0.0],
                [4.0, 0.0, 0.0, 0.0],
                [1.0, 0.0, 2.0, 0.0],
                [3.0, 0.0, 6.0, 0.0],
            ],
            &[whole],
        );
        // Level to the left, which is half a turn from level to the right.
        check(&[[4.0, 1.0, 0.0, 1.0], [0.0, 1.0, 4.0, 1.0]], &[&[(0.0, 1.0), (4.0, 1.0)]]);
        let hair = [[4.0, 1.0, 0.0, 1.0], [0.0, 1.0 - 1e-12, 4.0, 1.0 + 1e-12]];
        assert_eq!(chains(&lines(&hair)).len(), 1);
        // Side by side, and one behind the other with a gap.
        check(
            &[[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 1.0, 1.0], [0.0, 2.0, 0.0, 3.0]],
            &[&[(0.0, 0.0), (0.0, 1.0)], &[(1.0, 0.0), (1.0, 1.0)], &[(0.0, 2.0), (0.0, 3.0)]],
        );
        // Two triangles with an edge in common: five lines, from one end of that edge to the other.
        let [a, b, c, d] = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0), (4.0, 3.0)];
        let edge = |(a, b): (f64, f64), (c, d): (f64, f64)| [a, b, c, d];
        let all = [edge(a, b), edge(b, c), edge(c, a), edge(c, b), edge(b, d), edge(d, c)];
        let found = chains(&lines(&all));
        assert_eq!(found.iter().map(|chain| chain.len() - 1).sum::<usize>(), 5, "{found:?}");
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn places_without_length_are_no_lines() {
        assert!(chains(&lines(&[[1.0, 1.0, 1.0, 1.0]])).is_empty());
        assert!(chains(&[]).is_empty());
    }
}
