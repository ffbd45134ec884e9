//! Measures of frames that are known ahead, for many frames at a time.
//!
//! Most values say nothing but themselves: only next to an extremum is it worth to know how fast one changes. So
//! the world need not be told of each frame.

use super::environments::Here;
use super::{Depends, Extremes, MeasureId, PointId, Value, World};
use crate::constraint::{PointIdx, Program, Register};

/// All measures of a scene, of `N` frames at a time.
pub struct Gauges<const N: usize> {
    program: Program,
    points: Vec<PointIdx>,
    inputs: Vec<f64>,
    all: Vec<Gauge>,
    /// What each operation of the program came to in each frame.
    results: Vec<[f64; N]>,
    /// The results that no other follows from: where these have values, all have.
    ends: Vec<Register>,
    /// The first frame in which something has no value.
    n_known: usize,
}

/// Where the value of a measure is among the results, and the unit that it is kept in.
struct Gauge {
    id: MeasureId,
    register: Register,
    scale: f64,
}

impl World {
    /// The measures of a scene that is known ahead; none where one follows more than the places of points.
    pub fn gauges<const N: usize>(&self) -> Option<Gauges<N>> {
        let is_of_places = |depends: Depends| {
            let others = Depends { on_points: false, on_parameters: false, ..depends };
            depends.on_points && !others.is_live()
        };
        let mut all = self.measures().map(|(_, measure)| &measure.formula);
        if !all.all(|formula| is_of_places(self.depends(formula))) {
            return None;
        }
        let formulas = self.measures().map(|(_, measure)| &measure.formula);
        let (program, points, inputs, registers) = self.compile_in_frames(formulas);
        let ends = program.ends();
        let here = Here::new(self, None);
        let number = |value: Value| value.number();
        let inputs = inputs.iter().map(|formula| formula.evaluate(&here).map_or(f64::NAN, number));
        let all = self.measures().zip(registers).map(|((id, measure), register)| Gauge {
            id,
            register,
            scale: measure.unit.scale(),
        });
        Some(Gauges {
            program,
            points,
            inputs: inputs.collect(),
            all: all.collect(),
            results: Vec::new(),
            ends,
            n_known: 0,
        })
    }

    /// Lets a frame pass that was measured so, of which the world is told nothing else; false, and nothing is
    /// changed, where more is to be known of it than the values.
    pub fn pass_gauged<const N: usize>(
        &mut self,
        gauges: &Gauges<N>,
        l: usize,
        extremes: Extremes,
    ) -> bool {
        let time = self.clock.time_after(1);
        let is_refined = extremes == Extremes::Refined;
        if l >= gauges.n_known {
            return false;
        }
        let is_plain = gauges.all.iter().all(|gauge| {
            let tally = &self.measure(gauge.id).expect("a listed measure lives").tally;
            let is_later = tally.readings().last().is_some_and(|last| last.time < time);
            is_later && !(is_refined && tally.may_turn(gauges.value(gauge, l)))
        });
        if is_plain {
            for gauge in &gauges.all {
                let measure = self.measures.get_mut(gauge.id.idx()).expect("it lives");
                measure.tally.add(time, gauges.value(gauge, l), None);
            }
            self.pass(1);
        }
        is_plain
    }
}

impl<const N: usize> Gauges<N> {
    /// The points that are measured.
    pub fn points(&self) -> impl Iterator<Item = PointId> + '_ {
        self.points.iter().copied().map(PointId)
    }

    /// Evaluates them in frames that have these points, given by their places in the list, there.
    pub fn evaluate(&mut self, point: impl Fn(usize) -> [[f64; N]; 2]) {
        self.program.evaluate_each(point, |k| [self.inputs[k]; N], &mut self.results);
        let results = &self.results;
        let fails = |l: &usize| self.ends.iter().any(|&end| results[end as usize][*l].is_nan());
        self.n_known = (0..N).find(fails).unwrap_or(N);
    }

    fn value(&self, gauge: &Gauge, l: usize) -> f64 {
        self.results[gauge.register as usize][l] / gauge.scale
    }
}
