//! Numbers as the words that tell them apart to the bit.

/// Hands on the bits of numbers.
pub(crate) fn add_all(numbers: impl IntoIterator<Item = f64>, word: &mut impl FnMut(u64)) {
    numbers.into_iter().for_each(|number| word(number.to_bits()));
}
