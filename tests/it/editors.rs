//! The grammar for editors knows the words of the language.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkwork::lang::catalogue::commands;
use linkwork::terms::Function;

/// The words in a pattern of the grammar that are tried one after the other.
fn words_around<'a>(grammar: &'a str, one: &str) -> BTreeSet<&'a str> {
    let lists = grammar.split(['(', ')', ':']).map(|list| list.trim_start_matches('?'));
    let words = lists.map(|list| list.split('|').collect::<BTreeSet<_>>());
    words.filter(|words| words.contains(one)).max_by_key(BTreeSet::len).unwrap_or_default()
}

#[test]
fn the_editors_grammar_knows_every_command_and_function() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("editors/linkwork.tmLanguage.json");
    let grammar = fs::read_to_string(path).expect("the grammar can be read");
    let wanted: BTreeSet<&str> = commands().map(|entry| entry.keyword).chain(["add"]).collect();
    assert_eq!(words_around(&grammar, "motor"), wanted);
    let wanted: BTreeSet<&str> = Function::ALL.iter().map(|function| function.name()).collect();
    assert_eq!(words_around(&grammar, "atan2"), wanted);
}
