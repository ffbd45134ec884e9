//! A scene: the symbols of a mechanism, where its points are, and what they left behind.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::classify;
use super::page::BoundingBox;
use super::symbols::{Symbol, SymbolForm};
use super::trace::Curve;
use crate::constraint::Point;
use crate::interrupt::tick;
use crate::world::{ConstraintId, Ghost, World};

/// What a look at a symbol takes, in ticks.
const LOOK: usize = 20;

/// Constraints that do not hold, each with by how much it is off, in words.
pub type Unmet = BTreeMap<ConstraintId, Arc<str>>;

/// What is to be drawn, as plain data that owes nothing to the world it came from.
///
/// A copy is cheap: what does not change is shared.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(super) pose: DrawnPose,
    /// The same at other times, the oldest first.
    pub(super) ghosts: Vec<Arc<DrawnPose>>,
    pub(super) curves: Vec<Curve>,
    pub(super) unmet: Unmet,
}

/// Symbols and where the points are that they hang on.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPose {
    /// What is drawn.
    pub symbols: Arc<[Symbol]>,
    /// Positions by handle; those of points that do not live mean nothing.
    pub at: Arc<[Point]>,
}

impl Scene {
    /// The scene of a world as it stands.
    pub fn new(world: &World) -> Self {
        let pose = DrawnPose::of(world);
        let ghosts = world.ghosts().iter().map(|ghost| pose.exposed(ghost, world)).collect();
        let curves = world.traces().iter().enumerate();
        let curves = curves.map(|(k, trace)| Curve::of(k, trace, world)).collect();
        Self { pose, ghosts, curves, unmet: Unmet::new() }
    }

    /// The same, with what does not hold in it.
    #[must_use]
    pub fn with_unmet(mut self, unmet: Unmet) -> Self {
        self.unmet = unmet;
        self
    }

    /// Roughly how many bytes it takes beside others that share its symbols and ghosts.
    pub fn n_bytes(&self) -> usize {
        size_of::<Self>()
            + size_of_val(&*self.pose.at)
            + size_of_val(&*self.ghosts)
            + size_of_val(&*self.curves)
    }

    /// The scene of the same world somewhat later. It shares with this one what did not
    /// change: frames of a recording made this way take the room of their positions.
    #[must_use]
    pub fn next(&self, world: &World) -> Self {
        let mut pose = DrawnPose::of(world);
        if pose.symbols == self.pose.symbols {
            pose.symbols = self.pose.symbols.clone();
        }
        let n_same = self.n_same_ghosts(world);
        let mut ghosts = self.ghosts[..n_same].to_vec();
        ghosts.extend(world.ghosts()[n_same..].iter().map(|ghost| pose.exposed(ghost, world)));
        let curves = world.traces().iter().enumerate().map(|(k, trace)| {
            let grown = self.curves.get(k).and_then(|curve| curve.grown(trace, world));
            grown.unwrap_or_else(|| Curve::of(k, trace, world))
        });
        Self { pose, ghosts, curves: curves.collect(), unmet: Unmet::new() }
    }

    /// The same without where its points are, and that apart: of the frames of a recording it is all
    /// that is not shared.
    #[must_use]
    pub fn without_places(mut self) -> (Self, Arc<[Point]>) {
        let at = std::mem::take(&mut self.pose.at);
        (self, at)
    }

    /// The same with its points at these places.
    #[must_use]
    pub fn with_places(&self, at: Vec<Point>) -> Self {
        let mut scene = self.clone();
        scene.pose.at = at.into();
        scene
    }

    /// How many symbols it has.
    pub fn n_symbols(&self) -> usize {
        self.pose.symbols.len()
    }

    /// How many of the ghosts are still those of a later world.
    fn n_same_ghosts(&self, world: &World) -> usize {
        let n = self.ghosts.len().min(world.ghosts().len());
        let is_last_same = n > 0
            && world.ghosts()[n - 1].at.iter().all(|(id, place)| {
                self.ghosts[n - 1].at.get(id.idx()).is_none_or(|at| at == place)
            });
        if is_last_same { n } else { 0 }
    }

    /// Grows the box to hold ghosts and paths, those that `later` holds too excepted.
    pub(super) fn extend_by_past(&self, later: Option<&Self>, bounds: &mut BoundingBox) {
        for (k, ghost) in self.ghosts.iter().enumerate() {
            let same = later.and_then(|scene| scene.ghosts.get(k));
            if same.is_none_or(|other| other != ghost) {
                ghost.extend(bounds);
            }
        }
        for (k, curve) in self.curves.iter().enumerate() {
            let same = later.and_then(|scene| scene.curves.get(k));
            if same.is_none_or(|other| !curve.is_continued_by(other)) {
                curve.extend(bounds);
            }
        }
    }
}

impl DrawnPose {
    /// A world as it stands.
    fn of(world: &World) -> Self {
        Self { symbols: classify::symbols(world).into(), at: world.points().column().into() }
    }

    /// The same symbols where they were, without those that had not all their points then, and
    /// without those that cannot have been elsewhere.
    fn exposed(&self, ghost: &Ghost, world: &World) -> Arc<Self> {
        tick(LOOK * (self.at.len() + self.symbols.len()));
        let mut at = vec![None; self.at.len()];
        for (id, place) in &ghost.at {
            if let Some(slot) = at.get_mut(id.idx()) {
                *slot = Some(*place);
            }
        }
        let is_seen = |symbol: &&Symbol| {
            let points = symbol.points();
            let is_whole = points.iter().all(|&p| at[p as usize].is_some());
            let can_move =
                points.iter().any(|&p| !world.points().is_frozen(crate::world::PointId(p)));
            is_whole && can_move && !matches!(symbol.form, SymbolForm::Construction(_))
        };
        let symbols = self.symbols.iter().filter(is_seen).cloned().collect();
        Arc::new(Self { symbols, at: at.into_iter().map(Option::unwrap_or_default).collect() })
    }

    /// Grows the box to hold it.
    pub fn extend(&self, bounds: &mut BoundingBox) {
        tick(LOOK * self.symbols.len());
        self.symbols.iter().for_each(|symbol| symbol.extend(&self.at, bounds));
    }

    /// The length of each bar, world units.
    pub fn bar_lengths(&self) -> impl Iterator<Item = f64> {
        self.symbols.iter().filter_map(|symbol| symbol.bar_length(&self.at))
    }
}
