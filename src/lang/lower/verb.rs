//! From the first word of a statement to its rule, and from its parts to a command.

use std::sync::Arc;

use crate::diag::{Diagnostic, Span};
use crate::lang::ast::{
    Binding, Body, Command, ConstraintDecl, Definition, DragTarget, Expose, Ident, ListWhat, Name,
    Part, PlotPart, PointDecl, PrintItem, Relation,
};

use super::constraint;
use super::cursor::Cursor;
use super::errors::refusal;
use crate::lang::grammar::Rule;

/// The rule that reads statements beginning with `word`.
pub(super) fn rule(word: &str) -> Option<Rule> {
    Some(match word {
        "let" => Rule::let_,
        "point" => Rule::point,
        "freeze" => Rule::freeze,
        "thaw" => Rule::thaw,
        "move" => Rule::move_,
        "drag" => Rule::drag,
        "delete" => Rule::delete,
        "off" => Rule::off,
        "on" => Rule::on,
        "change" => Rule::change,
        "set" => Rule::set,
        "undo" => Rule::undo,
        "redo" => Rule::redo,
        "reset" => Rule::reset,
        "clear" => Rule::clear,
        "step" => Rule::step,
        "run" => Rule::run,
        "relax" => Rule::relax,
        "solve" => Rule::solve,
        "list" => Rule::list,
        "show" => Rule::show,
        "print" => Rule::print,
        "check" => Rule::check,
        "why" => Rule::why,
        "limits" => Rule::limits,
        "effects" => Rule::effects,
        "accuracy" => Rule::accuracy,
        "assert" => Rule::assert,
        "help" => Rule::help,
        "trace" => Rule::trace,
        "untrace" => Rule::untrace,
        "expose" => Rule::expose,
        "svg" => Rule::svg,
        "record" => Rule::record,
        "sample" => Rule::sample,
        "plot" => Rule::plot,
        "for" => Rule::for_,
        "define" => Rule::define,
        "use" => Rule::use_,
        "include" => Rule::include,
        "save" => Rule::save,
        "load" => Rule::load,
        "restore" => Rule::restore,
        "quit" | "exit" => Rule::quit,
        _ => return constraint::rule(word),
    })
}

/// Does a block in braces belong to the statement?
pub(super) fn has_block(rule: Rule) -> bool {
    matches!(rule, Rule::for_ | Rule::define)
}

/// The command whose statement `rule` has read.
pub(super) fn lower(
    rule: Rule,
    c: &mut Cursor,
    label: Option<Name>,
    block: Body,
) -> Result<Command, Diagnostic> {
    c.pass_verb();
    if let Some(constraint) = constraint::lower(rule, c) {
        let constraint = constraint?;
        return Ok(Command::Constrain(Box::new(ConstraintDecl { label, constraint })));
    }
    Ok(match rule {
        Rule::let_ => Command::Let(each(c, Rule::binding, binding)?),
        Rule::point => Command::Point(each(c, Rule::point_decl, point_decl)?),
        Rule::freeze => Command::Freeze(c.selection()?),
        Rule::thaw => Command::Thaw(c.selection()?),
        Rule::move_ => Command::Move { point: c.name()?, to: c.expr()? },
        Rule::drag => {
            let targets = each(c, Rule::drag_target, drag_target)?;
            Command::Drag { targets, over: c.expr_if_any()? }
        }
        Rule::delete => Command::Delete { names: c.names()?, cascade: c.flag(Rule::kw_cascade) },
        Rule::off => Command::Off(c.names()?),
        Rule::on => Command::On(c.names()?),
        Rule::change => Command::Change { name: c.name()?, parts: change_parts(c)? },
        Rule::set => set(c)?,
        Rule::undo => Command::Undo(c.expr_if_any()?),
        Rule::redo => Command::Redo(c.expr_if_any()?),
        Rule::reset => Command::Reset,
        Rule::clear => Command::Clear,
        Rule::step => Command::Step { frames: c.expr_if_any()?, promise: c.promise()? },
        Rule::run => Command::Run { time: c.expr()?, promise: c.promise()? },
        Rule::relax => Command::Relax(c.expr_if_any()?),
        Rule::solve => Command::Solve(c.promise()?),
        Rule::list => Command::List(list_what(c)?),
        Rule::show => Command::Show(c.name()?),
        Rule::print => Command::Print(print_items(c)?),
        Rule::check => Command::Check,
        Rule::why => Command::Why(c.name()?),
        Rule::limits => Command::Limits(c.name()?),
        Rule::effects => Command::Effects,
        Rule::accuracy => Command::Accuracy(c.promise()?),
        Rule::assert => Command::Assert {
            left: c.expr()?,
            relation: relation(c)?,
            within: c.clause(Rule::within)?,
        },
        Rule::help => Command::Help(c.setting_if_any()),
        Rule::trace => Command::Trace { names: c.names()?, every: c.clause(Rule::every)? },
        Rule::untrace => Command::Untrace(c.selection()?),
        Rule::expose => expose(c)?,
        Rule::svg => Command::Svg(c.text()?),
        Rule::record if c.flag(Rule::kw_stop) => Command::RecordStop,
        Rule::record => Command::Record { path: c.text()?, every: c.clause(Rule::every)? },
        Rule::sample => Command::Sample { series: c.text()?, values: c.exprs()? },
        Rule::plot => Command::Plot { path: c.text()?, parts: plot_parts(c)? },
        Rule::for_ => {
            Command::For { variable: c.declared_ident()?, range: c.range()?, body: block }
        }
        Rule::define => define(c, block)?,
        Rule::use_ => use_definition(c)?,
        Rule::include => Command::Include(c.text()?),
        Rule::save => Command::Save(c.text()?),
        Rule::load => Command::Load(c.text()?),
        Rule::restore => {
            Command::Restore { what: c.ident(), name: c.name_if_any()?, values: c.exprs()? }
        }
        Rule::quit => Command::Quit,
        _ => panic!("{rule:?} is no verb's rule"),
    })
}

/// The items `item` of all the `rule`s that follow.
fn each<'a, T>(
    c: &mut Cursor<'a>,
    rule: Rule,
    item: impl Fn(&mut Cursor<'a>) -> Result<T, Diagnostic>,
) -> Result<Vec<T>, Diagnostic> {
    let mut items = Vec::new();
    while let Some(pair) = c.take(rule) {
        items.push(item(&mut c.within(pair))?);
    }
    Ok(items)
}

fn binding(c: &mut Cursor) -> Result<Binding, Diagnostic> {
    Ok(Binding { name: c.name()?, value: c.expr()? })
}

fn point_decl(c: &mut Cursor) -> Result<PointDecl, Diagnostic> {
    let (name, at) = (c.name()?, c.expr()?);
    Ok(PointDecl { name, at, frozen: c.flag(Rule::kw_frozen) })
}

fn drag_target(c: &mut Cursor) -> Result<DragTarget, Diagnostic> {
    Ok(DragTarget { point: c.name()?, to: c.expr()? })
}

fn relation(c: &mut Cursor) -> Result<Relation, Diagnostic> {
    let relation = c.relation_if_any()?;
    Ok(relation.expect("the grammar has a relation here"))
}

fn change_parts(c: &mut Cursor) -> Result<Vec<Part>, Diagnostic> {
    constraint::parts(c, |first, second| refusal::part_twice(first.span, second.span))
}

fn set(c: &mut Cursor) -> Result<Command, Diagnostic> {
    let Some(setting) = c.setting_if_any() else { return Ok(Command::Settings(None)) };
    Ok(match c.expr_if_any()? {
        None => Command::Settings(Some(setting)),
        Some(value) => Command::Set { setting, value, targets: c.names()? },
    })
}

fn print_items(c: &mut Cursor) -> Result<Vec<PrintItem>, Diagnostic> {
    let mut items = Vec::new();
    while let Some(rule) = c.peek() {
        items.push(if rule == Rule::string {
            PrintItem::Text(c.text()?)
        } else {
            PrintItem::Value(c.expr()?)
        });
    }
    Ok(items)
}

fn plot_parts(c: &mut Cursor) -> Result<Vec<PlotPart>, Diagnostic> {
    let mut parts = Vec::new();
    let mut seen: Vec<(Rule, Span)> = Vec::new();
    while let Some((rule, span)) = c.peek_span() {
        if let Some((_, first)) = seen.iter().find(|(known, _)| *known == rule) {
            return Err(refusal::twice(&c.reader.text[span.range()], *first, span));
        }
        seen.push((rule, span));
        if c.flag(Rule::kw_log) {
            parts.push(PlotPart::Log);
            continue;
        }
        let part = c.take(rule).expect("it is the next thing");
        let text = c.within(part).text()?;
        parts.push(match rule {
            Rule::title => PlotPart::Title(text),
            Rule::x_label => PlotPart::X(text),
            _ => PlotPart::Y(text),
        });
    }
    Ok(parts)
}

fn expose(c: &mut Cursor) -> Result<Command, Diagnostic> {
    if c.flag(Rule::kw_off) {
        return Ok(Command::Expose(Expose::Off));
    }
    let every = c.clause(Rule::every)?;
    Ok(Command::Expose(every.map_or(Expose::Now, Expose::Every)))
}

fn define(c: &mut Cursor, body: Body) -> Result<Command, Diagnostic> {
    let name = c.declared_ident()?;
    let parameters = parameters(c)?;
    Ok(Command::Define(Arc::new(Definition { name, parameters, body })))
}

fn use_definition(c: &mut Cursor) -> Result<Command, Diagnostic> {
    let definition = c.ident();
    let arguments = {
        let list = c.take(Rule::arguments).expect("the grammar has arguments here");
        c.within(list).exprs()?
    };
    Ok(Command::Use { definition, arguments, instance: c.name_if_any()? })
}

fn parameters(c: &mut Cursor) -> Result<Vec<Ident>, Diagnostic> {
    let list = c.take(Rule::parameters).expect("the grammar has parameters here");
    let mut inner = c.within(list);
    let mut parameters: Vec<Ident> = Vec::new();
    while inner.peek() == Some(Rule::ident) {
        let parameter = inner.declared_ident()?;
        if let Some(first) = parameters.iter().find(|known| **known == parameter) {
            return Err(refusal::parameter_twice(first, &parameter));
        }
        parameters.push(parameter);
    }
    Ok(parameters)
}

fn list_what(c: &mut Cursor) -> Result<Option<ListWhat>, Diagnostic> {
    let Some(word) = c.ident_if_any() else { return Ok(None) };
    let what = ListWhat::ALL.into_iter().find(|what| what.word() == &*word.text);
    what.map(Some).ok_or_else(|| refusal::unknown_list(&word, &ListWhat::ALL.map(ListWhat::word)))
}
