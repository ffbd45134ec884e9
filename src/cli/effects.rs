//! `linkwork effects`: which effects a script's scene has switched on at its end.

use serde_json::{Value, json};

use super::args::Examination;
use super::output;
use super::quiet::rehearse;
use super::run::Status;
use crate::session::{EffectRow, Effects};

/// Runs a script and says which effects its scene has switched on, why, and what each costs.
pub fn script(examination: &Examination) -> Status {
    let session = match rehearse(&examination.file, &examination.outside) {
        Ok(session) => session,
        Err(status) => return status,
    };
    let effects = session.effects_on();
    if examination.json {
        output::answer(&format!("{:#}", to_json(&effects)));
    } else {
        effects.lines().iter().for_each(|line| output::answer(line));
    }
    Status::Fine
}

fn to_json(effects: &Effects) -> Value {
    let row = |row: &EffectRow| {
        json!({
            "name": row.name,
            "on": row.is_on,
            "because": row.because,
            "bytes": row.n_bytes,
            "seconds": row.seconds,
        })
    };
    let (total, awake) = effects.islands;
    json!({
        "effects": effects.rows.iter().map(row).collect::<Vec<_>>(),
        "islands": { "total": total, "awake": awake },
        "frames": effects.n_frames,
        "seconds": effects.seconds,
    })
}
