//! Text without what a terminal would take for orders.

use std::borrow::Cow;

/// A text as a terminal may show it: control characters but newline and tab appear as U+FFFD, and so
/// do those that turn the direction of what follows.
///
/// ```
/// assert_eq!(linkwork::diag::visible("a\tb\n"), "a\tb\n");
/// assert_eq!(linkwork::diag::visible("\u{1b}[2J\u{9b}\r"), "\u{fffd}[2J\u{fffd}\u{fffd}");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.contains(is_order) { text.replace(is_order, "\u{fffd}").into() } else { text.into() }
}

fn is_order(c: char) -> bool {
    let turns = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (c.is_control() && !matches!(c, '\n' | '\t'))
}
