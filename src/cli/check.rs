//! `linkwork check`: what a script makes, examined at its end.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::args::Examination;
use super::run::{self, Status};
use super::talk;
use crate::session::Check;

/// Runs a script and says what there is to know about the mechanism at its end.
pub fn script(examination: &Examination) -> Status {
    let mut session = run::begin(&examination.outside);
    let status = run::script(&examination.file, &mut session);
    talk::flush();
    if status != Status::Fine {
        return status;
    }
    let check = session.examine();
    let text = if examination.json {
        format!("{:#}\n", to_json(&check))
    } else {
        check.lines().into_iter().map(|line| line + "\n").collect()
    };
    // Whoever closed the pipe has read enough.
    let _ = io::stdout().lock().write_all(text.as_bytes());
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
