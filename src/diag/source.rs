//! The texts that were read, and places in them.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// A stretch of bytes in one of the texts of a [`Sources`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The text it lies in.
    pub source: SourceId,
    /// The offset of the first byte.
    pub start: u32,
    /// The offset after the last byte.
    pub end: u32,
}

impl Span {
    /// The bytes `range` of `source`. Offsets beyond 4 GiB point at the 4 GiB mark.
    pub fn new(source: SourceId, range: Range<usize>) -> Self {
        let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Self { source, start: offset(range.start), end: offset(range.end.max(range.start)) }
    }

    /// From the start of this span to the end of `other`, both of one source.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { source: self.source, start: self.start, end: other.end.max(self.start) }
    }

    /// Whether `other` lies within this span.
    pub fn holds(self, other: Self) -> bool {
        self.source == other.source && self.start <= other.start && other.end <= self.end
    }

    /// The empty span just after this one.
    #[must_use]
    pub fn after(self) -> Self {
        Self { start: self.end, ..self }
    }

    /// The offsets as a range to slice the text with.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Names one text of a [`Sources`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceId(pub u32);

/// One text and the name it is reported under: a path, `<stdin>`, a line of a session.
#[derive(Debug, Clone)]
pub struct Source {
    /// What a diagnostic calls it.
    pub name: Arc<str>,
    /// All of it.
    pub text: Arc<str>,
    /// The number of its first line: more than 1 for a piece of what was typed.
    pub first_line: usize,
    /// Where each line ends, once asked for: a long text with many warnings is read once for all of
    /// them.
    line_ends: OnceLock<Arc<[usize]>>,
}

impl Source {
    /// The number of the line that the byte `at` is in.
    pub fn line(&self, at: usize) -> usize {
        let ends = self.line_ends.get_or_init(|| {
            let bytes = self.text.bytes().enumerate();
            bytes.filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect()
        });
        self.first_line + ends.partition_point(|&end| end < at)
    }
}

/// Every text read so far. What may still be pointed at is never taken out, so a [`Span`] stays
/// good.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    all: Vec<Source>,
}

impl Sources {
    /// No texts.
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps `text` under `name`.
    pub fn add(&mut self, name: impl Into<Arc<str>>, text: impl Into<Arc<str>>) -> SourceId {
        self.add_piece(name, text, 1)
    }

    /// Keeps a piece of the text `name`, which begins at line `first_line` of it.
    pub fn add_piece(
        &mut self,
        name: impl Into<Arc<str>>,
        text: impl Into<Arc<str>>,
        first_line: usize,
    ) -> SourceId {
        let id = SourceId(u32::try_from(self.all.len()).expect("fewer than 2^32 texts"));
        let line_ends = OnceLock::new();
        self.all.push(Source { name: name.into(), text: text.into(), first_line, line_ends });
        id
    }

    /// Forgets the text that was added last, where no place in it is kept by anybody.
    pub fn forget_last(&mut self) {
        self.all.pop();
    }

    /// The text that was added last.
    pub fn last(&self) -> Option<(SourceId, &Source)> {
        let source = self.all.last()?;
        Some((SourceId(self.all.len() as u32 - 1), source))
    }

    /// What the next text will be called.
    pub fn next_id(&self) -> SourceId {
        SourceId(u32::try_from(self.all.len()).expect("fewer than 2^32 texts"))
    }

    /// The text that was added first.
    pub fn first(&self) -> Option<&Source> {
        self.get(SourceId(0))
    }

    /// The text called `id`, if it is one of these.
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        self.all.get(id.0 as usize)
    }

    /// The text under `span`, clipped to what is there.
    pub fn slice(&self, span: Span) -> &str {
        self.get(span.source).map_or("", |source| {
            let Range { start, end } = clip(&source.text, span.range());
            &source.text[start..end]
        })
    }

    /// Line and column of the first byte of `span`.
    pub fn place(&self, span: Span) -> Option<Place> {
        let source = self.get(span.source)?;
        let before = &source.text[..clip(&source.text, span.range()).start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        Some(Place {
            line: source.line(before.len()),
            column: before[line_start..].chars().count() + 1,
        })
    }
}

/// A position as people count it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
}

/// The part of `range` that lies inside `text`, moved outwards to whole characters.
pub(super) fn clip(text: &str, range: Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(range.start);
    start..text.ceil_char_boundary(range.end).max(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn place_counts_characters_and_survives_odd_spans() {
        let mut sources = Sources::new();
        let id = sources.add("a.link", "αβ\r\nγδ");
        let check = |range: Range<usize>, line, column| {
            let place = sources.place(Span::new(id, range)).expect("a known text");
            assert_eq!(place, Place { line, column });
        };
        check(0..0, 1, 1);
        check(2..3, 1, 2);
        check(3..3, 1, 2);
        check(6..8, 2, 1);
        check(10..10, 2, 3);
        check(99..200, 2, 3);
        assert_eq!(sources.slice(Span::new(id, 3..99)), "β\r\nγδ");
        assert_eq!(sources.place(Span::new(SourceId(7), 0..0)), None);
    }
}
