//! What runs that nobody hears talk to: variants of a sweep, trials of a fit. What they find is counted.

use super::finding::Finding;
use super::host::Host;
use super::silent::Silent;
use crate::diag::{Diagnostic, Sources};
use crate::solve::Status;

/// A host that counts what a run finds. Files are read where `outside` finds them; what is written is
/// only there for the variant itself.
pub struct Quiet<'a> {
    outside: Silent<'a>,
    /// How the worst command that let time pass ended, and its largest residual; none where no time
    /// passed.
    pub worst: Option<(Status, f64)>,
    /// Frames that missed their tolerance.
    pub n_missed: u64,
    /// Times that a motor could not go on where it could before.
    pub n_dead_points: u64,
}

impl<'a> Quiet<'a> {
    /// Nothing found yet.
    pub fn new(outside: &'a mut dyn Host) -> Self {
        let outside = Silent::new(outside);
        Self { outside, worst: None, n_missed: 0, n_dead_points: 0 }
    }
}

impl Host for Quiet<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&self.outside)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut self.outside)
    }

    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_listening(&self) -> bool {
        false
    }

    fn takes_findings(&self) -> bool {
        true
    }

    fn find_out(&mut self, finding: &Finding) {
        match finding {
            Finding::Ran(summary, ..) => {
                let (status, residual) = self.worst.unwrap_or((Status::Converged, 0.0));
                self.worst =
                    Some((status.max(summary.worst_status), residual.max(summary.worst_residual)));
                self.n_missed += summary.n_missed;
            }
            Finding::Halted(..) => self.n_dead_points += 1,
            _ => {}
        }
    }
}
