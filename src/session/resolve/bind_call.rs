//! Calls of functions in expressions become values, or formulas that stay live.

use super::bind::{Mode, Term, wanted};
use super::scope::Resolver;
use crate::diag::Diagnostic;
use crate::errors;
use crate::lang::ast::Expr;
use crate::terms::{Function, Shape};
use crate::world::{Depends, Formula, Node, Value, call};

impl Resolver<'_> {
    /// The call of a function.
    pub(super) fn bind_call(
        &mut self,
        function: Function,
        arguments: &[Expr],
        expr: &Expr,
        mode: Mode,
    ) -> Result<Term, Diagnostic> {
        let is_of_points = function.is_rate() || function.counts_turns();
        let mut few = [const { Term::plain(Value::Number(0.0)) }; 4];
        let mut many = Vec::new();
        let is_few = arguments.len() <= few.len();
        let letters =
            function.arguments().bytes().filter(|&b| b != b'*').chain(std::iter::repeat(b'n'));
        for (k, (argument, letter)) in arguments.iter().zip(letters).enumerate() {
            // Only a formula keeps the names of points.
            let term = self.bind(argument, if is_of_points { Mode::Live } else { mode })?;
            let shape = if letter == b'n' { Shape::Number } else { Shape::Vector };
            if term.shape() != shape {
                return Err(wanted(argument, shape));
            }
            if is_few {
                few[k] = term;
            } else {
                many.push(term);
            }
        }
        let terms = if is_few { &few[..arguments.len()] } else { &many[..] };
        if is_of_points {
            return self.bind_of_points(function, terms, arguments, expr, mode);
        }
        if terms.iter().all(|term| matches!(term, Term::Constant(..))) {
            let constant = |term: &Term| match term {
                Term::Constant(value, _) => *value,
                Term::Live(_) => unreachable!("all are constant"),
            };
            let mut values = [Value::Number(0.0); 4];
            let value = if is_few {
                values.iter_mut().zip(terms).for_each(|(value, term)| *value = constant(term));
                call(function, &values[..terms.len()], expr.span)?
            } else {
                call(function, &terms.iter().map(constant).collect::<Vec<_>>(), expr.span)?
            };
            return Ok(Term::plain(value));
        }
        let depends = terms.iter().fold(Depends::default(), |all, term| all.or(term.depends()));
        let formulas = terms.iter().zip(arguments).map(|(t, a)| t.clone().into_formula(a.span));
        let node = Node::Call(function, formulas.collect());
        Ok(Term::Live(Formula::new(node, function.result(), depends, expr.span)))
    }

    fn bind_of_points(
        &mut self,
        function: Function,
        terms: &[Term],
        arguments: &[Expr],
        expr: &Expr,
        mode: Mode,
    ) -> Result<Term, Diagnostic> {
        let points = points_of(function, terms, arguments)?;
        if function.counts_turns() {
            self.note_turning(&points);
        }
        let is_rate = function.is_rate();
        let depends = Depends { on_rates: is_rate, on_points: !is_rate, ..Depends::default() };
        let node = Node::Call(function, points);
        let formula = Formula::new(node, function.result(), depends, expr.span);
        match mode {
            Mode::Live => Ok(Term::Live(formula)),
            Mode::Now => self.evaluate(&formula).map(Term::plain),
        }
    }
}

/// The arguments of a function that takes the names of points.
fn points_of(
    function: Function,
    terms: &[Term],
    arguments: &[Expr],
) -> Result<Box<[Formula]>, Diagnostic> {
    let points = terms.iter().zip(arguments).map(|(term, argument)| match term {
        Term::Live(formula) if matches!(formula.node(), Node::Point(_)) => Ok(formula.clone()),
        _ => {
            let wants =
                if terms.len() == 1 { "the name of a point" } else { "the names of points" };
            Err(Diagnostic::error(
                errors::WRONG_SORT,
                format!("`{}` takes {wants}", function.name()),
            )
            .at(argument.span, "this is not a point"))
        }
    });
    points.collect()
}
