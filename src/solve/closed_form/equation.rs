//! Constraints that are no bars, as rows between points some of which are found together.

use super::abreast::{Abreast, Poses};
use super::found::larger;
use super::wheel;
use crate::constraint::{
    Activity, Constraint, ConstraintKind as _, Point, PointIdx, Quantity, Row, Vector,
};

/// No more points are looked at.
const MOST_POINTS: usize = 4;

/// A point, by what is found together.
#[derive(Clone, Copy)]
pub(super) enum End {
    Known(PointIdx),
    /// One of those that have two numbers.
    Base(usize),
    /// One of a body, as a multiple of the way from its pivot to the point that is found.
    On(usize, Vector),
}

/// A constraint that says numbers of points and bodies.
pub(super) struct Equation {
    /// Its rows.
    pub firm: Firm,
    /// Its points that are found together, or with a body that is.
    pub ends: Vec<(PointIdx, End)>,
}

/// A constraint by the rows that bind at every pose, in frames by themselves.
#[derive(Clone)]
pub(super) struct Firm {
    /// Its number.
    pub c: u32,
    /// How many rows there are.
    pub n_rows: usize,
    /// Segments between its points: where points move across these, or turn, by as much as they are long, the rows are
    /// others.
    segments: Vec<[PointIdx; 2]>,
    /// Whether it counts turns of the segments.
    is_wheel: bool,
}

impl Equation {
    /// The constraint of number `c`, where its points are found at the ends that `end` says; none if some are found
    /// elsewhere, or it does not say the same numbers at every pose.
    pub fn new(
        c: u32,
        constraint: &Constraint,
        end: impl Fn(PointIdx) -> Option<End>,
    ) -> Option<Self> {
        let firm = Firm::new(c, constraint)?;
        let mut ends: Vec<(PointIdx, End)> = Vec::with_capacity(MOST_POINTS);
        for &p in constraint.points() {
            let end = end(p)?;
            if !matches!(end, End::Known(_)) && ends.iter().all(|(q, _)| *q != p) {
                ends.push((p, end));
            }
        }
        (!ends.is_empty()).then_some(Self { firm, ends })
    }
}

impl Firm {
    fn new(c: u32, constraint: &Constraint) -> Option<Self> {
        let (traits, points) = (constraint.traits(), constraint.points());
        let n_rows = traits.n_firm_rows;
        // Beyond a stop it has more rows, and is left to others.
        if n_rows == 0 || traits.activity == Activity::Outside || points.len() > MOST_POINTS {
            return None;
        }
        let turns_with_centres = traits.is_wheel && traits.quantity == Quantity::Angle;
        let segments: &[[usize; 2]] = match points.len() {
            4 if turns_with_centres => &[[0, 1], [2, 3], [0, 2]],
            4 => &[[0, 1], [2, 3]],
            3 => &[[1, 2]],
            2 if !traits.is_linear => &[[0, 1]],
            _ => &[],
        };
        let segments = segments.iter().map(|segment| segment.map(|k| points[k])).collect();
        Some(Self { c, n_rows, segments, is_wheel: traits.is_wheel })
    }

    /// Calls `visit` for each of its rows at a pose; none where there are more or less than it has at every pose.
    pub fn rows(
        &self,
        x: &[Point],
        constraints: &[Constraint],
        mut visit: impl FnMut(&Row),
    ) -> Option<()> {
        let mut n_active = 0;
        constraints[self.c as usize].jacobian(x, &mut |row| {
            if row.is_active {
                n_active += 1;
                if n_active <= self.n_rows {
                    visit(&row);
                }
            }
        });
        (n_active == self.n_rows).then_some(())
    }

    /// How long its segments are.
    pub fn spans<'a>(&'a self, x: &'a [Point]) -> impl Iterator<Item = f64> + 'a {
        self.segments.iter().map(|[a, b]| x[*a as usize].distance(x[*b as usize]))
    }

    /// Checks that it holds once all of its points are found, and that the turns which it counts are told by where
    /// these are.
    pub fn check<const N: usize>(
        &self,
        x: &mut (impl Poses<N> + ?Sized),
        constraints: &[Constraint],
        abreast: &mut Abreast<N>,
    ) {
        let off = x.one().and_then(|x| {
            let mut worst = 0.0;
            self.rows(x, constraints, |row| {
                let steepest = row.terms().fold(0.0, |sum, (_, g)| sum + g.norm_squared());
                worst = larger(worst, row.f / steepest.sqrt());
            })?;
            self.is_counted(x, |p| abreast.ways[p as usize][0]).then_some(worst)
        });
        abreast.check_each(|_| off.unwrap_or(f64::NAN));
    }

    /// Whether the turns that it counts are told by where points are at the end of a frame in which they went no
    /// farther than `way` says.
    fn is_counted(&self, x: &[Point], way: impl Fn(PointIdx) -> f64) -> bool {
        let mut segments = self.segments.iter().zip(self.spans(x));
        let is_told = |([a, b], span): (&[PointIdx; 2], f64)| {
            let way = way(*a) + way(*b);
            way == 0.0 || (0.0..wheel::MOST).contains(&(way / (span - way)))
        };
        !self.is_wheel || segments.all(is_told)
    }
}
