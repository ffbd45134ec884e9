//! A path that was recorded: which point was to be where in which frame.

use crate::constraint::Point;
use crate::diag::{Diagnostic, Span, format_number};
use crate::errors;
use crate::world::{Entity, PointId, World};

/// The path of a point.
pub struct Curve {
    /// Whose path.
    pub point: PointId,
    /// Frames from now on, each with the place of the point at its end; that of now is 0.
    pub places: Vec<(usize, Point)>,
}

/// Times that are nearer to a frame than this part of it are that frame's.
const SAME: f64 = 1e-6;

/// Reads a table as `record` writes it: the point is that of the first columns `P.x`, `P.y` of which
/// the world has one. Without times the rows are the frames, the first that of now.
///
/// # Errors
/// Where it is no such table.
pub fn read_curve(world: &World, text: &str, span: Span) -> Result<Curve, Diagnostic> {
    let wrong = |what: String| {
        Diagnostic::error(errors::NOT_A_PATH, "this is no path of a point")
            .at(span, what)
            .help("`record \"curve.csv\" of time, C` writes one")
    };
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let heading: Vec<&str> = lines.next().unwrap_or_default().split(',').map(str::trim).collect();
    let place_of = |name: &str| heading.iter().position(|word| *word == name);
    let point = heading.iter().find_map(|word| {
        let name = word.strip_suffix(".x")?;
        match world.names().get(name)? {
            Entity::Point(id) => Some((id, place_of(word)?, place_of(&format!("{name}.y"))?)),
            _ => None,
        }
    });
    let Some((point, x, y)) = point else {
        return Err(wrong("no columns `P.x` and `P.y` of a point that is here".to_owned()));
    };
    let (time, clock) = (place_of("time"), world.clock());
    let mut places = Vec::new();
    for (k, line) in lines.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| {
            let found = cells.get(column).and_then(|cell| cell.trim().parse::<f64>().ok());
            found.filter(|n| n.is_finite()).ok_or_else(|| {
                wrong(format!("row {} has no number under `{}`", k + 1, heading[column]))
            })
        };
        let frame = match time {
            None => k as f64,
            Some(column) => (number(column)? - clock.time()) / clock.dt,
        };
        let at = Point::new(number(x)?, number(y)?);
        if frame < -SAME {
            continue;
        }
        if (frame - frame.round()).abs() > SAME {
            let dt = format_number(clock.dt);
            return Err(wrong(format!("row {} is between two frames of dt {dt}", k + 1)));
        }
        places.push((frame.round() as usize, at));
    }
    if places.is_empty() {
        return Err(wrong("it has no row from now on".to_owned()));
    }
    Ok(Curve { point, places })
}
