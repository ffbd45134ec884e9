//! A symbol: one thing to be drawn, in any of its forms.

use std::sync::Arc;

use super::draw::Draw;
use super::{
    Angle, Arrows, AxisMark, Belt, Block, Construction, Cord, Crank, Cross, Dimension, Equation,
    Joint, Link, Multiple, Plate, Rail, Ring, Rod, Round, Symmetry, Telescope, Ticks, TouchMark,
    Train, Web,
};
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::Key;
use crate::render::page::BoundingBox;

macro_rules! forms {
    ($($Name:ident)*) => {
        /// What a symbol is drawn as.
        #[derive(Debug, Clone, PartialEq)]
        pub enum SymbolForm {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](", stringify!($Name), ").")]
                $Name($Name),
            )*
        }

        $(
            impl From<$Name> for SymbolForm {
                fn from(form: $Name) -> Self {
                    Self::$Name(form)
                }
            }
        )*

        impl Draw for SymbolForm {
            fn points(&self) -> Vec<PointIdx> {
                match self { $(Self::$Name(form) => form.points(),)* }
            }
            fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
                match self { $(Self::$Name(form) => form.extend(at, bounds),)* }
            }
            fn draw(&self, canvas: &mut Canvas) {
                match self { $(Self::$Name(form) => form.draw(canvas),)* }
            }
        }
    };
}
forms! {
    Rod Cord Telescope Link Plate Web Crank Rail Train Joint
    Cross Ring Ticks Arrows Angle Dimension Construction AxisMark
    Symmetry Multiple Belt Round Block TouchMark Equation
}

/// One thing to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    /// Whose it is.
    pub key: Key,
    /// Its name.
    pub name: Arc<str>,
    /// Whether it is switched off.
    pub is_off: bool,
    /// What it is drawn as.
    pub form: SymbolForm,
}

impl Symbol {
    /// The points it hangs on.
    pub fn points(&self) -> Vec<PointIdx> {
        self.form.points()
    }

    /// Grows the box to hold it.
    pub fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
        for p in self.form.points() {
            bounds.include(at[p as usize]);
        }
        self.form.extend(at, bounds);
    }

    /// Draws it.
    pub fn draw(&self, canvas: &mut Canvas) {
        canvas.begin(self.key, self.is_off, Some(self.name.clone()));
        self.form.draw(canvas);
    }

    /// The ends of the bar it is; none for other symbols.
    pub const fn bar_ends(&self) -> Option<[PointIdx; 2]> {
        match &self.form {
            SymbolForm::Rod(rod) => Some(rod.points),
            SymbolForm::Crank(crank) => Some(crank.points),
            SymbolForm::Link(link) => Some(link.ends),
            SymbolForm::Telescope(telescope) => Some(telescope.points),
            _ => None,
        }
    }

    /// The length of the bar it is; none for other symbols.
    pub fn bar_length(&self, at: &[Point]) -> Option<f64> {
        let [a, b] = self.bar_ends()?;
        Some(at[a as usize].distance(at[b as usize]))
    }
}
