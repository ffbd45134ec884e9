//! Expressions that would become very long: what is handed on is shared, and what cannot be shared is
//! refused before it takes for ever.

use crate::support::compare::check_same;
use crate::support::talk::Talking;

/// Definitions that hand on their argument twice each, `n` levels of them.
fn doubling(n: usize) -> String {
    let levels = (1..=n).map(|k| format!("define d{k}(x) {{ use d{}(x + x) }}\n", k - 1));
    let last = format!(
        "point A = (0, 0) frozen, B = (1, 0)
        define d0(x) {{ rod: length A B = 1 + x / 2^{n} }}\n"
    );
    last + &levels.collect::<String>()
}

#[test]
fn an_argument_that_is_doubled_forty_times_is_shared() {
    let mut talking = Talking::after(&doubling(40));
    talking.run("use d40(1 + time); step 60");
    talking.run("assert distance(A, B) = 2 + time within 1e-9; assert time = 1 within 1e-9");
    talking.assert_goes_on_from_its_file("step 3; check");
    let instance = "d401";
    talking.run(&format!("delete {instance} cascade"));
    assert_eq!(talking.world().constraints().count(), 0);
    assert_eq!(talking.world().parameters().count(), 0, "what was shared belongs to the instance");
}

#[test]
fn a_short_argument_stays_where_it_is() {
    let mut talking = Talking::after(&doubling(3));
    talking.run("use d3(1 + time)");
    assert_eq!(talking.world().parameters().count(), 0);
}

#[test]
fn parameters_that_double_are_worked_out_once() {
    let levels = (1..=40).map(|k| format!("let a{k} = a{0} + a{0}\n", k - 1));
    let script = format!(
        "point A = (0, 0) frozen, B = (1, 0)\nlet a0 = B.x\n{}rod: hold a40 / 2^40 = 1 + time",
        levels.collect::<String>()
    );
    let mut talking = Talking::after(&script);
    talking.run("step 60; assert B.x = 2 within 1e-9; check");
    talking.assert_goes_on_from_its_file("step; delete rod; delete a0 cascade");
}

#[test]
fn the_unit_of_what_follows_many_others_is_asked_of_a_few() {
    let levels = (1..=60).map(|k| format!("let a{k} = a{0} + a{0}\n", k - 1));
    let rows = (1..20_000).map(|k| format!("let b{k} = b{} + 0\n", k - 1));
    let script = format!(
        "let a0 = 3deg\nlet b0 = 3deg\n{}{}",
        levels.collect::<String>(),
        rows.collect::<String>()
    );
    let mut talking = Talking::after(&script);
    talking.run("show b19999; show a60; show a1; list");
    let said = talking.talk.printed.join("\n");
    assert!(said.contains("6deg"), "what is near has its unit:\n{said}");
}

#[test]
fn parameters_that_double_what_is_missed_are_refused_at_once() {
    let levels = (1..=40).map(|k| format!("let a{k} = a{0} + a{0}\n", k - 1));
    let levels: String = levels.collect();
    let mut talking = Talking::after(&format!(
        "point A = (0, 0) frozen, B = (1, 0)\nrod: length A B = 1\nlet a0 = rod.residual\n{levels}"
    ));
    let problem = talking.execute("length A B = 1 + a40").expect_err("it follows from the rod");
    assert_eq!(&*problem.message, "`rod.residual` cannot drive a constraint");
}

const TOO_LONG: &str = "this is too long with all that it mentions";

/// Makes things that each mention the one before, up to the first that is refused; gives how many
/// there are then.
fn made_before_refusal(first: &str, next: impl Fn(usize) -> String) -> usize {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0)");
    talking.run(first);
    for k in 1..10_000 {
        let before = talking.world().constraints().count();
        if let Err(problem) = talking.execute(&next(k)) {
            assert_eq!(&*problem.message, TOO_LONG);
            assert_eq!(talking.world().constraints().count(), before);
            let script = talking.script();
            check_same(&Talking::after(&script).script(), &script, "what was made is kept");
            return k;
        }
    }
    panic!("nothing was refused");
}

#[test]
fn members_that_double_are_refused() {
    let hold = |k| format!("h{k}: hold h{0}.value + h{0}.value = 2^{k}", k - 1);
    assert!((10..20).contains(&made_before_refusal("h0: hold B.x = 1", hold)));
    let circle = |k| format!("circle c{k} = A radius (c{0}.radius + c{0}.radius) / 2", k - 1);
    assert!((10..20).contains(&made_before_refusal("circle c0 = A radius B.x", circle)));
}

#[test]
fn members_behind_each_other_are_refused_before_the_stack_ends() {
    let hold = |k| format!("h{k}: hold h{}.value + 0 = 1", k - 1);
    assert!(made_before_refusal("h0: hold B.x = 1", hold) > 100);
    let circle = |k| format!("circle c{k} = A radius c{}.radius + 0", k - 1);
    assert!(made_before_refusal("circle c0 = A radius B.x", circle) > 100);
}
