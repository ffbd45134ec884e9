//! kcl-ezpz with its default configuration: a residual below 1e-8.

use kcl_ezpz::datatypes::inputs::{DatumLineSegment, DatumPoint};
use kcl_ezpz::{Config, Constraint, ConstraintRequest, Id, IdGenerator, solve};

use crate::peer::Peer;
use crate::work::{Place, Relation, Work};

pub struct Ezpz<'a> {
    work: &'a Work,
    points: Vec<DatumPoint>,
    requests: Vec<ConstraintRequest>,
    guesses: Vec<(Id, f64)>,
}

impl<'a> Ezpz<'a> {
    pub fn start(work: &'a Work) -> Self {
        let mut ids = IdGenerator::default();
        let points: Vec<_> = work.start.iter().map(|_| DatumPoint::new(&mut ids)).collect();
        let guesses = points
            .iter()
            .zip(&work.start)
            .flat_map(|(p, at)| [(p.id_x(), at[0]), (p.id_y(), at[1])])
            .collect();
        // The driven points first, so that they are found again.
        let held = work.driven.iter().map(|d| d.0).chain(work.ground.iter().copied());
        let mut requests: Vec<_> = held.flat_map(|p| fixed(points[p], work.start[p])).collect();
        let line = |a: usize, b: usize| DatumLineSegment::new(points[a], points[b]);
        requests.extend(work.relations.iter().map(|relation| {
            ConstraintRequest::highest_priority(match *relation {
                Relation::Length(a, b, l) => Constraint::Distance(points[a], points[b], l),
                Relation::Equal([a, b, c, d]) => {
                    Constraint::LinesEqualLength(line(a, b), line(c, d))
                }
                Relation::OnLine(p, [a, b]) => {
                    Constraint::PointLineDistance(points[p], line(a, b), 0.0)
                }
            })
        }));
        Self { work, points, requests, guesses }
    }
}

fn fixed(point: DatumPoint, at: Place) -> [ConstraintRequest; 2] {
    [Constraint::Fixed(point.id_x(), at[0]), Constraint::Fixed(point.id_y(), at[1])]
        .map(ConstraintRequest::highest_priority)
}

impl Peer for Ezpz<'_> {
    fn frame(&mut self, k: usize) -> bool {
        for (nth, &(p, about)) in self.work.driven.iter().enumerate() {
            let at = self.work.target(about, k);
            self.requests[2 * nth..2 * nth + 2].clone_from_slice(&fixed(self.points[p], at));
        }
        let Ok(found) = solve(&self.requests, self.guesses.clone(), Config::default()) else {
            return false;
        };
        for (guess, value) in self.guesses.iter_mut().zip(found.final_values()) {
            guess.1 = *value;
        }
        found.is_satisfied()
    }

    fn pose(&mut self) -> Vec<Place> {
        self.guesses.chunks_exact(2).map(|g| [g[0].1, g[1].1]).collect()
    }
}
