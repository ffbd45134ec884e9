//! Findings as JSON, for programs.

use serde_json::{Value, json};

use super::{VERSION, objects};
use crate::diag::{Diagnostic, Sources, format_digits};
use crate::session::check::Check;
use crate::session::effects::{EffectRow, Effects};
use crate::study::{RungResult, Study};

impl Check {
    /// The findings as one JSON object, on one line.
    pub fn to_json(&self) -> String {
        alone(self.object()).to_string()
    }

    /// The findings as an object.
    pub(super) fn object(&self) -> Value {
        let redundant = self.redundant.iter();
        let conflicting = self.conflicting.iter();
        let unsatisfiable = self.unsatisfiable.iter();
        let mut object = json!({
            "type": "check",
            "sound": self.is_sound(),
            "degrees_of_freedom": self.degrees_of_freedom,
            "redundant": redundant
                .map(|(name, depends_on)| json!({ "constraint": name, "depends_on": depends_on }))
                .collect::<Vec<_>>(),
            "conflicting": conflicting
                .map(|(names, residual)| json!({ "constraints": names, "residual": residual }))
                .collect::<Vec<_>>(),
            "unsatisfiable": unsatisfiable.map(|found| &found.constraint).collect::<Vec<_>>(),
            "pose": self.pose_word(),
            "status": self.status.word(),
            "residual": self.residual,
        });
        if let Some(after) = &self.from_here {
            object["solved_from_here"] =
                json!({ "status": after.status.word(), "residual": after.residual });
        }
        object
    }
}

impl Effects {
    /// The effects as one JSON object, on one line.
    pub fn to_json(&self) -> String {
        alone(self.object()).to_string()
    }

    /// The effects as an object.
    pub(super) fn object(&self) -> Value {
        let row = |row: &EffectRow| {
            json!({
                "name": row.name,
                "on": row.is_on,
                "because": row.because,
                "bytes": row.n_bytes,
                "seconds": row.seconds,
            })
        };
        let (total, awake) = self.islands;
        json!({
            "type": "effects",
            "effects": self.rows.iter().map(row).collect::<Vec<_>>(),
            "islands": { "total": total, "awake": awake },
            "frames": self.n_frames,
            "seconds": self.seconds,
        })
    }
}

/// What a study found, as JSON objects, one for each of its rows.
pub fn study_alone(study: &Study) -> Vec<String> {
    let row = |row: &RungResult| {
        let object = json!({
            "type": "accuracy",
            "method": row.rung.method.word(),
            "iterations": row.settings.iterations,
            "tolerance": row.settings.tolerance,
            "seconds_per_frame": format_digits(row.seconds_per_frame, 3).parse::<f64>().ok(),
            "residual": row.residual,
            "position_error": row.position_error,
            "failed_frames": row.n_failed,
            "efficient": row.is_efficient,
        });
        alone(object).to_string()
    };
    study.rows.iter().map(row).collect()
}

/// A problem as an object that stands alone.
pub fn problem_alone(problem: &Diagnostic, sources: &Sources) -> String {
    alone(objects::diagnostic(problem, sources)).to_string()
}

/// An object that no other comes before: it says itself of which schema it is.
fn alone(mut object: Value) -> Value {
    object["version"] = VERSION.into();
    object
}
