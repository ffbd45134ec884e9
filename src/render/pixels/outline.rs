//! Shapes as chains of points: paths, circles, and the lines along them as areas.

use std::f64::consts::TAU;

use crate::constraint::{Point, Vector};

/// How far a chord may lie off its arc, pixels.
const SAG: f64 = 0.03;

/// A chain of points.
#[derive(Debug, Clone, Default)]
pub struct Contour {
    pub points: Vec<Point>,
    /// Whether the last is joined to the first by a line.
    pub is_closed: bool,
}

/// A turn, a scale and a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Where (1, 0) goes, from where the origin goes; (0, 1) goes at right angles to it.
    x: Vector,
    shift: Vector,
}

impl Transform {
    pub const NONE: Self = Self { x: Vector::new(1.0, 0.0), shift: Vector::new(0.0, 0.0) };

    pub const fn scaling(scale: f64) -> Self {
        Self { x: Vector::new(scale, 0.0), shift: Vector::new(0.0, 0.0) }
    }

    pub const fn shift(by: Vector) -> Self {
        Self { shift: by, ..Self::NONE }
    }

    /// Clockwise as seen.
    pub fn turn(degrees: f64) -> Self {
        Self { x: Vector::polar(1.0, degrees.to_radians()), ..Self::NONE }
    }

    fn turned(self, v: Vector) -> Vector {
        Vector::new(self.x.x * v.x - self.x.y * v.y, self.x.y * v.x + self.x.x * v.y)
    }

    /// Both, the other first.
    pub fn after(self, other: Self) -> Self {
        Self { x: self.turned(other.x), shift: self.turned(other.shift) + self.shift }
    }

    pub fn scale(self) -> f64 {
        self.x.norm()
    }
}

impl Contour {
    /// Moves it to where a transform says.
    pub fn place(&mut self, by: Transform) {
        for p in &mut self.points {
            *p = (by.turned(p.to_vector()) + by.shift).to_point();
        }
    }
}

/// Straight parts that an arc falls into when it is drawn so large.
fn n_chords(radius: f64, scale: f64, turn: f64) -> u32 {
    // The sag of a chord over an angle a is r (1 - cos(a/2)), about r a^2 / 8.
    let step = (8.0 * SAG / (radius * scale).max(SAG)).sqrt();
    (turn.abs() / step).ceil().clamp(4.0, 720.0) as u32
}

/// A circle.
pub fn circle(centre: Point, radius: f64, scale: f64) -> Contour {
    let n = n_chords(radius, scale, TAU);
    let at = |k| centre + Vector::polar(radius, TAU * f64::from(k) / f64::from(n));
    Contour { points: (0..n).map(at).collect(), is_closed: true }
}

/// A rectangle from the origin.
pub fn rectangle(width: f64, height: f64) -> Contour {
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    Contour { points: corners.map(|(x, y)| Point::new(x, y)).to_vec(), is_closed: true }
}

/// The chains of the data of a path: `M L H V Q A Z`, all absolute.
pub fn path(data: &str, scale: f64) -> Vec<Contour> {
    let mut contours: Vec<Contour> = Vec::new();
    let mut pen = Point::ORIGIN;
    let commands = data.match_indices(|c: char| c.is_ascii_alphabetic() && c != 'e');
    let starts: Vec<usize> = commands.map(|(at, _)| at).collect();
    for (k, &start) in starts.iter().enumerate() {
        let end = starts.get(k + 1).copied().unwrap_or(data.len());
        let numbers: Vec<f64> =
            data[start + 1..end].split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let last = |contours: &mut Vec<Contour>, p: Point| match contours.last_mut() {
            Some(contour) if !contour.is_closed => contour.points.push(p),
            // What goes on behind a closed chain begins at its start.
            Some(closed) => {
                let points = vec![closed.points[0], p];
                contours.push(Contour { points, is_closed: false });
            }
            None => contours.push(Contour { points: vec![p], is_closed: false }),
        };
        match data.as_bytes()[start] {
            b'M' | b'L' => {
                for (n, xy) in numbers.chunks_exact(2).enumerate() {
                    pen = Point::new(xy[0], xy[1]);
                    if data.as_bytes()[start] == b'M' && n == 0 {
                        contours.push(Contour { points: vec![pen], is_closed: false });
                    } else {
                        last(&mut contours, pen);
                    }
                }
            }
            b'H' => numbers.iter().for_each(|&x| {
                pen = Point::new(x, pen.y);
                last(&mut contours, pen);
            }),
            b'V' => numbers.iter().for_each(|&y| {
                pen = Point::new(pen.x, y);
                last(&mut contours, pen);
            }),
            b'Q' => {
                for four in numbers.chunks_exact(4) {
                    let (control, end) =
                        (Point::new(four[0], four[1]), Point::new(four[2], four[3]));
                    bend(pen, control, end, scale, &mut |p| last(&mut contours, p));
                    pen = end;
                }
            }
            b'A' => {
                for seven in numbers.chunks_exact(7) {
                    let end = Point::new(seven[5], seven[6]);
                    let arc = Arc {
                        radius: seven[0],
                        is_large: seven[3] != 0.0,
                        sweeps: seven[4] != 0.0,
                    };
                    arc.flatten(pen, end, scale, &mut |p| last(&mut contours, p));
                    pen = end;
                }
            }
            _ => {
                if let Some(contour) = contours.last_mut() {
                    contour.is_closed = true;
                    pen = contour.points[0];
                }
            }
        }
    }
    contours
}

/// A parabola.
pub fn bend(from: Point, control: Point, to: Point, scale: f64, add: &mut impl FnMut(Point)) {
    let bulge = (from.to_vector() - control.to_vector() * 2.0 + to.to_vector()).norm() * scale;
    let n = (bulge / (4.0 * SAG)).sqrt().ceil().clamp(1.0, 64.0) as u32;
    for k in 1..=n {
        let t = f64::from(k) / f64::from(n);
        let at = from.to_vector() * ((1.0 - t) * (1.0 - t))
            + control.to_vector() * (2.0 * t * (1.0 - t))
            + to.to_vector() * (t * t);
        add(at.to_point());
    }
}

/// A part of a circle as paths say it.
struct Arc {
    radius: f64,
    is_large: bool,
    /// Whether it goes on clockwise as seen.
    sweeps: bool,
}

impl Arc {
    fn flatten(&self, from: Point, to: Point, scale: f64, add: &mut impl FnMut(Point)) {
        let chord = to - from;
        let half = 0.5 * chord.norm();
        if half == 0.0 || !self.radius.is_finite() {
            return add(to);
        }
        let radius = self.radius.max(half);
        let height = (radius * radius - half * half).max(0.0).sqrt();
        let side = if self.is_large == self.sweeps { -1.0 } else { 1.0 };
        let across = Vector::new(-chord.y, chord.x) / (2.0 * half);
        let centre = from + chord * 0.5 + across * (side * height);
        let (start, end) = ((from - centre).angle(), (to - centre).angle());
        let turn = (end - start).rem_euclid(TAU);
        let turn = if self.sweeps { turn } else { turn - TAU };
        let n = n_chords(radius, scale, turn);
        for k in 1..n {
            let phi = start + turn * f64::from(k) / f64::from(n);
            add(centre + Vector::polar(radius, phi));
        }
        add(to);
    }
}

/// Dashes of one line at most: a line that leaves the page far behind has no more.
const MOST_DASHES: usize = 100_000;

/// The area of a line along a chain with round ends and corners, in convex pieces.
pub fn stroke(contour: &Contour, half: f64, dash: &[f64], add: &mut impl FnMut(&mut [Point])) {
    if half <= 0.0 {
        return;
    }
    let points = &contour.points;
    let closing = contour.is_closed.then(|| points[0]);
    let chain: Vec<Point> = points.iter().copied().chain(closing).collect();
    if dash.is_empty() || dash.iter().sum::<f64>() <= 0.0 {
        return thick(&chain, half, add);
    }
    let mut piece = vec![chain[0]];
    let (mut number, mut left) = (0, dash[0]);
    for ends in chain.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        loop {
            let distance = from.distance(to);
            if distance <= left || number > MOST_DASHES {
                left -= distance;
                piece.push(to);
                break;
            }
            from = from + (to - from) * (left / distance);
            piece.push(from);
            if number % 2 == 0 {
                thick(&piece, half, add);
            }
            piece = vec![from];
            number += 1;
            left = dash[number % dash.len()];
        }
    }
    if number % 2 == 0 && piece.len() > 1 {
        thick(&piece, half, add);
    }
}

fn thick(chain: &[Point], half: f64, add: &mut impl FnMut(&mut [Point])) {
    for ends in chain.windows(2) {
        let along = ends[1] - ends[0];
        let length = along.norm();
        if length > 0.0 {
            let across = Vector::new(-along.y, along.x) * (half / length);
            add(&mut [ends[0] + across, ends[1] + across, ends[1] - across, ends[0] - across]);
        }
    }
    let last = chain.len() - 1;
    if last == 0 || chain[0] == chain[last] {
        add(&mut circle(chain[0], half, 1.0).points);
    } else {
        add(&mut cap(chain[0], chain[0] - chain[1], half));
        add(&mut cap(chain[last], chain[last] - chain[last - 1], half));
    }
    // Corners that turn by little have no gap worth filling.
    let is_corner = |k: &usize| {
        let (a, b) = (chain[*k] - chain[k - 1], chain[k + 1] - chain[*k]);
        a.dot(b) <= 0.0 || a.cross(b).abs() * half > 0.2 * a.norm() * b.norm()
    };
    for k in (1..last).filter(is_corner) {
        add(&mut circle(chain[k], half, 1.0).points);
    }
}

/// Half a disc at the end of a line that comes from the other side.
fn cap(end: Point, outward: Vector, half: f64) -> Vec<Point> {
    let n = n_chords(half, 1.0, 0.5 * TAU);
    let first = outward.angle() - 0.25 * TAU;
    let at = |k| end + Vector::polar(half, first + 0.5 * TAU * f64::from(k) / f64::from(n));
    (0..=n).map(at).collect()
}
