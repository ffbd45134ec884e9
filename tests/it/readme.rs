//! The front page and the reference say what the program says.

use linkwork::lang::catalogue;

#[test]
fn the_front_page_tells_the_truth() {
    trycmd::TestCases::new().case("README.md");
}

#[test]
fn the_reference_names_every_command() {
    let reference = include_str!("../../docs/language.md");
    // What stands between two backticks: every other piece.
    let code: Vec<&str> = reference.split('`').skip(1).step_by(2).collect();
    let is_named = |word: &str| code.iter().any(|code| code.split(is_no_letter).any(|w| w == word));
    let missing: Vec<&str> =
        catalogue::commands().map(|entry| entry.keyword).filter(|word| !is_named(word)).collect();
    assert_eq!(missing, Vec::<&str>::new(), "commands that docs/language.md does not name");
}

fn is_no_letter(c: char) -> bool {
    !c.is_ascii_alphabetic()
}
