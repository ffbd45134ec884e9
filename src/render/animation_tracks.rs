//! The tracks of a moving picture: follows each figure from frame to frame.

use std::collections::BTreeMap;

use super::figure::{Figure, FigureShape, Key, Layer, Outline, Placement};
use super::keyframes::{AnimatedAttribute, AttributeTrack, Keyframes, track, visibility};
use crate::diag::push_decimals;
use crate::interrupt::tick;

/// How far anything may be drawn from where it is, px: less than can be seen in motion.
const TOLERANCE: f64 = 0.06;
/// Digits after the point of px and of degrees.
const PLACES: usize = 2;
/// What following a figure takes, in ticks.
const FIGURE: usize = 200;

/// Who a figure is, from frame to frame: one that changes its make is another figure.
type Identity = (Layer, Key, u16, usize);

/// A figure and how it looked in each frame.
#[derive(Debug)]
struct TrackedFigure {
    figure: Figure,
    /// By frame: where it was, none where it was not there.
    placements: Vec<Option<Placement>>,
    /// By frame and shape: its numbers, where they are not those of `figure`.
    forms: BTreeMap<usize, Vec<Vec<f64>>>,
}

/// All figures of a recording, as they come.
#[derive(Debug, Default)]
pub struct FigureTracks {
    figures: BTreeMap<Identity, TrackedFigure>,
    n_frames: usize,
}

impl FigureTracks {
    /// Adds the figures of one more frame.
    pub fn add(&mut self, figures: Vec<Figure>) {
        let frame = self.n_frames;
        for figure in figures {
            tick(FIGURE);
            let (layer, key, part) = figure.order();
            let mut make = 0;
            while let Some(tracked) = self.figures.get(&(layer, key, part, make))
                && !is_like(&tracked.figure, &figure)
            {
                make += 1;
            }
            let tracked =
                self.figures.entry((layer, key, part, make)).or_insert_with(|| TrackedFigure {
                    figure: figure.clone(),
                    placements: Vec::new(),
                    forms: BTreeMap::new(),
                });
            tracked.placements.resize(frame, None);
            tracked.placements.push(Some(figure.placement));
            if !is_near(&tracked.figure.shapes, &figure.shapes) {
                let numbers = figure.shapes.iter().map(|shape| shape.outline.numbers());
                tracked.forms.insert(frame, numbers.collect());
            }
        }
        self.n_frames += 1;
    }

    /// The figures from the bottom up, each with its motion; `times` from 0 to 1, one a frame.
    pub fn finish(self, times: &[f64], duration: f64) -> Vec<(Figure, Option<Keyframes>)> {
        let moving = |mut tracked: TrackedFigure| {
            tracked.placements.resize(times.len(), None);
            let tracks = tracked.tracks(times);
            (tracked.figure, (!tracks.is_empty()).then_some(Keyframes { duration, tracks }))
        };
        self.figures.into_values().map(moving).collect()
    }
}

/// Whether two figures differ in numbers only.
fn is_like(a: &Figure, b: &Figure) -> bool {
    a.is_off == b.is_off
        && a.shapes.len() == b.shapes.len()
        && a.shapes
            .iter()
            .zip(&b.shapes)
            .all(|(s, t)| s.class == t.class && s.outline.is_like(&t.outline))
}

/// Whether two figures of one make look the same in their own coordinates.
fn is_near(a: &[FigureShape], b: &[FigureShape]) -> bool {
    a.iter().zip(b).all(|(s, t)| {
        let (p, q) = (s.outline.numbers(), t.outline.numbers());
        p.iter().zip(&q).all(|(x, y)| (x - y).abs() <= TOLERANCE)
    })
}

impl TrackedFigure {
    fn tracks(&self, times: &[f64]) -> Vec<AttributeTrack> {
        let mut tracks = Vec::new();
        tracks.extend(visibility(
            times,
            &self.placements.iter().map(Option::is_some).collect::<Vec<_>>(),
        ));
        let placements = self.placements_throughout();
        let places: Vec<f64> = placements.iter().flat_map(|p| [p.at.x, p.at.y]).collect();
        let place = track(AnimatedAttribute::Place, times, &places, 2, TOLERANCE, numbers);

        let reach = self.figure.reach();
        let mut turns: Vec<f64> = placements.iter().map(|p| p.turn).collect();
        unwind(&mut turns);
        // A turn moves the far end of the figure.
        let tolerance = libm::atan2(TOLERANCE, reach).to_degrees();
        let mut turn = track(AnimatedAttribute::Turn, times, &turns, 1, tolerance, numbers);
        if turn.is_none() && turns[0] != 0.0 && place.is_some() {
            // A moving place stands for the whole transform: the turn has to be said again.
            let value = numbers(&turns[..1]);
            turn = Some(AttributeTrack {
                change: AnimatedAttribute::Turn,
                times: Vec::new(),
                values: vec![value.clone(), value],
            });
        }
        // On top of a place that does not move, the first turn is there already.
        if place.is_none()
            && let Some(turn) = &mut turn
        {
            let first = self.figure.placement.turn;
            for value in &mut turn.values {
                let by = value.parse::<f64>().expect("a number we wrote") - first;
                *value = numbers(&[by]);
            }
        }
        tracks.extend(place);
        tracks.extend(turn);
        tracks.extend(self.shape_tracks(times));
        tracks
    }

    /// Where it was in each frame; while it is away, where it was last or will be first.
    fn placements_throughout(&self) -> Vec<Placement> {
        let mut last = self.figure.placement;
        let throughout = self.placements.iter().map(|placement| {
            last = placement.unwrap_or(last);
            last
        });
        throughout.collect()
    }

    fn shape_tracks(&self, times: &[f64]) -> Vec<AttributeTrack> {
        let mut tracks = Vec::new();
        if self.forms.is_empty() {
            return tracks;
        }
        for (k, shape) in self.figure.shapes.iter().enumerate() {
            let own = shape.outline.numbers();
            let n = own.len();
            let by_frame = |frame| self.forms.get(&frame).map_or(&own[..], |form| &form[k]);
            let rows: Vec<f64> =
                (0..times.len()).flat_map(|frame| by_frame(frame).to_vec()).collect();
            match &shape.outline {
                Outline::Path(path) | Outline::GrowingPath { path, .. } => {
                    let write = |row: &[f64]| path.write(row, PLACES);
                    tracks.extend(track(
                        AnimatedAttribute::Shape(k, "d"),
                        times,
                        &rows,
                        n,
                        TOLERANCE,
                        write,
                    ));
                }
                Outline::Circle { .. } => {
                    tracks.extend(columns(k, ["cx", "cy", "r"], times, &rows));
                }
                Outline::Text { .. } => tracks.extend(columns(k, ["x", "y"], times, &rows)),
            }
        }
        tracks
    }
}

/// A track for each attribute of a shape that is one number.
fn columns<const N: usize>(
    shape: usize,
    attributes: [&'static str; N],
    times: &[f64],
    rows: &[f64],
) -> impl Iterator<Item = AttributeTrack> {
    attributes.into_iter().enumerate().filter_map(move |(i, attribute)| {
        let column: Vec<f64> = rows.iter().skip(i).step_by(N).copied().collect();
        track(AnimatedAttribute::Shape(shape, attribute), times, &column, 1, TOLERANCE, numbers)
    })
}

/// Replaces angles by equal ones such that none is more than half a turn from the one before.
fn unwind(degrees: &mut [f64]) {
    for k in 1..degrees.len() {
        let by = degrees[k] - degrees[k - 1];
        degrees[k] -= 360.0 * (by / 360.0).round();
    }
}

fn numbers(row: &[f64]) -> String {
    let mut text = String::new();
    for (k, &value) in row.iter().enumerate() {
        if k > 0 {
            text.push(' ');
        }
        push_decimals(&mut text, value, PLACES);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_go_on_through_whole_turns() {
        let mut degrees = [170.0, -170.0, -150.0, 160.0, 80.0];
        unwind(&mut degrees);
        assert_eq!(degrees, [170.0, 190.0, 210.0, 160.0, 80.0]);
    }
}
