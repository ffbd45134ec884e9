//! The samples of a path, in which a lap that repeats is kept once.
//!
//! A crank comes round to the same pose again and again, and the places it leads to are mostly the same to
//! the bit: now and then one differs in its last digits, since the angle of the crank is a sum. So a path
//! is kept as runs. Each run is some samples, the last so many of which come again and again, and the
//! few that differ by rounding; who asks for any sample gets what was put in, to the bit.

use std::borrow::Cow;
use std::ops::Index;

use crate::constraint::Point;

/// A repeated sample may differ by this part of the size of its lap: that is rounding.
const ROUNDING: f64 = 1e-12;

/// Of so many repeated samples one may differ.
const ODDS: usize = 16;

/// Repeated samples below which it is not worth to begin another run.
const FEW: usize = 32;

/// So long at first it is waited whether a sample comes again, before another one is waited for.
const FIRST_WAIT: usize = 64;

/// One place of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The place.
    pub at: Point,
    /// Whether the frame missed its tolerance.
    pub missed: bool,
}

/// Samples in order of time.
#[derive(Debug, Clone, Default)]
pub struct SampleList {
    runs: Vec<Run>,
}

/// Samples, the last of which come again and again.
#[derive(Debug, Clone, Default)]
struct Run {
    /// How many samples are in the runs before.
    before: usize,
    /// What is kept.
    kept: Vec<Sample>,
    /// How many of the last of these come again and again; 0 where none do.
    period: usize,
    /// How many samples there are with those that come again.
    n: usize,
    /// Repeated ones that differ by rounding, by their places.
    odd: Vec<(usize, Sample)>,
    /// How far one may differ.
    rounding: f64,
    watch: Watch,
}

/// Looks for a lap: waits for a sample to come again, then follows whether those behind it do
/// (R. P. Brent, An improved Monte Carlo factorization algorithm, 1980).
#[derive(Debug, Clone, Copy)]
struct Watch {
    /// The place of the sample that is waited for.
    anchor: usize,
    /// How long.
    wait: usize,
    lap: Option<Lap>,
}

/// Samples that are those of a lap before, so far.
#[derive(Debug, Clone, Copy)]
struct Lap {
    from: usize,
    period: usize,
    n_odd: usize,
}

impl Default for Watch {
    fn default() -> Self {
        Self { anchor: 0, wait: FIRST_WAIT, lap: None }
    }
}

fn is_same(a: &Sample, b: &Sample) -> bool {
    let bits = |s: &Sample| (s.at.x.to_bits(), s.at.y.to_bits(), s.missed);
    bits(a) == bits(b)
}

/// The larger of the width and the height of what samples cover.
fn extent(samples: &[Sample]) -> f64 {
    let least = |part: fn(&Sample) -> f64| samples.iter().map(part).fold(f64::INFINITY, f64::min);
    let most = |part: fn(&Sample) -> f64| samples.iter().map(part).fold(-f64::INFINITY, f64::max);
    let (x, y) = (|s: &Sample| s.at.x, |s: &Sample| s.at.y);
    (most(x) - least(x)).max(most(y) - least(y))
}

/// Whether so many of some repeated samples may differ.
const fn may_differ(n_odd: usize, n_repeated: usize) -> bool {
    n_odd <= 1 + n_repeated / ODDS
}

impl Run {
    fn get(&self, k: usize) -> &Sample {
        if k < self.kept.len() {
            return &self.kept[k];
        }
        match self.odd.binary_search_by_key(&k, |(at, _)| *at) {
            Ok(found) => &self.odd[found].1,
            Err(_) => &self.kept[self.base(k)],
        }
    }

    /// The place of the sample that a repeated one repeats.
    const fn base(&self, k: usize) -> usize {
        let first = self.kept.len() - self.period;
        first + (k - first) % self.period
    }

    /// Takes a sample; gives it back if it belongs to no lap of this run and would be dear to keep here.
    fn push(&mut self, sample: Sample) -> Option<Sample> {
        if self.period > 0 {
            let base = self.kept[self.base(self.n)];
            let n_repeated = self.n - self.kept.len();
            if !is_same(&base, &sample) {
                if !self.is_rounded(&base, &sample) || !may_differ(self.odd.len() + 1, n_repeated) {
                    if n_repeated >= FEW {
                        return Some(sample);
                    }
                    self.unfold();
                    return self.push(sample);
                }
                self.odd.push((self.n, sample));
            }
            self.n += 1;
            return None;
        }
        self.kept.push(sample);
        self.n += 1;
        if let Some(period) = self.found() {
            self.fold(period);
        }
        None
    }

    fn is_rounded(&self, a: &Sample, b: &Sample) -> bool {
        a.missed == b.missed && a.at.distance(b.at) <= self.rounding
    }

    /// Looks at the last sample; gives the period of a lap that has come twice.
    fn found(&mut self) -> Option<usize> {
        let last = self.kept.len() - 1;
        let is_as_at = |k: usize| is_same(&self.kept[k], &self.kept[last]);
        if let Some(lap) = &mut self.watch.lap {
            lap.n_odd += usize::from(!is_as_at(last - lap.period));
            let n_repeated = last + 1 - lap.from;
            if may_differ(lap.n_odd, n_repeated) {
                return (n_repeated == lap.period).then_some(lap.period);
            }
            self.watch.lap = None;
        }
        // Where a point rests its samples are the same and tell nothing of laps.
        if last == 0 || is_as_at(last - 1) {
            return None;
        }
        let watch = &mut self.watch;
        if last > watch.anchor && is_as_at(watch.anchor) {
            watch.lap = Some(Lap { from: last, period: last - watch.anchor, n_odd: 0 });
        } else if last - watch.anchor >= watch.wait {
            *watch = Watch { anchor: last, wait: 2 * watch.wait, lap: None };
        }
        None
    }

    /// Keeps the first of all laps of this period and lets go of what repeats it.
    fn fold(&mut self, period: usize) {
        self.watch.lap = None;
        let n = self.n;
        self.rounding = ROUNDING * extent(&self.kept[n - period..]);
        let goes_back = |k: &usize| self.is_rounded(&self.kept[*k], &self.kept[k + period]);
        let n_back = (0..n - 2 * period).rev().take_while(goes_back).count();
        let first = n - 2 * period - n_back;
        let (lap, repeated) = self.kept[first..].split_at(period);
        let pairs = repeated.iter().zip(lap.iter().cycle()).zip(first + period..);
        let odd: Vec<((&Sample, &Sample), usize)> =
            pairs.filter(|((sample, base), _)| !is_same(sample, base)).collect();
        let are_rounded = odd.iter().all(|((sample, base), _)| self.is_rounded(sample, base));
        if !are_rounded || !may_differ(odd.len(), repeated.len()) {
            return;
        }
        self.odd = odd.into_iter().map(|((sample, _), k)| (k, *sample)).collect();
        self.period = period;
        self.kept.truncate(first + period);
        self.kept.shrink_to_fit();
    }

    /// Keeps all samples one by one, and looks for laps anew.
    fn unfold(&mut self) {
        self.kept = (0..self.n).map(|k| *self.get(k)).collect();
        self.look_anew();
    }

    fn look_anew(&mut self) {
        self.period = 0;
        self.odd.clear();
        self.watch = Watch { anchor: self.kept.len().saturating_sub(1), ..Watch::default() };
    }

    fn truncate(&mut self, n: usize) {
        if n >= self.n {
            return;
        }
        self.n = n;
        if n <= self.kept.len() {
            self.kept.truncate(n);
            self.look_anew();
        } else {
            let n_odd = self.odd.partition_point(|(k, _)| *k < n);
            self.odd.truncate(n_odd);
        }
    }

    /// How many whole laps of the first `n` samples can go so that one is still repeated.
    const fn n_idle(&self, n: usize) -> usize {
        match n.saturating_sub(self.kept.len()).checked_div(self.period) {
            Some(n_laps) => n_laps.saturating_sub(1) * self.period,
            None => 0,
        }
    }
}

impl SampleList {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.runs.last().map_or(0, |run| run.before + run.n)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them.
    pub fn get(&self, k: usize) -> Option<&Sample> {
        let run = &self.runs[self.runs.partition_point(|run| run.before <= k).checked_sub(1)?];
        (k - run.before < run.n).then(|| run.get(k - run.before))
    }

    /// The last one.
    pub fn last(&self) -> Option<&Sample> {
        self.get(self.len().checked_sub(1)?)
    }

    /// All of them in order of time.
    pub fn iter(&self) -> impl Iterator<Item = &Sample> + Clone {
        self.runs.iter().flat_map(|run| (0..run.n).map(|k| run.get(k)))
    }

    /// Adds one.
    pub fn push(&mut self, sample: Sample) {
        let rest = match self.runs.last_mut() {
            Some(run) => run.push(sample),
            None => Some(sample),
        };
        if let Some(sample) = rest {
            let mut run = Run { before: self.len(), ..Run::default() };
            run.push(sample);
            self.runs.push(run);
        }
    }

    /// Leaves the first ones.
    pub fn truncate(&mut self, n: usize) {
        let n_runs = self.runs.partition_point(|run| run.before < n);
        self.runs.truncate(n_runs);
        if let Some(run) = self.runs.last_mut() {
            run.truncate(n - run.before);
        }
    }

    /// Takes off all but the first ones, and gives them.
    #[must_use]
    pub fn split_off(&mut self, n: usize) -> Self {
        let rest = self.iter().skip(n).copied().collect();
        self.truncate(n);
        rest
    }

    /// What they take, bytes.
    pub fn n_bytes(&self) -> usize {
        let of = |run: &Run| size_of::<Run>() + size_of_val(&*run.kept) + size_of_val(&*run.odd);
        self.runs.iter().map(of).sum()
    }

    /// What of the first `n` samples there is to see: laps that repeat come twice at most.
    pub fn seen(&self, n: usize) -> Cow<'_, [Sample]> {
        if let [run] = &self.runs[..]
            && n <= run.kept.len()
        {
            return Cow::Borrowed(&run.kept[..n]);
        }
        let mut seen = Vec::new();
        for run in &self.runs {
            let n = n.saturating_sub(run.before).min(run.n);
            let (n_kept, n_idle) = (run.kept.len(), run.n_idle(n));
            let places = (0..n.min(n_kept)).chain(n_kept + n_idle..n);
            seen.extend(places.map(|k| *run.get(k)));
        }
        Cow::Owned(seen)
    }

    /// How many of those that [are seen](Self::seen) of the first `of` samples are among the first `n`.
    pub fn n_seen(&self, n: usize, of: usize) -> usize {
        let of = |run: &Run| {
            let [all, n] = [of, n.min(of)].map(|n| n.saturating_sub(run.before).min(run.n));
            n - run.n_idle(all).min(n.saturating_sub(run.kept.len()))
        };
        self.runs.iter().map(of).sum()
    }
}

impl Index<usize> for SampleList {
    type Output = Sample;

    fn index(&self, k: usize) -> &Sample {
        self.get(k).expect("a place in the list")
    }
}

impl Extend<Sample> for SampleList {
    fn extend<T: IntoIterator<Item = Sample>>(&mut self, samples: T) {
        samples.into_iter().for_each(|sample| self.push(sample));
    }
}

impl FromIterator<Sample> for SampleList {
    fn from_iter<T: IntoIterator<Item = Sample>>(samples: T) -> Self {
        let mut list = Self::default();
        list.extend(samples);
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Vector;

    fn sample(x: f64, y: f64) -> Sample {
        Sample { at: Point::new(x, y), missed: false }
    }

    /// A place on a circle that is passed in so many steps.
    fn on_circle(k: usize, per_turn: usize) -> Sample {
        let angle = (k % per_turn) as f64 * std::f64::consts::TAU / per_turn as f64;
        Sample { at: Vector::polar(2.0, angle).to_point(), missed: false }
    }

    fn check(list: &SampleList, wanted: &[Sample]) {
        assert_eq!(list.len(), wanted.len());
        assert!(list.iter().zip(wanted).all(|(a, b)| is_same(a, b)));
        for k in (0..wanted.len()).step_by(7) {
            assert!(is_same(&list[k], &wanted[k]), "at {k}");
        }
        assert!(list.get(wanted.len()).is_none());
    }

    #[test]
    fn a_hundred_laps_take_the_room_of_one() {
        for per_turn in [24, 100, 360, 3000] {
            let samples: Vec<Sample> =
                (0..100 * per_turn).map(|k| on_circle(k, per_turn)).collect();
            let list: SampleList = samples.iter().copied().collect();
            check(&list, &samples);
            let one = size_of::<Run>() + per_turn * size_of::<Sample>();
            assert_eq!(list.n_bytes(), one, "{per_turn} a turn");
            assert!(list.seen(list.len()).len() <= 3 * per_turn);
        }
    }

    #[test]
    fn what_differs_in_its_last_digits_is_kept_as_it_is() {
        let mut samples: Vec<Sample> = (0..3600).map(|k| on_circle(k, 360)).collect();
        for lap in 0..10 {
            samples[360 * lap + 180].at.y = 1e-16 * lap as f64;
        }
        let list: SampleList = samples.iter().copied().collect();
        check(&list, &samples);
        assert!(list.n_bytes() < 400 * size_of::<Sample>(), "{} bytes", list.n_bytes());
        // What can be seen to be elsewhere begins another run.
        samples[2000].at.y += 1e-9;
        let list: SampleList = samples.iter().copied().collect();
        check(&list, &samples);
        assert!(list.seen(list.len()).iter().any(|s| is_same(s, &samples[2000])));
    }

    #[test]
    fn what_is_seen_leads_from_the_first_to_the_last_sample() {
        // Ten laps and a piece, then along another circle.
        let mut samples: Vec<Sample> = (0..3700).map(|k| on_circle(k, 360)).collect();
        samples.extend((0..5000).map(|k| {
            let Sample { at, .. } = on_circle(k, 90);
            sample(3.0 * at.x, 3.0 * at.y)
        }));
        let list: SampleList = samples.iter().copied().collect();
        check(&list, &samples);
        let longest = samples.windows(2).map(|s| s[0].at.distance(s[1].at)).fold(0.0, f64::max);
        for n in [0, 1, 359, 720, 1081, 3699, 3700, 3701, 8700] {
            let seen = list.seen(n);
            assert_eq!(seen.is_empty(), n == 0);
            assert!(seen.windows(2).all(|s| s[0].at.distance(s[1].at) <= longest), "{n}");
            if n > 0 {
                assert!(is_same(&seen[seen.len() - 1], &samples[n - 1]), "{n}");
            }
        }
        assert!(list.seen(8700).len() < 1600);
        assert_eq!(list.n_seen(8700, 8700), list.seen(8700).len());
        assert_eq!([0, 1, 300].map(|n| list.n_seen(n, 8700)), [0, 1, 300]);
        assert_eq!([720, 3000].map(|n| list.n_seen(n, 720)), [720, 720]);
    }

    #[test]
    fn points_that_rest_between_have_laps_too() {
        // A quarter of the time it moves.
        let place = |k: usize| sample((k % 400).min(100) as f64, 0.0);
        let samples: Vec<Sample> = (0..8000).map(place).collect();
        let list: SampleList = samples.iter().copied().collect();
        check(&list, &samples);
        assert!(list.n_bytes() < 1000 * size_of::<Sample>(), "{} bytes", list.n_bytes());
    }

    /// Numbers that look drawn by lot, below `most`.
    fn lots() -> impl FnMut(usize) -> usize {
        let mut state = 1_u64;
        move |most| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % most
        }
    }

    /// Whatever is put in, taken off and put in again, it is as a plain list.
    #[test]
    fn it_holds_what_was_put_in() {
        let mut lot = lots();
        for _ in 0..200 {
            let (mut list, mut wanted) = (SampleList::default(), Vec::new());
            for _ in 0..=lot(10) {
                let (per_turn, n, noise, cut) = (1 + lot(120), lot(700), lot(8), lot(5));
                for k in 0..n {
                    let mut sample = on_circle(k, per_turn);
                    match noise {
                        0 if k % 50 == 49 => sample.at.x += 4e-16,
                        1 if k == n / 2 => sample.missed = true,
                        2 if k % 97 == 96 => sample.at.y += 1e-6,
                        3 => sample.at.x += 1e-15 * (k / per_turn) as f64,
                        _ => {}
                    }
                    list.push(sample);
                    wanted.push(sample);
                }
                let left = wanted.len() - wanted.len() * cut / 8;
                let rest = list.split_off(left);
                let taken = wanted.split_off(left);
                check(&rest, &taken);
                if cut % 2 == 1 {
                    list.extend(rest.iter().copied());
                    wanted.extend(taken);
                }
                check(&list, &wanted);
                assert_eq!(list.seen(list.len()).last(), wanted.last());
                assert_eq!(list.last(), wanted.last());
            }
        }
    }
}
