//! L D L^T by dense fronts, for large nets.
//!
//! Points whose columns of L have the same rows form a node, and are eliminated together in a
//! dense matrix, the front: their own columns, and the change that their elimination makes to
//! the rows below them, which is handed to the parent (Duff and Reid, "The multifrontal
//! solution of indefinite sparse symmetric linear equations", ACM TOMS 9, 1983). The work is
//! dense products.

use super::block::Pivots;
use super::elimination::ROOT;
use super::graph::Lists;
use super::kernel::{Panel, WIDE, factor_panel, subtract_product};
use super::normal::Normal;

/// A factor by nodes; nothing is allocated per factor.
pub struct Supernodal {
    nodes: Vec<Node>,
    /// For each node the points below its own, ascending.
    below: Lists,
    /// For each node, where its points below lie in the front of its parent.
    places: Lists,
    /// The children of each node, ascending.
    children: Lists,
    /// The columns of L of each node, `n_rows` numbers each, with 1 / D on the diagonal; and
    /// behind those made so far, while factoring, the changes that are not handed over yet, as
    /// lower triangles on a stack that grows down from the end.
    numbers: Vec<f64>,
    /// How many of them are columns.
    n_stored: usize,
    /// D of the node at work.
    d: Vec<f64>,
    /// Room for what tiles are multiplied with.
    packed: Vec<f64>,
    /// The blocks of the normal matrix by node, and where each goes in the node's columns.
    entries: Vec<(u32, u32)>,
    /// Values of the rows below a node, while solving.
    gathered: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Node {
    /// Its points follow each other in elimination order.
    first: u32,
    n_points: u32,
    /// How many points it holds and reaches.
    n_front: u32,
    /// Its blocks of the normal matrix are the entries up to here from where those of the node
    /// before it end.
    end_entry: u32,
    /// Where its columns begin in `numbers`.
    start: usize,
}

impl Node {
    fn points(self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.n_points) as usize
    }

    fn n_pivots(self) -> usize {
        2 * self.n_points as usize
    }

    fn n_rows(self) -> usize {
        2 * self.n_front as usize
    }

    fn n_below(self) -> usize {
        self.n_rows() - self.n_pivots()
    }

    fn numbers(self) -> std::ops::Range<usize> {
        self.start..self.start + self.n_pivots() * self.n_rows()
    }
}

impl Supernodal {
    /// `columns` is the pattern of L by rows, in an order that follows its tree; `lower` that
    /// of the normal matrix.
    pub fn new(lower: &Lists, columns: Lists) -> Self {
        let rows = columns.transposed();
        drop(columns);
        let ends = amalgamate(&rows);
        let mut node_of = vec![0; rows.len()];
        let mut nodes = Vec::with_capacity(ends.len());
        let mut below = Lists::new();
        let mut first = 0;
        let mut start = 0;
        for (node_idx, &end) in ends.iter().enumerate() {
            node_of[first..end].fill(node_idx as u32);
            // The last point of a node reaches whatever the others reach beyond the node.
            below.push(rows.get(end - 1).iter().copied());
            let n_points = end - first;
            let n_front = n_points + rows.get(end - 1).len();
            nodes.push(Node {
                first: first as u32,
                n_points: n_points as u32,
                n_front: n_front as u32,
                end_entry: 0,
                start,
            });
            start += 4 * n_points * n_front;
            first = end;
        }
        let parent: Vec<u32> = (0..nodes.len())
            .map(|s| below.get(s).first().map_or(ROOT, |&p| node_of[p as usize]))
            .collect();
        let mut places = Lists::new();
        let mut children = vec![Vec::new(); nodes.len()];
        for (s, &p) in parent.iter().enumerate() {
            if p == ROOT {
                places.push([]);
                continue;
            }
            children[p as usize].push(s as u32);
            let node = nodes[p as usize];
            let beyond = below.get(p as usize);
            places.push(below.get(s).iter().map(|&point| place_in_front(node, beyond, point)));
        }
        drop(rows);
        let entries = place_entries(&mut nodes, lower, &node_of, &below);
        let mut child_lists = Lists::new();
        for list in children {
            child_lists.push(list);
        }
        let children = child_lists.shrunk();
        let most = |of: fn(&Node) -> usize| nodes.iter().map(of).max().unwrap_or(0);
        let n_pivots = most(|node| node.n_pivots());
        Self {
            below: below.shrunk(),
            places: places.shrunk(),
            numbers: vec![0.0; room(&nodes, &children)],
            n_stored: start,
            d: vec![0.0; n_pivots],
            packed: vec![0.0; WIDE * n_pivots],
            entries,
            gathered: vec![0.0; most(|node| node.n_below())],
            children,
            nodes,
        }
    }

    /// How many numbers the factor stores.
    pub fn n_stored(&self) -> usize {
        self.n_stored
    }

    /// Factors `normal + mu I`.
    pub fn factor(&mut self, normal: &Normal, mu: f64) -> Pivots {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // Vectors of four numbers instead of two: a net of 64 x 64 squares takes 4.1 ms
            // instead of 7.1. The bits are the same, because products are summed in an order
            // that is written down and never fused; a test compares them.
            #[allow(unsafe_code)]
            // SAFETY: the instructions exist, as was just asked.
            return unsafe { self.factor_avx2(normal, mu) };
        }
        self.factor_portable(normal, mu)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn factor_avx2(&mut self, normal: &Normal, mu: f64) -> Pivots {
        self.factor_portable(normal, mu)
    }

    // It becomes part of the function above, with its vectors.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn factor_portable(&mut self, normal: &Normal, mu: f64) -> Pivots {
        let mut pivots = Pivots::NONE;
        let mut first_entry = 0;
        let mut top = self.numbers.len();
        for (s, &node) in self.nodes.iter().enumerate() {
            let (n_rows, n_pivots, n_below) = (node.n_rows(), node.n_pivots(), node.n_below());
            let (columns, rest) = self.numbers.split_at_mut(node.numbers().end);
            let columns = &mut columns[node.start..];
            let (room, mut theirs) = rest.split_at_mut(top - node.numbers().end);
            let own = room.len() - n_below * n_below;
            let change = &mut room[own..];
            columns.fill(0.0);
            change.fill(0.0);
            let entries = &self.entries[first_entry..node.end_entry as usize];
            first_entry = node.end_entry as usize;
            scatter(columns, n_rows, entries, normal);
            for diagonal in columns.iter_mut().step_by(n_rows + 1) {
                *diagonal += mu;
            }
            // The last child's change lies on top.
            for &child in self.children.get(s).iter().rev() {
                let places = self.places.get(child as usize);
                let handed;
                (handed, theirs) = theirs.split_at_mut(n_packed(2 * places.len()));
                take_over(columns, change, node, places, handed);
            }
            let (d, packed) = (&mut self.d[..n_pivots], &mut self.packed);
            factor_panel(columns, d, packed, n_rows, &mut pivots);
            let panel = Panel { numbers: columns, ld: n_rows }.from(n_pivots);
            subtract_product(change, n_below, panel, d, packed, [n_below, n_below]);
            // What was handed over makes room for the change.
            let n_left = theirs.len();
            let to = self.numbers.len() - n_left;
            pack(&mut self.numbers, top, to, n_below);
            top = to - n_packed(n_below);
        }
        pivots
    }

    /// Replaces the right-hand side, in elimination order, by the solution.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        for (s, node) in self.nodes.iter().enumerate() {
            let ld = node.n_rows();
            let (own, later) = rhs[2 * node.first as usize..].split_at_mut(node.n_pivots());
            let gathered = &mut self.gathered[..node.n_below()];
            gathered.fill(0.0);
            for (j, column) in self.numbers[node.numbers()].chunks_exact(ld).enumerate() {
                let y = own[j];
                let (inside, outside) = column.split_at(own.len());
                for (r, l) in own[j + 1..].iter_mut().zip(&inside[j + 1..]) {
                    *r -= l * y;
                }
                for (r, l) in gathered.iter_mut().zip(outside) {
                    *r -= l * y;
                }
            }
            let base = node.points().end;
            for (&p, g) in self.below.get(s).iter().zip(gathered.as_chunks::<2>().0) {
                let at = 2 * (p as usize - base);
                later[at] += g[0];
                later[at + 1] += g[1];
            }
        }
        for (s, node) in self.nodes.iter().enumerate().rev() {
            let ld = node.n_rows();
            let (own, later) = rhs[2 * node.first as usize..].split_at_mut(node.n_pivots());
            let gathered = &mut self.gathered[..node.n_below()];
            let base = node.points().end;
            for (&p, g) in self.below.get(s).iter().zip(gathered.as_chunks_mut::<2>().0) {
                let at = 2 * (p as usize - base);
                *g = [later[at], later[at + 1]];
            }
            for (j, column) in self.numbers[node.numbers()].chunks_exact(ld).enumerate().rev() {
                let (inside, outside) = column.split_at(own.len());
                let mut y = own[j] * inside[j];
                y -= dot(&inside[j + 1..], &own[j + 1..]);
                y -= dot(outside, gathered);
                own[j] = y;
            }
        }
    }
}

/// The blocks of the normal matrix in the order of the nodes that hold their columns, and where
/// each goes there; notes with each node where its blocks end.
fn place_entries(
    nodes: &mut [Node],
    lower: &Lists,
    node_of: &[u32],
    below: &Lists,
) -> Vec<(u32, u32)> {
    let node_of = |i: u32| node_of[i as usize] as usize;
    let row = |k: usize| lower.get(k).iter().copied().chain([k as u32]);
    for i in (0..lower.len()).flat_map(row) {
        nodes[node_of(i)].end_entry += 1;
    }
    let mut next = Vec::with_capacity(nodes.len());
    let mut end = 0;
    for node in nodes.iter_mut() {
        next.push(end);
        end += node.end_entry;
        node.end_entry = end;
    }
    let mut entries = vec![(0, 0); end as usize];
    let pairs = (0..lower.len()).flat_map(|k| row(k).map(move |i| (k as u32, i)));
    for (block, (k, i)) in pairs.enumerate() {
        let s = node_of(i);
        let node = nodes[s];
        let row = 2 * place_in_front(node, below.get(s), k) as usize;
        let column = 2 * (i - node.first) as usize;
        entries[next[s] as usize] = (block as u32, (column * node.n_rows() + row) as u32);
        next[s] += 1;
    }
    entries
}

/// How many numbers the columns need, together with the changes that are on the stack when each
/// node is at work.
fn room(nodes: &[Node], children: &Lists) -> usize {
    let (mut most, mut n_stacked) = (0, 0);
    for (s, node) in nodes.iter().enumerate() {
        most = most.max(node.numbers().end + n_stacked + node.n_below().pow(2));
        let children = children.get(s).iter().map(|&child| nodes[child as usize]);
        let handed: usize = children.map(|child| n_packed(child.n_below())).sum();
        n_stacked = n_stacked + n_packed(node.n_below()) - handed;
    }
    most
}

/// How many numbers the lower triangle of `n` columns is, in pairs of columns of one length.
fn n_packed(n: usize) -> usize {
    n / 2 * (n + 2)
}

/// Moves the lower triangle of the `n` columns that end at `from` to where it ends at `to`, which
/// is no earlier.
fn pack(numbers: &mut [f64], from: usize, to: usize, n: usize) {
    let mut to = to;
    // The last column first: none is overwritten before it is moved.
    for column in (0..n).rev() {
        let end = from - (n - 1 - column) * n;
        let n_rows = n - column / 2 * 2;
        to -= n_rows;
        numbers.copy_within(end - n_rows..end, to);
    }
}

/// Puts blocks of the normal matrix where they belong in the columns of a node.
fn scatter(columns: &mut [f64], ld: usize, entries: &[(u32, u32)], normal: &Normal) {
    for &(block, at) in entries {
        let (block, at) = (normal.block(block as usize), at as usize);
        columns[at] = block[0];
        columns[at + 1] = block[2];
        columns[at + ld] = block[1];
        columns[at + ld + 1] = block[3];
    }
}

/// A sum of products in four strands, so that it vectorises.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sum = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sum[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    (sum[0] + sum[1]) + (sum[2] + sum[3]) + rest
}

/// Adds what a child hands over to the front of its parent: to the node's own `columns`, or to
/// its `change`.
fn take_over(columns: &mut [f64], change: &mut [f64], node: Node, places: &[u32], theirs: &[f64]) {
    let mut theirs = theirs;
    let (n_rows, n_pivots, n_below) = (node.n_rows(), node.n_pivots(), node.n_below());
    for (j, &to) in places.iter().enumerate() {
        for half in 0..2 {
            let from;
            (from, theirs) = theirs.split_at(2 * (places.len() - j));
            let column = 2 * to as usize + half;
            let (target, shift) = if column < n_pivots {
                (&mut columns[column * n_rows..][..n_rows], 0)
            } else {
                (&mut change[(column - n_pivots) * n_below..][..n_below], n_pivots)
            };
            for (&place, pair) in places[j..].iter().zip(from.as_chunks::<2>().0) {
                let at = 2 * place as usize - shift;
                target[at] += pair[0];
                target[at + 1] += pair[1];
            }
        }
    }
}

/// Where a point lies in the front of a node with the given points `below`.
fn place_in_front(node: Node, below: &[u32], point: u32) -> u32 {
    if node.points().contains(&(point as usize)) {
        point - node.first
    } else {
        let at = below.binary_search(&point).expect("the front holds all it is asked for");
        node.n_points + at as u32
    }
}

/// Where the nodes end: columns with the same rows, and small nodes joined with their parents
/// where that adds few zeros.
fn amalgamate(rows: &Lists) -> Vec<usize> {
    let mut nodes: Vec<Extent> = Vec::new();
    for k in 0..rows.len() {
        let n_below = rows.get(k).len();
        let mut last = Extent { first: k, end: k + 1, n_below, n_zeros: 0 };
        while let Some(&child) = nodes.last() {
            let is_parent = rows.get(child.end - 1).first().is_some_and(|&p| p < last.end as u32);
            if !is_parent || !child.joined(last).is_worthwhile() {
                break;
            }
            last = child.joined(last);
            nodes.pop();
        }
        nodes.push(last);
    }
    nodes.into_iter().map(|node| node.end).collect()
}

/// Points `first..end` and how many points below them they reach.
#[derive(Clone, Copy)]
struct Extent {
    first: usize,
    end: usize,
    n_below: usize,
    /// How many of their blocks are zeros stored for the sake of the shape.
    n_zeros: usize,
}

impl Extent {
    /// How many blocks their columns hold.
    fn n_blocks(self) -> usize {
        let n = self.end - self.first;
        n * (n + 1) / 2 + n * self.n_below
    }

    fn joined(self, parent: Self) -> Self {
        let mut joined = Self { first: self.first, ..parent };
        joined.n_zeros =
            joined.n_blocks() - self.n_blocks() - parent.n_blocks() + self.n_zeros + parent.n_zeros;
        joined
    }

    /// Whether one larger front is cheaper than two. Small fronts cost more in bookkeeping than
    /// in zeros; the bounds are those that measured best on nets of 16 to 64 squares.
    fn is_worthwhile(self) -> bool {
        let zeros = self.n_zeros as f64 / self.n_blocks() as f64;
        match self.end - self.first {
            0..=4 => true,
            5..=8 => zeros < 0.3,
            9..=24 => zeros < 0.1,
            _ => zeros < 0.03,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{Graph, SymbolicAnalysis};

    #[test]
    fn wider_vectors_give_the_same_bits() {
        let n = 20_u32;
        let at = |i: u32, j: u32| i * n + j;
        let rows: Vec<[u32; 4]> = (0..n - 1)
            .flat_map(|i| {
                (0..n - 1).map(move |j| [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)])
            })
            .collect();
        let points = rows.iter().map(<[u32; 4]>::as_slice);
        let analysis = SymbolicAnalysis::new(&Graph::new((n * n) as usize, points.clone()));
        let mut normal = Normal::new(&analysis.lower, &analysis.order, points);
        for row_idx in 0..rows.len() {
            let values: [f64; 8] =
                std::array::from_fn(|k| libm::sin((7 * row_idx * (k + 1)) as f64));
            normal.add_row(row_idx, &values);
        }
        let mut factor = Supernodal::new(&analysis.lower, analysis.columns);
        factor.factor(&normal, 1e-3);
        let widest = factor.numbers.clone();
        factor.factor_portable(&normal, 1e-3);
        assert!(widest.iter().zip(&factor.numbers).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}
