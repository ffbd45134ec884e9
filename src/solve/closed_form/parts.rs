//! The steps of what does not fall apart point by point: bodies, and points that hang on them.
//!
//! A body one of whose points is known holds each of its others as a bar would. Two known points say
//! where it is.

use std::collections::VecDeque;

use super::cluster::{Cluster, Net};
use super::compile::{Compiler, Locus, locus, meeting};
use super::{Body, Radius, Step};
use crate::constraint::{ConstraintKind as _, PointIdx};
use crate::solve::frame::decomposition::{Part, Search};

/// What is known of a part of an island on the way.
struct Assembly<'a> {
    search: &'a mut Search,
    bodies: Vec<Cluster>,
    /// The bodies that a point is of, for each point.
    of_point: &'a mut [Vec<u32>],
    /// The first point of each body that was known.
    anchors: Vec<Option<PointIdx>>,
    is_placed: Vec<bool>,
    /// Whether a constraint is checked by a step.
    is_met: Vec<bool>,
    /// Bodies that may be placed now, and points that may be found.
    next_bodies: VecDeque<usize>,
    next_points: VecDeque<PointIdx>,
}

impl Compiler<'_> {
    /// The steps of all parts; none if one has no closed form.
    pub fn parts(&mut self) -> Option<()> {
        let (plan, x) = (self.given.plan, self.given.x);
        let constraints = self.given.constraints;
        let mut search = Search::new(constraints, self.given.n_free, x.len());
        for block in plan.blocks.iter().filter(|block| block.is_determined) {
            search.learn(constraints, block.point);
        }
        let mut net = Net::new(constraints, x, &plan.rest);
        let mut of_point = vec![Vec::new(); x.len()];
        let mut is_smooth = true;
        for part in &plan.rest {
            is_smooth &= self.part(part, &mut net, &mut search, &mut of_point)?;
        }
        // Whether that was found out already makes no difference to what is kept of poses.
        self.form.degree = if is_smooth { 3 } else { 1 };
        Some(())
    }

    /// The steps of a part, and whether it has no freedom.
    fn part(
        &mut self,
        part: &Part,
        net: &mut Net,
        search: &mut Search,
        of_point: &mut [Vec<u32>],
    ) -> Option<bool> {
        let bodies = net.clusters(part);
        let n = bodies.len();
        let mut assembly = Assembly {
            search,
            bodies,
            of_point,
            anchors: vec![None; n],
            is_placed: vec![false; n],
            is_met: net.is_inside.clone(),
            next_bodies: (0..n).collect(),
            next_points: part.points.iter().copied().collect(),
        };
        assembly.file();
        loop {
            if let Some(b) = assembly.next_bodies.pop_front() {
                self.body(b, &mut assembly)?;
            } else if let Some(p) = assembly.next_points.pop_front() {
                self.joint(p, &mut assembly);
            } else {
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
        let is_found = if n_firm >= 2 {
            self.point(p, &ready, true).is_some()
        } else {
            self.hang(p, &ready, &assembly.circles(p)).is_some()
        };
        if is_found {
            ready.iter().for_each(|&c| assembly.is_met[c as usize] = true);
            assembly.learn(self, p);
        }
    }

    /// The step that finds a point of bodies of which a point is known each, by constraints and by
    /// these bodies.
    fn hang(&mut self, to: PointIdx, ready: &[u32], circles: &[Locus]) -> Option<()> {
        let (&first, others) = circles.split_first()?;
        let all = self.given.constraints;
        let by_one = ready.iter().find_map(|&c| {
            let constraint = &all[c as usize];
            let turned = self.turned(to, (c, constraint), &first);
            Some((turned.or_else(|| meeting(to, first, locus(constraint, to)?))?, Some(c)))
        });
        let (step, by) = by_one.or_else(|| Some((meeting(to, first, *others.first()?)?, None)))?;
        self.push(step, ready.iter().copied().filter(|&c| Some(c) != by))
    }

    /// A part that is one body, of which a point is known, swings about that.
    fn swing(&mut self, part: &Part, assembly: &mut Assembly) -> Option<()> {
        let [cluster] = &assembly.bodies[..] else { return None };
        let is_all = part.constraints.iter().all(|&c| assembly.is_met[c as usize])
            && part.points.iter().all(|p| cluster.place(*p).is_some());
        let _ = assembly.anchors[0].filter(|_| is_all)?;
        self.place(cluster, assembly)?;
        Some(())
    }
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
    fn learn(&mut self, compiler: &Compiler, p: PointIdx) {
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
            Some(Locus::Circle(anchor, Radius::Fixed(radius)))
        };
        let bodies = self.of_point[p as usize].iter();
        bodies.filter(|&&b| !self.is_placed[b as usize]).filter_map(circle).collect()
    }
}
