//! The form that scripts are kept in: the blanks of a text set anew, nothing else of it changed.
//!
//! Lines stay lines: what the writer broke in two stays in two, comments stay where they are, and
//! statements that share a line go on sharing it. What is set is the indent, the blanks between
//! words and around signs, the columns of comments behind statements, and that one empty line is
//! enough.

mod page;
mod tokens;

use std::ops::Range;

use self::page::Page;
use self::tokens::rows;
use super::layout::{Layout, Piece};
use super::lower::Reader;
use crate::diag::{Diagnostic, SourceId};

/// The text in canonical form, or what is wrong with it.
///
/// ```
/// use linkwork::diag::SourceId;
/// use linkwork::lang::format;
///
/// let text = "point A=( 0,0 )   frozen# ground\nfor i in 1..3 {\nstep i+1 }";
/// let wanted = "point A = (0, 0) frozen  # ground\nfor i in 1..3 {\n  step i + 1\n}\n";
/// assert_eq!(format(SourceId(0), text).unwrap(), wanted);
/// ```
///
/// # Errors
///
/// Everything that cannot be read: what is not understood is not touched.
pub fn format(source: SourceId, text: &str) -> Result<String, Vec<Diagnostic>> {
    let problems: Vec<_> = super::parse(source, text).filter_map(Result::err).collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut writer = Writer { reader: Reader { source, text }, page: Page::default() };
    writer.statements(start..text.len(), 0).map_err(|problem| vec![problem])?;
    Ok(writer.page.finish())
}

struct Writer<'a> {
    reader: Reader<'a>,
    page: Page,
}

impl Writer<'_> {
    /// The statements and comments of a stretch of the text, so many steps from the margin.
    fn statements(&mut self, range: Range<usize>, level: usize) -> Result<(), Diagnostic> {
        let mut layout = Layout::new(self.reader.text, range.clone());
        let mut at = range.start;
        let mut is_first = true;
        while let Some(Ok(piece)) = layout.next_piece() {
            let is_new_line = self.between(at..piece.whole.start, level) || is_first;
            if is_new_line {
                self.page.begin(level);
            } else {
                self.page.write("; ");
            }
            self.statement(&piece, level)?;
            at = piece.whole.end;
            is_first = false;
        }
        self.between(at..range.end, level);
        Ok(())
    }

    /// What stands between two statements: comments and line ends; whether the line ended.
    fn between(&mut self, range: Range<usize>, level: usize) -> bool {
        let mut rest = &self.reader.text[range];
        let mut n_ends = 0;
        let mut ended = false;
        while let Some(char) = rest.chars().next() {
            if char == '#' {
                let (comment, behind) = rest.split_at(rest.find('\n').unwrap_or(rest.len()));
                if !ended && !self.page.is_empty() {
                    self.page.comment(comment);
                } else {
                    self.page.begin(level);
                    self.page.comment(comment);
                }
                n_ends = 0;
                ended = true;
                rest = behind;
                continue;
            }
            if char == '\n' {
                n_ends += 1;
                ended = true;
                if n_ends == 2 {
                    self.page.empty_line();
                }
            }
            rest = &rest[char.len_utf8()..];
        }
        ended
    }

    fn statement(&mut self, piece: &Piece, level: usize) -> Result<(), Diagnostic> {
        let signs = self.reader.signs(&piece.head)?;
        for (k, row) in rows(self.reader.text, &piece.head, &signs).into_iter().enumerate() {
            if k > 0 {
                self.page.begin(if row.closes { level } else { level + 1 });
            }
            self.page.write(&row.code);
            self.page.comment(&row.comment);
        }
        let Some(block) = &piece.block else { return Ok(()) };
        let inside = &self.reader.text[block.clone()];
        if inside.trim().is_empty() {
            self.page.write(" {}");
        } else if inside.contains('\n') {
            self.page.write(" {");
            self.statements(block.clone(), level + 1)?;
            self.page.begin(level);
            self.page.write("}");
        } else {
            self.page.write(" { ");
            self.on_one_line(block.clone(), level)?;
            self.page.write(" }");
        }
        Ok(())
    }

    /// The statements of a block that stands on one line.
    fn on_one_line(&mut self, block: Range<usize>, level: usize) -> Result<(), Diagnostic> {
        let mut layout = Layout::new(self.reader.text, block);
        let mut gap = "";
        while let Some(Ok(piece)) = layout.next_piece() {
            self.page.write(gap);
            self.statement(&piece, level)?;
            gap = "; ";
        }
        Ok(())
    }
}
