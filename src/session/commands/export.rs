//! `export`: files for plotters and cutters, in true size.

use crate::diag::{Diagnostic, Span, format_rounded};
use crate::errors;
use crate::lang::ast::{ExportPart, Expr, Ident, Text};
use crate::render::Scene;
use crate::render::export::{Cut, PartFlaw, Placed, Strokes, dxf, lay_out, outlines, parts};
use crate::session::execution::Execution;
use crate::session::file_kind::{FileKind, ends_in};
use crate::session::output_file::wrong_ending;

/// The longest that a machine is asked for, mm: a hundred metres.
const LARGEST: f64 = 1e5;
/// The shortest, mm.
const SMALLEST: f64 = 1e-3;

/// The parts of an `export`, as they were said.
#[derive(Default)]
struct Wish {
    scale: Option<f64>,
    width: Option<(f64, Span)>,
    hole: Option<(f64, Span)>,
    kerf: Option<(f64, Span)>,
}

impl Execution<'_> {
    pub(crate) fn export(
        &mut self,
        path: &Text,
        said: &[ExportPart],
        span: Span,
    ) -> Result<(), Diagnostic> {
        let is_dxf = ends_in(&path.value, ".dxf");
        let kind = if is_dxf { FileKind::Dxf } else { FileKind::Picture };
        if !is_dxf && !ends_in(&path.value, ".svg") && !path.value.is_empty() {
            self.output_path(path)?;
            return Err(wrong_ending(path, &[".svg", ".dxf"]));
        }
        let file = self.output_file(path, kind)?;
        let wish = self.wish(said)?;
        let scale = wish.scale.unwrap_or(1.0);
        let bytes = match wish.width {
            Some((width, _)) => {
                let sheet = self.cut(&wish, scale, width, span)?;
                if is_dxf { dxf(&sheet) } else { outlines(&sheet) }
            }
            None if is_dxf => {
                return Err(Diagnostic::error(errors::UNMAKEABLE, "how wide are the parts?")
                    .at(path.span, "a `.dxf` holds parts to be cut")
                    .help(format!("`export \"{}\" in mm scale 10 width 12 hole 4`", path.value)));
            }
            None => {
                if let Some((_, at)) = wish.hole.or(wish.kerf) {
                    return Err(Diagnostic::error(errors::UNMAKEABLE, "this is for parts")
                        .at(at, "strokes for a plotter have none")
                        .help("`width 12` makes parts so wide"));
                }
                let strokes = Strokes::of(&Scene::new(&self.state.world), scale);
                let strokes = strokes.ok_or_else(|| nothing(span, "neither a bar nor a path"))?;
                must_fit(strokes.size(), span)?;
                strokes.svg()
            }
        };
        self.queue_file(file, kind, bytes.into_bytes(), path.span);
        Ok(())
    }

    fn wish(&mut self, said: &[ExportPart]) -> Result<Wish, Diagnostic> {
        let mut wish = Wish::default();
        for part in said {
            match part {
                ExportPart::In(unit) => must_be_mm(unit)?,
                ExportPart::Scale(expr) => wish.scale = Some(self.length(expr)?),
                ExportPart::Width(expr) => wish.width = Some((self.length(expr)?, expr.span)),
                ExportPart::Hole(expr) => wish.hole = Some((self.length(expr)?, expr.span)),
                ExportPart::Kerf(expr) => wish.kerf = Some((self.length(expr)?, expr.span)),
            }
        }
        Ok(wish)
    }

    /// A length that a machine can make, mm.
    fn length(&mut self, expr: &Expr) -> Result<f64, Diagnostic> {
        let value = self.resolve().number(expr)?;
        if (SMALLEST..=LARGEST).contains(&value) {
            return Ok(value);
        }
        Err(Diagnostic::error(errors::OUT_OF_RANGE, "expected 0.001 to 100000 mm")
            .at(expr.span, format!("this is {}", format_rounded(value))))
    }

    /// The parts on their sheet.
    fn cut(&self, wish: &Wish, scale: f64, width: f64, span: Span) -> Result<Placed, Diagnostic> {
        let kerf = wish.kerf.map_or(0.0, |(kerf, _)| kerf);
        let wrong = |message: &str, at, label| {
            Err(Diagnostic::error(errors::UNMAKEABLE, message.to_owned()).at(at, label))
        };
        if let Some((hole, at)) = wish.hole {
            if hole >= width {
                let label = format!("as wide as the part, {} mm", format_rounded(width));
                return wrong("a hole leaves some of the part around it", at, label);
            }
            if let Some((_, at)) = wish.kerf.filter(|_| kerf >= hole) {
                let label = format!("as wide as a hole, {} mm", format_rounded(hole));
                return wrong("a cut is thinner than a hole", at, label);
            }
        }
        if let Some((_, at)) = wish.kerf.filter(|_| kerf >= width) {
            let label = format!("as wide as the part, {} mm", format_rounded(width));
            return wrong("a cut is thinner than the part", at, label);
        }
        let hole = wish.hole.map(|(hole, _)| hole);
        let made = parts(&self.state.world, &Cut { scale, width, hole, kerf });
        let made = made.map_err(|PartFlaw::HolesMeet(name, [a, b], apart)| {
            let apart = format_rounded(apart);
            Diagnostic::error(errors::UNMAKEABLE, format!("two holes of `{name}` would meet"))
                .at(span, format!("{a} and {b} are {apart} mm apart"))
                .help("a larger `scale` or a smaller `hole` keeps them apart")
        })?;
        if made.is_empty() {
            return Err(nothing(span, "no rod and no rigid body is switched on"));
        }
        let sheet = lay_out(made);
        must_fit(sheet.size, span)?;
        Ok(sheet)
    }
}

/// Refuses what no machine has room for.
fn must_fit(size: [f64; 2], span: Span) -> Result<(), Diagnostic> {
    if size.iter().all(|side| *side <= LARGEST) {
        return Ok(());
    }
    Err(Diagnostic::error(errors::OUT_OF_RANGE, "this is too large for a machine")
        .at(span, "more than a hundred metres")
        .help("a smaller `scale` makes it smaller"))
}

fn nothing(span: Span, why: &str) -> Diagnostic {
    Diagnostic::error(errors::NOTHING_TO_EXPORT, "there is nothing to make").at(span, why)
}

fn must_be_mm(unit: &Ident) -> Result<(), Diagnostic> {
    if &*unit.text == "mm" {
        return Ok(());
    }
    Err(Diagnostic::error(errors::UNKNOWN_UNIT, format!("unknown unit `{}`", unit.text))
        .at(unit.span, "machines are told mm")
        .help("`in mm scale 25.4` where a unit of the plane is an inch"))
}
