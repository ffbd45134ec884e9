//! Lines as they are written: indents, empty lines, and the columns of comments.

use std::mem;

/// Blanks of one step from the margin.
const STEP: usize = 2;
/// Blanks before a comment behind a statement.
const BEFORE_COMMENT: usize = 2;

/// Lines written so far; the last may be under way.
#[derive(Debug, Default)]
pub(super) struct Page {
    lines: Vec<Line>,
    /// Is an empty line wanted before the next?
    is_parted: bool,
}

#[derive(Debug, Default)]
struct Line {
    code: String,
    comment: String,
    is_parted: bool,
}

impl Page {
    /// Is nothing written yet?
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Begins a line.
    pub fn begin(&mut self, level: usize) {
        let is_parted = mem::take(&mut self.is_parted) && !self.is_empty();
        self.lines.push(Line { code: " ".repeat(STEP * level), is_parted, ..Line::default() });
    }

    /// Goes on with the line.
    pub fn write(&mut self, code: &str) {
        if let Some(line) = self.lines.last_mut() {
            line.code.push_str(code);
        }
    }

    /// Ends the line with a comment.
    pub fn comment(&mut self, comment: &str) {
        if let Some(line) = self.lines.last_mut() {
            line.comment.push_str(comment.trim_end());
        }
    }

    /// Parts what follows by an empty line; several are as one, and none stands at either end.
    pub fn empty_line(&mut self) {
        self.is_parted = true;
    }

    /// The text.
    pub fn finish(self) -> String {
        let mut text = String::new();
        let mut lines = &self.lines[..];
        while let Some(first) = lines.first() {
            // Comments behind neighbouring statements stand in one column.
            let is_next = |line: &&Line| line.is_annotated() && !line.is_parted;
            let n = if first.is_annotated() {
                lines[1..].iter().take_while(is_next).count()
            } else {
                0
            };
            let (run, behind) = lines.split_at(1 + n);
            let width = run.iter().map(|line| line.code.chars().count()).max().unwrap_or(0);
            let column = if first.is_annotated() { width + BEFORE_COMMENT } else { 0 };
            run.iter().for_each(|line| line.push_to(&mut text, column));
            lines = behind;
        }
        text
    }
}

impl Line {
    /// Does a comment stand behind something else?
    fn is_annotated(&self) -> bool {
        !self.comment.is_empty() && !self.code.trim().is_empty()
    }

    fn push_to(&self, text: &mut String, column: usize) {
        if self.is_parted {
            text.push('\n');
        }
        text.push_str(&self.code);
        if !self.comment.is_empty() {
            let n = column.saturating_sub(self.code.chars().count());
            text.extend(std::iter::repeat_n(' ', n));
            text.push_str(&self.comment);
        }
        text.truncate(text.trim_end_matches(' ').len());
        text.push('\n');
    }
}
