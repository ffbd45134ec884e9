//! The commands that build big things from small ones: what each says, how it is read and written, and its help.

use std::fmt::{self, Formatter};
use std::sync::Arc;

use super::{Body, Verb};
use crate::diag::Diagnostic;
use crate::lang::catalogue::{Entry, Section};
use crate::lang::constraint::Range;
use crate::lang::expr::{Expr, Ident, Name};
use crate::lang::grammar::Rule;
use crate::lang::lower::{Cursor, refusal};
use crate::lang::parts::Text;
use crate::lang::print::{Clause, commas, write_block};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Building {
    /// `for i in 1..10 { ... }`, both ends included
    For {
        /// The loop variable.
        variable: Ident,
        /// Its first and last value.
        range: Range,
        /// What is repeated.
        body: Body,
    },
    /// `define dyad(A, B, a, b) { ... }`
    Define(Arc<Definition>),
    /// `use dyad(A, D, 3, 3.5) as left`
    Use {
        /// Which definition.
        definition: Ident,
        /// What stands for its parameters.
        arguments: Vec<Expr>,
        /// The instance's name.
        instance: Option<Name>,
    },
    /// `include "leg.link"`
    Include(Text),
    /// `save "session.link"`
    Save(Text),
    /// `save "typed.link" history`
    SaveHistory(Text),
    /// `load "session.link"`
    Load(Text),
    /// `restore turns crank = 0.25, 3`: state that no other statement can bring back.
    Restore {
        /// What sort of state.
        what: Ident,
        /// Whose.
        name: Option<Name>,
        /// Its values, constant expressions.
        values: Vec<Expr>,
    },
    /// `restore file "leg.link" = "point A = (0, 0)"`: what is read next, in place of a file.
    RestoreFile {
        /// Where it was.
        path: Text,
        /// What was in it.
        text: Text,
    },
}

/// A named group of statements with parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Definition {
    /// Its name.
    pub name: Ident,
    /// What its body may name of the outside.
    pub parameters: Vec<Ident>,
    /// What an instance consists of.
    pub body: Body,
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::for_,
        entry: Entry {
            keyword: "for",
            section: Section::Building,
            usage: "for NAME in FROM..TO { ... }",
            summary: "repeat statements, both ends included",
            help: "The variable stands for its value.",
            example: "for i in 1..10 { point p[i] = (i, 0); length p[i-1] p[i] = 1 }",
        },
    },
    Verb {
        rule: Rule::define,
        entry: Entry {
            keyword: "define",
            section: Section::Building,
            usage: "define NAME(PARAMETERS) { ... }",
            summary: "name a group of statements",
            help: "The parameters are points, or numbers that stay expressions.",
            example: "define dyad(A, B, a, b) {\n  point P = midpoint(A, B)\n  length A P = a; length B P = b\n}",
        },
    },
    Verb {
        rule: Rule::use_,
        entry: Entry {
            keyword: "use",
            section: Section::Building,
            usage: "use NAME(ARGUMENTS) [as NAME]",
            summary: "make what a definition says",
            help: "What it declares is prefixed with the name of the instance.",
            example: "use dyad(A, D, 3, 3.5) as left",
        },
    },
    Verb {
        rule: Rule::include,
        entry: Entry {
            keyword: "include",
            section: Section::Building,
            usage: "include FILE",
            summary: "read statements from a file into this world",
            help: "The path is relative to the file that includes it.",
            example: r#"include "jansen-leg.link""#,
        },
    },
    Verb {
        rule: Rule::save,
        entry: Entry {
            keyword: "save",
            section: Section::Building,
            usage: "save FILE [history]",
            summary: "write a script that brings this world back to the last bit",
            help: "With `history` what was typed, as `history` lists it.",
            example: r#"save "session.link"
save "typed.link" history"#,
        },
    },
    Verb {
        rule: Rule::load,
        entry: Entry {
            keyword: "load",
            section: Section::Building,
            usage: "load FILE",
            summary: "replace the world by what a file makes",
            help: "",
            example: r#"load "session.link""#,
        },
    },
    Verb {
        rule: Rule::restore,
        entry: Entry {
            keyword: "restore",
            section: Section::Building,
            usage: "restore STATE [NAME] [= VALUE, ...]",
            summary: "state that only a saved session needs",
            help: "`save` writes these; there is no need to type one.",
            example: "restore clock = 0.5, 30",
        },
    },
];

impl Building {
    /// Whether it changes what there is, and does not only say or write it.
    pub const fn leaves_a_mark(&self) -> bool {
        !matches!(self, Self::Save(_) | Self::SaveHistory(_))
    }

    /// Whether it makes or changes things, without letting time pass.
    pub(super) fn is_edit(&self) -> bool {
        matches!(self, Self::For { .. } | Self::Use { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(
        rule: Rule,
        c: &mut Cursor,
        block: Body,
    ) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::for_ => {
                Self::For { variable: c.declared_ident()?, range: c.range()?, body: block }
            }
            Rule::define => define(c, block)?,
            Rule::use_ => use_definition(c)?,
            Rule::include => Self::Include(c.text()?),
            Rule::save => {
                let path = c.text()?;
                if c.flag(Rule::kw_history) { Self::SaveHistory(path) } else { Self::Save(path) }
            }
            Rule::load => Self::Load(c.text()?),
            Rule::restore if c.flag(Rule::kw_file) => {
                Self::RestoreFile { path: c.text()?, text: c.text()? }
            }
            Rule::restore => {
                Self::Restore { what: c.ident(), name: c.name_if_any()?, values: c.exprs()? }
            }
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter, level: usize) -> fmt::Result {
        match self {
            Self::For { variable, range, body } => {
                write!(f, "for {variable} in {range} ")?;
                write_block(f, body, level)
            }
            Self::Define(definition) => {
                let Definition { name, parameters, body } = &**definition;
                write!(f, "define {name}({}) ", commas(parameters))?;
                write_block(f, body, level)
            }
            Self::Use { definition, arguments, instance } => {
                write!(f, "use {definition}({}){}", commas(arguments), Clause(" as ", instance))
            }
            Self::Include(path) => write!(f, "include {path}"),
            Self::Save(path) => write!(f, "save {path}"),
            Self::SaveHistory(path) => write!(f, "save {path} history"),
            Self::Load(path) => write!(f, "load {path}"),
            Self::Restore { what, name, values } => {
                write!(f, "restore {what}{}", Clause(" ", name))?;
                if values.is_empty() { Ok(()) } else { write!(f, " = {}", commas(values)) }
            }
            Self::RestoreFile { path, text } => write!(f, "restore file {path} = {text}"),
        }
    }
}

fn define(c: &mut Cursor, body: Body) -> Result<Building, Diagnostic> {
    let name = c.declared_ident()?;
    let parameters = parameters(c)?;
    Ok(Building::Define(Arc::new(Definition { name, parameters, body })))
}

fn use_definition(c: &mut Cursor) -> Result<Building, Diagnostic> {
    let definition = c.ident();
    let arguments = {
        let list = c.take(Rule::arguments).expect("the grammar has arguments here");
        c.within(list).exprs()?
    };
    Ok(Building::Use { definition, arguments, instance: c.name_if_any()? })
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
