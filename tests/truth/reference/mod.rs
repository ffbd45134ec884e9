//! Mechanisms solved and judged without the program: its own formulas, dense matrices, tiny steps.

pub mod constraint;
pub mod dense;
pub mod make;
pub mod motion;
pub mod number;
pub mod plane;
pub mod random;
pub mod scene;
pub mod solve;
