//! What is remembered of one island, and how it is written as plain numbers.

use super::inputs::Inputs;
use super::known_sides::KnownSides;
use crate::constraint::Point;
use crate::solve::report::Status;

/// What an island is made of, what drives it and how it lies, each as one number: equal
/// numbers mean that nothing was edited.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Fingerprint {
    pub structure: u64,
    pub inputs: u64,
    pub pose: u64,
}

/// What is remembered of one island.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(crate) struct Snapshot {
    /// The points that are not frozen.
    pub n_free: usize,
    /// How the last solve ended.
    pub status: Status,
    /// The largest distance to satisfaction it left, relative to the size.
    pub residual: f64,
    /// The energy at which a way off a saddle was last looked for; 0 if none was.
    pub probed_at: f64,
    /// Whether it is known how smooth its motion is.
    pub has_degree: bool,
    /// Whether its motion is smooth, where that is known.
    pub is_smooth: bool,
    /// Whether the user changed it since it was solved.
    pub is_edited: bool,
    /// Whether it is to be visited in the next frame.
    pub is_awake: bool,
    /// What it was.
    pub fingerprint: Fingerprint,
    /// The poses of the last frames, the latest first.
    pub past: Box<[Point]>,
    /// The last pose that met everything, kept while none does; else empty.
    pub feasible: Box<[Point]>,
    /// What its spectrum carries from frame to frame, (x, y) for each free point; else empty.
    pub direction: Box<[f64]>,
    /// What is not written down; none where this was read.
    pub exact: Option<Exact>,
}

/// What of an island follows from its pose, nearly: kept for those who bring it back in the same
/// session.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Exact {
    /// Whether it was never solved.
    pub is_new: bool,
    /// The work of its last visit.
    pub n_evaluations: u32,
    /// On which side everything was when last looked at.
    pub sides: KnownSides,
    /// What drives it in a frame that was cut short.
    pub inputs: Option<Box<Inputs>>,
}

/// How many numbers there are before those of the points.
const HEADER: usize = 17;
/// No world has more points.
const MOST_POINTS: usize = 1 << 31;

impl Snapshot {
    /// Whether the island was never solved.
    pub fn is_new(&self) -> bool {
        self.exact.as_ref().is_some_and(|exact| exact.is_new)
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let sides = self.exact.as_ref().map_or(0, |exact| exact.sides.n_bytes());
        size_of::<Self>() + size_of::<f64>() * (self.n_numbers() - HEADER) + sides
    }

    /// How many numbers [`Snapshot::to_numbers`] gives.
    pub fn n_numbers(&self) -> usize {
        HEADER + 2 * (self.past.len() + self.feasible.len()) + self.direction.len()
    }

    /// All of it, as `save` writes it.
    pub fn to_numbers(&self) -> Vec<f64> {
        let flag = |is: bool| f64::from(u8::from(is));
        let Fingerprint { structure, inputs, pose } = self.fingerprint;
        let mut numbers = vec![
            self.n_free as f64,
            f64::from(code(self.status)),
            self.residual.min(f64::MAX),
            self.probed_at,
            flag(self.has_degree),
            flag(self.is_smooth),
            (self.past.len() / self.n_free.max(1)) as f64,
            flag(!self.feasible.is_empty()),
            flag(!self.direction.is_empty()),
            flag(self.is_edited),
            flag(self.is_awake),
        ];
        numbers.extend([structure, inputs, pose].into_iter().flat_map(halves));
        numbers.extend(self.past.iter().chain(&self.feasible).flat_map(|p| [p.x, p.y]));
        numbers.extend(&self.direction);
        numbers
    }

    /// What [`Snapshot::to_numbers`] gave these numbers for; none if they cannot be that.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let (header, rest) = numbers.split_first_chunk::<HEADER>()?;
        let [
            n_free,
            status,
            residual,
            probed_at,
            has_degree,
            is_smooth,
            n_past,
            n_feasible,
            n_directions,
            is_edited,
            is_awake,
            ref fingerprint @ ..,
        ] = *header;
        let n_free = count(n_free, MOST_POINTS)?;
        let (past, rest) = rest.split_at_checked(2 * n_free * count(n_past, 3)?)?;
        let (feasible, rest) = rest.split_at_checked(2 * n_free * count(n_feasible, 1)?)?;
        let (direction, rest) = rest.split_at_checked(2 * n_free * count(n_directions, 1)?)?;
        if !rest.is_empty() || !numbers.iter().all(|number| number.is_finite()) {
            return None;
        }
        let [structure, inputs, pose] =
            [0, 2, 4].map(|k| whole([fingerprint[k], fingerprint[k + 1]]));
        Some(Self {
            n_free,
            status: match status {
                0.0 => Status::Converged,
                1.0 => Status::BestFit,
                // Whether nothing can help is found again by who asks.
                _ => Status::Stalled,
            },
            residual,
            probed_at,
            has_degree: has_degree != 0.0,
            is_smooth: is_smooth != 0.0,
            is_edited: is_edited != 0.0,
            is_awake: is_awake != 0.0,
            fingerprint: Fingerprint { structure, inputs, pose },
            past: points(past).into(),
            feasible: points(feasible).into(),
            direction: direction.into(),
            exact: None,
        })
    }
}

/// A whole number up to `most`.
fn count(number: f64, most: usize) -> Option<usize> {
    let is_one = number >= 0.0 && number <= most as f64 && number.fract() == 0.0;
    is_one.then_some(number as usize)
}

/// A hash as two numbers, each of which a double holds exactly.
fn halves(hash: u64) -> [f64; 2] {
    [f64::from((hash >> 32) as u32), f64::from(hash as u32)]
}

fn whole([upper, lower]: [f64; 2]) -> u64 {
    (upper as u64) << 32 | lower as u64
}

fn points(numbers: &[f64]) -> Vec<Point> {
    numbers.as_chunks::<2>().0.iter().map(|p| Point::new(p[0], p[1])).collect()
}

/// The number that stands for an ending.
const fn code(status: Status) -> u8 {
    match status {
        Status::Converged => 0,
        // No island ends as contradictory: that takes a test of its own.
        Status::BestFit | Status::Contradictory => 1,
        Status::Stalled => 2,
        Status::Unsatisfiable => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot() -> Snapshot {
        let place = |k: i32| Point::new(f64::from(k), 0.1 * f64::from(k));
        Snapshot {
            n_free: 2,
            status: Status::BestFit,
            residual: 1e-13,
            probed_at: 0.5,
            has_degree: true,
            is_smooth: false,
            is_edited: true,
            is_awake: false,
            fingerprint: Fingerprint { structure: u64::MAX - 1, inputs: 7, pose: 1 << 40 },
            past: (0..4).map(place).collect(),
            feasible: (4..6).map(place).collect(),
            direction: [1.0, 2.0, 3.0, 4.0].into(),
            exact: None,
        }
    }

    #[test]
    fn numbers_are_read_as_they_were_written() {
        let snapshot = snapshot();
        let numbers = snapshot.to_numbers();
        assert_eq!(numbers.len(), snapshot.n_numbers());
        assert_eq!(Snapshot::from_numbers(&numbers), Some(snapshot));
    }

    #[test]
    fn what_cannot_be_an_island_is_refused() {
        let numbers = snapshot().to_numbers();
        assert_eq!(Snapshot::from_numbers(&numbers[1..]), None);
        assert_eq!(Snapshot::from_numbers(&[]), None);
        for (k, wrong) in
            [(0, 0.5), (0, 3.0), (6, 4.0), (7, -1.0), (2, f64::NAN), (20, f64::INFINITY)]
        {
            let mut numbers = numbers.clone();
            numbers[k] = wrong;
            assert_eq!(Snapshot::from_numbers(&numbers), None, "number {k} is {wrong}");
        }
    }
}
