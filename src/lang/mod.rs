//! Text to statements: the command language, without a world to act on.
//!
//! Nothing in here reads a file, knows a point or a constraint, or panics on any text.
//! Names are not resolved: that `left.B` is a point, and `left.B.x` a number, is found out
//! by who executes the statement.

pub mod ast;
pub mod catalogue;
mod commands;
mod constraint;
mod expr;
mod format;
mod grammar;
mod growing;
mod layout;
mod lower;
mod parts;
mod print;
mod usage;

pub use format::format;
pub use growing::Growing;
pub use layout::{depth, statement_start};
pub use lower::{
    Class, NameOf, Next, Statements, Token, Tokens, is_incomplete, nearest_command, next, parse,
    tokens,
};
pub use usage::rest_of_usage;
