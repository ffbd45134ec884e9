//! Points and parameters: making, moving, freezing.

use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{Binding, Expr, Name, PointDecl, Selection};
use crate::session::execution::Execution;
use crate::session::resolve::scope::{ALL, RESERVED};
use crate::world::{
    ConstraintId, Edit, Entity, Formula, NameText, ParameterId, PointId, PointRecord,
};

impl Execution<'_> {
    pub(crate) fn make_points(&mut self, declarations: &[PointDecl]) -> Result<(), Diagnostic> {
        for PointDecl { name, at, frozen } in declarations {
            debug_assert!(!RESERVED.contains(&&*name.head.text), "the parser refuses these");
            let at = self.resolve().place(at)?;
            let name = self.resolve().declare(name)?;
            let record = PointRecord { name, at, start: at, is_frozen: *frozen, weight: 1.0 };
            let id = self.state.world.next_point();
            self.edit(Edit::Point(id, Some(Box::new(record))));
        }
        Ok(())
    }

    pub(crate) fn let_parameters(&mut self, bindings: &[Binding]) -> Result<(), Diagnostic> {
        bindings.iter().try_for_each(|binding| self.let_parameter(&binding.name, &binding.value))
    }

    fn let_parameter(&mut self, name: &Name, value: &Expr) -> Result<(), Diagnostic> {
        let text = self.resolve().declared(name)?;
        let mut formula = self.resolve().live(value)?.into_formula(value.span);
        if let Some(given) = self.input.overrides.get_mut(&text) {
            given.is_used = true;
            self.input.is_unrepeatable = true;
            formula = Formula::constant(given.value);
        }
        if let Some(Entity::Parameter(id)) = self.state.world.names().get(&text) {
            return self.redefine(id, formula, value);
        }
        let text = self.resolve().declare(name)?;
        let id = self.state.world.next_parameter();
        self.set_parameter(id, text, formula)
    }

    /// Gives a parameter that exists another expression.
    pub(crate) fn redefine(
        &mut self,
        id: ParameterId,
        formula: Formula,
        value: &Expr,
    ) -> Result<(), Diagnostic> {
        let old = self.state.world.parameter(id).expect("a named parameter lives");
        let text = old.name.clone();
        self.refuse_cycle(Entity::Parameter(id), &formula, value.span)?;
        let (was, is) = (old.formula.shape(), formula.shape());
        if was != is && !self.state.world.users(&[Entity::Parameter(id)]).is_empty() {
            return Err(Diagnostic::error(
                errors::MIXED_SORTS,
                format!("`{text}` is a {} and used as one", was.noun()),
            )
            .at(value.span, format!("this is a {}", is.noun())));
        }
        self.set_parameter(id, text, formula)
    }

    pub(super) fn set_parameter(
        &mut self,
        id: ParameterId,
        name: NameText,
        formula: Formula,
    ) -> Result<(), Diagnostic> {
        let mut undo = Vec::new();
        let result = if self.state.is_restoring {
            self.state.world.restore_parameter(id, name, formula, &mut undo);
            Ok(())
        } else {
            self.state.world.set_parameter(id, name, formula, &mut undo)
        };
        for inverse in undo {
            self.history.keep(&self.state.world, inverse);
        }
        result
    }

    /// Refuses an expression by which something would depend on itself.
    pub(super) fn refuse_cycle(
        &self,
        of: Entity,
        formula: &Formula,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let world = &self.state.world;
        let Some(path) = world.cycle(of, formula) else { return Ok(()) };
        let text = world.name_of(of);
        let problem = Diagnostic::error(errors::CYCLE, format!("`{text}` would depend on itself"))
            .at(span, format!("this leads back to `{text}`"));
        let path: Vec<String> =
            path.into_iter().map(|entity| format!("`{}`", world.name_of(entity))).collect();
        Err(if path.len() == 1 {
            problem.help("an expression stays live; to count on, give the number itself")
        } else {
            problem.note(format!("`{text}` from {}", path.join(", that from ")))
        })
    }

    /// The points of a selection.
    pub(crate) fn selected(&mut self, selection: &Selection) -> Result<Vec<PointId>, Diagnostic> {
        match selection {
            Selection::All => Ok(self.state.world.points().ids().collect()),
            Selection::Names(names) => {
                let mut points = Vec::new();
                for name in names {
                    let point = self.resolve().point(name);
                    points
                        .push(point.map_err(|problem| self.resolve().or_word(problem, name, ALL))?);
                }
                Ok(points)
            }
        }
    }

    pub(crate) fn freeze(&mut self, selection: &Selection, freeze: bool) -> Result<(), Diagnostic> {
        for id in self.selected(selection)? {
            if self.state.world.points().is_frozen(id) != freeze {
                self.edit(Edit::Freeze(id, freeze));
            }
        }
        Ok(())
    }

    pub(crate) fn move_point(&mut self, point: &Name, to: &Expr) -> Result<(), Diagnostic> {
        let id = self.resolve().point(point)?;
        let at = self.resolve().place(to)?;
        self.edit(Edit::Move(id, at));
        Ok(())
    }

    /// Switches constraints, or all those of an instance.
    pub(crate) fn switch(&mut self, names: &[Name], on: bool) -> Result<(), Diagnostic> {
        for name in names {
            let ids = match self.resolve().instance(name)? {
                Some(instance) => {
                    let members = self.state.world.names().members(&instance);
                    let constraints = members.filter_map(|member| match member {
                        Entity::Constraint(id) => Some(id),
                        _ => None,
                    });
                    constraints.collect()
                }
                None => vec![self.resolve().constraint(name)?],
            };
            for id in ids {
                self.switch_one(id, on);
            }
        }
        Ok(())
    }

    fn switch_one(&mut self, id: ConstraintId, on: bool) {
        let record = self.state.world.constraint(id).expect("a named constraint lives");
        if record.is_on == on {
            return;
        }
        if on {
            // A motor goes on from where its point is now.
            let mut record = record.clone();
            record.constraint.pick_up(self.state.world.points().column());
            record.is_on = true;
            self.edit(Edit::Constraint(id, Some(Box::new(record))));
        } else {
            self.edit(Edit::Switch(id, false));
        }
    }
}
