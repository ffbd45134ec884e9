//! `set`: shows and sets what the user prefers.

use super::setting_table::{OWN_SETTINGS, OwnSetting, SETTINGS, Setting};
use crate::diag::{Diagnostic, listed, suggest};
use crate::errors;
use crate::lang::ast::{Expr, Ident, Name};
use crate::session::execution::Execution;

impl Execution<'_> {
    pub(crate) fn show_settings(&mut self, which: Option<&Ident>) -> Result<(), Diagnostic> {
        if let Some(word) = which
            && Setting::named(&word.text).is_none()
        {
            return Err(unknown_setting(word));
        }
        for setting in &SETTINGS {
            if which.is_none_or(|word| &*word.text == setting.name) {
                let text = format!("set {} {}", setting.name, (setting.text)(self.state));
                self.host.print(&format!("{text:<28}# {}", setting.what));
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
        let own = OWN_SETTINGS.iter().find(|own| own.name == &*setting.text);
        match (Setting::named(&setting.text), own, targets) {
            (_, Some(own), [_, ..]) => self.set_for(own, value, targets),
            (_, None, [first, ..]) => {
                let names: Vec<String> =
                    OWN_SETTINGS.iter().map(|own| format!("`{}`", own.name)).collect();
                Err(Diagnostic::error(
                    errors::SETTING_OWNER,
                    format!("`{}` is set for the whole session", setting.text),
                )
                .at(first.span, format!("only {} are set for one thing", listed(&names, "and"))))
            }
            (Some(whole), _, []) => (whole.set)(self, value),
            (None, Some(own), []) => Err(Diagnostic::error(
                errors::SETTING_OWNER,
                format!("a {} belongs to {}", own.name, own.wanted),
            )
            .at(setting.span, "")
            .help(own.example)),
            (None, None, []) => Err(unknown_setting(setting)),
        }
    }

    fn set_for(
        &mut self,
        own: &OwnSetting,
        value: &Expr,
        targets: &[Name],
    ) -> Result<(), Diagnostic> {
        let number = self.positive(value)?;
        for name in targets {
            let entity = self.resolve().entity(name)?;
            if !(own.set)(self, entity, number, value.span)? {
                let problem = format!(
                    "`{}` is set for {}, not for a {}",
                    own.name,
                    own.wanted,
                    entity.noun()
                );
                return Err(Diagnostic::error(errors::WRONG_SORT, problem)
                    .at(name.span, format!("expected the name of {}", own.wanted)));
            }
        }
        Ok(())
    }
}

fn unknown_setting(word: &Ident) -> Diagnostic {
    let problem =
        Diagnostic::error(errors::UNKNOWN_SETTING, format!("unknown setting `{}`", word.text))
            .at(word.span, "nothing to set");
    suggest(problem, &word.text, Setting::names()).help("`set` alone lists the settings")
}
