//! The equation between two wheels that turn each other.

use super::content::add_all;
use super::turns::simplest_fraction;
use super::winding::Winding;
use std::f64::consts::TAU;

/// `theta1 - (1 + r) alpha + r theta2 = K`, in radians: theta1 and theta2 are the directions of the
/// wheels, alpha that of the line of centres, r is the ratio. All are counted on beyond half a turn
/// from those accepted last.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mesh {
    ratio: f64,
    /// The ratio as numbers of teeth, the second wheel's over the first's, where they exist.
    teeth: Option<(f64, f64)>,
    counts: Counts,
    k: f64,
}

/// What accepted poses change of the equation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Counts {
    /// theta1, alpha, theta2 as last accepted.
    pub lifted: [Winding; 3],
    /// What the whole turns of these angles contribute to the equation.
    pub wound: f64,
}

impl Counts {
    /// Of a wheel that nothing but its own turns matters of.
    pub fn of_one(own: Winding) -> Self {
        Self { lifted: [own, Winding::default(), Winding::default()], wound: 0.0 }
    }
}

impl Mesh {
    /// Wheels that mesh at these angles, theta1, alpha and theta2.
    pub fn new(ratio: f64, angles: [f64; 3]) -> Self {
        let lifted = angles.map(Winding::new);
        let teeth = simplest_fraction(ratio, f64::EPSILON * ratio.abs());
        let mut mesh = Self { ratio, teeth, counts: Counts { lifted, wound: 0.0 }, k: 0.0 };
        mesh.k = mesh.sum(angles);
        mesh
    }

    /// The ratio r.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Whether the line of centres has a part in the equation.
    pub fn follows_centres(&self) -> bool {
        self.ratio != -1.0
    }

    /// The left side of the equation without whole turns.
    fn sum(&self, [theta1, alpha, theta2]: [f64; 3]) -> f64 {
        (theta1 - alpha) + self.ratio * (theta2 - alpha)
    }

    /// The `i`th angle of a direction, counted on; that accepted last where there is no direction.
    pub fn angle(&self, i: usize, direction: Option<f64>) -> f64 {
        let winding = self.counts.lifted[i];
        direction.map_or(winding.angle, |direction| winding.near(direction))
    }

    /// What is left of the equation at angles that were counted on.
    pub fn value(&self, angles: [f64; 3]) -> f64 {
        self.value_where(self.counts.wound, angles)
    }

    /// The same where whole turns contribute so much.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    pub fn value_where(&self, wound: f64, angles: [f64; 3]) -> f64 {
        self.sum(angles) + (wound - self.k)
    }

    /// What whole turns and K add to the left side.
    pub fn rest(&self) -> f64 {
        self.counts.wound - self.k
    }

    /// The angle at which the first or the second wheel belongs, from that of the other and of the line
    /// of centres.
    pub fn angle_from(&self, is_second: bool, other: f64, alpha: f64) -> f64 {
        self.angle_where(self.counts.wound, is_second, other, alpha)
    }

    /// The same where whole turns contribute so much.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    pub fn angle_where(&self, wound: f64, is_second: bool, other: f64, alpha: f64) -> f64 {
        let rest = self.k - wound;
        if is_second {
            alpha + (rest - (other - alpha)) / self.ratio
        } else {
            alpha + (rest - self.ratio * (other - alpha))
        }
    }

    /// How far the first or the second wheel turns at most while the other and the line of centres
    /// turn by no more than that.
    pub fn most_turned(&self, is_second: bool, other: f64, line: f64) -> f64 {
        let r = self.ratio;
        let by_line = line * (1.0 + r).abs();
        if is_second { (other + by_line) / r.abs() } else { other * r.abs() + by_line }
    }

    /// Accepts directions; one that is not there stays as it was.
    pub fn follow(&mut self, directions: [Option<f64>; 3]) {
        for (winding, direction) in self.counts.lifted.iter_mut().zip(directions) {
            if let Some(direction) = direction {
                winding.follow(direction);
            }
        }
        self.counts.wound = self.wound_by(self.counts.lifted.map(|winding| winding.turns));
    }

    /// What so many whole turns contribute to the equation.
    pub fn wound_by(&self, [n1, n_alpha, n2]: [i64; 3]) -> f64 {
        // Wheels that mesh keep `first + r second` small however far they run; summed in
        // teeth it is exact, so nothing is lost in a million turns.
        let (first, second) = ((n1 - n_alpha) as f64, (n2 - n_alpha) as f64);
        TAU * match self.teeth {
            Some((p, q)) => (first * q + second * p) / q,
            None => second.mul_add(self.ratio, first),
        }
    }

    /// How far the wheels have turned.
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// They have turned so far.
    pub const fn set_counts(&mut self, counts: Counts) {
        self.counts = counts;
    }

    /// A gear change: the wheels mesh on from where they stand, turns so far forgotten.
    pub fn change_gear(&mut self, ratio: f64) {
        let angles = self.counts.lifted.map(|winding| winding.angle);
        let left = self.value(angles);
        *self = Self::new(ratio, angles);
        self.k -= left;
    }

    /// What accepted poses change of it.
    pub fn state(&self) -> Vec<f64> {
        let windings = self.counts.lifted.iter().flat_map(|winding| winding.to_numbers());
        windings.chain([self.counts.wound]).collect()
    }

    /// Takes over what [`state`](Self::state) gave.
    pub fn set_state(&mut self, state: &[f64]) {
        if let &[a, b, c, d, e, f, wound] = state {
            let lifted = [[a, b], [c, d], [e, f]].map(Winding::from_numbers);
            self.counts = Counts { lifted, wound };
        }
    }

    /// K.
    pub const fn captured(&self) -> f64 {
        self.k
    }

    /// Takes over a K.
    pub const fn set_captured(&mut self, k: f64) {
        self.k = k;
    }

    /// All that the equation depends on.
    pub fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { ratio, teeth: _, counts: Counts { lifted, wound }, k } = self;
        add_all([*ratio], word);
        lifted.iter().for_each(|winding| winding.content(word));
        add_all([*wound, *k], word);
    }
}
