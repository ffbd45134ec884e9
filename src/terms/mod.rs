//! What expressions are made of, for those who read them and for those who evaluate them:
//! functions, operations, members of things, statistics of measures, units, and what a value is.

mod function;
mod member;
mod operator;
mod shape;
mod statistic;
mod unit;

pub use function::Function;
pub use member::Member;
pub use operator::Operator;
pub use shape::Shape;
pub use statistic::Statistic;
pub use unit::Unit;
