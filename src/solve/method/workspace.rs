//! What a method works on and the room it works in.

use super::limits::{Limits, Outcome};
use super::rows::{Equations, Rows};
use crate::constraint::{Constraint, Point};
use crate::linalg::NormalMatrix;
use crate::solve::report::{Counters, Status};

/// A pose that a method improves. Only points among the unknowns of its equations move.
pub(crate) struct Pose<'a> {
    /// The constraints, over indices into `x`.
    pub constraints: &'a [Constraint],
    /// The positions.
    pub x: &'a mut [Point],
}

/// What a step takes into account of the curvature of its rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stiffness {
    /// Nothing: Gauss-Newton, whose steps are the shortest that meet the rows.
    None,
    /// A stretched length resists a move across it as well. Where not all can hold that is what
    /// makes steps go where the energy is least; where all can, they would go too far.
    Stretched,
}

/// The room a method works in: made when first needed, kept as long as it is.
pub(crate) struct Workspace {
    /// What is to be solved.
    pub equations: Equations,
    /// The rows at the pose that was evaluated last.
    pub rows: Rows,
    /// The unknown points before a step.
    pub before: Vec<Point>,
    /// What normalised the rows there.
    scale_before: Vec<f64>,
    /// The unknown points where a motion was expected to take them.
    pub expected: Vec<Point>,
    /// The derivative of the energy.
    pub slope: Vec<f64>,
    /// The step in the weighted unknowns.
    pub step: Vec<f64>,
    /// Room for one more step.
    pub trial_step: Vec<f64>,
    /// J^T J and its factor, for the methods that ask for it.
    matrix: Option<Box<NormalMatrix>>,
}

impl Workspace {
    /// Room for these equations.
    pub fn new(equations: Equations) -> Self {
        let n = 2 * equations.points().len();
        Self {
            equations,
            rows: Rows::default(),
            before: Vec::new(),
            scale_before: Vec::new(),
            expected: Vec::new(),
            slope: vec![0.0; n],
            step: vec![0.0; n],
            trial_step: Vec::new(),
            matrix: None,
        }
    }

    /// The longest step that is still a small change: a part of the size, or of the way that is
    /// left where a constraint asks for a place far outside.
    pub fn longest_step(&self, part: f64, limits: &Limits) -> f64 {
        part * limits.size.max(0.5 * self.rows.worst)
    }

    /// How far the farthest unknown point is from where it was expected.
    pub fn correction(&self, x: &[Point]) -> f64 {
        let points = self.equations.points().iter().map(|&p| x[p as usize]);
        points.zip(&self.expected).fold(0.0, |most, (at, expected)| {
            let d = at - *expected;
            most.max(d.x.abs()).max(d.y.abs())
        })
    }

    /// Evaluates the rows at a pose.
    pub fn evaluate(&mut self, pose: &Pose, work: &mut Counters) {
        self.rows.evaluate(&self.equations, pose.constraints, pose.x, work);
    }

    /// Remembers the unknown points and the scales of their rows, to try steps from there.
    pub fn remember(&mut self, pose: &Pose) {
        self.equations.gather(pose.x, &mut self.before);
        self.scale_before.clear();
        self.scale_before.extend_from_slice(self.rows.scales());
    }

    /// Takes `t` times the step from the remembered points and evaluates the rows there.
    /// Gives the energy in the remembered scales; infinite where there is none.
    pub fn try_step(&mut self, pose: &mut Pose, t: f64, work: &mut Counters) -> f64 {
        if !self.equations.displace(pose.x, &self.before, &self.step, t) {
            return f64::INFINITY;
        }
        let Self { rows, equations, scale_before, .. } = self;
        let energy =
            rows.evaluate_as_scaled_by(scale_before, equations, pose.constraints, pose.x, work);
        if energy.is_finite() { energy } else { f64::INFINITY }
    }

    /// Goes back to the remembered points, and evaluates the rows there again: steps are rarely
    /// taken back, and to keep both would take as much workspace as the scene.
    pub fn reject(&mut self, pose: &mut Pose, work: &mut Counters) {
        self.equations.scatter(&self.before, pose.x);
        self.evaluate(pose, work);
    }

    /// The derivative of the energy at the present rows.
    pub fn update_slope(&mut self) {
        self.rows.slope(&self.equations, &mut self.slope);
    }

    /// J^T J of the present rows, with or without the stiffness of stretched lengths.
    pub fn assemble(&mut self, stiffness: Stiffness) -> &mut NormalMatrix {
        let Self { equations, rows, matrix, .. } = self;
        let matrix = cleared(matrix, equations);
        for (r, (_, unknowns, gradient, bend)) in rows.iter(equations).enumerate() {
            matrix.add_row(r, gradient);
            if stiffness == Stiffness::Stretched && bend > 0.0 {
                // No row holds more points than a constraint of four.
                let mut across = [0.0; 8];
                let (turned, _) = across.as_chunks_mut::<2>();
                for (to, g) in turned.iter_mut().zip(gradient.as_chunks::<2>().0) {
                    *to = [-bend * g[1], bend * g[0]];
                }
                matrix.add_row(r, &across[..2 * unknowns.len()]);
            }
        }
        matrix
    }

    /// The curvature of the energy at the present rows, `J^T J + sum f hess f`.
    pub fn assemble_curvature(&mut self, pose: &Pose) {
        let Self { equations, rows, matrix, .. } = self;
        let matrix = cleared(matrix, equations);
        for (r, (_, _, gradient, _)) in rows.iter(equations).enumerate() {
            matrix.add_row(r, gradient);
        }
        rows.each_curvature(equations, pose.constraints, pose.x, |r, hessian| {
            matrix.add_symmetric(r, hessian);
        });
    }

    /// Takes out of the step what no row asks for, `J^T J (J^T J + mu)^-1 y` with the factored
    /// matrix: that is a sum of multiples of rows however inexact the factor is. For a tiny mu
    /// rounding gives a step parts in the directions that the rows leave open.
    pub fn keep_to_rows(&mut self) {
        let mut way = std::mem::take(&mut self.trial_step);
        way.clone_from(&self.step);
        self.matrix().solve(&mut way);
        let Self { rows, equations, step, .. } = self;
        step.fill(0.0);
        for (_, unknowns, gradient, _) in rows.iter(equations) {
            let entries = unknowns.iter().map(|&u| 2 * u as usize).zip(gradient.as_chunks::<2>().0);
            let along: f64 = entries.clone().map(|(u, g)| g[0] * way[u] + g[1] * way[u + 1]).sum();
            for (u, g) in entries {
                step[u] += along * g[0];
                step[u + 1] += along * g[1];
            }
        }
        self.trial_step = way;
    }

    /// The norm of the slope.
    pub fn steepness(&self) -> f64 {
        self.slope.iter().map(|g| g * g).sum::<f64>().sqrt()
    }

    /// The matrix as last assembled and factored.
    pub fn matrix(&mut self) -> &mut NormalMatrix {
        self.matrix.as_mut().expect("the matrix was assembled")
    }

    /// The ending at the present rows.
    pub fn outcome(&self, status: Status, n_iterations: u32) -> Outcome {
        Outcome { status, worst: self.rows.worst, energy: self.rows.energy, n_iterations }
    }

    /// Whether the present rows are met.
    pub fn is_met(&self, limits: &Limits) -> bool {
        self.rows.energy.is_finite() && self.rows.worst <= limits.tolerance
    }
}

/// The matrix of these equations, made when it is needed first, with nothing in it.
fn cleared<'a>(
    matrix: &'a mut Option<Box<NormalMatrix>>,
    equations: &Equations,
) -> &'a mut NormalMatrix {
    let matrix = matrix.get_or_insert_with(|| {
        Box::new(NormalMatrix::new(equations.points().len(), equations.pattern()))
    });
    matrix.clear();
    matrix
}
