//! The commands that let time pass, or the solver work: what each says, how it is read and written, and its help.

use std::fmt::{self, Formatter};

use super::Verb;
use crate::diag::Diagnostic;
use crate::lang::catalogue::{Entry, Section};
use crate::lang::expr::Expr;
use crate::lang::grammar::Rule;
use crate::lang::lower::Cursor;
use crate::lang::parts::Promise;
use crate::lang::print::{Clause, Guarded};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Running {
    /// `step`, `step 360 within 1e-9 in 2ms`
    Step {
        /// The number of frames.
        frames: Option<Expr>,
        /// What must hold for each frame.
        promise: Promise,
    },
    /// `run 2.5`
    Run {
        /// The simulated time.
        time: Expr,
        /// What must hold for each frame.
        promise: Promise,
    },
    /// `relax`, `relax 100`
    Relax(Option<Expr>),
    /// `solve`
    Solve(Promise),
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::step,
        entry: Entry {
            keyword: "step",
            section: Section::Running,
            usage: "step [FRAMES] [within TOLERANCE] [in WALL_TIME]",
            summary: "let frames go by: the clock advances by dt, then the solver works",
            help: "`within e` promises that each frame reaches the tolerance e, `in e` that none takes longer.",
            example: "step\n\
                 step 360\n\
                 step 100 within 1e-9 in 2ms",
        },
    },
    Verb {
        rule: Rule::run,
        entry: Entry {
            keyword: "run",
            section: Section::Running,
            usage: "run TIME [within TOLERANCE] [in WALL_TIME]",
            summary: "let simulated time go by, in whole frames",
            help: "`within e` promises that each frame reaches the tolerance e, `in e` that none takes longer.",
            example: "run 2.5",
        },
    },
    Verb {
        rule: Rule::relax,
        entry: Entry {
            keyword: "relax",
            section: Section::Running,
            usage: "relax [N]",
            summary: "bare iterations, the clock stands still",
            help: "",
            example: "relax\n\
                 relax 100",
        },
    },
    Verb {
        rule: Rule::solve,
        entry: Entry {
            keyword: "solve",
            section: Section::Running,
            usage: "solve [within TOLERANCE] [in WALL_TIME]",
            summary: "iterate until converged or stalled, the clock stands still",
            help: "Says which of the two.",
            example: "solve\n\
                 solve within 1e-12",
        },
    },
];

impl Running {
    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::step => Self::Step { frames: c.expr_if_any()?, promise: c.promise()? },
            Rule::run => Self::Run { time: c.expr()?, promise: c.promise()? },
            Rule::relax => Self::Relax(c.expr_if_any()?),
            Rule::solve => Self::Solve(c.promise()?),
            _ => return Ok(None),
        }))
    }

    /// The statement that does what it did when it was stopped after so many frames or iterations; none where
    /// they depend on a clock or on more than its own.
    pub fn stopped_after(&self, n: u64) -> Option<String> {
        match self {
            Self::Step { promise, .. } | Self::Run { promise, .. } => {
                let is_plain = promise.within.is_none() && promise.in_time.is_none();
                is_plain.then(|| format!("step {n}"))
            }
            Self::Relax(_) => Some(format!("relax {n}")),
            Self::Solve(_) => None,
        }
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Step { frames: None, promise } => write!(f, "step{promise}"),
            Self::Step { frames: Some(frames), promise } => {
                write!(f, "step {}{promise}", Guarded { expr: frames, stops: &["within", "in"] })
            }
            Self::Run { time, promise } => write!(f, "run {time}{promise}"),
            Self::Relax(n) => write!(f, "relax{}", Clause(" ", n)),
            Self::Solve(promise) => write!(f, "solve{promise}"),
        }
    }
}
