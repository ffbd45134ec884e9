//! A recording: a mechanism frame by frame, shown as a sequence of stills or as one picture
//! that moves.

use std::rc::Rc;

use super::animation::{Cast, duration, visibility};
use super::curve::Curve;
use super::document::{self, Group};
use super::figure::Figure;
use super::ink::{Ink, Lettering};
use super::motion::Motion;
use super::pen;
use super::scene::{Pose, Scene};
use super::stage::{Options, Stage};
use super::strip;
use crate::constraint::PointIdx;
use crate::world::{Sample, World};

/// A moving picture holds at most so many frames times parts: some ten megabytes. Beyond it
/// frames are left out evenly, and straight lines lead over the gaps.
const MOST_POSES: usize = 300_000;
/// Names are placed to suit so many frames of the whole.
const N_PROBES: usize = 16;

/// Frames of a mechanism in motion.
#[derive(Debug, Clone, Default)]
pub struct Recording {
    frames: Vec<Frame>,
    paths: Vec<RecordedPath>,
    ghosts: Vec<Pose>,
}

#[derive(Debug, Clone)]
struct Frame {
    time: f64,
    pose: Pose,
    /// Which paths there were, and how many of their samples.
    paths: Rc<[(usize, usize)]>,
    /// Which ghosts there were.
    ghosts: Rc<[usize]>,
}

/// A path as far as it grew before it was cut short or taken away.
#[derive(Debug, Clone)]
struct RecordedPath {
    idx: usize,
    point: PointIdx,
    name: Rc<str>,
    samples: Vec<Sample>,
}

impl Recording {
    /// A recording without frames.
    pub fn new() -> Self {
        Self::default()
    }

    /// How many frames it has.
    pub fn n_frames(&self) -> usize {
        self.frames.len()
    }

    /// Adds a world as it stands as one more frame.
    pub fn push(&mut self, world: &World) {
        let mut pose = Pose::of(world);
        // Most often only positions differ from the frame before.
        if let Some(last) = self.frames.last()
            && last.pose.parts == pose.parts
        {
            pose.parts = last.pose.parts.clone();
        }
        let paths = self.follow_paths(world);
        let ghosts = self.follow_ghosts(world, &pose);
        self.frames.push(Frame { time: world.clock().time(), pose, paths, ghosts });
    }

    fn follow_paths(&mut self, world: &World) -> Rc<[(usize, usize)]> {
        let mut present = Vec::new();
        for (idx, trace) in world.traces().iter().enumerate() {
            let is_grown = |path: &RecordedPath| {
                let n = path.samples.len();
                path.idx == idx
                    && path.point == trace.point.0
                    && n <= trace.samples.len()
                    && (n == 0 || path.samples[n - 1] == trace.samples[n - 1])
            };
            let k = self.paths.iter().rposition(is_grown).unwrap_or_else(|| {
                let name = world.points().name(trace.point).into();
                let samples = Vec::new();
                self.paths.push(RecordedPath { idx, point: trace.point.0, name, samples });
                self.paths.len() - 1
            });
            let path = &mut self.paths[k];
            path.samples.extend_from_slice(&trace.samples[path.samples.len()..]);
            present.push((k, path.samples.len()));
        }
        present.into()
    }

    fn follow_ghosts(&mut self, world: &World, pose: &Pose) -> Rc<[usize]> {
        let before = self.frames.last().map_or_else(|| Rc::from([]), |f| f.ghosts.clone());
        let ghosts = world.ghosts();
        if ghosts.len() == before.len() {
            return before;
        }
        let mut present: Vec<usize> = before.iter().copied().take(ghosts.len()).collect();
        for ghost in &ghosts[present.len()..] {
            present.push(self.ghosts.len());
            self.ghosts.push(pose.exposed(ghost));
        }
        present.into()
    }

    /// One picture a frame, all of one part of the plane, in order of time.
    pub fn stills(&self, options: &Options) -> impl Iterator<Item = String> {
        let stage = self.stage();
        let options = options.clone();
        (0..self.frames.len()).map(move |k| stage.svg(&self.scene(k), &options))
    }

    /// One picture that moves, without an end, in any browser and without a script; the
    /// first frame where nothing moves. Empty where nothing was recorded.
    ///
    /// A time unit is shown as a second, unless the whole would be too short or too long to
    /// watch. Paths lie there lightly and are drawn over as the mechanism moves.
    pub fn animated(&self, options: &Options) -> String {
        let stage = self.stage();
        let frames = self.shown();
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else {
            return document::write(&stage.view, &[], options);
        };
        let span = last.time - first.time;
        let duration = duration(span);
        let n = frames.len();
        let time_of = |(k, frame): (usize, &&Frame)| {
            if span > 0.0 { (frame.time - first.time) / span } else { k as f64 / n as f64 }
        };
        let times: Vec<f64> = frames.iter().enumerate().map(time_of).collect();
        // A clock that was set back has no one order of time; then frames are evenly spaced.
        let is_forward = times.windows(2).all(|pair| pair[0] < pair[1]);
        let even = (0..n).map(|k| k as f64 / (n.max(2) - 1) as f64).collect();
        let times: Vec<f64> = if is_forward { times } else { even };

        let mut groups = self.moving_ghosts(&stage, &frames, &times, duration);
        let mut cast = Cast::default();
        for frame in &frames {
            cast.add(stage.figures(&frame.pose));
        }
        let mut figures = cast.finish(&times, duration);
        figures.extend(self.moving_paths(&stage, &frames, &times, duration));
        figures.sort_by_key(|(figure, _)| figure.order());
        groups.push(Group { figures, ..Group::of(Vec::new()) });
        document::write(&stage.view, &groups, options)
    }

    /// The frames a moving picture is made of.
    fn shown(&self) -> Vec<&Frame> {
        let n_parts = self.frames.iter().map(|frame| frame.pose.parts.len()).max().unwrap_or(0);
        let stride = (self.frames.len() * n_parts).div_ceil(MOST_POSES).max(1);
        let last = self.frames.len().saturating_sub(1);
        let is_shown = |k: &usize| k.is_multiple_of(stride) || *k == last;
        (0..self.frames.len()).filter(is_shown).map(|k| &self.frames[k]).collect()
    }

    fn scene(&self, k: usize) -> Scene {
        let frame = &self.frames[k];
        let ghosts = frame.ghosts.iter().map(|&g| self.ghosts[g].clone()).collect();
        let curves = frame.paths.iter().map(|&(p, n)| self.paths[p].curve(n)).collect();
        Scene { pose: frame.pose.clone(), ghosts, curves }
    }

    fn stage(&self) -> Stage {
        let bare = |frame: &Frame| Scene {
            pose: frame.pose.clone(),
            ghosts: Vec::new(),
            curves: Vec::new(),
        };
        let last = self.frames.len().saturating_sub(1);
        let probes: Vec<Scene> = (0..N_PROBES.min(self.frames.len()))
            .map(|k| k * last / (N_PROBES - 1).min(last.max(1)))
            .map(|k| self.scene(k))
            .collect();
        let all: Vec<Scene> = self.frames.iter().map(bare).collect();
        let whole = Scene {
            ghosts: self.ghosts.clone(),
            curves: self.paths.iter().map(|path| path.curve(path.samples.len())).collect(),
            ..probes.last().cloned().unwrap_or_else(|| Scene::of(&World::new()))
        };
        let shown: Vec<&Scene> = all.iter().chain([&whole]).collect();
        Stage::over(&shown, &probes.iter().collect::<Vec<_>>())
    }

    fn moving_ghosts(
        &self,
        stage: &Stage,
        frames: &[&Frame],
        times: &[f64],
        duration: f64,
    ) -> Vec<Group> {
        let mut groups = stage.ghosts(&self.ghosts);
        for (k, group) in groups.iter_mut().enumerate() {
            let is_there: Vec<bool> = frames.iter().map(|f| f.ghosts.contains(&k)).collect();
            let track = visibility(times, &is_there);
            group.motion = track.map(|track| Motion { duration, tracks: vec![track] });
        }
        groups
    }

    /// The paths, each drawn as the mechanism moves, and the strip.
    fn moving_paths(
        &self,
        stage: &Stage,
        frames: &[&Frame],
        times: &[f64],
        duration: f64,
    ) -> Vec<(Figure, Option<Motion>)> {
        let mut figures = Vec::new();
        for (k, path) in self.paths.iter().enumerate() {
            let curve = path.curve(path.samples.len());
            let n_samples: Vec<usize> = frames.iter().map(|frame| frame.n_samples(k)).collect();
            figures.extend(pen::follow(&curve, &stage.view, &n_samples, times, duration));
        }
        let last = frames.last().map_or(&[][..], |frame| &frame.paths);
        let curves: Vec<Curve> = last.iter().map(|&(p, n)| self.paths[p].curve(n)).collect();
        let none = Lettering::new();
        let mut ink = Ink::new(&stage.view, &[], &none);
        strip::draw(&mut ink, &curves);
        figures.extend(ink.finish().into_iter().map(|figure| (figure, None)));
        figures
    }
}

impl Frame {
    /// How many samples of a path there were.
    fn n_samples(&self, path: usize) -> usize {
        self.paths.iter().find(|(p, _)| *p == path).map_or(0, |(_, n)| *n)
    }
}

impl RecordedPath {
    /// Its first `n` samples.
    fn curve(&self, n: usize) -> Curve {
        Curve { idx: self.idx, name: self.name.clone(), samples: self.samples[..n].into() }
    }
}
