//! Where the names of points stand: beside them, on nothing else.

use super::canvas::{Canvas, Lettering};
use super::labels::{Area, cheapest, direction, directions, text_width};
use super::occupancy::{OVER_PART, Occupancy};
use super::page::Page;
use super::scene::{DrawnPose, Scene};
use super::style::{self, JOINT};
use super::symbols::{Joint, SymbolForm};
use crate::constraint::{Point, PointIdx, Vector};

/// With more points than this, names of instances and rows (`left.P`, `p[3]`) are left out.
const MANY: usize = 30;
/// More names than this are left out altogether: the page shows a texture, not points.
const TOO_MANY: usize = 80;
/// How far a name's box may stand off its joint, px, in order of preference.
const DISTANCES: [f64; 4] = [3.5, 7.0, 13.0, 22.0];

/// Finds a place for each name that suits all of these scenes at once: in a motion a name
/// keeps its place beside its point.
pub fn place(scenes: &[&Scene], page: &Page) -> Lettering {
    let mut placed = Lettering::new();
    let Some(first) = scenes.first() else {
        return placed;
    };
    let names = names(&first.pose);
    if names.is_empty() {
        return placed;
    }
    let mut pages: Vec<(Occupancy, &DrawnPose)> =
        scenes.iter().map(|scene| (occupancy_of(scene, page), &scene.pose)).collect();
    for joint in names {
        let letter = style::letter(page.mark());
        let half = Vector::new(0.5 * text_width(&joint.name) * letter, 0.48 * letter);
        let costs = candidates(half, page.mark())
            .filter_map(|offset| Some((cost(&pages, joint.point, half, page, offset)?, offset)));
        let Some((cost, offset)) = cheapest(costs) else { continue };
        // Letters half hidden by symbols say nothing.
        let n_cells = half.x * half.y;
        if cost > 0.35 * f64::from(OVER_PART) * n_cells * pages.len() as f64 {
            continue;
        }
        for (occupancy, pose) in &mut pages {
            let middle = page.px(pose.at[joint.point as usize]) + offset;
            occupancy.add_area(Area::around(middle, half + Vector::new(2.0, 2.0)));
        }
        placed.insert(joint.point, offset);
    }
    placed
}

/// The joints that get their names.
fn names(pose: &DrawnPose) -> Vec<&Joint> {
    let all = pose.symbols.iter().filter_map(|symbol| match &symbol.form {
        SymbolForm::Joint(joint) => Some(joint),
        _ => None,
    });
    let all: Vec<&Joint> = all.collect();
    if all.len() <= MANY {
        return all;
    }
    let is_plain = |joint: &&Joint| !joint.name.contains(['.', '[']);
    let plain: Vec<&Joint> = all.into_iter().filter(is_plain).collect();
    if plain.len() <= TOO_MANY { plain } else { Vec::new() }
}

/// What a scene covers of its page.
fn occupancy_of(scene: &Scene, page: &Page) -> Occupancy {
    let mut occupancy = Occupancy::new(page);
    let none = Lettering::new();
    let mut canvas = Canvas::new(page, &scene.pose.at, &none);
    scene.pose.symbols.iter().for_each(|symbol| symbol.draw(&mut canvas));
    for curve in &scene.curves {
        curve.draw(&mut canvas);
    }
    canvas.finish().iter().for_each(|figure| occupancy.add(figure, page.mark()));
    occupancy
}

/// Places for a box of half size `half` around a joint, from the joint.
fn candidates(half: Vector, mark: f64) -> impl Iterator<Item = Vector> {
    // Upper right, then turning away from it on both sides; page angles go clockwise.
    let directions = directions().map(|k| {
        let step = f64::from(k.div_ceil(2)) * if k % 2 == 0 { 1.0 } else { -1.0 };
        direction(step - 2.0)
    });
    DISTANCES.into_iter().flat_map(move |distance| {
        let radius = JOINT * mark + distance;
        directions.clone().map(move |phi| {
            let e = Vector::polar(1.0, phi);
            // The box touches the circle of this radius: at a corner, or at a side.
            e * radius + Vector::new(half.x * blend(e.x), half.y * blend(e.y))
        })
    })
}

/// From the middle of a side to a corner: full a little before the direction is diagonal.
fn blend(component: f64) -> f64 {
    (1.5 * component).clamp(-1.0, 1.0)
}

/// How much a name would disturb there, over all pages; none if it leaves one of them.
fn cost(
    pages: &[(Occupancy, &DrawnPose)],
    point: PointIdx,
    half: Vector,
    page: &Page,
    offset: Vector,
) -> Option<f64> {
    let mut sum = 0;
    for (occupancy, pose) in pages {
        let at: Point = page.px(pose.at[point as usize]);
        sum += occupancy.cost(Area::around(at + offset, half))?;
    }
    Some(f64::from(sum))
}
