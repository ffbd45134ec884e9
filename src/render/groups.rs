//! Which things belong together, when told pair by pair.

/// A disjoint-set forest over indices that appear as they are named.
#[derive(Debug, Clone, Default)]
pub struct Groups {
    parent: Vec<usize>,
}

impl Groups {
    /// Says that `a` and `b` belong together.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        // The least member stands for its group, whatever the order of telling.
        self.parent[a.max(b)] = a.min(b);
    }

    /// The least member of the group of `member`.
    pub fn of(&mut self, member: usize) -> usize {
        while self.parent.len() <= member {
            self.parent.push(self.parent.len());
        }
        let mut root = member;
        while self.parent[root] != root {
            self.parent[root] = self.parent[self.parent[root]];
            root = self.parent[root];
        }
        root
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_stands_for_all() {
        let mut groups = Groups::default();
        groups.join(5, 3);
        groups.join(7, 5);
        assert_eq!([3, 5, 7, 4].map(|k| groups.of(k)), [3, 3, 3, 4]);
        groups.join(7, 1);
        assert_eq!(groups.of(5), 1);
    }
}
