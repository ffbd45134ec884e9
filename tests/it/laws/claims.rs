//! What is said to be solved is solved, whatever came before: every violation is within the
//! tolerance, and every live value is what its expression gives, both evaluated anew.

use super::random_scene::{after, edit, scene};
use super::random_session::{SCENE, statements};
use crate::support::draws::draws;
use crate::support::fresh::flaws;
use crate::support::talk::Talking;
use linkwork::diag::Diagnostic;
use linkwork::session::Flow;
use proptest::prelude::*;

/// The tolerance that a statement says the world is solved to, if it says so.
fn claim(talking: &mut Talking, statement: &str) -> Result<Option<f64>, Diagnostic> {
    let frame = talking.world().clock().frame;
    talking.talk.told();
    let flow = talking.execute(statement)?;
    let told = talking.talk.told();
    assert_eq!(flow, Flow::On);
    if statement == "solve" {
        let is_met = told.iter().any(|told| told.starts_with("converged"));
        return Ok(is_met.then(|| tolerance(talking)));
    }
    let is_run = ["step", "run", "drag"].iter().any(|word| statement.starts_with(word));
    if !is_run || talking.world().clock().frame == frame {
        return Ok(None);
    }
    let summary = talking.session.last_run().expect("frames have passed");
    Ok((summary.n_missed == 0).then_some(summary.tolerance))
}

/// The tolerance that is set.
fn tolerance(talking: &mut Talking) -> f64 {
    let line = talking.ask("set tolerance").concat();
    let value = line.split_whitespace().nth(2).expect("`set tolerance VALUE`");
    value.parse().expect("a number")
}

/// Carries out statements; what a claim of any of them leaves to be desired.
fn check(talking: &mut Talking, statements: &[String]) -> Result<(), TestCaseError> {
    for (k, statement) in statements.iter().enumerate() {
        // A refusal claims nothing.
        let claim = claim(talking, statement).unwrap_or_default();
        if let Some(tolerance) = claim {
            let flaws = flaws(talking.world(), 4.0 * tolerance);
            prop_assert!(flaws.is_empty(), "{flaws:?} after {:#?}", &statements[..=k]);
        }
        // What `check` says is said of the pose on the screen, run or not.
        if talking.ask("check").iter().any(|line| line.starts_with("status: converged")) {
            let tolerance = tolerance(talking);
            let flaws = flaws(talking.world(), 4.0 * tolerance);
            prop_assert!(flaws.is_empty(), "{flaws:?} checked after {:#?}", &statements[..=k]);
        }
    }
    Ok(())
}

/// The same with a loose tolerance to begin with and a tight one in the end: what was solved by
/// the one is not by the other.
fn roughly_then_exactly(statements: Vec<String>) -> Vec<String> {
    let rough = "set tolerance 1e-5".to_owned();
    let exact = ["set method auto; set tolerance 1e-12", "solve", "step", "step 2"];
    let exact = exact.map(str::to_owned).to_vec();
    [vec![rough], statements, exact].concat()
}

proptest! {
    #![proptest_config(draws(60))]

    #[test]
    fn what_is_said_to_be_solved_is_so_in_random_scenes(
        scene in scene(),
        edits in prop::collection::vec(edit(), 1..16),
    ) {
        check(&mut after(&scene), &roughly_then_exactly(edits))?;
    }

    #[test]
    fn what_is_said_to_be_solved_is_so_in_random_sessions(statements in statements(16)) {
        check(&mut Talking::after(SCENE), &roughly_then_exactly(statements))?;
    }
}
