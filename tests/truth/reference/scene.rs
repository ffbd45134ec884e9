//! A mechanism as data: what the program is told of it, and its equations at any pose.

use std::fmt::Write;

use super::constraint::{Constraint, Equation, Kind};
use super::dense::Matrix;
use super::number::{Curve, MOST, Slope};
use super::plane::{self, Place};

/// A mechanism. Poses are the places of all its points, in order.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Where its points are declared, and what is taken from a pose is taken.
    pub made_at: Vec<Place>,
    /// Where they are put after that.
    pub start: Vec<Place>,
    pub is_frozen: Vec<bool>,
    /// What a point resists being moved with; 1 if nothing is said.
    pub weight: Vec<f64>,
    pub constraints: Vec<Constraint>,
    pub dt: f64,
}

/// The active equations of a scene at a pose, measured as distances to satisfaction: each is
/// divided by the length of its gradient in the metric of the weights. The columns are the
/// coordinates of the points that are not frozen, each times the root of its weight.
pub struct Rows {
    pub f: Vec<f64>,
    pub jacobian: Matrix,
    /// Which constraint each row is of.
    pub of: Vec<usize>,
    /// What each was divided by.
    pub scale: Vec<f64>,
    /// The derivative by time, divided alike.
    pub rate: Vec<f64>,
}

impl Scene {
    /// A point; its place in the list.
    pub fn point(&mut self, at: Place) -> usize {
        self.made_at.push(at);
        self.start.push(at);
        self.is_frozen.push(false);
        self.weight.push(1.0);
        self.made_at.len() - 1
    }

    /// A point that does not move.
    pub fn ground(&mut self, at: Place) -> usize {
        let p = self.point(at);
        self.is_frozen[p] = true;
        p
    }

    /// A constraint named `c` and its number; its place in the list.
    pub fn add(&mut self, points: &[usize], kind: Kind) -> usize {
        let name = format!("c{}", self.constraints.len());
        self.constraints.push(Constraint { name, points: points.to_vec(), kind, is_on: true });
        self.constraints.len() - 1
    }

    /// The name of a point.
    pub fn name(p: usize) -> String {
        format!("p{p}")
    }

    /// The names of all points, with commas.
    pub fn names(&self) -> String {
        (0..self.made_at.len()).map(Self::name).collect::<Vec<_>>().join(", ")
    }

    /// The script that makes it.
    pub fn script(&self) -> String {
        let mut text = String::new();
        for (p, [x, y]) in self.made_at.iter().enumerate() {
            let frozen = if self.is_frozen[p] { " frozen" } else { "" };
            line(&mut text, format_args!("point p{p} = ({x}, {y}){frozen}"));
            if self.weight[p] != 1.0 {
                line(&mut text, format_args!("set weight {} for p{p}", self.weight[p]));
            }
        }
        if self.dt > 0.0 {
            line(&mut text, format_args!("set dt {}", self.dt));
        }
        let (captured, others): (Vec<_>, Vec<_>) =
            self.constraints.iter().partition(|c| c.kind.is_captured());
        captured.into_iter().for_each(|c| line(&mut text, format_args!("{}", Self::statement(c))));
        for (p, [x, y]) in self.start.iter().enumerate() {
            if self.start[p] != self.made_at[p] {
                line(&mut text, format_args!("move p{p} to ({x}, {y})"));
            }
        }
        others.into_iter().for_each(|c| line(&mut text, format_args!("{}", Self::statement(c))));
        for c in self.constraints.iter().filter(|c| !c.is_on) {
            line(&mut text, format_args!("off {}", c.name));
        }
        text
    }

    /// The statement of a constraint, with its label.
    pub fn statement(c: &Constraint) -> String {
        let points: Vec<String> = c.points.iter().map(|&p| Self::name(p)).collect();
        format!("{}: {}", c.name, c.kind.statement(&points))
    }

    /// The same scene with only these constraints.
    pub fn only(&self, which: &[usize]) -> Self {
        let constraints = which.iter().map(|&k| self.constraints[k].clone()).collect();
        Self { constraints, ..self.clone() }
    }

    /// The points that move, each with the column of its x.
    pub fn columns(&self) -> Vec<Option<usize>> {
        let mut n = 0;
        let mut next = |is_frozen: &bool| {
            (!is_frozen).then(|| {
                n += 2;
                n - 2
            })
        };
        self.is_frozen.iter().map(&mut next).collect()
    }

    /// How many coordinates can change.
    pub fn n_columns(&self) -> usize {
        2 * self.is_frozen.iter().filter(|is_frozen| !**is_frozen).count()
    }

    /// The constraints that are switched on, with their places in the list.
    pub fn active(&self) -> impl Iterator<Item = (usize, &Constraint)> {
        self.constraints.iter().enumerate().filter(|(_, c)| c.is_on)
    }

    fn slopes(c: &Constraint, x: &[Place], time: f64) -> Vec<Equation<Slope>> {
        let variable = |k: usize, p: usize| [0, 1].map(|i| Slope::variable(x[p][i], 2 * k + i));
        let places: Vec<_> = c.points.iter().enumerate().map(|(k, &p)| variable(k, p)).collect();
        c.kind.equations(&places, time)
    }

    /// The gradient by the columns, and its length when no weight counts and all points move.
    fn gradient(&self, c: &Constraint, local: &[f64; MOST], columns: &[Option<usize>]) -> Gradient {
        let mut row = vec![0.0; self.n_columns()];
        let mut of_points: Vec<(usize, Place)> = Vec::new();
        for (k, &p) in c.points.iter().enumerate() {
            let g = [local[2 * k], local[2 * k + 1]];
            if let Some(column) = columns[p] {
                let mobility = self.weight[p].sqrt().recip();
                row[column] += g[0] * mobility;
                row[column + 1] += g[1] * mobility;
            }
            match of_points.iter_mut().find(|(q, _)| *q == p) {
                Some((_, sum)) => *sum = [sum[0] + g[0], sum[1] + g[1]],
                None => of_points.push((p, g)),
            }
        }
        let all = of_points.iter().map(|(_, g)| g[0] * g[0] + g[1] * g[1]).sum::<f64>().sqrt();
        Gradient { row, all }
    }

    /// The active equations at a pose.
    pub fn rows(&self, x: &[Place], time: f64) -> Rows {
        let columns = self.columns();
        let jacobian = Matrix::zero(0, self.n_columns());
        let mut rows =
            Rows { f: Vec::new(), jacobian, of: Vec::new(), scale: Vec::new(), rate: Vec::new() };
        for (place, c) in self.active() {
            let equations = Self::slopes(c, x, time);
            let rates = c.kind.rates(equations.len(), time);
            for (equation, rate) in equations.iter().zip(rates).filter(|(e, _)| e.is_active) {
                let Gradient { mut row, .. } = self.gradient(c, &equation.f.gradient, &columns);
                let length = super::dense::norm(&row);
                if length <= 1e-14 {
                    continue;
                }
                row.iter_mut().for_each(|g| *g /= length);
                rows.f.push(equation.f.value / length);
                rows.jacobian.rows.push(row);
                rows.of.push(place);
                rows.scale.push(length);
                rows.rate.push(rate / length);
            }
        }
        rows
    }

    /// How far each constraint is from satisfaction, length units; 0 for one that is off.
    pub fn violations(&self, x: &[Place], time: f64) -> Vec<f64> {
        let columns = self.columns();
        let mut violations = vec![0.0; self.constraints.len()];
        for (place, c) in self.active() {
            let square = |e: &Equation<Slope>| {
                let Gradient { row, all } = self.gradient(c, &e.f.gradient, &columns);
                let (free, f) = (super::dense::norm(&row), e.f.value);
                let length = if free > 1e-14 { free } else { all };
                if length > 1e-14 { (f / length) * (f / length) } else { f * f }
            };
            violations[place] = Self::slopes(c, x, time).iter().map(square).sum::<f64>().sqrt();
        }
        violations
    }

    /// The largest of these.
    pub fn violation(&self, x: &[Place], time: f64) -> f64 {
        self.violations(x, time).into_iter().fold(0.0, f64::max)
    }

    /// Half the sum of the squares of the equations at `x`, each divided by the same as in
    /// `measure`, a list of what was active there and elsewhere; see [`Self::measure`].
    pub fn energy(&self, x: &[Place], time: f64, measure: &[Vec<f64>]) -> f64 {
        let mut sum = 0.0;
        for ((_, c), lengths) in self.active().zip(measure) {
            let places: Vec<Place> = c.points.iter().map(|&p| x[p]).collect();
            for (k, e) in c.kind.equations(&places, time).iter().enumerate() {
                // A limit that was kept, and a stop that was not reached, have no measure of
                // their own: a length counts as it is.
                let length = lengths.get(k).copied().unwrap_or(1.0);
                sum += 0.5 * (e.f / length) * (e.f / length);
            }
        }
        sum
    }

    /// What each equation of each active constraint is divided by at a pose.
    pub fn measure(&self, x: &[Place], time: f64) -> Vec<Vec<f64>> {
        let columns = self.columns();
        let of_constraint = |c: &Constraint| {
            Self::slopes(c, x, time)
                .iter()
                .map(|e| {
                    let Gradient { row, all } = self.gradient(c, &e.f.gradient, &columns);
                    let free = super::dense::norm(&row);
                    if free > 1e-14 {
                        free
                    } else if all > 1e-14 {
                        all
                    } else {
                        1.0
                    }
                })
                .collect()
        };
        self.active().map(|(_, c)| of_constraint(c)).collect()
    }

    /// The second derivatives of [`Self::energy`] with the measure of the pose itself, by the
    /// columns of [`Rows`].
    pub fn hessian(&self, x: &[Place], time: f64) -> Matrix {
        let columns = self.columns();
        let n = self.n_columns();
        let mut hessian = Matrix::zero(n, n);
        for (_, c) in self.active() {
            let variable =
                |(k, &p): (usize, &usize)| [0, 1].map(|i| Curve::variable(x[p][i], 2 * k + i));
            let places: Vec<_> = c.points.iter().enumerate().map(variable).collect();
            // The column and the mobility of each variable of the constraint.
            let at: Vec<(usize, f64, usize)> = (0..2 * c.points.len())
                .filter_map(|i| {
                    let p = c.points[i / 2];
                    Some((columns[p]? + i % 2, self.weight[p].sqrt().recip(), i))
                })
                .collect();
            for e in c.kind.equations(&places, time).iter().filter(|e| e.is_active) {
                let row = self.gradient(c, &e.f.gradient, &columns).row;
                let squared = super::dense::square(&row);
                if squared <= 1e-28 {
                    continue;
                }
                for (i, a) in row.iter().enumerate() {
                    super::dense::add_scaled(&mut hessian.rows[i], a / squared, &row);
                }
                for &(column, m, i) in &at {
                    for &(other, m2, j) in &at {
                        hessian.rows[column][other] +=
                            e.f.value * e.f.hessian[i][j] * m * m2 / squared;
                    }
                }
            }
        }
        hessian
    }

    /// The pose moved by a step in the columns of [`Rows`].
    pub fn moved(&self, x: &[Place], step: &[f64]) -> Vec<Place> {
        let mut moved = x.to_vec();
        for (p, column) in self.columns().iter().enumerate() {
            if let Some(column) = column {
                let mobility = self.weight[p].sqrt().recip();
                moved[p][0] += step[*column] * mobility;
                moved[p][1] += step[column + 1] * mobility;
            }
        }
        moved
    }

    /// The way from one pose to another in the columns of [`Rows`].
    pub fn way(&self, from: &[Place], to: &[Place]) -> Vec<f64> {
        let mut way = vec![0.0; self.n_columns()];
        for (p, column) in self.columns().iter().enumerate() {
            if let Some(column) = column {
                let root = self.weight[p].sqrt();
                way[*column] = (to[p][0] - from[p][0]) * root;
                way[column + 1] = (to[p][1] - from[p][1]) * root;
            }
        }
        way
    }

    /// How far a pose extends, and the lengths asked for.
    pub fn size(&self, x: &[Place]) -> f64 {
        let extent = |k: usize| {
            let of = |from: f64, f: fn(f64, f64) -> f64| x.iter().map(|p| p[k]).fold(from, f);
            of(f64::NEG_INFINITY, f64::max) - of(f64::INFINITY, f64::min)
        };
        let asked = self.active().map(|(_, c)| match c.kind {
            Kind::Length(range) if range.hi.is_finite() => range.hi,
            Kind::Length(range) => range.lo,
            Kind::Motor { radius, .. } => radius,
            _ => 0.0,
        });
        asked.fold(plane::length([extent(0), extent(1)]), f64::max)
    }
}

struct Gradient {
    row: Vec<f64>,
    all: f64,
}

fn line(text: &mut String, what: std::fmt::Arguments) {
    writeln!(text, "{what}").expect("a string takes all");
}
