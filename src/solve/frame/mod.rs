//! A frame by the method `auto`: an island falls apart into steps that are solved one after the
//! other, its pose is expected from those before, and a motion that is not understood so is
//! followed in smaller steps.

pub mod attempt;
pub mod branch;
pub mod decomposition;
pub mod dyad;
pub mod expected;
pub mod interpolate;
pub mod motion;
pub mod nearest;
pub mod predict;
pub mod pull;
pub mod settle;
pub mod substep;
