//! What the solver remembers that later results depend on, as plain numbers: `undo` puts it
//! back, `save` writes it down, and a run goes on from there to the same bits.

use std::sync::Arc;

use super::history::History;
use super::island::Island;
use super::spectrum::Spectrum;
use super::status::Status;
use crate::constraint::Point;
use crate::world::PointId;

/// What is remembered of all islands. Copies share what did not change between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Memory {
    /// What is remembered of each island that was solved, in order of their first points.
    pub islands: Vec<Arc<Remembered>>,
}

/// What is remembered of one island.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Remembered {
    /// Its free points, ascending: an island with others is another one.
    pub points: Vec<PointId>,
    /// All numbers, finite; what they mean is the solver's own affair.
    pub numbers: Vec<f64>,
}

/// How many numbers come before those that belong to points.
const N_HEAD: usize = 7;

/// What of an island is remembered.
pub(super) fn recall(island: &Island) -> Remembered {
    let past = island.history.to_past();
    let feasible = island.feasible.as_deref().unwrap_or_default();
    let direction = island.spectrum.as_deref().map_or(&[][..], |spectrum| &spectrum.v);
    let is_smooth = island.degree.iter().any(|&degree| degree > 1);
    let mut numbers = vec![
        f64::from(island.status as u8),
        if island.residual.is_finite() { island.residual } else { -1.0 },
        f64::from(u8::from(island.is_probed)),
        f64::from(u8::from(island.has_degree)) + 2.0 * f64::from(u8::from(is_smooth)),
        island.history.n_past() as f64,
        f64::from(u8::from(!feasible.is_empty())),
        f64::from(u8::from(!direction.is_empty())),
    ];
    debug_assert_eq!(numbers.len(), N_HEAD);
    numbers.extend(past.iter().chain(feasible).flat_map(|p| [p.x, p.y]));
    numbers.extend(direction);
    Remembered { points: island.points[..island.n_free].to_vec(), numbers }
}

/// Puts an island in a remembered state. What does not fit is not taken.
pub(super) fn restore(island: &mut Island, remembered: &Remembered) {
    let n_free = island.n_free;
    let (Some(head), Some(rest)) =
        (remembered.numbers.get(..N_HEAD), remembered.numbers.get(N_HEAD..))
    else {
        return;
    };
    let (n_past, n_feasible) = (head[4] as usize, usize::from(head[5] != 0.0));
    let n_direction = usize::from(head[6] != 0.0);
    if n_past > 3 || rest.len() != 2 * n_free * (n_past + n_feasible + n_direction) {
        return;
    }
    let points = |numbers: &[f64]| -> Vec<Point> {
        numbers.as_chunks::<2>().0.iter().map(|p| Point::new(p[0], p[1])).collect()
    };
    let (past, rest) = rest.split_at(2 * n_free * n_past);
    let (feasible, direction) = rest.split_at(2 * n_free * n_feasible);
    island.status = match head[0] as u8 {
        0 => Status::Converged,
        1 => Status::BestFit,
        _ => Status::Stalled,
    };
    island.residual = if head[1] < 0.0 { f64::INFINITY } else { head[1] };
    island.is_new = false;
    island.is_probed = head[2] != 0.0;
    if head[3] as u8 & 1 != 0 {
        island.set_smooth(head[3] as u8 & 2 != 0);
    }
    island.history = History::from_past(&points(past), n_free);
    island.feasible = (n_feasible > 0).then(|| points(feasible).into());
    island.spectrum =
        (n_direction > 0).then(|| Box::new(Spectrum::from_direction(direction.to_vec())));
}
