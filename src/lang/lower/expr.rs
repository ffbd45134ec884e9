//! Expressions: from operands and operators in a row to a tree by precedence.

use crate::diag::{Diagnostic, Span, nearest};
use crate::errors;
use crate::lang::ast::{Axis, Expr, Function, Node, Number, Operator, Unit};

use super::cursor::Cursor;
use super::errors::mistake::brief;
use super::errors::refusal;
use super::parsed::Parsed;
use crate::lang::grammar::Rule;

/// The deepest tree: whatever walks over one calls itself this often at most, and a chain
/// of operators has at most as many.
pub(super) const MAX_DEPTH: usize = 300;

/// An expression and how many nodes lie on its longest path down.
pub(super) struct Tree {
    pub expr: Expr,
    pub depth: usize,
}

type Result<T> = std::result::Result<T, Diagnostic>;

/// What waits for its right operand.
#[derive(Clone, Copy)]
enum Waiting {
    Minus(Span),
    Binary(Operator),
}

impl Waiting {
    /// The higher, the tighter.
    fn precedence(self) -> u8 {
        match self {
            Self::Binary(Operator::Add | Operator::Subtract) => 1,
            Self::Binary(Operator::Multiply | Operator::Divide) => 2,
            Self::Minus(_) => 3,
            Self::Binary(Operator::Power) => 4,
        }
    }
}

/// Builds the tree of an `expr` with two stacks (Dijkstra's shunting yard): a chain of any
/// length takes no stack of ours.
pub(super) fn lower_expr<'a>(cursor: &Cursor<'a>, pair: Parsed<'a>) -> Result<Tree> {
    let mut parts = pair.inner();
    if let (Some(only), None) = (parts.next(), parts.next()) {
        return operand(cursor, only);
    }
    let whole = cursor.span(pair);
    let mut operands = Vec::with_capacity(2);
    let mut waiting: Vec<Waiting> = Vec::new();
    for part in pair.inner() {
        match part.rule() {
            Rule::minus => waiting.push(Waiting::Minus(cursor.span(part))),
            Rule::operator => {
                let op = binary_op(part.as_str());
                let new = Waiting::Binary(op);
                // Of equals the left one goes first, but `^` is read from the right.
                let bar = new.precedence() + u8::from(op == Operator::Power);
                while let Some(top) = waiting.pop_if(|top| top.precedence() >= bar) {
                    apply(top, &mut operands, whole)?;
                }
                waiting.push(new);
            }
            _ => operands.push(operand(cursor, part)?),
        }
    }
    while let Some(top) = waiting.pop() {
        apply(top, &mut operands, whole)?;
    }
    Ok(operands.pop().expect("the grammar has an operand in each expression"))
}

fn binary_op(text: &str) -> Operator {
    match text {
        "+" => Operator::Add,
        "-" => Operator::Subtract,
        "*" => Operator::Multiply,
        "/" => Operator::Divide,
        _ => Operator::Power,
    }
}

fn apply(what: Waiting, operands: &mut Vec<Tree>, whole: Span) -> Result<()> {
    let right = operands.pop().expect("the grammar has an operand behind each operator");
    let tree = match what {
        Waiting::Minus(minus) => {
            let span = minus.to(right.expr.span);
            deeper(right.depth, Node::Negate(Box::new(right.expr)), span)
        }
        Waiting::Binary(op) => {
            let left = operands.pop().expect("the grammar has an operand before each operator");
            let span = left.expr.span.to(right.expr.span);
            let depth = left.depth.max(right.depth);
            deeper(depth, Node::Binary(op, Box::new([left.expr, right.expr])), span)
        }
    };
    if tree.depth > MAX_DEPTH {
        return Err(refusal::too_long(whole));
    }
    operands.push(tree);
    Ok(())
}

/// A node above others, the deepest of them `depth` deep.
fn deeper(depth: usize, node: Node, span: Span) -> Tree {
    Tree { expr: Expr { node, span }, depth: depth + 1 }
}

fn operand<'a>(cursor: &Cursor<'a>, pair: Parsed<'a>) -> Result<Tree> {
    let span = cursor.span(pair);
    let tree = match pair.rule() {
        Rule::number => deeper(0, Node::Number(number(pair.as_str(), span)?), span),
        Rule::reference => reference(cursor, pair)?,
        _ => parens(cursor, pair)?,
    };
    if tree.depth > MAX_DEPTH {
        return Err(refusal::too_long(span));
    }
    Ok(tree)
}

fn number(text: &str, span: Span) -> Result<Number> {
    let (digits, suffix) = text.split_at(digits_end(text));
    let unit = if suffix.is_empty() {
        Some(Unit::None)
    } else {
        Unit::ALL.into_iter().find(|unit| unit.suffix() == suffix)
    };
    let at_suffix = Span { start: span.end - suffix.len() as u32, ..span };
    let Some(unit) = unit else {
        return Err(unknown_suffix(digits, suffix, at_suffix));
    };
    let number = digits.parse().map(|written| Number { written, unit });
    match number {
        Ok(number) if number.value().is_finite() => Ok(number),
        _ => Err(refusal::too_large(span)),
    }
}

/// Where the suffix of a number begins.
fn digits_end(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let from = end + 1 + sign;
        if bytes.get(from).is_some_and(u8::is_ascii_digit) {
            end = digits(from);
        }
    }
    end
}

/// Units of length: here all lengths of a scene are in one, whichever that is.
const LENGTHS: [&str; 8] = ["mm", "cm", "dm", "m", "km", "in", "inch", "ft"];

fn unknown_suffix(digits: &str, suffix: &str, span: Span) -> Diagnostic {
    let (digits, suffix) = (brief(digits), brief(suffix));
    let problem = Diagnostic::error(errors::UNKNOWN_UNIT, format!("unknown unit `{suffix}`"))
        .at(span, "not the suffix of a number");
    if suffix.eq_ignore_ascii_case("e") {
        return problem.help(format!("an exponent has digits: `{digits}e-3`"));
    }
    if suffix.starts_with('_') {
        return problem.help("the digits of a number stand together: `1000000`, or `1e6`");
    }
    if LENGTHS.contains(&&*suffix) {
        return problem.help(format!(
            "lengths have no unit: write `{digits}`, and all lengths of a scene in one unit"
        ));
    }
    match nearest(&suffix, Unit::ALL.map(Unit::suffix)) {
        // A letter that is no unit is more likely a factor: `2r`.
        Some(unit) if suffix.len() > 1 => problem.help(format!("did you mean `{digits}{unit}`?")),
        _ => problem
            .help(format!("to multiply, write `{digits}*{suffix}`"))
            .help("the units are `deg`, `rad`, `rev`, `rpm`, `s` and `ms`"),
    }
}

/// A name, or the call of a function and components of what it gives.
fn reference<'a>(cursor: &Cursor<'a>, pair: Parsed<'a>) -> Result<Tree> {
    let whole = cursor.span(pair);
    let mut inner = cursor.within(pair);
    let name_pair = inner.take(Rule::name).expect("the grammar has a name here");
    let (name, depth) = cursor.name_of(name_pair)?;
    let Some(arguments) = inner.take(Rule::arguments) else {
        let reserved = match &*name.head.text {
            "pi" => Node::Pi,
            "tau" => Node::Tau,
            "time" => Node::Time,
            _ => return Ok(deeper(depth, Node::Name(name), whole)),
        };
        if let Some(part) = name.parts.first() {
            return Err(refusal::no_parts(&name.head, part.span));
        }
        return Ok(deeper(0, reserved, whole));
    };
    let Some(word) = name.as_simple() else {
        return Err(refusal::not_a_function(name.span));
    };
    if Function::named(&word.text).next().is_none() {
        return Err(refusal::unknown_function(word));
    }
    let call_span = word.span.to(cursor.span(arguments));
    let (arguments, depth) = trees(cursor, arguments)?;
    let mut functions = Function::named(&word.text);
    let Some(function) = functions.find(|function| function.takes(arguments.len())) else {
        return Err(refusal::wrong_count(word, arguments.len(), call_span));
    };
    let call = deeper(depth, Node::Call(function, arguments), call_span);
    components(cursor, call, inner)
}

/// The expressions in `pair` and the depth of the deepest.
fn trees<'a>(cursor: &Cursor<'a>, pair: Parsed<'a>) -> Result<(Vec<Expr>, usize)> {
    let mut inner = cursor.within(pair);
    let mut exprs = Vec::new();
    let mut depth = 0;
    while inner.peek() == Some(Rule::expr) {
        let tree = inner.tree()?;
        depth = depth.max(tree.depth);
        exprs.push(tree.expr);
    }
    Ok((exprs, depth))
}

fn parens<'a>(cursor: &Cursor<'a>, pair: Parsed<'a>) -> Result<Tree> {
    let opening = cursor.span(pair);
    let mut inner = cursor.within(pair);
    let x = inner.tree()?;
    let y = if inner.peek() == Some(Rule::expr) { Some(inner.tree()?) } else { None };
    // Looking for what follows has passed the closing parenthesis.
    inner.peek();
    let span = Span { end: inner.end() as u32, ..opening };
    let tree = match y {
        Some(y) => deeper(x.depth.max(y.depth), Node::Vector(Box::new([x.expr, y.expr])), span),
        None => Tree { expr: Expr { span, ..x.expr }, depth: x.depth },
    };
    components(cursor, tree, inner)
}

/// Wraps `tree` in the components that follow it.
fn components<'a>(cursor: &Cursor<'a>, tree: Tree, mut rest: Cursor<'a>) -> Result<Tree> {
    let mut tree = tree;
    while let Some(member) = rest.take(Rule::member) {
        let at = cursor.span(member);
        let axis = match member.as_str() {
            ".x" => Axis::X,
            ".y" => Axis::Y,
            other => return Err(refusal::no_component(other, at)),
        };
        let span = tree.expr.span.to(at);
        tree = deeper(tree.depth, Node::Component(Box::new(tree.expr), axis), span);
        if tree.depth > MAX_DEPTH {
            return Err(refusal::too_long(span));
        }
    }
    Ok(tree)
}
