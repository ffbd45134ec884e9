//! The commands that change what is there: what each says, how it is read and written, and its help.

use std::fmt::{self, Formatter};

use super::Verb;
use crate::diag::Diagnostic;
use crate::lang::catalogue::{Entry, Section};
use crate::lang::constraint::Part;
use crate::lang::expr::{Expr, Ident, Name};
use crate::lang::grammar::Rule;
use crate::lang::lower::{Cursor, parts, refusal};
use crate::lang::print::{Clause, Guarded, Names};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Changing {
    /// `delete coupler`, `delete C cascade`
    Delete {
        /// What goes.
        names: Vec<Name>,
        /// Does all that uses it go too?
        cascade: bool,
    },
    /// `off crank`: out of the active list.
    Off(Vec<Name>),
    /// `on crank`: back into the active list.
    On(Vec<Name>),
    /// `rename A to pivot`
    Rename {
        /// What it is called.
        from: Name,
        /// What it is to be called.
        to: Name,
    },
    /// `change crank speed 2rev`
    Change {
        /// What changes.
        name: Name,
        /// The trailing parts of the statement that made it; at least one.
        parts: Vec<Part>,
    },
    /// `set`: all settings are printed. `set dt`: this one.
    Settings(Option<Ident>),
    /// `set dt 1/360`, `set method newton`, `set rho 0.25 for coupler`
    Set {
        /// Which setting.
        setting: Ident,
        /// Its value; a word is a name, see [`Expr::as_word`].
        value: Expr,
        /// What it is set for; empty: for the whole session.
        targets: Vec<Name>,
    },
    /// `undo`, `undo 3`
    Undo(Option<Expr>),
    /// `redo`, `redo 3`
    Redo(Option<Expr>),
    /// `reset`
    Reset,
    /// `clear`
    Clear,
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::delete,
        entry: Entry {
            keyword: "delete",
            section: Section::Changing,
            usage: "delete NAMES [cascade]",
            summary: "take points, constraints, parameters or instances out",
            help: "A point still in use is refused, with a list of its users; `cascade` takes these out too.",
            example: "delete coupler\n\
                 delete C cascade",
        },
    },
    Verb {
        rule: Rule::off,
        entry: Entry {
            keyword: "off",
            section: Section::Changing,
            usage: "off NAMES",
            summary: "keep constraints, but out of the active list",
            help: "",
            example: "off crank",
        },
    },
    Verb {
        rule: Rule::on,
        entry: Entry {
            keyword: "on",
            section: Section::Changing,
            usage: "on NAMES",
            summary: "take constraints back into the active list",
            help: "",
            example: "on crank",
        },
    },
    Verb {
        rule: Rule::rename,
        entry: Entry {
            keyword: "rename",
            section: Section::Changing,
            usage: "rename NAME to NAME",
            summary: "give a point, a constraint, a parameter, a measure or an instance another name",
            help: "All that refers to it goes on doing so: constraints, expressions, paths, recordings.\n\
                 A definition looks its names up when it is used, and finds the new ones then.",
            example: "rename C to knee\n\
                 rename length1 to coupler",
        },
    },
    Verb {
        rule: Rule::change,
        entry: Entry {
            keyword: "change",
            section: Section::Changing,
            usage: "change NAME PART ...",
            summary: "change any trailing part of the statement that made a thing",
            help: "The parts: `= e`, `<= e`, `>= e`, `in a..b`, `radius e`, `speed e`, `phase e`, `at e`,\n\
                 `ratio e`, `inside`, `unbounded`, `on A B`, `to A B`.",
            example: "change crank speed 2rev\n\
                 change coupler = 4\n\
                 change coupler in 3..4",
        },
    },
    Verb {
        rule: Rule::set,
        entry: Entry {
            keyword: "set",
            section: Section::Changing,
            usage: "set [SETTING [VALUE [for NAMES]]]",
            summary: "change a setting, or print them",
            help: "`set` alone prints all settings, `set dt` this one. `set rho` and `set weight` can be for\n\
                 some constraints or points only. `help settings` lists them.",
            example: "set\n\
                 set dt 1/360\n\
                 set method newton\n\
                 set rho 0.25 for coupler",
        },
    },
    Verb {
        rule: Rule::undo,
        entry: Entry {
            keyword: "undo",
            section: Section::Changing,
            usage: "undo [N]",
            summary: "take back the last commands that changed anything",
            help: "Runs included.",
            example: "undo\n\
                 undo 3",
        },
    },
    Verb {
        rule: Rule::redo,
        entry: Entry {
            keyword: "redo",
            section: Section::Changing,
            usage: "redo [N]",
            summary: "do again what was undone",
            help: "",
            example: "redo",
        },
    },
    Verb {
        rule: Rule::reset,
        entry: Entry {
            keyword: "reset",
            section: Section::Changing,
            usage: "reset",
            summary: "time 0, and the points where they stood when the clock left 0",
            help: "",
            example: "reset",
        },
    },
    Verb {
        rule: Rule::clear,
        entry: Entry {
            keyword: "clear",
            section: Section::Changing,
            usage: "clear",
            summary: "an empty world",
            help: "",
            example: "clear",
        },
    },
];

impl Changing {
    /// Whether it changes what there is, and does not only say or write it.
    pub const fn leaves_a_mark(&self) -> bool {
        !matches!(self, Self::Settings(_))
    }

    /// The statement that does what it did when it was stopped after so many commands.
    pub fn stopped_after(&self, n: u64) -> Option<String> {
        match self {
            Self::Undo(_) => Some(format!("undo {n}")),
            Self::Redo(_) => Some(format!("redo {n}")),
            _ => None,
        }
    }

    /// Whether it makes or changes things, without letting time pass.
    pub(super) fn is_edit(&self) -> bool {
        matches!(
            self,
            Self::Delete { .. }
                | Self::Off(_)
                | Self::On(_)
                | Self::Rename { .. }
                | Self::Change { .. }
        )
    }

    /// Whether it gives something that is there another value.
    pub(super) const fn is_adjustment(&self) -> bool {
        matches!(self, Self::Off(_) | Self::On(_) | Self::Change { .. } | Self::Set { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::delete => Self::Delete { names: c.names()?, cascade: c.flag(Rule::kw_cascade) },
            Rule::off => Self::Off(c.names()?),
            Rule::on => Self::On(c.names()?),
            Rule::rename => Self::Rename { from: c.name()?, to: c.name()? },
            Rule::change => Self::Change { name: c.name()?, parts: change_parts(c)? },
            Rule::set => set(c)?,
            Rule::undo => Self::Undo(c.expr_if_any()?),
            Rule::redo => Self::Redo(c.expr_if_any()?),
            Rule::reset => Self::Reset,
            Rule::clear => Self::Clear,
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Delete { names, cascade } => {
                let names = Names { names, stops: &["cascade"] };
                write!(f, "delete {names}{}", if *cascade { " cascade" } else { "" })
            }
            Self::Off(names) => write!(f, "off {}", Names { names, stops: &[] }),
            Self::On(names) => write!(f, "on {}", Names { names, stops: &[] }),
            Self::Rename { from, to } => write!(f, "rename {from} to {to}"),
            Self::Change { name, parts } => {
                write!(f, "change {name}")?;
                parts.iter().try_for_each(|part| write!(f, " {part}"))
            }
            Self::Settings(None) => f.write_str("set"),
            Self::Settings(Some(setting)) => write!(f, "set {setting}"),
            Self::Set { setting, value, targets } => {
                write!(f, "set {setting} {}", Guarded { expr: value, stops: &["for"] })?;
                match targets.as_slice() {
                    [] => Ok(()),
                    names => write!(f, " for {}", Names { names, stops: &[] }),
                }
            }
            Self::Undo(n) => write!(f, "undo{}", Clause(" ", n)),
            Self::Redo(n) => write!(f, "redo{}", Clause(" ", n)),
            Self::Reset => f.write_str("reset"),
            Self::Clear => f.write_str("clear"),
        }
    }
}

fn change_parts(c: &mut Cursor) -> Result<Vec<Part>, Diagnostic> {
    parts(c, |first, second| refusal::part_twice(first.span, second.span))
}

fn set(c: &mut Cursor) -> Result<Changing, Diagnostic> {
    let Some(setting) = c.setting_if_any() else { return Ok(Changing::Settings(None)) };
    Ok(match c.expr_if_any()? {
        None => Changing::Settings(Some(setting)),
        Some(value) => Changing::Set { setting, value, targets: c.names()? },
    })
}
