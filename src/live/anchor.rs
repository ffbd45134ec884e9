//! Which figures of a drawing lie where points are: a page finds their places by itself, so that a
//! frame need not tell them.

use crate::constraint::{ConstraintKind, Point, PointIdx, Vector};
use crate::render::{Drawing, Figure, Key, Outline, Placement};
use crate::world::World;

/// What a figure lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// At a point, upright.
    Point(PointIdx),
    /// At the first, its x axis towards the second, which is another.
    Bar(PointIdx, PointIdx),
}

/// How far beside its anchor a figure is still on it, px: nobody sees less.
const NEAR: f64 = 1e-3;
/// The same of its turn, degrees: a bar that is as long as a screen is wide ends beside it so far.
const NEAR_TURN: f64 = 1e-5;

impl Anchor {
    /// What a figure lies on as it is now, among the points of what it stands for. Where that is chance,
    /// frames will tell.
    pub fn of(figure: &Figure, drawing: &Drawing, at: &[Point], world: &World) -> Option<Self> {
        let points: &[PointIdx] = match &figure.key {
            Key::Point(id) => &[id.0],
            Key::Constraint(id) => world.constraint(*id)?.constraint.points(),
            Key::Triangle(corners) => corners,
            Key::Trace(_) | Key::Legend => return None,
        };
        let ends = points.iter().flat_map(|&a| points.iter().map(move |&b| (a, b)));
        let bars = ends.filter(|(a, b)| a != b).map(|(a, b)| Self::Bar(a, b));
        let upright = points.iter().map(|&p| Self::Point(p));
        let has = |anchor: &Self| anchor.has(&figure.placement, drawing, at);
        // A bar that happens to be level lies upright on its end too; what is round is never turned.
        if is_round(figure) { upright.chain(bars).find(has) } else { bars.chain(upright).find(has) }
    }

    /// Whether a figure with this place lies on it.
    pub fn has(self, placement: &Placement, drawing: &Drawing, at: &[Point]) -> bool {
        is_near(placement, &self.placement(drawing, at))
    }

    fn placement(self, drawing: &Drawing, at: &[Point]) -> Placement {
        let (centre, scale) = (drawing.centre(), drawing.scale());
        let px = |p: PointIdx| {
            let v = at[p as usize] - centre;
            Point::new(v.x * scale, -v.y * scale)
        };
        match self {
            Self::Point(p) => Placement::at(px(p)),
            Self::Bar(a, b) => {
                let (a, b) = (px(a), px(b));
                Placement::along(a, b - a)
            }
        }
    }

    /// The points, as a page is told.
    pub fn handles(self) -> Vec<u32> {
        match self {
            Self::Point(p) => vec![p],
            Self::Bar(a, b) => vec![a, b],
        }
    }
}

/// Whether a figure looks the same however it is turned.
fn is_round(figure: &Figure) -> bool {
    let is_circle = |outline: &Outline| matches!(outline, Outline::Circle { centre, .. } if *centre == Point::ORIGIN);
    figure.shapes.iter().all(|shape| is_circle(&shape.outline))
}

/// Whether nobody sees that a figure is here and not there.
fn is_near(a: &Placement, b: &Placement) -> bool {
    let Vector { x, y } = a.at - b.at;
    let turn = a.turn - b.turn;
    x.abs() <= NEAR && y.abs() <= NEAR && turn.abs() <= NEAR_TURN
}

/// Where a page has the figures of a drawing.
#[derive(Debug, Default)]
pub struct Places {
    /// What each lies on.
    anchors: Vec<Option<Anchor>>,
    /// Where those without an anchor were told to be.
    told: Vec<Option<Placement>>,
}

impl Places {
    /// Those of a new drawing: a page knows what they lie on, and nothing else.
    pub fn new(drawing: &Drawing, at: &[Point], world: &World) -> Self {
        let figures = drawing.figures();
        let anchors = figures.iter().map(|figure| Anchor::of(figure, drawing, at, world)).collect();
        Self { anchors, told: vec![None; figures.len()] }
    }

    /// What each lies on.
    pub fn anchors(&self) -> &[Option<Anchor>] {
        &self.anchors
    }

    /// The figures that are somewhere else than a page would have them, and where they are.
    pub fn news(&mut self, drawing: &Drawing, at: &[Point]) -> Vec<(u32, Placement)> {
        let mut news = Vec::new();
        let had = self.anchors.iter().zip(&mut self.told);
        for (k, (figure, (anchor, told))) in (0..).zip(drawing.figures().iter().zip(had)) {
            let placement = figure.placement;
            let is_known = match anchor {
                Some(anchor) => anchor.has(&placement, drawing, at),
                None => told.is_some_and(|told| is_near(&told, &placement)),
            };
            if !is_known {
                news.push((k, placement));
                *told = Some(placement);
            }
        }
        news
    }
}
