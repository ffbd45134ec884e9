//! Curves: the paths that points left behind, thinned to what a page can show.

use std::sync::Arc;

use super::canvas::Canvas;
use super::figure::{Figure, Key, Layer};
use super::laps::once;
use super::page::{BoundingBox, Page};
use super::path::Path;
use super::samples::Samples;
use super::style::{Class, colour_number};
use crate::constraint::{Point, Vector};
use crate::interrupt::tick;
use crate::world::{Entity, PointId, Sample, Trace, World};

/// How far a drawn line may pass a sample, px: a tenth of what a screen can show.
const TOLERANCE: f64 = 0.1;

/// A path longer than this crosses itself many times over and is drawn finer, px.
const LONG: f64 = 6000.0;

/// What a look at a sample takes, and what passing it takes, in ticks.
const LOOK: usize = 1;
const PASS: usize = 20;

/// The path of one point.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Its place among the paths, which gives it its colour.
    pub idx: usize,
    /// Whose it is.
    pub point: PointId,
    /// What it is called: as its point, if not otherwise.
    pub name: Arc<str>,
    /// Whether it has a name of its own.
    pub is_named: bool,
    /// Where the point was.
    pub samples: Samples,
}

/// What a path is called.
fn name_of<'a>(trace: &'a Trace, world: &'a World) -> &'a str {
    let of_point = || world.name_of(Entity::Point(trace.point));
    trace.label.as_deref().unwrap_or_else(of_point)
}

impl Curve {
    /// The path at a place in the list of a world's traces.
    pub fn of(idx: usize, trace: &Trace, world: &World) -> Self {
        let name = name_of(trace, world).into();
        let samples = Samples::new(&trace.samples);
        Self { idx, point: trace.point, name, is_named: trace.label.is_some(), samples }
    }

    /// The same path somewhat later; none if it is not the same.
    pub fn grown(&self, trace: &Trace, world: &World) -> Option<Self> {
        let is_same = self.point == trace.point
            && self.is_named == trace.label.is_some()
            && *self.name == *name_of(trace, world);
        let samples = is_same.then(|| self.samples.grown(&trace.samples))??;
        Some(Self { samples, ..self.clone() })
    }

    /// Whether another holds all of this one. Paths are cut short or grow: the last sample
    /// answers for those before.
    pub fn is_continued_by(&self, other: &Self) -> bool {
        let n = self.samples.len();
        self.point == other.point
            && self.name == other.name
            && n <= other.samples.len()
            && (n == 0 || self.samples.at(n - 1) == other.samples.at(n - 1))
    }

    /// Grows the box to hold it.
    pub fn extend(&self, bounds: &mut BoundingBox) {
        self.samples.read(|all| {
            tick(LOOK * all.len());
            all.iter().for_each(|sample| bounds.include(sample.at));
        });
    }

    /// The class it has in a legend.
    pub const fn class(&self) -> Class {
        Class::Trace(colour_number(self.idx))
    }

    /// Draws it; the figure is empty while there are fewer than two samples.
    pub fn draw<'c>(&self, canvas: &'c mut Canvas) -> &'c mut Figure {
        let paths = self.paths(canvas.page);
        let colour = colour_number(self.idx);
        let is_long = paths[0].length() > LONG;
        let met = if is_long { Class::Fine(colour) } else { Class::Trace(colour) };
        canvas.begin(Key::Trace(self.idx), false, Some(self.name.clone()));
        let figure = canvas.figure(Layer::Trace, super::figure::Placement::default());
        for (class, points) in [met, Class::Missed(colour)].into_iter().zip(paths) {
            if !points.is_empty() {
                figure.path(class, points);
            }
        }
        figure
    }

    /// The stretches that met their tolerance, and those that did not.
    fn paths(&self, page: &Page) -> [Path; 2] {
        let mut paths = [Path::default(), Path::default()];
        self.samples.read(|samples| {
            let once = once(samples);
            let lap: Vec<Sample> = once.of(samples).collect();
            let runs = runs(&lap);
            let is_closed = once.is_closed && runs.len() == 1;
            for run in runs {
                let is_missed = run[1].missed;
                let points: Vec<Point> = run.iter().map(|sample| page.px(sample.at)).collect();
                let mut points = thin(&points, TOLERANCE);
                let path = if is_closed {
                    points.pop();
                    Path::polygon(points)
                } else {
                    Path::polyline(points)
                };
                paths[usize::from(is_missed)].append(path);
            }
        });
        paths
    }
}

/// Cuts a path where frames begin or cease to miss their tolerance. Each piece begins with
/// the last sample of the one before, so that nothing is left out between them.
fn runs(samples: &[Sample]) -> Vec<&[Sample]> {
    let mut runs = Vec::new();
    let mut start = 0;
    for k in 1..samples.len() {
        let is_last = k + 1 == samples.len();
        if is_last || samples[k + 1].missed != samples[k].missed {
            runs.push(&samples[start..=k]);
            start = k;
        }
    }
    runs
}

/// The points of a polyline that passes all of `points` within `tolerance`, in one pass: from
/// each point that is kept, as far as all points since lie within the same thin sector.
pub fn thin(points: &[Point], tolerance: f64) -> Vec<Point> {
    let Some(&first) = points.first() else {
        return Vec::new();
    };
    let mut kept = vec![first];
    let mut anchor = first;
    let mut before = first;
    let mut sector = Sector::default();
    for &p in &points[1..] {
        tick(PASS);
        if !sector.admits(p - anchor, tolerance) {
            kept.push(before);
            anchor = before;
            sector = Sector::default();
        }
        sector.narrow(p - anchor, tolerance);
        before = p;
    }
    kept.push(before);
    kept
}

/// The directions from which a line passes all points so far.
#[derive(Debug, Default)]
struct Sector {
    /// A reference direction, and the bounds of the angle against it.
    bounds: Option<(Vector, f64, f64)>,
    /// How far along it the points went.
    reach: f64,
}

impl Sector {
    /// Whether a line that ends at `v` passes all points so far.
    fn admits(&self, v: Vector, tolerance: f64) -> bool {
        let Some((axis, low, high)) = self.bounds else {
            return true;
        };
        let angle = axis.angle_to(v);
        // A path that turns back has a tip that must not be cut off.
        v.norm() + tolerance > self.reach && angle >= low && angle <= high
    }

    fn narrow(&mut self, v: Vector, tolerance: f64) {
        let length = v.norm();
        self.reach = self.reach.max(length);
        // So near the anchor any direction will do.
        let Some(axis) = v.unit().filter(|_| length > tolerance) else {
            return;
        };
        let half = libm::asin(tolerance / length);
        let (axis, low, high) = self.bounds.unwrap_or((axis, -half, half));
        let angle = axis.angle_to(v);
        self.bounds = Some((axis, low.max(angle - half), high.min(angle + half)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest distance of a point from the polyline.
    fn deviation(points: &[Point], line: &[Point]) -> f64 {
        let to_segment = |p: Point, a: Point, b: Point| {
            let v = b - a;
            let k = if v.norm() > 0.0 { (p - a).dot(v) / v.norm_squared() } else { 0.0 };
            p.distance(a + v * k.clamp(0.0, 1.0))
        };
        let to_line = |p: &Point| {
            line.windows(2).map(|s| to_segment(*p, s[0], s[1])).fold(f64::INFINITY, f64::min)
        };
        points.iter().map(to_line).fold(0.0, f64::max)
    }

    #[test]
    fn thinned_lines_pass_all_points() {
        let check = |name: &str, at: &dyn Fn(f64) -> Point, at_most: usize| {
            let points: Vec<Point> = (0..=5000).map(|k| at(f64::from(k) / 5000.0)).collect();
            let line = thin(&points, TOLERANCE);
            assert!(line.len() <= at_most, "{name}: {} points", line.len());
            let worst = deviation(&points, &line);
            assert!(worst <= 2.0 * TOLERANCE, "{name}: {worst}");
            assert_eq!((line[0], line[line.len() - 1]), (points[0], points[5000]), "{name}");
        };
        check("line", &|t| Point::new(300.0 * t, 20.0 * t), 2);
        check("circle", &|t| Vector::polar(200.0, 7.0 * t).to_point(), 120);
        check("there and back", &|t| Point::new(100.0 * libm::sin(20.0 * t), 0.0), 60);
        check("rosette", &|t| Vector::polar(200.0 * libm::cos(28.0 * t), 7.0 * t).to_point(), 800);
        check("one place", &|_| Point::new(3.0, 4.0), 2);
        check("noise", &|t| Point::new(0.02 * libm::sin(1e4 * t), 0.02 * libm::cos(7e3 * t)), 3);
    }

    #[test]
    fn stretches_share_their_ends() {
        let samples: Vec<Sample> = [false, false, true, true, false]
            .iter()
            .enumerate()
            .map(|(k, &missed)| Sample { at: Point::new(k as f64, 0.0), missed })
            .collect();
        let spans: Vec<(f64, f64)> =
            runs(&samples).iter().map(|r| (r[0].at.x, r[r.len() - 1].at.x)).collect();
        assert_eq!(spans, [(0.0, 1.0), (1.0, 3.0), (3.0, 4.0)]);
        assert!(runs(&samples[..1]).is_empty());
    }
}
