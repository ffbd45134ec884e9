//! A constraint as stated becomes a record of the world.

use crate::constraint::{
    Bounds, Constraint, ConstraintKind as _, Culprit, Field, Flaw, Kind, Point, PointIdx, Refusal,
};
use crate::diag::{Diagnostic, Span, format_number};
use crate::errors;
use crate::lang::ast::{
    Constraint as Stated, ConstraintDecl, Expr, Name, Pair, Part, Range, Relation, Role,
};
use crate::lang::catalogue::{Pattern, Slot};
use crate::session::execution::Execution;
use crate::session::resolve::said::{Behind, Said, TEETH, field_of, flag_of};
use crate::session::resolve::scope::Resolver;
use crate::solve::CogForm;
use crate::terms::{Shape, Unit};
use crate::world::{Edit, Record, Value};

impl Execution<'_> {
    pub(crate) fn constrain(
        &mut self,
        declaration: &ConstraintDecl,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let stated = &declaration.constraint;
        let (constraint, Behind { drivers, units }) = self.resolve().build(stated, span)?;
        if !self.state.is_restoring {
            self.note_slips(&constraint, &stated.parts, &drivers);
        }
        let defined = stated.parts.iter().find_map(|part| match part {
            Part::Defined(name) => Some(name),
            _ => None,
        });
        if let (Some(label), Some(name)) = (&declaration.label, defined) {
            let text = self.resolve().text(name.span).to_owned();
            return Err(Diagnostic::error(
                errors::LABEL,
                format!("this has a name already: `{text}`"),
            )
            .at(label.span, "no label belongs here"));
        }
        let name = match declaration.label.as_ref().or(defined) {
            Some(label) => self.resolve().declare(label)?,
            None => self.resolve().numbered(stated.word.pattern().entry.keyword).into(),
        };
        let mut record = Record::new(name, constraint, drivers);
        record.set_units(&[], units);
        self.state.world.bind(&mut record);
        if !self.state.is_restoring {
            refuse_idle(&record.constraint, span)?;
            refuse_flaw(&record.constraint, &stated.parts, span)?;
        }
        let id = self.state.world.next_constraint();
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        self.begin_at_start(id);
        Ok(())
    }
}

impl Resolver<'_> {
    fn build(
        &mut self,
        Stated { word, parts }: &Stated,
        span: Span,
    ) -> Result<(Constraint, Behind), Diagnostic> {
        let pattern = word.pattern();
        let mut behind = Behind::default();
        let mut said = self.say(pattern, parts, &mut behind)?;
        said.is_restored = self.state.is_restoring;
        let word = pattern.entry.keyword;
        if word == "tangent" || parts.iter().any(|part| matches!(part, Part::Point(Role::On, _))) {
            self.say_touch(parts, &mut said, &mut behind.drivers, span)?;
        }
        let kind = Kind::stated_by(word).expect("each word states a kind");
        let kind = match (kind, self.state.preferences.solve.cog) {
            // A belt has no such form.
            (Kind::Glider, _) if !said.curves.is_empty() => Kind::Touch,
            (Kind::Cog, CogForm::Velocity) if word == "cog" => Kind::CogVelocity,
            _ => kind,
        };
        let constraint = said
            .declare(kind, word, self.state.world.points().column())
            .map_err(|refusal| refused(&refusal, parts, span))?;
        Ok((constraint, behind))
    }

    fn say(
        &mut self,
        pattern: &Pattern,
        parts: &[Part],
        behind: &mut Behind,
    ) -> Result<Said, Diagnostic> {
        let mut said = Said::default();
        let held = parts.iter().find_map(|part| match part {
            Part::Measure(expr) => Some(expr),
            _ => None,
        });
        let mut shape = Shape::Number;
        if let Some(held) = held {
            shape = self.say_held(held, &mut said.values, behind)?;
        }
        for part in parts {
            match part {
                Part::Point(Role::Through | Role::From | Role::To, name) => {
                    said.groups.push(vec![self.idx(name)?]);
                }
                // Lines, circles and arcs are looked up by who knows which is which.
                Part::Points(_) if pattern.slots.contains(&Slot::Touching) => {}
                Part::Points(names) => {
                    let points = names.iter().map(|name| self.idx(name));
                    said.groups.push(points.collect::<Result<_, _>>()?);
                }
                Part::Line(_, pair) => said.groups.push(self.ends(pair)?.to_vec()),
                Part::Relation(relation) if shape == Shape::Vector => {
                    let at = self.held_target(relation, behind)?;
                    said.values.extend([(Field::X, at.x), (Field::Y, at.y)]);
                }
                Part::Relation(relation) => said.bounds = Some(self.bounds(relation, behind)?),
                Part::Flag(role) => said.flags.push(flag_of(*role)),
                Part::Value(_, value) => {
                    self.say_value(pattern.slot(part), value, &mut said.values, behind)?;
                }
                Part::Values(_, teeth) => said.values.extend(self.teeth(teeth, behind)?),
                Part::Defined(_) | Part::Point(..) | Part::Measure(_) => {}
            }
        }
        Ok(said)
    }

    /// The numbers of teeth of two wheels.
    pub(super) fn teeth(
        &mut self,
        teeth: &[Expr; 2],
        behind: &mut Behind,
    ) -> Result<[(Field, f64); 2], Diagnostic> {
        let [first, second] = TEETH;
        Ok([
            (first, self.drive(&teeth[0], first, behind)?),
            (second, self.drive(&teeth[1], second, behind)?),
        ])
    }

    /// Evaluates the value of a part that goes into a slot.
    pub(super) fn say_value(
        &mut self,
        slot: Option<Slot>,
        value: &Expr,
        values: &mut Vec<(Field, f64)>,
        behind: &mut Behind,
    ) -> Result<(), Diagnostic> {
        match slot {
            Some(Slot::Place(_)) => {
                let at = self.target(value, behind)?;
                values.extend([(Field::X, at.x), (Field::Y, at.y)]);
            }
            Some(Slot::Value(role) | Slot::Optional(role, _)) => {
                let field = field_of(role);
                values.push((field, self.drive(value, field, behind)?));
            }
            Some(Slot::Gearing) => {
                values.push((Field::Ratio, self.drive(value, Field::Ratio, behind)?));
            }
            _ => {}
        }
        Ok(())
    }

    /// What is held, live if it can change; gives whether it is a number or a vector.
    fn say_held(
        &mut self,
        held: &Expr,
        values: &mut Vec<(Field, f64)>,
        behind: &mut Behind,
    ) -> Result<Shape, Diagnostic> {
        let (value, formula) = self.measure(held)?;
        let fields = match value {
            Value::Number(n) => vec![(Field::Value, n)],
            Value::Vector(v) => vec![(Field::Value, v.x), (Field::ValueY, v.y)],
        };
        if let Some(formula) = formula {
            behind.drivers.extend(fields.iter().map(|(field, _)| (*field, formula.clone())));
        }
        values.extend(fields);
        Ok(value.shape())
    }

    /// What a vector that is held has to be.
    pub(super) fn held_target(
        &mut self,
        relation: &Relation,
        behind: &mut Behind,
    ) -> Result<Point, Diagnostic> {
        match relation {
            Relation::Equal(value) => self.target(value, behind),
            relation => Err(Diagnostic::error(errors::MIXED_SORTS, "vectors have no order")
                .at(upper(relation).span, "only `=` can be held between vectors")
                .help("hold a coordinate of it: `hold A.x <= 4`")),
        }
    }

    pub(super) fn idx(&mut self, name: &Name) -> Result<PointIdx, Diagnostic> {
        Ok(self.point(name)?.0)
    }

    /// The points of a pair.
    pub(super) fn ends(&mut self, pair: &Pair) -> Result<[PointIdx; 2], Diagnostic> {
        Ok([self.idx(&pair.from)?, self.idx(&pair.to)?])
    }

    /// A place for a coordinate constraint, live if it can change.
    fn target(&mut self, at: &Expr, behind: &mut Behind) -> Result<Point, Diagnostic> {
        let (value, formula) = self.driver(at, Shape::Vector)?;
        if let Some(formula) = formula {
            behind.drivers.push((Field::X, formula.clone()));
            behind.drivers.push((Field::Y, formula));
        }
        match value {
            Value::Vector(v) => Ok(Point::new(v.x, v.y)),
            Value::Number(_) => unreachable!("the shape was asked for"),
        }
    }

    /// A number of a constraint, live if it can change.
    fn drive(&mut self, expr: &Expr, field: Field, behind: &mut Behind) -> Result<f64, Diagnostic> {
        let driven = self.driven(expr)?;
        if driven.unit != Unit::None {
            behind.units.push((field, driven.unit));
        }
        if let Some(formula) = driven.formula {
            behind.drivers.push((field, formula));
        }
        Ok(driven.value)
    }

    /// The interval that a relation allows.
    pub(super) fn bounds(
        &mut self,
        relation: &Relation,
        behind: &mut Behind,
    ) -> Result<Bounds, Diagnostic> {
        let (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
        Ok(match relation {
            Relation::Equal(e) => {
                let (n_drivers, n_units) = (behind.drivers.len(), behind.units.len());
                let value = self.drive(e, Field::Lo, behind)?;
                if let Some((_, formula)) = behind.drivers.get(n_drivers).cloned() {
                    behind.drivers.push((Field::Hi, formula));
                }
                if let Some(&(_, unit)) = behind.units.get(n_units) {
                    behind.units.push((Field::Hi, unit));
                }
                Bounds::exactly(value)
            }
            Relation::Less(e) | Relation::LessEqual(e) => {
                Bounds { lo: least, hi: self.drive(e, Field::Hi, behind)? }
            }
            Relation::Greater(e) | Relation::GreaterEqual(e) => {
                Bounds { lo: self.drive(e, Field::Lo, behind)?, hi: most }
            }
            Relation::In(Range { from, to }) => {
                let lo = self.drive(from, Field::Lo, behind)?;
                Bounds { lo, hi: self.drive(to, Field::Hi, behind)? }
            }
        })
    }
}

/// What is wrong with what parts of a statement give.
fn refused(refusal: &Refusal, parts: &[Part], statement: Span) -> Diagnostic {
    let groups = parts.iter().filter_map(|part| match part {
        Part::Points(names) => Some(names.iter().map(|name| name.span).collect()),
        Part::Line(_, pair) => Some(vec![pair.from.span, pair.to.span]),
        Part::Point(_, name) => Some(vec![name.span]),
        _ => None,
    });
    let groups: Vec<Vec<Span>> = groups.collect();
    let at = match refusal.at {
        Culprit::Statement => statement,
        Culprit::Group(group) => {
            let names = &groups[group];
            names[0].to(names[names.len() - 1])
        }
        Culprit::Point(group, point) => groups[group][point],
    };
    refusal_at(refusal, at)
}

/// What is wrong, at its place.
pub(super) fn refusal_at(refusal: &Refusal, at: Span) -> Diagnostic {
    let problem = Diagnostic::error(errors::DEGENERATE, refusal.message).at(at, refusal.label);
    match refusal.help {
        Some(help) => problem.help(help),
        None => problem,
    }
}

/// Refuses what is held although no point has a part in it.
fn refuse_idle(constraint: &Constraint, statement: Span) -> Result<(), Diagnostic> {
    if constraint.points().is_empty() {
        return Err(Diagnostic::error(
            errors::HOLDS_NOTHING,
            "no point has a part in this, so nothing can hold it",
        )
        .at(statement, "it does not measure the pose")
        .help("`assert` looks whether something is so"));
    }
    Ok(())
}

/// Why an angle cannot have a range like this.
const WIDE: &str = "this range is wider than one turn";
const HOLDS_NOTHING: &str =
    "an `orientation` is an angle within one turn, from -180deg to 180deg: this would hold nothing";

/// Refuses values that no pose could have; `parts` gave them.
pub(super) fn refuse_flaw(
    constraint: &Constraint,
    parts: &[Part],
    statement: Span,
) -> Result<(), Diagnostic> {
    let Some(flaw) = constraint.traits().flaw else { return Ok(()) };
    let relation = parts.iter().find_map(|part| match part {
        Part::Relation(relation) => Some(relation),
        _ => None,
    });
    let value = parts.iter().find_map(|part| match part {
        Part::Value(role, value) if field_of(*role) == flaw.field() => Some(value),
        Part::Values(_, values) => {
            TEETH.iter().position(|field| *field == flaw.field()).map(|k| &values[k])
        }
        _ => None,
    });
    let span = value.or(relation.map(upper)).map_or(statement, |value| value.span);
    let now = constraint.get(flaw.field()).map_or_else(String::new, format_number);
    let (message, at, label) = match (flaw, relation) {
        (Flaw::EmptyRange, Some(Relation::In(Range { from, to }))) => (
            "this range is empty",
            from.span.to(to.span),
            "its lower end is above its upper end".to_owned(),
        ),
        (Flaw::WiderThanATurn, Some(Relation::In(Range { from, to }))) => {
            (WIDE, from.span.to(to.span), HOLDS_NOTHING.to_owned())
        }
        (Flaw::WiderThanATurn, _) => (WIDE, span, HOLDS_NOTHING.to_owned()),
        (Flaw::EmptyRange, _) => {
            ("no angle is like this", span, "angles lie between -180deg and 180deg".to_owned())
        }
        (Flaw::NegativeLength, _) => {
            ("a length cannot be negative", span, format!("this is {now}"))
        }
        (Flaw::NoRadius, _) => ("a circle needs a radius above 0", span, format!("this is {now}")),
        (Flaw::NegativeRadius, _) => {
            ("a radius cannot be negative", span, format!("this is {now}"))
        }
        (Flaw::RatioNotAboveZero, _) => {
            ("a ratio of lengths has to be above 0", span, format!("this is {now}"))
        }
        (Flaw::FirstTeeth | Flaw::SecondTeeth, _) => (
            "a wheel has a whole number of teeth, from 1 to 100 000",
            span,
            format!("this is {now}"),
        ),
        (Flaw::NegativeBeltRatio, _) => {
            ("a ratio of radii cannot be negative", span, format!("this is {now}"))
        }
        (Flaw::ZeroRadius, _) => {
            ("a wheel of radius 0 does not roll", span, format!("this is {now}"))
        }
        (Flaw::ZeroRatio, _) => ("a ratio of radii cannot be 0", span, format!("this is {now}")),
    };
    let problem = Diagnostic::error(errors::NONSENSE_VALUE, message).at(at, label);
    Err(match flaw {
        Flaw::NegativeBeltRatio => {
            problem.help("for wheels that turn opposite ways write `crossed` behind the ratio")
        }
        _ => problem,
    })
}

/// The expression of a relation that says how large a value may be, if one does.
const fn upper(relation: &Relation) -> &Expr {
    match relation {
        Relation::Equal(e)
        | Relation::Less(e)
        | Relation::LessEqual(e)
        | Relation::Greater(e)
        | Relation::GreaterEqual(e)
        | Relation::In(Range { to: e, .. }) => e,
    }
}
