//! Which parts a mechanism is made of, and how a cutter makes them.

use std::fmt::Write;

use super::rounded::{Rounded, Stretch};
use super::sheet::Placed;
use crate::constraint::{Constraint, ConstraintKind as _, Point, PointIdx, Vector};
use crate::diag::format_decimals;
use crate::render::FIRST_WORDS;
use crate::render::symbols::hull;
use crate::render::text::printable;
use crate::world::{PointId, Record, World};

/// Digits after the point of a mm: a millionth.
pub const PLACES: usize = 6;

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

/// What holds points together, as it is being found.
struct Member {
    name: String,
    points: Vec<PointIdx>,
}

/// The rods and rigid bodies of a world that are switched on, in the order in which they were made.
///
/// # Errors
/// Where one cannot be made.
pub fn parts(world: &World, cut: &Cut) -> Result<Vec<Part>, PartFlaw> {
    members(world).iter().map(|member| part(world, member, cut)).collect()
}

fn members(world: &World) -> Vec<Member> {
    let mut members: Vec<Member> = Vec::new();
    let on = || world.constraints().map(|(_, record)| record).filter(|record| record.is_on);
    for record in on() {
        let Some(points) = held_together(record) else { continue };
        let all_frozen = points.iter().all(|&p| world.points().is_frozen(PointId(p)));
        let is_known = members.iter().any(|known| points.iter().all(|p| known.points.contains(p)));
        if !all_frozen && !is_known {
            members.push(Member { name: record.name.to_string(), points });
        }
    }
    // What is hinged on a rod is a hole in it.
    for record in on() {
        if let Constraint::Hinge(hinge) = record.constraint.stated() {
            let [pin, a, b] = hinge.points;
            let rod = |member: &&mut Member| [a, b].iter().all(|p| member.points.contains(p));
            if let Some(rod) = members.iter_mut().find(rod)
                && !rod.points.contains(&pin)
            {
                rod.points.push(pin);
            }
        }
    }
    members
}

/// The points that a constraint holds as one body; none if it is no part.
fn held_together(record: &Record) -> Option<Vec<PointIdx>> {
    let is_driven = record.drivers().iter().any(|(_, formula)| formula.depends().is_live());
    match record.constraint.stated() {
        Constraint::Length(length) if length.bounds.is_equality() && !is_driven => {
            Some(length.points.to_vec())
        }
        Constraint::Motor(motor) => Some(motor.crank().to_vec()),
        Constraint::Rigid(rigid) => Some(rigid.points().to_vec()),
        _ => None,
    }
}

fn part(world: &World, member: &Member, cut: &Cut) -> Result<Part, PartFlaw> {
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

/// The parts on their sheet as SVG, one path each.
pub fn svg(sheet: &Placed) -> String {
    let number = |value: f64| format_decimals(value, PLACES);
    let [width, height] = sheet.size.map(number);
    let mut text = format!(
        "{FIRST_WORDS} xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" \
         height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <g id=\"parts\" fill=\"none\" stroke=\"#ff0000\" stroke-width=\"0.1\">\n"
    );
    // On a page y points down.
    let point = |p: Point| format!("{} {}", number(p.x), number(sheet.size[1] - p.y));
    for part in &sheet.parts {
        let name = escaped(&part.name);
        let _ = write!(text, "<path d=\"{}", outline_data(&part.outline, &point));
        for &hole in &part.holes {
            text.push_str(&circle_data(hole, part.hole_radius, &point));
        }
        let _ = writeln!(text, "\"><title>{name}</title></path>");
    }
    text.push_str("</g>\n</svg>\n");
    text
}

/// A name as XML has it.
pub fn escaped(name: &str) -> String {
    printable(name).replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn outline_data(outline: &Rounded, point: &dyn Fn(Point) -> String) -> String {
    let stretches = outline.stretches();
    let radius = format_decimals(outline.radius, PLACES);
    if let [Stretch::Arc { centre, .. }] = stretches[..] {
        return circle_data(centre, outline.radius, point);
    }
    let mut data = String::new();
    for stretch in &stretches {
        match *stretch {
            Stretch::Line { to, .. } => data.extend(["L", &point(to)]),
            Stretch::Arc { centre, angles: [from, to] } => {
                let [from, to] =
                    [from, to].map(|angle| point(centre + Vector::polar(outline.radius, angle)));
                if data.is_empty() {
                    data.extend(["M", &from]);
                }
                data.extend(["A", &radius, " ", &radius, " 0 0 0 ", &to]);
            }
        }
    }
    data + "Z"
}

fn circle_data(centre: Point, radius: f64, point: &dyn Fn(Point) -> String) -> String {
    let [a, b, c] = [0.0, 1.0, 2.0]
        .map(|third| point(centre + Vector::polar(radius, third * std::f64::consts::TAU / 3.0)));
    let r = format_decimals(radius, PLACES);
    format!("M{a}A{r} {r} 0 0 0 {b}A{r} {r} 0 0 0 {c}A{r} {r} 0 0 0 {a}Z")
}
