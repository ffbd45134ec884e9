//! The steps of bodies, and of points that hang on them.
//!
//! A body one of whose points is known holds each of its others as a bar would. Two known points say
//! where it is. Where that leads no further a few bodies and points are found [together](super::block).

use std::collections::VecDeque;

use super::cluster::{Cluster, Net};
use super::compile::{Compiler, Given, Locus, locus, may_have_a_step, meeting};
use super::length::bar;
use super::{Body, ClosedForm, Length, Radius, Step};
use crate::constraint::{ConstraintKind as _, PointIdx};
use crate::solve::frame::decomposition::{Part, Plan, Search};

/// What is known of a part of an island on the way.
pub(super) struct Assembly<'a> {
    pub search: &'a mut Search,
    pub bodies: Vec<Cluster>,
    /// The bodies that a point is of, for each point.
    pub of_point: &'a mut [Vec<u32>],
    /// The first point of each body that was known.
    anchors: Vec<Option<PointIdx>>,
    pub is_placed: Vec<bool>,
    /// Whether a constraint is checked by a step.
    pub is_met: &'a mut [bool],
    /// The checks of constraints that said where something is, for when all of it is found.
    pub unchecked: Vec<Step>,
    /// Bodies that may be placed now, and points that may be found.
    next_bodies: VecDeque<usize>,
    next_points: VecDeque<PointIdx>,
}

/// A body of fewer points is found as fast point by point.
const FEW: usize = 6;

impl ClosedForm {
    /// The list for an island; none if some of its points have no closed form.
    pub fn new(given: Given) -> Option<Self> {
        let may_be = given.constraints.iter().all(may_have_a_step);
        may_be.then(|| list(given))?.map(Compiler::finish)
    }
}

/// The steps of an island; none if some of it has no closed form. They are the same whenever they are
/// compiled: a length that has to do with which they are is one that the list holds.
fn list(given: Given) -> Option<Compiler> {
    let Given { plan, constraints, x, .. } = given;
    let by_points = || Compiler::new(given).blocks(|_| true).filter(|_| plan.is_complete());
    if constraints.len() < 2 * FEW - 3
        && let Some(compiler) = by_points()
    {
        return Some(compiler);
    }
    let mut parts = vec![determined(plan)];
    parts.extend(plan.rest.iter().cloned());
    let mut net = Net::new(constraints, x, &parts);
    let bodies: Vec<Vec<Cluster>> = parts.iter().map(|part| net.clusters(part)).collect();
    let is_bar = |c: &u32| bar(&constraints[*c as usize]).is_some();
    let all_bars = || (0..constraints.len() as u32).filter(is_bar);
    if bodies.iter().flatten().all(|body| body.points.len() < FEW)
        && let Some(mut compiler) = by_points()
    {
        if net.is_by_lengths {
            compiler.form.held.extend(all_bars());
        }
        return Some(compiler);
    }
    let within = bodies.iter().flatten().flat_map(|body| &body.constraints);
    let held: Vec<u32> =
        if net.is_by_lengths { all_bars().collect() } else { within.copied().collect() };
    let found = Compiler::new(given).by_bodies(&parts, bodies, net.is_inside);
    // How far the ends of a body are apart says whether it is known by them.
    let mut compiler = found.or_else(by_points)?;
    compiler.form.held.extend(held);
    Some(compiler)
}

impl Compiler<'_> {
    /// The steps of parts with bodies, and of the points that are found after them.
    fn by_bodies(
        mut self,
        parts: &[Part],
        bodies: Vec<Vec<Cluster>>,
        mut is_met: Vec<bool>,
    ) -> Option<Self> {
        let Given { plan, constraints, n_free, x, .. } = self.given;
        let mut search = Search::new(constraints, n_free, x.len());
        let mut of_point = vec![Vec::new(); x.len()];
        let mut is_smooth = true;
        for (part, bodies) in parts.iter().zip(bodies) {
            let n = bodies.len();
            let assembly = Assembly {
                search: &mut search,
                bodies,
                of_point: &mut of_point,
                anchors: vec![None; n],
                is_placed: vec![false; n],
                is_met: &mut is_met,
                unchecked: Vec::new(),
                next_bodies: (0..n).collect(),
                next_points: part.points.iter().copied().collect(),
            };
            is_smooth &= self.part(part, assembly)?;
        }
        if !plan.is_complete() {
            // Whether that was found out already makes no difference to what is kept of poses.
            self.form.degree = if is_smooth { 3 } else { 1 };
        }
        self.blocks(|block| !block.is_determined)
    }

    /// The steps of a part, and whether it has no freedom.
    fn part(&mut self, part: &Part, mut assembly: Assembly) -> Option<bool> {
        assembly.file();
        loop {
            if let Some(b) = assembly.next_bodies.pop_front() {
                self.body(b, &mut assembly)?;
            } else if let Some(p) = assembly.next_points.pop_front() {
                self.joint(p, &mut assembly);
            } else if !self.together(part, &mut assembly) {
                break;
            }
        }
        let is_found = part.points.iter().all(|&p| assembly.search.knows(p));
        if !is_found {
            self.swing(part, &mut assembly)?;
        }
        for c in part.constraints.iter().copied().filter(|&c| !assembly.is_met[c as usize]) {
            let check = self.check(c)?;
            self.form.steps.push(check);
        }
        self.form.steps.append(&mut assembly.unchecked);
        assembly.unfile();
        Some(is_found)
    }

    /// Places a body if two of its points are known. None if that does not say where it is.
    fn body(&mut self, b: usize, assembly: &mut Assembly) -> Option<()> {
        let cluster = &assembly.bodies[b];
        let known = cluster.points.iter().filter(|(p, _)| assembly.search.knows(*p));
        if assembly.is_placed[b] || known.take(2).count() < 2 {
            return Some(());
        }
        assembly.is_placed[b] = true;
        let found = self.place(cluster, assembly)?;
        found.into_iter().for_each(|p| assembly.learn(self, p));
        Some(())
    }

    /// Adds the step of a body; gives the points that it finds.
    fn place(&mut self, cluster: &Cluster, assembly: &Assembly) -> Option<Vec<PointIdx>> {
        let is_known = |p: PointIdx| assembly.search.knows(p);
        let mass = |p: PointIdx| 1.0 / self.given.w[p as usize];
        let body = Body::new(cluster, self.given.constraints, is_known, mass)?;
        // The longer side of what holds two points is no shorter than that.
        self.form.extent = self.form.extent.max(body.extent * std::f64::consts::FRAC_1_SQRT_2);
        let found = body.finds().collect();
        self.form.steps.push(Step::Body(Box::new(body)));
        Some(found)
    }

    /// Finds a point if enough is known around it.
    fn joint(&mut self, p: PointIdx, assembly: &mut Assembly) {
        if assembly.search.knows(p) {
            return;
        }
        let all = self.given.constraints;
        let ready = assembly.search.ready(p).filter(|&c| !assembly.is_met[c as usize]);
        let ready: Vec<u32> = ready.collect();
        let n_firm: usize = ready.iter().map(|&c| all[c as usize].traits().n_firm_rows).sum();
        let is_found = n_firm >= 2 && self.point(p, &ready, true).is_some()
            || self.hang(p, &ready, &assembly.circles(p)).is_some();
        if is_found {
            ready.iter().for_each(|&c| assembly.is_met[c as usize] = true);
            assembly.learn(self, p);
        }
    }

    /// The step that finds a point of bodies of which a point is known each, by constraints and by
    /// these bodies.
    fn hang(&mut self, to: PointIdx, ready: &[u32], circles: &[Locus]) -> Option<()> {
        let Given { constraints: all, n_free, .. } = self.given;
        let mut by_one = |circle: &Locus| {
            ready.iter().find_map(|&c| {
                let constraint = &all[c as usize];
                let turned = self.turned(to, (c, constraint), circle);
                let step =
                    turned.or_else(|| meeting(to, *circle, locus((c, constraint), to)?, n_free))?;
                Some((step, Some(c)))
            })
        };
        let by_two = || {
            let pairs = circles
                .iter()
                .enumerate()
                .flat_map(|(k, one)| circles[k + 1..].iter().map(move |other| (*one, *other)));
            pairs
                .into_iter()
                .find_map(|(one, other)| Some((meeting(to, one, other, n_free)?, None)))
        };
        let (step, by) = circles.iter().find_map(&mut by_one).or_else(by_two)?;
        self.push(step, ready.iter().copied().filter(|&c| Some(c) != by))
    }

    /// A part that is one body, of which a point is known, swings about that.
    fn swing(&mut self, part: &Part, assembly: &mut Assembly) -> Option<()> {
        let [cluster] = &assembly.bodies[..] else { return None };
        let is_all = part.constraints.iter().all(|&c| assembly.is_met[c as usize])
            && part.points.iter().all(|p| cluster.place(*p).is_some());
        (is_all && assembly.anchors[0].is_some()).then(|| self.place(cluster, assembly))??;
        Some(())
    }
}

/// All points that can be found one by one, as one part.
fn determined(plan: &Plan) -> Part {
    let mut part = Part::default();
    for block in plan.blocks.iter().filter(|block| block.is_determined) {
        part.points.push(block.point);
        let which = block.first as usize..block.end as usize;
        part.constraints.extend(&plan.constraints[which]);
    }
    part.points.sort_unstable();
    part.constraints.sort_unstable();
    part
}

impl Assembly<'_> {
    /// Files the bodies under their points.
    fn file(&mut self) {
        for (b, body) in self.bodies.iter().enumerate() {
            for &(p, _) in &body.points {
                self.of_point[p as usize].push(b as u32);
            }
            self.anchors[b] = body.points.iter().map(|(p, _)| *p).find(|&p| self.search.knows(p));
        }
    }

    /// And takes them out again.
    fn unfile(&mut self) {
        let points = self.bodies.iter().flat_map(|body| &body.points);
        points.for_each(|&(p, _)| self.of_point[p as usize].clear());
    }

    /// A point is known, and with it perhaps others.
    pub fn learn(&mut self, compiler: &Compiler, p: PointIdx) {
        self.next_points.extend(self.search.learn(compiler.given.constraints, p));
        for &b in &self.of_point[p as usize] {
            let b = b as usize;
            if self.is_placed[b] {
                continue;
            }
            self.next_bodies.push_back(b);
            if self.anchors[b].is_none() {
                self.anchors[b] = Some(p);
                self.next_points.extend(self.bodies[b].points.iter().map(|(p, _)| *p));
            }
        }
    }

    /// The circles on which bodies hold a point.
    fn circles(&self, p: PointIdx) -> Vec<Locus> {
        let circle = |&b: &u32| {
            let anchor = self.anchors[b as usize]?;
            let body = &self.bodies[b as usize];
            let radius = (body.place(p)? - body.place(anchor)?).norm();
            Some(Locus::Circle(anchor, Radius::Fixed(Length::fixed(radius))))
        };
        let bodies = self.of_point[p as usize].iter();
        bodies.filter(|&&b| !self.is_placed[b as usize]).filter_map(circle).collect()
    }
}
