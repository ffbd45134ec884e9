//! Parts of a mechanism, as they are cut.

use super::members::{Member, members};
use super::rounded::Rounded;
use crate::constraint::{Point, PointIdx, Vector};
use crate::interrupt::tick;
use crate::render::symbols::hull;
use crate::world::{PointId, World};

/// What the making of a part takes, in ticks.
const PART: usize = 500;
/// What the making of a hole takes, in ticks.
const HOLE: usize = 20;

/// How parts are made; all in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// How long one unit of the plane is.
    pub scale: f64,
    /// How wide a rod is.
    pub width: f64,
    /// The diameter of holes; none without.
    pub hole: Option<f64>,
    /// How much the cut takes away.
    pub kerf: f64,
}

/// A part: a rod or a rigid body, lying flat with its first edge along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What it is called.
    pub name: String,
    /// Where the cut runs around it.
    pub outline: Rounded,
    /// The middles of its holes.
    pub holes: Vec<Point>,
    /// The radius of the cut in each hole.
    pub hole_radius: f64,
}

/// Why a part cannot be made.
#[derive(Debug, Clone, PartialEq)]
pub enum PartFlaw {
    /// Two points of a part are nearer than a hole is wide: the part, the points, how far they are
    /// apart, mm.
    HolesMeet(String, [String; 2], f64),
}

/// The rods and rigid bodies of a world that are switched on, in the order in which they were made.
///
/// # Errors
/// Where one cannot be made.
pub fn parts(world: &World, cut: &Cut) -> Result<Vec<Part>, PartFlaw> {
    members(world).iter().map(|member| part(world, member, cut)).collect()
}

fn part(world: &World, member: &Member, cut: &Cut) -> Result<Part, PartFlaw> {
    tick(PART);
    let at = world.points().column();
    let corners = hull(&member.points, at);
    let origin = at[corners[0] as usize];
    let turn = corners.get(1).map_or(0.0, |&p| (at[p as usize] - origin).angle());
    let place = |p: &PointIdx| {
        let flat: Vector = (at[*p as usize] - origin).rotate(-turn) * cut.scale;
        flat.to_point()
    };
    let radius = 0.5 * (cut.width + cut.kerf);
    let outline = Rounded { corners: corners.iter().map(place).collect(), radius };
    let mut holes: Vec<(Point, PointIdx)> = Vec::new();
    for p in member.points.iter().filter(|_| cut.hole.is_some()) {
        tick(HOLE + holes.len());
        let hole = place(p);
        let near = |(other, _): &&(Point, PointIdx)| other.distance(hole) < cut.hole.unwrap_or(0.0);
        match holes.iter().find(near) {
            // Points at one place share a pin.
            Some((other, _)) if other.distance(hole) < 1e-6 => {}
            Some(&(other, q)) => {
                let names = [q, *p].map(|p| world.points().name(PointId(p)).to_owned());
                return Err(PartFlaw::HolesMeet(member.name.clone(), names, other.distance(hole)));
            }
            None => holes.push((hole, *p)),
        }
    }
    let holes = holes.into_iter().map(|(hole, _)| hole).collect();
    let hole_radius = 0.5 * (cut.hole.unwrap_or(0.0) - cut.kerf);
    Ok(Part { name: member.name.clone(), outline, holes, hole_radius })
}
