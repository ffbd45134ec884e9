//! `rename`: things go on under other names.

use crate::diag::Diagnostic;
use crate::errors;
use crate::lang::ast::Name;
use crate::session::execution::Execution;
use crate::world::{Edit, Entity, NameText};

impl Execution<'_> {
    /// Gives another name to a thing, or to all members of an instance. What refers to it does so by
    /// its handle, so nothing else changes.
    pub(crate) fn rename(&mut self, from: &Name, to: &Name) -> Result<(), Diagnostic> {
        let Some(instance) = self.resolve().instance(from)? else {
            let entity = self.resolve().entity(from)?;
            let name = self.free_name(to)?;
            self.edit(Edit::Rename(entity, Box::new(name)));
            return Ok(());
        };
        let name = self.free_name(to)?;
        let members: Vec<Entity> = self.state.world.names().members(&instance).collect();
        for member in members {
            let within = &self.state.world.name_of(member)[instance.len()..];
            let whole = format!("{name}{within}");
            self.edit(Edit::Rename(member, Box::new(whole.into())));
        }
        Ok(())
    }

    /// The full text of a name that nothing has. What has it is not in the way for long: it may be renamed too.
    fn free_name(&mut self, name: &Name) -> Result<NameText, Diagnostic> {
        self.resolve().declare(name).map_err(|mut why| {
            if why.code == Some(errors::NAME_TAKEN) && !why.helps.is_empty() {
                why.helps = vec!["choose another name, or `rename` what has it before".to_owned()];
            }
            why
        })
    }
}
