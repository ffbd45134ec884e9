//! Constraints of one kind lie together, so that a pass over all of them has no branches
//! on the kind.

use super::kinds::with_kinds;
use super::{
    Cog, CogVelocity, Coincidence, Constraint, ConstraintMut, ConstraintRef, Coordinate, Distance,
    Equal, Equivalence, Glider, Hinge, Kind, Length, Motor, Orientation, Rack, Relation, Rigid,
};

/// The place of a constraint in its batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot {
    /// Which batch.
    pub kind: Kind,
    /// Where in the batch.
    pub idx: u32,
}

/// Sees each batch once, in the order of the kinds; empty ones are left out.
pub trait Visitor {
    /// Sees all constraints of one kind.
    fn visit<R: Relation>(&mut self, kind: Kind, items: &[R]);
}

/// Changes each batch once, in the order of the kinds; empty ones are left out.
pub trait VisitorMut {
    /// Changes all constraints of one kind.
    fn visit<R: Relation>(&mut self, kind: Kind, items: &mut [R]);
}

/// A constraint as the enum of all kinds holds it: itself, or in a box.
trait Held<T> {
    /// The constraint itself.
    fn open(self) -> T;
}

impl<T: Relation> Held<T> for T {
    fn open(self) -> T {
        self
    }
}

impl<T: Relation> Held<T> for Box<T> {
    fn open(self) -> T {
        *self
    }
}

macro_rules! define {
    ($($batch:ident $Name:ident ($Held:ty) $word:literal,)*) => {
        /// Constraints, sorted by kind; within a kind in the order they were added.
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct Batches {
            $(
                #[doc = concat!("Every [`", stringify!($Name), "`].")]
                pub $batch: Vec<$Name>,
            )*
        }

        impl Batches {
            /// Adds a constraint at the end of its batch.
            pub fn push(&mut self, constraint: Constraint) -> Slot {
                let kind = constraint.kind();
                let idx = match constraint {
                    $(
                        Constraint::$Name(c) => {
                            self.$batch.push(Held::open(c));
                            self.$batch.len() - 1
                        }
                    )*
                };
                Slot { kind, idx: idx as u32 }
            }

            /// The constraint in a slot that `push` gave.
            pub fn get(&self, slot: Slot) -> ConstraintRef<'_> {
                let idx = slot.idx as usize;
                match slot.kind {
                    $(Kind::$Name => ConstraintRef::$Name(&self.$batch[idx]),)*
                }
            }

            /// The same, for a change.
            pub fn get_mut(&mut self, slot: Slot) -> ConstraintMut<'_> {
                let idx = slot.idx as usize;
                match slot.kind {
                    $(Kind::$Name => ConstraintMut::$Name(&mut self.$batch[idx]),)*
                }
            }

            /// How many constraints there are of all kinds.
            pub fn len(&self) -> usize {
                0 $(+ self.$batch.len())*
            }

            /// Whether there are none.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Removes all, keeping the room they took.
            pub fn clear(&mut self) {
                $(self.$batch.clear();)*
            }

            /// Shows each batch that is not empty, in the order of the kinds.
            pub fn visit(&self, visitor: &mut impl Visitor) {
                $(
                    if !self.$batch.is_empty() {
                        visitor.visit(Kind::$Name, &self.$batch);
                    }
                )*
            }

            /// The same, for a change.
            pub fn visit_mut(&mut self, visitor: &mut impl VisitorMut) {
                $(
                    if !self.$batch.is_empty() {
                        visitor.visit(Kind::$Name, &mut self.$batch);
                    }
                )*
            }
        }
    };
}
with_kinds!(define);
