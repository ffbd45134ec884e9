//! Which points share a row, and in what order and shape that couples the unknowns.

/// An undirected graph on points: two are neighbours if some row holds both.
pub struct Graph {
    start: Vec<u32>,
    neighbours: Vec<u32>,
}

impl Graph {
    /// The graph on `n_points` points whose edges are all pairs within each of `rows`.
    pub fn new<'a>(n_points: usize, rows: impl Iterator<Item = &'a [u32]>) -> Self {
        let mut edges = Vec::new();
        for row in rows {
            for (k, &a) in row.iter().enumerate() {
                for &b in &row[..k] {
                    edges.push((a, b));
                    edges.push((b, a));
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        let mut start = vec![0; n_points + 1];
        for &(a, _) in &edges {
            start[a as usize + 1] += 1;
        }
        accumulate(&mut start);
        Self { start, neighbours: edges.into_iter().map(|(_, b)| b).collect() }
    }

    /// How many points there are.
    pub fn n_points(&self) -> usize {
        self.start.len() - 1
    }

    /// The neighbours of a point, ascending.
    pub fn neighbours(&self, point: usize) -> &[u32] {
        &self.neighbours[self.start[point] as usize..self.start[point + 1] as usize]
    }
}

/// Turns counts (each one place after its owner) into starting positions.
pub fn accumulate(counts: &mut [u32]) {
    let mut sum = 0;
    for count in counts {
        sum += *count;
        *count = sum;
    }
}

/// The inverse of a permutation.
pub fn inverse(order: &[u32]) -> Vec<u32> {
    let mut place = vec![0; order.len()];
    for (k, &point) in order.iter().enumerate() {
        place[point as usize] = k as u32;
    }
    place
}

/// Lists of ascending indices, one after the other: the pattern of a triangular matrix.
#[derive(Clone)]
pub struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// No lists yet.
    pub fn new() -> Self {
        Self { start: vec![0], items: Vec::new() }
    }

    /// Appends a list.
    pub fn push(&mut self, items: impl IntoIterator<Item = u32>) {
        self.items.extend(items);
        self.start.push(self.items.len() as u32);
    }

    /// The same without room for more.
    #[must_use]
    pub fn shrunk(mut self) -> Self {
        self.start.shrink_to_fit();
        self.items.shrink_to_fit();
        self
    }

    /// How many lists there are.
    pub fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// How many items there are in all lists.
    pub fn n_items(&self) -> usize {
        self.items.len()
    }

    /// Where list `k` lies among all items.
    pub fn range(&self, k: usize) -> std::ops::Range<usize> {
        self.start[k] as usize..self.start[k + 1] as usize
    }

    /// List `k`.
    pub fn get(&self, k: usize) -> &[u32] {
        &self.items[self.range(k)]
    }

    /// The items of all lists.
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// For each index below `len()` the lists that hold it, ascending.
    pub fn transposed(&self) -> Self {
        let mut start = vec![0; self.len() + 1];
        for &item in &self.items {
            start[item as usize + 1] += 1;
        }
        accumulate(&mut start);
        let mut next = start.clone();
        let mut items = vec![0; self.items.len()];
        for k in 0..self.len() {
            for &item in self.get(k) {
                let at = &mut next[item as usize];
                items[*at as usize] = k as u32;
                *at += 1;
            }
        }
        Self { start, items }
    }
}

/// The lower triangle in elimination order: for each place the earlier places of neighbours.
pub fn lower_triangle(graph: &Graph, order: &[u32]) -> Lists {
    let place = inverse(order);
    let mut lower = Lists::new();
    let mut row = Vec::new();
    for (k, &point) in order.iter().enumerate() {
        row.clear();
        let places = graph.neighbours(point as usize).iter().map(|&b| place[b as usize]);
        row.extend(places.filter(|&i| (i as usize) < k));
        row.sort_unstable();
        lower.push(row.iter().copied());
    }
    lower
}
