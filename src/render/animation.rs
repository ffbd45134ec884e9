//! One picture that moves, made from the scenes of a motion.

use super::animation_tracks::FigureTracks;
use super::canvas::{Canvas, Lettering};
use super::document::{self, Group, Options};
use super::figure::Figure;
use super::keyframes::{Keyframes, visibility};
use super::scene::{DrawnPose, Scene};
use super::trace::Curve;
use super::view::View;
use super::{legend, trace_animation};
use crate::interrupt::tick;
use std::sync::Arc;

/// A picture holds at most so many frames times symbols: some ten megabytes. Beyond it frames
/// are left out evenly, and straight lines lead over the gaps.
const MOST_POSES: usize = 300_000;
/// Whether a picture shows frame `k` of `n` with so many symbols at most, or leaves it out.
pub fn is_shown(k: usize, n: usize, n_symbols: usize) -> bool {
    let stride = (n * n_symbols).div_ceil(MOST_POSES).max(1);
    k.is_multiple_of(stride) || k + 1 == n
}

/// What a look whether two things are the same takes, in ticks.
const LOOK: usize = 20;

/// The shortest motion shown, seconds: a shorter one is a flicker.
const SHORTEST: f64 = 1.0;
/// The longest motion shown, seconds: more than a minute nobody watches.
const LONGEST: f64 = 60.0;

/// How long a motion of so much simulated time is shown, seconds.
pub fn shown_for(span: f64) -> f64 {
    span.clamp(SHORTEST, LONGEST)
}

/// A picture that moves, frame by frame.
///
/// It plays in any browser, without an end and without a script, and shows its first frame
/// where nothing moves. A time unit is shown as a second, unless the whole would be too short
/// or too long to watch. Paths lie there lightly and are drawn over as the mechanism moves.
#[derive(Debug, Clone)]
pub struct Animation {
    view: View,
    options: Options,
    frames: Vec<(Scene, f64)>,
}

impl Animation {
    /// A picture without frames.
    pub fn new(view: View, options: &Options) -> Self {
        let view = if options.without_names { view.without_names() } else { view };
        Self { view, options: options.clone(), frames: Vec::new() }
    }

    /// Adds a scene at a time.
    pub fn push(&mut self, scene: &Scene, time: f64) {
        self.frames.push((scene.clone(), time));
    }

    /// The picture as an SVG document.
    pub fn finish(mut self) -> String {
        self.leave_out();
        let times = self.times();
        let mut groups = self.ghosts(&times);
        let mut tracks = FigureTracks::default();
        for (scene, _) in &self.frames {
            tracks.add(self.view.figures(&scene.pose));
        }
        let mut figures = tracks.finish(&times, self.duration());
        figures.extend(self.paths(&times));
        figures.extend(self.legend());
        figures.sort_by_key(|(figure, _)| figure.order());
        groups.push(Group { figures, ..Group::of(Vec::new()) });
        document::write(self.view.page(), &groups, &self.options)
    }

    /// Leaves out as many frames as it takes.
    fn leave_out(&mut self) {
        let n_symbols = self.frames.iter().map(|(scene, _)| scene.n_symbols()).max();
        let n = self.frames.len();
        let mut k = 0;
        self.frames.retain(|_| {
            let is_kept = is_shown(k, n, n_symbols.unwrap_or(0));
            k += 1;
            is_kept
        });
    }

    /// Simulated time from the first to the last frame.
    fn span(&self) -> f64 {
        match &self.frames[..] {
            [(_, first), .., (_, last)] => last - first,
            _ => 0.0,
        }
    }

    /// How long the motion is shown, seconds.
    fn duration(&self) -> f64 {
        shown_for(self.span())
    }

    /// When each frame is shown, from 0 to 1.
    fn times(&self) -> Vec<f64> {
        let span = self.span();
        let is_forward = self.frames.windows(2).all(|pair| pair[0].1 < pair[1].1);
        let n_steps = self.frames.len().max(2) - 1;
        let time = |(k, (_, time)): (usize, &(Scene, f64))| {
            // A clock that was set back gives no order; frames do.
            if is_forward && span > 0.0 {
                (time - self.frames[0].1) / span
            } else {
                k as f64 / n_steps as f64
            }
        };
        self.frames.iter().enumerate().map(time).collect()
    }

    /// Every ghost of any frame, while it is there.
    fn ghosts(&self, times: &[f64]) -> Vec<Group> {
        let mut all: Vec<Arc<DrawnPose>> = Vec::new();
        let mut is_there: Vec<Vec<bool>> = Vec::new();
        for (frame, (scene, _)) in self.frames.iter().enumerate() {
            for ghost in &scene.ghosts {
                tick(LOOK * all.len());
                let is_same = |other: &Arc<DrawnPose>| Arc::ptr_eq(other, ghost) || other == ghost;
                let k = all.iter().position(is_same).unwrap_or_else(|| {
                    all.push(ghost.clone());
                    is_there.push(vec![false; times.len()]);
                    all.len() - 1
                });
                is_there[k][frame] = true;
            }
        }
        let mut groups = self.view.ghosts(all.iter().map(|ghost| &**ghost));
        for (group, is_there) in groups.iter_mut().zip(&is_there) {
            let track = visibility(times, is_there);
            let duration = self.duration();
            group.motion = track.map(|track| Keyframes { duration, tracks: vec![track] });
        }
        groups
    }

    /// Every path of any frame, as far as it came.
    fn paths(&self, times: &[f64]) -> Vec<(Figure, Option<Keyframes>)> {
        let mut all: Vec<(Curve, Vec<usize>)> = Vec::new();
        for (frame, (scene, _)) in self.frames.iter().enumerate() {
            for curve in &scene.curves {
                tick(LOOK * all.len());
                let is_same = |(other, _): &(Curve, _)| other.is_continued_by(curve);
                let k = all.iter().position(is_same).unwrap_or_else(|| {
                    all.push((curve.clone(), vec![0; times.len()]));
                    all.len() - 1
                });
                all[k].0 = curve.clone();
                all[k].1[frame] = curve.samples.len();
            }
        }
        let follow = |(curve, n_samples): &(Curve, Vec<usize>)| {
            trace_animation::follow(curve, self.view.page(), n_samples, times, self.duration())
        };
        all.iter().flat_map(follow).collect()
    }

    fn legend(&self) -> Vec<(Figure, Option<Keyframes>)> {
        let none = Lettering::new();
        let mut canvas = Canvas::new(self.view.page(), &[], &none);
        let curves = self.frames.last().map_or(&[][..], |(scene, _)| &scene.curves);
        legend::draw(&mut canvas, curves);
        canvas.finish().into_iter().map(|figure| (figure, None)).collect()
    }
}
