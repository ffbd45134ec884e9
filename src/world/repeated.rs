//! A list that is mostly the same from one command to the next, and is then kept once.

use std::ops::Deref;
use std::sync::Arc;

/// A list that shares what is in it with the one it was begun beside, for as long as it is the same.
#[derive(Debug, Clone)]
pub(crate) struct Repeated<T> {
    items: Arc<Vec<T>>,
    /// How many of these are in it.
    n: usize,
    /// Whether they are its own.
    is_own: bool,
}

impl<T> Default for Repeated<T> {
    fn default() -> Self {
        Self { items: Arc::default(), n: 0, is_own: false }
    }
}

impl<T: Copy + PartialEq> Repeated<T> {
    /// An empty list that is likely to become the same as another one.
    pub fn beside(other: &Self) -> Self {
        Self { items: other.items.clone(), n: 0, is_own: false }
    }

    /// Appends an item.
    #[inline]
    pub fn push(&mut self, item: T) {
        if !self.is_own && self.items.get(self.n) == Some(&item) {
            self.n += 1;
        } else {
            self.own().push(item);
            self.n += 1;
        }
    }

    /// Takes an item out; the last one takes its place.
    pub fn swap_remove(&mut self, at: usize) -> T {
        self.n -= 1;
        self.own_of(self.n + 1).swap_remove(at)
    }

    /// Gives room back.
    pub fn shrink_to_fit(&mut self) {
        if self.is_own {
            self.own().shrink_to_fit();
        }
    }

    /// Roughly the bytes that it alone keeps.
    pub fn n_bytes(&self) -> usize {
        if self.is_own { size_of_val(&**self) } else { 0 }
    }

    fn own(&mut self) -> &mut Vec<T> {
        self.own_of(self.n)
    }

    /// The items, the first `n` of which are its own from here on.
    fn own_of(&mut self, n: usize) -> &mut Vec<T> {
        if !std::mem::replace(&mut self.is_own, true) {
            self.items = Arc::new(self.items[..n].to_vec());
        }
        Arc::make_mut(&mut self.items)
    }
}

impl<T> Deref for Repeated<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.items[..self.n]
    }
}

#[cfg(test)]
mod tests {
    use super::Repeated;

    fn beside(other: &Repeated<u32>, items: &[u32]) -> Repeated<u32> {
        let mut list = Repeated::beside(other);
        items.iter().for_each(|item| list.push(*item));
        assert_eq!(*list, *items);
        list
    }

    #[test]
    fn what_is_the_same_is_kept_once() {
        let first = beside(&Repeated::default(), &[1, 2, 3]);
        assert_eq!(first.n_bytes(), 12);
        for (items, n_bytes) in [
            (&[1, 2, 3][..], 0),
            (&[1, 2], 0),
            (&[], 0),
            (&[1, 2, 4], 12),
            (&[2], 4),
            (&[1, 2, 3, 4], 16),
        ] {
            assert_eq!(beside(&first, items).n_bytes(), n_bytes, "{items:?}");
        }
        assert_eq!(*first, [1, 2, 3]);
    }

    #[test]
    fn what_is_taken_out_is_there_in_the_other() {
        let first = beside(&Repeated::default(), &[1, 2, 3]);
        let mut list = beside(&first, &[1, 2]);
        assert_eq!(list.swap_remove(0), 1);
        assert_eq!((&*list, &*first), (&[2][..], &[1, 2, 3][..]));
    }
}
