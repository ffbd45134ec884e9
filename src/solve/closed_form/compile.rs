//! From the constraints of an island to its list of steps.

use super::abreast::Abreast;
use super::length::{Length, bar};
use super::nearest::FEW;
use super::{
    Bar, CircleLine, Circles, ClosedForm, Compiled, Crank, Crossing, Direction, Line, Nearest,
    Radius, Ray, Step, Sum, Wheel,
};
use crate::constraint::{Carried, Constraint, ConstraintKind as _, Point, PointIdx};
use crate::solve::frame::decomposition::{Block, Plan};

/// What a constraint leaves of the plane to a point.
#[derive(Clone, Copy)]
pub(super) enum Locus {
    /// A circle around another point.
    Circle(PointIdx, Radius),
    /// A line.
    Line(Line),
    /// The line from another through a slider; whether only the part beyond it.
    Beyond(PointIdx, PointIdx, bool),
}

/// An island at a pose that counts.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a> {
    /// The order in which its points can be found.
    pub plan: &'a Plan,
    /// Its constraints.
    pub constraints: &'a [Constraint],
    /// Where its points are, the free ones first.
    pub x: &'a [Point],
    /// How many of them are free.
    pub n_free: usize,
    /// Their inverse masses.
    pub w: &'a [f64],
    /// The highest degree up to which the motion of points that are found one by one is smooth.
    pub degree: u8,
}

/// A list on its way.
pub(super) struct Compiler<'a> {
    pub given: Given<'a>,
    pub form: ClosedForm,
    /// How many numbers drive its steps so far.
    n_driven: u32,
}

impl ClosedForm {
    /// Whether steps may ask a constraint for its values in each frame, so that these may change.
    pub fn asks(constraint: &Constraint) -> bool {
        match constraint {
            Constraint::Motor(_) | Constraint::Coordinate(_) | Constraint::Orientation(_) => true,
            Constraint::Length(bar) => bar.bounds.is_equality(),
            _ => false,
        }
    }

    /// Whether the steps of this list ask for the values of all these in each frame.
    pub fn takes_all(&self, changed: &[(u32, Constraint)]) -> bool {
        changed.iter().all(|(c, _)| self.takes(*c))
    }

    /// Whether the steps ask for the values of the constraint of this number.
    pub(super) fn takes(&self, c: u32) -> bool {
        self.held.binary_search(&c).is_err()
    }

    /// A step holds what is no more.
    pub fn outdate(&mut self) {
        self.is_outdated = true;
    }

    /// The length of a bar changed.
    fn note_length(&mut self, c: u32) {
        self.knows_lengths = false;
        self.is_outdated |= !self.takes(c);
    }

    /// Whether a step holds what is no more.
    pub fn is_outdated(&self) -> bool {
        self.is_outdated
    }
}

impl Compiled {
    /// Values of the constraint of number `c` change, from the first of these to the second.
    pub fn note_values(&mut self, c: u32, [before, now]: [&Constraint; 2]) {
        let is_bar = |constraint: &Constraint| {
            !matches!(constraint, Constraint::Length(_)) || bar(constraint).is_some()
        };
        match self {
            // What is no length has no list.
            _ if !ClosedForm::asks(now) || is_bar(before) != is_bar(now) => *self = Self::NotYet,
            Self::List(form) if matches!(now, Constraint::Length(_)) => form.note_length(c),
            // There may be one for other lengths.
            Self::Impossible if matches!(now, Constraint::Length(_)) => *self = Self::NotYet,
            // Others are asked anew in each frame.
            Self::List(_) | Self::NotYet | Self::Impossible => {}
        }
    }
}

impl<'a> Compiler<'a> {
    /// A list without steps.
    pub fn new(given: Given<'a>) -> Self {
        let Given { plan, constraints, x, degree, .. } = given;
        let form = ClosedForm {
            steps: Vec::with_capacity(plan.blocks.len()),
            cranks: Vec::new(),
            degree,
            one: Abreast::new(x.len(), 0),
            n_constraints: constraints.len() as u32,
            extent: 0.0,
            wheels: Vec::new(),
            has_blocks: false,
            knows_pose: false,
            knows_lengths: false,
            held: Vec::new(),
            is_outdated: false,
            schedule: None,
        };
        let is_driver = |c: &&Constraint| matches!(c, Constraint::Motor(_));
        let n_driven = constraints.iter().filter(is_driver).count() as u32;
        Self { given, form, n_driven }
    }

    /// The list, as far as it got.
    pub fn finish(self) -> ClosedForm {
        let Self { given, mut form, n_driven } = self;
        form.one = Abreast::new(given.x.len(), n_driven as usize);
        form.held.sort_unstable();
        form.steps = gather(form.steps);
        form
    }

    /// The steps of some of the points that are found one by one; none if one has no closed form.
    pub fn blocks(mut self, are_meant: impl Fn(&Block) -> bool) -> Option<Self> {
        let plan = self.given.plan;
        for block in plan.blocks.iter().filter(|block| are_meant(block)) {
            let which = &plan.constraints[block.first as usize..block.end as usize];
            self.point(block.point, which, block.is_determined)?;
        }
        Some(self)
    }

    /// The steps that find a point by some constraints, and check those of them that it takes no more. None
    /// if there are none; nothing is added then.
    pub fn point(&mut self, to: PointIdx, which: &[u32], is_determined: bool) -> Option<()> {
        let (step, pair) = match *which {
            [one] => (self.step(to, which, is_determined)?, [one, one]),
            [first, ref others @ ..] => others.iter().find_map(|&other| {
                let pair = [first, other];
                Some((self.step(to, &pair, is_determined)?, pair))
            })?,
            [] => return None,
        };
        let others = which.iter().copied().filter(|c| !pair.contains(c));
        self.push(step, others)
    }

    /// Adds a step, and checks of constraints after it.
    pub fn push(&mut self, step: Step, checked: impl Iterator<Item = u32>) -> Option<()> {
        let checks: Option<Vec<Step>> = checked.map(|c| self.check(c)).collect();
        let checks = checks?;
        self.n_driven += u32::from(matches!(step, Step::Direction(_) | Step::Place { .. }));
        if let Step::Wheel(wheel) = &step {
            self.form.wheels.push(wheel.by);
        }
        self.form.steps.push(step);
        self.form.steps.extend(checks);
        Some(())
    }

    /// The check of a bar whose ends others find.
    pub fn check(&self, c: u32) -> Option<Step> {
        let (points, length) = bar(&self.given.constraints[c as usize])?;
        Some(Step::Bar(Bar::new(points, Length::of_bar(length, c))))
    }

    /// The step that finds a point by one or two constraints.
    fn step(&mut self, to: PointIdx, which: &[u32], is_determined: bool) -> Option<Step> {
        let Given { constraints: all, n_free, .. } = self.given;
        match *which {
            [c] if is_determined && all[c as usize].traits().is_linear => self.assignment(c, to),
            [one, two] if is_determined => {
                let pair = [one, two].map(|c| (c, &all[c as usize]));
                let mut turned = |by, bar| self.turned(to, by, &locus(bar, to)?);
                let turned = turned(pair[0], pair[1]).or_else(|| turned(pair[1], pair[0]));
                turned.or_else(|| meeting(to, locus(pair[0], to)?, locus(pair[1], to)?, n_free))
            }
            [one] if !is_determined => match locus((one, &all[one as usize]), to)? {
                Locus::Circle(from, radius) => {
                    Some(Step::Nearest(vec![Nearest { to, from, radius }]))
                }
                Locus::Line(..) | Locus::Beyond(..) => None,
            },
            _ => None,
        }
    }

    /// The step of a constraint that says by itself where a point is.
    fn assignment(&mut self, c: u32, to: PointIdx) -> Option<Step> {
        match &self.given.constraints[c as usize] {
            Constraint::Motor(motor) if motor.measured_from().is_none() => {
                let [from, driven] = motor.crank();
                if driven != to || from == to {
                    return None;
                }
                self.form.cranks.push(Crank { to, from, motor: c, before: motor.heading() });
                Some(Step::Crank(self.form.cranks.len() as u32 - 1))
            }
            Constraint::Coordinate(_) => {
                Some(Step::Place { to, constraint: c, drive: self.n_driven })
            }
            constraint => Some(Step::Sum(Sum::new(to, constraint, self.given.x.len())?)),
        }
    }

    /// A constraint says where points are that are found together: what drives it is turned on in each frame.
    pub fn note_driver(&mut self, c: u32) {
        if let Constraint::Motor(motor) = &self.given.constraints[c as usize] {
            let ([from, to], before) = (motor.crank(), motor.heading());
            self.form.cranks.push(Crank { to, from, motor: c, before });
        }
    }

    /// The step that finds a point on a circle which a constraint turns.
    pub fn turned(&mut self, to: PointIdx, by: (u32, &Constraint), circle: &Locus) -> Option<Step> {
        let &Locus::Circle(from, Radius::Fixed(length)) = circle else { return None };
        match by {
            (_, Constraint::Cog(_) | Constraint::Rack(_)) => {
                let k = self.form.wheels.len() as u32;
                let wheel = Wheel::new(to, from, length.now, by, k)?;
                self.form.held.extend(length.bar());
                Some(Step::Wheel(wheel))
            }
            (c, Constraint::Orientation(orientation)) => {
                let by = (c, orientation);
                Some(Step::Direction(Direction::new(to, from, length, by, self.n_driven)?))
            }
            _ => None,
        }
    }
}

/// Puts all points on circles that nothing else holds behind the other steps, a few together: nothing follows
/// from where they are.
fn gather(steps: Vec<Step>) -> Vec<Step> {
    let (last, mut steps): (Vec<_>, Vec<_>) =
        steps.into_iter().partition(|step| matches!(step, Step::Nearest(_)));
    let mut points = last.into_iter().flat_map(Step::into_nearest).peekable();
    while points.peek().is_some() {
        steps.push(Step::Nearest(points.by_ref().take(FEW).collect()));
    }
    steps
}

/// Whether a step may keep what a constraint keeps from frame to frame.
pub(super) fn may_have_a_step(constraint: &Constraint) -> bool {
    let is_told = matches!(constraint.traits().carried, Carried::Nothing | Carried::ByClock);
    is_told
        || matches!(
            constraint,
            Constraint::Cog(_) | Constraint::Rack(_) | Constraint::Orientation(_)
        )
}

/// Whether a constraint says by itself what it holds; a motor that is measured from a line does not.
pub(super) fn is_told(constraint: &Constraint) -> bool {
    !matches!(constraint, Constraint::Motor(motor) if motor.measured_from().is_some())
}

/// The step that finds a point on two loci; as many points as that, the first, are free.
pub(super) fn meeting(to: PointIdx, one: Locus, two: Locus, n_free: usize) -> Option<Step> {
    match (one, two) {
        (Locus::Circle(a, Radius::Fixed(l)), Locus::Circle(b, Radius::Fixed(m))) => {
            (a != b).then_some(Step::Circles(Circles::new(to, [a, b], [l, m])?))
        }
        (Locus::Circle(from, Radius::Fixed(l)), Locus::Line(line))
        | (Locus::Line(line), Locus::Circle(from, Radius::Fixed(l))) => {
            if line.is_fixed(n_free) {
                Some(Step::CircleLine(CircleLine::new(to, from, line, l)?))
            } else {
                Some(Step::CircleMovingLine(CircleLine::new(to, from, line, l)?))
            }
        }
        (Locus::Line(one), Locus::Line(two)) => {
            Some(Step::Crossing(Crossing::new(to, [one, two])?))
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
pub(super) fn locus((c, constraint): (u32, &Constraint), p: PointIdx) -> Option<Locus> {
    match constraint {
        Constraint::Length(bar) if bar.bounds.is_equality() => {
            let radius = Radius::Fixed(Length::of_bar(bar.bounds.lo, c));
            Some(Locus::Circle(other_end(bar.points, p)?, radius))
        }
        Constraint::Glider(glider) => {
            let [slider, a, b] = glider.points;
            if slider == p {
                let line = Line::through([a, b], glider.bounded);
                return (a != p && b != p && a != b).then_some(Locus::Line(line));
            }
            Some(Locus::Beyond(other_end([a, b], p)?, slider, glider.bounded))
        }
        Constraint::Distance(distance) if distance.bounds.is_equality() => {
            let [own, a, b] = distance.points;
            let line = Line::beside([a, b], distance.bounds.lo);
            (own == p && a != p && b != p && a != b).then_some(Locus::Line(line))
        }
        Constraint::Aligned(aligned) => {
            let from = other_end(aligned.points, p)?;
            Some(Locus::Line(Line::parallel_to_axis(from, aligned)))
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
        has_list_at(constraints, n_free, &vec![Point::ORIGIN; n_points])
    }

    fn has_list_at(constraints: &[Constraint], n_free: usize, x: &[Point]) -> bool {
        let (plan, w) = (Plan::new(constraints, n_free, x.len()), vec![1.0; x.len()]);
        let (plan, w) = (&plan, &w);
        ClosedForm::new(Given { plan, constraints, x, n_free, w, degree: 3 }).is_some()
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
    fn a_link_on_a_slider_that_hangs_from_elsewhere_is_found_with_its_slot() {
        let crank: Constraint = Motor::new([2, 0], 1.0, 0.0, 1.0).into();
        let slot: Constraint = Glider { points: [0, 1, 3], bounded: false }.into();
        let x = [(1.0, 0.0), (4.0, 3.0), (0.0, 0.0), (-2.0, -3.0), (4.0, 7.0)];
        let x = x.map(|(x, y)| Point::new(x, y));
        assert!(has_list_at(&[crank.clone(), slot.clone(), bar([4, 1])], 2, &x));
        let cord: Constraint =
            Length { points: [4, 1], bounds: Bounds { lo: 0.0, hi: 4.0 } }.into();
        assert!(!has_list_at(&[crank, slot, cord], 2, &x));
    }
}
