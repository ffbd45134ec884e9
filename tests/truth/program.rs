//! The program as a user meets it: a text in, lines and talk out. No other file of these tests
//! names the library.

use std::io;
use std::mem::take;
use std::path::{Path, PathBuf};
use std::time::Instant;

use linkwork::diag::{Diagnostic, Paint, Sources, render};
use linkwork::session::{Host, Session};

use crate::reference::plane::Place;

/// A session and what it said.
pub struct Program {
    session: Session,
    listener: Listener,
}

/// What a session printed and told since it was last asked.
#[derive(Default)]
pub struct Said {
    /// Lines of the answer.
    pub printed: Vec<String>,
    /// Notes and warnings, as the user sees them.
    pub told: String,
}

/// How an attempt to solve ended, in the program's words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Converged,
    /// A best fit, with the claim that the constraints contradict each other.
    Contradictory,
    /// A best fit without that claim.
    BestFit,
    Stalled,
    Unsatisfiable,
}

impl Verdict {
    /// Whether no small move is said to gain anything.
    pub const fn is_best_fit(self) -> bool {
        matches!(self, Self::Contradictory | Self::BestFit)
    }
}

/// The findings of `check`.
#[derive(Clone, Debug, Default)]
pub struct Check {
    pub degrees_of_freedom: usize,
    /// Each redundant constraint with those that imply it.
    pub redundant: Vec<(String, Vec<String>)>,
    /// Sets that cannot hold.
    pub conflicting: Vec<Vec<String>>,
    /// The line about the pose.
    pub pose: String,
    /// Whether it speaks of the pose on the screen as not solved.
    pub is_drawn_unsolved: bool,
    pub verdict: Option<Verdict>,
}

struct Listener {
    said: Said,
    begun: Instant,
}

impl Host for Listener {
    fn print(&mut self, line: &str) {
        self.said.printed.push(line.to_owned());
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.said.told.push_str(&render(what, sources, Paint::Plain));
        self.said.told.push('\n');
    }

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        Err(io::Error::from(io::ErrorKind::NotFound))
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        Some(self.begun.elapsed().as_secs_f64())
    }
}

impl Program {
    /// After a script.
    ///
    /// # Errors
    /// The first mistake, as the user sees it.
    pub fn after(script: &str) -> Result<Self, String> {
        let listener = Listener { said: Said::default(), begun: Instant::now() };
        let mut program = Self { session: Session::new(), listener };
        // Studies read what a short receipt leaves out.
        program.run("set receipt long")?;
        program.run(script)?;
        Ok(program)
    }

    /// Carries out a text up to its first mistake; gives what was said since it was last asked.
    ///
    /// # Errors
    /// The mistake, as the user sees it.
    pub fn run(&mut self, text: &str) -> Result<Said, String> {
        let source = self.session.add_source("scene", text, Some(PathBuf::new()));
        match self.session.execute_all(source, &mut self.listener) {
            Ok(_) => Ok(take(&mut self.listener.said)),
            Err(problem) => Err(render(&problem, self.session.sources(), Paint::Plain)),
        }
    }

    /// Carries out a text that has no mistake.
    pub fn must(&mut self, text: &str) -> Said {
        self.run(text).unwrap_or_else(|problem| panic!("{problem}\n{text}"))
    }

    /// Where points are, in this order; their names stand with commas.
    pub fn places(&mut self, names: &str) -> Vec<Place> {
        places(&self.must(&format!("print {names}")).printed.concat())
    }

    /// The value of an expression.
    pub fn number(&mut self, expression: &str) -> f64 {
        let printed = self.must(&format!("print {expression}")).printed.concat();
        printed.parse().unwrap_or_else(|_| panic!("`{expression}` is {printed}"))
    }

    /// Solves, and says how that ended.
    pub fn solve(&mut self) -> Verdict {
        let told = self.must("solve").told;
        verdict(&told).unwrap_or_else(|| panic!("no verdict in {told}"))
    }

    /// What `check` finds.
    pub fn check(&mut self) -> Check {
        let mut check = Check::default();
        let names = |text: &str| text.split(", ").map(str::to_owned).collect::<Vec<_>>();
        for line in self.must("check").printed {
            let Some((what, rest)) = line.split_once(": ") else { continue };
            match what {
                "degrees of freedom" => {
                    check.degrees_of_freedom = rest.parse().expect("a number of freedoms");
                }
                "redundant" => {
                    let (one, others) = rest.split_once(", implied by ").unwrap_or((rest, ""));
                    let others = if others.is_empty() { Vec::new() } else { names(others) };
                    check.redundant.push((one.to_owned(), others));
                }
                "conflicting" => {
                    let set = rest.rsplit_once(", off by").map_or(rest, |(set, _)| set);
                    check.conflicting.push(names(set));
                }
                "pose" => rest.clone_into(&mut check.pose),
                "as drawn" => check.is_drawn_unsolved = true,
                "status" => check.verdict = verdict(rest),
                _ => {}
            }
        }
        check
    }
}

/// Whether the lines of `why` find that something contradicts the constraint it was asked about.
pub fn is_contradicted(lines: &[String]) -> bool {
    // A best fit may meet one of a set that cannot hold: `c is satisfied: it cannot hold with d`.
    if lines.iter().any(|line| line.contains("cannot hold")) {
        return true;
    }
    let no_conflict = ["is satisfied", "nothing contradicts", "not at rest"];
    !lines.iter().any(|line| no_conflict.iter().any(|words| line.contains(words)))
}

/// The places in a printed line.
pub fn places(line: &str) -> Vec<Place> {
    let number = |text: &str| text.trim().parse().unwrap_or(f64::NAN);
    line.split('(')
        .filter_map(|part| part.split(')').next()?.split_once(','))
        .map(|(x, y)| [number(x), number(y)])
        .collect()
}

/// How solving ended, if a text says so.
pub fn verdict(text: &str) -> Option<Verdict> {
    let words = [
        ("contradict each other", Verdict::Contradictory),
        ("best fit", Verdict::BestFit),
        ("no solution found from here", Verdict::BestFit),
        ("unsatisfiable", Verdict::Unsatisfiable),
        ("stalled", Verdict::Stalled),
        ("converged", Verdict::Converged),
    ];
    words.iter().find(|(word, _)| text.contains(word)).map(|(_, verdict)| *verdict)
}

/// The dead points that `limits` tells of, degrees.
pub fn dead_points(told: &str) -> Vec<f64> {
    let before = |part: &str| part.rsplit([' ']).next().and_then(|word| word.parse().ok());
    let parts: Vec<&str> = told.split(" deg, a dead point").collect();
    parts[..parts.len() - 1].iter().filter_map(|part| before(part)).collect()
}

/// Whether `limits` says that a motor turns all the way round.
pub fn turns_fully(told: &str) -> bool {
    told.contains("turns fully")
}

/// Whether `limits` says that it lost the motion.
pub fn may_be_lost(told: &str) -> bool {
    told.contains("was lost") || told.contains("cannot be told")
}

/// Whether a receipt tells of frames that did not reach the tolerance.
pub fn has_missed(told: &str) -> bool {
    told.contains("did not reach the tolerance")
}

/// Whether a receipt tells that something may be on another branch.
pub fn may_have_changed_branch(told: &str) -> bool {
    told.contains("may have changed branch")
}

/// Whether a receipt tells that a motion began where its branches meet.
pub fn began_where_branches_meet(told: &str) -> bool {
    told.contains("began where two branches meet")
}

/// The iterations of a frame that a receipt tells of.
pub fn iterations_a_frame(told: &str) -> Option<f64> {
    told.split(" iterations and").next()?.rsplit(' ').next()?.parse().ok()
}

/// The position error that the last receipt estimates, length units.
pub fn position_error(told: &str) -> Option<f64> {
    let (_, rest) = told.rsplit_once("position error about ")?;
    let end = rest.find([',', '\n', ' ']).unwrap_or(rest.len());
    rest[..end].parse().ok()
}
