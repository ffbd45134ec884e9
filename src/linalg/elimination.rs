//! What elimination does to the pattern: its tree, its fill, and an order that follows the tree.

use super::graph::Lists;
use crate::interrupt::tick;

/// What a place of the pattern takes, in ticks.
const FILL: usize = 10;

/// Marks a root of the elimination tree.
pub const ROOT: u32 = u32::MAX;

/// The elimination tree of a lower triangle: each place's parent, the first later place its
/// column of the factor holds (Liu 1986).
pub fn tree(lower: &Lists) -> Vec<u32> {
    let n = lower.len();
    let mut parent = vec![ROOT; n];
    let mut ancestor = vec![ROOT; n];
    for k in 0..n {
        for &i in lower.get(k) {
            let mut i = i as usize;
            while i != k {
                let next = std::mem::replace(&mut ancestor[i], k as u32);
                if next == ROOT {
                    parent[i] = k as u32;
                    break;
                }
                i = next as usize;
            }
        }
    }
    parent
}

/// The places of a forest such that children come before parents and subtrees stay together.
pub fn postorder(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let mut first_child = vec![ROOT; n];
    let mut sibling = vec![ROOT; n];
    let mut roots = Vec::new();
    for k in (0..n).rev() {
        if parent[k] == ROOT {
            roots.push(k as u32);
        } else {
            let p = parent[k] as usize;
            sibling[k] = std::mem::replace(&mut first_child[p], k as u32);
        }
    }
    let mut order = Vec::with_capacity(n);
    let mut path = Vec::new();
    while let Some(root) = roots.pop() {
        path.push(root);
        while let Some(&k) = path.last() {
            let child = std::mem::replace(&mut first_child[k as usize], ROOT);
            if child == ROOT {
                order.push(k);
                path.pop();
            } else {
                first_child[k as usize] = sibling[child as usize];
                path.push(child);
            }
        }
    }
    order
}

/// The pattern of the factor by rows, without its diagonal: for each place the earlier ones
/// whose elimination reaches it, which are those on the tree's paths from the row's entries.
pub fn fill(lower: &Lists, parent: &[u32]) -> Lists {
    let mut seen = vec![ROOT; lower.len()];
    let mut rows = Lists::new();
    let mut row = Vec::new();
    for k in 0..lower.len() {
        tick(FILL * (row.len() + 1));
        row.clear();
        seen[k] = k as u32;
        for &i in lower.get(k) {
            let mut i = i as usize;
            while seen[i] != k as u32 {
                seen[i] = k as u32;
                row.push(i as u32);
                i = parent[i] as usize;
            }
        }
        row.sort_unstable();
        rows.push(row.iter().copied());
    }
    rows
}
