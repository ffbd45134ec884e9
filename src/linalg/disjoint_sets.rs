//! Which things hang together, when told pair by pair.

/// A forest of disjoint sets of indices, each known by its least member.
///
/// ```
/// use linkwork::linalg::DisjointSets;
///
/// let mut sets = DisjointSets::default();
/// sets.join(5, 3);
/// sets.join(7, 5);
/// assert_eq!([3, 5, 7, 4].map(|k| sets.least(k)), [3, 3, 3, 4]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct DisjointSets {
    /// A member of the same set that is no greater; the member itself for the least.
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Makes one set of those of `a` and `b`. The least member stands for all, whatever the
    /// order of telling.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.least(a), self.least(b));
        self.parent[a.max(b)] = a.min(b) as u32;
    }

    /// The least member of the set of `member`, which is on its own as long as it was not named.
    pub fn least(&mut self, member: usize) -> usize {
        let n = self.parent.len() as u32;
        self.parent.extend(n..=member as u32);
        let mut root = member;
        while self.parent[root] as usize != root {
            self.parent[root] = self.parent[self.parent[root] as usize];
            root = self.parent[root] as usize;
        }
        root
    }
}
