//! Expressions become programs: values that are measured on the pose one that the solver runs at
//! every pose it tries, values that follow time one that is run for many frames at once.

use std::collections::BTreeMap;

use super::environments::Here;
use super::known_ahead::TimedValue;
use super::{
    ConstraintId, Depends, Drivers, Formula, Mention, Node, ParameterId, PointId, Record, World,
};
use crate::constraint::{
    Constraint, ConstraintKind as _, Curve, Field, Measured, Operation, PointIdx, Program, Register,
};
use crate::terms::{Function, Member, Operator, Shape};

/// Where the result of a formula is.
#[derive(Debug, Clone, Copy)]
enum Place {
    Number(Register),
    Vector(Register, Register),
}

impl Place {
    fn number(self) -> Register {
        match self {
            Self::Number(register) => register,
            Self::Vector(..) => unreachable!("shapes are checked when a formula is bound"),
        }
    }

    fn vector(self) -> (Register, Register) {
        match self {
            Self::Vector(x, y) => (x, y),
            Self::Number(_) => unreachable!("shapes are checked when a formula is bound"),
        }
    }
}

impl World {
    /// Makes the expressions of a constraint that measure the pose part of it, to be solved with it;
    /// the others are to be evaluated before it is solved.
    pub fn bind(&mut self, record: &mut Record) {
        self.sort_parameters();
        let constraint = record.constraint.stated().clone();
        let mut live = Drivers::new();
        let mut measured = Drivers::new();
        for (field, formula) in record.drivers() {
            // What wheels and speeds turn by is of the pose that a frame begins with.
            let is_rate = *field == Field::Speed || constraint.traits().is_wheel;
            let has_rows = constraint.n_rows() > 0;
            // What is held is nothing without its points; other values are of no more than a place
            // where nothing they mention can move.
            let is_held =
                matches!(field, Field::Value | Field::ValueY | Field::Wanted | Field::Beyond);
            let gives_way = is_held || self.follows_motion(formula);
            let is_measured = has_rows && !is_rate && gives_way && self.depends(formula).on_points;
            let list = if is_measured { &mut measured } else { &mut live };
            list.push((*field, formula.clone()));
        }
        if measured.is_empty() {
            record.bind(constraint, None);
        } else {
            let (constraint, inputs) = self.compile(constraint, &measured);
            live.extend(inputs);
            record.bind(constraint, Some(live));
        }
    }

    /// Binds anew what measures a point, directly or through others, after it was frozen or thawed;
    /// gives that as it was bound before.
    pub(super) fn rebind_measures(&mut self, point: PointId) -> Vec<(ConstraintId, Record)> {
        let mut changed = Vec::new();
        if !self.dependencies.has_measures() {
            return changed;
        }
        let users = self.point_users.of(point, &self.constraints, &self.parameters, &self.measures);
        let (_, constraints) = self.affected(users);
        let measured = |constraint: &Constraint| Field::ALL.map(|field| constraint.measures(field));
        for id in constraints {
            let record = self.constraint(id).expect("a listed constraint lives");
            if !record.drivers().iter().any(|(_, formula)| self.depends(formula).on_points) {
                continue;
            }
            let mut record = record.clone();
            let before = measured(&record.constraint);
            self.bind(&mut record);
            if measured(&record.constraint) != before {
                // What has no value now says so where it is evaluated next.
                let _ = record.drive(&Here::new(self, None));
                self.swap_bound(id, &mut record);
                changed.push((id, record));
            }
        }
        changed
    }

    /// Puts a constraint in the place of the same one that was bound otherwise.
    pub(super) fn swap_bound(&mut self, id: ConstraintId, record: &mut Record) {
        self.touched.constraints.push(id);
        self.dependencies.note_switch(id);
        self.note_constraint(id);
        if let Some(now) = self.constraints.get_mut(id.idx()) {
            std::mem::swap(now, record);
        }
    }

    /// A constraint with measured values, and what its program is given from outside.
    fn compile(&self, constraint: Constraint, measured: &Drivers) -> (Constraint, Drivers) {
        let mut compiler = Compiler::new(self, Following::Pose, constraint.points());
        let values = compiler.values(measured);
        let Compiler { points, program, inputs, .. } = compiler;
        // What has no value now, as while a saved pose is brought back, will be given one.
        let value = |formula: &Formula| formula.evaluate(&Here::new(self, None));
        let numbers = inputs.iter().map(|f| value(f).map_or(f64::NAN, super::Value::number));
        let constraint = Measured::new(constraint, points, program, values, numbers.collect());
        let inputs = (0..).map(Field::Input).zip(inputs).collect();
        (constraint.into(), inputs)
    }

    /// The values of some constraints as functions of time; with the program, what it is given from
    /// outside.
    pub(super) fn compile_in_time(
        &self,
        ids: impl Iterator<Item = ConstraintId>,
        also: impl Iterator<Item = ParameterId>,
    ) -> (Program, Vec<Formula>, Vec<TimedValue>) {
        let mut compiler = Compiler::new(self, Following::Time, &[]);
        let mut values = Vec::new();
        for constraint in ids {
            let record = self.constraint(constraint).expect("a driven constraint lives");
            let own = compiler.values(record.live()).into_iter();
            values.extend(own.map(|(field, register)| TimedValue { constraint, field, register }));
        }
        for parameter in also.filter_map(|id| self.parameter(id)) {
            compiler.compile_parameters(&parameter.formula);
            compiler.compile(&parameter.formula);
        }
        (compiler.program, compiler.inputs, values)
    }

    /// Some values as functions of points in frames: the program, its points and inputs, where the values are.
    pub(super) fn compile_in_frames<'a>(
        &self,
        formulas: impl Iterator<Item = &'a Formula>,
    ) -> (Program, Vec<PointIdx>, Vec<Formula>, Vec<Register>) {
        let mut compiler = Compiler::new(self, Following::Frames, &[]);
        let values = formulas.map(|formula| {
            compiler.compile_parameters(formula);
            compiler.compile(formula).number()
        });
        let values = values.collect();
        (compiler.program, compiler.points, compiler.inputs, values)
    }
}

/// What the values of a program follow.
#[derive(Clone, Copy, PartialEq)]
enum Following {
    /// Where points are at poses that are tried.
    Pose,
    /// Where points are in frames.
    Frames,
    /// The time.
    Time,
}

impl Following {
    /// Whether what depends on this follows it.
    const fn is_meant(self, depends: Depends) -> bool {
        match self {
            Self::Pose | Self::Frames => depends.on_points,
            Self::Time => depends.on_time,
        }
    }
}

/// A program in the making.
struct Compiler<'a> {
    world: &'a World,
    /// What is to be worked out; the rest is given from outside.
    following: Following,
    /// The points it looks at, those of the constraint first.
    points: Vec<PointIdx>,
    program: Program,
    /// Where the coordinates of points are.
    of_points: BTreeMap<PointIdx, (Register, Register)>,
    /// Where the values of parameters are that measure the pose.
    of_parameters: BTreeMap<ParameterId, Place>,
    /// What it is given from outside.
    inputs: Vec<Formula>,
}

impl<'a> Compiler<'a> {
    fn new(world: &'a World, following: Following, points: &[PointIdx]) -> Self {
        Self {
            world,
            following,
            points: points.to_vec(),
            program: Program::default(),
            of_points: BTreeMap::new(),
            of_parameters: BTreeMap::new(),
            inputs: Vec::new(),
        }
    }

    /// Compiles expressions for some values; gives where these are.
    fn values(&mut self, expressions: &[(Field, Formula)]) -> Vec<(Field, Register)> {
        let mut last: Option<(&Formula, Place)> = None;
        let mut values = Vec::with_capacity(expressions.len());
        for (field, formula) in expressions {
            let place = match last {
                // Both ends of an equality, both coordinates of a place.
                Some((before, place)) if before.is_same(formula) => place,
                _ => {
                    self.compile_parameters(formula);
                    self.compile(formula)
                }
            };
            last = Some((formula, place));
            let register = match (place, field) {
                (Place::Number(register), _) => register,
                (Place::Vector(x, _), Field::X | Field::Value) => x,
                (Place::Vector(_, y), _) => y,
            };
            values.push((*field, register));
        }
        values
    }

    /// Compiles the parameters that a formula mentions and that are to be worked out, each after those
    /// it mentions: a chain of them may be longer than calls can be deep.
    fn compile_parameters(&mut self, formula: &Formula) {
        let mut open: Vec<(ParameterId, bool)> = self.wanted(formula);
        while let Some((id, is_ready)) = open.pop() {
            if self.of_parameters.contains_key(&id) {
                continue;
            }
            let parameter = self.world.parameter(id).expect("a mentioned parameter lives");
            if is_ready {
                let place = self.compile(&parameter.formula);
                self.of_parameters.insert(id, place);
            } else {
                open.push((id, true));
                open.extend(self.wanted(&parameter.formula));
            }
        }
    }

    /// The parameters that a formula mentions, itself or by a member, and that are to be worked out; none
    /// of them is ready.
    fn wanted(&self, formula: &Formula) -> Vec<(ParameterId, bool)> {
        let mut wanted = Vec::new();
        let mut open = vec![formula.clone()];
        while let Some(formula) = open.pop() {
            formula.mentions(&mut |mention| match mention {
                Mention::Member(id, Member::Radius) => {
                    open.extend(self.world.radius_driver(id).cloned());
                }
                Mention::Member(id, Member::Value) => open.push(self.world.measured_by(id)),
                Mention::Parameter(id) => {
                    let parameter = self.world.parameter(id);
                    let is_inside = parameter.is_some_and(|it| self.following.is_meant(it.depends));
                    wanted.extend(is_inside.then_some((id, false)));
                }
                _ => {}
            });
        }
        wanted
    }

    fn push(&mut self, operation: Operation) -> Register {
        self.program.push(operation)
    }

    fn binary(&mut self, operator: Operator, a: Register, b: Register) -> Register {
        self.push(Operation::Binary(operator, a, b))
    }

    fn subtract(
        &mut self,
        a: (Register, Register),
        b: (Register, Register),
    ) -> (Register, Register) {
        (self.binary(Operator::Subtract, a.0, b.0), self.binary(Operator::Subtract, a.1, b.1))
    }

    fn scale(&mut self, v: (Register, Register), k: Register) -> Place {
        let x = self.binary(Operator::Multiply, v.0, k);
        Place::Vector(x, self.binary(Operator::Multiply, v.1, k))
    }

    fn dot(&mut self, a: (Register, Register), b: (Register, Register)) -> Register {
        let x = self.binary(Operator::Multiply, a.0, b.0);
        let y = self.binary(Operator::Multiply, a.1, b.1);
        self.binary(Operator::Add, x, y)
    }

    fn cross(&mut self, a: (Register, Register), b: (Register, Register)) -> Register {
        let x = self.binary(Operator::Multiply, a.0, b.1);
        let y = self.binary(Operator::Multiply, a.1, b.0);
        self.binary(Operator::Subtract, x, y)
    }

    fn point(&mut self, id: PointId) -> (Register, Register) {
        if let Some(&place) = self.of_points.get(&id.0) {
            return place;
        }
        let known = self.points.iter().position(|&p| p == id.0);
        let k = known.unwrap_or_else(|| {
            self.points.push(id.0);
            self.points.len() - 1
        }) as u32;
        let place = (self.push(Operation::X(k)), self.push(Operation::Y(k)));
        self.of_points.insert(id.0, place);
        place
    }

    /// A number from outside.
    fn input(&mut self, formula: &Formula) -> Register {
        let known = self.inputs.iter().position(|input| input.is_same(formula));
        let k = known.unwrap_or_else(|| {
            self.inputs.push(formula.clone());
            self.inputs.len() - 1
        });
        self.push(Operation::Input(k as u32))
    }

    fn compile(&mut self, formula: &Formula) -> Place {
        let depends = self.world.depends(formula);
        if !self.following.is_meant(depends) && !depends.is_constant() {
            return match formula.shape() {
                Shape::Number => Place::Number(self.input(formula)),
                Shape::Vector => {
                    let (span, depends) = (formula.span(), formula.depends());
                    let part = |node| Formula::new(node, Shape::Number, depends, span);
                    let x = self.input(&part(Node::X(formula.clone())));
                    Place::Vector(x, self.input(&part(Node::Y(formula.clone()))))
                }
            };
        }
        match formula.node() {
            Node::Number(n, _) => Place::Number(self.push(Operation::Constant(*n))),
            Node::Point(id) => {
                let (x, y) = self.point(*id);
                Place::Vector(x, y)
            }
            Node::Parameter(id) => self.of_parameters[id],
            Node::Vector(x, y) => {
                let x = self.compile(x).number();
                Place::Vector(x, self.compile(y).number())
            }
            Node::X(v) => Place::Number(self.compile(v).vector().0),
            Node::Y(v) => Place::Number(self.compile(v).vector().1),
            Node::Negate(a) => match self.compile(a) {
                Place::Number(a) => Place::Number(self.push(Operation::Negate(a))),
                Place::Vector(x, y) => {
                    let x = self.push(Operation::Negate(x));
                    Place::Vector(x, self.push(Operation::Negate(y)))
                }
            },
            Node::Binary(operator, a, b) => {
                let (a, b) = (self.compile(a), self.compile(b));
                match (a, b) {
                    (Place::Number(a), Place::Number(b)) => {
                        Place::Number(self.binary(*operator, a, b))
                    }
                    (Place::Vector(ax, ay), Place::Vector(bx, by)) => {
                        let x = self.binary(*operator, ax, bx);
                        Place::Vector(x, self.binary(*operator, ay, by))
                    }
                    (Place::Vector(x, y), Place::Number(k)) => {
                        let x = self.binary(*operator, x, k);
                        Place::Vector(x, self.binary(*operator, y, k))
                    }
                    (Place::Number(k), Place::Vector(x, y)) => self.scale((x, y), k),
                }
            }
            Node::Call(function, arguments) => {
                let place = self.call(*function, arguments);
                if !function.counts_turns() {
                    return place;
                }
                // The whole turns are those that it had when the frame began.
                let before = self.input(formula);
                Place::Number(self.push(Operation::NearestTurn(place.number(), before)))
            }
            Node::Member(id, Member::Radius) => self.radius(*id),
            Node::Member(id, Member::Value) => self.compile(&self.world.measured_by(*id)),
            Node::Time => Place::Number(self.input(formula)),
            Node::Member(..) | Node::Statistic(..) => {
                unreachable!("what does not measure the pose is an input")
            }
        }
    }

    /// The radius of a circle or an arc.
    fn radius(&mut self, id: ConstraintId) -> Place {
        let ends = match *self.world.curve(id).expect("only a circle or an arc has a radius") {
            Curve::Through { points: [o, p] } | Curve::Arc { points: [o, p, _] } => [o, p],
            Curve::Circle { radius, .. } => {
                return match self.world.radius_driver(id) {
                    Some(formula) => self.compile(formula),
                    None => Place::Number(self.push(Operation::Constant(radius))),
                };
            }
        };
        let [o, p] = ends.map(|p| self.point(PointId(p)));
        let (x, y) = self.subtract(p, o);
        Place::Number(self.push(Operation::Norm(x, y)))
    }

    /// The angle of a vector. That of nothing is none, but at a pose that is tried it is 0.
    fn angle(&mut self, x: Register, y: Register) -> Register {
        let size = match self.following {
            Following::Pose => None,
            Following::Time => Some(self.push(Operation::Norm(x, y))),
            // One that is out of all numbers is looked at frame by frame.
            Following::Frames => Some(self.dot((x, y), (x, y))),
        };
        if let Some(size) = size {
            self.binary(Operator::Divide, size, size);
        }
        self.push(Operation::OfTwo(Function::Atan2, y, x))
    }

    fn call(&mut self, function: Function, arguments: &[Formula]) -> Place {
        let places: Vec<Place> = arguments.iter().map(|a| self.compile(a)).collect();
        let number = |k: usize| places[k].number();
        let vector = |k: usize| places[k].vector();
        Place::Number(match function {
            Function::Norm => {
                let (x, y) = vector(0);
                self.push(Operation::Norm(x, y))
            }
            Function::Dot => self.dot(vector(0), vector(1)),
            Function::Cross => self.cross(vector(0), vector(1)),
            Function::Rotate => {
                let ((x, y), phi) = (vector(0), number(1));
                let [cos, sin] = self.cos_and_sin(phi);
                let v = (cos, self.push(Operation::Negate(sin)));
                let turned = self.dot((x, y), v);
                return Place::Vector(turned, self.dot((x, y), (sin, cos)));
            }
            Function::Polar => {
                let (r, phi) = (number(0), number(1));
                let [cos, sin] = self.cos_and_sin(phi);
                return self.scale((cos, sin), r);
            }
            Function::Midpoint => {
                let ((ax, ay), (bx, by)) = (vector(0), vector(1));
                let sum = (self.binary(Operator::Add, ax, bx), self.binary(Operator::Add, ay, by));
                let half = self.push(Operation::Constant(0.5));
                return self.scale(sum, half);
            }
            Function::Distance => {
                let (x, y) = self.subtract(vector(1), vector(0));
                self.push(Operation::Norm(x, y))
            }
            Function::DistanceToLine => {
                let line = self.subtract(vector(2), vector(1));
                let to_point = self.subtract(vector(0), vector(1));
                let area = self.cross(line, to_point);
                let length = self.push(Operation::Norm(line.0, line.1));
                self.binary(Operator::Divide, area, length)
            }
            Function::Angle | Function::Turn => {
                let (x, y) = self.subtract(vector(1), vector(0));
                self.angle(x, y)
            }
            Function::AngleBetween | Function::TurnBetween => {
                let u = self.subtract(vector(1), vector(0));
                let v = self.subtract(vector(3), vector(2));
                let (along, across) = (self.dot(u, v), self.cross(u, v));
                self.angle(along, across)
            }
            Function::Clamp => {
                let (x, lo, hi) = (number(0), number(1), number(2));
                let x = self.push(Operation::OfTwo(Function::Min, x, hi));
                let lo = self.push(Operation::LowerEnd(lo, hi));
                self.push(Operation::OfTwo(Function::Max, x, lo))
            }
            _ if function.is_rate() => unreachable!("no rate drives a constraint"),
            _ => {
                let mut numbers = places.iter().map(|place| place.number());
                let first = numbers.next().expect("a function has an argument");
                let rest: Vec<Register> = numbers.collect();
                match rest[..] {
                    [] => self.push(Operation::Of(function, first)),
                    _ => rest
                        .into_iter()
                        .fold(first, |sum, next| self.push(Operation::OfTwo(function, sum, next))),
                }
            }
        })
    }

    fn cos_and_sin(&mut self, phi: Register) -> [Register; 2] {
        [Function::Cos, Function::Sin].map(|function| self.push(Operation::Of(function, phi)))
    }
}
