//! Values given from outside the scripts: `--set r=90deg`.

use super::{Nowhere, Session};
use crate::diag::Diagnostic;
use crate::lang::ast::Command;

/// A value from outside and whether some `let` took it.
#[derive(Debug, Clone)]
pub(super) struct Override {
    pub value: f64,
    pub is_used: bool,
}

impl Session {
    /// Gives a parameter a value that wins over the scripts' own `let`.
    pub fn override_parameter(&mut self, name: &str, value: f64) {
        self.overrides.insert(name.to_owned(), Override { value, is_used: false });
    }

    /// Names given to [`override_parameter`](Self::override_parameter) that no `let` has.
    pub fn unused_overrides(&self) -> impl Iterator<Item = &str> {
        self.overrides.iter().filter(|(_, o)| !o.is_used).map(|(name, _)| name.as_str())
    }
}

/// The name and the number of `r = 90deg`, as a `let` would take it: no other names, one
/// parameter.
///
/// # Errors
/// Where the text is no such binding.
///
/// ```
/// use linkwork::session::evaluate_binding;
///
/// assert_eq!(evaluate_binding("r=1/4").unwrap(), ("r".to_owned(), 0.25));
/// assert!(evaluate_binding("r").is_err());
/// ```
pub fn evaluate_binding(text: &str) -> Result<(String, f64), Diagnostic> {
    let expected = || Diagnostic::error("expected `name=value`, the value a number");
    let mut session = Session::new(Box::new(Nowhere));
    let statement = format!("let {text}");
    let source = session.add_source("value", &statement, None);
    let mut statements = crate::lang::parse(source, &statement);
    let (Some(Ok(statement)), None) = (statements.next(), statements.next()) else {
        return Err(expected());
    };
    let Command::Let(bindings) = &statement.command else { return Err(expected()) };
    let [binding] = &bindings[..] else { return Err(expected()) };
    Ok((session.declared(&binding.name)?, session.number(&binding.value)?))
}
