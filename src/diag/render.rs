//! Draws a diagnostic the way `rustc` does; the only place that names annotate-snippets.

use std::borrow::Cow;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::source::clip;
use super::{Diagnostic, Place, Severity, Sources, Span, visible};

/// Are escape codes for colours written?
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Paint {
    /// Text alone.
    Plain,
    /// With colours of a terminal.
    Coloured,
}

/// Draws `problem` with the lines of text it is about, without a newline at the end.
pub fn render(problem: &Diagnostic, sources: &Sources, paint: Paint) -> String {
    render_within(problem, sources, paint, WIDTH)
}

/// Columns of a terminal that says nothing of its width.
const WIDTH: usize = 140;

/// As [`render`](fn@render), no text so wide that it would be broken in a terminal of so many
/// columns: a line that is broken takes the marks below it away from their places.
pub fn render_within(
    problem: &Diagnostic,
    sources: &Sources,
    paint: Paint,
    n_columns: usize,
) -> String {
    let problem = &without_orders(problem);
    let level = match problem.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let title = level.primary_title(&*problem.message);
    let title = match problem.code {
        Some(code) => title.id(code.to_string()),
        None => title,
    };
    let mut group = title.elements(snippets(problem, sources));
    for note in &problem.notes {
        group = group.element(Level::NOTE.message(note));
    }
    for help in &problem.helps {
        group = group.element(Level::HELP.message(help));
    }
    let mut report = vec![group];
    let n_hidden = problem.via.len().saturating_sub(VIA_SHOWN);
    for (position, &span) in problem.via.iter().take(VIA_SHOWN).enumerate() {
        let mut group = Level::NOTE
            .secondary_title("reached from here")
            .elements(snippet(&[(span, "", AnnotationKind::Primary)], sources));
        if position + 1 == VIA_SHOWN && n_hidden > 0 {
            group = group.element(Level::NOTE.message(format!("and from {n_hidden} more places")));
        }
        report.push(group);
    }
    let renderer = match paint {
        Paint::Plain => Renderer::plain(),
        Paint::Coloured => Renderer::styled(),
    };
    renderer.term_width(n_columns).render(&report)
}

/// Says `problem` in one line that editors and `grep` can take apart:
/// `file:line:column: error[E0201]: message: label`.
///
/// ```
/// use linkwork::diag::{Code, Diagnostic, Sources, Span, short};
///
/// let mut sources = Sources::new();
/// let id = sources.add("a.link", "step\nlenght A B");
/// let problem = Diagnostic::error(Code::new(101), "unknown command `lenght`")
///     .at(Span::new(id, 5..11), "not a command");
/// let line = "a.link:2:1: error[E0101]: unknown command `lenght`: not a command";
/// assert_eq!(short(&problem, &sources), line);
/// ```
pub fn short(problem: &Diagnostic, sources: &Sources) -> String {
    let problem = &without_orders(problem);
    let mut line = String::new();
    let place = problem.place().and_then(|span| Some((sources.get(span.source)?, span)));
    if let Some((source, span)) = place
        && let Some(Place { line: row, column }) = sources.place(span)
    {
        line = format!("{}:{row}:{column}: ", visible(&source.name));
    }
    line.push_str(match problem.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    });
    if let Some(code) = problem.code {
        line = format!("{line}[{code}]");
    }
    let line = format!("{line}: {problem}");
    let line = problem.helps.iter().fold(line, |line, help| line + "; " + help);
    line.replace('\n', " ")
}

/// A problem whose words may quote anything, as a terminal may show them.
fn without_orders(problem: &Diagnostic) -> Diagnostic {
    let mut problem = problem.clone();
    let shown = |text: &str| visible(text).into_owned();
    problem.message = shown(&problem.message).into_boxed_str();
    problem.labels.iter_mut().for_each(|label| label.text = shown(&label.text));
    problem.notes.iter_mut().for_each(|note| *note = shown(note));
    problem.helps.iter_mut().for_each(|help| *help = shown(help));
    problem
}

/// Deeper chains of `for`, `use` and `include` are counted, not drawn.
const VIA_SHOWN: usize = 4;

/// One snippet for each group of labels that lie close together, the primary one's first.
fn snippets<'a>(problem: &'a Diagnostic, sources: &'a Sources) -> Vec<Drawn<'a>> {
    let mut groups: Vec<Vec<Mark>> = Vec::new();
    let by_rank = |primary| problem.labels.iter().filter(move |label| label.primary == primary);
    for label in by_rank(true).chain(by_rank(false)) {
        let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let mark = (label.span, label.text.as_str(), kind);
        match groups.iter_mut().find(|group| is_near(group[0].0, label.span)) {
            Some(group) => group.push(mark),
            None => groups.push(vec![mark]),
        }
    }
    groups.into_iter().filter_map(|marks| snippet(&marks, sources)).collect()
}

/// Can the two be drawn in one snippet?
fn is_near(a: Span, b: Span) -> bool {
    a.source == b.source && a.start.abs_diff(b.start) < 4_000
}

/// A place, what is written beside it, and how it is underlined.
type Mark<'a> = (Span, &'a str, AnnotationKind);
type Drawn<'a> = Snippet<'a, annotate_snippets::Annotation<'a>>;

/// Bytes of a longer place are not underlined: the whole of it would be drawn.
const LONGEST_UNDERLINED: usize = 100;

/// Bytes that are drawn behind the last place: more than a terminal is wide.
const LONGEST_TAIL: usize = 200;

/// The lines of the text from the first to the last of `marks`, all of one text.
///
/// Only these are handed to the drawing, so an error in a script of a million lines costs
/// no more than in a short one. A place of several lines is cut at the end of its first.
fn snippet<'a>(marks: &[Mark<'a>], sources: &'a Sources) -> Option<Drawn<'a>> {
    let source = sources.get(marks.first()?.0.source)?;
    let text: &str = &source.text;
    let ranges: Vec<_> = marks
        .iter()
        .map(|(span, ..)| {
            let range = clip(text, span.range());
            let cut = text.ceil_char_boundary(range.start.saturating_add(LONGEST_UNDERLINED));
            range.start..range.end.min(line_end(text, range.start)).min(cut).max(range.start)
        })
        .collect();
    let from = ranges.iter().map(|range| line_start(text, range.start)).min()?;
    let last = ranges.iter().map(|range| range.end).max()?;
    let tail = text.ceil_char_boundary(last.saturating_add(LONGEST_TAIL));
    let to = line_end(text, last).min(tail).max(last);
    let line = source.line(from);
    let annotations = marks.iter().zip(ranges).map(|((_, label, kind), range)| {
        let label = (!label.is_empty()).then_some(*label);
        kind.span(range.start - from..range.end - from).label(label)
    });
    Some(
        Snippet::source(without_second_controls(&text[from..to]))
            .path(visible(&source.name))
            .line_start(line)
            .annotations(annotations),
    )
}

/// A text without the control characters from U+0080 on, which the drawing lets through; what takes
/// their place is as long, so that places stay where they are.
fn without_second_controls(text: &str) -> Cow<'_, str> {
    let is_control = |char: char| ('\u{80}'..='\u{9f}').contains(&char);
    if text.contains(is_control) { text.replace(is_control, "¿").into() } else { text.into() }
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

fn line_end(text: &str, at: usize) -> usize {
    let line = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
    // The carriage return of a CRLF is no part of the line, unless the place is behind it.
    if line > at && text.as_bytes()[line - 1] == b'\r' { line - 1 } else { line }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::{Code, Diagnostic, SourceId};

    /// Draws an error at `range` of `text`.
    fn drawn(text: &str, range: std::ops::Range<usize>) -> String {
        let mut sources = Sources::new();
        let id = sources.add("a.link", text);
        let problem = Diagnostic::error(Code::new(7), "wrong").at(Span::new(id, range), "here");
        render(&problem, &sources, Paint::Plain)
    }

    fn check(text: &str, range: std::ops::Range<usize>, wanted: &str) {
        assert_eq!(drawn(text, range), wanted, "of {text:?}");
    }

    #[test]
    fn the_place_is_underlined() {
        check(
            "one\ntwo three\nfour",
            8..13,
            "error[E0007]: wrong\n --> a.link:2:5\n  |\n2 | two three\n  |     ^^^^^ here",
        );
    }

    #[test]
    fn odd_line_ends_and_empty_texts_are_survived() {
        let empty = "error[E0007]: wrong\n --> a.link:1:1\n  |\n1 |\n  | ^ here";
        check("", 0..0, empty);
        check("", 7..9, empty);
        check("\r\n", 0..1, empty);
        check("ab\r\ncd", 0..2, "error[E0007]: wrong\n --> a.link:1:1\n  |\n1 | ab\n  | ^^ here");
        check("ab\n", 3..3, "error[E0007]: wrong\n --> a.link:2:1\n  |\n2 |\n  | ^ here");
        check("ab", 2..2, "error[E0007]: wrong\n --> a.link:1:3\n  |\n1 | ab\n  |   ^ here");
    }

    #[test]
    fn of_several_lines_the_first_is_underlined() {
        check("ab\ncd\nef", 1..8, "error[E0007]: wrong\n --> a.link:1:2\n  |\n1 | ab\n  |  ^ here");
    }

    #[test]
    fn tabs_and_control_characters_are_made_visible() {
        check(
            "\tab",
            1..2,
            "error[E0007]: wrong\n --> a.link:1:2\n  |\n1 |     ab\n  |     ^ here",
        );
        let escape = drawn("a\u{1b}[31mb", 0..1);
        assert!(!escape.contains('\u{1b}'), "{escape:?}");
        let order = "\u{1b}[2J\u{9b}31m\r";
        let mut sources = Sources::new();
        let id = sources.add(order, order);
        let problem = Diagnostic::error(Code::new(7), order)
            .at(Span::new(id, 0..1), order)
            .also(Span::new(id, 1..2), order)
            .note(order)
            .help(order)
            .reached_from(Span::new(id, 0..1));
        let drawn = render(&problem, &sources, Paint::Plain);
        assert!(drawn.chars().all(|c| c == '\n' || !c.is_control()), "{drawn:?}");
    }

    #[test]
    fn long_lines_are_cut() {
        let text = format!("{}x{}", "a ".repeat(100_000), " b".repeat(100_000));
        let drawn = drawn(&text, 200_000..200_001);
        assert!(drawn.len() < 1_000, "{} bytes", drawn.len());
        assert!(drawn.contains("a x b"), "{drawn}");
        assert!(drawn.contains("a.link:1:200001"), "{drawn}");
    }

    #[test]
    fn without_blanks_too() {
        let text = "x".repeat(100_000);
        for range in [0..1, 0..100_000, 50_000..50_001, 50_000..100_000, 100_000..100_000] {
            let drawn = drawn(&text, range.clone());
            assert!(drawn.len() < 1_500, "{} bytes at {range:?}", drawn.len());
        }
    }

    #[test]
    fn places_far_apart_are_drawn_apart() {
        let mut sources = Sources::new();
        let text = format!("({}\n)", "x".repeat(100_000));
        let id = sources.add("a.link", &*text);
        let problem = Diagnostic::error(Code::new(7), "wrong")
            .at(Span::new(id, text.len() - 1..text.len()), "here")
            .also(Span::new(id, 0..1), "opened here");
        let drawn = render(&problem, &sources, Paint::Plain);
        assert!(drawn.len() < 1_500, "{} bytes", drawn.len());
        assert!(drawn.contains("a.link:2:1") && drawn.contains("opened here"), "{drawn}");
    }

    #[test]
    fn the_way_to_the_place_is_told() {
        let mut sources = Sources::new();
        let inner = sources.add("leg.link", "length A Q");
        let outer = sources.add("a.link", "step\ninclude \"leg.link\"");
        let problem = Diagnostic::error(Code::new(7), "there is no `Q`")
            .at(Span::new(inner, 9..10), "")
            .note("the points are `A` and `B`")
            .help("did you mean `B`?")
            .reached_from(Span::new(outer, 5..23));
        let wanted = "\
error[E0007]: there is no `Q`
 --> leg.link:1:10
  |
1 | length A Q
  |          ^
  |
  = note: the points are `A` and `B`
  = help: did you mean `B`?
note: reached from here
 --> a.link:2:1
  |
2 | include \"leg.link\"
  | ^^^^^^^^^^^^^^^^^^";
        assert_eq!(render(&problem, &sources, Paint::Plain), wanted);
        let coloured = render(&problem, &sources, Paint::Coloured);
        assert!(coloured.contains("\u{1b}["));
        let deep =
            (0..100).fold(problem, |problem, _| problem.reached_from(Span::new(outer, 0..4)));
        let drawn = render(&deep, &sources, Paint::Plain);
        assert!(drawn.contains("and from 97 more places"), "{drawn}");
    }

    #[test]
    fn without_a_place_the_message_stands_alone() {
        let sources = Sources::new();
        let problem = Diagnostic::warning("the disk is full");
        assert_eq!(render(&problem, &sources, Paint::Plain), "warning: the disk is full");
        let lost = Diagnostic::error(Code::new(7), "lost").at(Span::new(SourceId(9), 0..1), "x");
        assert_eq!(render(&lost, &sources, Paint::Plain), "error[E0007]: lost");
    }
}
