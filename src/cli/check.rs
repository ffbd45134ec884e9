//! `linkwork check`: what a script makes, examined at its end.

use serde_json::{Value, json};

use super::args::Examination;
use super::output;
use super::quiet::rehearse;
use super::run::Status;
use crate::session::Check;

/// Runs a script and says what there is to know about the mechanism at its end.
pub fn script(examination: &Examination) -> Status {
    let session = match rehearse(&examination.file, &examination.outside) {
        Ok(session) => session,
        Err(status) => return status,
    };
    let check = session.examine();
    if examination.json {
        output::answer(&format!("{:#}", to_json(&check)));
    } else {
        check.lines().iter().for_each(|line| output::answer(line));
    }
    if check.is_sound() { Status::Fine } else { Status::BrokenPromise }
}

fn to_json(check: &Check) -> Value {
    let redundant = check.redundant.iter();
    let conflicting = check.conflicting.iter();
    let unsatisfiable = check.unsatisfiable.iter();
    json!({
        "degrees_of_freedom": check.degrees_of_freedom,
        "redundant": redundant
            .map(|(name, depends_on)| json!({ "constraint": name, "depends_on": depends_on }))
            .collect::<Vec<_>>(),
        "conflicting": conflicting
            .map(|(names, residual)| json!({ "constraints": names, "residual": residual }))
            .collect::<Vec<_>>(),
        "unsatisfiable": unsatisfiable.map(|found| &found.constraint).collect::<Vec<_>>(),
        "pose": check.pose_word(),
        "status": check.status.word(),
        "residual": check.residual,
    })
}
