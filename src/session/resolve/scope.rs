//! What a name means where it stands: bindings of a block, members of an instance, the world.

use super::scopes::{Bound, Scope, Scopes, lost};
use crate::diag::{Diagnostic, Likeness, Sources, Span, format_number, nearest};
use crate::errors;
use crate::lang::ast::{Axis, Function, Name, PartKind};
use crate::session::quotas::Quotas;
use crate::session::state::State;
use crate::terms::{Member, Statistic};
use crate::world::{ConstraintId, Entity, Formula, MeasureId, NameText, PointId, Turning};

/// Names that have a meaning of their own in every expression.
pub const RESERVED: [&str; 3] = ["pi", "tau", "time"];

/// The word for every point.
pub const ALL: &str = "all";

/// Few names have more bytes.
const USUAL_NAME: usize = 24;

/// What names and expressions mean where a statement stands.
pub struct Resolver<'a> {
    /// What the names are names of. The solver is asked for velocities; what it takes in for
    /// that it forgets again.
    pub state: &'a mut State,
    scopes: &'a mut Scopes,
    sources: &'a Sources,
    /// How much an expression may be.
    pub(super) quotas: &'a Quotas,
}

/// What a name in an expression stands for.
#[derive(Debug, Clone)]
pub enum Meaning {
    /// What a block binds.
    Bound(Bound),
    /// Something with a name.
    Entity(Entity),
    /// A member of a constraint.
    Member(ConstraintId, Member),
    /// A statistic of a measure.
    Statistic(MeasureId, Statistic),
}

impl<'a> Resolver<'a> {
    /// Names as they are in `scopes`; `sources` holds the text they stand in.
    pub fn new(
        state: &'a mut State,
        scopes: &'a mut Scopes,
        sources: &'a Sources,
        quotas: &'a Quotas,
    ) -> Self {
        Self { state, scopes, sources, quotas }
    }

    /// Wants counted how far something turns, from this statement on.
    pub(super) fn note_turning(&mut self, points: &[Formula]) {
        let points: Vec<PointId> = points.iter().filter_map(Formula::as_point).collect();
        self.scopes.turnings.extend(Turning::of(&points));
    }

    /// The text at a place.
    pub fn text(&self, span: Span) -> &str {
        self.sources.slice(span)
    }

    fn scope(&self) -> &Scope {
        self.scopes.innermost()
    }

    fn binding(&self, name: &Name) -> Option<&Bound> {
        let bindings = &self.scope().bindings;
        bindings.iter().rev().find(|(text, _)| *text == name.head.text).map(|(_, bound)| bound)
    }

    /// The text of the first `n_parts` parts of a name, indices evaluated.
    fn spell(&mut self, name: &Name, n_parts: usize) -> Result<String, Diagnostic> {
        // A loop spells millions of names: each in the room of the one before.
        let mut text = std::mem::take(&mut self.scopes.spelling);
        text.clear();
        text.reserve(USUAL_NAME);
        text.push_str(&name.head.text);
        for part in &name.parts[..n_parts] {
            match &part.kind {
                PartKind::Member(member) => {
                    text.push('.');
                    text.push_str(member);
                }
                PartKind::Index(index) => {
                    let value = self.number(index)?.round();
                    if value.abs() > 1e15 {
                        return Err(Diagnostic::error(
                            errors::OUT_OF_RANGE,
                            "an index this large names nothing",
                        )
                        .at(index.span, "no more than 1e15"));
                    }
                    text.push('[');
                    crate::diag::push_integer(&mut text, value as i64);
                    text.push(']');
                }
            }
        }
        Ok(text)
    }

    /// What has this name: a member of the present instance before anything outside.
    fn find(&self, text: &str) -> Option<Entity> {
        let prefix = &self.scope().prefix;
        if !prefix.is_empty()
            && let Some(entity) = self.state.world.names().get(&format!("{prefix}{text}"))
        {
            return Some(entity);
        }
        self.state.world.names().get(text)
    }

    /// What a name in an expression stands for, with the component taken of it, if any.
    pub(crate) fn meaning(&mut self, name: &Name) -> Result<(Meaning, Option<Axis>), Diagnostic> {
        let axis = match name.parts.last().map(|part| &part.kind) {
            Some(PartKind::Member(member)) => match &**member {
                "x" => Some(Axis::X),
                "y" => Some(Axis::Y),
                _ => None,
            },
            _ => None,
        };
        if let Some(bound) = self.binding(name) {
            let bound = bound.clone();
            if !bound.is_there(&self.state.world) {
                return Err(lost(name.span));
            }
            return match (name.parts.len(), axis) {
                (0, _) => Ok((Meaning::Bound(bound), None)),
                (1, Some(axis)) if !matches!(bound, Bound::Number(..)) => {
                    Ok((Meaning::Bound(bound), Some(axis)))
                }
                _ => Err(Diagnostic::error(
                    errors::NO_MEMBER,
                    format!("`{}` stands for one value here and has no parts", name.head.text),
                )
                .at(name.span, "only `.x` and `.y` of a vector")),
            };
        }
        let whole = self.spell(name, name.parts.len())?;
        if let Some(entity) = self.find(&whole) {
            self.scopes.spelling = whole;
            return Ok((Meaning::Entity(entity), None));
        }
        let word = match name.parts.last().map(|part| &part.kind) {
            Some(PartKind::Member(member)) => &**member,
            _ => "",
        };
        let (member, statistic) = (Member::named(word), Statistic::named(word));
        if axis.is_some() || member.is_some() || statistic.is_some() {
            let owner = self.spell(name, name.parts.len() - 1)?;
            let found = self.find(&owner);
            self.scopes.spelling = owner;
            if let (Some(Entity::Measure(id)), Some(which)) = (found, statistic) {
                return Ok((Meaning::Statistic(id, which), None));
            }
            match (found.filter(|_| statistic.is_none()), member) {
                (Some(entity), None) => return Ok((Meaning::Entity(entity), axis)),
                (Some(entity), Some(member)) => {
                    return Ok((self.member(entity, member, name.span)?, None));
                }
                (None, _) => {}
            }
        }
        Err(self.unknown(&whole, name.span))
    }

    /// What has this name.
    pub(crate) fn entity(&mut self, name: &Name) -> Result<Entity, Diagnostic> {
        self.entity_for(name, "a point, a constraint, a parameter or a measure")
    }

    /// What has this name, where `wanted` is expected.
    fn entity_for(&mut self, name: &Name, wanted: &str) -> Result<Entity, Diagnostic> {
        match self.meaning(name)? {
            (Meaning::Entity(entity), None) => Ok(entity),
            (Meaning::Bound(Bound::Point(id)), None) => Ok(Entity::Point(id)),
            (Meaning::Bound(bound), _) => {
                let value = match bound {
                    Bound::Number(n, _) => format!("the number {}", format_number(n)),
                    _ => "a value".to_owned(),
                };
                Err(Diagnostic::error(
                    errors::WRONG_SORT,
                    format!("`{}` stands for {value} here", name.head.text),
                )
                .at(name.span, format!("expected the name of {wanted}")))
            }
            (_, Some(_)) | (Meaning::Member(..) | Meaning::Statistic(..), None) => {
                let owner = self.spell(name, name.parts.len() - 1)?;
                let message = format!("`{}` is a value of `{owner}`", self.text(name.span));
                Err(Diagnostic::error(errors::WRONG_SORT, message)
                    .at(name.span, format!("expected the name of {wanted}")))
            }
        }
    }

    /// The point of this name.
    pub(crate) fn point(&mut self, name: &Name) -> Result<PointId, Diagnostic> {
        match self.entity_for(name, "a point")? {
            Entity::Point(id) => Ok(id),
            other => Err(self.wrong_kind(name, other, "a point")),
        }
    }

    /// The constraint of this name.
    pub(crate) fn constraint(&mut self, name: &Name) -> Result<ConstraintId, Diagnostic> {
        match self.entity_for(name, "a constraint")? {
            Entity::Constraint(id) => Ok(id),
            other => Err(self.wrong_kind(name, other, "a constraint")),
        }
    }

    fn wrong_kind(&self, name: &Name, is: Entity, wanted: &str) -> Diagnostic {
        let text = self.state.world.name_of(is);
        Diagnostic::error(errors::WRONG_SORT, format!("`{text}` is a {}", is.noun()))
            .at(name.span, format!("expected the name of {wanted}"))
    }

    /// The full name of an instance, if that is what the name says.
    pub(crate) fn instance(&mut self, name: &Name) -> Result<Option<String>, Diagnostic> {
        if self.binding(name).is_some() {
            return Ok(None);
        }
        let text = self.spell(name, name.parts.len())?;
        let inner = format!("{}{text}", self.scope().prefix);
        let names = self.state.world.names();
        Ok(if names.is_instance(&inner) {
            Some(inner)
        } else if names.is_instance(&text) {
            Some(text)
        } else {
            None
        })
    }

    /// The full text of a name to be given to something new.
    pub(crate) fn declare(&mut self, name: &Name) -> Result<NameText, Diagnostic> {
        if self.binding(name).is_some() {
            return Err(Diagnostic::error(
                errors::NAME_TAKEN,
                format!("`{}` stands for a value in this block", name.head.text),
            )
            .at(name.span, "choose another name"));
        }
        let mut text = self.spell(name, name.parts.len())?;
        let prefix = &self.scope().prefix;
        if !prefix.is_empty() {
            text.insert_str(0, prefix);
        }
        self.must_be_free(&text, name.span)?;
        let name = NameText::from(text.as_str());
        self.scopes.spelling = text;
        Ok(name)
    }

    /// The full text of a name that may be taken already.
    pub(crate) fn declared(&mut self, name: &Name) -> Result<String, Diagnostic> {
        let text = self.spell(name, name.parts.len())?;
        Ok(format!("{}{text}", self.scope().prefix))
    }

    /// Says what has a name that was to be given to something new.
    pub(crate) fn must_be_free(&self, text: &str, span: Span) -> Result<(), Diagnostic> {
        let names = self.state.world.names();
        if names.is_free(text) {
            return self.must_have_no_owner(text, span);
        }
        let noun = names.get(text).map_or("instance", Entity::noun);
        let article = if noun == "instance" { "an" } else { "a" };
        Err(Diagnostic::error(errors::NAME_TAKEN, format!("`{text}` is {article} {noun} already"))
            .at(span, "this name is taken")
            .help(match noun {
                "parameter" => format!("`let {text} = ...` changes it"),
                "constraint" => {
                    format!("`change {text} ...` changes it, `delete {text}` removes it")
                }
                "measure" => format!("`measure {text} = ...` begins it anew"),
                "point" => format!("`move {text} to (x, y)` moves it, `delete {text}` removes it"),
                _ => format!("`delete {text} cascade` removes it"),
            }))
    }

    /// Refuses a member of something that is no instance: `A.x` is a coordinate.
    fn must_have_no_owner(&self, text: &str, span: Span) -> Result<(), Diagnostic> {
        if !text.as_bytes().contains(&b'.') {
            return Ok(());
        }
        let names = self.state.world.names();
        for (dot, _) in text.match_indices('.') {
            let owner = &text[..dot];
            if let Some(entity) = names.get(owner) {
                if self.has_member(entity, &text[dot + 1..]) {
                    return Err(Diagnostic::error(
                        errors::NAME_TAKEN,
                        format!("`{text}` is a member of `{owner}`"),
                    )
                    .at(span, "this name has its meaning already"));
                }
                return Err(Diagnostic::error(
                    errors::NO_MEMBER,
                    format!("`{owner}` is a {}", entity.noun()),
                )
                .at(span, "only an instance of a definition has members")
                .help("choose a name without the dot"));
            }
        }
        Ok(())
    }

    /// Whether a thing has a member of this word.
    fn has_member(&self, of: Entity, word: &str) -> bool {
        match of {
            Entity::Constraint(id) => {
                Member::named(word).is_some_and(|member| self.state.world.has_member(id, member))
            }
            Entity::Measure(_) => Statistic::named(word).is_some(),
            Entity::Point(_) | Entity::Parameter(_) => false,
        }
    }

    /// The first free `{prefix}{stem}1`, `{prefix}{stem}2`, ...
    pub(crate) fn numbered(&mut self, stem: &str) -> String {
        let prefix = &self.scope().prefix;
        if prefix.is_empty() {
            self.state.world.numbered_name(stem)
        } else {
            let stem = format!("{prefix}{stem}");
            self.state.world.numbered_name(&stem)
        }
    }

    /// The error for a name that nothing has.
    pub(crate) fn unknown(&self, text: &str, span: Span) -> Diagnostic {
        let names = self.state.world.names();
        let problem = Diagnostic::error(errors::UNKNOWN_NAME, format!("unknown name `{text}`"));
        if names.is_instance(text) {
            let member = names
                .iter()
                .filter_map(|(name, _)| name.strip_prefix(text)?.strip_prefix('.').map(|_| name))
                .min();
            return Diagnostic::error(errors::WRONG_SORT, format!("`{text}` is an instance"))
                .at(span, "expected one of its members")
                .help(format!("for example `{}`", member.unwrap_or_default()));
        }
        let problem = problem.at(span, "nothing has this name");
        if let Some((first, last)) = self.siblings(text) {
            return problem.help(if first == last {
                format!("there is `{first}`")
            } else {
                format!("there are `{first}` to `{last}`")
            });
        }
        if let Some((owner, word)) = text.rsplit_once('.')
            && let Some(members) = self.find(owner).and_then(|entity| self.member_words(entity))
        {
            return problem.help(match nearest(word, members.iter().copied()) {
                Some(near) => format!("did you mean `{owner}.{near}`?"),
                None => format!("its members are `.{}`", members.join("`, `.")),
            });
        }
        if let Some((owner, word)) = text.rsplit_once('.')
            && Statistic::named(word).is_some()
            && self.find(owner).is_none()
        {
            return problem.help(format!("`measure {owner} = ...` follows a value that has one"));
        }
        let prefix = &self.scope().prefix;
        let likeness = Likeness::to(text);
        let is_like = |name: &&str| likeness.as_ref().is_some_and(|to| to.may_be(name));
        let bound = self.scope().bindings.iter().map(|(name, _)| &**name);
        let inside = names.iter().filter_map(|(name, _)| name.strip_prefix(prefix.as_str()));
        let all = names.iter().map(|(name, _)| name);
        let mut known: Vec<&str> = all.chain(inside).chain(bound).filter(is_like).collect();
        known.sort_unstable();
        // One letter is too near to `pi` to mean it.
        if text.chars().nth(1).is_some() {
            known.extend(RESERVED);
        }
        match (Function::named(text).next(), nearest(text, known.iter().copied())) {
            (Some(function), _) => {
                problem.help(format!("it is a function: `{}`", function.usage()))
            }
            (None, _) if text == ALL => problem.help(format!(
                "`{ALL}` stands behind `freeze`, `thaw` and `untrace`; `clear` empties the world"
            )),
            (None, Some(near)) => problem.help(format!("did you mean `{near}`?")),
            (None, None) => problem,
        }
    }

    /// The error for a name that nothing has where a word could have stood: says so if that was
    /// probably meant.
    pub(crate) fn or_word(&self, problem: Diagnostic, name: &Name, word: &str) -> Diagnostic {
        let text = self.text(name.span);
        if self.state.world.names().is_free(text) && nearest(text, [word]).is_some() {
            return problem.help(format!("did you mean the word `{word}`?"));
        }
        problem
    }

    /// The names that differ from this one in their last index only: the least and the
    /// greatest.
    fn siblings(&self, text: &str) -> Option<(String, String)> {
        let (stem, rest) = text.rsplit_once('[')?;
        let (_, end) = rest.split_once(']')?;
        let prefix = &self.scope().prefix;
        let index = |name: &str| -> Option<i64> {
            let name = name.strip_prefix(prefix.as_str()).unwrap_or(name);
            name.strip_prefix(stem)?
                .strip_prefix('[')?
                .strip_suffix(end)?
                .strip_suffix(']')?
                .parse()
                .ok()
        };
        let indices = || self.state.world.names().iter().filter_map(|(name, _)| index(name));
        let name = |index: i64| format!("{stem}[{index}]{end}");
        Some((name(indices().min()?), name(indices().max()?)))
    }
}
