//! What each command does, a file for each family.

pub mod accuracy;
pub mod blocks;
pub mod change;
pub mod constrain;
pub mod dead_point;
pub mod delete;
pub mod diagnose;
pub mod driver;
pub mod driver_range;
mod effect_table;
pub mod effects;
pub mod hands;
pub mod measure;
mod pace;
pub mod plot;
pub mod points;
pub mod restorable;
pub mod restore;
pub mod run;
pub mod save;
pub mod setting_table;
pub mod settings;
pub mod show;
mod slips;
mod stretch;
pub mod touch;
mod trace_record;
