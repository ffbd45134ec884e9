//! Places as editors count them: lines and UTF-16 units, both from 0.

use serde_json::{Value, json};

use crate::diag::Span;

/// The place of the byte `at`.
fn position(text: &str, at: usize) -> Value {
    let before = &text[..text.floor_char_boundary(at)];
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    let line = before.bytes().filter(|&byte| byte == b'\n').count();
    json!({ "line": line, "character": before[line_start..].encode_utf16().count() })
}

/// The places that a span goes from and to.
pub fn range(text: &str, span: Span) -> Value {
    let bytes = span.range();
    json!({ "start": position(text, bytes.start), "end": position(text, bytes.end) })
}

/// The byte at a place; the end of its line, or of the text, where it lies behind that.
pub fn offset(text: &str, position: &Value) -> usize {
    let line = position["line"].as_u64().unwrap_or(0) as usize;
    let character = position["character"].as_u64().unwrap_or(0) as usize;
    let mut start = 0;
    for _ in 0..line {
        match text[start..].find('\n') {
            Some(len) => start += len + 1,
            None => return text.len(),
        }
    }
    let mut units = 0;
    for (at, char) in text[start..].char_indices() {
        if units >= character || char == '\n' {
            return start + at;
        }
        units += char.len_utf16();
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::SourceId;

    #[test]
    fn places_go_there_and_back() {
        let text = "αβ\n𝄞x\n";
        for (at, char) in text.char_indices() {
            let span = Span::new(SourceId(0), at..at + char.len_utf8());
            let start = range(text, span)["start"].clone();
            assert_eq!(offset(text, &start), at, "{start}");
        }
        let x = Span::new(SourceId(0), text.find('x').expect("it is there")..text.len());
        assert_eq!(range(text, x)["start"], json!({ "line": 1, "character": 2 }));
        assert_eq!(offset(text, &json!({ "line": 0, "character": 99 })), 4);
        assert_eq!(offset(text, &json!({ "line": 99, "character": 0 })), text.len());
    }
}
