//! A world built, driven and solved in a few words, for the tests of the solver.

use linkwork::constraint::{
    Bounds, Constraint, ConstraintKind, Coordinate, Field, Glider, Length, Motor, Point,
};
use linkwork::solve::{Budget, Report, Settings, Solver};
use linkwork::world::{Clock, ConstraintId, Edit, PointId, PointRecord, Record, World};

/// A world with its solver and settings.
#[derive(Default)]
pub struct Scene {
    pub world: World,
    pub solver: Solver,
    pub settings: Settings,
}

impl Scene {
    /// An empty scene whose frames last a 360th of a time unit.
    pub fn new() -> Self {
        let mut scene = Self::default();
        scene.frames_per_unit(360.0);
        scene
    }

    /// Sets the length of a frame.
    pub fn frames_per_unit(&mut self, n: f64) {
        let clock = self.world.clock().with_dt(1.0 / n);
        self.world.apply(Edit::Clock(Box::new(Clock { base_frame: 0, ..clock })));
    }

    fn add_point(&mut self, x: f64, y: f64, is_frozen: bool) -> PointId {
        let id = self.world.next_point();
        let at = Point::new(x, y);
        let name = format!("p{}", id.0).into();
        let record = PointRecord { name, at, start: at, is_frozen, weight: 1.0 };
        self.world.apply(Edit::Point(id, Some(Box::new(record))));
        id
    }

    pub fn point(&mut self, x: f64, y: f64) -> PointId {
        self.add_point(x, y, false)
    }

    pub fn ground(&mut self, x: f64, y: f64) -> PointId {
        self.add_point(x, y, true)
    }

    pub fn add(&mut self, constraint: impl Into<Constraint>) -> ConstraintId {
        let id = self.world.next_constraint();
        let name = format!("c{}", id.0).into();
        let record = Record::new(name, constraint.into(), Vec::new());
        self.world.apply(Edit::Constraint(id, Some(Box::new(record))));
        id
    }

    pub fn length(&mut self, a: PointId, b: PointId, l: f64) -> ConstraintId {
        self.within(a, b, l, l)
    }

    pub fn within(&mut self, a: PointId, b: PointId, lo: f64, hi: f64) -> ConstraintId {
        self.add(Length { points: [a.0, b.0], bounds: Bounds { lo, hi } })
    }

    /// A motor of one turn a time unit.
    pub fn motor(&mut self, o: PointId, p: PointId, radius: f64, phase: f64) -> ConstraintId {
        self.add(Motor::new([o.0, p.0], radius, phase, std::f64::consts::TAU))
    }

    pub fn glider(&mut self, p: PointId, a: PointId, b: PointId) -> ConstraintId {
        self.add(Glider { points: [p.0, a.0, b.0], bounded: true })
    }

    pub fn coordinate(&mut self, p: PointId, x: f64, y: f64) -> ConstraintId {
        self.add(Coordinate { points: [p.0], target: Point::new(x, y) })
    }

    /// Sets a value of a constraint, as `change` would.
    pub fn set(&mut self, id: ConstraintId, field: Field, value: f64) {
        let mut record = self.world.constraint(id).expect("it was made").clone();
        record.constraint.set(field, value);
        self.world.apply(Edit::Constraint(id, Some(Box::new(record))));
    }

    pub fn move_to(&mut self, p: PointId, x: f64, y: f64) {
        self.world.apply(Edit::Move(p, Point::new(x, y)));
    }

    /// One frame: the clock goes on, the solver works.
    pub fn step(&mut self) -> Report {
        self.drive(|_| {})
    }

    /// Moves a frozen point along with the clock and solves the frame.
    pub fn drag(&mut self, p: PointId, x: f64, y: f64) -> Report {
        self.drive(|s| s.move_to(p, x, y))
    }

    /// One frame in which `hand` acts as the clock goes on.
    pub fn drive(&mut self, hand: impl FnOnce(&mut Self)) -> Report {
        self.solver.sync(&mut self.world, &self.settings);
        hand(self);
        self.world.advance().expect("no live expressions here");
        self.solver.frame(&mut self.world, &self.settings, &Budget::default())
    }

    pub fn settle(&mut self) -> Report {
        self.solver.settle(&mut self.world, &self.settings, &Budget::default())
    }

    pub fn at(&self, p: PointId) -> Point {
        self.world.points().at(p)
    }

    /// The largest distance to satisfaction, length units.
    pub fn worst(&self) -> f64 {
        let ids = self.world.constraints().map(|(id, _)| id);
        ids.map(|id| self.solver.violation(&self.world, id)).fold(0.0, f64::max)
    }

    /// All coordinates, to the bit.
    pub fn bits(&self) -> Vec<u64> {
        let points = self.world.points();
        points.ids().flat_map(|p| [points.at(p).x.to_bits(), points.at(p).y.to_bits()]).collect()
    }
}

/// A crank of radius `a` about (0, 0), a coupler `b`, a rocker `c` about (d, 0).
pub struct FourBar {
    pub crank: PointId,
    pub rocker: PointId,
    pub motor: ConstraintId,
}

pub fn four_bar(s: &mut Scene, [a, b, c, d]: [f64; 4], phase: f64, start: (f64, f64)) -> FourBar {
    let (o, q) = (s.ground(0.0, 0.0), s.ground(d, 0.0));
    let crank = s.point(a * phase.cos(), a * phase.sin());
    let rocker = s.point(start.0, start.1);
    let motor = s.motor(o, crank, a, phase);
    s.length(crank, rocker, b);
    s.length(rocker, q, c);
    FourBar { crank, rocker, motor }
}

/// Theo Jansen's leg; gives the crank pin and the foot.
pub fn jansen(s: &mut Scene) -> [PointId; 2] {
    let (o, q) = (s.ground(0.0, 0.0), s.ground(-38.0, -7.8));
    let m = s.point(15.0, 0.0);
    let a = s.point(-22.0, 34.0);
    let b = s.point(-75.0, 1.0);
    let c = s.point(-61.0, -35.0);
    let d = s.point(-23.0, -46.0);
    let foot = s.point(-43.0, -85.0);
    s.motor(o, m, 15.0, 0.0);
    for (from, to, l) in [
        (m, a, 50.0),
        (a, q, 41.5),
        (m, d, 61.9),
        (d, q, 39.3),
        (q, b, 40.1),
        (a, b, 55.8),
        (b, c, 39.4),
        (c, d, 36.7),
        (c, foot, 65.7),
        (d, foot, 49.0),
    ] {
        s.length(from, to, l);
    }
    [m, foot]
}

/// Peaucellier's cell; gives the crank and the point on the straight line.
pub fn peaucellier(s: &mut Scene) -> [PointId; 2] {
    let (o, q) = (s.ground(0.0, 0.0), s.ground(2.0, 0.0));
    let p = s.point(4.0, 0.0);
    let (a, b) = (s.point(5.5, 2.5), s.point(5.5, -2.5));
    let out = s.point(7.0, 0.0);
    s.add(Motor::new([q.0, p.0], 2.0, 0.0, 0.0));
    for (from, to, l) in
        [(o, a, 6.0), (o, b, 6.0), (p, a, 3.0), (p, b, 3.0), (a, out, 3.0), (b, out, 3.0)]
    {
        s.length(from, to, l);
    }
    [p, out]
}
