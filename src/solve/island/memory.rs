//! What the solver remembers that later results depend on: `undo` puts it back, `save` writes it
//! down as plain numbers, and a run goes on from there to the same bits.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Island;
use super::history::History;
use super::snapshot::{Exact, Snapshot};
use crate::solve::method::spectrum::Spectrum;
use crate::solve::settings::{Method, Settings};
use crate::world::PointId;

/// What is remembered of all islands that were solved. Copies share what is in them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Memory {
    /// By the first free point of each island.
    islands: BTreeMap<PointId, Arc<Snapshot>>,
    /// With which settings: under others what counted as solved may not any more.
    made_by: Option<(Method, f64)>,
}

impl Memory {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        self.islands.values().map(|snapshot| 48 + size_of::<f64>() * snapshot.n_numbers()).sum()
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
            .chain(islands.map(|(first, snapshot)| (Some(*first), snapshot.to_numbers())))
            .collect()
    }

    /// Adds a part that [`Memory::to_numbers`] gave; false if it cannot be one.
    pub fn restore(&mut self, owner: Option<PointId>, numbers: &[f64]) -> bool {
        match (owner, numbers) {
            (Some(first), _) => {
                let Some(snapshot) = Snapshot::from_numbers(numbers) else { return false };
                self.islands.insert(first, Arc::new(snapshot));
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

    /// Adds what is remembered of an island; nothing of one that was never solved, or is blank.
    pub(crate) fn insert(&mut self, island: &Island) {
        if !island.is_new && !island.is_blank {
            self.put(island.points[0], snapshot_of(island));
        }
    }

    /// Adds a snapshot of the island that begins with a point.
    pub(crate) fn put(&mut self, first: PointId, snapshot: Arc<Snapshot>) {
        if !snapshot.is_new() {
            self.islands.insert(first, snapshot);
        }
    }

    /// The snapshots, each with the first point of its island.
    pub(crate) fn into_islands(self) -> impl Iterator<Item = (PointId, Arc<Snapshot>)> {
        self.islands.into_iter()
    }
}

/// What of an island is remembered; worked out once after each visit.
pub(crate) fn snapshot_of(island: &Island) -> Arc<Snapshot> {
    island.remembered.get_or_init(|| Arc::new(Snapshot::of(island))).clone()
}

impl Snapshot {
    /// What of an island is remembered.
    pub fn of(island: &Island) -> Self {
        Self {
            n_free: island.n_free,
            status: island.status,
            residual: island.residual,
            probed_at: island.probed_at,
            has_degree: island.has_degree,
            is_smooth: island.is_smooth(),
            is_edited: island.is_edited,
            is_awake: island.is_awake,
            fingerprint: island.fingerprint(),
            past: island.history.to_past().into(),
            feasible: island.feasible.clone().unwrap_or_default(),
            direction: island.spectrum.as_deref().map_or(&[][..], Spectrum::direction).into(),
            exact: Some(Exact {
                is_new: island.is_new,
                n_evaluations: island.n_evaluations,
                sides: island.known_sides(),
                inputs: (!island.inputs.is_empty()).then(|| Box::new(island.inputs.clone())),
            }),
        }
    }
}

/// Puts an island in a remembered state, if it is of the same structure. What was edited since
/// then counts as edited by hand now.
pub(crate) fn restore(island: &mut Island, then: &Snapshot) {
    let now = island.fingerprint();
    if now.structure != then.fingerprint.structure || then.n_free != island.n_free {
        return;
    }
    island.status = then.status;
    island.residual = then.residual;
    island.is_new = then.is_new();
    island.is_edited = then.is_edited;
    island.is_awake = then.is_awake;
    island.probed_at = then.probed_at;
    if then.has_degree {
        island.set_smooth(then.is_smooth);
    }
    island.history = History::from_past(&then.past, island.n_free);
    island.feasible = (!then.feasible.is_empty()).then(|| then.feasible.clone());
    let direction = (!then.direction.is_empty()).then(|| then.direction.to_vec());
    island.spectrum = direction.map(|direction| Box::new(Spectrum::from_direction(direction)));
    if let Some(exact) = &then.exact {
        island.n_evaluations = exact.n_evaluations;
        island.recall_sides(&exact.sides);
        island.inputs = exact.inputs.as_deref().cloned().unwrap_or_default();
    }
    if now != then.fingerprint {
        island.note_edit(now.pose != then.fingerprint.pose);
    }
}
