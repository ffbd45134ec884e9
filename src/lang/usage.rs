//! The rest of a statement's shape: what of its usage is still to be typed.

use super::catalogue;
use super::lower::split_prefix;

/// A part of a usage.
#[derive(Debug, Clone, PartialEq)]
enum Part<'a> {
    /// A word or a mark that stands there as it is.
    Literal(&'a str),
    /// A word in capitals, which stands for something.
    Slot(&'a str),
    /// `[...]`: it may be left out.
    Optional(Vec<Part<'a>>),
    /// `a | b`
    Either(Vec<Vec<Part<'a>>>),
    /// `...`: more of the same.
    More,
}

/// What of its usage is still to be typed behind the beginning of a statement, as it would be
/// typed on; none where nothing is, or where what is typed does not fit.
///
/// ```
/// use linkwork::lang::rest_of_usage;
///
/// assert_eq!(rest_of_usage("glider P ").as_deref(), Some("on A B|CURVE [unbounded]"));
/// assert_eq!(rest_of_usage("length B C").as_deref(), Some(" [RELATION]"));
/// assert_eq!(rest_of_usage("solve within 1e-9 in 2ms"), None);
/// ```
pub fn rest_of_usage(statement: &str) -> Option<String> {
    let (_, statement) = split_prefix(statement.trim_start())?;
    let verb = statement.split(|c: char| !c.is_alphanumeric()).next()?;
    let is_being_typed = verb.len() == statement.len();
    let entry = catalogue::commands().find(|entry| entry.keyword == verb);
    if is_being_typed && entry.is_none() {
        return rest_of_word(verb);
    }
    let usage = entry?.usage;
    let parts = Usage(usage.strip_prefix(verb)?.trim_start()).parts();
    let words = words(&statement[verb.len()..]);
    let left = Typed { words: &words, at: 0 }.pass_all(&parts, &[])?;
    let text = written(&left);
    let is_apart = statement.ends_with([' ', '\t', '(']) || text.starts_with([',', '(', '.']);
    (!text.is_empty()).then(|| if is_apart { text } else { format!(" {text}") })
}

/// The rest of the only command that begins so, and of its usage.
fn rest_of_word(word: &str) -> Option<String> {
    let mut fitting = catalogue::commands().filter(|entry| entry.keyword.starts_with(word));
    match (fitting.next(), fitting.next()) {
        (Some(entry), None) if !word.is_empty() => Some(entry.usage[word.len()..].to_owned()),
        _ => None,
    }
}

/// What is left of a usage that is being read.
struct Usage<'a>(&'a str);

impl<'a> Usage<'a> {
    /// Its parts, up to the bracket that closes them.
    fn parts(&mut self) -> Vec<Part<'a>> {
        let mut parts: Vec<Part<'a>> = Vec::new();
        let mut others: Vec<Vec<Part<'a>>> = Vec::new();
        // Where the alternative begins that is being read.
        let mut first = 0;
        while let Some(word) = self.next() {
            match word {
                "[" => parts.push(Part::Optional(self.parts())),
                "]" => break,
                "|" => {
                    // An alternative begins at the last word that says what follows.
                    let is_word = |part: &Part| matches!(part, Part::Literal(word) if *word != "=");
                    if others.is_empty() {
                        first = parts.iter().rposition(is_word).unwrap_or(0);
                    }
                    others.push(parts.split_off(first));
                }
                "..." => parts.push(Part::More),
                _ if word.contains(|c: char| c.is_ascii_uppercase()) => {
                    parts.push(Part::Slot(word));
                }
                _ => parts.push(Part::Literal(word)),
            }
        }
        if !others.is_empty() {
            // What may be left out stands behind all of them.
            let last = parts.split_off(first);
            let n = last.iter().position(|part| matches!(part, Part::Optional(_)));
            let (last, behind) = last.split_at(n.filter(|&n| n > 0).unwrap_or(last.len()));
            others.push(last.to_vec());
            parts.push(Part::Either(others));
            parts.extend_from_slice(behind);
        }
        parts
    }

    fn next(&mut self) -> Option<&'a str> {
        let text = self.0.trim_start();
        let first = text.chars().next()?;
        let len = match first {
            _ if text.starts_with("...") => 3,
            _ if text.starts_with("..") => 2,
            '[' | ']' | ',' | '|' | '(' | ')' | '=' | '{' | '}' => 1,
            _ => {
                let ends = |c: char| " ,[]()=".contains(c) || c == '.';
                text.find(ends).unwrap_or(text.len())
            }
        };
        let (word, rest) = text.split_at(len);
        self.0 = rest;
        Some(word)
    }
}

/// The words and marks of a text; what stands between brackets or quotes is one with its word.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut depth = 0_usize;
    let mut is_quoted = false;
    let mut start = None;
    for (at, char) in text.char_indices() {
        let is_inside = is_quoted || depth > 0;
        match char {
            '"' => is_quoted = !is_quoted,
            '(' | '[' | '{' if !is_quoted => depth += 1,
            ')' | ']' | '}' if !is_quoted => depth = depth.saturating_sub(1),
            _ => {}
        }
        let is_mark = ",=<>".contains(char) && !is_inside;
        if !is_inside && (is_mark || char.is_whitespace()) {
            words.extend(start.take().map(|from: usize| &text[from..at]));
            if is_mark {
                words.push(&text[at..=at]);
            }
        } else {
            start.get_or_insert(at);
        }
    }
    words.extend(start.map(|from| &text[from..]));
    words
}

/// What is typed, and how far it was passed.
struct Typed<'a> {
    words: &'a [&'a str],
    at: usize,
}

impl<'a> Typed<'a> {
    fn peek(&self) -> Option<&'a str> {
        self.words.get(self.at).copied()
    }

    /// Passes what is typed of some parts, `ends` among the words that end them; gives those that
    /// are left, or none where what is typed does not fit.
    fn pass_all<'p>(&mut self, parts: &[Part<'p>], ends: &[&str]) -> Option<Vec<Part<'p>>> {
        let mut k = 0;
        while k < parts.len() {
            if self.peek().is_none() {
                return Some(parts[k..].to_vec());
            }
            let mut stops: Vec<&str> = first_words(&parts[k + 1..]);
            stops.extend(ends);
            match &parts[k] {
                Part::Literal(word) if self.peek() == Some(word) => self.at += 1,
                Part::Literal(_) => return None,
                Part::Slot(name) => self.pass_slot(name, &stops),
                Part::More => return Some(Vec::new()),
                Part::Either(alternatives) => {
                    let fits = |parts: &&Vec<Part>| match parts.first() {
                        Some(Part::Literal(word)) => self.peek() == Some(word),
                        _ => true,
                    };
                    let chosen = alternatives.iter().rev().find(fits)?;
                    let left = self.pass_all(chosen, &stops)?;
                    if !left.is_empty() {
                        return Some(left.into_iter().chain(parts[k + 1..].to_vec()).collect());
                    }
                }
                Part::Optional(_) => {
                    let is_optional = |part: &Part| matches!(part, Part::Optional(_));
                    let n = parts[k..].iter().take_while(|part| is_optional(part)).count();
                    let left = self.pass_options(&parts[k..k + n], &stops)?;
                    if !left.is_empty() || self.peek().is_none() {
                        return Some(left.into_iter().chain(parts[k + n..].to_vec()).collect());
                    }
                    k += n - 1;
                }
            }
            k += 1;
        }
        // More than the usage has is no beginning of it.
        (self.peek().is_none() || !ends.is_empty()).then(Vec::new)
    }

    /// Passes parts that may be left out, in any order; gives those that were not typed yet.
    fn pass_options<'p>(&mut self, options: &[Part<'p>], ends: &[&str]) -> Option<Vec<Part<'p>>> {
        let mut unused: Vec<&Part<'p>> = options.iter().collect();
        while let Some(word) = self.peek() {
            let fits = |option: &&Part| first_words(std::slice::from_ref(*option)).contains(&word);
            let is_open = |option: &&Part| matches!(option, Part::Optional(inside) if matches!(inside[0], Part::Slot(_)));
            let open = || unused.iter().position(is_open);
            let Some(k) = unused.iter().position(fits).or_else(open) else { break };
            let Part::Optional(inside) = unused.remove(k) else { break };
            let rest: Vec<Part> = unused.iter().map(|part| (*part).clone()).collect();
            let stops: Vec<&str> = first_words(&rest).into_iter().chain(ends.to_vec()).collect();
            // A word that ends it may follow.
            let stops = if stops.is_empty() { vec!["\n"] } else { stops };
            let left = self.pass_all(inside, &stops)?;
            if !left.is_empty() {
                return Some(left.into_iter().chain(rest).collect());
            }
        }
        let is_over = self.peek().is_none_or(|word| ends.contains(&word));
        is_over.then(|| unused.into_iter().cloned().collect())
    }

    /// Passes what stands for a slot: an operand with what is computed with it, several names, or
    /// a relation.
    fn pass_slot(&mut self, name: &str, stops: &[&str]) {
        let is_many = name.ends_with("NAMES") || name == "PART";
        if name == "RELATION" {
            while self.peek().is_some_and(|word| matches!(word, "=" | "<" | ">" | "in")) {
                self.at += 1;
            }
        }
        self.at += 1;
        while let Some(word) = self.peek() {
            let before = self.words[self.at - 1];
            let is_operator = |char: char| "+-*/^".contains(char);
            let is_computed = word.starts_with(is_operator) || before.ends_with(is_operator);
            let is_next = is_many && !stops.contains(&word);
            if !(is_computed || is_next) {
                return;
            }
            self.at += 1;
        }
    }
}

/// The words that the parts may begin with.
fn first_words<'a>(parts: &[Part<'a>]) -> Vec<&'a str> {
    let mut words = Vec::new();
    for part in parts {
        match part {
            Part::Literal(word) => {
                words.push(*word);
                return words;
            }
            Part::Optional(inside) => words.extend(first_words(inside)),
            Part::Either(alternatives) => {
                words.extend(alternatives.iter().flat_map(|parts| first_words(parts)));
                return words;
            }
            Part::Slot(_) | Part::More => return words,
        }
    }
    words
}

fn written(parts: &[Part]) -> String {
    let mut text = String::new();
    for part in parts {
        let piece = match part {
            Part::Literal(word) | Part::Slot(word) => (*word).to_owned(),
            Part::More => "...".to_owned(),
            Part::Optional(inside) => format!("[{}]", written(inside)),
            Part::Either(alternatives) => {
                let all: Vec<String> = alternatives.iter().map(|parts| written(parts)).collect();
                all.join(" | ")
            }
        };
        let is_range_open = text.ends_with("..") && !text.ends_with("...");
        let is_glued =
            matches!(&*piece, "," | ")" | ".." | "(") || text.ends_with('(') || is_range_open;
        if !text.is_empty() && !is_glued {
            text.push(' ');
        }
        text.push_str(&piece);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(statement: &str, wanted: &str) {
        assert_eq!(rest_of_usage(statement).as_deref().unwrap_or("-"), wanted, "{statement:?}");
    }

    #[test]
    fn the_rest_of_the_shape_is_what_is_not_typed_yet() {
        check("mot", "or O P [radius R] [speed W] [phase PHI] [from A B]");
        check("motor ", "O P [radius R] [speed W] [phase PHI] [from A B]");
        check("crank: motor A", " P [radius R] [speed W] [phase PHI] [from A B]");
        check("p[1] : add motor A", " P [radius R] [speed W] [phase PHI] [from A B]");
        check("motor A B ", "[radius R] [speed W] [phase PHI] [from A B]");
        check("motor A B speed 1rev ", "[radius R] [phase PHI] [from A B]");
        check("motor A B speed ", "W [radius R] [phase PHI] [from A B]");
        check("equal A B", ", C D [ratio R] [RELATION]");
        check("equal A B, ", "C D [ratio R] [RELATION]");
        check("equal A B, C D ratio 2 ", "[RELATION]");
        check("cog O A, P B ", "ratio R | teeth N1, N2 [inside]");
        check("cog O A, P B teeth 20", ", N2 [inside]");
        check("circle c = O ", "radius R | through P");
        check("circle c = O through ", "P");
        check("drag A to (1, 2) + B ", "[over FRAMES]");
        check("move A ", "to POSITION");
        check("freeze ", "NAMES | all");
        check(
            "record \"a.svg\" ",
            "[of VALUE [in UNIT], ...] [every FRAMES] [width PX] [dark] [transparent] [without names] [title TEXT]",
        );
        check("for i in 1", "..TO { ... }");
        check("length B C = 3.5", "-");
        check("step 360 ", "[within TOLERANCE] [in WALL_TIME]");
        check("step within 1e-9 ", "[FRAMES] [in WALL_TIME]");
        check("reset", "-");
        check("delete A B ", "[cascade]");
        check("glider P at", "-");
        check("nonsense A B", "-");
        check("", "-");
    }
}
