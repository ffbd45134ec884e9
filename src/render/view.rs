//! A view: what all pictures of one mechanism in motion share, so that they can be laid one
//! on the other.

use std::borrow::Borrow;
use std::convert::Infallible;

use super::canvas::{Canvas, Lettering};
use super::document::Group;
use super::figure::Figure;
use super::lettering;
use super::page::{BoundingBox, Page};
use super::scene::{DrawnPose, Scene};
use crate::interrupt::tick;

/// Names are placed to suit so many scenes of a motion.
const N_PROBES: usize = 16;

/// What a look at a bar takes, in ticks.
const LOOK: usize = 20;

/// A part of the plane, and where on it each name stands.
#[derive(Debug, Clone)]
pub struct View {
    page: Page,
    lettering: Lettering,
}

impl View {
    /// The view that shows all of these scenes.
    pub fn of<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> Self {
        Self::shown(scenes, None)
    }

    /// The same for pictures that are shown so wide, px.
    pub fn shown<'a>(scenes: impl IntoIterator<Item = &'a Scene>, width: Option<u32>) -> Self {
        let scenes: Vec<&Scene> = scenes.into_iter().collect();
        match Self::through(scenes.len(), width, |k| Ok::<_, Infallible>(scenes[k])) {
            Ok(view) => view,
            Err(never) => match never {},
        }
    }

    /// The view that shows so many scenes, which are fetched one after the other, so wide, px.
    ///
    /// # Errors
    /// That of a scene that cannot be fetched.
    pub fn through<S: Borrow<Scene>, E>(
        n_scenes: usize,
        width: Option<u32>,
        mut fetch: impl FnMut(usize) -> Result<S, E>,
    ) -> Result<Self, E> {
        let mut bounds = BoundingBox::default();
        let mut bars = 0.0;
        let mut last: Option<S> = None;
        for k in 0..n_scenes {
            let scene = fetch(k)?;
            scene.borrow().pose.extend(&mut bounds);
            match &last {
                None => bars = typical_bar(&scene.borrow().pose),
                Some(last) => last.borrow().extend_by_past(Some(scene.borrow()), &mut bounds),
            }
            last = Some(scene);
        }
        if let Some(last) = &last {
            last.borrow().extend_by_past(None, &mut bounds);
        }
        let page = Page::fit_width(&bounds, width);
        let page = if bars > 0.0 { page.with_bars(bars) } else { page };
        let n_probes = n_scenes.min(N_PROBES);
        let probe = |k: usize| fetch(k * (n_scenes - 1) / (n_probes - 1).max(1));
        let probes = (0..n_probes).map(probe).collect::<Result<Vec<S>, E>>()?;
        let probes: Vec<&Scene> = probes.iter().map(S::borrow).collect();
        Ok(Self { page, lettering: lettering::place(&probes, &page) })
    }

    /// The same without names.
    #[must_use]
    pub fn without_names(self) -> Self {
        Self { lettering: Lettering::new(), ..self }
    }

    /// A page on which names stand so.
    pub(super) const fn new(page: Page, lettering: Lettering) -> Self {
        Self { page, lettering }
    }

    pub(super) const fn page(&self) -> &Page {
        &self.page
    }

    pub(super) const fn lettering(&self) -> &Lettering {
        &self.lettering
    }

    /// A pose as figures.
    pub(super) fn figures(&self, pose: &DrawnPose) -> Vec<Figure> {
        let mut canvas = Canvas::new(&self.page, &pose.at, &self.lettering);
        pose.symbols.iter().for_each(|symbol| symbol.draw(&mut canvas));
        canvas.finish()
    }

    /// A scene as figures, without its ghosts and its legend.
    pub(super) fn figures_of(&self, scene: &Scene) -> Vec<Figure> {
        let mut canvas = Canvas::new(&self.page, &scene.pose.at, &self.lettering);
        scene.pose.symbols.iter().for_each(|symbol| symbol.draw(&mut canvas));
        for curve in &scene.curves {
            curve.draw(&mut canvas);
        }
        canvas.finish()
    }

    /// Poses of the past, the fainter the older.
    pub(super) fn ghosts<'a>(
        &self,
        ghosts: impl ExactSizeIterator<Item = &'a DrawnPose>,
    ) -> Vec<Group> {
        const OLDEST: f64 = 0.14;
        const NEWEST: f64 = 0.45;
        let none = Lettering::new();
        let n = ghosts.len();
        let group = |(k, ghost): (usize, &DrawnPose)| {
            let mut canvas = Canvas::new(&self.page, &ghost.at, &none);
            ghost.symbols.iter().for_each(|symbol| symbol.draw(&mut canvas));
            let age = (k + 1) as f64 / n as f64;
            let figures = canvas.finish().into_iter().filter(Figure::is_solid).collect();
            Group { opacity: OLDEST + (NEWEST - OLDEST) * age, ..Group::of(figures) }
        };
        ghosts.enumerate().map(group).collect()
    }
}

/// The length of a bar that a quarter of all bars fall short of; 0 if there is none.
pub(super) fn typical_bar(pose: &DrawnPose) -> f64 {
    tick(LOOK * pose.symbols.len());
    let mut lengths: Vec<f64> = pose.bar_lengths().collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 4).copied().unwrap_or(0.0)
}
