//! The stage: what all pictures of one mechanism in motion share, so that they can be laid
//! one on the other.

use super::document::{self, Group};
use super::figure::Figure;
use super::ink::{Ink, Lettering};
use super::lettering;
use super::scene::{Pose, Scene};
use super::strip;
use super::view::{Extent, View};

/// What a picture says besides the drawing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Options {
    /// The title of the document.
    pub title: Option<String>,
    /// What made it and from what: keys and values, kept in the document and not drawn.
    pub receipt: Vec<(String, String)>,
}

/// A part of the plane, and where on it each name stands.
#[derive(Debug, Clone)]
pub struct Stage {
    pub(super) view: View,
    lettering: Lettering,
}

impl Stage {
    /// The stage that shows all of these scenes.
    pub fn of(scenes: &[&Scene]) -> Self {
        Self::over(scenes, scenes)
    }

    /// The stage that shows all of `scenes`, its names placed to suit those in `probes`.
    pub(super) fn over(scenes: &[&Scene], probes: &[&Scene]) -> Self {
        let mut extent = Extent::default();
        scenes.iter().for_each(|scene| scene.extend(&mut extent));
        let bars = scenes.first().map_or(0.0, |scene| typical(&scene.pose));
        let view = View::fit(&extent);
        let view = if bars > 0.0 { view.with_bars(bars) } else { view };
        Self { view, lettering: lettering::place(probes, &view) }
    }

    /// A scene on this stage as an SVG document.
    pub fn svg(&self, scene: &Scene, options: &Options) -> String {
        let mut groups = self.ghosts(&scene.ghosts);
        let mut ink = Ink::new(&self.view, &scene.pose.at, &self.lettering);
        scene.pose.parts.iter().for_each(|part| part.draw(&mut ink));
        for curve in &scene.curves {
            curve.draw(&mut ink);
        }
        strip::draw(&mut ink, &scene.curves);
        groups.push(Group::of(ink.finish()));
        document::write(&self.view, &groups, options)
    }

    /// A pose as figures.
    pub(super) fn figures(&self, pose: &Pose) -> Vec<Figure> {
        let mut ink = Ink::new(&self.view, &pose.at, &self.lettering);
        pose.parts.iter().for_each(|part| part.draw(&mut ink));
        ink.finish()
    }

    /// Poses of the past, the fainter the older.
    pub(super) fn ghosts(&self, ghosts: &[Pose]) -> Vec<Group> {
        const OLDEST: f64 = 0.12;
        const NEWEST: f64 = 0.4;
        let none = Lettering::new();
        let n = ghosts.len();
        let group = |(k, ghost): (usize, &Pose)| {
            let mut ink = Ink::new(&self.view, &ghost.at, &none);
            ghost.parts.iter().for_each(|part| part.draw(&mut ink));
            let age = (k + 1) as f64 / n as f64;
            let opacity = OLDEST + (NEWEST - OLDEST) * age;
            let figures = ink.finish().into_iter().filter(Figure::is_solid).collect();
            Group { opacity, ..Group::of(figures) }
        };
        ghosts.iter().enumerate().map(group).collect()
    }
}

/// The length of a bar that a quarter of all bars fall short of; 0 if there is none.
fn typical(pose: &Pose) -> f64 {
    let mut lengths: Vec<f64> = pose.bar_lengths().collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 4).copied().unwrap_or(0.0)
}
