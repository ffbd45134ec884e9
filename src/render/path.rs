//! Paths: lines and arcs, in px, and how SVG writes them.

use crate::constraint::{Point, Vector};
use crate::diag::push_decimals;
use crate::interrupt::tick;

/// What the writing of a verb takes, in ticks.
const VERB: usize = 200;

/// Lines and arcs; arcs lie around the origin.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    verbs: Vec<Verb>,
    /// The numbers of all verbs, one after the other.
    numbers: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verb {
    Move,
    Line,
    /// A parabola: its control point, then its end.
    Bend,
    /// A circular arc: radius, then its end.
    Arc {
        is_large: bool,
        is_clockwise: bool,
    },
    Close,
}

impl Verb {
    const fn n_numbers(self) -> usize {
        match self {
            Self::Move | Self::Line => 2,
            Self::Bend => 4,
            Self::Arc { .. } => 3,
            Self::Close => 0,
        }
    }
}

impl Path {
    /// A straight line.
    pub fn segment(a: Point, b: Point) -> Self {
        Self::polyline([a, b])
    }

    /// A line along the x axis.
    pub fn along_x(from: f64, to: f64) -> Self {
        Self::segment(Point::new(from, 0.0), Point::new(to, 0.0))
    }

    /// A chain of straight lines.
    pub fn polyline(points: impl IntoIterator<Item = Point>) -> Self {
        let mut path = Self::default();
        for p in points {
            if path.verbs.is_empty() {
                path.move_to(p)
            } else {
                path.line_to(p)
            };
        }
        path
    }

    /// A closed chain of straight lines.
    pub fn polygon(points: impl IntoIterator<Item = Point>) -> Self {
        let mut path = Self::polyline(points);
        path.close();
        path
    }

    /// An arc around the origin, angles in radians, clockwise as seen where `to > from`.
    /// Must be less than a whole turn.
    pub fn arc(radius: f64, from: f64, to: f64) -> Self {
        let mut path = Self::default();
        path.move_to(Vector::polar(radius, from).to_point());
        path.verbs.push(Verb::Arc {
            is_large: (to - from).abs() > std::f64::consts::PI,
            is_clockwise: to > from,
        });
        let end = Vector::polar(radius, to);
        path.numbers.extend([radius, end.x, end.y]);
        path
    }

    /// Begins a new chain.
    pub fn move_to(&mut self, p: Point) -> &mut Self {
        self.push(Verb::Move, &[p.x, p.y])
    }

    /// Goes straight on.
    pub fn line_to(&mut self, p: Point) -> &mut Self {
        self.push(Verb::Line, &[p.x, p.y])
    }

    /// Goes on in a parabola.
    pub fn bend_to(&mut self, control: Point, p: Point) -> &mut Self {
        self.push(Verb::Bend, &[control.x, control.y, p.x, p.y])
    }

    /// Goes back to where the chain began.
    pub fn close(&mut self) -> &mut Self {
        self.push(Verb::Close, &[])
    }

    /// Adds a whole circle around the origin.
    pub fn circle(&mut self, radius: f64) -> &mut Self {
        let half = Verb::Arc { is_large: true, is_clockwise: true };
        self.push(Verb::Move, &[radius, 0.0])
            .push(half, &[radius, -radius, 0.0])
            .push(half, &[radius, radius, 0.0])
            .close()
    }

    fn push(&mut self, verb: Verb, numbers: &[f64]) -> &mut Self {
        self.verbs.push(verb);
        self.numbers.extend_from_slice(numbers);
        self
    }

    /// Its numbers, in the order in which they are written.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Whether two paths differ in their numbers only.
    pub fn is_like(&self, other: &Self) -> bool {
        self.verbs == other.verbs
    }

    /// Whether there is nothing to see.
    pub fn is_empty(&self) -> bool {
        self.verbs.is_empty()
    }

    /// How long it is, arcs as their chords.
    pub fn length(&self) -> f64 {
        let mut length = 0.0;
        self.flatten(&mut |a, b| length += a.distance(b));
        length
    }

    /// Adds another path behind this one.
    pub fn append(&mut self, other: Self) {
        self.verbs.extend(other.verbs);
        self.numbers.extend(other.numbers);
    }

    /// The path as SVG writes it, with these numbers in the place of its own.
    pub fn write(&self, numbers: &[f64], n_decimals: usize) -> String {
        let mut text = String::with_capacity(numbers.len() * 6);
        let mut rest = numbers;
        let mut last = None;
        for &verb in &self.verbs {
            tick(VERB);
            let (now, then) = rest.split_at(verb.n_numbers());
            rest = then;
            match verb {
                Verb::Move => text.push('M'),
                // A chain of lines needs the letter once.
                Verb::Line if last == Some(Verb::Line) => text.push(' '),
                Verb::Line => text.push('L'),
                Verb::Bend => text.push('Q'),
                Verb::Close => text.push('Z'),
                Verb::Arc { is_large, is_clockwise } => {
                    text.push('A');
                    push_decimals(&mut text, now[0], n_decimals);
                    text.push(' ');
                    push_decimals(&mut text, now[0], n_decimals);
                    text.push_str(if is_large { " 0 1" } else { " 0 0" });
                    text.push_str(if is_clockwise { " 1 " } else { " 0 " });
                }
            }
            let written = if matches!(verb, Verb::Arc { .. }) { &now[1..] } else { now };
            for (k, &value) in written.iter().enumerate() {
                if k > 0 {
                    text.push(' ');
                }
                push_decimals(&mut text, value, n_decimals);
            }
            last = Some(verb);
        }
        text
    }

    /// Chains of points near the path, for who asks what it covers. Arcs become chords of
    /// less than a twelfth of a turn.
    pub fn flatten(&self, add: &mut impl FnMut(Point, Point)) {
        let (mut start, mut pen) = (Point::ORIGIN, Point::ORIGIN);
        let mut rest = &self.numbers[..];
        for &verb in &self.verbs {
            let (now, then) = rest.split_at(verb.n_numbers());
            rest = then;
            let end = match now {
                [.., x, y] => Point::new(*x, *y),
                _ => start,
            };
            match verb {
                Verb::Move => start = end,
                Verb::Line | Verb::Close => add(pen, end),
                Verb::Bend => {
                    let control = Point::new(now[0], now[1]);
                    let middle =
                        (pen.to_vector() + control.to_vector() * 2.0 + end.to_vector()) / 4.0;
                    add(pen, middle.to_point());
                    add(middle.to_point(), end);
                }
                // All arcs are drawn around the origin.
                Verb::Arc { is_clockwise, .. } => {
                    let from = pen.to_vector().angle();
                    let by = (end.to_vector().angle() - from).rem_euclid(std::f64::consts::TAU);
                    let by = if is_clockwise { by } else { by - std::f64::consts::TAU };
                    let n = (by.abs() * 6.0).ceil().max(1.0);
                    let mut before = pen;
                    for k in 1..=n as u32 {
                        let phi = from + by * f64::from(k) / n;
                        let next = Vector::polar(now[0], phi).to_point();
                        add(before, next);
                        before = next;
                    }
                }
            }
            pen = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_written_short() {
        let corner = [Point::new(0.0, 0.0), Point::new(10.0, -0.001), Point::new(10.0, 2.5)];
        let path = Path::polygon(corner);
        assert_eq!(path.write(path.numbers(), 2), "M0 0L10 0 10 2.5Z");
        let arc = Path::arc(2.0, 0.0, std::f64::consts::FRAC_PI_2);
        assert_eq!(arc.write(arc.numbers(), 2), "M2 0A2 2 0 0 1 0 2");
    }

    #[test]
    fn a_flattened_circle_stays_on_its_radius() {
        let mut path = Path::default();
        path.circle(5.0);
        let mut n = 0;
        path.flatten(&mut |a, b| {
            n += 1;
            assert!((a.to_vector().norm() - 5.0).abs() < 1e-9 && a.distance(b) < 1.0 + 1e-9);
        });
        assert!(n > 30);
    }
}
