//! What the solver remembers that later results depend on, as plain numbers: `undo` puts it
//! back, `save` writes it down, and a run goes on from there to the same bits.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Island;
use super::fingerprint::Fingerprint;
use super::history::History;
use crate::constraint::Point;
use crate::solve::method::spectrum::Spectrum;
use crate::solve::report::Status;
use crate::solve::settings::{Method, Settings};
use crate::world::PointId;

/// What is remembered of all islands that were solved. Copies share what is in them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Memory {
    /// By the first free point of each island. All numbers are finite; what they mean is the
    /// solver's own affair.
    islands: BTreeMap<PointId, Arc<[f64]>>,
    /// With which settings: under others what counted as solved may not any more.
    made_by: Option<(Method, f64)>,
}

/// The places of the numbers that do not belong to points.
mod head {
    pub const N_FREE: usize = 0;
    pub const STATUS: usize = 1;
    pub const RESIDUAL: usize = 2;
    pub const PROBED_AT: usize = 3;
    pub const HAS_DEGREE: usize = 4;
    pub const IS_SMOOTH: usize = 5;
    pub const N_PAST: usize = 6;
    pub const N_FEASIBLE: usize = 7;
    pub const N_DIRECTIONS: usize = 8;
    pub const IS_EDITED: usize = 9;
    pub const IS_AWAKE: usize = 10;
    pub const FINGERPRINT: usize = 11;
    /// How many there are; a fingerprint takes two numbers for each of its three parts.
    pub const LEN: usize = FINGERPRINT + 6;
}

impl Memory {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        self.islands.values().map(|numbers| 48 + size_of_val(&**numbers)).sum()
    }

    /// All of it, each part with the point it is filed under.
    pub fn to_numbers(&self) -> Vec<(Option<PointId>, Vec<f64>)> {
        let made_by = self.made_by.map(|(method, tolerance)| {
            let place = Method::ALL.iter().position(|other| *other == method);
            (None, vec![place.unwrap_or_default() as f64, tolerance])
        });
        let islands = self.islands.iter();
        made_by
            .into_iter()
            .chain(islands.map(|(first, numbers)| (Some(*first), numbers.to_vec())))
            .collect()
    }

    /// Adds a part that [`Memory::to_numbers`] gave; false if it cannot be one.
    pub fn restore(&mut self, owner: Option<PointId>, numbers: &[f64]) -> bool {
        match (owner, numbers) {
            (Some(first), _) if Parts::split(numbers).is_some() => {
                self.islands.insert(first, numbers.into());
            }
            (None, &[method, tolerance]) if tolerance > 0.0 && tolerance.is_finite() => {
                let Some(&method) = Method::ALL.get(method as usize) else { return false };
                self.made_by = Some((method, tolerance));
            }
            _ => return false,
        }
        true
    }

    /// The same without its settings where they are these.
    #[must_use]
    pub fn for_settings(mut self, settings: &Settings) -> Self {
        self.made_by = self.made_by.filter(|by| *by != (settings.method, settings.tolerance));
        self
    }

    /// Notes with which settings it was made.
    pub(crate) fn sign(&mut self, settings: Option<&Settings>) {
        self.made_by = settings.map(|s| (s.method, s.tolerance)).or(self.made_by);
    }

    /// The settings, as far as they matter, that it was made with.
    pub(crate) fn made_by(&self) -> Option<(Method, f64)> {
        self.made_by
    }

    /// Whether another makes no difference: with which settings nothing was solved is none.
    pub fn is_same(&self, other: &Self) -> bool {
        let is_bare = self.islands.is_empty() && other.islands.is_empty();
        is_bare || self == other
    }

    /// Adds what is remembered of an island; nothing of one that was never solved.
    pub(crate) fn insert(&mut self, island: &Island) {
        if !island.is_new {
            self.islands.insert(island.points[0], recall(island));
        }
    }

    pub(crate) fn take(&mut self, island: &Island) -> Option<Arc<[f64]>> {
        self.islands.remove(&island.points[0])
    }
}

/// The numbers of an island, by meaning.
struct Parts<'a> {
    head: &'a [f64],
    past: &'a [f64],
    feasible: &'a [f64],
    direction: &'a [f64],
}

impl<'a> Parts<'a> {
    fn split(numbers: &'a [f64]) -> Option<Self> {
        let (head, rest) = numbers.split_at_checked(head::LEN)?;
        let count = |k: usize, most: usize| -> Option<usize> {
            let n = head[k];
            (n >= 0.0 && n <= most as f64 && n.fract() == 0.0).then_some(n as usize)
        };
        let n = 2 * count(head::N_FREE, rest.len().max(1 << 31))?;
        let (past, rest) = rest.split_at_checked(n * count(head::N_PAST, 3)?)?;
        let (feasible, rest) = rest.split_at_checked(n * count(head::N_FEASIBLE, 1)?)?;
        let (direction, rest) = rest.split_at_checked(n * count(head::N_DIRECTIONS, 1)?)?;
        let is_finite = numbers.iter().all(|a| a.is_finite());
        (rest.is_empty() && is_finite).then_some(Self { head, past, feasible, direction })
    }
}

/// What of an island is remembered; worked out once after each visit.
fn recall(island: &Island) -> Arc<[f64]> {
    let numbers = || {
        let feasible = island.feasible.as_deref().unwrap_or_default();
        let direction = island.spectrum.as_deref().map_or(&[][..], Spectrum::direction);
        let flag = |is: bool| f64::from(u8::from(is));
        let mut numbers = vec![0.0; head::LEN];
        numbers[head::N_FREE] = island.n_free as f64;
        numbers[head::STATUS] = f64::from(island.status as u8);
        numbers[head::RESIDUAL] = island.residual.min(f64::MAX);
        numbers[head::PROBED_AT] = island.probed_at;
        numbers[head::IS_EDITED] = flag(island.is_edited);
        numbers[head::IS_AWAKE] = flag(island.is_awake);
        numbers[head::HAS_DEGREE] = flag(island.has_degree);
        numbers[head::IS_SMOOTH] = flag(island.is_smooth());
        numbers[head::N_PAST] = island.history.n_past() as f64;
        numbers[head::N_FEASIBLE] = flag(!feasible.is_empty());
        numbers[head::N_DIRECTIONS] = flag(!direction.is_empty());
        let Fingerprint { structure, inputs, pose } = island.fingerprint();
        for (k, part) in [structure, inputs, pose].into_iter().enumerate() {
            numbers[head::FINGERPRINT + 2 * k] = f64::from((part >> 32) as u32);
            numbers[head::FINGERPRINT + 2 * k + 1] = f64::from(part as u32);
        }
        let past = island.history.to_past();
        numbers.extend(past.iter().chain(feasible).flat_map(|p| [p.x, p.y]));
        numbers.extend(direction);
        numbers.into()
    };
    island.remembered.get_or_init(numbers).clone()
}

/// Puts an island in a remembered state, if it is of the same structure. What was edited since
/// then counts as edited by hand now.
pub(crate) fn restore(island: &mut Island, numbers: &[f64]) {
    let Some(Parts { head, past, feasible, direction }) = Parts::split(numbers) else { return };
    let part = |k: usize| {
        let at = head::FINGERPRINT + 2 * k;
        (head[at] as u64) << 32 | head[at + 1] as u64
    };
    let then = Fingerprint { structure: part(0), inputs: part(1), pose: part(2) };
    let now = island.fingerprint();
    if now.structure != then.structure || head[head::N_FREE] != island.n_free as f64 {
        return;
    }
    let points = |numbers: &[f64]| -> Vec<Point> {
        numbers.as_chunks::<2>().0.iter().map(|p| Point::new(p[0], p[1])).collect()
    };
    island.status = match head[head::STATUS] {
        0.0 => Status::Converged,
        1.0 => Status::BestFit,
        _ => Status::Stalled,
    };
    island.residual = head[head::RESIDUAL];
    island.is_new = false;
    island.is_edited = head[head::IS_EDITED] != 0.0;
    island.is_awake = head[head::IS_AWAKE] != 0.0;
    island.probed_at = head[head::PROBED_AT];
    if head[head::HAS_DEGREE] != 0.0 {
        island.set_smooth(head[head::IS_SMOOTH] != 0.0);
    }
    island.history = History::from_past(&points(past), island.n_free);
    island.feasible = (!feasible.is_empty()).then(|| points(feasible).into());
    island.spectrum =
        (!direction.is_empty()).then(|| Box::new(Spectrum::from_direction(direction.to_vec())));
    if now != then {
        island.note_edit(now.pose != then.pose);
    }
}
