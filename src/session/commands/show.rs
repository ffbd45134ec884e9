//! Looking: `list`, `show`, `print`, `assert`.

use std::fmt::Write;

use crate::constraint::ConstraintKind as _;
use crate::diag::{Diagnostic, Kind, Span, format_counted, format_number, format_rounded};
use crate::errors;
use crate::interrupt::tick;
use crate::lang::ast::{Expr, ListWhat, Name, Node, PrintItem, Relation};
use crate::lang::catalogue::{self, Trade};
use crate::lang::nearest_command;
use crate::render::Drawable;
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::resolve::scope::Meaning;
use crate::session::resolve::unbind::{Unbind, quoted};
use crate::session::state::State;
use crate::session::value_text::{format_value, format_value_in};
use crate::solve::present;
use crate::terms::{Statistic, Unit};
use crate::world::{ConstraintId, Entity, Measure, PointId, Value, World};

/// What the writing of a line takes, in ticks.
const LINE: usize = 1000;

impl Execution<'_> {
    pub(crate) fn print(&mut self, items: &[PrintItem]) -> Result<(), Diagnostic> {
        let mut line = String::new();
        let mut values = Vec::new();
        for (k, item) in items.iter().enumerate() {
            if k > 0 {
                line.push(' ');
            }
            match item {
                PrintItem::Text(text) => line.push_str(&text.value),
                PrintItem::Value(expr) => {
                    let value = self.resolve().value(expr)?;
                    line.push_str(&format_value(value));
                    values.push(value);
                }
                PrintItem::InUnit(expr, unit) => match self.resolve().value(expr)? {
                    Value::Number(n) => {
                        let in_unit = n / unit.scale();
                        line.push_str(&format_number(in_unit));
                        values.push(Value::Number(in_unit));
                    }
                    Value::Vector(_) => {
                        return Err(Diagnostic::error(
                            errors::MIXED_SORTS,
                            "only a number is written in a unit",
                        )
                        .at(expr.span, "this is a vector")
                        .help("print its parts, `v.x` and `v.y`"));
                    }
                },
            }
        }
        if self.host.takes_findings() {
            self.host.find_out(&Finding::Printed(&line, &values));
        } else {
            self.host.print(&line);
        }
        Ok(())
    }

    /// Values alone are printed; the lone name of what has no value of its own is shown.
    pub(crate) fn bare(&mut self, items: &[PrintItem]) -> Result<(), Diagnostic> {
        let [PrintItem::Value(Expr { node: Node::Name(name), .. })] = items else {
            return self.print(items);
        };
        if self.resolve().instance(name)?.is_some() {
            return self.show(name);
        }
        match self.resolve().meaning(name) {
            Ok((Meaning::Entity(Entity::Constraint(_) | Entity::Measure(_)), None)) => {
                self.show(name)
            }
            _ => self.print(items).map_err(|problem| {
                let word = name.as_simple().map_or("", |word| &*word.text);
                let is_free = self.state.world.names().is_free(word);
                if is_free && let Some(Trade { says, example, .. }) = catalogue::trade(word) {
                    return problem.help(format!("`{word}` {says}: `{example}`"));
                }
                if is_free && let Some(outside) = catalogue::outside(word) {
                    return problem.help(outside.advice());
                }
                match nearest_command(word) {
                    Some(near) if is_free => {
                        problem.help(format!("did you mean the command `{near}`?"))
                    }
                    None if problem.helps.is_empty() => problem.help("`help` lists the commands"),
                    _ => problem,
                }
            }),
        }
    }

    pub(crate) fn assert(
        &mut self,
        left: &Expr,
        relation: &Relation,
        within: Option<&Expr>,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let slack = within.map_or(Ok(0.0), |e| self.resolve().number(e))?;
        if let Some(e) = within.filter(|_| slack < 0.0) {
            return Err(Diagnostic::error(errors::OUT_OF_RANGE, "a tolerance is not negative")
                .at(e.span, format!("this is {}", format_number(slack))));
        }
        let a = self.resolve().value(left)?;
        let (holds, wanted, difference) = match relation {
            Relation::In(range) => {
                let (lo, hi) =
                    (self.resolve().number(&range.from)?, self.resolve().number(&range.to)?);
                let a = self.one_number(a, left)?;
                let outside = (lo - a).max(a - hi).max(0.0);
                (outside <= slack, format!("{}..{}", format_number(lo), format_number(hi)), outside)
            }
            Relation::Equal(right) => {
                let b = self.resolve().value(right)?;
                let difference = match (a, b) {
                    (Value::Number(a), Value::Number(b)) => (a - b).abs(),
                    (Value::Vector(a), Value::Vector(b)) => (a - b).norm(),
                    _ => {
                        return Err(Diagnostic::error(
                            errors::MIXED_SORTS,
                            "a number and a vector cannot be compared",
                        )
                        .at(left.span, format!("a {}", a.shape().noun()))
                        .also(right.span, format!("a {}", b.shape().noun())));
                    }
                };
                (difference <= slack, format_value(b), difference)
            }
            Relation::Less(right)
            | Relation::LessEqual(right)
            | Relation::Greater(right)
            | Relation::GreaterEqual(right) => {
                let a = self.one_number(a, left)?;
                let b = self.resolve().number(right)?;
                let holds = match relation {
                    Relation::Less(_) => a < b + slack,
                    Relation::LessEqual(_) => a <= b + slack,
                    Relation::Greater(_) => a > b - slack,
                    _ => a >= b - slack,
                };
                (holds, format_number(b), (a - b).abs())
            }
        };
        if holds {
            return Ok(());
        }
        let mut text = format!(
            "left is {}, right is {wanted}, they differ by {}",
            format_value(a),
            format_number(difference)
        );
        if within.is_some() {
            let _ = write!(text, ", more than {}", format_number(slack));
        }
        Err(Diagnostic::error(errors::ASSERTION, "assertion failed")
            .kind(Kind::Promise)
            .at(span, text))
    }

    fn one_number(&self, value: Value, expr: &Expr) -> Result<f64, Diagnostic> {
        match value {
            Value::Number(n) => Ok(n),
            Value::Vector(_) => {
                Err(Diagnostic::error(errors::MIXED_SORTS, "vectors have no order")
                    .at(expr.span, "this is a vector")
                    .help("compare `norm(v)`, or `v.x`"))
            }
        }
    }

    pub(crate) fn list(&mut self, what: Option<ListWhat>) {
        let is_asked = |part| what.is_none_or(|what| what == part);
        if self.host.takes_findings() {
            let listing = self.state.listing(is_asked);
            return self.host.find_out(&Finding::Listed(&listing));
        }
        let mut lines: Vec<String> = Vec::new();
        if is_asked(ListWhat::Parameters) {
            lines.extend(
                self.state
                    .parameters_in_order()
                    .into_iter()
                    .map(|id| self.state.parameter_line(id)),
            );
        }
        if is_asked(ListWhat::Points) {
            lines.extend(self.state.world.points().ids().map(|id| self.state.point_line(id)));
        }
        if is_asked(ListWhat::Constraints) {
            let (now, _) = present(&self.state.world);
            let constraints = self.state.world.constraints().map(|(id, _)| id);
            lines.extend(constraints.map(|id| self.state.constraint_line(&now, id)));
        }
        if is_asked(ListWhat::Traces) {
            lines.extend(self.state.world.traces().iter().map(|trace| {
                let name = self.state.world.points().name(trace.point);
                let places = format_counted(trace.samples.len() as u64, "place");
                let label = trace.label.as_deref().map(quoted);
                let label = label.map_or_else(String::new, |label| format!(" as {label}"));
                let every = match trace.every {
                    1 => String::new(),
                    every => format!(" every {every}"),
                };
                let ended = if trace.is_ended { ", ended" } else { "" };
                format!("trace {name}{label}{every}  # {places}{ended}")
            }));
        }
        if is_asked(ListWhat::Measures) {
            lines.extend(self.state.world.measures().map(|(_, it)| self.state.measure_line(it)));
        }
        if is_asked(ListWhat::Definitions) {
            lines.extend(self.state.definitions.values().map(|definition| {
                let names: Vec<&str> = definition.parameters.iter().map(|p| &*p.text).collect();
                format!("define {}({})", definition.name.text, names.join(", "))
            }));
        }
        self.print_all(&lines);
        if lines.is_empty() {
            let nothing = match what {
                None => "nothing here yet",
                Some(ListWhat::Points) => "no points",
                Some(ListWhat::Constraints) => "no constraints",
                Some(ListWhat::Traces) => "no traces",
                Some(ListWhat::Parameters) => "no parameters",
                Some(ListWhat::Measures) => "no measures",
                Some(ListWhat::Definitions) => "no definitions",
            };
            self.note(nothing);
        }
    }

    pub(crate) fn show(&mut self, name: &Name) -> Result<(), Diagnostic> {
        if self.host.takes_findings() {
            return self.show_as_data(name);
        }
        if let Some(instance) = self.resolve().instance(name)? {
            let prefix = format!("{instance}.");
            let (now, _) = present(&self.state.world);
            let mut lines = Vec::new();
            for id in self.state.world.points().ids() {
                if self.state.world.points().name(id).starts_with(&prefix) {
                    lines.push(self.state.point_line(id));
                }
            }
            for (id, record) in self.state.world.constraints() {
                if record.name.starts_with(&prefix) {
                    lines.push(self.state.constraint_line(&now, id));
                }
            }
            for (_, measure) in self.state.world.measures() {
                if measure.name.starts_with(&prefix) {
                    lines.push(self.state.measure_line(measure));
                }
            }
            lines.iter().for_each(|line| self.host.print(line));
            return Ok(());
        }
        match self.resolve().entity(name)? {
            Entity::Point(id) => {
                let (now, _) = present(&self.state.world);
                let mut lines = vec![self.state.point_line(id)];
                for (c, record) in self.state.world.constraints() {
                    if record.constraint.points().contains(&id.0) {
                        lines.push(format!("  {}", self.state.constraint_line(&now, c)));
                    }
                }
                lines.iter().for_each(|line| self.host.print(line));
            }
            Entity::Constraint(id) => {
                let (now, _) = present(&self.state.world);
                let mut lines = vec![self.state.constraint_line(&now, id)];
                lines.extend(
                    Unbind::of(&self.state.world)
                        .constraint_details(id)
                        .into_iter()
                        .map(|l| format!("  {l}")),
                );
                lines.iter().for_each(|line| self.host.print(line));
            }
            Entity::Measure(id) => {
                let measure = self.state.world.measure(id).expect("it is named");
                let mut lines = vec![self.state.measure_line(measure)];
                lines.extend(measure_details(measure));
                lines.iter().for_each(|line| self.host.print(line));
            }
            Entity::Parameter(id) => {
                let text = Unbind::of(&self.state.world).parameter_text(id);
                let formula = self.state.world.parameter(id).expect("it is named").formula.clone();
                let value = self.resolve().evaluate(&formula)?;
                let unit = if formula.depends().is_constant() {
                    // It stands there already.
                    Unit::None
                } else {
                    Unbind::of(&self.state.world).unit(&formula)
                };
                self.host.print(&format!("{text}  # {}", format_value_in(value, unit)));
            }
        }
        Ok(())
    }

    /// Shows the mechanism.
    pub(crate) fn sketch(&mut self) {
        if self.state.world.points().ids().next().is_none() {
            return self.note("nothing here yet");
        }
        self.host.draw(Drawable::Scene(&self.state.scene()));
    }

    pub(crate) fn tell_history(&mut self) {
        let typed = self.input.typed();
        let lines: Vec<String> = typed.flat_map(str::lines).map(str::to_owned).collect();
        self.print_all(&lines);
    }
}

impl State {
    fn parameter_line(&self, id: crate::world::ParameterId) -> String {
        let text = Unbind::of(&self.world).parameter_text(id);
        let parameter = self.world.parameter(id).expect("a listed parameter lives");
        match (parameter.depends.is_constant(), parameter.value) {
            (false, Some(value)) if !parameter.depends.is_live() => {
                let unit = Unbind::of(&self.world).unit(&parameter.formula);
                format!("{text}  # {}", format_value_in(value, unit))
            }
            _ => text,
        }
    }

    fn measure_line(&self, measure: &Measure) -> String {
        tick(LINE);
        let text = Unbind::of(&self.world).measure_statement(measure);
        match measure.tally.readings().len() {
            1 => format!("{text}  # 1 value"),
            n => format!("{text}  # {n} values"),
        }
    }

    fn point_line(&self, id: PointId) -> String {
        tick(LINE);
        let points = self.world.points();
        let at = points.at(id);
        let mut line = format!(
            "point {} = ({}, {})",
            points.name(id),
            format_number(at.x),
            format_number(at.y)
        );
        if points.is_frozen(id) {
            line.push_str(" frozen");
        }
        if points.weight(id) != 1.0 {
            let _ = write!(line, "  # weight {}", format_number(points.weight(id)));
        }
        line
    }

    /// A constraint, with its residual in a world that is as this one is `now`.
    fn constraint_line(&self, now: &World, id: ConstraintId) -> String {
        tick(LINE);
        let record = self.world.constraint(id).expect("a listed constraint lives");
        let mut line = Unbind::of(&self.world).constraint_text(record);
        if record.is_on {
            let constraint = &now.constraint(id).expect("it lives there too").constraint;
            let residual = constraint.residual(now.points().column());
            let _ = write!(line, "  # residual {}", format_rounded(residual));
        } else {
            line.push_str("  # off");
        }
        if let Some(rho) = record.rho() {
            let _ = write!(line, ", rho {}", format_number(rho));
        }
        line
    }
}

/// What a measure has kept, a line for what goes together.
fn measure_details(measure: &Measure) -> Vec<String> {
    let of = |which| measure.tally.get(which).map(format_number);
    let line = |items: &[Statistic]| {
        let items = items.iter().map(|&it| Some(format!("{} {}", it.word(), of(it)?)));
        Some(format!("  {}", items.collect::<Option<Vec<_>>>()?.join(", ")))
    };
    let lines = [
        line(&[Statistic::Min, Statistic::AtMin]),
        line(&[Statistic::Max, Statistic::AtMax]),
        line(&[Statistic::Span, Statistic::Mean]),
        line(&[Statistic::First, Statistic::Last]),
    ];
    lines.into_iter().flatten().collect()
}
