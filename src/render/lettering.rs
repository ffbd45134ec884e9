//! Where the names of points stand: beside them, on nothing else.

use std::f64::consts::TAU;

use super::canvas::{Ink, Lettering};
use super::occupancy::{Area, Cover, OVER_PART};
use super::page::Page;
use super::parts::{Form, Joint};
use super::scene::{Pose, Scene};
use super::style::{self, JOINT};
use crate::constraint::{Point, PointIdx, Vector};

/// With more points than this, names of instances and rows (`left.P`, `p[3]`) are left out.
const MANY: usize = 30;
/// More names than this are left out altogether: the page shows a texture, not points.
const TOO_MANY: usize = 80;
/// How far a name's box may stand off its joint, px, in order of preference.
const DISTANCES: [f64; 4] = [3.5, 7.0, 13.0, 22.0];
/// Directions that are tried, to the upper right first.
const N_DIRECTIONS: u32 = 16;

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
    let mut pages: Vec<(Cover, &Pose)> =
        scenes.iter().map(|scene| (cover(scene, page), &scene.pose)).collect();
    for joint in names {
        let letter = style::letter(page.mark());
        let half = Vector::new(0.5 * style::text_width(&joint.name) * letter, 0.48 * letter);
        let found = candidates(half, page.mark())
            .filter_map(|offset| Some((cost(&pages, joint.point, half, page, offset)?, offset)))
            .min_by_key(|(cost, _)| *cost);
        let Some((cost, offset)) = found else { continue };
        // Letters half hidden by parts say nothing.
        let n_cells = half.x * half.y;
        if f64::from(cost) > 0.35 * f64::from(OVER_PART) * n_cells * pages.len() as f64 {
            continue;
        }
        for (cover, pose) in &mut pages {
            let middle = page.px(pose.at[joint.point as usize]) + offset;
            cover.add_area(Area { middle, half: half + Vector::new(2.0, 2.0) });
        }
        placed.insert(joint.point, offset);
    }
    placed
}

/// The joints that get their names.
fn names(pose: &Pose) -> Vec<&Joint> {
    let all = pose.parts.iter().filter_map(|part| match &part.form {
        Form::Joint(joint) => Some(joint),
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
fn cover(scene: &Scene, page: &Page) -> Cover {
    let mut cover = Cover::new(page);
    let none = Lettering::new();
    let mut ink = Ink::new(page, &scene.pose.at, &none);
    scene.pose.parts.iter().for_each(|part| part.draw(&mut ink));
    for curve in &scene.curves {
        curve.draw(&mut ink);
    }
    ink.finish().iter().for_each(|figure| cover.add(figure, page.mark()));
    cover
}

/// Places for a box of half size `half` around a joint, from the joint.
fn candidates(half: Vector, mark: f64) -> impl Iterator<Item = Vector> {
    // Upper right, then turning away from it on both sides; page angles go clockwise.
    let directions = (0..N_DIRECTIONS).map(|k| {
        let step = f64::from(k.div_ceil(2)) * if k % 2 == 0 { 1.0 } else { -1.0 };
        (step - 2.0) * TAU / f64::from(N_DIRECTIONS)
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
    pages: &[(Cover, &Pose)],
    point: PointIdx,
    half: Vector,
    page: &Page,
    offset: Vector,
) -> Option<u32> {
    let mut sum = 0;
    for (cover, pose) in pages {
        let at: Point = page.px(pose.at[point as usize]);
        sum += cover.cost(Area { middle: at + offset, half })?;
    }
    Some(sum)
}
