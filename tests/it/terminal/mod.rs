//! The program as who sits at a terminal sees it, key by key.

mod graphics;
mod journal;
mod line;
mod screen;
mod surroundings;
