//! Tables of values with commas between them (RFC 4180): how a cell is written, how rows are read.

use std::borrow::Cow;
use std::iter;

/// A cell as it is written: in quotes where it would be taken for something else.
pub fn cell(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

/// The rows of a table, each as its cells, without the blanks around those that are not in quotes.
/// Lines with nothing on them are no rows.
pub fn rows(text: &str) -> impl Iterator<Item = Vec<Cow<'_, str>>> {
    let mut left = text;
    iter::from_fn(move || {
        left = left.trim_start_matches(['\n', '\r', ' ', '\t']);
        if left.is_empty() {
            return None;
        }
        let mut row = Vec::new();
        loop {
            let (cell, behind) = first_cell(left);
            row.push(cell);
            left = behind;
            match left.strip_prefix(',') {
                Some(next) => left = next,
                None => return Some(row),
            }
        }
    })
}

/// The first cell, and what stands behind it from its comma or line end on.
fn first_cell(text: &str) -> (Cow<'_, str>, &str) {
    let begin = text.trim_start_matches([' ', '\t']);
    if let Some(quoted) = begin.strip_prefix('"') {
        let (cell, behind) = up_to_quote(quoted);
        // What follows the quotes before the next comma belongs to no cell.
        return (cell, &behind[behind.find([',', '\n']).unwrap_or(behind.len())..]);
    }
    let (cell, behind) = text.split_at(text.find([',', '\n']).unwrap_or(text.len()));
    (Cow::Borrowed(cell.trim()), behind)
}

/// What stands up to the closing quote, and what behind it; two quotes are one that is meant.
fn up_to_quote(text: &str) -> (Cow<'_, str>, &str) {
    let mut from = 0;
    loop {
        let end = text[from..].find('"').map_or(text.len(), |at| from + at);
        let behind = text.get(end + 1..).unwrap_or_default();
        if behind.starts_with('"') {
            from = end + 2;
            continue;
        }
        let cell = &text[..end];
        let cell = if from > 0 { cell.replace("\"\"", "\"").into() } else { cell.into() };
        return (cell, behind);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_have_to_be() {
        assert_eq!(cell("a b"), "a b");
        assert_eq!(cell("a, \"b\""), "\"a, \"\"b\"\"\"");
    }

    #[test]
    fn what_is_written_is_read() {
        let words = ["", "a", "a, b", "\"", "\"\"", "\"a\"", "a\nb", "a\r\nb", " a ", ",", "\"\n,"];
        for first in words {
            for second in words {
                // The blanks around a cell are no part of it, and a row has something on it.
                let wanted = [first, second, "."]
                    .map(|word| if cell(word) == word { word.trim() } else { word });
                let line = [first, second, "."].map(cell).join(",");
                for text in [format!("{line}\n{line}"), format!("{line}\r\n\r\n{line}\r\n")] {
                    let found: Vec<_> = rows(&text).collect();
                    assert_eq!(found, [wanted, wanted], "{text:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_well_formed_ends() {
        for text in ["\"", "\"a", "\"a\"b,c", "a,\"", ",", "\n", "\"\"\"", "\"a\"\n\"", "\u{e9},\""]
        {
            assert!(rows(text).count() <= 2, "{text:?}");
        }
        assert_eq!(rows("\"a\"b,c\n").next().expect("a row"), ["a", "c"]);
        assert_eq!(rows("1,2,").next().expect("a row"), ["1", "2", ""]);
    }
}
