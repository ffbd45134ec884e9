//! A value given from outside the scripts, as it is written: `r=90deg`.

use super::resolve::scope::{Resolver, Scopes};
use super::state::State;
use crate::diag::{Diagnostic, Sources};
use crate::lang::ast::Command;

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
    let statement = format!("let {text}");
    let mut sources = Sources::new();
    let source = sources.add("value", statement.as_str());
    let mut statements = crate::lang::parse(source, &statement);
    let (Some(Ok(statement)), None) = (statements.next(), statements.next()) else {
        return Err(expected());
    };
    let Command::Let(bindings) = &statement.command else { return Err(expected()) };
    let [binding] = &bindings[..] else { return Err(expected()) };
    let (mut state, mut scopes) = (State::new(), Scopes::default());
    let mut resolver = Resolver::new(&mut state, &mut scopes, &sources);
    Ok((resolver.declared(&binding.name)?, resolver.number(&binding.value)?))
}
