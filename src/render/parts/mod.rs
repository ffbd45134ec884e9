//! What a mechanism is drawn as, one file each: the points it hangs on, the room it takes,
//! how it is drawn.

mod angle;
mod arrows;
mod bar;
mod construction;
mod cord;
mod crank;
mod cross;
mod dimension;
mod joint;
mod link;
mod plate;
mod rail;
mod ring;
mod rod;
mod teeth;
mod telescope;
mod ticks;
mod train;
mod web;

pub use angle::Angle;
pub use arrows::Arrows;
pub use construction::Construction;
pub use cord::Cord;
pub use crank::{Crank, Sense};
pub use cross::Cross;
pub use dimension::Dimension;
pub use joint::{Foot, Joint};
pub use link::Link;
pub use plate::Plate;
pub use rail::Rail;
pub use ring::Ring;
pub use rod::Rod;
pub use telescope::Telescope;
pub use ticks::Ticks;
pub use train::{Gears, Train};
pub use web::Web;

use std::sync::Arc;

use super::canvas::Ink;
use super::figure::Key;
use super::page::Extent;
use crate::constraint::{Point, PointIdx};

/// What every form answers.
trait Draw {
    /// The points it hangs on.
    fn points(&self) -> Vec<PointIdx>;

    /// Grows the box by what it needs beyond its points.
    fn extend(&self, _at: &[Point], _extent: &mut Extent) {}

    /// Draws it.
    fn draw(&self, ink: &mut Ink);
}

macro_rules! forms {
    ($($Name:ident)*) => {
        /// What a part is drawn as.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Form {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](", stringify!($Name), ").")]
                $Name($Name),
            )*
        }

        $(
            impl From<$Name> for Form {
                fn from(form: $Name) -> Self {
                    Self::$Name(form)
                }
            }
        )*

        impl Draw for Form {
            fn points(&self) -> Vec<PointIdx> {
                match self { $(Self::$Name(form) => form.points(),)* }
            }
            fn extend(&self, at: &[Point], extent: &mut Extent) {
                match self { $(Self::$Name(form) => form.extend(at, extent),)* }
            }
            fn draw(&self, ink: &mut Ink) {
                match self { $(Self::$Name(form) => form.draw(ink),)* }
            }
        }
    };
}
forms! {
    Rod Cord Telescope Link Plate Web Crank Rail Train Joint
    Cross Ring Ticks Arrows Angle Dimension Construction
}

/// One thing to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Whose it is.
    pub key: Key,
    /// Its name.
    pub name: Arc<str>,
    /// Whether it is switched off.
    pub is_off: bool,
    /// What it is drawn as.
    pub form: Form,
}

impl Part {
    /// The points it hangs on.
    pub fn points(&self) -> Vec<PointIdx> {
        self.form.points()
    }

    /// Grows the box to hold it.
    pub fn extend(&self, at: &[Point], extent: &mut Extent) {
        for p in self.form.points() {
            extent.include(at[p as usize]);
        }
        self.form.extend(at, extent);
    }

    /// Draws it.
    pub fn draw(&self, ink: &mut Ink) {
        ink.begin(self.key, self.is_off, Some(self.name.clone()));
        self.form.draw(ink);
    }

    /// The length of the bar it is; none for other parts.
    pub fn bar_length(&self, at: &[Point]) -> Option<f64> {
        let [a, b] = match &self.form {
            Form::Rod(rod) => rod.points,
            Form::Crank(crank) => crank.points,
            Form::Link(link) => link.ends,
            Form::Telescope(telescope) => telescope.points,
            _ => return None,
        };
        Some(at[a as usize].distance(at[b as usize]))
    }
}
