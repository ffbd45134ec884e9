//! Where a single point can still go, and what keeps it from going elsewhere.

use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRow, UnitRows};
use crate::constraint::{PointIdx, Vector};

/// What is left of the two freedoms of a point, at first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Directions {
    /// It cannot move.
    None,
    /// It can move along this unit vector, either way.
    Along(Vector),
    /// It can move in every direction.
    All,
}

/// How a point can move, and what holds it.
#[derive(Debug, Clone, PartialEq)]
pub struct Freedom {
    /// Where it can go.
    pub directions: Directions,
    /// The constraints that keep it from going elsewhere, the strongest first.
    pub held_by: Vec<usize>,
}

/// A share of a unit displacement below this is none; rounding leaves 1e-7.
const NO_SHARE: f64 = 1e-5;

/// How the point can move with everything that must move with it.
pub fn freedom(scene: &ConstraintSystem, point: PointIdx) -> Freedom {
    let (rows, _) = scene.rows(0.0);
    let holds = |island: &UnitRows| island.points.binary_search(&point).is_ok();
    let Some(island) = rows.islands().into_iter().find(holds) else {
        return Freedom { directions: Directions::None, held_by: Vec::new() };
    };
    let place = island.points.partition_point(|&p| p < point);
    let mut projector = Projector::of(&island);
    // The block of the projection onto the free motions that belongs to the point.
    let mut share = [[0.0; 2]; 2];
    let mut motions = [vec![0.0; island.n_unknowns()], vec![0.0; island.n_unknowns()]];
    for (axis, motion) in motions.iter_mut().enumerate() {
        motion[2 * place + axis] = 1.0;
        projector.onto_motions(motion);
        share[axis] = [motion[2 * place], motion[2 * place + 1]];
    }
    let [[a, b], [_, c]] = share;
    let (middle, spread) = (0.5 * (a + c), libm::hypot(0.5 * (a - c), b));
    if middle - spread > NO_SHARE {
        return Freedom { directions: Directions::All, held_by: Vec::new() };
    }
    let phi = 0.5 * libm::atan2(b, 0.5 * (a - c));
    let along = Vector::polar(1.0, phi);
    let is_held = middle + spread <= NO_SHARE;
    let directions = if is_held { Directions::None } else { Directions::Along(along) };
    let blocked: &[Vector] =
        if is_held { &[Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)] } else { &[along.perp()] };
    Freedom { directions, held_by: holders(&island, place, blocked) }
}

/// The constraints whose forces hold the point against a push in the blocked directions.
fn holders(island: &UnitRows, place: usize, blocked: &[Vector]) -> Vec<usize> {
    let mut projector = Projector::of(island);
    let mut strength: Vec<(f64, usize)> = Vec::new();
    for direction in blocked {
        let mut push = vec![0.0; island.n_unknowns()];
        push[2 * place] = direction.x;
        push[2 * place + 1] = direction.y;
        for (force, row) in projector.multipliers(&push).0.iter().zip(&island.rows) {
            strength.push((force.abs(), row.source.0));
        }
    }
    strongest_first(strength, &island.rows)
}

fn strongest_first(mut strength: Vec<(f64, usize)>, rows: &[UnitRow]) -> Vec<usize> {
    strength.retain(|&(force, _)| force > NO_SHARE);
    strength.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut named = vec![false; rows.last().map_or(0, |row| row.source.0 + 1)];
    let first = |&(_, c): &(f64, usize)| !std::mem::replace(&mut named[c], true);
    strength.into_iter().filter(first).map(|(_, c)| c).collect()
}
