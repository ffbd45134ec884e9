//! `record ... of`: the columns of a table, and its rows.

use crate::diag::{Diagnostic, Span};
use crate::lang::ast::{Column, Unit};
use crate::session::execution::Execution;
use crate::session::parcel::unwritable;
use crate::session::resolve::unbind::Unbind;
use crate::session::state::State;
use crate::session::undo::recorder::{Recorder, TableColumn};
use crate::solve::Solver;
use crate::terms::Shape;
use crate::world::{Rates, Value};

impl Execution<'_> {
    /// The columns of a table.
    pub(super) fn table_columns(
        &mut self,
        columns: &[Column],
    ) -> Result<Vec<TableColumn>, Diagnostic> {
        columns.iter().map(|column| self.table_column(column)).collect()
    }

    fn table_column(&mut self, column: &Column) -> Result<TableColumn, Diagnostic> {
        let formula = self.resolve().live(&column.value)?.into_formula(&column.value);
        let words = Unbind::of(&self.state.world).unbind(&formula);
        let unit = match column.unit {
            Unit::None => String::new(),
            unit => format!(" in {}", unit.suffix()),
        };
        let headings = match formula.shape() {
            Shape::Number => vec![format!("{words}{unit}")],
            Shape::Vector => {
                let is_name = words.as_name().is_some();
                let of = if is_name { words.to_string() } else { format!("({words})") };
                vec![format!("{of}.x{unit}"), format!("{of}.y{unit}")]
            }
        };
        Ok(TableColumn { headings, formula, scale: column.unit.scale() })
    }

    /// Adds the row of now to a table with columns of its own.
    pub(super) fn take_row(
        &mut self,
        recorder: &mut Recorder,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let row = self.state.row(&recorder.columns)?;
        let time = self.state.world.clock().time();
        recorder.take_row(time, &row).map_err(|e| unwritable(&recorder.path, span, &e))
    }

    /// Adds the row of now to each table with columns of its own for which it is due.
    pub(super) fn take_rows(&mut self, span: Span) -> Result<(), Diagnostic> {
        let frame = self.state.world.clock().frame;
        for k in 0..self.state.recorders.len() {
            let recorder = &self.state.recorders[k];
            if recorder.columns.is_empty() || !recorder.is_due(frame) {
                continue;
            }
            let columns = recorder.columns.clone();
            let row = self.state.row(&columns).map_err(|why| self.in_frame(why))?;
            let time = self.state.world.clock().time();
            let recorder = &mut self.state.recorders[k];
            recorder.take_row(time, &row).map_err(|e| unwritable(&recorder.path, span, &e))?;
        }
        Ok(())
    }
}

impl State {
    /// The values of columns now; of what mentions a thing that was deleted there is none.
    fn row(&mut self, columns: &[TableColumn]) -> Result<Vec<f64>, Diagnostic> {
        let mut rates: Option<Rates> = None;
        let mut row = Vec::new();
        for TableColumn { headings, formula, scale } in columns {
            if !self.world.has_all(formula) {
                row.extend(headings.iter().map(|_| f64::NAN));
                continue;
            }
            if rates.is_none() && self.world.depends(formula).on_rates {
                rates = Some(self.look(Solver::rates)?);
            }
            match self.world.evaluate(formula, rates.as_ref())? {
                Value::Number(n) => row.push(n / scale),
                Value::Vector(v) => row.extend([v.x / scale, v.y / scale]),
            }
        }
        Ok(row)
    }
}
