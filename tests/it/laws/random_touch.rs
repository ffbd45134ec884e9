//! Points on circles and arcs, and lines and circles that touch: what is compared is measured on the
//! pose.

use std::f64::consts::TAU;

use linkwork::constraint::{
    Constraint, Declared, Field, Flag, Given, Measured, Operation, Point, PointIdx, Program,
    Register, Touch, Vec2,
};
use linkwork::terms::{Function, Operator};

use super::random_constraint::{Scene, Similarity};

/// A point on a circle or an arc, a line or a circle that touches another, or a common direction, as
/// the scene's variant says; it is on the side where it is before.
pub fn touch(scene: &Scene, by: Similarity) -> Constraint {
    let p = &scene.points;
    let mut look = Look::default();
    // No line has one end only, and no centre is on its own circle.
    let are_two = p[0] != p[1];
    let (values, groups, flags, n_curves): (_, Vec<Vec<PointIdx>>, &[Flag], u32) = match scene
        .variant
    {
        1 if are_two && p[1] != p[2] => {
            let [rim, centre, from, to] = [p[0], p[1], p[2], p[3]];
            look.hold(&[rim]);
            let values = vec![
                (Field::Value, look.distance(centre, rim)),
                (Field::Wanted, look.distance(centre, from)),
                (Field::Beyond, look.beyond(rim, [centre, from, to])),
            ];
            (values, vec![vec![rim]], &[], 1)
        }
        2 if are_two => {
            let [a, b, centre, rim] = [p[0], p[1], p[2], p[3]];
            look.hold(&[a, b]);
            let values = vec![
                (Field::Value, look.distance_to_line(centre, [a, b])),
                (Field::Wanted, look.distance(centre, rim)),
            ];
            (values, vec![vec![a, b]], &[], 1)
        }
        3 => {
            let is_inside = scene.numbers[0] > 0.0;
            let operator = if is_inside { Operator::Subtract } else { Operator::Add };
            let radii = [look.distance(p[0], p[1]), look.distance(p[2], p[3])];
            let wanted = look.binary(operator, radii[0], radii[1]);
            let values = vec![(Field::Value, look.distance(p[0], p[2])), (Field::Wanted, wanted)];
            (values, Vec::new(), if is_inside { &[Flag::Inside] } else { &[] }, 2)
        }
        4 if are_two && p[2] != p[3] => {
            let [a, b, rim, centre] = [p[0], p[1], p[2], p[3]];
            look.hold(&[a, b, rim]);
            let (line, spoke) = (look.between(a, b), look.between(centre, rim));
            (vec![(Field::Value, look.angle(line, spoke))], vec![vec![a, b], vec![rim]], &[], 1)
        }
        _ => {
            let [rim, centre] = [p[0], p[1]];
            look.hold(&[rim]);
            let radius = look.constant((4.0 * scene.numbers[0].abs() + 0.1) * by.scale);
            let value = look.distance(centre, rim);
            (vec![(Field::Value, value), (Field::Wanted, radius)], vec![vec![rim]], &[], 1)
        }
    };
    let before = by.points(&scene.before);
    let curves: Vec<u32> = (0..n_curves).collect();
    let given = Given {
        word: if groups.iter().map(Vec::len).eq([1]) { "glider" } else { "tangent" },
        groups: &groups,
        bounds: None,
        values: &look.values(&values, &before),
        flags,
        curves: &curves,
        x: &before,
        is_restored: false,
    };
    let touch = Touch::declare(&given).expect("it can be stated").into();
    Measured::new(touch, look.points, look.program, values, Vec::new()).into()
}

/// A program in the making, and the points that it looks at.
#[derive(Default)]
struct Look {
    points: Vec<PointIdx>,
    program: Program,
}

impl Look {
    /// The place of a point in the list.
    fn place(&mut self, p: PointIdx) -> usize {
        self.points.iter().position(|&q| q == p).unwrap_or_else(|| {
            self.points.push(p);
            self.points.len() - 1
        })
    }

    /// Puts the points that the constraint itself holds first.
    fn hold(&mut self, points: &[PointIdx]) {
        debug_assert!(self.points.is_empty());
        self.points.extend(points);
    }

    fn push(&mut self, operation: Operation) -> Register {
        self.program.push(operation)
    }

    fn constant(&mut self, value: f64) -> Register {
        self.push(Operation::Constant(value))
    }

    fn binary(&mut self, operator: Operator, a: Register, b: Register) -> Register {
        self.push(Operation::Binary(operator, a, b))
    }

    fn point(&mut self, p: PointIdx) -> [Register; 2] {
        let k = self.place(p) as u32;
        [Operation::X(k), Operation::Y(k)].map(|operation| self.push(operation))
    }

    fn between(&mut self, from: PointIdx, to: PointIdx) -> [Register; 2] {
        let (from, to) = (self.point(from), self.point(to));
        [0, 1].map(|k| self.binary(Operator::Subtract, to[k], from[k]))
    }

    fn distance(&mut self, a: PointIdx, b: PointIdx) -> Register {
        let [x, y] = self.between(a, b);
        self.push(Operation::Norm(x, y))
    }

    /// a.x b.x + a.y b.y
    fn dot(&mut self, a: [Register; 2], b: [Register; 2]) -> Register {
        let [x, y] = [0, 1].map(|k| self.binary(Operator::Multiply, a[k], b[k]));
        self.binary(Operator::Add, x, y)
    }

    /// a.x b.y - a.y b.x
    fn cross(&mut self, a: [Register; 2], b: [Register; 2]) -> Register {
        let [x, y] = [0, 1].map(|k| self.binary(Operator::Multiply, a[k], b[1 - k]));
        self.binary(Operator::Subtract, x, y)
    }

    fn distance_to_line(&mut self, p: PointIdx, [a, b]: [PointIdx; 2]) -> Register {
        let (line, to_point) = (self.between(a, b), self.between(a, p));
        let area = self.cross(line, to_point);
        let length = self.push(Operation::Norm(line[0], line[1]));
        self.binary(Operator::Divide, area, length)
    }

    fn angle(&mut self, u: [Register; 2], v: [Register; 2]) -> Register {
        let (along, across) = (self.dot(u, v), self.cross(u, v));
        self.push(Operation::OfTwo(Function::Atan2, across, along))
    }

    /// How far along its circle a point is beyond the nearer end of an arc.
    fn beyond(&mut self, p: PointIdx, [centre, from, to]: [PointIdx; 3]) -> Register {
        let (first, last) = (self.between(centre, from), self.between(centre, to));
        let (angle, turn) = (self.angle(first, last), self.constant(TAU));
        let whole = self.push(Operation::OfTwo(Function::Mod, angle, turn));
        let part = self.constant(0.5);
        let half = self.binary(Operator::Multiply, whole, part);
        let [cos, sin] = [Function::Cos, Function::Sin].map(|f| self.push(Operation::Of(f, half)));
        let back = self.push(Operation::Negate(sin));
        let middle = [self.dot(first, [cos, back]), self.dot(first, [sin, cos])];
        let spoke = self.between(centre, p);
        let from_middle = self.angle(middle, spoke);
        let from_middle = self.push(Operation::Of(Function::Abs, from_middle));
        let over = self.binary(Operator::Subtract, from_middle, half);
        let radius = self.push(Operation::Norm(first[0], first[1]));
        self.binary(Operator::Multiply, over, radius)
    }

    /// What is measured at a pose.
    fn values(&self, wanted: &[(Field, Register)], x: &[Point]) -> Vec<(Field, f64)> {
        let point = |k: usize| {
            let p = x[self.points[k] as usize];
            Vec2 { x: p.x, y: p.y }
        };
        self.program.evaluate(
            point,
            |_| unreachable!("it has no inputs"),
            |results: &[f64]| {
                wanted
                    .iter()
                    .map(|&(field, register)| (field, results[register as usize]))
                    .collect()
            },
        )
    }
}
