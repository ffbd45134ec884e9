//! A view: what all pictures of one mechanism in motion share, so that they can be laid one
//! on the other.

use super::canvas::{Ink, Lettering};
use super::document::{self, Group};
use super::figure::Figure;
use super::legend;
use super::lettering;
use super::page::{Extent, Page};
use super::scene::{Pose, Scene};

/// Names are placed to suit so many scenes of a motion.
const N_PROBES: usize = 16;

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
pub struct View {
    page: Page,
    lettering: Lettering,
}

impl View {
    /// The view that shows all of these scenes.
    pub fn of<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> Self {
        let scenes: Vec<&Scene> = scenes.into_iter().collect();
        let mut extent = Extent::default();
        for (k, scene) in scenes.iter().enumerate() {
            scene.pose.extend(&mut extent);
            scene.extend_by_past(scenes.get(k + 1).copied(), &mut extent);
        }
        let bars = scenes.first().map_or(0.0, |scene| typical_bar(&scene.pose));
        let page = Page::fit(&extent);
        let page = if bars > 0.0 { page.with_bars(bars) } else { page };
        let n_probes = scenes.len().min(N_PROBES);
        let probe = |k: usize| scenes[k * (scenes.len() - 1) / (n_probes - 1).max(1)];
        let probes: Vec<&Scene> = (0..n_probes).map(probe).collect();
        Self { page, lettering: lettering::place(&probes, &page) }
    }

    pub(super) const fn page(&self) -> &Page {
        &self.page
    }

    /// A pose as figures.
    pub(super) fn figures(&self, pose: &Pose) -> Vec<Figure> {
        let mut ink = Ink::new(&self.page, &pose.at, &self.lettering);
        pose.parts.iter().for_each(|part| part.draw(&mut ink));
        ink.finish()
    }

    /// Poses of the past, the fainter the older.
    pub(super) fn ghosts<'a>(&self, ghosts: impl ExactSizeIterator<Item = &'a Pose>) -> Vec<Group> {
        const OLDEST: f64 = 0.14;
        const NEWEST: f64 = 0.45;
        let none = Lettering::new();
        let n = ghosts.len();
        let group = |(k, ghost): (usize, &Pose)| {
            let mut ink = Ink::new(&self.page, &ghost.at, &none);
            ghost.parts.iter().for_each(|part| part.draw(&mut ink));
            let age = (k + 1) as f64 / n as f64;
            let figures = ink.finish().into_iter().filter(Figure::is_solid).collect();
            Group { opacity: OLDEST + (NEWEST - OLDEST) * age, ..Group::of(figures) }
        };
        ghosts.enumerate().map(group).collect()
    }
}

/// A scene as an SVG document, fitted to the page.
pub fn svg(scene: &Scene, options: &Options) -> String {
    svg_with_view(scene, &View::of([scene]), options)
}

/// A scene as an SVG document, one of several with a view in common.
pub fn svg_with_view(scene: &Scene, view: &View, options: &Options) -> String {
    let mut groups = view.ghosts(scene.ghosts.iter().map(|ghost| &**ghost));
    let mut ink = Ink::new(&view.page, &scene.pose.at, &view.lettering);
    scene.pose.parts.iter().for_each(|part| part.draw(&mut ink));
    for curve in &scene.curves {
        curve.draw(&mut ink);
    }
    legend::draw(&mut ink, &scene.curves);
    groups.push(Group::of(ink.finish()));
    document::write(&view.page, &groups, options)
}

/// The length of a bar that a quarter of all bars fall short of; 0 if there is none.
fn typical_bar(pose: &Pose) -> f64 {
    let mut lengths: Vec<f64> = pose.bar_lengths().collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 4).copied().unwrap_or(0.0)
}
