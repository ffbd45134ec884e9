//! Names become handles, expressions become formulas, and back.

pub mod bind;
mod bind_call;
mod members;
pub mod said;
pub mod scope;
pub mod scopes;
pub mod unbind;
