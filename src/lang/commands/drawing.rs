//! The commands that draw and record: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::Verb;
use crate::diag::{Diagnostic, Span};
use crate::lang::catalogue::{Entry, Section};
use crate::lang::expr::{Expr, Name};
use crate::lang::grammar::Rule;
use crate::lang::lower::{Cursor, refusal};
use crate::lang::parts::{Selection, Text};
use crate::lang::print::{Clause, Names, commas};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// `trace C every 5`
    Trace {
        /// The points.
        names: Vec<Name>,
        /// Only each so many frames.
        every: Option<Expr>,
    },
    /// `untrace C`, `untrace all`
    Untrace(Selection),
    /// `expose`, `expose every 30`, `expose off`
    Expose(Expose),
    /// `svg "now.svg"`
    Svg(Text),
    /// `record "frames/" every 10`
    Record {
        /// The file or folder.
        path: Text,
        /// Only each so many frames.
        every: Option<Expr>,
    },
    /// `record stop`
    RecordStop,
    /// `sample "relaxation" = e`: the next values of a series.
    Sample {
        /// Which series.
        series: Text,
        /// Its next values, at least one.
        values: Vec<Expr>,
    },
    /// `plot "errors.svg" log title "..." x "..." y "..."`: all series as a chart.
    Plot {
        /// The file.
        path: Option<Text>,
        /// How it looks.
        parts: Vec<PlotPart>,
    },
}

/// What an `expose` asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Expose {
    /// `expose`: one ghost of what is now.
    Now,
    /// `expose every 30`: a ghost each so many frames.
    Every(Expr),
    /// `expose off`
    Off,
}

/// One part of a `plot`, each at most once.
#[derive(Debug, Clone, PartialEq)]
pub enum PlotPart {
    /// `log`: equal ratios are equally high.
    Log,
    /// `title "..."`
    Title(Text),
    /// `x "..."`: what the numbers to the right count.
    X(Text),
    /// `y "..."`: what the values are.
    Y(Text),
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::trace,
        entry: Entry {
            keyword: "trace",
            section: Section::Pictures,
            usage: "trace NAMES [every FRAMES]",
            summary: "record the paths of points",
            help: "",
            example: "trace C\n\
                 trace A C every 5",
        },
    },
    Verb {
        rule: Rule::untrace,
        entry: Entry {
            keyword: "untrace",
            section: Section::Pictures,
            usage: "untrace NAMES | all",
            summary: "forget the paths of points",
            help: "",
            example: "untrace C\n\
                 untrace all",
        },
    },
    Verb {
        rule: Rule::expose,
        entry: Entry {
            keyword: "expose",
            section: Section::Pictures,
            usage: "expose [every FRAMES | off]",
            summary: "multiple exposure: keep a ghost of the whole mechanism",
            help: "Alone it keeps one ghost of what is now.",
            example: "expose\n\
                 expose every 30\n\
                 expose off",
        },
    },
    Verb {
        rule: Rule::svg,
        entry: Entry {
            keyword: "svg",
            section: Section::Pictures,
            usage: "svg FILE",
            summary: "write a picture of what is now",
            help: "",
            example: r#"svg "now.svg""#,
        },
    },
    Verb {
        rule: Rule::record,
        entry: Entry {
            keyword: "record",
            section: Section::Pictures,
            usage: "record FILE [every FRAMES] | stop",
            summary: "write each frame from here on",
            help: r#"A folder (`"frames/"`) gets a picture a frame, an `.svg` is one animation, a `.csv` has
    time and the traced points. `record stop`, or the end of the script, writes them."#,
            example: r#"record "frames/" every 10
    record "motion.svg"
    record stop"#,
        },
    },
    Verb {
        rule: Rule::sample,
        entry: Entry {
            keyword: "sample",
            section: Section::Pictures,
            usage: "sample SERIES = VALUE, ...",
            summary: "append values to a named series, to be plotted",
            help: "The name of the series stands in quotes. `plot` draws all series.",
            example: r#"sample "relaxation" = distance(A, B) - 5
    relax 1
    sample "relaxation" = distance(A, B) - 5"#,
        },
    },
    Verb {
        rule: Rule::plot,
        entry: Entry {
            keyword: "plot",
            section: Section::Pictures,
            usage: "plot [FILE] [log] [title TEXT] [x TEXT] [y TEXT]",
            summary: "write all series as a line chart against the number of the sample",
            help: "The first sample of a series has number 0. With `log` equal ratios are equally high,
    and values that are not above 0 are left out.",
            example: r#"plot "errors.svg" log title "Two circles" x "iteration" y "error""#,
        },
    },
];

impl Drawing {
    /// Whether it changes what there is, and does not only say or write it.
    pub const fn leaves_a_mark(&self) -> bool {
        !matches!(self, Self::Svg(_) | Self::Plot { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::trace => Self::Trace { names: c.names()?, every: c.clause(Rule::every)? },
            Rule::untrace => Self::Untrace(c.selection()?),
            Rule::expose => expose(c)?,
            Rule::svg => Self::Svg(c.text()?),
            Rule::record if c.flag(Rule::kw_stop) => Self::RecordStop,
            Rule::record => Self::Record { path: c.text()?, every: c.clause(Rule::every)? },
            Rule::sample => Self::Sample { series: c.text()?, values: c.exprs()? },
            Rule::plot => Self::Plot { path: c.text_if_any()?, parts: plot_parts(c)? },
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Trace { names, every } => {
                let names = Names { names, stop: "every" };
                write!(f, "trace {names}{}", Clause(" every ", every))
            }
            Self::Untrace(what) => write!(f, "untrace {what}"),
            Self::Expose(Expose::Now) => f.write_str("expose"),
            Self::Expose(Expose::Every(frames)) => write!(f, "expose every {frames}"),
            Self::Expose(Expose::Off) => f.write_str("expose off"),
            Self::Svg(path) => write!(f, "svg {path}"),
            Self::Record { path, every } => {
                write!(f, "record {path}{}", Clause(" every ", every))
            }
            Self::RecordStop => f.write_str("record stop"),
            Self::Sample { series, values } => write!(f, "sample {series} = {}", commas(values)),
            Self::Plot { path, parts } => {
                write!(f, "plot{}", Clause(" ", path))?;
                parts.iter().try_for_each(|part| write!(f, " {part}"))
            }
        }
    }
}

fn plot_parts(c: &mut Cursor) -> Result<Vec<PlotPart>, Diagnostic> {
    let mut parts = Vec::new();
    let mut seen: Vec<(Rule, Span)> = Vec::new();
    while let Some((rule, span)) = c.peek_span() {
        if let Some((_, first)) = seen.iter().find(|(known, _)| *known == rule) {
            return Err(refusal::twice(c.text_at(span), *first, span));
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

fn expose(c: &mut Cursor) -> Result<Drawing, Diagnostic> {
    if c.flag(Rule::kw_off) {
        return Ok(Drawing::Expose(Expose::Off));
    }
    let every = c.clause(Rule::every)?;
    Ok(Drawing::Expose(every.map_or(Expose::Now, Expose::Every)))
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
