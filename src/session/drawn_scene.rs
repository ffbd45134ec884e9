//! The scene that pictures of a state show: what there is, with what does not hold in it.

use std::sync::Arc;

use super::settled::miss;
use super::state::State;
use crate::interrupt::tick;
use crate::render::{Scene, Unmet};
use crate::solve::{present, verdict};

/// What the writing of an amount takes, in ticks.
const AMOUNT: usize = 500;

impl State {
    /// What is drawn of the present pose.
    pub fn scene(&self) -> Scene {
        Scene::new(&self.world).with_unmet(self.unmet())
    }

    /// What does not hold in the present pose, each with by how much.
    fn unmet(&self) -> Unmet {
        let verdict = verdict(&self.world, &self.preferences.solve);
        if verdict.is_met() {
            return Unmet::new();
        }
        let (world, _) = present(&self.world);
        let off = verdict.judged.iter().filter(|judged| !judged.is_met());
        let amount = |id| {
            tick(AMOUNT);
            let record = world.constraint(id)?;
            let text = format!("{} off by {}", record.name, miss(&world, &record.constraint));
            Some((id, Arc::from(text)))
        };
        off.filter_map(|judged| amount(judged.id)).collect()
    }
}
