//! Which symbols the constraints and points of a world are drawn as.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::figure::Key;
use super::symbols::{
    Angle, Arrows, AxisMark, Belt, Block, Construction, Cord, Crank, Cross, Dimension, Equation,
    Gears, Joint, Link, Multiple, Plate, Rail, Ring, Rod, Round, Sense, Support, Symbol,
    SymbolForm, Symmetry, Telescope, Ticks, TouchMark, Toucher, Web,
};
use crate::constraint::{
    Bounds, Constraint, ConstraintKind, Contact, Curve, Equal, Field, Length, Orientation, Point,
    PointIdx, Touch,
};
use crate::diag::format_rounded;
use crate::interrupt::tick;
use crate::linalg::DisjointSets;
use crate::world::{ConstraintId, Record, World};

/// Triangles of rods are looked for among at most so many rods: a net of a thousand is a net
/// without a filling too.
const MOST_RODS: usize = 400;

/// What a look at a constraint or a pair of points takes, in ticks.
const LOOK: usize = 50;

/// The symbols of a world, in order of creation, points last.
pub fn symbols(world: &World) -> Vec<Symbol> {
    let mut classifier = Classifier::new(world);
    for (_, record) in world.constraints() {
        classifier.bars(record);
        classifier.segments(record);
    }
    for (id, record) in world.constraints() {
        classifier.constraint(id, record);
    }
    classifier.webs();
    classifier.gears();
    classifier.joints();
    classifier.symbols
}

struct Classifier<'a> {
    world: &'a World,
    at: &'a [Point],
    symbols: Vec<Symbol>,
    /// What a bar or an edge connects; a mark there needs no line of its own.
    connected: BTreeSet<[PointIdx; 2]>,
    /// Rods that are on, lower end first.
    rods: BTreeSet<[PointIdx; 2]>,
    /// Centres of motors that have a disc.
    driven: BTreeMap<PointIdx, u8>,
    equal: Marks,
    parallel: Marks,
    /// How many pairs of lengths in a ratio have a letter.
    n_multiples: u8,
    gears_on: Gears,
    gears_off: Gears,
    /// Whose each mesh is, those that are on and those that are off.
    meshes: [Vec<(ConstraintId, Arc<str>)>; 2],
}

/// How many strokes mark each of several classes of segments.
#[derive(Default)]
struct Marks {
    number_of: BTreeMap<[PointIdx; 2], usize>,
    groups: DisjointSets,
    /// The classes, by their least member, each with its place in the order of appearance.
    classes: BTreeMap<usize, usize>,
}

impl Marks {
    fn join(&mut self, [a, b, c, d]: [PointIdx; 4]) {
        let [s, t] = [[a, b], [c, d]].map(|ends| {
            let n = self.number_of.len();
            *self.number_of.entry(sorted(ends)).or_insert(n)
        });
        self.groups.join(s, t);
    }

    /// One to three strokes: more cannot be told apart at a glance.
    fn n_strokes(&mut self, ends: [PointIdx; 2]) -> u8 {
        let class = self.groups.least(self.number_of[&sorted(ends)]);
        let n = self.classes.len();
        let idx = *self.classes.entry(class).or_insert(n);
        (idx % 3) as u8 + 1
    }
}

fn sorted([a, b]: [PointIdx; 2]) -> [PointIdx; 2] {
    [a.min(b), a.max(b)]
}

/// Whether two directions are asked to be the same or opposite.
fn is_parallel(orientation: &Orientation) -> bool {
    let Bounds { lo, .. } = orientation.bounds;
    orientation.bounds.is_equality() && libm::sin(lo).abs() < 1e-9
}

/// Whether lengths are compared as they are, and not one with a multiple of the other.
fn is_one_length(record: &Record) -> bool {
    record.constraint.get(Field::Ratio) == Some(1.0) && record.driver(Field::Ratio).is_none()
}

/// The points of a constraint that holds this many.
fn points<const N: usize>(constraint: &Constraint) -> [PointIdx; N] {
    constraint.points().try_into().expect("a kind with this many points")
}

impl<'a> Classifier<'a> {
    fn new(world: &'a World) -> Self {
        Self {
            world,
            at: world.points().column(),
            symbols: Vec::new(),
            connected: BTreeSet::new(),
            rods: BTreeSet::new(),
            driven: BTreeMap::new(),
            equal: Marks::default(),
            parallel: Marks::default(),
            n_multiples: 0,
            gears_on: Gears::default(),
            gears_off: Gears::default(),
            meshes: [Vec::new(), Vec::new()],
        }
    }

    /// Notes what a constraint connects.
    fn bars(&mut self, record: &Record) {
        tick(LOOK);
        let mut connect = |a, b| _ = self.connected.insert(sorted([a, b]));
        let stated = record.constraint.stated();
        match (stated, stated.points()) {
            (Constraint::Length(length), &[a, b]) => {
                connect(a, b);
                if record.is_on && length.bounds.is_equality() {
                    self.rods.insert(sorted([a, b]));
                }
            }
            (Constraint::Motor(_), &[a, b, ..])
            | (Constraint::Glider(_) | Constraint::Hinge(_), &[_, a, b]) => connect(a, b),
            (
                Constraint::Cog(_) | Constraint::CogVelocity(_) | Constraint::Rack(_),
                &[a, b, c, d],
            ) => {
                connect(a, b);
                connect(c, d);
            }
            (Constraint::Rigid(_), points) => {
                for (k, &b) in points.iter().enumerate() {
                    tick(LOOK * k);
                    points[..k].iter().for_each(|&a| connect(a, b));
                }
            }
            _ => {}
        }
    }

    /// Notes which segments a constraint makes alike.
    fn segments(&mut self, record: &Record) {
        match record.constraint.stated() {
            Constraint::Equal(equal) if is_one_length(record) => self.equal.join(equal.points),
            Constraint::Equivalence(equivalence) => self.parallel.join(equivalence.points),
            Constraint::Orientation(orientation) if is_parallel(orientation) => {
                self.parallel.join(orientation.points);
            }
            _ => {}
        }
    }

    fn constraint(&mut self, id: ConstraintId, record: &Record) {
        tick(LOOK);
        let stated = record.constraint.at(self.at);
        match &*stated {
            Constraint::Coordinate(c) => {
                self.add(id, record, Cross { point: c.points[0], target: c.target });
            }
            Constraint::Coincidence(c) => self.add(id, record, Ring { points: c.points }),
            Constraint::Equivalence(c) => {
                self.carry(id, record, c.points);
                self.arrows(id, record, c.points);
            }
            Constraint::Equal(c) => {
                self.carry(id, record, c.points);
                if !is_one_length(record) {
                    return self.multiple(id, record, c);
                }
                let [a, b, ..] = c.points;
                let n_ticks = self.equal.n_strokes([a, b]);
                self.add(id, record, Ticks { points: c.points, n_ticks });
            }
            Constraint::Length(c) => self.length(id, record, c),
            Constraint::Orientation(c) => {
                self.carry(id, record, c.points);
                if is_parallel(c) {
                    self.arrows(id, record, c.points);
                } else {
                    self.add(id, record, Angle { points: c.points });
                }
            }
            Constraint::Motor(c) => {
                let sense = Sense::of(stated.get(Field::Speed).unwrap_or(0.0));
                let crank = c.crank();
                let n_motors = self.driven.entry(crank[0]).or_default();
                let rank = *n_motors;
                *n_motors = n_motors.saturating_add(1);
                if let Some([s, e]) = c.measured_from() {
                    self.add(id, record, Angle { points: [s, e, crank[0], crank[1]] });
                }
                self.add(id, record, Crank { points: crank, sense, rank });
            }
            Constraint::Glider(c) => {
                let [block, a, b] = c.points;
                self.add(id, record, Rail { block, ends: [a, b], is_bounded: c.bounded });
            }
            Constraint::Hinge(c) => {
                let [pin, a, b] = c.points;
                self.add(id, record, Link { pin, ends: [a, b], ratio: c.ratio });
            }
            Constraint::Cog(c) if c.contact() != Contact::Mesh => {
                let is_crossed = c.contact() == Contact::CrossedBelt;
                let ratio = record.constraint.get(Field::Ratio).unwrap_or(1.0);
                self.add(id, record, Belt { points: c.points, ratio, is_crossed });
            }
            Constraint::Cog(_) | Constraint::CogVelocity(_) | Constraint::Rack(_) => {
                self.mesh(id, record);
            }
            Constraint::Distance(c) => {
                let [point, a, b] = c.points;
                self.connection(id, record, [a, b]);
                self.add(id, record, Dimension { point, line: [a, b] });
            }
            Constraint::Rigid(_) => match *stated.points() {
                [a, b] => self.add(id, record, Rod { points: [a, b] }),
                ref points => self.add(id, record, Plate::new(points, self.at)),
            },
            Constraint::Symmetric(c) => {
                let [a, b, p, q] = c.points;
                self.add(id, record, Symmetry { points: [a, b], axis: [p, q] });
            }
            Constraint::Aligned(c) => {
                self.connection(id, record, c.points);
                self.add(id, record, AxisMark { points: c.points, direction: c.direction });
            }
            Constraint::Curve(c) => {
                let mut curve = c.clone();
                if let Curve::Circle { radius, .. } = &mut curve {
                    *radius = self.world.radius_now(id);
                }
                self.add(id, record, Round { curve });
            }
            Constraint::Touch(c) => self.touch(id, record, c),
            Constraint::Hold(_) => self.equation(id, record),
            Constraint::Measured(_) => unreachable!("what is stated measures nothing"),
        }
    }

    fn add(&mut self, id: ConstraintId, record: &Record, form: impl Into<SymbolForm>) {
        self.symbols.push(Symbol {
            key: Key::Constraint(id),
            name: Arc::from(&*record.name),
            is_off: !record.is_on,
            form: form.into(),
        });
    }

    /// Gives two segments lines where no bars are, for marks to hang on.
    fn carry(&mut self, id: ConstraintId, record: &Record, [a, b, c, d]: [PointIdx; 4]) {
        self.connection(id, record, [a, b]);
        self.connection(id, record, [c, d]);
    }

    fn connection(&mut self, id: ConstraintId, record: &Record, ends: [PointIdx; 2]) {
        if self.connected.insert(sorted(ends)) {
            self.add(id, record, Construction { points: ends });
        }
    }

    /// Two lengths in a ratio, by the next letter.
    fn multiple(&mut self, id: ConstraintId, record: &Record, equal: &Equal) {
        let letter = char::from(b'a' + self.n_multiples);
        self.n_multiples = (self.n_multiples + 1) % 26;
        let texts = [format!("{}{letter}", format_rounded(equal.ratio)), letter.to_string()];
        let texts = texts.map(Arc::from);
        self.add(id, record, Multiple { points: equal.points, texts });
    }

    fn arrows(&mut self, id: ConstraintId, record: &Record, points: [PointIdx; 4]) {
        let [a, b, ..] = points;
        let n_chevrons = self.parallel.n_strokes([a, b]);
        self.add(id, record, Arrows { points, n_chevrons });
    }

    fn touch(&mut self, id: ConstraintId, record: &Record, touch: &Touch) {
        let curve = |k: usize| self.world.curve(ConstraintId(touch.curves()[k]));
        let Some(first) = curve(0).cloned() else { return };
        if touch.is_glider() {
            let (block, centre) = (touch.points()[0], first.points()[0]);
            return self.add(id, record, Block { block, centre });
        }
        let other = match (touch.at(), touch.line()) {
            (Some(p), _) => Toucher::At(p),
            (None, Some(ends)) => {
                self.connection(id, record, ends);
                Toucher::Line(ends)
            }
            (None, None) => match touch.curves().get(1).and_then(|_| curve(1)) {
                Some(second) => Toucher::Circle(second.points()[0]),
                None => return,
            },
        };
        self.add(id, record, TouchMark { curve: first, other });
    }

    /// An equation at what it measures: at segments whose length or direction it mentions, at its
    /// other points by themselves.
    fn equation(&mut self, id: ConstraintId, record: &Record) {
        let mut segments: Vec<[PointIdx; 2]> = Vec::new();
        for (_, formula) in record.drivers() {
            formula.segments(&mut |ends| {
                tick(segments.len());
                let ends = sorted(ends.map(|p| p.0));
                if !segments.contains(&ends) {
                    segments.push(ends);
                }
            });
        }
        let is_alone = |p: &&PointIdx| !segments.iter().flatten().any(|q| q == *p);
        let points: Vec<PointIdx> =
            record.constraint.points().iter().filter(is_alone).copied().collect();
        segments.iter().for_each(|&ends| self.connection(id, record, ends));
        let is_equality = record.constraint.traits().bounds.is_none_or(Bounds::is_equality);
        self.add(id, record, Equation { segments, points, is_equality });
    }

    fn length(&mut self, id: ConstraintId, record: &Record, length: &Length) {
        let points = length.points;
        let Bounds { lo, hi } = length.bounds;
        let is_driven = record.drivers().iter().any(|(_, formula)| formula.depends().is_live());
        if length.bounds.is_equality() && !is_driven {
            self.add(id, record, Rod { points });
        } else if length.bounds.is_equality() {
            // The outer stage of an actuator has a length of its own; where it stood when
            // the clock started is one that every frame agrees on.
            let [a, b] = points.map(|p| self.world.points().start(crate::world::PointId(p)));
            self.add(id, record, Telescope { points, outer: 0.55 * a.distance(b) });
        } else if lo > 0.0 {
            self.add(id, record, Telescope { points, outer: lo });
        } else if hi.is_finite() {
            self.add(id, record, Cord { points, length: hi });
        }
    }

    fn mesh(&mut self, id: ConstraintId, record: &Record) {
        let gears = if record.is_on { &mut self.gears_on } else { &mut self.gears_off };
        let four = points(&record.constraint);
        if let Constraint::Rack(rack) = &record.constraint {
            gears.add_rack(four, rack.radius().abs(), rack.has_said_radius());
        } else {
            gears.add_pair(four, record.constraint.get(Field::Ratio).unwrap_or(1.0), self.at);
        }
        self.meshes[usize::from(!record.is_on)].push((id, Arc::from(&*record.name)));
    }

    fn gears(&mut self) {
        let gears = [std::mem::take(&mut self.gears_on), std::mem::take(&mut self.gears_off)];
        for (k, gears) in gears.into_iter().enumerate() {
            for (mesh, train) in gears.trains() {
                let (id, name) = self.meshes[k][mesh].clone();
                let form = SymbolForm::Train(train);
                self.symbols.push(Symbol { key: Key::Constraint(id), name, is_off: k == 1, form });
            }
        }
    }

    /// Fills the triangles of rods.
    fn webs(&mut self) {
        if self.rods.len() > MOST_RODS {
            return;
        }
        let mut neighbours: BTreeMap<PointIdx, Vec<PointIdx>> = BTreeMap::new();
        for &[a, b] in &self.rods {
            neighbours.entry(a).or_default().push(b);
        }
        for (&a, higher) in &neighbours {
            for (k, &b) in higher.iter().enumerate() {
                for &c in &higher[k + 1..] {
                    if self.rods.contains(&[b, c]) {
                        let points = [a, b, c];
                        self.symbols.push(Symbol {
                            key: Key::Triangle(points),
                            name: "".into(),
                            is_off: false,
                            form: Web { points }.into(),
                        });
                    }
                }
            }
        }
    }

    fn joints(&mut self) {
        let points = self.world.points();
        for id in points.ids() {
            tick(LOOK);
            let is_driven = self.driven.contains_key(&id.0);
            let support = match (points.is_frozen(id), is_driven) {
                (false, _) => Support::Free,
                (true, false) => Support::Frozen,
                (true, true) => Support::FrozenMotor,
            };
            let name: Arc<str> = points.name(id).into();
            let form = Joint { point: id.0, name: name.clone(), support, is_driven }.into();
            self.symbols.push(Symbol { key: Key::Point(id), name, is_off: false, form });
        }
    }
}
