//! Lines that fit a terminal: broken at words, what is left of them indented.

/// In narrower terminals nothing is gained by indenting.
const NARROWEST: usize = 20;
/// What goes on is indented by so much more than what it belongs to.
const INDENT: usize = 4;

/// The line in lines of at most so many columns. It is broken between words only, so that a word
/// that is wider is left whole. What does not fit stands below the second column of a table, below
/// the text of a message, or a little further in than the line.
pub fn wrapped(line: &str, n_columns: usize) -> String {
    if width(line) <= n_columns || n_columns < NARROWEST {
        return line.to_owned();
    }
    let indent = " ".repeat(hanging(line, n_columns));
    let mut out = String::with_capacity(line.len() + indent.len());
    let mut column = 0;
    for (blanks, word) in words(line) {
        let end = column + blanks.len() + width(word);
        if end > n_columns && !out.is_empty() {
            out.push('\n');
            out.push_str(&indent);
            out.push_str(word);
            column = indent.len() + width(word);
        } else {
            out.push_str(blanks);
            out.push_str(word);
            column = end;
        }
    }
    out
}

/// Words, each with the blanks before it.
fn words(line: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut rest = line;
    std::iter::from_fn(move || {
        let start = rest.find(|c| c != ' ')?;
        let end = rest[start..].find(' ').map_or(rest.len(), |n| start + n);
        let pair = (&rest[..start], &rest[start..end]);
        rest = &rest[end..];
        Some(pair)
    })
}

/// Where the lines after the first begin.
fn hanging(line: &str, n_columns: usize) -> usize {
    let line: String = letters(line).collect();
    let widest = n_columns * 3 / 5;
    let indent = line.len() - line.trim_start().len();
    let column = message_text(&line).or_else(|| second_column(&line, indent));
    column.filter(|&column| column <= widest).unwrap_or((indent + INDENT).min(widest))
}

/// Where a note, or what is said of an underlined place, has its first word.
fn message_text(line: &str) -> Option<usize> {
    let text = line.trim_start();
    let text = match text.strip_prefix("= ") {
        Some(note) => note.split_once(": ")?.1,
        None => text
            .strip_prefix("| ")?
            .trim_start()
            .strip_prefix('^')?
            .trim_start_matches('^')
            .trim_start(),
    };
    Some(width(line) - width(text))
}

/// Where what stands behind the first gap begins.
fn second_column(line: &str, indent: usize) -> Option<usize> {
    let gap = indent + line[indent..].find("  ")?;
    let text = line[gap..].trim_start();
    Some(width(line) - width(text))
}

/// Columns that a text takes, colours left out.
fn width(text: &str) -> usize {
    letters(text).count()
}

/// A text without the orders that colour it.
fn letters(text: &str) -> impl Iterator<Item = char> {
    let mut is_order = false;
    text.chars().filter(move |&c| {
        let was_order = is_order;
        is_order = c == '\x1b' || (is_order && c != 'm');
        !is_order && !was_order
    })
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn what_fits_stays_as_it_is() {
        let line = "  drag  draw points along straight lines";
        assert_eq!(wrapped(line, line.len()), line);
        assert_eq!(wrapped("", 40), "");
    }

    #[test]
    fn a_table_goes_on_below_its_second_column() {
        let line = "  drag    draw points along straight lines, simulating";
        let wanted = "  drag    draw points along\n          straight lines,\n          simulating";
        assert_eq!(wrapped(line, 30), wanted);
    }

    #[test]
    fn a_wide_first_column_does_not_push_the_rest_away() {
        let line = "a-name-of-some-length   what it is for";
        assert_eq!(wrapped(line, 30), "a-name-of-some-length   what\n    it is for");
    }

    #[test]
    fn messages_go_on_below_their_text() {
        let line = "  = help: to define it, write `let A = ...`";
        assert_eq!(wrapped(line, 30), "  = help: to define it, write\n          `let A = ...`");
        let line = "  |                 ^^^^^ expected the end of the statement";
        let wanted = "  |                 ^^^^^ expected the\n      end of the statement";
        assert_eq!(wrapped(line, 40), wanted);
        let line = "  |     ^^^^^ expected the end of the statement";
        assert_eq!(
            wrapped(line, 30),
            "  |     ^^^^^ expected the end\n              of the statement"
        );
    }

    #[test]
    fn a_word_is_never_broken_and_colours_take_no_room() {
        let path = "x".repeat(50);
        assert_eq!(
            wrapped(&format!("see {path} there"), 30),
            format!("see\n    {path}\n    there")
        );
        let red = "\x1b[31mone two three four five six seven\x1b[0m";
        assert_eq!(wrapped(red, 33), red);
        assert_eq!(wrapped(red, 30), "\x1b[31mone two three four five six\n    seven\x1b[0m");
    }

    #[test]
    fn all_words_are_kept_in_any_width() {
        let line = "  gear (two wheels)   `cog O A, Q B teeth 20, 60`; \u{3b1} `inside` for a ring";
        for n_columns in 0..100 {
            let broken = wrapped(line, n_columns);
            let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
            assert_eq!(words(&broken), words(line));
            let is_wide = |line: &str| line.chars().count() > n_columns;
            assert!(n_columns < 20 || !broken.lines().any(is_wide), "{n_columns}: {broken}");
        }
    }
}
