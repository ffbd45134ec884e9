//! A path that was recorded: which point was to be where in which frame.

use std::borrow::Cow;

use super::csv;
use crate::constraint::Point;
use crate::diag::{Diagnostic, Span, format_number};
use crate::errors;
use crate::terms::Unit;
use crate::world::{Clock, Entity, PointId, World};

/// The path of a point.
pub struct Curve {
    /// Whose path.
    pub point: PointId,
    /// Frames from now on, each with the place of the point at its end; that of now is 0.
    pub places: Vec<(u64, Point)>,
}

/// Times that are nearer to a frame than this part of it are that frame's.
const SAME: f64 = 1e-6;

/// What writes a table that can be read here.
pub const WRITES_ONE: &str = "`record \"curve.csv\" of time, C` writes one";

/// A column of numbers, and what one of them is multiplied by.
struct Column {
    at: usize,
    scale: f64,
}

/// A table of which nothing is known but what stands over its columns.
struct Table<'a> {
    heading: Vec<Cow<'a, str>>,
    span: Span,
}

impl Table<'_> {
    fn wrong(&self, what: String) -> Diagnostic {
        Diagnostic::error(errors::NOT_A_PATH, "this is no path of a point")
            .at(self.span, what)
            .help(WRITES_ONE)
    }

    /// The column over which this stands, alone or with a unit: `time in ms`.
    fn column(&self, words: &str) -> Result<Option<Column>, Diagnostic> {
        for (at, heading) in self.heading.iter().enumerate() {
            let Some(behind) = heading.strip_prefix(words) else { continue };
            if behind.is_empty() {
                return Ok(Some(Column { at, scale: 1.0 }));
            }
            let Some(suffix) = behind.strip_prefix(" in ") else { continue };
            let unit = Unit::ALL.into_iter().find(|unit| unit.suffix() == suffix);
            let unit =
                unit.ok_or_else(|| self.wrong(format!("`{heading}`: no unit `{suffix}`")))?;
            return Ok(Some(Column { at, scale: unit.scale() }));
        }
        Ok(None)
    }

    /// The first point of the world whose places are here.
    fn point(&self, world: &World) -> Result<Option<(PointId, [Column; 2])>, Diagnostic> {
        for heading in &self.heading {
            let words = heading.split_once(" in ").map_or(&**heading, |(words, _)| words);
            let Some(name) = words.strip_suffix(".x") else { continue };
            let Some(Entity::Point(id)) = world.names().get(name) else { continue };
            let [x, y] = ["x", "y"].map(|side| self.column(&format!("{name}.{side}")));
            if let (Some(x), Some(y)) = (x?, y?) {
                return Ok(Some((id, [x, y])));
            }
        }
        Ok(None)
    }

    /// The number of a row in a column; rows count from 1.
    fn number(&self, row: &[Cow<str>], k: usize, column: &Column) -> Result<f64, Diagnostic> {
        let found = row.get(column.at).and_then(|cell| cell.parse::<f64>().ok());
        let found = found.map(|n| n * column.scale).filter(|n| n.is_finite());
        found.ok_or_else(|| {
            self.wrong(format!("row {k} has no number under `{}`", self.heading[column.at]))
        })
    }

    /// The frame that ends at a time, counted from now on; none of those before.
    fn frame(&self, time: f64, k: usize, clock: &Clock) -> Result<Option<u64>, Diagnostic> {
        let frame = (time - clock.time()) / clock.dt;
        if frame < -SAME {
            return Ok(None);
        }
        if (frame - frame.round()).abs() > SAME {
            let dt = format_number(clock.dt);
            return Err(self.wrong(format!("row {k} is between two frames of dt {dt}")));
        }
        Ok(Some(frame.round() as u64))
    }
}

/// Reads a table as `record` writes it: the point is that of the first columns `P.x`, `P.y` of which
/// the world has one. Without times the rows are the frames, the first that of now.
///
/// # Errors
/// Where it is no such table.
pub fn read_curve(world: &World, text: &str, span: Span) -> Result<Curve, Diagnostic> {
    let mut rows = csv::rows(text);
    let table = Table { heading: rows.next().unwrap_or_default(), span };
    let Some((point, [x, y])) = table.point(world)? else {
        return Err(table.wrong("no columns `P.x` and `P.y` of a point that is here".to_owned()));
    };
    let time = table.column("time")?;
    let mut places = Vec::new();
    for (k, row) in (1..).zip(rows) {
        let frame = match &time {
            None => Some(k as u64 - 1),
            Some(column) => table.frame(table.number(&row, k, column)?, k, world.clock())?,
        };
        let at = Point::new(table.number(&row, k, &x)?, table.number(&row, k, &y)?);
        places.extend(frame.map(|frame| (frame, at)));
    }
    if places.is_empty() {
        return Err(table.wrong("it has no row from now on".to_owned()));
    }
    Ok(Curve { point, places })
}
