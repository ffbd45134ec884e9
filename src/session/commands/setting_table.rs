//! The settings: what each is, how it is shown, and how it is set.

use crate::diag::{Diagnostic, Span, format_fraction, format_number, suggest};
use crate::errors;
use crate::lang::ast::Expr;
use crate::session::execution::Execution;
use crate::session::preferences::{AtDeadPoint, Preferences, Receipt};
use crate::session::state::State;
use crate::session::undo::journal::Change;
use crate::solve::{CogForm, Method};
use crate::world::{Edit, Entity, Extremes};

/// Something that is set for the whole session.
pub struct Setting {
    /// Its name in the language.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Whether scenes behave otherwise with another value; if not, it is a taste of the user's.
    pub is_of_scene: bool,
    /// Its value as it would be typed.
    pub text: fn(&State) -> String,
    /// The words that it may be set to, if it is set to words.
    pub words: fn() -> Vec<&'static str>,
    /// Sets it.
    pub set: fn(&mut Execution<'_>, &Expr) -> Result<(), Diagnostic>,
}

/// Something that is set for one thing.
pub struct OwnSetting {
    /// Its name in the language.
    pub name: &'static str,
    /// What it is set for.
    pub wanted: &'static str,
    /// What to type.
    pub example: &'static str,
    /// Sets it for an entity, to a number above 0 that stands at this place; false if it is not
    /// set for such entities.
    pub set: fn(&mut Execution<'_>, Entity, f64, Span) -> Result<bool, Diagnostic>,
}

/// The settings, in the order in which they are printed.
pub static SETTINGS: [Setting; 10] = [
    Setting {
        name: "dt",
        what: "time of one frame",
        is_of_scene: true,
        text: |state| format_fraction(state.world.clock().dt),
        words: Vec::new,
        set: |command, value| {
            let dt = command.positive(value)?;
            command.edit(Edit::Clock(Box::new(command.state.world.clock().with_dt(dt))));
            Ok(())
        },
    },
    Setting {
        name: "method",
        what: "how frames are solved",
        is_of_scene: true,
        text: |state| state.preferences.solve.method.word().to_owned(),
        words: || Method::ALL.map(Method::word).to_vec(),
        set: |command, value| {
            let method = word_of(value, &Method::ALL, Method::word, "a method")?;
            command.prefer(|preferences| preferences.solve.method = method);
            Ok(())
        },
    },
    Setting {
        name: "rho",
        what: "relaxation coefficient",
        is_of_scene: true,
        text: |state| format_number(state.preferences.solve.rho),
        words: Vec::new,
        set: |command, value| {
            let rho = coefficient(command.positive(value)?, value.span)?;
            command.prefer(|preferences| preferences.solve.rho = rho);
            Ok(())
        },
    },
    Setting {
        name: "iterations",
        what: "most iterations between two frames",
        is_of_scene: true,
        text: |state| state.preferences.solve.iterations.to_string(),
        words: Vec::new,
        set: |command, value| {
            let n = command.resolve().count(value, 1.0, 1e9, "iterations")?;
            command.prefer(|preferences| preferences.solve.iterations = n as u32);
            Ok(())
        },
    },
    Setting {
        name: "tolerance",
        what: "largest residual allowed, relative to the scene's size",
        is_of_scene: true,
        text: |state| format_number(state.preferences.solve.tolerance),
        words: Vec::new,
        set: |command, value| {
            let tolerance = command.positive(value)?;
            command.prefer(|preferences| preferences.solve.tolerance = tolerance);
            Ok(())
        },
    },
    Setting {
        name: "dead-points",
        what: "where a motor cannot go on: `stop`, `hold` or `reverse`",
        is_of_scene: true,
        text: |state| state.preferences.dead_points.word().to_owned(),
        words: || AtDeadPoint::ALL.map(AtDeadPoint::word).to_vec(),
        set: |command, value| {
            let what = "what happens at a dead point";
            let at = word_of(value, &AtDeadPoint::ALL, AtDeadPoint::word, what)?;
            command.prefer(|preferences| preferences.dead_points = at);
            Ok(())
        },
    },
    Setting {
        name: "cog",
        what: "`holonomic`, or the paper's `velocity` form",
        is_of_scene: true,
        text: |state| state.preferences.solve.cog.word().to_owned(),
        words: || CogForm::ALL.map(CogForm::word).to_vec(),
        set: |command, value| {
            let form = word_of(value, &CogForm::ALL, CogForm::word, "a form of cogs")?;
            command.prefer(|preferences| preferences.solve.cog = form);
            Ok(())
        },
    },
    Setting {
        name: "measures",
        what: "extremes between frames `refined`, or those of the frames: `sampled`",
        is_of_scene: false,
        text: |state| state.preferences.measures.word().to_owned(),
        words: || Extremes::ALL.map(Extremes::word).to_vec(),
        set: |command, value| {
            let what = "how extremes are found";
            let extremes = word_of(value, &Extremes::ALL, Extremes::word, what)?;
            command.prefer(|preferences| preferences.measures = extremes);
            Ok(())
        },
    },
    Setting {
        name: "receipt",
        what: "what is said after a run: `short` or `long`",
        is_of_scene: false,
        text: |state| state.preferences.receipt.word().to_owned(),
        words: || Receipt::ALL.map(Receipt::word).to_vec(),
        set: |command, value| {
            let receipt = word_of(value, &Receipt::ALL, Receipt::word, "a length of receipts")?;
            command.prefer(|preferences| preferences.receipt = receipt);
            Ok(())
        },
    },
    Setting {
        name: "live",
        what: "`on`: each edit is followed by a solution; `off`: `solve` and `step` solve",
        is_of_scene: false,
        text: |state| if state.preferences.is_live { "on" } else { "off" }.to_owned(),
        words: || vec!["on", "off"],
        set: |command, value| {
            let word = |is_on| if is_on { "on" } else { "off" };
            let is_live = word_of(value, &[true, false], word, "whether edits are solved")?;
            command.prefer(|preferences| preferences.is_live = is_live);
            Ok(())
        },
    },
];

/// What is set for single points or constraints.
pub static OWN_SETTINGS: [OwnSetting; 2] = [
    OwnSetting {
        name: "rho",
        wanted: "a constraint",
        example: "`set rho 0.25 for coupler`",
        set: |command, entity, number, span| {
            let Entity::Constraint(id) = entity else { return Ok(false) };
            let mut record = command.state.world.constraint(id).expect("it is named").clone();
            record.set_rho(coefficient(number, span)?);
            command.edit(Edit::Constraint(id, Some(Box::new(record))));
            Ok(true)
        },
    },
    OwnSetting {
        name: "weight",
        wanted: "a point",
        example: "`set weight 100 for A B`",
        set: |command, entity, number, span| {
            let Entity::Point(id) = entity else { return Ok(false) };
            if !(1e-9..=1e9).contains(&number) {
                return Err(Diagnostic::error(
                    errors::OUT_OF_RANGE,
                    "a weight lies between 1e-9 and 1e9",
                )
                .at(span, format!("this is {}", format_number(number))));
            }
            command.edit(Edit::Weight(id, number));
            Ok(true)
        },
    },
];

impl Setting {
    /// The setting of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| setting.name == name)
    }

    /// The names of all, those that belong to one thing included.
    pub fn names() -> impl Iterator<Item = &'static str> {
        SETTINGS.iter().map(|setting| setting.name).chain(OWN_SETTINGS.iter().map(|own| own.name))
    }
}

impl Execution<'_> {
    /// Sets something that the user prefers.
    fn prefer(&mut self, change: impl FnOnce(&mut Preferences)) {
        let mut new = self.state.preferences.clone();
        change(&mut new);
        if new.solve == self.state.preferences.solve {
            // The solver asks for nothing of it.
            return self.change(Change::Preferences(Box::new(new)));
        }
        // What was edited before is taken in as it was set then; what counted as solved may not
        // any more, and that is part of this command.
        self.sync();
        self.change(Change::Preferences(Box::new(new)));
        self.sync();
    }

    /// A number above 0.
    pub(super) fn positive(&mut self, expr: &Expr) -> Result<f64, Diagnostic> {
        let value = self.resolve().number(expr)?;
        if value > 0.0 {
            return Ok(value);
        }
        Err(Diagnostic::error(errors::OUT_OF_RANGE, "expected a number above 0")
            .at(expr.span, format!("this is {}", format_number(value))))
    }
}

/// A coefficient of relaxation.
fn coefficient(rho: f64, span: Span) -> Result<f64, Diagnostic> {
    if rho <= 2.0 {
        return Ok(rho);
    }
    Err(Diagnostic::error(errors::OUT_OF_RANGE, "a relaxation coefficient above 2 never converges")
        .at(span, "expected 0 < rho <= 2"))
}

/// The one of these that is meant by a word.
fn word_of<T: Copy>(
    value: &Expr,
    all: &[T],
    word: impl Fn(T) -> &'static str,
    what: &str,
) -> Result<T, Diagnostic> {
    let list: Vec<String> = all.iter().map(|t| format!("`{}`", word(*t))).collect();
    let expected = format!("expected one of {}", list.join(", "));
    let Some(given) = value.as_word() else {
        return Err(Diagnostic::error(errors::SETTING_VALUE, format!("this is not {what}"))
            .at(value.span, expected));
    };
    if let Some(found) = all.iter().find(|t| word(**t) == &*given.text) {
        return Ok(*found);
    }
    let problem =
        Diagnostic::error(errors::SETTING_VALUE, format!("`{}` is not {what}", given.text))
            .at(given.span, expected);
    Err(suggest(problem, &given.text, all.iter().map(|t| word(*t))))
}
