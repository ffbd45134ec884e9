//! Laws of the language: what is printed reads back, and no text is too odd to be read.

use linkwork::diag::{Diagnostic, Paint, SourceId, Sources, Span, render};
use linkwork::lang::ast::Statement;
use linkwork::lang::{catalogue, format, is_incomplete, parse};
use proptest::prelude::*;

use crate::support::draws::draws;
use crate::support::trees::statement;

proptest! {
    #![proptest_config(draws(600))]

    #[test]
    fn what_is_printed_reads_back(statement in statement()) {
        let text = statement.to_string();
        prop_assert_eq!(read(&text), Ok(vec![statement]), "of {}", text);
    }

    #[test]
    fn layout_means_nothing(statement in statement()) {
        // Line ends, blanks and comments go where blanks are; strings are left alone.
        let text = statement.to_string();
        if text.contains(['"', '{']) {
            return Ok(());
        }
        let text = format!("\u{feff}\r\n; {} # end", text.replace(' ', " \\\r\n\t"));
        prop_assert_eq!(read(&text), Ok(vec![statement]), "of {}", text);
    }

    #[test]
    fn the_form_of_scripts_says_the_same_and_stays(statement in statement()) {
        let text = statement.to_string();
        let broken = format!("# a\n{} # end", text.replace(' ', " \\\r\n\t"));
        let written = if text.contains(['"', '{']) { vec![text] } else { vec![text, broken] };
        for text in written {
            let form = format(SourceId(0), &text).expect("it has no mistake");
            prop_assert_eq!(read(&form), Ok(vec![statement.clone()]), "of {}", text);
            prop_assert_eq!(format(SourceId(0), &form), Ok(form.clone()), "of {}", text);
        }
    }

    #[test]
    fn any_characters_are_survived(text in ".{0,200}") {
        survives(&text)?;
    }

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        survives(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn words_of_the_language_in_any_order_are_survived(
        words in prop::collection::vec(prop::sample::select(words()), 0..40)
    ) {
        survives(&words.join(" "))?;
        survives(&words.concat())?;
    }

    #[test]
    fn damaged_statements_are_survived(
        statement in statement(),
        cut in any::<prop::sample::Index>(),
        len in 0_usize..4,
        put in prop::sample::select(words()),
    ) {
        let mut text: Vec<char> = statement.to_string().chars().collect();
        let at = cut.index(text.len());
        let end = (at + len).min(text.len());
        survives(&text[..at].iter().collect::<String>())?;
        text.splice(at..end, put.chars());
        survives(&text.iter().collect::<String>())?;
    }

    #[test]
    fn what_was_read_before_is_not_seen(
        statement in statement(),
        cut in any::<prop::sample::Index>(),
        put in prop::sample::select(words()),
        first in 0_usize..3,
    ) {
        let text = statement.to_string();
        stands_alone(&text, first)?;
        let mut damaged: Vec<char> = text.chars().collect();
        let at = cut.index(damaged.len());
        damaged.splice(at..at, put.chars());
        stands_alone(&damaged.iter().collect::<String>(), first)?;
    }

    #[test]
    fn words_of_the_language_are_read_alike_behind_others(
        words in prop::collection::vec(prop::sample::select(words()), 0..8),
        first in 0_usize..3,
    ) {
        stands_alone(&words.join(" "), first)?;
        stands_alone(&words.concat(), first)?;
    }
}

/// Checks that `text` is read behind one that differs from it in its digits as it is behind a comment.
fn stands_alone(text: &str, first: usize) -> Result<(), TestCaseError> {
    // A byte order mark is none behind others.
    let text = text.trim_start_matches('\u{feff}');
    let other = with_other_digits(text, first);
    let (Ok(before), false) = (read(&other), is_incomplete(&other)) else { return Ok(()) };
    // What two have in common is kept.
    let behind_other = format!("{other};\n{other};\n{text}");
    let n_before = behind_other.len() - text.len();
    let behind_comment = format!("#{}\n{text}", "-".repeat(n_before - 2));
    let told = |text: &str, n_before: usize| {
        // All of the trees, with the places that comparing them leaves out.
        parse(SourceId(0), text).skip(n_before).map(|it| format!("{it:?}")).collect::<Vec<_>>()
    };
    let (alone, behind) = (told(&behind_comment, 0), told(&behind_other, 2 * before.len()));
    prop_assert_eq!(alone, behind, "{:?} behind {:?}", text, other);
    Ok(())
}

/// `text` with other digits, more or fewer, wherever some stand.
fn with_other_digits(text: &str, first: usize) -> String {
    let mut others = ["4", "31", "205"].into_iter().cycle().skip(first);
    let mut changed = String::new();
    let mut was_digit = false;
    for char in text.chars() {
        let is_digit = char.is_ascii_digit();
        if !is_digit {
            changed.push(char);
        } else if !was_digit {
            changed.extend(others.next());
        }
        was_digit = is_digit;
    }
    changed
}

fn read(text: &str) -> Result<Vec<Statement>, Diagnostic> {
    let mut sources = Sources::new();
    let id = sources.add("law", text);
    parse(id, text).collect()
}

/// Reads `text`, draws each mistake, and checks that every span lies on characters of it.
fn survives(text: &str) -> Result<(), TestCaseError> {
    let mut sources = Sources::new();
    let id = sources.add("odd", text);
    is_incomplete(text);
    let check = |span: Span| {
        let is_inside = text.get(span.range()).is_some();
        prop_assert!(is_inside, "{span:?} in {text:?}");
        Ok(())
    };
    for statement in parse(id, text) {
        match statement {
            Ok(statement) => {
                check(statement.span)?;
                let printed = statement.to_string();
                prop_assert_eq!(read(&printed), Ok(vec![statement]), "of {}", printed);
            }
            Err(problem) => {
                for label in &problem.labels {
                    check(label.span)?;
                }
                prop_assert!(problem.place().is_some(), "{problem:?} has no place");
                render(&problem, &sources, Paint::Coloured);
                render(&problem.reached_from(Span::new(id, 0..1)), &sources, Paint::Plain);
            }
        }
    }
    Ok(())
}

/// Every keyword, and what else statements consist of.
fn words() -> Vec<String> {
    let marks = "( ) [ ] { } , ; = <= >= < > .. . : + - * / ^ # \\ \" \n \r\n \t é 'x A p[3] p[i-1].x \
                 left.B (1,2) 3 .5 1e-9 2. 90deg 3x 1e999 \"text\" \"a\\qb\" sin( pi time to in at on \
                 over all frozen unbounded inside cascade every within for as stop radius \u{a0} \u{feff}";
    let marks = marks.split(' ').map(str::to_owned);
    marks.chain(catalogue::commands().map(|entry| entry.keyword.to_owned())).collect()
}
