//! What each piece of a text is, for whoever shows it: commands, names, numbers, comments.
//!
//! A statement that can be read is told by the grammar; one that cannot (it is being typed) by its
//! first word and the words that clauses begin with.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use pest::Parser;
use pest::iterators::Pair;

use super::prefix::{first_word, is_word_char};
use crate::lang::catalogue::{self, ConstraintWord, Slot};
use crate::lang::expr::Unit;
use crate::lang::grammar::{LinkworkParser, Rule};
use crate::lang::layout::{Flaw, Layout, string_end};
use crate::terms::Function;

/// What a piece of a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// The word that a statement begins with.
    Command,
    /// A word that a part of a statement begins with: `speed`, `frozen`, `in`.
    Clause,
    /// The name of something, with the parts of it that can be told here.
    Name,
    /// A name that is given to something here.
    NewName,
    /// A function that is called.
    Function,
    /// A number with its suffix.
    Number,
    /// A string.
    Text,
    /// A comment.
    Comment,
    /// A sign.
    Sign,
}

/// A piece of a text; blanks belong to none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Token {
    /// Its bytes.
    pub range: Range<usize>,
    /// What it is.
    pub class: Class,
}

/// The pieces of a text, in their order.
///
/// ```
/// use linkwork::lang::{Class, tokens};
///
/// let classes: Vec<Class> = tokens("crank: motor A B").iter().map(|it| it.class).collect();
/// assert_eq!(classes, [Class::NewName, Class::Sign, Class::Command, Class::Name, Class::Name]);
/// ```
pub fn tokens(text: &str) -> Vec<Token> {
    Tokens::default().of(text)
}

/// What the words of a statement are, by where they begin in it.
type Words = Arc<[(usize, Class)]>;

/// The pieces of a text that is asked for again and again while it is typed: a statement that was in it
/// the last time is not read anew.
#[derive(Debug, Clone, Default)]
pub struct Tokens {
    /// The statements of the text.
    read: HashMap<Box<str>, Words>,
}

impl Tokens {
    /// As [`tokens`].
    pub fn of(&mut self, text: &str) -> Vec<Token> {
        let known = std::mem::take(&mut self.read);
        let mut telling = Telling { text, known, read: HashMap::new(), told: HashMap::new() };
        telling.read_block(0..text.len());
        let Telling { read, told, .. } = telling;
        self.read = read;
        let mut tokens = lexed(text);
        let mut previous = None;
        for token in tokens.iter_mut().filter(|token| token.class == Class::Name) {
            token.class = told.get(&token.range.start).copied().unwrap_or_else(|| {
                // What stands behind the last mistake is read word by word.
                guessed(text, &token.range, previous)
            });
            previous = Some(token.range.end);
        }
        tokens
    }
}

/// A text on its way to be told.
struct Telling<'a> {
    text: &'a str,
    /// What was read before.
    known: HashMap<Box<str>, Words>,
    /// What is in this text.
    read: HashMap<Box<str>, Words>,
    /// What words are, by the offsets where they begin.
    told: HashMap<usize, Class>,
}

impl Telling<'_> {
    /// Tells what the words of the statements in a range are.
    fn read_block(&mut self, range: Range<usize>) {
        let text = self.text;
        let mut layout = Layout::new(text, range.clone());
        while let Some(piece) = layout.next_piece() {
            match piece {
                Ok(piece) => {
                    self.read_head(piece.head);
                    if let Some(block) = piece.block {
                        self.read_block(block);
                    }
                }
                Err(Flaw::Unclosed { outermost, start, .. })
                    if text.as_bytes()[outermost] == b'{' =>
                {
                    self.read_head(start..outermost);
                    self.read_block(outermost + 1..range.end);
                }
                Err(_) => return,
            }
        }
    }

    /// Tells what the words of a statement are.
    fn read_head(&mut self, head: Range<usize>) {
        let statement = self.text[head.clone()].trim_end();
        if !self.read.contains_key(statement) {
            let known = self.known.remove_entry(statement);
            let (statement, words) = known.unwrap_or_else(|| (statement.into(), words(statement)));
            self.read.insert(statement, words);
        }
        let words = self.read[statement].iter();
        self.told.extend(words.map(|&(at, class)| (head.start + at, class)));
    }
}

/// What the words of a statement are, if it can be read.
fn words(statement: &str) -> Words {
    let mut told = HashMap::new();
    let mut at = 0;
    if let Ok(prefix) = LinkworkParser::parse(Rule::prefix, statement) {
        for pair in prefix.flatten() {
            let start = pair.as_span().start();
            match pair.as_rule() {
                Rule::name => drop(told.insert(start, Class::NewName)),
                Rule::kw_add => drop(told.insert(start, Class::Command)),
                Rule::verb => at = start,
                _ => {}
            }
        }
    }
    read_command(&statement[at..], at, &mut told);
    told.into_iter().collect()
}

/// Tells the words of what stands behind a label, at a place in its statement.
fn read_command(input: &str, at: usize, told: &mut HashMap<usize, Class>) {
    let word = first_word(input);
    let rule = if super::is_bare(input) { Some(Rule::bare) } else { catalogue::rule(word) };
    let Some(Ok(mut pairs)) = rule.map(|rule| LinkworkParser::parse(rule, input)) else {
        return;
    };
    let Some(whole) = pairs.next() else { return };
    for pair in whole.clone().into_inner() {
        read_pair(&pair, &whole, at, told);
    }
    if rule == Some(Rule::set) {
        read_setting(whole, at, told);
    }
    if rule != Some(Rule::bare) {
        told.insert(at, Class::Command);
    }
}

/// Tells the words of a setting and of its value, which are no names.
fn read_setting(set: Pair<'_, Rule>, base: usize, told: &mut HashMap<usize, Class>) {
    for pair in set.into_inner() {
        if matches!(pair.as_rule(), Rule::setting | Rule::expr) {
            let start = base + pair.as_span().start();
            for token in lexed(pair.as_str()).iter().filter(|it| it.class == Class::Name) {
                let is_word =
                    pair.as_rule() == Rule::setting || token.range.len() == pair.as_str().len();
                if is_word {
                    told.insert(start + token.range.start, Class::Clause);
                }
            }
        }
    }
}

fn read_pair(
    pair: &Pair<'_, Rule>,
    parent: &Pair<'_, Rule>,
    base: usize,
    told: &mut HashMap<usize, Class>,
) {
    let start = base + pair.as_span().start();
    let is_first = pair.as_span().start() == parent.as_span().start();
    let is_new = match parent.as_rule() {
        Rule::point_decl | Rule::binding | Rule::defined | Rule::result_item => is_first,
        Rule::measure => true,
        _ => false,
    };
    match pair.as_rule() {
        Rule::name if is_new => drop(told.insert(start, Class::NewName)),
        Rule::name => drop(told.insert(start, Class::Name)),
        Rule::ident => {
            let is_new = matches!(parent.as_rule(), Rule::for_ | Rule::define | Rule::parameters);
            told.entry(start).or_insert(if is_new { Class::NewName } else { Class::Clause });
        }
        Rule::reference if pair.clone().into_inner().any(|it| it.as_rule() == Rule::arguments) => {
            for inner in pair.clone().into_inner() {
                read_pair(&inner, pair, base, told);
            }
            told.insert(start, Class::Function);
            return;
        }
        _ if is_leaf(pair) && pair.as_str().starts_with(char::is_alphabetic) => {
            told.insert(start, Class::Clause);
        }
        _ => {}
    }
    for inner in pair.clone().into_inner() {
        // A name begins with an identifier that is told as the name.
        if !(pair.as_rule() == Rule::name && inner.as_rule() == Rule::ident) {
            read_pair(&inner, pair, base, told);
        }
    }
}

fn is_leaf(pair: &Pair<'_, Rule>) -> bool {
    pair.clone().into_inner().next().is_none()
}

/// What a word is in a statement that cannot be read yet; `previous` is where the word before it
/// ends.
fn guessed(text: &str, range: &Range<usize>, previous: Option<usize>) -> Class {
    let word = &text[range.clone()];
    let before = text[..range.start].trim_end_matches([' ', '\t']);
    let behind = text[range.end..].trim_start_matches([' ', '\t']);
    let begins = before.is_empty() || before.ends_with(['\n', ';', '{', '}', ':']);
    if behind.starts_with('(') && Function::named(word).next().is_some() {
        return Class::Function;
    }
    if begins && catalogue::rule(word).is_some() {
        return Class::Command;
    }
    if begins && behind.starts_with(':') {
        return Class::NewName;
    }
    let said = previous.map(|end| &text[..end]).filter(|_| !begins);
    let verb = said.map_or("", |said| said.rsplit(|c| !is_word_char(c)).next().unwrap_or(""));
    let defines = |word: ConstraintWord| word.pattern().slots.contains(&Slot::Defined);
    let names_next = matches!(verb, "point" | "let" | "for" | "define" | "measure" | "result")
        || ConstraintWord::named(verb).is_some_and(defines);
    if names_next || (before.ends_with(',') && behind.starts_with('=')) {
        return Class::NewName;
    }
    if !begins && clause_words().contains(word) {
        return Class::Clause;
    }
    Class::Name
}

/// All words that the grammar knows as such.
pub(super) fn clause_words() -> &'static BTreeSet<String> {
    static WORDS: OnceLock<BTreeSet<String>> = OnceLock::new();
    WORDS.get_or_init(|| {
        let rules = Rule::all_rules().iter().map(|rule| format!("{rule:?}"));
        let words = rules.filter_map(|rule| rule.strip_prefix("kw_").map(str::to_owned));
        words.chain(Unit::ALL.iter().map(|unit| unit.suffix().to_owned())).collect()
    })
}

/// Words (as names), numbers, strings, comments and signs.
fn lexed(text: &str) -> Vec<Token> {
    let bytes = text.as_bytes();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let Some(first) = rest.chars().next() else { break };
        let is_range = at > 0 && bytes[at - 1] == b'.';
        let is_fraction =
            first == '.' && !is_range && bytes.get(at + 1).is_some_and(u8::is_ascii_digit);
        let (class, len) = match first {
            _ if first.is_whitespace() => {
                at += first.len_utf8();
                continue;
            }
            '#' => (Class::Comment, rest.find('\n').unwrap_or(rest.len())),
            '"' => (Class::Text, string_end(rest.as_bytes(), 0).unwrap_or_else(|end| end)),
            _ if first.is_ascii_digit() || is_fraction => (Class::Number, number_len(rest)),
            _ if is_word_char(first) => (Class::Name, name_len(rest)),
            _ => (Class::Sign, first.len_utf8()),
        };
        tokens.push(Token { range: at..at + len, class });
        at += len;
    }
    tokens
}

fn number_len(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_part = |at: usize| {
        let is_dot = bytes[at] == b'.'
            && bytes.get(at + 1).is_some_and(u8::is_ascii_digit)
            && !text[..at].contains('.');
        let is_sign =
            at > 0 && matches!(bytes[at], b'+' | b'-') && matches!(bytes[at - 1], b'e' | b'E');
        is_dot || is_sign || bytes[at].is_ascii_alphanumeric()
    };
    (0..text.len()).find(|&at| !is_part(at)).unwrap_or(text.len())
}

/// A name with its members and those of its indices that are plain numbers.
fn name_len(text: &str) -> usize {
    let mut len = text.find(|c| !is_word_char(c)).unwrap_or(text.len());
    loop {
        let rest = &text[len..];
        let member = rest.strip_prefix('.').map_or("", first_word);
        let index = rest.strip_prefix('[').and_then(|inside| inside.split_once(']'));
        match index.map(|(index, _)| index) {
            _ if !member.is_empty() => len += 1 + member.len(),
            Some(index) if index.bytes().all(|b| b.is_ascii_digit()) && !index.is_empty() => {
                len += index.len() + 2;
            }
            _ => return len,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each token with a letter for its class.
    fn shown(text: &str) -> String {
        let letter = |class| match class {
            Class::Command => 'C',
            Class::Clause => 'c',
            Class::Name => 'n',
            Class::NewName => 'N',
            Class::Function => 'f',
            Class::Number => '1',
            Class::Text => 't',
            Class::Comment => '#',
            Class::Sign => '.',
        };
        let tokens = tokens(text);
        let all =
            tokens.iter().map(|it| format!("{}{}", letter(it.class), &text[it.range.clone()]));
        all.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn statements_are_told_by_the_grammar() {
        let check = |text: &str, wanted: &str| assert_eq!(shown(text), wanted, "{text:?}");
        check("point at = (0, 1) frozen", "Cpoint Nat .= .( 10 ., 11 .) cfrozen");
        check("length at B = 3rev", "Clength nat nB .= 13rev");
        check("add bar: length A B", "Cadd Nbar .: Clength nA nB");
        check("motor A B speed sin(time)", "Cmotor nA nB cspeed fsin .( ntime .)");
        check("distance(A, B) in deg", "fdistance .( nA ., nB .) cin cdeg");
        check(
            "for i in 1..3 { p[i-1], p[2].x }",
            "Cfor Ni cin 11 .. .. 13 .{ np .[ ni .- 11 .] ., np[2].x .}",
        );
        check("set dead-points stop # now", "Cset cdead .- cpoints cstop ## now");
        check("print \"a # b\", 1e-9", "Cprint t\"a # b\" ., 11e-9");
        check("step; step 2", "Cstep .; Cstep 12");
    }

    #[test]
    fn statements_that_are_being_typed_are_told_by_their_words() {
        let check = |text: &str, wanted: &str| assert_eq!(shown(text), wanted, "{text:?}");
        check("motor A B speed", "Cmotor nA nB cspeed");
        check("crank: moto", "Ncrank .: nmoto");
        check("point A = (0, ", "Cpoint NA .= .( 10 .,");
        check("define d(A) {\n  length A B = ", "Cdefine Nd .( NA .) .{ Clength nA nB .=");
        check("print \"open", "Cprint t\"open");
        check("print \"open\\\nstep", "Cprint t\"open\\ Cstep");
    }

    #[test]
    fn what_was_read_before_is_told_as_what_is_read_first() {
        let texts = [
            "for i in 1..3 {\n  point p[i] = (i, 0)\n  leng",
            "for i in 1..3 {\n  point p[i] = (i, 0)\n  length p[i] B\n",
            "for i in 1..3 {\n  point p[i] = (i, 0)\n  length p[i] B\n}",
            "point p[i] = (i, 0); crank: motor A B",
            "crank: motor A B speed; motor A B",
        ];
        let mut kept = Tokens::default();
        for text in texts.iter().chain(texts.iter().rev()) {
            assert_eq!(kept.of(text), tokens(text), "{text:?}");
        }
    }

    #[test]
    fn any_text_has_pieces() {
        for text in [
            "\u{e9}(",
            "\"",
            "\"\\",
            "1..2",
            "..",
            "a.",
            "p[",
            "p[]",
            "{",
            "}}",
            "\\",
            "1e",
            "\u{1f600}",
        ] {
            let tokens = tokens(text);
            assert!(tokens.windows(2).all(|pair| pair[0].range.end <= pair[1].range.start));
            assert!(tokens.iter().all(|token| !text[token.range.clone()].is_empty()));
        }
    }
}
