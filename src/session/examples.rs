//! The mechanisms that come with the program: those of the paper, and the gallery.

use crate::diag::{Diagnostic, suggest};
use crate::errors;

/// A script that shows something.
#[derive(Debug, Clone, Copy)]
pub struct Example {
    /// What it is called.
    pub name: &'static str,
    /// The script.
    pub text: &'static str,
}

macro_rules! examples {
    ($($folder:literal { $($name:literal)* })*) => {
        &[$($(Example {
            name: $name,
            text: include_str!(concat!("../../scripts/", $folder, "/", $name, ".link")),
        },)*)*]
    };
}

/// All of them, in the order in which they are listed.
pub const EXAMPLES: &[Example] = examples! {
    "paper" {
        "bezier"
        "crankshaft"
        "figure-1"
        "figure-2"
        "figure-3"
        "guilloche"
        "planet-gear"
        "theorem"
        "two-circles"
    }
    "gallery" {
        "ackermann-steering"
        "angle-bisector"
        "angle-bracket"
        "apollonius-circle"
        "apollonius"
        "belt-drive"
        "belt-with-idler"
        "cam-flat-follower"
        "cam-roller-follower"
        "chebyshev"
        "clock-train"
        "cord-and-telescope"
        "crane"
        "epicycles"
        "fillet"
        "five-bar-plotter"
        "folding-lid"
        "four-bar"
        "geneva-drive"
        "hart"
        "hoeken"
        "jansen-beast"
        "jansen-leg"
        "jansen-walk"
        "kissing-circles"
        "klann"
        "pantograph"
        "parallelogram"
        "peaucellier"
        "planetary-gear"
        "planetary-train"
        "rack-and-pinion"
        "roberts-cognates"
        "rope-over-two-pulleys"
        "scissor-lift"
        "scotch-yoke"
        "slider-crank"
        "spirograph"
        "steering-rack"
        "trammel"
        "two-link-arm"
        "watt"
        "winch"
        "window-wiper"
        "wing-nut"
    }
};

impl Example {
    /// The example of this name, with or without the ending of a script.
    ///
    /// # Errors
    /// Where there is none.
    pub fn named(name: &str) -> Result<&'static Self, Diagnostic> {
        let name = name.strip_suffix(".link").unwrap_or(name);
        EXAMPLES.iter().find(|example| example.name == name).ok_or_else(|| {
            let problem =
                Diagnostic::error(errors::NO_HELP, format!("there is no example `{name}`"));
            suggest(problem, name, EXAMPLES.iter().map(|example| example.name))
                .help("`examples` lists them")
        })
    }

    /// What it shows: the first sentence of the comment that it begins with.
    pub fn summary(&self) -> String {
        let comment = self.text.lines().map_while(|line| line.strip_prefix('#'));
        let words: Vec<&str> = comment.flat_map(str::split_whitespace).collect();
        let text = words.join(" ");
        // A ratio has blanks on both sides of its colon.
        let is_end = |at: &usize| text.as_bytes()[at - 1] != b' ';
        let ends = [". ", ": ", "; "].iter().filter_map(|end| text.find(end).filter(is_end));
        text[..ends.min().unwrap_or(text.len())].trim_end_matches('.').to_owned()
    }

    /// A line for each.
    pub fn overview() -> Vec<String> {
        let width = EXAMPLES.iter().map(|example| example.name.len()).max().unwrap_or(0);
        EXAMPLES
            .iter()
            .map(|example| format!("{:<width$}  {}", example.name, example.summary()))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_script_of_the_gallery_and_of_the_paper_is_an_example() {
        for folder in ["paper", "gallery"] {
            let path = format!("{}/scripts/{folder}", env!("CARGO_MANIFEST_DIR"));
            for file in std::fs::read_dir(path).expect("a folder") {
                let file = file.expect("an entry").path();
                let name = file.file_stem().and_then(|name| name.to_str()).expect("a name");
                let text = std::fs::read_to_string(&file).expect("a script");
                assert_eq!(Example::named(name).map(|example| example.text), Ok(&*text));
            }
        }
    }
}
