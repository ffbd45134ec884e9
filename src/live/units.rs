//! Places in texts as a page counts them: in UTF-16 units, not in bytes.

/// How many units there are before the byte `at`, or before the letter that it is in.
pub fn to_utf16(text: &str, at: usize) -> usize {
    let before = text.char_indices().take_while(|(start, letter)| start + letter.len_utf8() <= at);
    before.map(|(_, letter)| letter.len_utf16()).sum()
}

/// The byte where so many units end; that of the letter whose half they would be.
pub fn from_utf16(text: &str, units: usize) -> usize {
    let mut n = 0;
    for (at, letter) in text.char_indices() {
        n += letter.len_utf16();
        if n > units {
            return at;
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_bytes_are_places_of_letters() {
        // One, two, three and four bytes; one unit each, but for the last, which has two.
        let text = "aä€😀b";
        let (bytes, units) = ([0, 1, 3, 6, 10, 11], [0, 1, 2, 3, 5, 6]);
        for (byte, unit) in bytes.into_iter().zip(units) {
            assert_eq!(to_utf16(text, byte), unit);
            assert_eq!(from_utf16(text, unit), byte);
        }
        assert_eq!((to_utf16(text, 99), from_utf16(text, 99)), (6, 11));
        assert_eq!((to_utf16(text, 8), from_utf16(text, 4)), (3, 6));
    }
}
