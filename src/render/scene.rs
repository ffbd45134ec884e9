//! A scene: the parts of a mechanism, where its points are, and what they left behind.

use std::rc::Rc;

use super::parts::{Form, Part};
use super::view::Extent;
use super::{curve::Curve, plan};
use crate::constraint::{Point, PointIdx};
use crate::world::{Ghost, World};

/// What is to be drawn, as plain data that owes nothing to the world it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    pub(super) pose: Pose,
    /// The same at other times, the oldest first.
    pub(super) ghosts: Vec<Pose>,
    pub(super) curves: Vec<Curve>,
}

/// Parts and where the points are that they hang on.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// What is drawn.
    pub parts: Rc<[Part]>,
    /// Positions by handle; those of points that do not live mean nothing.
    pub at: Rc<[Point]>,
}

impl Scene {
    /// The scene of a world as it stands.
    pub fn of(world: &World) -> Self {
        let pose = Pose::of(world);
        let ghosts = world.ghosts().iter().map(|ghost| pose.exposed(ghost)).collect();
        let curves = world.traces().iter().enumerate();
        let curves = curves.map(|(k, trace)| Curve::of(k, trace, world)).collect();
        Self { pose, ghosts, curves }
    }

    /// Grows the box to hold everything.
    pub fn extend(&self, extent: &mut Extent) {
        self.pose.extend(extent);
        self.ghosts.iter().for_each(|ghost| ghost.extend(extent));
        self.curves.iter().for_each(|curve| curve.extend(extent));
    }
}

impl Pose {
    /// A world as it stands.
    pub fn of(world: &World) -> Self {
        Self { parts: plan::parts(world).into(), at: world.points().column().into() }
    }

    /// The same parts where they were, without those that had not all their points then, and
    /// without those that still are where they were.
    pub fn exposed(&self, ghost: &Ghost) -> Self {
        let mut at = vec![None; self.at.len()];
        for (id, place) in &ghost.at {
            if let Some(slot) = at.get_mut(id.idx()) {
                *slot = Some(*place);
            }
        }
        let is_seen = |part: &&Part| {
            let points = part.points();
            let has_moved = |&p: &PointIdx| at[p as usize] != Some(self.at[p as usize]);
            let is_whole = points.iter().all(|&p| at[p as usize].is_some());
            is_whole && points.iter().any(has_moved) && !matches!(part.form, Form::Construction(_))
        };
        let parts = self.parts.iter().filter(is_seen).cloned().collect();
        Self { parts, at: at.into_iter().map(Option::unwrap_or_default).collect() }
    }

    /// Grows the box to hold it.
    pub fn extend(&self, extent: &mut Extent) {
        self.parts.iter().for_each(|part| part.extend(&self.at, extent));
    }

    /// The length of each bar, world units.
    pub fn bar_lengths(&self) -> impl Iterator<Item = f64> {
        self.parts.iter().filter_map(|part| part.bar_length(&self.at))
    }
}
