//! The nearest of many names: what a misspelt word was probably meant to be.

use super::Diagnostic;

/// The candidate nearest to `word`, if one is near enough to be worth suggesting.
///
/// Nearness is the optimal string alignment distance (insert, delete, replace, swap of
/// neighbours) with letters of either case taken as equal. A candidate may differ in one
/// place for every three characters of the longer word, and at least in one. Of equally
/// near ones that is taken of which only letters were left out, then the first; one that differs in
/// case alone before all.
///
/// ```
/// use linkwork::diag::nearest;
///
/// assert_eq!(nearest("lenght", ["list", "length"]), Some("length"));
/// assert_eq!(nearest("lst", ["let", "list"]), Some("list"));
/// assert_eq!(nearest("banana", ["list", "length"]), None);
/// ```
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    Likeness::to(word)?.nearest(candidates)
}

/// What other words are like a word.
#[derive(Debug)]
pub struct Likeness {
    /// The word, small.
    word: Vec<char>,
    letters: u64,
}

impl Likeness {
    /// Likeness to a word; none if nothing is like it, as it is so long.
    pub fn to(word: &str) -> Option<Self> {
        let word = fold(word);
        let letters = letters(word.iter().map(|&char| u32::from(char)));
        (word.len() <= LONGEST).then_some(Self { word, letters })
    }

    /// In how many places a word of that length may differ.
    fn limit(&self, length: usize) -> usize {
        (self.word.len().max(length) / 3).max(1)
    }

    /// Whether a candidate may be near: a quick look that rules most words out.
    pub fn may_be(&self, candidate: &str) -> bool {
        if !candidate.is_ascii() {
            return true;
        }
        let limit = self.limit(candidate.len());
        if self.word.len().abs_diff(candidate.len()) > limit || candidate.len() > LONGEST {
            return false;
        }
        let small = candidate.bytes().map(|byte| u32::from(byte.to_ascii_lowercase()));
        let letters = letters(small);
        // Each letter that one has and the other has not is a place in which they differ.
        let n_here = (self.letters & !letters).count_ones();
        let n_there = (letters & !self.letters).count_ones();
        n_here.max(n_there) as usize <= limit
    }

    fn nearest<'a>(&self, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
        let mut best: Option<((usize, bool), &str)> = None;
        for candidate in candidates.into_iter().filter(|candidate| self.may_be(candidate)) {
            let folded = fold(candidate);
            let limit = self.limit(folded.len());
            if self.word.len().abs_diff(folded.len()) > limit || folded.len() > LONGEST {
                continue;
            }
            let distance = distance(&self.word, &folded);
            // A one-letter word is one replacement from every other: that is no likeness.
            let alike = distance <= limit && distance < self.word.len().max(folded.len());
            let rank = (distance, !is_within(&self.word, &folded));
            if alike && best.is_none_or(|(least, _)| rank < least) {
                best = Some((rank, candidate));
            }
        }
        best.map(|(_, candidate)| candidate)
    }
}

/// The letters of a word as bits; some share one.
fn letters(word: impl Iterator<Item = u32>) -> u64 {
    word.fold(0, |bits, letter| bits | 1 << (letter % 64))
}

/// A problem with the candidate nearest to `word` as help, if one is near enough.
pub fn suggest<'a>(
    problem: Diagnostic,
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    match nearest(word, candidates) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem,
    }
}

/// Longer words are not compared: the time grows with the square of the length.
const LONGEST: usize = 64;

fn fold(word: &str) -> Vec<char> {
    // One more than the longest is enough to know that it is too long.
    word.chars().flat_map(char::to_lowercase).take(LONGEST + 1).collect()
}

/// Whether all letters of the one are in the other, in their order.
fn is_within(few: &[char], many: &[char]) -> bool {
    let mut many = many.iter();
    few.iter().all(|c| many.any(|d| c == d))
}

fn distance(a: &[char], b: &[char]) -> usize {
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_only_what_is_near() {
        let words = ["length", "list", "let", "step", "A", "coupler"];
        let check = |word: &str, wanted: Option<&str>| {
            assert_eq!(nearest(word, words), wanted, "for {word:?}");
        };
        check("lenght", Some("length"));
        check("LENGTH", Some("length"));
        check("lst", Some("list"));
        check("setp", Some("step"));
        check("a", Some("A"));
        check("B", None);
        check("cuopler", Some("coupler"));
        check("", None);
        check("rhubarb", None);
        check(&"x".repeat(100_000), None);
    }

    #[test]
    fn a_quick_look_rules_out_nothing_that_is_near() {
        // All words of up to four of these letters, each with each.
        let mut words = vec![String::new()];
        for k in 0..4 {
            let longest: Vec<String> = words.iter().filter(|w| w.len() == k).cloned().collect();
            words.extend(longest.iter().flat_map(|w| ["a", "B", "7"].map(|l| format!("{w}{l}"))));
        }
        for word in &words {
            let likeness = Likeness::to(word).unwrap();
            for other in &words {
                let (small, other_small) = (fold(word), fold(other));
                let is_near = distance(&small, &other_small) <= likeness.limit(other.len());
                assert!(!is_near || likeness.may_be(other), "{word:?} and {other:?}");
            }
        }
    }

    #[test]
    fn equal_but_for_case_comes_first() {
        assert_eq!(nearest("ab", ["aB2", "ac", "AB"]), Some("AB"));
    }
}
