//! What the solver remembers: a run that is interrupted goes on to the same bits.

use crate::support::scene::{Scene, four_bar, jansen, peaucellier};
use linkwork::constraint::{Cog, Field};
use linkwork::solve::{Budget, Memory, Method, Solver};
use linkwork::world::{Edit, Touched};

fn through_numbers(memory: &Memory) -> Memory {
    let mut copy = Memory::default();
    for (owner, numbers) in memory.to_numbers() {
        assert!(copy.restore(owner, &numbers));
    }
    assert_eq!(copy.to_numbers(), memory.to_numbers());
    copy
}

fn run(s: &mut Scene, n: usize) {
    for _ in 0..n {
        s.step();
    }
}

/// Runs a scene `n` frames, then `n` more with and without an interruption.
fn check(mut s: Scene, n: usize, edit: impl Fn(&mut Scene)) {
    run(&mut s, n);
    edit(&mut s);
    let mut loaded = Scene { world: s.world.clone(), solver: Solver::new(), settings: s.settings };
    loaded.world.take_touched(Box::new(Touched::default()));
    loaded.solver.set_memory(through_numbers(&s.solver.memory()));
    for frame in 0..n {
        let (one, other) = (s.step(), loaded.step());
        assert_eq!(s.bits(), loaded.bits(), "frame {frame}");
        assert_eq!(one.iterations, other.iterations, "frame {frame}");
    }
}

fn mechanisms(method: Method) -> Scene {
    let mut s = Scene::new();
    s.settings.method = method;
    four_bar(&mut s, [1.0, 3.5, 3.0, 4.0], 0.0, (3.0, 3.0));
    four_bar(&mut s, [4.0, 2.5, 1.0, 2.0], 1.0, (2.6, 0.8));
    jansen(&mut s);
    peaucellier(&mut s);
    let (a, b) = (s.point(20.0, 0.0), s.point(21.0, 0.0));
    let (c, d) = (s.ground(23.0, 0.0), s.point(22.0, 0.1));
    s.motor(a, b, 1.0, 0.0);
    s.coordinate(a, 20.0, 0.0);
    s.length(c, d, 1.0);
    let x = s.world.points().column().to_vec();
    s.add(Cog::new([a.0, b.0, c.0, d.0], 2.0, &x));
    s
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    for method in Method::ALL {
        check(mechanisms(method), 25, |_| {});
    }
}

#[test]
fn a_run_that_was_edited_before_the_interruption_does_too() {
    check(mechanisms(Method::Auto), 25, |s| {
        let (motor, _) = s.world.constraints().next().expect("a motor");
        s.set(motor, Field::Speed, 1.0);
        s.solver.sync(&mut s.world, &s.settings);
    });
    check(mechanisms(Method::Auto), 25, |s| {
        let (last, _) = s.world.constraints().next_back().expect("wheels");
        s.world.apply(Edit::Switch(last, false));
        s.solver.sync(&mut s.world, &s.settings);
    });
}

#[test]
fn what_is_taken_back_happens_again_to_the_bit() {
    let mut s = mechanisms(Method::Auto);
    run(&mut s, 10);
    let (moment, memory) = (s.world.moment(), s.solver.memory());
    run(&mut s, 30);
    let first = s.bits();
    s.world.go_to(moment);
    s.solver.set_memory(memory);
    run(&mut s, 30);
    assert_eq!(s.bits(), first);
}

#[test]
fn an_island_that_was_not_touched_is_not_made_anew_when_others_are_brought_back() {
    let mut s = mechanisms(Method::Auto);
    let (a, b) = (s.ground(40.0, 0.0), s.point(41.0, 0.0));
    s.length(a, b, 1.0);
    run(&mut s, 10);
    let (moment, outer) = (s.world.moment(), s.solver.begin_recall());
    s.move_to(b, 41.0, 0.5);
    run(&mut s, 5);
    let first = s.bits();
    let recall = s.solver.end_recall(outer).expect("it was asked for");
    s.world.go_to(moment);
    s.world.take_touched(Box::new(Touched::default()));
    s.move_to(b, 41.0, 0.5);
    s.solver.recall(&recall);
    run(&mut s, 5);
    assert_eq!(s.bits(), first);
    let outer = s.solver.begin_recall();
    s.move_to(b, 41.0, -0.5);
    s.solver.sync(&mut s.world, &s.settings);
    let recall = s.solver.end_recall(outer).expect("it was asked for");
    s.solver.recall(&recall);
    // Only the rod was touched.
    let report = s.solver.settle(&mut s.world, &s.settings, &Budget::default());
    assert_eq!(report.counters.islands_rebuilt, 1);
}
