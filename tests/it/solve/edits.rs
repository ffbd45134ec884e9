//! Edits where everything holds: they are no work, and make no difference to what comes after.

use crate::support::scene::{Scene, four_bar};
use linkwork::constraint::Field;
use linkwork::solve::{Counters, Memory, Method, Solver, Status};
use linkwork::world::{ConstraintId, Edit, PointId, Touched};
use proptest::prelude::*;

/// A chain of so many bars that hangs from the ground, beside a four-bar that a motor turns.
struct Chain {
    s: Scene,
    points: Vec<PointId>,
    bars: Vec<ConstraintId>,
}

impl Chain {
    fn new(n: usize) -> Self {
        let mut s = Scene::new();
        let mut points = vec![s.ground(0.0, 0.0)];
        points.extend((1..=n).map(|k| s.point(k as f64, 0.01 * (k * k) as f64 / n as f64)));
        let mut chain = Self { s, points, bars: Vec::new() };
        (0..n).for_each(|k| chain.join(chain.points[k], chain.points[k + 1]));
        four_bar(&mut chain.s, [1.0, 3.5, 3.0, 4.0], 0.0, (3.0, 3.0));
        (0..4).for_each(|_| _ = chain.s.step());
        chain
    }

    /// Puts a bar in between two points as they are.
    fn join(&mut self, a: PointId, b: PointId) {
        let length = self.s.at(a).distance(self.s.at(b));
        self.bars.push(self.s.length(a, b, length));
    }

    fn switch(&mut self, k: usize, is_on: bool) {
        self.s.world.apply(Edit::Switch(self.bars[k], is_on));
    }

    fn freeze(&mut self, k: usize, is_frozen: bool) {
        self.s.world.apply(Edit::Freeze(self.points[k], is_frozen));
    }

    /// A bar to a new point at the end.
    fn append(&mut self) {
        let last = *self.points.last().expect("it has some");
        let at = self.s.at(last);
        let next = self.s.point(at.x + 1.0, at.y + 0.5);
        self.points.push(next);
        self.join(last, next);
    }

    fn delete(&mut self, k: usize) {
        self.s.world.apply(Edit::Constraint(self.bars[k], None));
    }

    fn lengthen(&mut self, k: usize, length: f64) {
        self.s.set(self.bars[k], Field::Lo, length);
        self.s.set(self.bars[k], Field::Hi, length);
    }

    /// The work of taking in what was edited, and of the next frame.
    fn work(&mut self) -> Counters {
        let taken_in = self.s.settle().counters;
        taken_in.plus(&self.s.step().counters)
    }
}

/// An edit of a chain.
type Make = fn(&mut Chain);

#[test]
fn edits_of_what_holds_and_rests_are_no_work() {
    let mut chain = Chain::new(1000);
    let moving = chain.work();
    let edits: [(&str, Make); 9] = [
        ("off", |chain| chain.switch(500, false)),
        ("on", |chain| chain.switch(500, true)),
        ("freeze", |chain| chain.freeze(300, true)),
        ("thaw", |chain| chain.freeze(300, false)),
        ("append", Chain::append),
        ("delete within", |chain| chain.delete(700)),
        ("delete at the end", |chain| chain.delete(999)),
        ("join", |chain| chain.join(chain.points[100], chain.points[102])),
        ("nothing", |_| {}),
    ];
    for (what, edit) in edits {
        edit(&mut chain);
        assert_eq!(chain.work(), moving, "{what}");
    }
}

#[test]
fn what_was_edited_is_put_together_once_it_moves() {
    let mut chain = Chain::new(100);
    for k in [20, 40, 60] {
        chain.switch(k, false);
        chain.s.step();
    }
    chain.lengthen(10, 1.1);
    let report = chain.s.settle();
    // Four pieces, of which one is to be solved beside the four-bar.
    let counters = report.counters;
    assert_eq!((counters.islands_rebuilt, counters.islands_visited), (4, 2));
    assert!(report.status == Status::Converged && report.residual <= 1e-12, "{report:?}");
    let bar = chain.bars[10];
    assert!(chain.s.solver.violation(&chain.s.world, bar) < 1e-11);
}

#[test]
fn a_bar_that_does_not_hold_is_solved() {
    for method in Method::ALL {
        let mut chain = Chain::new(10);
        chain.s.settings.method = method;
        chain.s.step();
        chain.switch(4, false);
        chain.s.step();
        chain.lengthen(4, 1.2);
        chain.switch(4, true);
        let report = chain.s.settle();
        assert!(report.residual <= 1e-12 && chain.s.worst() < 1e-11, "{method:?}: {report:?}");
    }
}

/// Makes the solver of a scene anew from what it remembers.
fn begin_anew(s: &mut Scene) {
    let mut memory = Memory::default();
    for (owner, numbers) in s.solver.memory().to_numbers() {
        assert!(memory.restore(owner, &numbers));
    }
    s.world.take_touched(Box::new(Touched::default()));
    s.solver = Solver::new();
    s.solver.set_memory(memory);
}

/// One of the edits there are, of the place that `k` says.
fn edit(chain: &mut Chain, what: u32, k: usize) {
    let (p, bar) = (1 + k % (chain.points.len() - 1), k % chain.bars.len());
    let is_there = chain.s.world.constraint(chain.bars[bar]).is_some();
    let (point, at) = (chain.points[p], chain.s.at(chain.points[p]));
    match what {
        0 | 1 if is_there => chain.switch(bar, what == 0),
        2 | 3 => chain.freeze(p, what == 2),
        4 => chain.append(),
        5 if is_there => chain.delete(bar),
        6 => chain.join(chain.points[p - 1], chain.points[(p + 5) % chain.points.len()]),
        7 if is_there => chain.lengthen(bar, 1.0 + k as f64 / 100.0),
        8 => chain.s.move_to(point, at.x + 0.1, at.y),
        9 => chain.s.move_to(chain.points[0], 0.01 * k as f64, 0.0),
        10 => _ = chain.s.world.apply(Edit::Weight(point, 1.0 + (k % 3) as f64)),
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whether islands are put together at once, after each edit, or when that is needed.
    #[test]
    fn when_islands_are_put_together_is_never_seen(
        edits in prop::collection::vec((0_u32..12, 0_usize..40), 1..12),
    ) {
        let mut lazy = Chain::new(12);
        let mut eager = Chain::new(12);
        for (n, (what, k)) in edits.into_iter().enumerate() {
            for chain in [&mut lazy, &mut eager] {
                edit(chain, what, k);
            }
            if (n + k) % 3 > 0 {
                let reports = [&mut lazy, &mut eager].map(|chain| chain.s.step());
                prop_assert_eq!(reports[0].status, reports[1].status, "edit {}", n);
                begin_anew(&mut eager.s);
                prop_assert_eq!(lazy.s.bits(), eager.s.bits(), "edit {}", n);
                let memory = |chain: &Chain| chain.s.solver.memory().to_numbers();
                prop_assert_eq!(memory(&lazy), memory(&eager), "edit {}", n);
                let mut anew = Solver::new();
                anew.sync(&mut lazy.s.world.clone(), &lazy.s.settings);
                let sizes = [&lazy.s.solver, &anew].map(|solver| solver.size(&lazy.s.world));
                prop_assert_eq!(sizes[0].to_bits(), sizes[1].to_bits(), "edit {}", n);
            }
        }
    }
}
