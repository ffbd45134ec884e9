//! A constraint as stated becomes a record of the world.

use crate::constraint::{
    Bounds, Cog, CogVelocity, Coincidence, Constraint, Coordinate, Distance, Equal, Equivalence,
    Field, Glider, Hinge, Length, Motor, Orientation, Period, Point, PointIdx, Rack, Rigid,
};
use crate::diag::{Diagnostic, Span, format_number};
use crate::lang::ast::{Constraint as Stated, ConstraintDecl, Expr, Name, Pair, Range, Relation};
use crate::session::execution::Execution;
use crate::session::resolve::scope::Resolver;
use crate::solve::CogForm;
use crate::world::{Drivers, Edit, PointId, Record, Shape, Value};
use std::f64::consts::{FRAC_PI_2, PI};

/// What a relation is about: the values it may allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measure {
    /// A distance between points, never negative.
    Length,
    /// An angle between -pi and pi.
    Angle,
    /// Any number.
    Signed,
}

impl Execution<'_> {
    pub(crate) fn constrain(
        &mut self,
        declaration: &ConstraintDecl,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let (constraint, drivers, stem) = self.resolve().build(&declaration.constraint, span)?;
        let name = match &declaration.label {
            Some(label) => self.resolve().declare(label)?,
            None => self.resolve().numbered(stem).into(),
        };
        let record = Record::new(name, constraint, drivers);
        let id = self.state.world.next_constraint();
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        Ok(())
    }
}

impl Resolver<'_> {
    fn build(
        &mut self,
        stated: &Stated,
        span: Span,
    ) -> Result<(Constraint, Drivers, &'static str), Diagnostic> {
        let mut drivers = Drivers::new();
        let (constraint, stem): (Constraint, _) = match stated {
            Stated::Coordinate { point, at } => {
                let points = [self.idx(point)?];
                let target = self.target(at, &mut drivers)?;
                (Coordinate { points, target }.into(), "coordinate")
            }
            Stated::Coincidence(pair) => {
                let points = self.two(pair, "a point coincides with itself anyway")?;
                (Coincidence { points }.into(), "coincidence")
            }
            Stated::Equivalence(a, b) => {
                (Equivalence { points: self.pairs(a, b)? }.into(), "equivalence")
            }
            Stated::Equal(a, b, relation) => {
                let points = self.pairs(a, b)?;
                let bounds = match relation {
                    None => Bounds::exactly(0.0),
                    Some(relation) => self.bounds(relation, Measure::Signed, &mut drivers)?,
                };
                (Equal { points, bounds }.into(), "equal")
            }
            Stated::Length(pair, relation) => {
                let points = self.pair(pair)?;
                let [a, b] = points.map(|p| self.at(p));
                let bounds = self.bounds_or(
                    relation.as_ref(),
                    Measure::Length,
                    a.distance(b),
                    &mut drivers,
                )?;
                (Length { points, bounds }.into(), "length")
            }
            Stated::Orientation(a, b, relation) => {
                let points = self.pairs(a, b)?;
                let [p1, p2, p3, p4] = points.map(|p| self.at(p));
                let now = (p2 - p1).angle_to(p4 - p3);
                let bounds =
                    self.bounds_or(relation.as_ref(), Measure::Angle, now, &mut drivers)?;
                (
                    Orientation { points, bounds, period: Period::Whole, side: 0.0 }.into(),
                    "orientation",
                )
            }
            Stated::Parallel(a, b) => (self.turned(a, b, 0.0)?, "parallel"),
            Stated::Perpendicular(a, b) => (self.turned(a, b, FRAC_PI_2)?, "perpendicular"),
            Stated::Motor { arm, radius, speed, phase } => {
                let options = [radius.as_ref(), speed.as_ref(), phase.as_ref()];
                (self.motor(arm, options, &mut drivers)?, "motor")
            }
            Stated::Glider { point, on, unbounded } => {
                let [a, b] = self.pair(on)?;
                let points = [self.idx(point)?, a, b];
                (Glider { points, bounded: !unbounded }.into(), "glider")
            }
            Stated::Hinge { point, on, at } => {
                let [a, b] = self.pair(on)?;
                let points = [self.idx(point)?, a, b];
                let ratio = self.drive(at, Field::Ratio, &mut drivers)?;
                (Hinge { points, ratio }.into(), "hinge")
            }
            Stated::Cog { first, second, ratio, inside } => {
                let points = self.pairs(first, second)?;
                let value = self.drive(ratio, Field::Ratio, &mut drivers)?;
                let ratio = cog_ratio(value, *inside, ratio.span)?;
                let x = self.state.world.points().column();
                let wheels: Constraint = match self.state.preferences.solve.cog {
                    CogForm::Holonomic => Cog::new(points, ratio, x).into(),
                    CogForm::Velocity => CogVelocity::new(points, ratio, x).into(),
                };
                (wheels, "cog")
            }
            Stated::Distance { point, line, relation } => {
                let [a, b] = self.pair(line)?;
                let points = [self.idx(point)?, a, b];
                let [p, a, b] = points.map(|p| self.at(p));
                let now = (b - a).unit().map_or(0.0, |e| e.cross(p - a));
                let bounds =
                    self.bounds_or(relation.as_ref(), Measure::Signed, now, &mut drivers)?;
                (Distance { points, bounds }.into(), "distance")
            }
            Stated::Rigid(names) => {
                let points =
                    names.iter().map(|name| self.idx(name)).collect::<Result<Vec<_>, _>>()?;
                for (k, name) in names.iter().enumerate() {
                    if points[..k].contains(&points[k]) {
                        return Err(Diagnostic::error("a rigid body holds each point once")
                            .at(name.span, "named twice"));
                    }
                }
                (Rigid::new(&points, self.state.world.points().column()).into(), "rigid")
            }
            Stated::Rack { wheel, on } => {
                let points = self.pairs(wheel, on)?;
                let [o, a, ..] = points.map(|p| self.at(p));
                if o == a {
                    return Err(Diagnostic::error("the rim point lies on the centre")
                        .at(span, "a wheel of radius 0 does not roll"));
                }
                (Rack::new(points, self.state.world.points().column()).into(), "rack")
            }
        };
        Ok((constraint, drivers, stem))
    }

    fn at(&self, p: PointIdx) -> Point {
        self.state.world.points().at(PointId(p))
    }

    fn idx(&mut self, name: &Name) -> Result<PointIdx, Diagnostic> {
        Ok(self.point(name)?.0)
    }

    pub(crate) fn pair(&mut self, pair: &Pair) -> Result<[PointIdx; 2], Diagnostic> {
        self.two(pair, "a segment needs two different points")
    }

    fn two(&mut self, pair: &Pair, why: &str) -> Result<[PointIdx; 2], Diagnostic> {
        let ends = [self.idx(&pair.from)?, self.idx(&pair.to)?];
        if ends[0] == ends[1] {
            return Err(
                Diagnostic::error(why).at(pair.from.span.to(pair.to.span), "the same point twice")
            );
        }
        Ok(ends)
    }

    fn pairs(&mut self, a: &Pair, b: &Pair) -> Result<[PointIdx; 4], Diagnostic> {
        let ([x1, x2], [x3, x4]) = (self.pair(a)?, self.pair(b)?);
        Ok([x1, x2, x3, x4])
    }

    fn turned(&mut self, a: &Pair, b: &Pair, angle: f64) -> Result<Constraint, Diagnostic> {
        let points = self.pairs(a, b)?;
        let bounds = Bounds::exactly(angle);
        Ok(Orientation { points, bounds, period: Period::Half, side: 0.0 }.into())
    }

    /// A place for a coordinate constraint, live if it can change.
    pub(crate) fn target(&mut self, at: &Expr, drivers: &mut Drivers) -> Result<Point, Diagnostic> {
        let (value, formula) = self.driver(at, Shape::Vector)?;
        if let Some(formula) = formula {
            drivers.push((Field::X, formula.clone()));
            drivers.push((Field::Y, formula));
        }
        match value {
            Value::Vector(v) => Ok(Point::new(v.x, v.y)),
            Value::Number(_) => unreachable!("the shape was asked for"),
        }
    }

    /// A number of a constraint, live if it can change.
    pub(crate) fn drive(
        &mut self,
        expr: &Expr,
        field: Field,
        drivers: &mut Drivers,
    ) -> Result<f64, Diagnostic> {
        let driven = self.driven(expr)?;
        if let Some(formula) = driven.formula {
            drivers.push((field, formula));
        }
        Ok(driven.value)
    }

    fn motor(
        &mut self,
        arm: &Pair,
        [radius, speed, phase]: [Option<&Expr>; 3],
        drivers: &mut Drivers,
    ) -> Result<Constraint, Diagnostic> {
        let points = self.pair(arm)?;
        let [o, p] = points.map(|p| self.at(p));
        let r = match radius {
            Some(radius) => {
                let value = self.drive(radius, Field::Radius, drivers)?;
                not_negative(value, "a radius", radius.span)?;
                value
            }
            None if o == p => {
                return Err(Diagnostic::error("the motor's points coincide, so it has no radius")
                    .at(arm.from.span.to(arm.to.span), "")
                    .help("say how far apart they belong: `radius 1`"));
            }
            None => o.distance(p),
        };
        let angle = match phase {
            Some(phase) => self.drive(phase, Field::Phase, drivers)?,
            None => (p - o).angle(),
        };
        let omega = match speed {
            Some(speed) => self.drive(speed, Field::Speed, drivers)?,
            None => 0.0,
        };
        Ok(Motor::new(points, r, angle, omega).into())
    }

    fn bounds_or(
        &mut self,
        relation: Option<&Relation>,
        measure: Measure,
        now: f64,
        drivers: &mut Drivers,
    ) -> Result<Bounds, Diagnostic> {
        match relation {
            Some(relation) => self.bounds(relation, measure, drivers),
            None => Ok(Bounds::exactly(now)),
        }
    }

    /// The interval that a relation allows.
    pub(crate) fn bounds(
        &mut self,
        relation: &Relation,
        measure: Measure,
        drivers: &mut Drivers,
    ) -> Result<Bounds, Diagnostic> {
        let (least, most) = match measure {
            Measure::Angle => (-PI, PI),
            Measure::Length | Measure::Signed => (f64::NEG_INFINITY, f64::INFINITY),
        };
        let bounds = match relation {
            Relation::Equal(e) => {
                let value = self.drive(e, Field::Lo, drivers)?;
                if let Some((_, formula)) = drivers.last().cloned() {
                    drivers.push((Field::Hi, formula));
                }
                Bounds::exactly(value)
            }
            Relation::Less(e) | Relation::LessEqual(e) => {
                Bounds { lo: least, hi: self.drive(e, Field::Hi, drivers)? }
            }
            Relation::Greater(e) | Relation::GreaterEqual(e) => {
                Bounds { lo: self.drive(e, Field::Lo, drivers)?, hi: most }
            }
            Relation::In(Range { from, to }) => {
                let lo = self.drive(from, Field::Lo, drivers)?;
                let hi = self.drive(to, Field::Hi, drivers)?;
                if lo > hi {
                    return Err(Diagnostic::error("this range is empty")
                        .at(from.span.to(to.span), "its lower end is above its upper end"));
                }
                Bounds { lo, hi }
            }
        };
        let last = upper(relation).span;
        if bounds.lo > bounds.hi {
            return Err(Diagnostic::error("no angle is like this")
                .at(last, "angles lie between -180deg and 180deg"));
        }
        // A lower bound below 0 allows everything; an upper one, nothing.
        if measure == Measure::Length && bounds.hi < 0.0 {
            not_negative(bounds.hi, "a length", last)?;
        }
        Ok(bounds)
    }
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

/// Refuses a negative number where none makes sense.
pub(crate) fn not_negative(value: f64, what: &str, span: Span) -> Result<(), Diagnostic> {
    if value >= 0.0 {
        return Ok(());
    }
    Err(Diagnostic::error(format!("{what} cannot be negative"))
        .at(span, format!("this is {}", format_number(value))))
}

/// The ratio of a pair of wheels, negative where one runs inside the other.
pub(crate) fn cog_ratio(value: f64, inside: bool, span: Span) -> Result<f64, Diagnostic> {
    if value == 0.0 {
        return Err(Diagnostic::error("a ratio of radii cannot be 0").at(span, "this is 0"));
    }
    Ok(if inside { -value.abs() } else { value })
}
