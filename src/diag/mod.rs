//! Problems as data: what is wrong, where in which text, and what to type next.
//!
//! This room lies below all others. It knows texts and places in them, and nothing of
//! mechanisms or of the language.

mod diagnostic;
mod list;
mod nearest;
mod number;
mod render;
mod source;
mod visible;

pub use diagnostic::{Code, Diagnostic, Kind, Label, Severity};
#[doc(hidden)]
pub use list::{listed, listed_first, listed_ways};
#[doc(hidden)]
pub use nearest::{Likeness, nearest, suggest};
pub use number::format_number;
#[doc(hidden)]
pub use number::{
    format_count, format_counted, format_decimals, format_degrees, format_digits, format_exponent,
    format_fraction, format_rounded, format_seconds, push_decimals, push_integer,
};
pub use render::{Paint, render, render_within, short};
pub use source::{Place, Source, SourceId, Sources, Span};
pub use visible::visible;
