//! What tests share: sessions whose talk is kept, scenes for the solver, random statements.

pub mod compare;
pub mod draws;
pub mod fresh;
pub mod notebook;
pub mod program;
pub mod scene;
pub mod sources;
pub mod talk;
pub mod trees;
