//! Draws a diagnostic the way `rustc` does; the only place that names annotate-snippets.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::source::clip;
use super::{Diagnostic, Severity, Sources, Span};

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
    let level = match problem.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let mut group = level.primary_title(&*problem.message).elements(snippets(problem, sources));
    for note in &problem.notes {
        group = group.element(Level::NOTE.message(note));
    }
    for help in &problem.helps {
        group = group.element(Level::HELP.message(help));
    }
    let mut report = vec![group];
    let n_hidden = problem.via.len().saturating_sub(VIA_SHOWN);
    for (position, &span) in problem.via.iter().take(VIA_SHOWN).enumerate() {
        let mut group = Level::NOTE.secondary_title("reached from here").elements(snippet(
            span,
            [(span, "", AnnotationKind::Primary)],
            sources,
        ));
        if position + 1 == VIA_SHOWN && n_hidden > 0 {
            group = group.element(Level::NOTE.message(format!("and from {n_hidden} more places")));
        }
        report.push(group);
    }
    let renderer = match paint {
        Paint::Plain => Renderer::plain(),
        Paint::Coloured => Renderer::styled(),
    };
    renderer.render(&report)
}

/// Deeper chains of `for`, `use` and `include` are counted, not drawn.
const VIA_SHOWN: usize = 4;

/// One snippet for each text the labels point into, the primary one's first.
fn snippets<'a>(problem: &'a Diagnostic, sources: &'a Sources) -> Vec<Drawn<'a>> {
    let mut order: Vec<Span> = Vec::new();
    let by_rank = |primary| problem.labels.iter().filter(move |label| label.primary == primary);
    for label in by_rank(true).chain(by_rank(false)) {
        if order.iter().all(|span| span.source != label.span.source) {
            order.push(label.span);
        }
    }
    order
        .into_iter()
        .filter_map(|first| {
            let source = first.source;
            let here = problem.labels.iter().filter(move |label| label.span.source == source);
            let labels = here.map(|label| {
                let kind = match label.primary {
                    true => AnnotationKind::Primary,
                    false => AnnotationKind::Context,
                };
                (label.span, label.text.as_str(), kind)
            });
            snippet(first, labels, sources)
        })
        .collect()
}

type Drawn<'a> = Snippet<'a, annotate_snippets::Annotation<'a>>;

/// The lines of the text of `first` from the first to the last label.
///
/// Only these are handed to the drawing, so an error in a script of a million lines costs
/// no more than in a short one. A label of several lines is cut at the end of its first.
fn snippet<'a>(
    first: Span,
    labels: impl IntoIterator<Item = (Span, &'a str, AnnotationKind)>,
    sources: &'a Sources,
) -> Option<Drawn<'a>> {
    let source = sources.get(first.source)?;
    let text: &str = &source.text;
    let labels: Vec<_> = labels
        .into_iter()
        .map(|(span, label, kind)| {
            let range = clip(text, span.range());
            let end = range.end.min(line_end(text, range.start)).max(range.start);
            (range.start..end, label, kind)
        })
        .collect();
    let from = labels.iter().map(|(range, ..)| line_start(text, range.start)).min()?;
    let to = labels.iter().map(|(range, ..)| line_end(text, range.start)).max()?.max(from);
    let line = text[..from].bytes().filter(|&byte| byte == b'\n').count() + source.first_line;
    let annotations = labels.into_iter().map(|(range, label, kind)| {
        let label = (!label.is_empty()).then_some(label);
        kind.span(range.start - from..range.end - from).label(label)
    });
    Some(
        Snippet::source(&text[from..to])
            .path(&*source.name)
            .line_start(line)
            .annotations(annotations),
    )
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

fn line_end(text: &str, at: usize) -> usize {
    let line = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
    // The carriage return of a CRLF is no part of the line, unless the place is behind it.
    if line > at && text.as_bytes()[line - 1] == b'\r' { line - 1 } else { line }
}
