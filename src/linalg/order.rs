//! An elimination order with little fill: approximate minimum degree on a quotient graph.

use super::graph::Graph;
use crate::interrupt::tick;

const NONE: u32 = u32::MAX;

/// What the elimination of a point takes, in ticks.
const PIVOT: usize = 200;

/// An order in which to eliminate the points: `order[k]` goes k-th.
///
/// Amestoy, Davis and Duff, "An approximate minimum degree ordering algorithm", SIAM J. Matrix
/// Anal. Appl. 17 (1996): eliminated points become elements (cliques kept as member lists),
/// degrees are bounded from above, points that have become indistinguishable are merged, and
/// an element that lies within a new one is absorbed by it.
pub fn minimum_degree(graph: &Graph) -> Vec<u32> {
    let n = graph.n_points();
    let mut quotient = Quotient::new(graph);
    let mut order = Vec::with_capacity(n);
    while order.len() < n {
        let pivot = quotient.buckets.pop_least();
        tick(PIVOT);
        quotient.eliminate(pivot, n - order.len());
        let mut point = pivot as u32;
        while point != NONE {
            order.push(point);
            point = quotient.merged.next[point as usize];
        }
    }
    order
}

/// The graph while it is eliminated; points and the elements they turn into share indices.
struct Quotient {
    /// How many points a live point stands for; 0 once it is eliminated or merged.
    weight: Vec<u32>,
    /// Neighbours of a live point that no element accounts for.
    neighbours: Vec<Vec<u32>>,
    /// Elements a live point belongs to, oldest first.
    elements: Vec<Vec<u32>>,
    /// The live points of an element; empty once it is absorbed.
    members: Vec<Vec<u32>>,
    /// The weight of an element's members.
    size: Vec<u32>,
    /// The weight of an element's members outside the newest one, where `seen` is `stamp`.
    outside: Vec<u32>,
    seen: Vec<u32>,
    /// Equal to `stamp` for members of the newest element.
    mark: Vec<u32>,
    stamp: u32,
    merged: Chains,
    buckets: Buckets,
    hashes: Vec<(u64, u32)>,
}

impl Quotient {
    fn new(graph: &Graph) -> Self {
        let n = graph.n_points();
        let neighbours: Vec<_> = (0..n).map(|p| graph.neighbours(p).to_vec()).collect();
        let mut buckets = Buckets::new(n);
        for (point, list) in neighbours.iter().enumerate().rev() {
            buckets.insert(point, list.len());
        }
        Self {
            weight: vec![1; n],
            neighbours,
            elements: vec![Vec::new(); n],
            members: vec![Vec::new(); n],
            size: vec![0; n],
            outside: vec![0; n],
            seen: vec![0; n],
            mark: vec![0; n],
            stamp: 0,
            merged: Chains::new(n),
            buckets,
            hashes: Vec::new(),
        }
    }

    /// Turns `pivot` into an element and brings its neighbours up to date.
    fn eliminate(&mut self, pivot: usize, n_left: usize) {
        self.stamp += 1;
        let n_left = n_left - self.weight[pivot] as usize;
        self.weight[pivot] = 0;
        let mut members = self.gather(pivot);
        self.measure_outside(&members);
        let total: u32 = members.iter().map(|&i| self.weight[i as usize]).sum();
        self.hashes.clear();
        for &i in &members {
            self.update(i as usize, pivot, total, n_left);
        }
        self.merge_indistinguishable();
        members.retain(|&i| self.weight[i as usize] > 0);
        for &i in &members {
            self.buckets.insert(i as usize, self.buckets.degree[i as usize] as usize);
        }
        self.size[pivot] = members.iter().map(|&i| self.weight[i as usize]).sum();
        self.members[pivot] = members;
    }

    /// The live neighbours of `pivot`, taken out of their buckets; its elements are absorbed.
    fn gather(&mut self, pivot: usize) -> Vec<u32> {
        let mut found = std::mem::take(&mut self.neighbours[pivot]);
        for e in std::mem::take(&mut self.elements[pivot]) {
            found.append(&mut self.members[e as usize]);
        }
        let (weight, mark, stamp) = (&self.weight, &mut self.mark, self.stamp);
        found.retain(|&i| {
            let is_new = weight[i as usize] > 0 && mark[i as usize] != stamp;
            mark[i as usize] = stamp;
            is_new
        });
        for &i in &found {
            self.buckets.remove(i as usize);
        }
        found
    }

    /// For each element that shares a point with `members`, the weight of the others in it.
    fn measure_outside(&mut self, members: &[u32]) {
        for &i in members {
            for &e in &self.elements[i as usize] {
                let e = e as usize;
                if self.seen[e] != self.stamp {
                    self.seen[e] = self.stamp;
                    self.outside[e] = self.size[e];
                }
                self.outside[e] -= self.weight[i as usize];
            }
        }
    }

    /// Renews the lists and the degree of `i`, a member of the new element `pivot`.
    fn update(&mut self, i: usize, pivot: usize, total: u32, n_left: usize) {
        let mut elements = std::mem::take(&mut self.elements[i]);
        let mut neighbours = std::mem::take(&mut self.neighbours[i]);
        let mut degree = 0;
        let mut hash = 0;
        elements.retain(|&e| {
            let e = e as usize;
            let is_apart = !self.members[e].is_empty() && self.outside[e] > 0;
            if is_apart {
                degree += self.outside[e];
                hash += e as u64;
            } else {
                self.members[e] = Vec::new();
            }
            is_apart
        });
        neighbours.retain(|&v| {
            let v = v as usize;
            let is_apart = self.weight[v] > 0 && self.mark[v] != self.stamp;
            if is_apart {
                degree += self.weight[v];
                hash += v as u64;
            }
            is_apart
        });
        if elements.is_empty() && neighbours.is_empty() {
            // Nothing but the new element holds it: it can go at once, without fill.
            self.weight[i] = 0;
            self.merged.append(pivot, i);
            return;
        }
        let others = total - self.weight[i];
        let bound = (degree + others).min(self.buckets.degree[i] + others);
        self.buckets.degree[i] = bound.min(n_left as u32 - self.weight[i]);
        elements.push(pivot as u32);
        self.elements[i] = elements;
        self.neighbours[i] = neighbours;
        self.hashes.push((hash, i as u32));
    }

    /// Merges members of the newest element that have the same neighbours and elements; both
    /// lists are in an order of their own, so equal sets are equal lists.
    fn merge_indistinguishable(&mut self) {
        let mut hashes = std::mem::take(&mut self.hashes);
        hashes.sort_unstable();
        for (k, &(hash, i)) in hashes.iter().enumerate() {
            let i = i as usize;
            if self.weight[i] == 0 {
                continue;
            }
            for &(_, j) in hashes[k + 1..].iter().take_while(|&&(h, _)| h == hash) {
                let j = j as usize;
                if self.weight[j] > 0
                    && self.elements[i] == self.elements[j]
                    && self.neighbours[i] == self.neighbours[j]
                {
                    self.buckets.degree[i] -= self.weight[j];
                    self.weight[i] += std::mem::take(&mut self.weight[j]);
                    self.merged.append(i, j);
                }
            }
        }
        self.hashes = hashes;
    }
}

/// Chains of points that are eliminated together.
struct Chains {
    next: Vec<u32>,
    last: Vec<u32>,
}

impl Chains {
    fn new(n: usize) -> Self {
        Self { next: vec![NONE; n], last: (0..n as u32).collect() }
    }

    /// Appends the chain that begins at `j` to the one that begins at `i`.
    fn append(&mut self, i: usize, j: usize) {
        self.next[self.last[i] as usize] = j as u32;
        self.last[i] = self.last[j];
    }
}

/// Points by degree, in doubly linked lists; the latest inserted comes first.
struct Buckets {
    degree: Vec<u32>,
    head: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    least: usize,
}

impl Buckets {
    fn new(n: usize) -> Self {
        Self {
            degree: vec![0; n],
            head: vec![NONE; n],
            next: vec![NONE; n],
            previous: vec![NONE; n],
            least: 0,
        }
    }

    fn insert(&mut self, point: usize, degree: usize) {
        let old = std::mem::replace(&mut self.head[degree], point as u32);
        if old != NONE {
            self.previous[old as usize] = point as u32;
        }
        self.degree[point] = degree as u32;
        self.next[point] = old;
        self.previous[point] = NONE;
        self.least = self.least.min(degree);
    }

    fn remove(&mut self, point: usize) {
        let (previous, next) = (self.previous[point], self.next[point]);
        if previous == NONE {
            self.head[self.degree[point] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }

    fn pop_least(&mut self) -> usize {
        while self.head[self.least] == NONE {
            self.least += 1;
        }
        let point = self.head[self.least] as usize;
        self.remove(point);
        point
    }
}
