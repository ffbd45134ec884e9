//! Questions without a statement of their own: what an expression is worth, what `r=90deg` says.

use super::input::Input;
use super::quotas::Quotas;
use super::resolve::scope::Resolver;
use super::resolve::scopes::Scopes;
use super::state::State;
use crate::diag::{Diagnostic, SourceId, Sources};
use crate::errors;
use crate::lang::ast::{Command, Expr, Looking, Making, PrintItem};
use crate::lang::parse;
use crate::world::Value;

/// The value now of the expression that the text `source` prints.
pub fn value(source: SourceId, input: &Input, state: &mut State) -> Result<Value, Diagnostic> {
    let Input { sources, quotas, .. } = input;
    let text = sources.get(source).map(|source| source.text.clone()).unwrap_or_default();
    let mut statements = parse(source, &text);
    let (statement, next) = (statements.next().transpose()?, statements.next());
    let expr: Option<&Expr> = match statement.as_ref().map(|statement| &statement.command) {
        Some(Command::Looking(Looking::Print(items))) => match &items[..] {
            [PrintItem::Value(expr)] => Some(expr),
            _ => None,
        },
        _ => None,
    };
    match (expr, next) {
        (Some(expr), None) => {
            Resolver::new(state, &mut Scopes::default(), sources, quotas).value(expr)
        }
        _ => Err(Diagnostic::error(errors::UNEXPECTED, "expected one expression")),
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
    let expected =
        || Diagnostic::error(errors::UNEXPECTED, "expected `name=value`, the value a number");
    let statement = format!("let {text}");
    let mut sources = Sources::new();
    let source = sources.add("value", statement.as_str());
    let mut statements = parse(source, &statement);
    let (Some(Ok(statement)), None) = (statements.next(), statements.next()) else {
        return Err(expected());
    };
    let Command::Making(Making::Let(bindings)) = &statement.command else { return Err(expected()) };
    let [binding] = &bindings[..] else { return Err(expected()) };
    let (mut state, mut scopes) = (State::new(), Scopes::default());
    let quotas = Quotas::default();
    let mut resolver = Resolver::new(&mut state, &mut scopes, &sources, &quotas);
    Ok((resolver.declared(&binding.name)?, resolver.number(&binding.value)?))
}
