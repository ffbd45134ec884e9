//! Gliders on circles and arcs, and tangents: what they measure, as formulas.

use crate::constraint::{Constraint, ConstraintKind as _, Curve, Field, PointIdx};
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{Name, Part, Role};
use crate::session::execution::Execution;
use crate::session::resolve::said::Said;
use crate::session::resolve::scope::Resolver;
use crate::terms::{Function, Member, Operator, Shape, Unit};
use crate::world::{ConstraintId, Depends, Drivers, Entity, Formula, Node, PointId};

/// One of two that touch.
enum Side {
    Line([PointIdx; 2]),
    Curve(ConstraintId),
}

/// Formulas that stand for a statement.
struct Builder {
    /// The place of the statement.
    span: Span,
}

impl Builder {
    fn number(&self, node: Node) -> Formula {
        let depends = Depends { on_points: true, on_parameters: true, ..Depends::default() };
        Formula::new(node, Shape::Number, depends, self.span)
    }

    fn vector(&self, node: Node) -> Formula {
        let depends = Depends { on_points: true, ..Depends::default() };
        Formula::new(node, Shape::Vector, depends, self.span)
    }

    fn point(&self, p: PointIdx) -> Formula {
        self.vector(Node::Point(PointId(p)))
    }

    fn call(&self, function: Function, points: &[PointIdx]) -> Formula {
        self.number(Node::Call(function, points.iter().map(|&p| self.point(p)).collect()))
    }

    fn binary(&self, operator: Operator, a: Formula, b: Formula) -> Formula {
        self.number(Node::Binary(operator, a, b))
    }

    fn constant(&self, value: f64) -> Formula {
        Formula::new(Node::Number(value, Unit::None), Shape::Number, Depends::default(), self.span)
    }

    fn radius(&self, id: ConstraintId) -> Formula {
        let depends = Depends { on_parameters: true, ..Depends::default() };
        Formula::new(Node::Member(id, Member::Radius), Shape::Number, depends, self.span)
    }

    /// How far P is beyond the nearer end of the arc from A to B round O, along the circle.
    fn beyond(&self, p: PointIdx, [o, a, b]: [PointIdx; 3]) -> Formula {
        let turn = |f, arguments: Vec<Formula>| self.number(Node::Call(f, arguments.into()));
        let between = self.call(Function::AngleBetween, &[o, a, o, b]);
        let whole = turn(Function::Mod, vec![between, self.constant(std::f64::consts::TAU)]);
        let half = self.binary(Operator::Multiply, whole, self.constant(0.5));
        let spoke = self.vector(Node::Binary(Operator::Subtract, self.point(a), self.point(o)));
        let middle = self.vector(Node::Call(Function::Rotate, [spoke, half.clone()].into()));
        let tip = self.vector(Node::Binary(Operator::Add, self.point(o), middle));
        let ends = vec![self.point(o), tip, self.point(o), self.point(p)];
        let from_middle = turn(Function::Abs, vec![turn(Function::AngleBetween, ends)]);
        let angle = self.binary(Operator::Subtract, from_middle, half);
        self.binary(Operator::Multiply, angle, self.call(Function::Distance, &[o, a]))
    }
}

impl Resolver<'_> {
    /// Looks up what a glider on a curve or a tangent names, and says what of it is measured.
    pub(super) fn say_touch(
        &mut self,
        parts: &[Part],
        said: &mut Said,
        drivers: &mut Drivers,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let build = Builder { span };
        let on = parts.iter().find_map(|part| match part {
            Part::Point(Role::On, name) => Some(name),
            _ => None,
        });
        let measured = if let Some(name) = on {
            self.say_glider(name, parts, said, &build)?
        } else {
            self.say_tangent(parts, said, &build)?
        };
        for (field, formula) in measured {
            let value = match self.state.world.evaluate(&formula, None) {
                Err(_) if self.state.is_restoring => 0.0,
                value => value?.number(),
            };
            said.values.push((field, value));
            drivers.push((field, formula));
        }
        Ok(())
    }

    fn say_glider(
        &mut self,
        name: &Name,
        parts: &[Part],
        said: &mut Said,
        build: &Builder,
    ) -> Result<Drivers, Diagnostic> {
        let c = self.curve(name)?;
        said.curves.push(c.0);
        let p = said.groups[0][0];
        let o = self.centre(c)[0];
        if !self.state.is_restoring {
            let place = parts.iter().find_map(|part| match part {
                Part::Points(names) => Some(names[0].span),
                _ => None,
            });
            self.refuse_own_point(p, c, place.unwrap_or(build.span))?;
        }
        let mut measured = vec![
            (Field::Value, build.call(Function::Distance, &[o, p])),
            (Field::Wanted, build.radius(c)),
        ];
        let is_whole = parts.iter().any(|part| matches!(part, Part::Flag(Role::Unbounded)));
        if let Some(Curve::Arc { points }) = self.state.world.curve(c).filter(|_| !is_whole) {
            measured.push((Field::Beyond, build.beyond(p, *points)));
        }
        Ok(measured)
    }

    fn say_tangent(
        &mut self,
        parts: &[Part],
        said: &mut Said,
        build: &Builder,
    ) -> Result<Drivers, Diagnostic> {
        let mut sides = Vec::new();
        let mut at = None;
        for part in parts {
            match part {
                Part::Points(names) => sides.push((self.side(names)?, names[0].span)),
                Part::Point(Role::At, name) => at = Some((self.idx(name)?, name)),
                _ => {}
            }
        }
        let [(first, _), (second, place)] = &sides[..] else {
            unreachable!("the grammar reads two sides")
        };
        let (line, curves) = match (first, second) {
            (Side::Line(_), Side::Line(_)) => {
                return Err(Diagnostic::error(errors::NO_TOUCH, "two lines do not touch")
                    .at(*place, "one of both has to be a circle or an arc")
                    .help("lines of one direction are `parallel A B, C D`"));
            }
            (Side::Line(ends), Side::Curve(c)) | (Side::Curve(c), Side::Line(ends)) => {
                (Some(*ends), vec![*c])
            }
            (Side::Curve(c), Side::Curve(d)) if c == d => {
                return Err(Diagnostic::error(errors::NO_TOUCH, "a circle does not touch itself")
                    .at(*place, "the same circle again"));
            }
            (Side::Curve(c), Side::Curve(d)) => (None, vec![*c, *d]),
        };
        said.curves = curves.iter().map(|c| c.0).collect();
        said.groups = line.iter().map(|ends| ends.to_vec()).collect();
        let centres: Vec<PointIdx> = curves.iter().map(|&c| self.centre(c)[0]).collect();
        if !self.state.is_restoring {
            refuse_one_centre(line, &centres, build.span)?;
        }
        if let Some((p, name)) = at {
            if !self.state.is_restoring {
                self.refuse_apart(p, name, line, &curves)?;
            }
            said.groups.push(vec![p]);
            let rays = match line {
                Some([a, b]) => [a, b, centres[0], p],
                None => [centres[0], p, centres[1], p],
            };
            return Ok(vec![(Field::Value, build.call(Function::AngleBetween, &rays))]);
        }
        let radius = build.radius(curves[0]);
        let is_inside = parts.iter().any(|part| matches!(part, Part::Flag(Role::Inside)));
        Ok(match line {
            Some(_) if is_inside => {
                return Err(Diagnostic::error(
                    errors::NO_TOUCH,
                    "a line is not inside of a circle",
                )
                .at(build.span, "`inside` is for two circles"));
            }
            Some([a, b]) => vec![
                (Field::Value, build.call(Function::DistanceToLine, &[centres[0], a, b])),
                (Field::Wanted, radius),
            ],
            None => {
                let operator = if is_inside { Operator::Subtract } else { Operator::Add };
                let wanted = build.binary(operator, radius, build.radius(curves[1]));
                let value = build.call(Function::Distance, &centres);
                vec![(Field::Value, value), (Field::Wanted, wanted)]
            }
        })
    }

    /// The points of a line, or a circle or an arc.
    fn side(&mut self, names: &[Name]) -> Result<Side, Diagnostic> {
        match names {
            [a, b] => {
                let ends = [self.idx(a)?, self.idx(b)?];
                if ends[0] == ends[1] {
                    return Err(Diagnostic::error(
                        errors::DEGENERATE,
                        "a segment needs two different points",
                    )
                    .at(a.span.to(b.span), "the same point twice"));
                }
                Ok(Side::Line(ends))
            }
            [curve] => Ok(Side::Curve(self.curve(curve)?)),
            _ => unreachable!("the grammar reads one or two names"),
        }
    }

    /// The circle or arc with a name.
    fn curve(&mut self, name: &Name) -> Result<ConstraintId, Diagnostic> {
        let entity = self.entity(name)?;
        match entity {
            Entity::Constraint(id) if self.state.world.curve(id).is_some() => Ok(id),
            _ => {
                let text = self.text(name.span);
                let label = format!("this is a {}", entity.noun());
                let problem = Diagnostic::error(
                    errors::WRONG_SORT,
                    format!("`{text}` is no circle and no arc"),
                )
                .at(name.span, label);
                Err(match entity {
                    Entity::Point(_) => problem
                        .help(format!("`circle c = {text} radius 1` makes a circle round a point")),
                    _ => problem,
                })
            }
        }
    }

    /// The points of a circle or an arc, its centre first.
    fn centre(&self, c: ConstraintId) -> Vec<PointIdx> {
        let curve = self.state.world.curve(c).expect("it was looked up as one");
        curve.points().to_vec()
    }

    /// Refuses a glider that the circle or arc is made of: it is on it anyway, or never.
    fn refuse_own_point(&self, p: PointIdx, c: ConstraintId, span: Span) -> Result<(), Diagnostic> {
        let points = self.centre(c);
        if !points.contains(&p) {
            return Ok(());
        }
        let curve = self.state.world.name_of(Entity::Constraint(c));
        let (message, label) = if p == points[0] {
            ("a centre is nowhere on its circle", format!("this is the centre of `{curve}`"))
        } else {
            (
                "a point that a circle or an arc goes through lies on it anyway",
                format!("`{curve}` goes through it"),
            )
        };
        Err(Diagnostic::error(errors::DEGENERATE, message)
            .at(span, label)
            .help("name another point"))
    }

    /// Refuses a point at which a direction is asked for and that is not on both.
    fn refuse_apart(
        &self,
        p: PointIdx,
        name: &Name,
        line: Option<[PointIdx; 2]>,
        curves: &[ConstraintId],
    ) -> Result<(), Diagnostic> {
        let world = &self.state.world;
        let records = || world.constraints().map(|(_, record)| &record.constraint);
        let text = self.text(name.span);
        for &c in curves {
            let is_of_it = self.centre(c)[1..].contains(&p);
            let slides = records().any(|constraint| {
                matches!(constraint.stated(), Constraint::Touch(touch)
                    if touch.is_glider() && touch.points() == [p] && touch.curves() == [c.0])
            });
            if !is_of_it && !slides {
                let curve = world.name_of(Entity::Constraint(c));
                return Err(Diagnostic::error(
                    errors::NO_COMMON_POINT,
                    format!("`{text}` is not known to be on `{curve}`"),
                )
                .at(name.span, "a common direction is one at a common point")
                .help(format!("`glider {text} on {curve}` puts it there")));
            }
        }
        let Some([a, b]) = line else { return Ok(()) };
        let slides = records().any(|constraint| {
            let is_on_line =
                matches!(constraint.stated(), Constraint::Glider(_) | Constraint::Hinge(_));
            is_on_line && constraint.points()[..3] == [p, a, b]
        });
        if p == a || p == b || slides {
            return Ok(());
        }
        let [a, b] = [a, b].map(|end| world.points().name(PointId(end)).to_owned());
        Err(Diagnostic::error(
            errors::NO_COMMON_POINT,
            format!("`{text}` is not known to be on the line {a} {b}"),
        )
        .at(name.span, "a common direction is one at a common point")
        .help(format!("`glider {text} on {a} {b} unbounded` puts it there")))
    }
}

/// Refuses a line through the centre of a circle, and circles round one centre.
fn refuse_one_centre(
    line: Option<[PointIdx; 2]>,
    centres: &[PointIdx],
    span: Span,
) -> Result<(), Diagnostic> {
    let message = match (line, centres) {
        (Some(ends), [o]) if ends.contains(o) => {
            "a line through the centre of a circle does not touch it"
        }
        (None, [o, p]) if o == p => "circles round one centre do not touch",
        _ => return Ok(()),
    };
    Err(Diagnostic::error(errors::NO_TOUCH, message).at(span, "the same point is in both"))
}

impl Execution<'_> {
    /// Makes what names a circle or an arc anew, after a change of it.
    pub(super) fn rebind_users_of(&mut self, id: ConstraintId) -> Result<(), Diagnostic> {
        let mut undo = Vec::new();
        let result = self.state.world.rebind_users_of(id, &mut undo);
        for inverse in undo {
            self.history.keep(&self.state.world, inverse);
        }
        result
    }
}
