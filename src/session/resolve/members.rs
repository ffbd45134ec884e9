//! Members of things: which there are, and what they cannot be used for.

use super::bind::{Mode, Term};
use super::scope::{Meaning, Resolver};
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::session::quotas::{DEEPEST_EXPRESSION, Quota};
use crate::terms::{Member, Shape, Statistic};
use crate::world::{ConstraintId, Depends, Entity, Extent, Formula, MeasureId, Node};

impl Resolver<'_> {
    /// The members that a constraint has.
    pub(super) fn members(&self, id: ConstraintId) -> impl Iterator<Item = Member> {
        let world = &self.state.world;
        Member::ALL.into_iter().filter(move |&member| world.has_member(id, member))
    }

    /// The words of the members of a thing that has some.
    pub(super) fn member_words(&self, of: Entity) -> Option<Vec<&'static str>> {
        match of {
            Entity::Constraint(id) => Some(self.members(id).map(Member::word).collect()),
            Entity::Measure(_) => Some(Statistic::ALL.map(Statistic::word).to_vec()),
            Entity::Point(_) => Some(vec!["x", "y"]),
            Entity::Parameter(_) => None,
        }
    }

    /// A member of something with a name.
    pub(super) fn member(
        &self,
        of: Entity,
        member: Member,
        span: Span,
    ) -> Result<Meaning, Diagnostic> {
        let world = &self.state.world;
        let (name, word) = (world.name_of(of), member.word());
        let Entity::Constraint(id) = of else {
            return Err(Diagnostic::error(
                errors::NO_MEMBER,
                format!("`{name}` is a {}", of.noun()),
            )
            .at(span, format!("only a constraint has a member `.{word}`")));
        };
        if world.has_member(id, member) {
            return Ok(Meaning::Member(id, member));
        }
        let others = self.members(id).map(|other| format!("`{name}.{}`", other.word()));
        let others: Vec<String> = others.collect();
        let label = match member {
            Member::Angle => "only a motor has an angle",
            Member::Radius => "only a circle or an arc has a radius",
            _ => "it measures no single number",
        };
        Err(Diagnostic::error(errors::NO_MEMBER, format!("`{name}` has no `.{word}`"))
            .at(span, label)
            .help(format!("there is {}", others.join(" and "))))
    }

    /// The term that a member of a constraint becomes.
    pub(super) fn bind_member(
        &mut self,
        id: ConstraintId,
        member: Member,
        span: Span,
        mode: Mode,
    ) -> Result<Term, Diagnostic> {
        let follows = member.follows();
        let depends = Depends {
            on_angles: member == Member::Angle,
            // What it depends on is known where it is looked up, as of a parameter.
            on_parameters: matches!(member, Member::Radius | Member::Value),
            on_constraints: follows,
            on_points: follows || member == Member::Value,
            ..Depends::default()
        };
        let formula = Formula::new(Node::Member(id, member), Shape::Number, depends, span);
        match mode {
            Mode::Live => Ok(Term::Live(formula)),
            Mode::Now => self.evaluate(&formula).map(Term::plain),
        }
    }

    /// The term that a statistic of a measure becomes.
    pub(super) fn bind_statistic(
        &mut self,
        id: MeasureId,
        which: Statistic,
        span: Span,
        mode: Mode,
    ) -> Result<Term, Diagnostic> {
        let depends = Depends { on_measures: true, ..Depends::default() };
        let formula = Formula::new(Node::Statistic(id, which), Shape::Number, depends, span);
        match mode {
            Mode::Live => Ok(Term::Live(formula)),
            Mode::Now => self.evaluate(&formula).map(Term::plain),
        }
    }

    /// Refuses an expression that is too long, or too deep, with all that it mentions: every level of
    /// members of members, each mentioned twice, doubles it.
    pub(super) fn refuse_too_long(&self, formula: &Formula, span: Span) -> Result<(), Diagnostic> {
        let (n_terms, depth) = (self.quotas.n_terms(), DEEPEST_EXPRESSION);
        let most = Extent { n_terms, depth };
        if self.state.world.extent_within(formula, most).is_some() {
            return Ok(());
        }
        let word = Quota::Terms.word();
        let label =
            format!("more than {n_terms} terms, the limit `{word}`, or {depth} within each other");
        Err(Diagnostic::error(errors::TOO_MUCH, "this is too long with all that it mentions")
            .at(span, label)
            .help("`let name = ...` gives a part a name, and its value is then worked out once"))
    }

    /// Refuses to drive a constraint by what follows from the constraints.
    pub(super) fn refuse_what_follows(
        &self,
        formula: &Formula,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let depends = self.state.world.depends(formula);
        if depends.on_rates {
            return Err(Diagnostic::error(
                errors::NOT_A_DRIVER,
                "a velocity cannot drive a constraint",
            )
            .at(span, "velocities follow from the constraints"));
        }
        if depends.on_measures {
            return Err(Diagnostic::error(
                errors::NOT_A_DRIVER,
                "a measure cannot drive a constraint",
            )
            .at(span, "what is measured follows from the motion")
            .help("use it in `print`, `assert`, `result`, or a parameter that these use"));
        }
        let Some((id, member)) = self.state.world.following_member(formula) else { return Ok(()) };
        let name =
            format!("{}.{}", self.state.world.name_of(Entity::Constraint(id)), member.word());
        Err(Diagnostic::error(errors::NOT_A_DRIVER, format!("`{name}` cannot drive a constraint"))
            .at(span, "it follows from the constraints"))
    }
}
