//! Text as a picture can hold it.

use crate::diag::visible;

/// A text without what XML has no way to write, or what a program that shows the picture could take
/// for an order: U+FFFD stands in its place.
pub fn printable(text: &str) -> String {
    visible(text).replace(['\u{fffe}', '\u{ffff}'], "\u{fffd}")
}
