//! A sweep: a script over a grid. It begins with the variants that show what its columns are.

use std::borrow::Cow;

use super::grid::Grid;
use super::table::Columns;
use super::variant::{SweepScript, Variant};
use crate::diag::{Diagnostic, Kind, Sources};
use crate::errors;
use crate::render::Options;
use crate::session::host::Host;
use crate::session::undeclared::Undeclared;

/// Variants that are tried for one that comes to its end and shows the columns.
const MODELS: u64 = 1000;

/// A script with the grid that it is run over.
#[derive(Debug)]
pub struct Sweep {
    script: SweepScript,
    grid: Grid,
    /// The first variants up to one that came to its end, if one did.
    first: Vec<Variant>,
    columns: Columns,
}

/// What is wrong, and the texts that its places are in.
pub type Refusal = (Diagnostic, Sources);

fn refusal(problem: Diagnostic) -> Refusal {
    (problem, Sources::new())
}

impl Sweep {
    /// Runs the first variants, up to one that comes to its end.
    ///
    /// # Errors
    /// A parameter that is given twice, or that no `let` of the script takes; the wish to stop.
    pub fn begin(script: SweepScript, grid: Grid, host: &mut dyn Host) -> Result<Self, Refusal> {
        let names: Vec<&str> = grid.axes.iter().map(|axis| axis.name.as_str()).collect();
        if let Some(k) = (0..names.len()).find(|&k| names[..k].contains(&names[k])) {
            let message = format!("`--set {}=...` is given twice", names[k]);
            return Err(refusal(Diagnostic::error(errors::TWICE, message)));
        }
        let mut first = Vec::new();
        for number in 0..MODELS.min(grid.n_variants() as u64) {
            let Some(ran) = script.run_to_its_end(&grid, number, host) else {
                let message = "stopped before the first row";
                return Err(refusal(
                    Diagnostic::error(errors::INTERRUPTED, message).kind(Kind::Interrupted),
                ));
            };
            let has_failed = ran.variant.failure.is_some();
            first.push(ran.variant);
            // A run that fails says nothing of what comes after.
            if !has_failed {
                let undeclared = Undeclared::in_session(&ran.session);
                if let Some(problem) = undeclared.problems().next() {
                    return Err(refusal(problem));
                }
                break;
            }
        }
        let has_ended = |variant: &&Variant| variant.failure.is_none();
        let model = first.last().filter(has_ended).or(first.first());
        let columns = Columns::new(&grid, model);
        Ok(Self { script, grid, first, columns })
    }

    /// How many variants there are.
    pub fn n_variants(&self) -> u64 {
        self.grid.n_variants() as u64
    }

    /// The columns of its table: the same whoever runs which part.
    pub const fn columns(&self) -> &Columns {
        &self.columns
    }

    /// What it is run over.
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Runs a variant, unless it was run to begin with; none where the user stops it.
    pub fn variant(&self, number: u64, host: &mut dyn Host) -> Option<Cow<'_, Variant>> {
        if let Some(known) = self.first.get(usize::try_from(number).ok()?) {
            return Some(Cow::Borrowed(known));
        }
        let ran = self.script.run_to_its_end(&self.grid, number, host)?;
        Some(Cow::Owned(ran.variant))
    }

    /// A picture of the pose that a variant ends in.
    pub fn picture(&self, number: u64, options: &Options, host: &mut dyn Host) -> Option<String> {
        let ran = self.script.run_to_its_end(&self.grid, number, host)?;
        Some(ran.picture(options))
    }
}
