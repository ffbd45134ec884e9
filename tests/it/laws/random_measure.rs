//! Constraints whose values are measured on the pose.

use linkwork::constraint::{
    Constraint, ConstraintKind as _, Field, Measured, Operation, PointIdx, Program, Quantity,
    Register,
};
use linkwork::terms::{Function, Operator};

use super::random_constraint::{Scene, Similarity};

/// A constraint of a scene with all values that can be measured on two pairs of its points: lengths
/// as parts of the one, angles against the angle between both, places half way. What is measured
/// moves, turns and stretches with the plane.
pub fn measured(scene: &Scene, base: Constraint, by: Similarity) -> Constraint {
    let fields: Vec<Field> =
        Field::ALL.into_iter().filter(|&field| can_be_measured(&base, field)).collect();
    if fields.is_empty() {
        return base;
    }
    let mut measure = Measure::new(scene, &base, by);
    let mut values: Vec<(Field, Register)> = Vec::new();
    for &field in &fields {
        let is_one = field == Field::Hi && base.get(Field::Lo) == base.get(Field::Hi);
        let register = match values.last() {
            Some(&(Field::Lo, register)) if is_one => register,
            _ => measure.value(&base, field),
        };
        values.push((field, register));
    }
    Measured::new(base, measure.points, measure.program, values, Vec::new()).into()
}

fn can_be_measured(base: &Constraint, field: Field) -> bool {
    let is_rate = field == Field::Speed || base.traits().is_wheel;
    !is_rate && base.get(field).is_some_and(f64::is_finite)
}

struct Measure {
    points: Vec<PointIdx>,
    program: Program,
    /// The coordinates of four points.
    at: [[Register; 2]; 4],
    /// How far the first two were apart.
    unit: f64,
}

impl Measure {
    fn new(scene: &Scene, base: &Constraint, by: Similarity) -> Self {
        let n = scene.points.len();
        let looked_at = [0, 1, 2, 3].map(|k| scene.points[n - 1 - k]);
        let mut points = base.points().to_vec();
        let mut program = Program::default();
        let at = looked_at.map(|p| {
            let known = points.iter().position(|&q| q == p);
            let k = known.unwrap_or_else(|| {
                points.push(p);
                points.len() - 1
            }) as u32;
            [Operation::X(k), Operation::Y(k)].map(|operation| program.push(operation))
        });
        let [a, b] = [looked_at[0], looked_at[1]].map(|p| scene.before[p as usize]);
        Self { points, program, at, unit: by.scale * (a.distance(b) + 0.1) }
    }

    fn value(&mut self, base: &Constraint, field: Field) -> Register {
        let value = base.get(field).expect("a value that it has");
        let is_angle = base.traits().quantity == Quantity::Angle || field == Field::Phase;
        match field {
            Field::X | Field::Y => self.half_way(usize::from(field == Field::Y)),
            Field::Value if base.get(Field::ValueY).is_some() => self.at[2][0],
            Field::ValueY => self.at[2][1],
            Field::Value => self.times_distance(1.5),
            _ if is_angle => self.turned(value),
            _ => self.times_distance(value / self.unit),
        }
    }

    fn constant(&mut self, value: f64) -> Register {
        self.program.push(Operation::Constant(value))
    }

    fn binary(&mut self, operator: Operator, a: Register, b: Register) -> Register {
        self.program.push(Operation::Binary(operator, a, b))
    }

    fn between(&mut self, from: usize, to: usize) -> [Register; 2] {
        [0, 1].map(|k| self.binary(Operator::Subtract, self.at[to][k], self.at[from][k]))
    }

    fn half_way(&mut self, k: usize) -> Register {
        let sum = self.binary(Operator::Add, self.at[0][k], self.at[1][k]);
        let half = self.constant(0.5);
        self.binary(Operator::Multiply, sum, half)
    }

    fn times_distance(&mut self, factor: f64) -> Register {
        let [x, y] = self.between(0, 1);
        let distance = self.program.push(Operation::Norm(x, y));
        let factor = self.constant(factor);
        self.binary(Operator::Multiply, distance, factor)
    }

    /// `value` and a part of the angle between both pairs.
    fn turned(&mut self, value: f64) -> Register {
        let ([ux, uy], [vx, vy]) = (self.between(0, 1), self.between(2, 3));
        let product = |this: &mut Self, a, b| this.binary(Operator::Multiply, a, b);
        let (xx, yy) = (product(self, ux, vx), product(self, uy, vy));
        let (xy, yx) = (product(self, ux, vy), product(self, uy, vx));
        let along = self.binary(Operator::Add, xx, yy);
        let across = self.binary(Operator::Subtract, xy, yx);
        let angle = self.program.push(Operation::OfTwo(Function::Atan2, across, along));
        let part = self.constant(0.2);
        let part = self.binary(Operator::Multiply, angle, part);
        let value = self.constant(value);
        self.binary(Operator::Add, value, part)
    }
}
