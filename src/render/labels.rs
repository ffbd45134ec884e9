//! What labels of drawings and of charts have in common: how wide they are, the area they
//! take, and which of the places that were tried is best.

use std::f64::consts::TAU;

use crate::constraint::{Point, Vector};

/// Directions in which a label may stand from what it names.
const N_DIRECTIONS: u32 = 16;

/// Costs that differ by less are equal, and the place that was tried first is taken.
const EQUAL: f64 = 1e-9;

/// The width of a letter in sizes of letters, a generous average.
const LETTER: f64 = 0.58;

/// How much wider bold letters are than others.
pub const BOLD: f64 = 1.1;

/// A rectangle of the page, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// Its upper left corner.
    pub lo: Point,
    /// Its lower right corner.
    pub hi: Point,
}

impl Area {
    /// The area that reaches this far from its middle on both sides.
    pub fn around(middle: Point, half: Vector) -> Self {
        Self { lo: middle - half, hi: middle + half }
    }

    /// Its middle.
    pub fn middle(&self) -> Point {
        Point::new(0.5 * (self.lo.x + self.hi.x), 0.5 * (self.lo.y + self.hi.y))
    }

    /// Whether it comes closer than `gap` to another.
    pub fn meets(&self, other: &Self, gap: f64) -> bool {
        self.lo.x < other.hi.x + gap
            && other.lo.x < self.hi.x + gap
            && self.lo.y < other.hi.y + gap
            && other.lo.y < self.hi.y + gap
    }

    /// Whether a place lies in it, or no farther than `gap` outside.
    pub fn holds(&self, place: Point, gap: f64) -> bool {
        (self.lo.x - gap..=self.hi.x + gap).contains(&place.x)
            && (self.lo.y - gap..=self.hi.y + gap).contains(&place.y)
    }

    /// The place in it that is nearest to another.
    pub fn nearest(&self, place: Point) -> Point {
        Point::new(place.x.clamp(self.lo.x, self.hi.x), place.y.clamp(self.lo.y, self.hi.y))
    }
}

/// The angle of a direction by its number, radians, from 0 on in equal steps.
pub fn direction(number: f64) -> f64 {
    number * TAU / f64::from(N_DIRECTIONS)
}

/// The numbers of all directions.
pub fn directions() -> std::ops::Range<u32> {
    0..N_DIRECTIONS
}

/// The candidate that costs least, with what it costs; of equals the first.
pub fn cheapest<T>(candidates: impl IntoIterator<Item = (f64, T)>) -> Option<(f64, T)> {
    let mut best: Option<(f64, T)> = None;
    for (cost, candidate) in candidates {
        if best.as_ref().is_none_or(|(least, _)| cost < *least - EQUAL) {
            best = Some((cost, candidate));
        }
    }
    best
}

/// About how wide a text is, in sizes of its letters: the widths of Helvetica, rounded up.
///
/// Drawings crowd their names around joints, where a few px decide.
pub fn text_width(text: &str) -> f64 {
    text.chars()
        .map(|c| match c {
            'i' | 'j' | 'l' | '\'' | '.' | '[' | ']' | 'I' | 'f' | 't' | 'r' => 0.34,
            'm' | 'w' | 'M' | 'W' => 0.92,
            'A'..='Z' => 0.72,
            _ => 0.57,
        })
        .sum()
}

/// A text in lines no wider than this many sizes of its letters, broken between words; a word that is
/// wider ends in dots.
pub fn wrapped(text: &str, most: f64) -> Vec<String> {
    let space = text_width(" ");
    let mut lines: Vec<String> = Vec::new();
    let mut width = 0.0;
    for word in text.split_whitespace() {
        let word = shortened(word, most);
        let more = text_width(&word);
        match lines.last_mut() {
            Some(line) if width + space + more <= most => {
                line.push(' ');
                line.push_str(&word);
                width += space + more;
            }
            _ => {
                lines.push(word);
                width = more;
            }
        }
    }
    lines
}

/// As much of a word as is no wider than this, with dots where something is left out.
fn shortened(word: &str, most: f64) -> String {
    const DOTS: &str = "\u{2026}";
    if text_width(word) <= most {
        return word.to_owned();
    }
    let mut room = most - text_width(DOTS);
    let fits = |c: &char| {
        room -= text_width(c.encode_utf8(&mut [0; 4]));
        room >= 0.0
    };
    word.chars().take_while(fits).chain(DOTS.chars()).collect()
}

/// How wide a text of letters of this size is, px, all letters taken to be alike.
///
/// Charts write numbers, whose digits are, and stand where they always stood: with the widths
/// letter by letter the labels of every chart would move by some px.
pub fn even_width(text: &str, size: f64) -> f64 {
    LETTER * size * text.chars().count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equals_is_taken() {
        assert_eq!(cheapest([(3.0, 'a'), (1.0, 'b'), (1.0 - 1e-12, 'c')]), Some((1.0, 'b')));
        assert_eq!(cheapest::<char>([]), None);
    }

    #[test]
    fn texts_are_broken_between_words() {
        assert_eq!(wrapped("a four-bar", 20.0), ["a four-bar"]);
        assert_eq!(wrapped("one  two three", 5.0), ["one two", "three"]);
        assert_eq!(wrapped("abcdefghij", 3.0), ["abcd\u{2026}"]);
        assert!(wrapped("  ", 9.0).is_empty());
        for most in [1.0, 3.0, 10.0] {
            let lines = wrapped("the Quick brown fox jumps over iiiiiiiiiii WWWWWWWW", most);
            assert!(lines.iter().all(|line| text_width(line) <= most), "{lines:?}");
        }
    }

    #[test]
    fn areas_know_what_they_touch() {
        let area = Area::around(Point::new(10.0, 5.0), Vector::new(4.0, 2.0));
        assert!(area.holds(Point::new(14.0, 7.0), 0.0) && !area.holds(Point::new(15.0, 5.0), 0.5));
        assert!(area.meets(&Area::around(Point::new(19.0, 5.0), Vector::new(4.0, 2.0)), 1.5));
        assert_eq!(area.nearest(Point::new(0.0, 6.0)), Point::new(6.0, 6.0));
    }
}
