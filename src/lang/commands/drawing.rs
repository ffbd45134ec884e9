//! The commands that draw and record: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::{Verb, each};
use crate::diag::{Diagnostic, Span};
use crate::lang::catalogue::{Entry, Section};
use crate::lang::expr::{Expr, Ident, Name, Unit};
use crate::lang::grammar::Rule;
use crate::lang::lower::{Cursor, refusal};
use crate::lang::parts::{Selection, Text};
use crate::lang::print::{Clause, InUnit, Names, commas};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// `trace C as "before" every 5`
    Trace {
        /// The points.
        names: Vec<Name>,
        /// What the path is called.
        label: Option<Text>,
        /// Only each so many frames.
        every: Option<Expr>,
    },
    /// `untrace C`, `untrace all`
    Untrace(Selection),
    /// `untrace "before"`
    UntraceLabel(Text),
    /// `expose`, `expose every 30`, `expose off`
    Expose(Expose),
    /// `svg "now.svg" width 600 dark`
    Svg {
        /// The file.
        path: Text,
        /// How it looks.
        parts: Vec<PicturePart>,
    },
    /// `record "frames/" every 10`, `record "t.csv" of time, angle(A, B) in deg`
    Record {
        /// The file or folder.
        path: Text,
        /// What a table has columns of; none for the traced points.
        columns: Vec<Column>,
        /// Only each so many frames.
        every: Option<Expr>,
        /// How its pictures look.
        parts: Vec<PicturePart>,
    },
    /// `export "parts.dxf" in mm scale 10 width 12`: a file for a machine.
    Export {
        /// The file.
        path: Text,
        /// What it is measured in, and how parts are made.
        parts: Vec<ExportPart>,
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
    /// `plot "errors.svg" log title "..." x "..." y "..."`: all series as a chart, or measures
    /// against another.
    Plot {
        /// The file.
        path: Option<Text>,
        /// Which measures are drawn, if not the series.
        curves: Option<Curves>,
        /// How it looks.
        parts: Vec<PlotPart>,
    },
}

/// A column of a table, two of a vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its values.
    pub value: Expr,
    /// What they are counted in.
    pub unit: Unit,
}

/// `y, z against x` in a `plot`.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// What is drawn upwards, a line each; at least one.
    pub up: Vec<Expr>,
    /// What is drawn to the right.
    pub against: Expr,
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

/// One part of an `svg` or a `record`, each at most once.
#[derive(Debug, Clone, PartialEq)]
pub enum PicturePart {
    /// `width 600`: how wide it is, px.
    Width(Expr),
    /// `dark`: light lines on dark paper.
    Dark,
    /// `transparent`: no paper.
    Transparent,
    /// `without names`
    WithoutNames,
    /// `title "..."`
    Title(Text),
}

/// One part of an `export`, each at most once.
#[derive(Debug, Clone, PartialEq)]
pub enum ExportPart {
    /// `in mm`: what the machine measures in.
    In(Ident),
    /// `scale 10`: so many of these is one unit of the plane.
    Scale(Expr),
    /// `width 12`: parts, so wide.
    Width(Expr),
    /// `hole 4`: the diameter of their holes.
    Hole(Expr),
    /// `kerf 0.2`: how much the cut takes away.
    Kerf(Expr),
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
            usage: "trace NAMES [as TEXT] [every FRAMES]",
            summary: "record the paths of points",
            help: "With `as` the path has a name, which stands in the legend, and a path of the same point that\n\
                 still grew ends there and stays drawn. `reset` empties those that grow.",
            example: "trace C\n\
                 trace A C every 5\n\
                 trace C as \"before\"",
        },
    },
    Verb {
        rule: Rule::untrace,
        entry: Entry {
            keyword: "untrace",
            section: Section::Pictures,
            usage: "untrace NAMES | TEXT | all",
            summary: "forget the paths of points, or the one of this name",
            help: "",
            example: "untrace C\n\
                 untrace \"before\"\n\
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
            usage: "svg FILE [width PX] [dark] [transparent] [without names] [title TEXT]",
            summary: "write a picture of what is now",
            help: "The ending says what it is: `.svg`, or `.png` where the program is built with pictures.\n\
                 What is not solved is red, with the amount by which it is off.",
            example: r#"svg "now.svg"
    svg "slide.svg" width 600 dark without names title "A four-bar""#,
        },
    },
    Verb {
        rule: Rule::record,
        entry: Entry {
            keyword: "record",
            section: Section::Pictures,
            usage: "record FILE [of VALUE [in UNIT], ...] [every FRAMES] [width PX] [dark] [transparent] [without names] [title TEXT] | stop",
            summary: "write each frame from here on",
            help: r#"A folder (`"frames/"`) gets a picture a frame, an `.svg` or a `.gif` is one animation, a
    `.csv` has time and the traced points. With `of` a `.csv` has these columns, two of a vector, and a
    row of now. `record stop`, or the end of the script, writes them. Pictures look as those of `svg` do;
    a `.gif` takes a program that is built with pictures."#,
            example: r#"record "frames/" every 10
    record "motion.svg"
    record "t.csv" of time, angle(A, B) in deg, C every 10
    record stop"#,
        },
    },
    Verb {
        rule: Rule::export,
        entry: Entry {
            keyword: "export",
            section: Section::Pictures,
            usage: "export FILE [in mm] [scale MM] [width MM] [hole MM] [kerf MM]",
            summary: "write a file for a plotter or a cutter, in true size",
            help: "`scale` says how many mm one unit of the plane is. Without `width` an `.svg` for plotters:\n\
                 strokes only, the paths and the mechanism each on a layer of its own. With `width` an `.svg`\n\
                 or a `.dxf` for cutters: each rod and each rigid body an outline so wide with holes, laid\n\
                 side by side; the outlines lie half a `kerf` outside, and the holes inside.",
            example: r#"export "plot.svg" in mm scale 10
    export "parts.dxf" in mm scale 10 width 12 hole 4 kerf 0.2"#,
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
            usage: "plot [FILE] [MEASURES against MEASURE|time] [log] [title TEXT] [x TEXT] [y TEXT]",
            summary: "write measures against another as a line chart, or all series against the sample",
            help: "Of a measure each value is drawn at that of the other in the same frame. The first sample of a
    series has number 0. With `log` equal ratios are equally high, and values that are not above 0
    are left out.",
            example: r#"plot "errors.svg" log title "Two circles" x "iteration" y "error"
    plot "lift.svg" lift against phi
    plot d, e against time"#,
        },
    },
];

impl Drawing {
    /// Whether it changes what there is, and does not only say or write it.
    pub const fn leaves_a_mark(&self) -> bool {
        !matches!(self, Self::Svg { .. } | Self::Export { .. } | Self::Plot { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::trace => {
                let names = c.names()?;
                let label = match c.take(Rule::as_text) {
                    Some(clause) => Some(c.within(clause).text()?),
                    None => None,
                };
                Self::Trace { names, label, every: c.clause(Rule::every)? }
            }
            Rule::untrace => match c.text_if_any()? {
                Some(label) => Self::UntraceLabel(label),
                None => Self::Untrace(c.selection()?),
            },
            Rule::expose => expose(c)?,
            Rule::svg => Self::Svg { path: c.text()?, parts: picture_parts(c)? },
            Rule::record if c.flag(Rule::kw_stop) => Self::RecordStop,
            Rule::record => {
                let (path, columns) = (c.text()?, columns(c)?);
                let every = c.clause(Rule::every)?;
                Self::Record { path, columns, every, parts: picture_parts(c)? }
            }
            Rule::export => Self::Export { path: c.text()?, parts: export_parts(c)? },
            Rule::sample => Self::Sample { series: c.text()?, values: c.exprs()? },
            Rule::plot => {
                let (path, curves) = (c.text_if_any()?, curves(c)?);
                Self::Plot { path, curves, parts: plot_parts(c)? }
            }
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Trace { names, label, every } => {
                let names = Names { names, stops: &["every", "as"] };
                let (label, every) = (Clause(" as ", label), Clause(" every ", every));
                write!(f, "trace {names}{label}{every}")
            }
            Self::Untrace(what) => write!(f, "untrace {what}"),
            Self::UntraceLabel(label) => write!(f, "untrace {label}"),
            Self::Expose(Expose::Now) => f.write_str("expose"),
            Self::Expose(Expose::Every(frames)) => write!(f, "expose every {frames}"),
            Self::Expose(Expose::Off) => f.write_str("expose off"),
            Self::Svg { path, parts } => {
                write!(f, "svg {path}")?;
                write_each(f, parts)
            }
            Self::Record { path, columns, every, parts } => {
                write!(f, "record {path}")?;
                if !columns.is_empty() {
                    write!(f, " of {}", commas(columns))?;
                }
                write!(f, "{}", Clause(" every ", every))?;
                write_each(f, parts)
            }
            Self::Export { path, parts } => {
                write!(f, "export {path}")?;
                write_each(f, parts)
            }
            Self::RecordStop => f.write_str("record stop"),
            Self::Sample { series, values } => write!(f, "sample {series} = {}", commas(values)),
            Self::Plot { path, curves, parts } => {
                write!(f, "plot{}{}", Clause(" ", path), Clause(" ", curves))?;
                write_each(f, parts)
            }
        }
    }
}

fn columns(c: &mut Cursor) -> Result<Vec<Column>, Diagnostic> {
    let Some(list) = c.take(Rule::columns) else { return Ok(Vec::new()) };
    each(&mut c.within(list), Rule::column, |c| Ok(Column { value: c.expr()?, unit: c.unit()? }))
}

fn curves(c: &mut Cursor) -> Result<Option<Curves>, Diagnostic> {
    let Some(clause) = c.take(Rule::against) else { return Ok(None) };
    let mut up = c.within(clause).exprs()?;
    let against = up.pop().expect("the grammar has two values at least here");
    Ok(Some(Curves { up, against }))
}

fn write_each(f: &mut Formatter, parts: &[impl Display]) -> fmt::Result {
    parts.iter().try_for_each(|part| write!(f, " {part}"))
}

/// The parts that follow, in any order, each at most once.
fn parts<T>(
    c: &mut Cursor,
    part: impl Fn(Rule, &mut Cursor) -> Result<T, Diagnostic>,
) -> Result<Vec<T>, Diagnostic> {
    let mut parts = Vec::new();
    let mut seen: Vec<(Rule, Span)> = Vec::new();
    while let Some((rule, span)) = c.peek_span() {
        if let Some((_, first)) = seen.iter().find(|(known, _)| *known == rule) {
            return Err(refusal::twice(c.text_at(span), *first, span));
        }
        seen.push((rule, span));
        let pair = c.take(rule).expect("it is the next thing");
        parts.push(part(rule, &mut c.within(pair))?);
    }
    Ok(parts)
}

fn plot_parts(c: &mut Cursor) -> Result<Vec<PlotPart>, Diagnostic> {
    parts(c, |rule, c| {
        Ok(match rule {
            Rule::title => PlotPart::Title(c.text()?),
            Rule::x_label => PlotPart::X(c.text()?),
            Rule::y_label => PlotPart::Y(c.text()?),
            _ => PlotPart::Log,
        })
    })
}

fn picture_parts(c: &mut Cursor) -> Result<Vec<PicturePart>, Diagnostic> {
    parts(c, |rule, c| {
        Ok(match rule {
            Rule::width => PicturePart::Width(c.expr()?),
            Rule::title => PicturePart::Title(c.text()?),
            Rule::kw_dark => PicturePart::Dark,
            Rule::kw_transparent => PicturePart::Transparent,
            _ => PicturePart::WithoutNames,
        })
    })
}

fn export_parts(c: &mut Cursor) -> Result<Vec<ExportPart>, Diagnostic> {
    parts(c, |rule, c| {
        Ok(match rule {
            Rule::scale => ExportPart::Scale(c.expr()?),
            Rule::width => ExportPart::Width(c.expr()?),
            Rule::hole => ExportPart::Hole(c.expr()?),
            Rule::kerf => ExportPart::Kerf(c.expr()?),
            _ => ExportPart::In(c.unit_word()),
        })
    })
}

fn expose(c: &mut Cursor) -> Result<Drawing, Diagnostic> {
    if c.flag(Rule::kw_off) {
        return Ok(Drawing::Expose(Expose::Off));
    }
    let every = c.clause(Rule::every)?;
    Ok(Drawing::Expose(every.map_or(Expose::Now, Expose::Every)))
}

impl Display for Column {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}{}", self.value, InUnit(self.unit))
    }
}

impl Display for Curves {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} against {}", commas(&self.up), self.against)
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

impl Display for PicturePart {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Width(px) => write!(f, "width {px}"),
            Self::Dark => f.write_str("dark"),
            Self::Transparent => f.write_str("transparent"),
            Self::WithoutNames => f.write_str("without names"),
            Self::Title(text) => write!(f, "title {text}"),
        }
    }
}

impl Display for ExportPart {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::In(unit) => write!(f, "in {}", unit.text),
            Self::Scale(value) => write!(f, "scale {value}"),
            Self::Width(value) => write!(f, "width {value}"),
            Self::Hole(value) => write!(f, "hole {value}"),
            Self::Kerf(value) => write!(f, "kerf {value}"),
        }
    }
}
