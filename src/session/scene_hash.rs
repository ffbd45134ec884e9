//! What a picture says of where it comes from: tolerance, residual, a hash of the scene.

use std::fmt::Write;

use super::commands::setting_table::SETTINGS;
use super::fnv::fnv_1a;
use super::resolve::unbind::Unbind;
use super::state::State;
use super::summary::Summary;
use crate::diag::{format_number, format_rounded};
use crate::interrupt::tick;
use crate::render::Options;
use crate::solve::verdict;

/// What the writing of a line takes, in ticks.
const LINE: usize = 500;

impl State {
    /// A hash of the scene: the same for the same settings, points at the start, parameters
    /// and constraints, however far it has run.
    pub fn scene_hash(&self) -> u64 {
        let mut text = String::new();
        // Writing to a string cannot fail.
        for setting in SETTINGS.iter().filter(|setting| setting.is_of_scene) {
            let _ = writeln!(text, "set {} {}", setting.name, (setting.text)(self));
        }
        let points = self.world.points();
        for id in points.ids() {
            tick(LINE);
            let has_begun = self.world.clock().frame > 0;
            let at = if has_begun { points.start(id) } else { points.at(id) };
            let _ = writeln!(
                text,
                "point {} = ({}, {}) frozen {} weight {}",
                points.name(id),
                format_number(at.x),
                format_number(at.y),
                points.is_frozen(id),
                format_number(points.weight(id))
            );
        }
        for id in self.parameters_in_order() {
            tick(LINE);
            let _ = writeln!(text, "{}", Unbind::of(&self.world).parameter_text(id));
        }
        for (_, record) in self.world.constraints() {
            tick(LINE);
            let rho = record.rho().map(format_number).unwrap_or_default();
            let _ = writeln!(
                text,
                "{} on {} rho {rho}",
                Unbind::of(&self.world).constraint_text(record),
                record.is_on
            );
        }
        fnv_1a(text.as_bytes())
    }

    /// What pictures of the present scene carry along, if this run led to it. The largest residual is that
    /// of the run, or of the present pose where that is larger.
    pub(super) fn picture_options(&self, run: Option<&Summary>) -> Options {
        let tolerance = run.map_or(self.preferences.solve.tolerance, |run| run.tolerance);
        let now = verdict(&self.world, &self.preferences.solve).residual;
        let residual = run.map_or(now, |run| run.worst_residual.max(now));
        let receipt = [
            ("tolerance", format_number(tolerance)),
            ("largest residual", format_rounded(residual)),
            ("scene", format!("{:016x}", self.scene_hash())),
        ];
        let receipt = receipt.map(|(key, value)| (key.to_owned(), value)).to_vec();
        Options { receipt, ..Options::default() }
    }
}
