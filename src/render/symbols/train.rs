//! Cog wheels in mesh with one another and with racks.

use std::f64::consts::{PI, TAU};

use super::bar::Segment;
use super::draw::Draw;
use super::teeth;
use crate::constraint::{Point, PointIdx, Vector};
use crate::interrupt::tick;
use crate::linalg::DisjointSets;
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::page::BoundingBox;
use crate::render::path::Path;
use crate::render::style::Class;

/// From tooth to tooth, px, where there is room for it.
const PITCH: f64 = 15.0;
/// Teeth closer together than this are a blur; pitch circles are drawn instead, px.
const LEAST_PITCH: f64 = 4.0;
/// With fewer teeth than this nothing looks like a wheel.
const LEAST_TEETH: f64 = 6.0;
/// More teeth than this on one wheel are a large file and a grey rim.
const MOST_TEETH: f64 = 400.0;

/// Wheels that mesh, directly or through others.
#[derive(Debug, Clone, PartialEq)]
pub struct Train {
    wheels: Vec<Wheel>,
    meshes: Vec<Mesh>,
}

#[derive(Debug, Clone, PartialEq)]
struct Wheel {
    centre: PointIdx,
    marker: PointIdx,
    /// Whether its teeth point inward.
    is_ring: bool,
}

/// What meshes with what; wheels by their number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mesh {
    /// Two wheels and the ratio of their radii, second over first, negative for internal.
    Wheels([usize; 2], f64),
    /// A wheel, the line it rolls on, its radius, and whether it may be at any height over it.
    Rack(usize, [PointIdx; 2], f64, bool),
}

/// All wheels of a scene, before they are sorted into trains.
#[derive(Debug, Clone, Default)]
pub struct Gears {
    wheels: Vec<(Wheel, f64)>,
    meshes: Vec<Mesh>,
    groups: DisjointSets,
}

impl Gears {
    /// Adds centre and marker of one wheel, centre and marker of another, as they stand.
    pub fn add_pair(&mut self, [o1, a1, o2, a2]: [PointIdx; 4], ratio: f64, at: &[Point]) {
        let [r1, r2] = radii(at[o1 as usize].distance(at[o2 as usize]), ratio);
        let first = self.wheel([o1, a1], r1, ratio < 0.0 && r1 > r2);
        let second = self.wheel([o2, a2], r2, ratio < 0.0 && r1 <= r2);
        self.groups.join(first, second);
        self.meshes.push(Mesh::Wheels([first, second], ratio));
    }

    /// Adds centre and marker of a wheel and the line it rolls on, or a parallel to it at the
    /// distance of the radius where the height is free.
    pub fn add_rack(&mut self, [o, a, p, q]: [PointIdx; 4], radius: f64, is_free: bool) {
        let wheel = self.wheel([o, a], radius, false);
        self.meshes.push(Mesh::Rack(wheel, [p, q], radius, is_free));
    }

    /// A wheel that is there already, or a new one: one shaft may carry wheels of several
    /// sizes.
    fn wheel(&mut self, [centre, marker]: [PointIdx; 2], radius: f64, is_ring: bool) -> usize {
        tick(self.wheels.len());
        let wheel = Wheel { centre, marker, is_ring };
        let is_same = |(other, r): &(Wheel, f64)| {
            *other == wheel && (r - radius).abs() <= 0.02 * radius.max(*r)
        };
        self.wheels.iter().position(is_same).unwrap_or_else(|| {
            self.wheels.push((wheel, radius));
            self.wheels.len() - 1
        })
    }

    /// The trains, each with the number of its first mesh in the order of adding.
    pub fn trains(mut self) -> Vec<(usize, Train)> {
        let mut trains: Vec<(usize, Train)> = Vec::new();
        // For each group its train, for each wheel its number there.
        let mut train_of = vec![usize::MAX; self.wheels.len()];
        let mut number_of = vec![usize::MAX; self.wheels.len()];
        for (k, &mesh) in self.meshes.iter().enumerate() {
            let wheels = match mesh {
                Mesh::Wheels([a, b], _) => vec![a, b],
                Mesh::Rack(a, ..) => vec![a],
            };
            let group = self.groups.least(wheels[0]);
            if train_of[group] == usize::MAX {
                train_of[group] = trains.len();
                trains.push((k, Train { wheels: Vec::new(), meshes: Vec::new() }));
            }
            let train = &mut trains[train_of[group]].1;
            for wheel in wheels {
                if number_of[wheel] == usize::MAX {
                    number_of[wheel] = train.wheels.len();
                    train.wheels.push(self.wheels[wheel].0.clone());
                }
            }
            train.meshes.push(match mesh {
                Mesh::Wheels(pair, ratio) => Mesh::Wheels(pair.map(|w| number_of[w]), ratio),
                Mesh::Rack(wheel, line, radius, is_free) => {
                    Mesh::Rack(number_of[wheel], line, radius, is_free)
                }
            });
        }
        trains
    }
}

/// The radii of two wheels in mesh, their centres at a distance.
fn radii(distance: f64, ratio: f64) -> [f64; 2] {
    // Internal wheels of nearly one size would be circles far larger than the mechanism.
    const NEAREST: f64 = 0.02;
    let first = distance / (1.0 + ratio).abs().max(NEAREST);
    [first, first * ratio.abs()]
}

/// One wheel on the page.
#[derive(Debug, Clone, Copy)]
struct Rim {
    centre: Point,
    /// The direction of the marker, page angle.
    marker: f64,
    radius: f64,
    n_teeth: f64,
    /// The direction of one of the teeth, page angle.
    tooth: f64,
}

impl Rim {
    /// How far round its teeth are in a direction: 0 on a tooth, pi in a gap.
    fn phase(&self, direction: f64) -> f64 {
        self.n_teeth * (direction - self.tooth)
    }

    /// Turns the teeth so that their phase in a direction is as given. They keep their place
    /// against the marker, to a whole tooth, so that they turn with it.
    fn set_phase(&mut self, direction: f64, phase: f64) {
        let against_marker = self.n_teeth * (direction - self.marker) - phase;
        self.tooth = self.marker + whole_turns_off(against_marker) / self.n_teeth;
    }
}

/// An angle without whole turns, in [0, 2 pi) but for rounding: a hair less than 2 pi is 0,
/// so that frames of one motion agree on which tooth is the first.
fn whole_turns_off(angle: f64) -> f64 {
    const HAIR: f64 = 1e-6;
    (angle + HAIR).rem_euclid(TAU) - HAIR
}

impl Train {
    /// The radius of each wheel, world units.
    fn radii(&self, at: &[Point]) -> Vec<f64> {
        let mut found = vec![None; self.wheels.len()];
        for mesh in &self.meshes {
            match *mesh {
                Mesh::Wheels([a, b], ratio) => {
                    let [o1, o2] = [a, b].map(|w| at[self.wheels[w].centre as usize]);
                    let [r1, r2] = radii(o1.distance(o2), ratio);
                    found[a].get_or_insert(r1);
                    found[b].get_or_insert(r2);
                }
                Mesh::Rack(wheel, _, radius, _) => {
                    found[wheel].get_or_insert(radius);
                }
            }
        }
        found.into_iter().map(|r| r.unwrap_or(0.0)).collect()
    }

    /// How many teeth each wheel has, such that all are of one size and the numbers are in
    /// the ratios asked for or as near as whole numbers come; none where they would be a blur.
    fn n_teeth(radii: &[f64], pitch: f64) -> Option<Vec<f64>> {
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
        if largest.is_nan() || largest <= 0.0 || smallest <= 0.0 {
            return None;
        }
        let pitch = pitch.min(TAU * smallest / LEAST_TEETH);
        if pitch < LEAST_PITCH || TAU * largest / pitch > MOST_TEETH {
            return None;
        }
        // Try each number near the wanted one on the smallest wheel.
        let wanted = TAU * smallest / pitch;
        let candidates = (LEAST_TEETH as u32)..=(1.6 * wanted).ceil() as u32;
        let error_with = |n: u32| -> f64 {
            let off = |r: &f64| {
                let exact = f64::from(n) * r / smallest;
                (exact - exact.round()).abs()
            };
            let off = radii.iter().map(off).fold(0.0, f64::max);
            // Rounding of the radii is not an error; another size of teeth is a small one.
            off.max(1e-4) + 0.004 * libm::log(f64::from(n) / wanted).abs()
        };
        let n = candidates.min_by(|&a, &b| error_with(a).total_cmp(&error_with(b)))?;
        Some(radii.iter().map(|r| (f64::from(n) * r / smallest).round()).collect())
    }

    /// The wheels on the page, teeth in gaps; none where pitch circles are drawn instead.
    fn rims(&self, canvas: &Canvas, radii: &[f64]) -> Option<Vec<Rim>> {
        let px: Vec<f64> = radii.iter().map(|&r| canvas.page.length(r)).collect();
        let n_teeth = Self::n_teeth(&px, canvas.size(PITCH))?;
        let mut rims: Vec<Rim> = (0..self.wheels.len())
            .map(|k| {
                let centre = canvas.px(self.wheels[k].centre);
                let marker = (canvas.px(self.wheels[k].marker) - centre).angle();
                Rim { centre, marker, radius: px[k], n_teeth: n_teeth[k], tooth: marker }
            })
            .collect();
        let mut is_set = vec![false; rims.len()];
        is_set[0] = true;
        // From wheel to wheel; the meshes of a train hang together.
        for _ in 0..self.meshes.len() {
            tick(self.meshes.len());
            let mut is_done = true;
            for mesh in &self.meshes {
                let Mesh::Wheels([a, b], ratio) = *mesh else { continue };
                let (known, other) = match (is_set[a], is_set[b]) {
                    (true, false) => (a, b),
                    (false, true) => (b, a),
                    _ => continue,
                };
                let [from, to] = contact(rims[known], rims[other], ratio < 0.0);
                let phase = rims[known].phase(from);
                // Outer wheels turn against one another, inner ones with one another.
                rims[other].set_phase(to, if ratio < 0.0 { phase - PI } else { PI - phase });
                is_set[other] = true;
                is_done = false;
            }
            if is_done {
                break;
            }
        }
        Some(rims)
    }

    fn draw_rack(canvas: &mut Canvas, [p, q]: [PointIdx; 2], rim: &Rim, is_free: bool) {
        let mut segment = Segment::between(canvas, p, q);
        let e = Vector::polar(1.0, segment.placement.turn.to_radians());
        if is_free {
            canvas
                .figure(Layer::Construction, segment.placement)
                .path(Class::Construction, Path::along_x(0.0, segment.length));
            let height = e.cross(rim.centre - segment.placement.at);
            let side = if height < 0.0 { -1.0 } else { 1.0 };
            segment.placement.at += e.perp() * (height - side * rim.radius);
        }
        let to_centre = rim.centre - segment.placement.at;
        let support = to_centre.dot(e);
        let is_below = e.cross(to_centre) > 0.0;
        // Page angles grow clockwise: at its lowest place a wheel above the line goes left.
        let down = if is_below { -e.perp() } else { e.perp() };
        let with_line = down.perp().dot(e).signum();
        let phase = PI + with_line * rim.phase(down.angle());
        let pitch = TAU * rim.radius / rim.n_teeth;
        let turns = whole_turns_off(TAU * support / pitch - phase) / TAU;
        let outline = teeth::rack(segment.length, pitch, turns * pitch, is_below, canvas.size(7.0));
        canvas.figure(Layer::Wheel, segment.placement).path(Class::Wheel, outline);
    }
}

/// The directions in which two wheels touch, seen from each of them.
fn contact(a: Rim, b: Rim, is_internal: bool) -> [f64; 2] {
    let between = (b.centre - a.centre).angle();
    match (is_internal, a.radius > b.radius) {
        (false, _) => [between, between + PI],
        (true, true) => [between, between],
        (true, false) => [between + PI, between + PI],
    }
}

impl Draw for Train {
    fn points(&self) -> Vec<PointIdx> {
        let mut points: Vec<PointIdx> =
            self.wheels.iter().flat_map(|wheel| [wheel.centre, wheel.marker]).collect();
        for mesh in &self.meshes {
            if let Mesh::Rack(_, line, ..) = mesh {
                points.extend(line);
            }
        }
        points
    }

    fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
        for (wheel, radius) in self.wheels.iter().zip(self.radii(at)) {
            let rim = if wheel.is_ring { 1.12 } else { 1.04 };
            bounds.include_circle(at[wheel.centre as usize], rim * radius);
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        let radii = self.radii(canvas.at);
        let rims = self.rims(canvas, &radii);
        for mesh in &self.meshes {
            if let (Mesh::Rack(wheel, line, _, is_free), Some(rims)) = (*mesh, &rims) {
                Self::draw_rack(canvas, line, &rims[wheel], is_free);
            }
        }
        // A small wheel lies in front of a large one.
        let mut order: Vec<usize> = (0..self.wheels.len()).collect();
        order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
        for k in order {
            let wheel = &self.wheels[k];
            let (centre, marker) = (canvas.px(wheel.centre), canvas.px(wheel.marker));
            let radius = canvas.page.length(radii[k]);
            match &rims {
                Some(rims) => draw_toothed(canvas, &rims[k], wheel.is_ring),
                None => draw_plain(canvas, centre, radius, wheel.is_ring),
            }
            let spoke = Segment::new(centre, marker);
            // The spokes of all wheels lie over the wheels, so that a turn is seen.
            canvas
                .figure(Layer::Wheel, spoke.placement)
                .path(Class::Spoke, Path::along_x(0.0, spoke.length));
        }
    }
}

fn draw_toothed(canvas: &mut Canvas, rim: &Rim, is_ring: bool) {
    let module = 2.0 * rim.radius / rim.n_teeth;
    let placement = Placement { at: rim.centre, turn: rim.tooth.to_degrees() };
    let mut outline = teeth::wheel(rim.radius, rim.n_teeth as u32, is_ring);
    let rim_width = 1.2 * module + canvas.size(9.0);
    let upright = Placement::at(rim.centre);
    if is_ring {
        outline.circle(rim.radius + rim_width);
        canvas.figure(Layer::Wheel, placement).path(Class::RingWheel, outline);
    } else {
        canvas.figure(Layer::Wheel, placement).path(Class::Wheel, outline);
        let web = rim.radius - rim_width;
        if web > canvas.size(24.0) {
            canvas.figure(Layer::Wheel, upright).circle(Class::WheelWeb, Point::ORIGIN, web);
        }
    }
    canvas.figure(Layer::Wheel, upright).circle(Class::Pitch, Point::ORIGIN, rim.radius);
}

fn draw_plain(canvas: &mut Canvas, centre: Point, radius: f64, is_ring: bool) {
    let class = if is_ring { Class::RingPlain } else { Class::Wheel };
    canvas.figure(Layer::Wheel, Placement::at(centre)).circle(class, Point::ORIGIN, radius);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::canvas::Lettering;
    use crate::render::page::Page;

    fn page_over(at: &[Point], train: &Train) -> Page {
        let mut bounds = BoundingBox::default();
        train.extend(at, &mut bounds);
        Page::fit(&bounds)
    }

    fn one_train(points: [PointIdx; 4], ratio: f64, at: &[Point]) -> Train {
        let mut gears = Gears::default();
        gears.add_pair(points, ratio, at);
        gears.trains().remove(0).1
    }

    #[test]
    fn teeth_meet_gaps_and_numbers_are_in_the_ratio() {
        for (ratio, x2) in [(2.0, 3.0), (0.25, 1.25), (-0.25, 0.75), (-3.0, 2.0), (1.0, 2.0)] {
            for turn in [0.0, 0.3, 2.0] {
                let at = [
                    Point::ORIGIN,
                    Vector::polar(1.0, turn).to_point(),
                    Point::new(x2, 0.0),
                    Point::new(x2, 0.4),
                ];
                let train = one_train([0, 1, 2, 3], ratio, &at);
                let page = page_over(&at, &train);
                let lettering = Lettering::default();
                let canvas = Canvas::new(&page, &at, &lettering);
                let rims = train.rims(&canvas, &train.radii(&at)).expect("room for teeth");
                assert_eq!(rims[1].n_teeth / rims[0].n_teeth, ratio.abs());
                let [from, to] = contact(rims[0], rims[1], ratio < 0.0);
                let (p, q) = (rims[0].phase(from), rims[1].phase(to));
                let mesh = if ratio < 0.0 { p - q } else { p + q };
                assert!((libm::cos(mesh) + 1.0).abs() < 1e-9, "ratio {ratio}: {mesh}");
                // Both place the contact at one place of the page.
                let touch = |rim: &Rim, phi| rim.centre + Vector::polar(rim.radius, phi);
                assert!(touch(&rims[0], from).distance(touch(&rims[1], to)) < 1e-6);
            }
        }
    }

    #[test]
    fn a_shaft_may_carry_two_sizes() {
        let at: Vec<Point> =
            [(0.0, 0.0), (1.0, 0.0), (3.0, 0.0), (3.0, 1.0), (9.0, 0.0), (9.0, 1.0)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec();
        let mut gears = Gears::default();
        gears.add_pair([0, 1, 2, 3], 2.0, &at);
        gears.add_pair([2, 3, 4, 5], 5.0, &at);
        gears.add_pair([2, 3, 0, 1], 0.5, &at);
        let trains = gears.trains();
        assert_eq!(
            trains.iter().map(|(k, t)| (*k, t.wheels.len())).collect::<Vec<_>>(),
            [(0, 2), (1, 2)]
        );
    }
}
