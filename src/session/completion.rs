//! What helps who types a line: what may stand where the cursor is, what is still to be typed, and
//! what the pieces of the line are.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

use super::Session;
use super::commands::setting_table::{SETTINGS, Setting};
use super::examples::EXAMPLES;
use crate::lang::ast::{Function, ListWhat, Unit};
use crate::lang::{
    Class, NameOf, Next, Token, Tokens, catalogue, next, rest_of_usage, statement_start,
};
use crate::terms::{Member, Statistic};
use crate::world::{Entity, World};

/// Names kept; more than this are no help, and are not looked through.
const MOST_NAMES: usize = 10_000;

/// What has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Point,
    Guide,
    Driver,
    Constraint,
    Parameter,
    Measure,
    Instance,
    /// Of a constraint or a measure: it may be looked at, and is offered once the dot is there.
    Member,
}

/// What can be offered: the words of the language, and the names of a session.
#[derive(Debug, Clone, Default)]
pub struct Completion {
    names: BTreeMap<String, Kind>,
    /// Each with its parameters.
    definitions: BTreeMap<String, String>,
    /// Whether all names there are were taken in.
    is_whole: bool,
    /// The world's revision at which it had these names.
    revision: Option<u64>,
    /// The text that was told last.
    tokens: RefCell<Tokens>,
}

/// What may stand where the cursor is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Offer {
    /// Where the word begins that is being typed.
    pub start: usize,
    /// What it may become, in order.
    pub candidates: Vec<Candidate>,
    /// Whether a path is being typed: who has files can say which there are.
    pub is_path: bool,
}

/// What a word may become.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    /// The word.
    pub text: String,
    /// The same with what is to follow, to be looked at.
    pub shown: String,
}

/// What a piece of a line is, as it is shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// Its bytes.
    pub range: Range<usize>,
    /// What it is.
    pub class: Class,
    /// Whether it is a name that nothing has.
    pub is_unknown: bool,
}

impl Completion {
    /// Takes in what there is now.
    pub fn refresh(&mut self, session: &Session) {
        let world = session.world();
        self.definitions = session.definitions().collect();
        if self.revision == Some(world.revision()) {
            return;
        }
        self.revision = Some(world.revision());
        self.names.clear();
        let all = world.names();
        self.is_whole = all.iter().nth(MOST_NAMES).is_none();
        for (name, entity) in all.iter().take(MOST_NAMES) {
            self.names.insert(name.to_owned(), kind(world, entity));
            let words = member_words(world, entity).into_iter();
            self.names.extend(words.map(|word| (format!("{name}.{word}"), Kind::Member)));
        }
        let instances = all.instances().take(MOST_NAMES);
        self.names.extend(instances.map(|name| (name.to_owned(), Kind::Instance)));
    }

    /// What may stand at the end of `before`.
    pub fn offer(&self, before: &str) -> Offer {
        let start = word_start(before);
        let statement = &before[statement_start(before).min(start)..start];
        if let Some(quote) = open_quote(before) {
            let statement = &before[statement_start(before).min(quote)..quote];
            let is_path = next(statement).contains(&Next::Path);
            return Offer { start: quote + 1, candidates: Vec::new(), is_path };
        }
        let word = &before[start..];
        let mut candidates: Vec<Candidate> = Vec::new();
        for next in next(statement) {
            self.add(&next, word, &mut candidates);
        }
        candidates.retain(|candidate| candidate.text.starts_with(word));
        candidates.sort_unstable();
        candidates.dedup();
        Offer { start, candidates, is_path: false }
    }

    /// What is still to be typed of the statement that `before` ends in.
    pub fn hint(&self, before: &str) -> Option<String> {
        let statement = &before[statement_start(before)..];
        if open_quote(before).is_some() || statement.contains('#') {
            return None;
        }
        self.rest_of_use(statement).or_else(|| rest_of_usage(statement))
    }

    /// The parameters of the definition that a `use` names.
    fn rest_of_use(&self, statement: &str) -> Option<String> {
        let name = statement.strip_prefix("use ")?.trim_start().strip_suffix('(')?;
        self.definitions.get(name).map(|parameters| format!("{parameters}) [as NAME]"))
    }

    /// The pieces of a text, those marked that are names of nothing. A word that ends at `cursor`
    /// is still being typed.
    pub fn pieces(&self, text: &str, cursor: usize) -> Vec<Piece> {
        let tokens = self.tokens.borrow_mut().of(text);
        let of_class = |class| tokens.iter().filter(move |token: &&Token| token.class == class);
        let new: Vec<&str> = of_class(Class::NewName).map(|it| &text[it.range.clone()]).collect();
        let is_unknown = |token: &Token| {
            token.class == Class::Name
                && token.range.end != cursor
                && self.is_whole
                && !text[token.range.end..].starts_with('[')
                && !self.is_known(&text[token.range.clone()], &new)
        };
        tokens
            .iter()
            .map(|token| Piece {
                range: token.range.clone(),
                class: token.class,
                is_unknown: is_unknown(token),
            })
            .collect()
    }

    /// Whether something has this name, or the thing whose part it is.
    fn is_known(&self, name: &str, new: &[&str]) -> bool {
        let is_reserved = matches!(name, "pi" | "tau" | "time" | "all");
        let is_named = |name: &str| {
            self.names.contains_key(name)
                || self.definitions.contains_key(name)
                || new.contains(&name)
                || new
                    .iter()
                    .any(|new| name.strip_prefix(new).is_some_and(|it| it.starts_with('[')))
        };
        is_reserved
            || is_named(name)
            || name
                .rmatch_indices('.')
                .any(|(dot, _)| is_named(&name[..dot]) && self.may_end_so(name, dot))
    }

    /// Whether what stands behind a dot may be a part of what stands before it.
    fn may_end_so(&self, name: &str, dot: usize) -> bool {
        let is_axis = matches!(&name[dot..], ".x" | ".y");
        let owner = self.names.get(&name[..dot]);
        match owner {
            Some(Kind::Point) => is_axis,
            Some(
                Kind::Instance | Kind::Constraint | Kind::Guide | Kind::Driver | Kind::Measure,
            ) => false,
            _ => true,
        }
    }

    fn add(&self, next: &Next, word: &str, found: &mut Vec<Candidate>) {
        let words = |found: &mut Vec<Candidate>, words: &mut dyn Iterator<Item = &str>| {
            found.extend(
                words.map(|word| Candidate { text: word.to_owned(), shown: word.to_owned() }),
            );
        };
        let keyword = |word: &str| Candidate { text: format!("{word} "), shown: word.to_owned() };
        let commands = || catalogue::commands().map(|entry| entry.keyword);
        match next {
            Next::Command => {
                found.extend(commands().chain(["add"]).map(keyword));
                if !word.is_empty() {
                    self.add(&Next::Value, word, found);
                }
            }
            Next::Word(word) => found.push(keyword(word)),
            Next::Setting => words(found, &mut Setting::names()),
            Next::ValueOf(name) => match Setting::named(name).map(|setting| (setting.words)()) {
                Some(values) if !values.is_empty() => words(found, &mut values.into_iter()),
                _ => self.add(&Next::Value, word, found),
            },
            Next::Unit => words(found, &mut Unit::ALL.iter().map(|unit| unit.suffix())),
            Next::List => words(found, &mut ListWhat::ALL.iter().map(|what| what.word())),
            Next::Topic => {
                let topics = catalogue::topics().map(|entry| entry.keyword);
                let functions = Function::ALL.iter().map(|function| function.name());
                let settings = SETTINGS.iter().map(|setting| setting.name);
                words(found, &mut commands().chain(topics).chain(functions).chain(settings));
            }
            Next::Example => words(found, &mut EXAMPLES.iter().map(|example| example.name)),
            Next::Path => {}
            Next::Value => {
                let functions = Function::ALL.iter().map(|function| Candidate {
                    text: format!("{}(", function.name()),
                    shown: function.usage().to_owned(),
                });
                found.extend(functions);
                let constants = ["pi", "tau", "time"].into_iter();
                let is_value = |kind: Kind| match kind {
                    Kind::Point | Kind::Parameter => true,
                    Kind::Member => word.contains('.'),
                    // The beginning of a member's name.
                    _ => !word.is_empty(),
                };
                found.extend(self.named(is_value));
                found.extend(
                    constants.map(|it| Candidate { text: it.to_owned(), shown: it.to_owned() }),
                );
            }
            Next::Name(NameOf::Definition) => {
                found.extend(self.definitions.iter().map(|(name, parameters)| Candidate {
                    text: format!("{name}("),
                    shown: format!("{name}({parameters})"),
                }));
            }
            Next::Name(of) => found.extend(self.named(|kind| match of {
                NameOf::Point => matches!(kind, Kind::Point),
                NameOf::PointOrCurve => matches!(kind, Kind::Point | Kind::Guide),
                NameOf::Constraint => matches!(kind, Kind::Constraint | Kind::Guide | Kind::Driver),
                NameOf::Driver => matches!(kind, Kind::Driver | Kind::Parameter),
                NameOf::Parameter => matches!(kind, Kind::Parameter),
                NameOf::Definition => false,
                NameOf::Anything => kind != Kind::Member,
            })),
        }
    }

    fn named(&self, is_wanted: impl Fn(Kind) -> bool) -> impl Iterator<Item = Candidate> {
        let wanted = self.names.iter().filter(move |(_, kind)| is_wanted(**kind));
        wanted.map(|(name, _)| Candidate { text: name.clone(), shown: name.clone() })
    }
}

fn kind(world: &World, entity: Entity) -> Kind {
    match entity {
        Entity::Point(_) => Kind::Point,
        Entity::Parameter(_) => Kind::Parameter,
        Entity::Measure(_) => Kind::Measure,
        Entity::Constraint(id) if world.has_member(id, Member::Radius) => Kind::Guide,
        Entity::Constraint(id)
            if world.has_member(id, Member::Angle) || world.has_member(id, Member::Value) =>
        {
            Kind::Driver
        }
        Entity::Constraint(_) => Kind::Constraint,
    }
}

/// The words of the members of a thing.
fn member_words(world: &World, of: Entity) -> Vec<&'static str> {
    match of {
        Entity::Constraint(id) => {
            let members = Member::ALL.into_iter().filter(|&member| world.has_member(id, member));
            members.map(Member::word).collect()
        }
        Entity::Measure(_) => Statistic::ALL.map(Statistic::word).to_vec(),
        Entity::Point(_) | Entity::Parameter(_) => Vec::new(),
    }
}

/// Where the string begins that is not closed at the end of a text's last line.
fn open_quote(text: &str) -> Option<usize> {
    let line = text.rfind('\n').map_or(0, |at| at + 1);
    let mut quote = None;
    let mut is_escaped = false;
    for (at, char) in text[line..].char_indices() {
        match char {
            '"' if !is_escaped => quote = if quote.is_some() { None } else { Some(line + at) },
            '#' if quote.is_none() => return None,
            _ => {}
        }
        is_escaped = char == '\\' && !is_escaped;
    }
    quote
}

/// Where the word begins that is being typed: a name with its indices and members, or a word of
/// those that have hyphens.
fn word_start(before: &str) -> usize {
    let statement = &before[statement_start(before)..];
    let has_hyphens = ["set ", "help ", "examples "].iter().any(|verb| statement.starts_with(verb));
    let ends_word =
        |c: char| !(c.is_alphanumeric() || "_'.[]".contains(c) || (has_hyphens && c == '-'));
    let char_len = |at: usize| before[at..].chars().next().map_or(1, char::len_utf8);
    before.rfind(ends_word).map_or(0, |at| at + char_len(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn completion() -> Completion {
        let mut session = Session::new();
        let script = "point A = (0, 0) frozen, B = (1, 0), p[1] = (0, 1), p[10] = (5, 5)
            let cr = 3
            crank: motor A B
            coupler: coincidence p[1] p[1] ";
        let script = script.replace("coincidence p[1] p[1]", "horizontal A p[10]");
        session.run(&script).expect("a script");
        session
            .run("circle c = A radius 2; define pair(A, d) { point P = A + (d, 0) }")
            .expect("more");
        session.run("use pair(B, 2) as left").expect("an instance");
        let mut completion = Completion::default();
        completion.refresh(&session);
        completion
    }

    fn texts(before: &str) -> (usize, Vec<String>) {
        let offer = completion().offer(before);
        (
            offer.start,
            offer.candidates.into_iter().map(|it| it.text.trim_end().to_owned()).collect(),
        )
    }

    #[test]
    fn what_fits_the_place_is_offered() {
        let check = |before: &str, start: usize, wanted: &[&str]| {
            let (at, found) = texts(before);
            let wanted: Vec<String> = wanted.iter().map(ToString::to_string).collect();
            assert_eq!((at, found), (start, wanted), "{before:?}");
        };
        check("len", 0, &["length"]);
        check("  dr", 2, &["drag"]);
        check("step 3; und", 8, &["undo"]);
        check("bar: mot", 5, &["motor"]);
        check("for i in 1..3 { mot", 16, &["motor"]);
        check("freeze c", 7, &[]);
        check("off c", 4, &["c", "coupler", "crank"]);
        check("limits c", 7, &["cr", "crank"]);
        check("glider B on c", 12, &["c"]);
        check("show co", 5, &["coupler"]);
        check("show coupler.", 5, &[]);
        check("print crank.a", 6, &["crank.angle"]);
        check("crank.angle in r", 15, &["rad", "rev", "rpm"]);
        check("motor A B s", 10, &["speed"]);
        check("motor A B speed 1 ra", 18, &["radius"]);
        check("point Q = (0, 0) f", 17, &["frozen"]);
        check("length A p[1", 9, &["p[10]", "p[1]"]);
        check("length A B = cr", 13, &["cr", "crank", "cross("]);
        check("delete le", 7, &["left", "left.P"]);
        check("set dead", 4, &["dead-points"]);
        check("set dead-points ", 16, &["hold", "reverse", "stop"]);
        check("set method con", 11, &["conjugate"]);
        check("list p", 5, &["parameters", "points"]);
        check("help expr", 5, &["expressions"]);
        check("examples four", 9, &["four-bar"]);
        check("use p", 4, &["pair("]);
        check("print (A - cr", 11, &["cr", "crank", "cross("]);
        check("step 3 wi", 7, &["within"]);
        check("motor )", 7, &[]);
    }

    #[test]
    fn a_definition_is_offered_with_its_arguments() {
        let offer = completion().offer("use ");
        assert_eq!(offer.candidates[0].shown, "pair(A, d)");
        assert_eq!(completion().hint("use pair(").as_deref(), Some("A, d) [as NAME]"));
    }

    #[test]
    fn a_path_is_a_matter_of_who_has_files() {
        assert!(completion().offer("svg \"no").is_path);
        assert_eq!(completion().offer("step; include \"sc").start, 15);
        assert!(!completion().offer("print \"no").is_path);
    }

    #[test]
    fn names_of_nothing_are_marked_once_they_are_typed() {
        let check = |text: &str, wanted: &[&str]| {
            let pieces = completion().pieces(text, text.len());
            let unknown = pieces.into_iter().filter(|piece| piece.is_unknown);
            let unknown: Vec<&str> = unknown.map(|piece| &text[piece.range]).collect();
            assert_eq!(unknown, wanted, "{text:?}");
        };
        check("length A B", &[]);
        check("length A X = 3", &["X"]);
        check("length A X", &[]);
        check("A.x, A.z, 1", &["A.z"]);
        check("left.P, left.Q, 1", &["left.Q"]);
        check("crank.angle, crank.speed, 1", &["crank.speed"]);
        check("point Q = A; length Q B = cr", &[]);
        check("for i in 1..2 { point q[i] = (i, 0) }; print q[2].x, time", &[]);
        check("lenght A B = 3", &["lenght"]);
        check("p[10], p[2], 1", &["p[2]"]);
    }
}
