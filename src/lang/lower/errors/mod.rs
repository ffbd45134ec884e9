//! What is wrong with a statement that cannot be read, in the words of who wrote it.

pub(super) mod expected;
pub mod mistake;
pub mod refusal;
