//! From the constraints of an island to its list of steps.

use super::abreast::Abreast;
use super::{CircleLine, Circles, ClosedForm, Crank, Direction, Radius, Ray, Step, Sum, Wheel};
use crate::constraint::{Carried, Constraint, ConstraintKind as _, PointIdx};
use crate::solve::frame::decomposition::{Block, Form, Plan};

/// What a constraint leaves of the plane to a point.
enum Locus {
    /// A circle around another point.
    Circle(PointIdx, Radius),
    /// The line through two others; whether only the part between them.
    Line([PointIdx; 2], bool),
    /// The line from another through a slider; whether only the part beyond it.
    Beyond(PointIdx, PointIdx, bool),
}

impl ClosedForm {
    /// The list for constraints over `n_points` points, in the order of a plan; none if some of
    /// these have no closed form. `degree` is the highest up to which a motion is smooth.
    pub fn new(
        plan: &Plan,
        constraints: &[Constraint],
        n_points: usize,
        degree: u8,
    ) -> Option<Self> {
        let carries = |c: &Constraint| {
            let is_told = matches!(c.traits().carried, Carried::Nothing | Carried::ByClock);
            !is_told && !matches!(c, Constraint::Cog(_) | Constraint::Orientation(_))
        };
        if !plan.is_complete() || constraints.iter().any(carries) {
            return None;
        }
        let mut form = Self {
            steps: Vec::with_capacity(plan.blocks.len()),
            cranks: Vec::new(),
            degree,
            one: Abreast::new(n_points, 0),
            n_constraints: plan.constraints.len() as u32,
            counts_turns: false,
            knows_pose: false,
        };
        let is_driver = |c: &&Constraint| matches!(c, Constraint::Motor(_));
        let n_motors = constraints.iter().filter(is_driver).count() as u32;
        let mut n_driven = n_motors;
        for block in &plan.blocks {
            let which = &plan.constraints[block.first as usize..block.end as usize];
            let (step, pair) = form.block(block, which, constraints, n_driven)?;
            n_driven += u32::from(matches!(step, Step::Direction(_)));
            form.counts_turns |= matches!(step, Step::Wheel(_));
            form.steps.push(step);
            for &c in which.iter().filter(|c| !pair.contains(c)) {
                form.steps.push(bar(&constraints[c as usize])?);
            }
        }
        form.one = Abreast::new(n_points, n_driven as usize);
        Some(form)
    }

    /// Whether steps ask a constraint for its values in each frame, so that these may change.
    pub fn asks(constraint: &Constraint) -> bool {
        matches!(
            constraint,
            Constraint::Motor(_) | Constraint::Coordinate(_) | Constraint::Orientation(_)
        )
    }

    /// The step that finds the point of a block, and the constraints it does so by: all, or of many
    /// the first and one that goes with it.
    fn block(
        &mut self,
        block: &Block,
        which: &[u32],
        all: &[Constraint],
        drive: u32,
    ) -> Option<(Step, [u32; 2])> {
        match *which {
            [one] => Some((self.step(block, which, all, drive)?, [one, one])),
            [first, ref others @ ..] => others.iter().find_map(|&other| {
                let pair = [first, other];
                Some((self.step(block, &pair, all, drive)?, pair))
            }),
            [] => None,
        }
    }

    /// The step that finds the point of a block by some constraints; `drive` are the next numbers to drive one.
    fn step(
        &mut self,
        block: &Block,
        which: &[u32],
        all: &[Constraint],
        drive: u32,
    ) -> Option<Step> {
        let to = block.point;
        match (block.form, which) {
            (Form::Assignment, &[c]) => self.assignment(&all[c as usize], c, to),
            (_, &[one, two]) if block.is_determined => {
                let pair = [one, two].map(|c| (c, &all[c as usize]));
                let turned =
                    turned(to, pair, drive).or_else(|| turned(to, [pair[1], pair[0]], drive));
                turned.or_else(|| meeting(to, locus(pair[0].1, to)?, locus(pair[1].1, to)?))
            }
            (_, &[one]) if !block.is_determined => match locus(&all[one as usize], to)? {
                Locus::Circle(from, radius) => Some(Step::Nearest { to, from, radius }),
                Locus::Line(..) | Locus::Beyond(..) => None,
            },
            _ => None,
        }
    }

    /// The step of a constraint that says by itself where a point is.
    fn assignment(&mut self, constraint: &Constraint, c: u32, to: PointIdx) -> Option<Step> {
        match constraint {
            Constraint::Motor(motor) if motor.measured_from().is_none() => {
                let [from, driven] = motor.crank();
                if driven != to || from == to {
                    return None;
                }
                self.cranks.push(Crank { to, from, motor: c, before: motor.heading() });
                Some(Step::Crank(self.cranks.len() as u32 - 1))
            }
            Constraint::Coordinate(_) => Some(Step::Place { to, constraint: c, way: 0.0 }),
            _ => Some(Step::Sum(Sum::new(to, constraint, self.one.ways.len())?)),
        }
    }
}

/// The step that finds the end of a bar that the first constraint turns.
fn turned(to: PointIdx, [by, bar]: [(u32, &Constraint); 2], drive: u32) -> Option<Step> {
    let Locus::Circle(from, Radius::Fixed(length)) = locus(bar.1, to)? else { return None };
    match by {
        (c, Constraint::Cog(cog)) => Some(Step::Wheel(Wheel::new(to, from, length, (c, cog))?)),
        (c, Constraint::Orientation(orientation)) => {
            let link = Direction::new(to, from, length, (c, orientation), drive)?;
            Some(Step::Direction(link))
        }
        _ => None,
    }
}

/// The check of a bar whose ends others find.
fn bar(constraint: &Constraint) -> Option<Step> {
    match constraint {
        Constraint::Length(bar) if bar.bounds.is_equality() && bar.bounds.lo > 0.0 => {
            Some(Step::Bar { points: bar.points, length: bar.bounds.lo })
        }
        _ => None,
    }
}

/// The step that finds a point on two loci.
fn meeting(to: PointIdx, one: Locus, two: Locus) -> Option<Step> {
    match (one, two) {
        (Locus::Circle(a, Radius::Fixed(l)), Locus::Circle(b, Radius::Fixed(m))) => {
            (a != b).then_some(Step::Circles(Circles::new(to, [a, b], [l, m])?))
        }
        (Locus::Circle(from, Radius::Fixed(l)), Locus::Line(line, is_bounded))
        | (Locus::Line(line, is_bounded), Locus::Circle(from, Radius::Fixed(l))) => {
            Some(Step::CircleLine(CircleLine::new(to, from, line, l, is_bounded)?))
        }
        (Locus::Circle(centre, Radius::Fixed(l)), Locus::Beyond(from, slider, is_bounded))
        | (Locus::Beyond(from, slider, is_bounded), Locus::Circle(centre, Radius::Fixed(l)))
            if centre == from =>
        {
            Some(Step::Ray(Ray::new(to, from, slider, l, is_bounded)?))
        }
        _ => None,
    }
}

/// What a constraint leaves to a point.
fn locus(constraint: &Constraint, p: PointIdx) -> Option<Locus> {
    match constraint {
        Constraint::Length(bar) if bar.bounds.is_equality() => {
            Some(Locus::Circle(other_end(bar.points, p)?, Radius::Fixed(bar.bounds.lo)))
        }
        Constraint::Glider(glider) => {
            let [slider, a, b] = glider.points;
            if slider == p {
                return (a != p && b != p).then_some(Locus::Line([a, b], glider.bounded));
            }
            Some(Locus::Beyond(other_end([a, b], p)?, slider, glider.bounded))
        }
        Constraint::Equal(equal) if equal.bounds.is_equality() && equal.ratio > 0.0 => {
            let [a, b, c, d] = equal.points;
            let (ratio, more) = (equal.ratio, equal.bounds.lo);
            let (own, between, factor, offset) = if a == p || b == p {
                ([a, b], [c, d], ratio, more)
            } else {
                ([c, d], [a, b], 1.0 / ratio, -more / ratio)
            };
            let from = other_end(own, p)?;
            let radius = Radius::Measured { between, factor, offset };
            (!between.contains(&p)).then_some(Locus::Circle(from, radius))
        }
        _ => None,
    }
}

/// The other of two points; none where both are one.
fn other_end([a, b]: [PointIdx; 2], p: PointIdx) -> Option<PointIdx> {
    (a != b).then_some(if p == a { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::{
        Bounds, Cog, Equivalence, Glider, Hinge, Length, Motor, Orientation, Period, Point,
    };

    fn bar(points: [PointIdx; 2]) -> Constraint {
        Length { points, bounds: Bounds::exactly(4.0) }.into()
    }

    fn has_list(constraints: &[Constraint], n_free: usize, n_points: usize) -> bool {
        let plan = Plan::new(constraints, n_free, n_points);
        ClosedForm::new(&plan, constraints, n_points, 3).is_some()
    }

    #[test]
    fn wheels_links_at_angles_and_braced_points_have_a_list() {
        // The crank's end 0, the point 1 that is found; 2 to 5 stand still.
        let x = [(1.0, 0.0), (4.0, 0.0), (0.0, 0.0), (3.0, 0.0), (0.0, 5.0), (5.0, 5.0)];
        let x = x.map(|(x, y)| Point::new(x, y));
        let crank: Constraint = Motor::new([2, 0], 1.0, 0.0, 1.0).into();
        let cog: Constraint = Cog::new([2, 0, 3, 1], 2.0, &x).into();
        assert!(has_list(&[crank.clone(), bar([3, 1]), cog], 2, 6));
        let (bounds, period) = (Bounds::exactly(0.7), Period::Whole);
        let angle = Orientation { points: [2, 0, 0, 1], bounds, period, side: 0.0 };
        assert!(has_list(&[crank.clone(), bar([0, 1]), angle.into()], 2, 6));
        assert!(has_list(&[crank, bar([0, 1]), bar([3, 1]), bar([4, 1])], 2, 6));
    }

    #[test]
    fn a_slotted_link_and_what_it_carries_have_a_list() {
        // The crank's end 0, the link's end 1, points 2 and 3 that it carries; 4 and 5 stand still.
        let crank: Constraint = Motor::new([4, 0], 1.0, 0.0, 1.0).into();
        let hinge: Constraint = Hinge { points: [2, 5, 1], ratio: 0.3 }.into();
        let copy: Constraint = Equivalence { points: [5, 2, 1, 3] }.into();
        for ends in [[5, 1], [1, 5]] {
            let slot: Constraint = Glider { points: [0, ends[0], ends[1]], bounded: true }.into();
            let all = [crank.clone(), bar([5, 1]), slot, hinge.clone(), copy.clone()];
            assert!(has_list(&all, 4, 6), "{ends:?}");
        }
    }

    #[test]
    fn a_link_on_a_slider_that_hangs_from_elsewhere_has_none() {
        let crank: Constraint = Motor::new([2, 0], 1.0, 0.0, 1.0).into();
        let slot: Constraint = Glider { points: [0, 1, 3], bounded: false }.into();
        assert!(!has_list(&[crank, slot, bar([4, 1])], 2, 5));
    }
}
