//! The legend below a drawing: a scale, and which colour is whose path.

use crate::diag::push_decimals;

/// The page.
pub const PAPER: &str = "#fdfdfb";
const INK: &str = "#273542";
const STEEL: &str = "#d3dce5";
const STEEL_DARK: &str = "#94a6b7";
const BRASS: &str = "#f5ecd3";
const BRASS_EDGE: &str = "#94793a";
const PENCIL: &str = "#7b8894";
const RAIL: &str = "#9aa7b3";
/// What is off.
const WRONG: &str = "#c8102e";

/// Colours of paths, in order; seven that stay apart for colour-blind eyes and in print
/// (M. Okabe and K. Ito, Color Universal Design, 2008; its yellow is too pale for lines on
/// paper and left out).
const PALETTE: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

/// Light paper or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theme {
    /// Dark lines on light paper.
    Light,
    /// Light lines on dark paper.
    Dark,
}

/// Each colour of a light picture with the one that takes its place in a dark one.
const DARK: [(&str, &str); 26] = [
    (PAPER, "#14191e"),
    (INK, "#dde5ec"),
    (STEEL, "#465462"),
    (STEEL_DARK, "#6f8496"),
    (BRASS, "#4a4127"),
    (BRASS_EDGE, "#cfb366"),
    (PENCIL, "#93a1ae"),
    (RAIL, "#657380"),
    (WRONG, "#ff5c6c"),
    ("#f1f4f7", "#2c3740"),
    ("#e3eaf0", "#333f4a"),
    ("#e9eef3", "#222b33"),
    ("#eef2f5", "#36434f"),
    ("#c3ccd4", "#45515c"),
    ("#cdbb8a", "#7d6f45"),
    ("#fbf6e8", "#241f14"),
    ("#cdb981", "#8a7946"),
    ("#e4e9ee", "#2c3740"),
    ("#ffffff", "#0c1014"),
    ("#a9b3bd", "#5b6772"),
    ("#0072b2", "#4aa8e0"),
    ("#d55e00", "#f08a3c"),
    ("#009e73", "#2cc79b"),
    ("#cc79a7", "#dd96bd"),
    ("#e69f00", "#f0b73c"),
    ("#000000", "#ffffff"),
];

impl Theme {
    /// A colour of a light picture in this one. Sky blue, and no colour at all, are the same in both.
    pub fn colour(self, light: &'static str) -> &'static str {
        match self {
            Self::Light => light,
            Self::Dark => {
                DARK.iter().find(|(known, _)| *known == light).map_or(light, |(_, dark)| dark)
            }
        }
    }
}

/// Radius of a joint, px.
pub const JOINT: f64 = 3.3;
/// Half the width of a rod with its edge, px.
pub const HALF_ROD: f64 = 4.3;
/// Radius of a motor, px.
pub const MOTOR: f64 = 8.5;
/// Size of letters, px.
const LETTER: f64 = 14.0;
/// Size of the letters below the drawing, px.
pub const CAPTION: f64 = 12.0;
/// Size of the letters of the title, px.
pub const HEADLINE: f64 = 17.0;
/// The size of the letters of an amount, px.
pub const AMOUNT: f64 = 13.0;
/// From the middle of a letter down to its base line, in sizes of letters.
pub const BASE_LINE: f64 = 0.34;

/// What a shape is, which says how it looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// The dark outline of a rod, beneath it.
    RodEdge,
    /// A rod.
    Rod,
    /// The dark outline of a crank, beneath it.
    CrankEdge,
    /// A crank.
    Crank,
    /// The outline of the inner stage of a telescope.
    PistonEdge,
    /// The inner stage of a telescope.
    Piston,
    /// The bar of a hinge, which may stretch.
    Link,
    /// A cord.
    Cord,
    /// The outline of a rigid body, beneath it.
    PlateEdge,
    /// A rigid body.
    Plate,
    /// The area within three rods.
    Web,
    /// A rail.
    Rail,
    /// A rail beyond the points that span it.
    RailOn,
    /// An end stop.
    Stop,
    /// A block on a rail.
    Block,
    /// The circle a crank pin runs on.
    Orbit,
    /// The disc of a motor.
    Motor,
    /// The arc of a motor's arrow.
    Turn,
    /// The head of a motor's arrow.
    TurnHead,
    /// A toothed wheel or rack.
    Wheel,
    /// A toothed ring.
    RingWheel,
    /// A ring whose teeth would be a blur.
    RingPlain,
    /// The inside of a wheel's rim.
    WheelWeb,
    /// A belt.
    Belt,
    /// A pitch circle.
    Pitch,
    /// From a wheel's centre to its marker.
    Spoke,
    /// A triangle under a frozen point.
    Ground,
    /// The hatching beneath it.
    Hatch,
    /// A joint.
    Joint,
    /// A pin within a bar.
    Pin,
    /// A mark in the tradition of drawings: tick, arc, chevron.
    Mark,
    /// The head of a dimension arrow.
    Arrow,
    /// A thin line that carries a mark.
    Construction,
    /// An axis of symmetry.
    Axis,
    /// A name.
    Name,
    /// By how much something is off.
    Amount,
    /// The title above the drawing.
    Headline,
    /// Text in the legend below the drawing.
    Caption,
    /// The line of the scale.
    Scale,
    /// A path.
    Trace(u8),
    /// A path that covers much of the page.
    Fine(u8),
    /// A path where frames missed their tolerance.
    Missed(u8),
    /// A path drawn lightly, to be drawn over as its point moves.
    Faint(u8),
}

/// How a class is drawn; widths and dashes in px.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    /// The name that classes of this look have in common.
    pub name: &'static str,
    /// The colour of the area, or `none`.
    pub fill: &'static str,
    /// The colour of the line, or `none`.
    pub stroke: &'static str,
    /// How wide the line is.
    pub width: f64,
    /// How long its dashes and gaps are in turn; nothing where it is not dashed.
    pub dash: &'static [f64],
    /// From 0, not there, to 1.
    pub opacity: f64,
}

const fn line(name: &'static str, stroke: &'static str, width: f64) -> Look {
    Look { name, fill: "none", stroke, width, dash: &[], opacity: 1.0 }
}

const fn area(name: &'static str, fill: &'static str, stroke: &'static str, width: f64) -> Look {
    Look { name, fill, stroke, width, dash: &[], opacity: 1.0 }
}

const fn dashed(look: Look, dash: &'static [f64]) -> Look {
    Look { dash, ..look }
}

const fn colour(number: u8) -> &'static str {
    PALETTE[number as usize % PALETTE.len()]
}

/// The colour number of the path at a place in the list of paths.
pub const fn colour_number(idx: usize) -> u8 {
    (idx % PALETTE.len()) as u8
}

impl Class {
    /// How it is drawn at full size.
    pub const fn look(self) -> Look {
        match self {
            Self::RodEdge => line("rod-edge", INK, 2.0 * HALF_ROD),
            Self::Rod => line("rod", STEEL, 2.0 * HALF_ROD - 2.6),
            Self::CrankEdge => line("crank-edge", INK, 2.0 * HALF_ROD),
            Self::Crank => line("crank", STEEL_DARK, 2.0 * HALF_ROD - 2.6),
            Self::PistonEdge => line("piston-edge", INK, 5.6),
            Self::Piston => line("piston", "#f1f4f7", 3.2),
            Self::Link => line("link", INK, 2.4),
            Self::Cord => line("cord", INK, 1.3),
            Self::PlateEdge => line("plate-edge", INK, 15.0),
            Self::Plate => area("plate", "#e3eaf0", "#e3eaf0", 12.4),
            Self::Web => area("web", "#e9eef3", "none", 0.0),
            Self::Rail => line("rail", RAIL, 3.2),
            Self::RailOn => dashed(line("rail-on", RAIL, 2.0), &[7.0, 5.0]),
            Self::Stop => line("stop", INK, 2.6),
            Self::Block => area("block", "#eef2f5", INK, 1.5),
            Self::Orbit => dashed(line("orbit", "#c3ccd4", 1.0), &[1.0, 4.0]),
            Self::Motor => area("motor", INK, PAPER, 1.5),
            Self::Turn => line("turn", INK, 1.6),
            Self::TurnHead => area("turn-head", INK, "none", 0.0),
            Self::Wheel => area("wheel", BRASS, BRASS_EDGE, 1.3),
            Self::Pitch => dashed(line("pitch", "#cdbb8a", 0.9), &[9.0, 3.0, 1.5, 3.0]),
            Self::Belt => line("belt-run", INK, 2.6),
            Self::RingWheel => area("ring-wheel", BRASS, BRASS_EDGE, 1.3),
            Self::RingPlain => line("ring-plain", BRASS_EDGE, 1.6),
            Self::WheelWeb => area("wheel-web", "#fbf6e8", "#cdb981", 1.0),
            Self::Spoke => line("spoke", BRASS_EDGE, 1.8),
            Self::Ground => area("ground", "#e4e9ee", INK, 1.5),
            Self::Hatch => line("hatch", INK, 1.2),
            Self::Joint => area("joint", "#ffffff", INK, 1.7),
            Self::Pin => area("pin", INK, INK, 1.7),
            Self::Mark => line("mark", PENCIL, 1.3),
            Self::Arrow => area("arrow", PENCIL, "none", 0.0),
            Self::Construction => {
                dashed(line("construction", "#a9b3bd", 1.0), &[8.0, 3.0, 2.0, 3.0])
            }
            Self::Axis => dashed(line("axis", PENCIL, 1.2), &[14.0, 3.0, 2.0, 3.0]),
            Self::Name => area("name", INK, PAPER, 3.5),
            Self::Amount => area("amount", WRONG, PAPER, 3.5),
            Self::Headline => area("headline", INK, "none", 0.0),
            Self::Caption => area("caption", PENCIL, "none", 0.0),
            Self::Scale => line("scale", PENCIL, 1.2),
            Self::Trace(n) => line("trace", colour(n), 1.7),
            Self::Fine(n) => Look { opacity: 0.85, ..line("fine", colour(n), 0.9) },
            Self::Missed(n) => dashed(line("missed", colour(n), 1.4), &[2.0, 4.0]),
            Self::Faint(n) => Look { opacity: 0.25, ..line("faint", colour(n), 1.7) },
        }
    }

    /// The name of the class in the document.
    pub fn name(self) -> String {
        match self {
            Self::Trace(n) | Self::Fine(n) | Self::Missed(n) | Self::Faint(n) => {
                format!("{}-{n}", self.look().name)
            }
            _ => self.look().name.to_owned(),
        }
    }

    /// Half the width of its stroke, px at full size; 0 for what has none.
    pub fn half_width(self) -> f64 {
        if self.look().stroke == "none" { 0.0 } else { 0.5 * self.look().width }
    }

    /// Whether letters may not lie on it: all but areas, faint lines and paths.
    pub const fn is_solid(self) -> bool {
        !matches!(
            self,
            Self::Trace(_)
                | Self::Fine(_)
                | Self::Missed(_)
                | Self::Faint(_)
                | Self::Orbit
                | Self::Web
                | Self::Construction
                | Self::Axis
                | Self::Pitch
                | Self::WheelWeb
        )
    }

    /// The rule of the style sheet, with strokes at a fraction `mark` of their full size.
    fn rule(self, mark: f64, theme: Theme) -> String {
        let look = self.look();
        let mut text = format!(".{}{{fill:{}", self.name(), theme.colour(look.fill));
        if look.stroke != "none" {
            text.push_str(";stroke:");
            text.push_str(theme.colour(look.stroke));
            text.push_str(";stroke-width:");
            // Below half a pixel a line is a shade of grey.
            push_decimals(&mut text, (look.width * mark).max(0.5), 2);
        }
        for (k, &dash) in look.dash.iter().enumerate() {
            text.push_str(if k == 0 { ";stroke-dasharray:" } else { " " });
            push_decimals(&mut text, dash * mark, 2);
        }
        if look.opacity < 1.0 {
            text.push_str(";opacity:");
            push_decimals(&mut text, look.opacity, 2);
        }
        match self {
            Self::Name => {
                text.push_str(";paint-order:stroke;font-style:italic;font-size:");
                push_decimals(&mut text, letter(mark), 1);
                text.push_str("px");
            }
            Self::Amount => {
                text.push_str(";paint-order:stroke;font-size:");
                push_decimals(&mut text, AMOUNT, 1);
                text.push_str("px");
            }
            Self::Headline => {
                text.push_str(";font-size:");
                push_decimals(&mut text, HEADLINE, 1);
                text.push_str("px");
            }
            Self::RingWheel => text.push_str(";fill-rule:evenodd"),
            Self::Caption => text.push_str(";font-size:12px;text-anchor:start"),
            _ => {}
        }
        text.push('}');
        text
    }
}

/// Size of letters among marks of this size, px: they shrink less, so as to be read.
pub fn letter(mark: f64) -> f64 {
    LETTER * mark.max(0.72)
}

/// The style sheet for these classes.
pub fn sheet(classes: &std::collections::BTreeSet<Class>, mark: f64, theme: Theme) -> String {
    let mut text = String::from(
        "\npath,circle{stroke-linecap:round;stroke-linejoin:round}\n\
         text{font-family:Helvetica,Arial,'Liberation Sans',sans-serif;text-anchor:middle}\n",
    );
    for class in classes {
        text.push_str(&class.rule(mark, theme));
        text.push('\n');
    }
    text
}

/// The class of groups that stand for what does not hold.
pub const UNMET: &str = "unmet";

/// The rule for them, stronger than that of any class.
pub fn unmet_rule(theme: Theme) -> String {
    format!(".{UNMET} path,.{UNMET} circle{{stroke:{}}}\n", theme.colour(WRONG))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (WCAG 2.1), from 0 to 1.
    fn luminance(colour: &str) -> f64 {
        let channel = |k: usize| {
            let value = u8::from_str_radix(&colour[k..k + 2], 16).expect("hexadecimal");
            let c = f64::from(value) / 255.0;
            if c <= 0.03928 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    fn contrast(a: &str, b: &str) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn lines_stand_out_from_dark_paper() {
        let paper = Theme::Dark.colour(PAPER);
        for colour in [INK, PENCIL, WRONG, BRASS_EDGE].into_iter().chain(PALETTE) {
            let dark = Theme::Dark.colour(colour);
            let found = contrast(dark, paper);
            assert!(found >= 4.5, "{colour} becomes {dark}: {found:.2}");
        }
    }
}
