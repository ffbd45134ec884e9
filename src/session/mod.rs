//! Statements become edits: every command is one transaction on a world.
//!
//! A session reads statements, resolves their names, changes its world through reversible
//! edits, lets the solver work, and hands what is to be printed or written to a [`Host`].
//! It never touches a terminal, and never leaves half an edit behind.
//!
//! Its parts: `state` is all that commands change, `input` what they are read from, `undo` what
//! takes them back; `execution` is the command under way, the only one who meets the host.

mod advice;
mod answer;
mod ask;
mod attempt;
mod check;
mod commands;
mod completion;
mod csv;
mod culprits;
mod curve;
mod deadline;
mod dispatch;
mod drawn_scene;
mod effects;
mod examples;
mod execution;
mod file_kind;
mod finding;
mod fnv;
mod host;
mod input;
mod json;
mod keeping;
mod output_file;
mod overview;
mod parcel;
mod preferences;
mod quiet;
mod quotas;
mod report;
mod resolve;
mod results;
mod review;
mod scene_hash;
mod series;
mod settled;
mod silent;
mod spool;
mod state;
mod summary;
pub(crate) mod sweep;
mod transcript;
mod undeclared;
mod undo;
mod value_text;

use std::path::PathBuf;

pub use answer::Answer;
pub use ask::evaluate_binding;
pub use attempt::Attempt;
pub use check::{Check, FromHere, Unsatisfiable};
pub use commands::accuracy::Telling;
pub use commands::ongoing::Ongoing;
pub use completion::{Candidate, Completion, Offer, Piece};
pub use effects::{EffectRow, Effects};
pub use examples::{EXAMPLES, Example};
pub use execution::Flow;
pub use finding::{
    ConstraintRow, Finding, Fit, Limits, Listing, MeasureRow, ParameterRow, PointRow, Swept,
    TraceRow,
};
pub use host::{Clock, Done, Host, Kept, Nowhere, contained, reason};
pub use json::{Objects, VERSION as JSON_VERSION, answer_request, is_request, problem_alone};
pub use overview::{ConstraintView, Offence, ParameterView, Standing};
pub use preferences::{AtDeadPoint, Preferences, Receipt};
pub use quotas::{Quota, parse_limit};
pub use results::Results;
pub use silent::Silent;
pub use spool::Spool;
pub use summary::{Summary, Way};
pub use sweep::{
    Axis, Columns, Failure, Grid, Refusal, Shard, Sweep, SweepScript, Variant, parse_axis,
    picture_sheet,
};
pub use transcript::{CONTINUATION, Outcome, PROMPT, Transcript, without_prompts};
pub use undeclared::Undeclared;

pub use crate::interrupt::Wish;
pub use crate::mobility::{DriverRange, PoseClass, RangeEnd, Reach};

use crate::constraint::{ConstraintKind as _, Point};
use crate::diag::{Diagnostic, SourceId, Sources, Span};
use crate::interrupt::{self, Stopped};
use crate::lang::ast::Statement;
use crate::solve::{FrameCounts, present};
use crate::world::{Entity, Value, World};
use execution::Execution;
use input::{Input, Override};
use state::State;
use undo::history::History;

/// A world with everything that a user can say to it.
///
/// What a session says goes to a [`Host`], which it is lent with each statement; [`run`](Self::run)
/// brings one that keeps it all. Questions that need none take the session alone. A session is
/// [`Send`]: it may be made on one thread and go on on another.
pub struct Session {
    state: State,
    input: Input,
    history: History,
}

impl Default for Session {
    fn default() -> Self {
        Self::new()
    }
}

impl Session {
    /// An empty world.
    pub fn new() -> Self {
        Self { state: State::new(), input: Input::default(), history: History::default() }
    }

    /// Carries out a text, statement by statement, up to the first error; gives what it printed,
    /// told and wrote. What it `include`s or `load`s it has to have written itself: who has files
    /// brings a [`Host`] and calls [`execute_all`](Self::execute_all).
    ///
    /// # Errors
    /// The first thing that is wrong. The statements before it keep their effect.
    ///
    /// ```
    /// use linkwork::Session;
    ///
    /// let mut session = Session::new();
    /// let answer = session.run("let r = 2; print \"r is\", r; list points")?;
    /// assert_eq!(answer.lines, ["r is 2"]);
    /// assert_eq!(answer.told[0].to_string(), "no points");
    ///
    /// let problem = session.run("print r; lenght A B").unwrap_err();
    /// assert_eq!(problem.helps, ["did you mean `length`?"]);
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub fn run(&mut self, text: &str) -> Result<Answer, Diagnostic> {
        let mut answer = Answer::default();
        let source = self.input.add_once("<text>", text);
        self.execute_all(source, &mut answer)?;
        Ok(answer)
    }

    /// The value of an expression now; looking changes nothing.
    ///
    /// # Errors
    /// What is wrong with it, or why it has no value.
    ///
    /// ```
    /// use linkwork::Session;
    ///
    /// let mut session = Session::new();
    /// session.run("point A = (0, 0), B = (3, 4)")?;
    /// assert_eq!(session.evaluate("distance(A, B)")?.number(), 5.0);
    /// assert_eq!(session.evaluate("B - A")?.vector().y, 4.0);
    /// assert!(session.evaluate("distance(A, C)").is_err());
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub fn evaluate(&mut self, expression: &str) -> Result<Value, Diagnostic> {
        let source = self.input.add_piece("<expression>", format!("print {expression}"), 1, None);
        let value = ask::value(source, &self.input, &mut self.state)?;
        // Nobody holds a place in what had a value.
        self.input.sources.forget_last();
        Ok(value)
    }

    /// How the frames that passed were found.
    #[doc(hidden)]
    pub fn frame_counts(&self) -> FrameCounts {
        self.state.solver.frame_counts()
    }

    /// Where a point is.
    pub fn position(&self, point: &str) -> Option<Point> {
        match self.world().names().get(point)? {
            Entity::Point(id) => Some(self.world().points().at(id)),
            _ => None,
        }
    }

    /// By how much a constraint that is switched on is missed, in its own unit: length units, or
    /// radians.
    pub fn residual(&self, constraint: &str) -> Option<f64> {
        let Entity::Constraint(id) = self.world().names().get(constraint)? else { return None };
        let record = self.world().constraint(id).filter(|record| record.is_on)?;
        if record.live().is_empty() {
            return Some(record.constraint.residual(self.world().points().column()));
        }
        // The value that was asked for last need not be the value now.
        let (world, _) = present(self.world());
        let record = world.constraint(id)?;
        Some(record.constraint.residual(world.points().column()))
    }

    /// What `result` said so far: what the run is for.
    ///
    /// ```
    /// use linkwork::Session;
    ///
    /// let mut session = Session::new();
    /// session.run("point A = (3, 4); result far = norm(A), \"at\" = A")?;
    /// assert_eq!(session.results().get("far"), Some(5.0));
    /// assert_eq!(session.results().get("at.y"), Some(4.0));
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub const fn results(&self) -> &Results {
        &self.state.results
    }

    /// The texts read so far; places in diagnostics are places in these.
    pub const fn sources(&self) -> &Sources {
        &self.input.sources
    }

    /// The world as it is.
    pub const fn world(&self) -> &World {
        &self.state.world
    }

    /// The definitions, each with its parameters as they are written.
    pub fn definitions(&self) -> impl Iterator<Item = (String, String)> {
        self.state.definitions.values().map(|definition| {
            let parameters: Vec<&str> = definition.parameters.iter().map(|it| &*it.text).collect();
            (definition.name.text.to_string(), parameters.join(", "))
        })
    }

    /// Receipt of the last command that let time pass.
    pub const fn last_run(&self) -> Option<&Summary> {
        self.history.last_run.as_ref()
    }

    /// Roughly how many bytes are kept so that commands can be taken back or done again.
    pub const fn undo_bytes(&self) -> usize {
        self.history.journal.n_bytes()
    }

    /// Keeps a text. `folder` is where what it includes is looked for.
    pub fn add_source(&mut self, name: &str, text: &str, folder: Option<PathBuf>) -> SourceId {
        self.add_piece(name, text, 1, folder)
    }

    /// Keeps a piece of a text that is typed piece by piece; it begins at line `first_line`.
    pub fn add_piece(
        &mut self,
        name: &str,
        text: &str,
        first_line: usize,
        folder: Option<PathBuf>,
    ) -> SourceId {
        self.input.add_piece(name, text, first_line, folder)
    }

    /// Gives a parameter a value that wins over the scripts' own `let`.
    pub fn override_parameter(&mut self, name: &str, value: f64) {
        self.input.overrides.insert(name.to_owned(), Override { value, is_used: false });
    }

    /// Names given to [`override_parameter`](Self::override_parameter) that no `let` has.
    pub fn unused_overrides(&self) -> impl Iterator<Item = &str> {
        self.input.overrides.iter().filter(|(_, o)| !o.is_used).map(|(name, _)| name.as_str())
    }

    /// Sets how much there may be of something.
    pub const fn limit(&mut self, quota: Quota, most: u64) {
        self.input.quotas.set(quota, most);
    }

    /// How much there may be of something.
    pub const fn quota(&self, quota: Quota) -> u64 {
        self.input.quotas.of(quota)
    }

    /// Carries out one statement, whole or not at all.
    ///
    /// # Errors
    /// What is wrong with it; the world is then as it was.
    pub fn execute(
        &mut self,
        statement: &Statement,
        host: &mut dyn Host,
    ) -> Result<Flow, Diagnostic> {
        self.input.begin_statement();
        self.command(host).carry_out(statement)
    }

    /// Carries out a whole text, statement by statement, up to the first error.
    ///
    /// # Errors
    /// The first thing that is wrong. The statements before it keep their effect.
    pub fn execute_all(
        &mut self,
        source: SourceId,
        host: &mut dyn Host,
    ) -> Result<Flow, Diagnostic> {
        let text = self.input.sources.get(source).map(|s| s.text.clone()).unwrap_or_default();
        let mut statements = crate::lang::parse(source, &text);
        while let Some(statement) = next_of(&mut statements, host).transpose() {
            let Ok(statement) = statement else { return Ok(Flow::Stopped) };
            let place = match &statement {
                Ok(statement) => Some(statement.span),
                Err(problem) => problem.place(),
            };
            self.input.reached = place.unwrap_or(self.input.reached);
            let statement = statement.map_err(|problem| self.advise(problem))?;
            let flow = self.execute(&statement, host)?;
            self.tell_done(statement.span, self.has_stayed(flow), host);
            if flow != Flow::On {
                return Ok(flow);
            }
        }
        Ok(Flow::On)
    }

    /// Whether what the last statement did stays: what is stopped may be taken back.
    const fn has_stayed(&self, flow: Flow) -> bool {
        !matches!(flow, Flow::Stopped) || self.input.stopped_after.is_some()
    }

    /// Tells the host that a statement has ended.
    fn tell_done(&self, span: Span, is_ok: bool, host: &mut dyn Host) {
        host.done(&Done { span, is_ok, sources: self.sources(), world: self.world() });
    }

    /// What is drawn of the present pose, with what does not hold in it.
    ///
    /// ```
    /// use linkwork::Session;
    /// use linkwork::render::{Options, svg};
    ///
    /// let mut session = Session::new();
    /// session.run("point A = (0, 0) frozen, B = (4, 0) frozen; bar: length A B = 5; solve")?;
    /// assert!(svg(&session.scene(), &Options::default()).contains(">bar off by 1<"));
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub fn scene(&self) -> crate::render::Scene {
        self.state.scene()
    }

    /// What pictures of the present scene say besides the drawing.
    fn picture_options(&self) -> crate::render::Options {
        self.state.picture_options(self.history.run_to(&self.state.world))
    }

    /// What was typed and carried out, statement by statement.
    pub fn typed(&self) -> impl Iterator<Item = &str> {
        self.input.typed()
    }

    /// How many statements were typed and carried out.
    pub fn n_typed(&self) -> usize {
        self.input.n_typed()
    }

    /// Those of them from the `n`th on that changed something.
    pub fn changes_since(&self, n: usize) -> impl Iterator<Item = &str> {
        self.input.changes_since(n)
    }

    /// Ends the session: recordings still running are written.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn finish(&mut self, host: &mut dyn Host) -> Result<(), Diagnostic> {
        self.command(host).finish()
    }

    /// Studies the motion so far, or of what is to come, over `n_frames` if given; writes
    /// `accuracy.csv` and `accuracy.svg`.
    ///
    /// # Errors
    /// Where there is nothing to study, or a file cannot be written.
    pub fn study_accuracy(
        &mut self,
        n_frames: Option<u64>,
        telling: Telling,
        host: &mut dyn Host,
    ) -> Result<Flow, Diagnostic> {
        self.command(host).study_accuracy(n_frames, telling)
    }

    /// What there is to know about the mechanism at rest at the present time.
    pub fn examine(&self) -> Check {
        self.state.examine()
    }

    /// What the scene has switched on, timed by letting a copy of it run on for as long as its
    /// live expressions have values.
    pub fn effects_on(&self, host: &dyn Host) -> Effects {
        self.state.effects_on(host)
    }

    /// What to say of a pose that waits to be solved, if it does.
    pub fn unsolved(&self) -> Option<Diagnostic> {
        self.state.unsolved()
    }

    /// How far what drives can go, a motor, a constraint with a value or a parameter, the rest held as
    /// it is now; none if it drives nothing.
    pub fn range(&self, driver: Entity) -> Option<DriverRange> {
        self.state.range(driver)
    }

    /// The script that makes this world, its settings and its state.
    pub fn to_script(&self) -> String {
        self.state.to_script()
    }

    /// A hash of the scene: the same for the same settings, points at the start, parameters
    /// and constraints, however far it has run.
    pub fn scene_hash(&self) -> u64 {
        self.state.scene_hash()
    }

    fn command<'a>(&'a mut self, host: &'a mut dyn Host) -> Execution<'a> {
        Execution::new(&mut self.state, &mut self.input, &mut self.history, host)
    }
}

/// The next statement of a text, unless the user stops the reading of it.
fn next_of(
    statements: &mut impl Iterator<Item = Result<Statement, Diagnostic>>,
    host: &dyn Host,
) -> Result<Option<Result<Statement, Diagnostic>>, Stopped> {
    interrupt::listening(host.wish_to_stop(), || statements.next())
}
