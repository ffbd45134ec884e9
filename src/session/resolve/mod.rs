//! Names become handles, expressions become formulas, and back.

pub mod bind;
pub mod said;
pub mod scope;
pub mod unbind;
