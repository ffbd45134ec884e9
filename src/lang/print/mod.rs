//! Trees to text: the canonical form, which reads back to an equal tree.

use std::fmt::{self, Display, Formatter};

mod constraint;
mod expr;

use super::ast::{
    Binding, Command, ConstraintDecl, Definition, DragTarget, Expose, Expr, Ident, Name, PlotPart,
    PointDecl, PrintItem, Promise, Range, Relation, Selection, Statement, Text,
};
use super::expr::Node;

impl Display for Statement {
    /// On one line, or with its block on several, without a newline at the end.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write_indented(f, self, 0)
    }
}

impl Display for Command {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write_command(f, self, 0)
    }
}

fn write_indented(f: &mut Formatter, statement: &Statement, level: usize) -> fmt::Result {
    write!(f, "{:1$}", "", 2 * level)?;
    write_command(f, &statement.command, level)
}

fn write_command(f: &mut Formatter, command: &Command, level: usize) -> fmt::Result {
    match command {
        Command::Let(bindings) => write!(f, "let {}", commas(bindings)),
        Command::Point(points) => write!(f, "point {}", commas(points)),
        Command::Freeze(what) => write!(f, "freeze {what}"),
        Command::Thaw(what) => write!(f, "thaw {what}"),
        Command::Move { point, to } => write!(f, "move {point} to {to}"),
        Command::Drag { targets, over } => {
            write!(f, "drag {}{}", commas(targets), Clause(" over ", over))
        }
        Command::Constrain(decl) => write!(f, "{decl}"),
        Command::Delete { names, cascade } => {
            let names = Names { names, stop: "cascade" };
            write!(f, "delete {names}{}", if *cascade { " cascade" } else { "" })
        }
        Command::Off(names) => write!(f, "off {}", Names { names, stop: "" }),
        Command::On(names) => write!(f, "on {}", Names { names, stop: "" }),
        Command::Change { name, parts } => {
            write!(f, "change {name}")?;
            parts.iter().try_for_each(|part| write!(f, " {part}"))
        }
        Command::Settings(None) => f.write_str("set"),
        Command::Settings(Some(setting)) => write!(f, "set {setting}"),
        Command::Set { setting, value, targets } => {
            write!(f, "set {setting} {}", Guarded { expr: value, stops: &["for"] })?;
            match targets.as_slice() {
                [] => Ok(()),
                names => write!(f, " for {}", Names { names, stop: "" }),
            }
        }
        Command::Undo(n) => write!(f, "undo{}", Clause(" ", n)),
        Command::Redo(n) => write!(f, "redo{}", Clause(" ", n)),
        Command::Reset => f.write_str("reset"),
        Command::Clear => f.write_str("clear"),
        Command::Step { frames: None, promise } => write!(f, "step{promise}"),
        Command::Step { frames: Some(frames), promise } => {
            write!(f, "step {}{promise}", Guarded { expr: frames, stops: &["within", "in"] })
        }
        Command::Run { time, promise } => write!(f, "run {time}{promise}"),
        Command::Relax(n) => write!(f, "relax{}", Clause(" ", n)),
        Command::Solve(promise) => write!(f, "solve{promise}"),
        Command::List(None) => f.write_str("list"),
        Command::List(Some(what)) => write!(f, "list {}", what.word()),
        Command::Show(name) => write!(f, "show {name}"),
        Command::Print(items) => write!(f, "print {}", commas(items)),
        Command::Check => f.write_str("check"),
        Command::Why(name) => write!(f, "why {name}"),
        Command::Limits(name) => write!(f, "limits {name}"),
        Command::Effects => f.write_str("effects"),
        Command::Accuracy(promise) => write!(f, "accuracy{promise}"),
        Command::Assert { left, relation, within } => {
            write!(f, "assert {left} {relation}{}", Clause(" within ", within))
        }
        Command::Help(None) => f.write_str("help"),
        Command::Help(Some(word)) => write!(f, "help {word}"),
        Command::Trace { names, every } => {
            let names = Names { names, stop: "every" };
            write!(f, "trace {names}{}", Clause(" every ", every))
        }
        Command::Untrace(what) => write!(f, "untrace {what}"),
        Command::Expose(Expose::Now) => f.write_str("expose"),
        Command::Expose(Expose::Every(frames)) => write!(f, "expose every {frames}"),
        Command::Expose(Expose::Off) => f.write_str("expose off"),
        Command::Svg(path) => write!(f, "svg {path}"),
        Command::Record { path, every } => {
            write!(f, "record {path}{}", Clause(" every ", every))
        }
        Command::RecordStop => f.write_str("record stop"),
        Command::Sample { series, values } => write!(f, "sample {series} = {}", commas(values)),
        Command::Plot { path, parts } => {
            write!(f, "plot {path}")?;
            parts.iter().try_for_each(|part| write!(f, " {part}"))
        }
        Command::For { variable, range, body } => {
            write!(f, "for {variable} in {range} ")?;
            write_block(f, body, level)
        }
        Command::Define(definition) => {
            let Definition { name, parameters, body } = &**definition;
            write!(f, "define {name}({}) ", commas(parameters))?;
            write_block(f, body, level)
        }
        Command::Use { definition, arguments, instance } => {
            write!(f, "use {definition}({}){}", commas(arguments), Clause(" as ", instance))
        }
        Command::Include(path) => write!(f, "include {path}"),
        Command::Save(path) => write!(f, "save {path}"),
        Command::Load(path) => write!(f, "load {path}"),
        Command::Restore { what, name, values } => {
            write!(f, "restore {what}{}", Clause(" ", name))?;
            if values.is_empty() { Ok(()) } else { write!(f, " = {}", commas(values)) }
        }
        Command::Quit => f.write_str("quit"),
    }
}

fn write_block(f: &mut Formatter, body: &[Statement], level: usize) -> fmt::Result {
    if body.is_empty() {
        return f.write_str("{}");
    }
    f.write_str("{\n")?;
    for statement in body {
        write_indented(f, statement, level + 1)?;
        f.write_str("\n")?;
    }
    write!(f, "{:1$}}}", "", 2 * level)
}

/// Items with `, ` between them.
struct Commas<'a, T>(&'a [T]);

fn commas<T>(items: &[T]) -> Commas<'_, T> {
    Commas(items)
}

impl<T: Display> Display for Commas<'_, T> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (position, item) in self.0.iter().enumerate() {
            write!(f, "{}{item}", if position == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// A word and what follows it, if anything does.
struct Clause<'a, T>(&'a str, &'a Option<T>);

impl<T: Display> Display for Clause<'_, T> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.1 {
            Some(value) => write!(f, "{}{value}", self.0),
            None => Ok(()),
        }
    }
}

/// Names in a row; a name that reads like the word that ends the row gets a comma before it.
struct Names<'a> {
    names: &'a [Name],
    stop: &'a str,
}

impl Display for Names<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (position, name) in self.names.iter().enumerate() {
            let gap = match position {
                0 => "",
                _ if &*name.head.text == self.stop => ", ",
                _ => " ",
            };
            write!(f, "{gap}{name}")?;
        }
        Ok(())
    }
}

/// An expression, in parentheses if it begins with a word that would end it before it begins.
struct Guarded<'a> {
    expr: &'a Expr,
    stops: &'a [&'a str],
}

impl Display for Guarded<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let mut first = self.expr;
        while let Node::Binary(_, operands) = &first.node {
            first = &operands[0];
        }
        let word = first.as_name().map_or("", |name| &*name.head.text);
        if self.stops.contains(&word) {
            write!(f, "({})", self.expr)
        } else {
            write!(f, "{}", self.expr)
        }
    }
}

impl Display for ConstraintDecl {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        if let Some(label) = &self.label {
            write!(f, "{label}: ")?;
        }
        write!(f, "{}", self.constraint)
    }
}

impl Display for Relation {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Equal(value) => write!(f, "= {value}"),
            Self::Less(value) => write!(f, "< {value}"),
            Self::LessEqual(value) => write!(f, "<= {value}"),
            Self::Greater(value) => write!(f, "> {value}"),
            Self::GreaterEqual(value) => write!(f, ">= {value}"),
            Self::In(range) => write!(f, "in {range}"),
        }
    }
}

impl Display for PlotPart {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Log => f.write_str("log"),
            Self::Title(text) => write!(f, "title {text}"),
            Self::X(text) => write!(f, "x {text}"),
            Self::Y(text) => write!(f, "y {text}"),
        }
    }
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}..{}", self.from, self.to)
    }
}

impl Display for Promise {
    /// With a blank before each part.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}{}", Clause(" within ", &self.within), Clause(" in ", &self.in_time))
    }
}

impl Display for Binding {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} = {}", self.name, self.value)
    }
}

impl Display for PointDecl {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let frozen = if self.frozen { " frozen" } else { "" };
        write!(f, "{} = {}{frozen}", self.name, self.at)
    }
}

impl Display for DragTarget {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} to {}", self.point, self.to)
    }
}

impl Display for Selection {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Names(names) => write!(f, "{}", Names { names, stop: "" }),
        }
    }
}

impl Display for PrintItem {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Text(text) => write!(f, "{text}"),
        }
    }
}

impl Display for Text {
    /// In quotes.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("\"")?;
        for char in self.value.chars() {
            match char {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                '\n' => f.write_str("\\n")?,
                char => write!(f, "{char}")?,
            }
        }
        f.write_str("\"")
    }
}

impl Display for Ident {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(&self.text)
    }
}
