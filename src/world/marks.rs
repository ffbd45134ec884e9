//! Which of many things were noted already, without a pass over all of them to begin anew.

/// By place, the number of the last round in which it was marked.
#[derive(Debug, Default)]
pub(crate) struct Marks {
    rounds: Vec<u32>,
    round: u32,
}

impl Marks {
    /// Begins a round in which nothing is marked.
    pub fn begin(&mut self) {
        self.round += 1;
    }

    /// Marks a place; false if it was marked in this round already.
    #[inline]
    pub fn mark(&mut self, place: usize) -> bool {
        if place >= self.rounds.len() {
            self.rounds.resize(place + 1, 0);
        }
        std::mem::replace(&mut self.rounds[place], self.round) != self.round
    }
}
