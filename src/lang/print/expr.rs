//! The canonical form of expressions and names: no parentheses but those that are needed.

use std::fmt::{self, Display, Formatter};

use crate::diag::format_number;

use super::commas;
use crate::lang::expr::{Axis, Expr, Name, Node, Number, PartKind};
use crate::terms::Operator;

/// How tight what stands in the text binds: a looser one in its place needs parentheses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tightness {
    Sum,
    Product,
    Negation,
    Power,
    Atom,
}

impl Display for Expr {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write_at_least(f, self, Tightness::Sum)
    }
}

fn write_at_least(f: &mut Formatter, expr: &Expr, least: Tightness) -> fmt::Result {
    if tightness(&expr.node) < least {
        f.write_str("(")?;
        write_node(f, &expr.node)?;
        f.write_str(")")
    } else {
        write_node(f, &expr.node)
    }
}

fn tightness(node: &Node) -> Tightness {
    match node {
        Node::Binary(Operator::Add | Operator::Subtract, _) => Tightness::Sum,
        Node::Binary(Operator::Multiply | Operator::Divide, _) => Tightness::Product,
        Node::Binary(Operator::Power, _) => Tightness::Power,
        Node::Negate(_) => Tightness::Negation,
        Node::Number(number) if number.written.is_sign_negative() => Tightness::Negation,
        _ => Tightness::Atom,
    }
}

fn write_node(f: &mut Formatter, node: &Node) -> fmt::Result {
    match node {
        Node::Number(number) => write!(f, "{number}"),
        Node::Pi => f.write_str("pi"),
        Node::Tau => f.write_str("tau"),
        Node::Time => f.write_str("time"),
        Node::Name(name) => write!(f, "{name}"),
        Node::Negate(of) => {
            f.write_str("-")?;
            write_at_least(f, of, Tightness::Negation)
        }
        Node::Binary(op, operands) => {
            let [left, right] = &**operands;
            let (sign, at_left, at_right) = match op {
                Operator::Add => (" + ", Tightness::Sum, Tightness::Product),
                Operator::Subtract => (" - ", Tightness::Sum, Tightness::Product),
                Operator::Multiply => (" * ", Tightness::Product, Tightness::Negation),
                Operator::Divide => (" / ", Tightness::Product, Tightness::Negation),
                Operator::Power => ("^", Tightness::Atom, Tightness::Negation),
            };
            write_at_least(f, left, at_left)?;
            f.write_str(sign)?;
            write_at_least(f, right, at_right)
        }
        Node::Vector(components) => write!(f, "({}, {})", components[0], components[1]),
        Node::Component(of, axis) => {
            let member = if *axis == Axis::X { ".x" } else { ".y" };
            match of.node {
                Node::Vector(_) | Node::Call(..) | Node::Component(..) => {
                    write!(f, "{of}{member}")
                }
                _ => write!(f, "({of}){member}"),
            }
        }
        Node::Call(function, arguments) => write!(f, "{}({})", function.name(), commas(arguments)),
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}{}", format_number(self.written), self.unit.suffix())
    }
}

impl Display for Name {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}", self.head)?;
        for part in &self.parts {
            match &part.kind {
                PartKind::Member(member) => write!(f, ".{member}")?,
                PartKind::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
