//! The commands that ask questions: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::Verb;
use crate::diag::Diagnostic;
use crate::lang::catalogue::{Entry, Section};
use crate::lang::constraint::Relation;
use crate::lang::expr::{Expr, Ident, Name, Unit};
use crate::lang::grammar::Rule;
use crate::lang::lower::{Cursor, is_bare, refusal};
use crate::lang::parts::{Promise, Text};
use crate::lang::print::{Clause, commas};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Looking {
    /// `list`, `list points`
    List(Option<ListWhat>),
    /// `show`, `show C`
    Show(Option<Name>),
    /// `print C, distance(A, C), "text"`
    Print(Vec<PrintItem>),
    /// `C`, `distance(A, C), "text"`: values alone print; the lone name of a thing shows it.
    Bare(Vec<PrintItem>),
    /// `check`
    Check,
    /// `why C`
    Why(Name),
    /// `limits crank`
    Limits(Name),
    /// `effects`
    Effects,
    /// `accuracy`, `accuracy within 1e-9 in 2ms`
    Accuracy(Promise),
    /// `assert distance(u, t, p) = 0 within 1e-9`
    Assert {
        /// The left-hand side.
        left: Expr,
        /// How it compares, and to what.
        relation: Relation,
        /// The tolerance.
        within: Option<Expr>,
    },
    /// `help`, `help motor`
    Help(Option<Ident>),
    /// `history`
    History,
    /// `examples`, `examples four-bar`
    Examples(Option<Ident>),
    /// `view`
    View,
    /// `quit`, `exit`
    Quit,
}

/// What a `list` lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ListWhat {
    /// `list points`
    Points,
    /// `list constraints`
    Constraints,
    /// `list traces`
    Traces,
    /// `list parameters`
    Parameters,
    /// `list measures`
    Measures,
    /// `list definitions`
    Definitions,
}

impl ListWhat {
    /// Every list, in the order of the reference.
    pub const ALL: [Self; 6] = [
        Self::Points,
        Self::Constraints,
        Self::Traces,
        Self::Parameters,
        Self::Measures,
        Self::Definitions,
    ];

    /// How it is asked for.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::Constraints => "constraints",
            Self::Traces => "traces",
            Self::Parameters => "parameters",
            Self::Measures => "measures",
            Self::Definitions => "definitions",
        }
    }
}

/// One item of a `print`.
#[derive(Debug, Clone, PartialEq)]
pub enum PrintItem {
    /// A number or a vector.
    Value(Expr),
    /// `angle(A, B) in deg`: a number, by how many of the unit it is.
    InUnit(Expr, Unit),
    /// A text, as it is.
    Text(Text),
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::list,
        entry: Entry {
            keyword: "list",
            section: Section::Looking,
            usage: "list [points | constraints | traces | parameters | measures | definitions]",
            summary: "say what there is",
            help: "",
            example: "list\n\
                 list points",
        },
    },
    Verb {
        rule: Rule::show,
        entry: Entry {
            keyword: "show",
            section: Section::Looking,
            usage: "show [NAME]",
            summary: "draw the mechanism; a point with its constraints, a constraint with its residual",
            help: "Alone it draws the mechanism: as `svg` does where the terminal shows pictures, in letters\n\
                   elsewhere.",
            example: "show\n\
                 show C",
        },
    },
    Verb {
        rule: Rule::print,
        entry: Entry {
            keyword: "print",
            section: Section::Looking,
            usage: "print ITEM [in UNIT], ...",
            summary: "write values and strings on one line",
            help: "Numbers in the shortest form that reads back to the same bits, vectors as `(x, y)`,\n\
                 a space between two items. `in deg`, `in rad`, `in rev`, `in rpm`, `in s` or `in ms` behind a\n\
                 number writes how many of these it is.",
            example: r#"print C, distance(A, C), time
    print "x is", C.x
    print angle(A, C) in deg, "degrees""#,
        },
    },
    Verb {
        rule: Rule::check,
        entry: Entry {
            keyword: "check",
            section: Section::Looking,
            usage: "check",
            summary: "degrees of freedom; what is redundant, conflicting, near-singular",
            help: "",
            example: "check",
        },
    },
    Verb {
        rule: Rule::why,
        entry: Entry {
            keyword: "why",
            section: Section::Looking,
            usage: "why NAME",
            summary: "what holds a point, or what a constraint conflicts with",
            help: "",
            example: "why C",
        },
    },
    Verb {
        rule: Rule::limits,
        entry: Entry {
            keyword: "limits",
            section: Section::Looking,
            usage: "limits NAME",
            summary: "how far what drives can go, and what stops it",
            help: "NAME is a motor, a constraint with one value, or a parameter that constraints follow. The\n\
                 rest is held as it is now. The motion is followed both ways: to a dead point, where it\n\
                 folds back; to a constraint that stops it; to where a length would be negative; or as far\n\
                 as the search goes. Change points are where it could go on in more than one way.",
            example: "limits crank\n\
                 limits jack\n\
                 limits w",
        },
    },
    Verb {
        rule: Rule::effects,
        entry: Entry {
            keyword: "effects",
            section: Section::Looking,
            usage: "effects",
            summary: "which effects the scene has switched on, why, and what each costs",
            help: "",
            example: "effects",
        },
    },
    Verb {
        rule: Rule::accuracy,
        entry: Entry {
            keyword: "accuracy",
            section: Section::Looking,
            usage: "accuracy [within TOLERANCE] [in WALL_TIME]",
            summary: "what accuracy costs in time on this very scene",
            help: "Does the longest run since the scene last changed again, on a copy, with every method and
    many settings. Prints a table and writes `accuracy.csv` and `accuracy.svg`. With a wish it
    names the one setting to use instead.",
            example: "accuracy\n\
                 accuracy within 1e-6\n\
                 accuracy in 2ms",
        },
    },
    Verb {
        rule: Rule::assert,
        entry: Entry {
            keyword: "assert",
            section: Section::Looking,
            usage: "assert VALUE RELATION [within TOLERANCE]",
            summary: "stop unless this holds",
            help: "Compares numbers, or vectors by their distance. In a batch a failed one ends the run\n\
                 with exit status 1.",
            example: "assert distance(u, t, p) = 0 within 1e-9\n\
                 assert C.x > 0",
        },
    },
    Verb {
        rule: Rule::help,
        entry: Entry {
            keyword: "help",
            section: Section::Looking,
            usage: "help [WORD]",
            summary: "say how a command is written and what it does",
            help: "",
            example: "help\n\
                 help motor",
        },
    },
    Verb {
        rule: Rule::history,
        entry: Entry {
            keyword: "history",
            section: Section::Looking,
            usage: "history",
            summary: "list what was typed in this session",
            help: "Without what failed. `save \"typed.link\" history` writes it.",
            example: "history",
        },
    },
    Verb {
        rule: Rule::examples,
        entry: Entry {
            keyword: "examples",
            section: Section::Looking,
            usage: "examples [NAME]",
            summary: "list the mechanisms that come with the program, or print one",
            help: "",
            example: "examples\n\
                 examples four-bar",
        },
    },
    Verb {
        rule: Rule::view,
        entry: Entry {
            keyword: "view",
            section: Section::Looking,
            usage: "view",
            summary: "show the mechanism in a browser, to be looked at and taken hold of",
            help: "Prints the address of a page on this machine. What is typed shows there at once; what the\n\
                 mouse does is written as statements. In a session only: `linkwork view FILE` begins one.",
            example: "view",
        },
    },
    Verb {
        rule: Rule::quit,
        entry: Entry {
            keyword: "quit",
            section: Section::Looking,
            usage: "quit",
            summary: "end the session",
            help: "",
            example: "quit",
        },
    },
    Verb {
        rule: Rule::quit,
        entry: Entry {
            keyword: "exit",
            section: Section::Looking,
            usage: "exit",
            summary: "end the session",
            help: "The same as `quit`.",
            example: "exit",
        },
    },
];

impl Looking {
    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::list => Self::List(list_what(c)?),
            Rule::show => Self::Show(c.name_if_any()?),
            Rule::print => Self::Print(print_items(c)?),
            Rule::check => Self::Check,
            Rule::why => Self::Why(c.name()?),
            Rule::limits => Self::Limits(c.name()?),
            Rule::effects => Self::Effects,
            Rule::accuracy => Self::Accuracy(c.promise()?),
            Rule::assert => Self::Assert {
                left: c.expr()?,
                relation: relation(c)?,
                within: c.clause(Rule::within)?,
            },
            Rule::help => Self::Help(c.setting_if_any()),
            Rule::history => Self::History,
            Rule::examples => Self::Examples(c.example_if_any()),
            Rule::view => Self::View,
            Rule::bare => Self::Bare(print_items(c)?),
            Rule::quit => Self::Quit,
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::List(None) => f.write_str("list"),
            Self::List(Some(what)) => write!(f, "list {}", what.word()),
            Self::Show(name) => write!(f, "show{}", Clause(" ", name)),
            Self::Print(items) => write!(f, "print {}", commas(items)),
            Self::Bare(items) => write!(f, "{}", Bare(items)),
            Self::Check => f.write_str("check"),
            Self::Why(name) => write!(f, "why {name}"),
            Self::Limits(name) => write!(f, "limits {name}"),
            Self::Effects => f.write_str("effects"),
            Self::Accuracy(promise) => write!(f, "accuracy{promise}"),
            Self::Assert { left, relation, within } => {
                write!(f, "assert {left} {relation}{}", Clause(" within ", within))
            }
            Self::Help(None) => f.write_str("help"),
            Self::Help(Some(word)) => write!(f, "help {word}"),
            Self::History => f.write_str("history"),
            Self::Examples(name) => write!(f, "examples{}", Clause(" ", name)),
            Self::View => f.write_str("view"),
            Self::Quit => f.write_str("quit"),
        }
    }
}

fn relation(c: &mut Cursor) -> Result<Relation, Diagnostic> {
    let relation = c.relation_if_any()?;
    Ok(relation.expect("the grammar has a relation here"))
}

fn print_items(c: &mut Cursor) -> Result<Vec<PrintItem>, Diagnostic> {
    let mut items = Vec::new();
    while let Some(rule) = c.peek() {
        items.push(if rule == Rule::string {
            PrintItem::Text(c.text()?)
        } else {
            let value = c.expr()?;
            match c.unit_if_any()? {
                None => PrintItem::Value(value),
                Some(unit) => PrintItem::InUnit(value, unit),
            }
        });
    }
    Ok(items)
}

fn list_what(c: &mut Cursor) -> Result<Option<ListWhat>, Diagnostic> {
    let Some(word) = c.ident_if_any() else { return Ok(None) };
    let what = ListWhat::ALL.into_iter().find(|what| what.word() == &*word.text);
    what.map(Some).ok_or_else(|| refusal::unknown_list(&word, &ListWhat::ALL.map(ListWhat::word)))
}

/// Values alone; in parentheses where the first would be taken for a command.
struct Bare<'a>(&'a [PrintItem]);

impl Display for Bare<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let text = commas(self.0).to_string();
        match self.0 {
            [PrintItem::Value(value), rest @ ..] if !is_bare(&text) => {
                write!(f, "({value}){}", if rest.is_empty() { "" } else { ", " })?;
                write!(f, "{}", commas(rest))
            }
            [PrintItem::InUnit(value, unit), rest @ ..] if !is_bare(&text) => {
                write!(f, "({value}) in {}", unit.suffix())?;
                write!(f, "{}{}", if rest.is_empty() { "" } else { ", " }, commas(rest))
            }
            _ => f.write_str(&text),
        }
    }
}

impl Display for PrintItem {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::InUnit(value, unit) => write!(f, "{value} in {}", unit.suffix()),
            Self::Text(text) => write!(f, "{text}"),
        }
    }
}
