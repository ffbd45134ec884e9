//! Settings: their names, their values, `set`.

use crate::diag::{Diagnostic, format_number, suggest};
use crate::lang::ast::{Expr, Ident, Name};
use crate::session::execution::Execution;
use crate::session::preferences::AtDeadPoint;
use crate::session::state::State;
use crate::session::undo::journal::Change;
use crate::solve::{CogForm, Method};
use crate::world::{Edit, Entity};

/// The settings, in the order in which they are printed, with what each is.
pub const SETTINGS: [(&str, &str); 7] = [
    ("dt", "time of one frame"),
    ("method", "how frames are solved"),
    ("rho", "relaxation coefficient"),
    ("iterations", "most iterations between two frames"),
    ("tolerance", "largest residual allowed, relative to the scene's size"),
    ("dead-points", "where a motor cannot go on: `stop`, `hold` or `reverse`"),
    ("cog", "`holonomic`, or the paper's `velocity` form"),
];

impl State {
    /// The value of a setting as it would be typed.
    pub(crate) fn setting_text(&self, name: &str) -> String {
        let solve = &self.preferences.solve;
        match name {
            "dt" => format_number(self.world.clock().dt),
            "method" => solve.method.word().to_owned(),
            "rho" => format_number(solve.rho),
            "iterations" => solve.iterations.to_string(),
            "tolerance" => format_number(solve.tolerance),
            "cog" => solve.cog.word().to_owned(),
            "dead-points" => self.preferences.dead_points.word().to_owned(),
            _ => unreachable!("`{name}` is not among the settings"),
        }
    }
}

impl Execution<'_> {
    pub(crate) fn show_settings(&mut self, which: Option<&Ident>) -> Result<(), Diagnostic> {
        if let Some(word) = which
            && SETTINGS.iter().all(|(name, _)| *name != &*word.text)
        {
            return Err(unknown_setting(word));
        }
        for (name, what) in SETTINGS {
            if which.is_none_or(|word| &*word.text == name) {
                let text = format!("set {name} {}", self.state.setting_text(name));
                self.host.print(&format!("{text:<28}# {what}"));
            }
        }
        Ok(())
    }

    pub(crate) fn set(
        &mut self,
        setting: &Ident,
        value: &Expr,
        targets: &[Name],
    ) -> Result<(), Diagnostic> {
        match (&*setting.text, targets) {
            ("rho" | "weight", [_, ..]) => self.set_for(setting, value, targets),
            ("weight", []) => Err(Diagnostic::error("a weight belongs to a point")
                .at(setting.span, "")
                .help("`set weight 100 for A B`")),
            (_, [first, ..]) => {
                Err(Diagnostic::error(format!("`{}` is set for the whole session", setting.text))
                    .at(first.span, "only `rho` and `weight` are set for one thing"))
            }
            ("dt", []) => {
                let dt = self.positive(value)?;
                self.edit(Edit::Clock(Box::new(self.state.world.clock().with_dt(dt))));
                Ok(())
            }
            (_, []) => {
                let mut new = self.state.preferences.clone();
                let solve = &mut new.solve;
                match &*setting.text {
                    "method" => {
                        solve.method = word_of(value, &Method::ALL, Method::word, "a method")?;
                    }
                    "cog" => {
                        solve.cog = word_of(value, &CogForm::ALL, CogForm::word, "a form of cogs")?;
                    }
                    "dead-points" => {
                        let what = "what happens at a dead point";
                        new.dead_points =
                            word_of(value, &AtDeadPoint::ALL, AtDeadPoint::word, what)?;
                    }
                    "rho" => solve.rho = self.coefficient(value)?,
                    "iterations" => {
                        solve.iterations =
                            self.resolve().count(value, 1.0, 1e9, "iterations")? as u32;
                    }
                    "tolerance" => {
                        let tolerance = self.positive(value)?;
                        new.solve.tolerance = tolerance;
                    }
                    _ => return Err(unknown_setting(setting)),
                }
                // What was edited before is taken in as it was set then; what counted as solved
                // may not any more, and that is part of this command.
                self.sync();
                self.change(Change::Preferences(Box::new(new)));
                self.sync();
                Ok(())
            }
        }
    }

    fn positive(&mut self, expr: &Expr) -> Result<f64, Diagnostic> {
        let value = self.resolve().number(expr)?;
        if value > 0.0 {
            return Ok(value);
        }
        Err(Diagnostic::error("expected a number above 0")
            .at(expr.span, format!("this is {}", format_number(value))))
    }

    /// A coefficient of relaxation.
    fn coefficient(&mut self, expr: &Expr) -> Result<f64, Diagnostic> {
        let rho = self.positive(expr)?;
        if rho <= 2.0 {
            return Ok(rho);
        }
        Err(Diagnostic::error("a relaxation coefficient above 2 never converges")
            .at(expr.span, "expected 0 < rho <= 2"))
    }

    fn set_for(
        &mut self,
        setting: &Ident,
        value: &Expr,
        targets: &[Name],
    ) -> Result<(), Diagnostic> {
        let number = self.positive(value)?;
        for name in targets {
            match (&*setting.text, self.resolve().entity(name)?) {
                ("weight", Entity::Point(id)) => {
                    if !(1e-9..=1e9).contains(&number) {
                        return Err(Diagnostic::error("a weight lies between 1e-9 and 1e9")
                            .at(value.span, format!("this is {}", format_number(number))));
                    }
                    self.edit(Edit::Weight(id, number));
                }
                ("rho", Entity::Constraint(id)) => {
                    let mut record = self.state.world.constraint(id).expect("it is named").clone();
                    record.set_rho(self.coefficient(value)?);
                    self.edit(Edit::Constraint(id, Some(Box::new(record))));
                }
                (_, entity) => {
                    let wanted =
                        if &*setting.text == "weight" { "a point" } else { "a constraint" };
                    return Err(Diagnostic::error(format!(
                        "`{}` is set for {wanted}, not for a {}",
                        setting.text,
                        entity.noun()
                    ))
                    .at(name.span, format!("expected the name of {wanted}")));
                }
            }
        }
        Ok(())
    }
}

fn word_of<T: Copy>(
    value: &Expr,
    all: &[T],
    word: impl Fn(T) -> &'static str,
    what: &str,
) -> Result<T, Diagnostic> {
    let list: Vec<String> = all.iter().map(|t| format!("`{}`", word(*t))).collect();
    let expected = format!("expected one of {}", list.join(", "));
    let Some(given) = value.as_word() else {
        return Err(Diagnostic::error(format!("this is not {what}")).at(value.span, expected));
    };
    if let Some(found) = all.iter().find(|t| word(**t) == &*given.text) {
        return Ok(*found);
    }
    let problem =
        Diagnostic::error(format!("`{}` is not {what}", given.text)).at(given.span, expected);
    Err(suggest(problem, &given.text, all.iter().map(|t| word(*t))))
}

fn unknown_setting(word: &Ident) -> Diagnostic {
    let problem = Diagnostic::error(format!("unknown setting `{}`", word.text))
        .at(word.span, "nothing to set");
    let known = SETTINGS.iter().map(|(name, _)| *name).chain(["weight"]);
    suggest(problem, &word.text, known).help("`set` alone lists the settings")
}
