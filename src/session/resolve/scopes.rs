//! The blocks and instances around a statement, and what their variables and parameters stand for.

use std::sync::Arc;

use smallvec::{SmallVec, smallvec};

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::terms::Unit;
use crate::world::{Formula, PointId, Turning, World};

/// The blocks and instances around a statement.
#[derive(Debug)]
pub struct Scopes {
    /// The innermost last; the outermost is never left.
    stack: SmallVec<[Scope; 1]>,
    /// Room for the text of a name.
    pub(super) spelling: String,
    /// What the statement under way wants counted.
    pub(super) turnings: Vec<Turning>,
}

impl Default for Scopes {
    fn default() -> Self {
        Self { stack: smallvec![Scope::default()], spelling: String::new(), turnings: Vec::new() }
    }
}

impl Scopes {
    /// The scope of an instance begins.
    pub fn enter(&mut self, scope: Scope) {
        self.stack.push(scope);
    }

    /// The scope entered last ends.
    pub fn leave(&mut self) {
        self.stack.pop();
    }

    /// Binds a loop variable in the innermost scope; gives its place there.
    pub fn bind(&mut self, name: Arc<str>, value: f64) -> usize {
        let bindings = &mut self.innermost_mut().bindings;
        bindings.push((name, Bound::Number(value, Unit::None)));
        bindings.len() - 1
    }

    /// Gives a loop variable of the innermost scope another value.
    pub fn rebind(&mut self, place: usize, value: f64) {
        self.innermost_mut().bindings[place].1 = Bound::Number(value, Unit::None);
    }

    /// Forgets a loop variable of the innermost scope.
    pub fn unbind(&mut self, place: usize) {
        self.innermost_mut().bindings.truncate(place);
    }

    /// All that parameters stand for is gone, but for numbers.
    pub fn lose_all(&mut self) {
        let bindings = self.stack.iter_mut().flat_map(|scope| &mut scope.bindings);
        for (_, bound) in bindings.filter(|(_, bound)| !matches!(bound, Bound::Number(..))) {
            *bound = Bound::Lost;
        }
        self.turnings.clear();
    }

    /// What was to be counted since this was last asked for.
    pub fn take_turnings(&mut self) -> Vec<Turning> {
        std::mem::take(&mut self.turnings)
    }

    pub(super) fn innermost(&self) -> &Scope {
        self.stack.last().expect("the outermost scope is never left")
    }

    fn innermost_mut(&mut self) -> &mut Scope {
        self.stack.last_mut().expect("the outermost scope is never left")
    }
}

/// The names that a block or an instance adds.
#[derive(Debug, Default)]
pub struct Scope {
    /// What is put before a name that is declared here: `left.`, or nothing.
    pub prefix: String,
    /// Loop variables and parameters of a definition, the innermost last.
    pub bindings: Vec<(Arc<str>, Bound)>,
}

/// What a loop variable or a parameter of a definition stands for.
#[derive(Debug, Clone)]
pub enum Bound {
    /// A value that does not change, and the unit that it is said in.
    Number(f64, Unit),
    /// A live expression.
    Formula(Formula),
    /// A point, itself.
    Point(PointId),
    /// What it was is of a world that was cleared.
    Lost,
}

impl Bound {
    /// Whether all that it stands for is there.
    pub(super) fn is_there(&self, world: &World) -> bool {
        match self {
            Self::Number(..) => true,
            Self::Formula(formula) => world.has_all(formula),
            Self::Point(id) => world.points().is_alive(*id),
            Self::Lost => false,
        }
    }
}

/// What is wrong where a parameter stands for what was deleted since it was given.
pub(super) fn lost(span: Span) -> Diagnostic {
    Diagnostic::error(errors::UNKNOWN_NAME, "what this stands for is gone")
        .at(span, "it was deleted within this definition")
}
