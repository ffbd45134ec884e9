//! An island that is followed by its closed form, and what it keeps so that it can be followed in
//! another way at any time.

use super::{Island, corners, rounding};
use crate::constraint::Point;
use crate::solve::closed_form::{ClosedForm, Compiled, Found, Given};
use crate::solve::frame::predict::{self, Doubt};
use crate::solve::report::{NoStep, Status};

impl Island {
    /// Finds the pose at the end of a frame.
    ///
    /// # Errors
    /// Why the frame has to be followed in another way, from where everything still is.
    pub fn closed_frame(&mut self, tolerance: f64) -> Result<Found, NoStep> {
        if !self.is_under_way() || self.inputs.is_disturbed {
            return Err(NoStep::First);
        }
        let changed = self.inputs.constraints();
        if !changed.iter().all(|(_, before)| ClosedForm::asks(before)) {
            return Err(NoStep::Changed);
        }
        // What was compiled for other values takes the same constraints.
        if let Compiled::List(form) = &self.closed_form
            && !form.takes_all(changed)
        {
            return Err(NoStep::Changed);
        }
        let mut form = self.take_closed_form().ok_or(NoStep::Open)?;
        if !form.knows_pose() {
            self.swap_inputs();
            let fits = form.look(&self.x, &self.constraints);
            self.swap_inputs();
            if !fits {
                form = self.take_closed_form().ok_or(NoStep::Open)?;
            }
        }
        if !form.takes_all(self.inputs.constraints()) {
            // It is for what was there before this frame.
            form.outdate();
            self.closed_form = Compiled::List(form);
            return Err(NoStep::Changed);
        }
        form.drive(&self.inputs, &self.x, &self.constraints);
        let found = self.run_closed(&mut form, tolerance);
        if found.is_some() {
            self.history.advance();
            self.accept_pose();
        }
        self.closed_form = Compiled::List(form);
        found.ok_or(NoStep::Unproved)
    }

    /// Whether it is where the last frame left it, and everything holds there.
    pub fn is_under_way(&self) -> bool {
        self.status == Status::Converged && !self.is_new && !self.is_edited
    }

    /// Runs its list of steps. The pose that the frame began with is kept, and put back where the
    /// list does not lead to another within the tolerance.
    #[inline]
    pub fn run_closed(&mut self, form: &mut ClosedForm, tolerance: f64) -> Option<Found> {
        self.history.begin(&self.x[..self.n_free], form.degree);
        if form.has_blocks {
            form.expect(&self.history, &self.x);
        }
        let found = form.run(&mut self.x, &self.constraints);
        let is_met = found.worst <= self.enough(form, tolerance) || found.worst <= self.rounding();
        if !is_met {
            self.put_back(form);
        }
        is_met.then_some(found)
    }

    /// The distance to satisfaction that a tolerance leaves: the size is at least the longest length
    /// that is asked for, and that of each body.
    pub fn enough(&self, form: &ClosedForm, tolerance: f64) -> f64 {
        tolerance * self.wanted().max(form.extent)
    }

    /// Puts everything back where the frame began.
    pub fn put_back(&mut self, form: &mut ClosedForm) {
        self.x[..self.n_free].copy_from_slice(self.history.origin());
        form.forget_pose();
    }

    /// What rounding leaves of numbers as large as those of the points that stand still.
    pub fn rounding(&self) -> f64 {
        let still = &self.x[self.n_free..];
        rounding(still.iter().fold(0.0, |most: f64, p| most.max(p.x.abs()).max(p.y.abs())))
    }

    /// Lends the list of steps that finds its pose; none if it has none.
    pub fn take_closed_form(&mut self) -> Option<Box<ClosedForm>> {
        match std::mem::take(&mut self.closed_form) {
            Compiled::List(form) if !form.is_outdated() => Some(form),
            Compiled::NotYet | Compiled::List(_) => {
                let form = self.compile();
                if form.is_none() {
                    self.closed_form = Compiled::Impossible;
                }
                form
            }
            Compiled::Impossible => {
                self.closed_form = Compiled::Impossible;
                None
            }
        }
    }

    /// How many constraints a frame by the list of steps evaluates.
    pub fn n_closed(&self) -> u32 {
        match &self.closed_form {
            Compiled::List(form) => form.n_constraints(),
            Compiled::NotYet | Compiled::Impossible => 0,
        }
    }

    /// The pose was reached by the list of steps, from one at which the island was of this size.
    pub fn note_closed_form(&mut self, found: &Found, size: f64, doubt: &Doubt) {
        self.are_sides_old = true;
        if found.is_sensitive() {
            let least_side = found.least_side();
            self.position_error =
                predict::position_error(self, found.worst, least_side, size, doubt);
        }
    }

    /// Frames were passed by the list of steps, the last of which left this.
    pub fn end_stretch(&mut self, worst: f64, n_constraints: u32) {
        self.begin_change();
        // Values that follow time went on with it.
        self.still.take();
        self.before = None;
        self.residual = worst / self.size_before();
        self.n_evaluations = n_constraints;
        self.are_sides_old = true;
    }

    /// What follows reaches poses in another way than by the list of steps. Its constraints and
    /// points may be those at the end of a frame already: sides are those of its beginning.
    pub fn leave_closed_form(&mut self) {
        if let Compiled::List(form) = &mut self.closed_form {
            form.forget_pose();
        }
        if self.are_sides_old {
            self.swap_inputs();
            self.know_sides();
            self.swap_inputs();
        }
    }

    /// Works out on which side of its singular pose each block is, unless that is known.
    pub fn know_sides(&mut self) {
        if std::mem::take(&mut self.are_sides_old) {
            self.update_sides();
        }
    }

    /// How large it was at the pose that the last frame that counts began with, as
    /// [`size`](Self::size) says.
    pub fn size_before(&self) -> f64 {
        self.size_at(self.history.past(1).iter().copied())
    }

    /// The same where the free points are there.
    pub fn size_at(&self, free: impl Iterator<Item = Point>) -> f64 {
        let still = self.x[self.n_free..].iter().copied();
        self.size_between(corners(free.chain(still)))
    }

    /// What its size is at least, wherever its free points are.
    pub fn least_size(&self) -> f64 {
        let (lo, hi) = corners(self.x[self.n_free..].iter().copied());
        (hi.x - lo.x).max(hi.y - lo.y).max(self.wanted())
    }

    /// The list of steps for the pose that the frame begins with.
    fn compile(&mut self) -> Option<Box<ClosedForm>> {
        self.swap_inputs();
        let form = ClosedForm::new(Given {
            plan: &self.plan,
            constraints: &self.constraints,
            x: &self.x,
            n_free: self.n_free,
            w: &self.w,
            degree: self.highest_degree(),
        });
        let form = form.map(|mut form| {
            form.look(&self.x, &self.constraints);
            Box::new(form)
        });
        self.swap_inputs();
        form
    }
}
