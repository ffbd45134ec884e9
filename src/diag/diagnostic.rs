//! One problem: a message, the places it is about, and what to do.

use std::error::Error;
use std::fmt;
use std::ops::{Deref, DerefMut};

use super::Span;

/// Something to tell the user, with the places it is about.
///
/// ```
/// use linkwork::diag::{Code, Diagnostic, Sources, Span};
///
/// let mut sources = Sources::new();
/// let id = sources.add("a.link", "lenght A B");
/// let problem = Diagnostic::error(Code::new(101), "unknown command `lenght`")
///     .at(Span::new(id, 0..6), "not a command")
///     .help("did you mean `length`?");
/// assert_eq!(&*problem.message, "unknown command `lenght`");
/// ```
///
/// No larger than a pointer: results that may fail are as cheap as those that cannot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic(Box<Problem>);

/// What a [`Diagnostic`] says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// What sort of failure it is to a batch.
    pub kind: Kind,
    /// Which error it is; warnings and notes have none.
    pub code: Option<Code>,
    /// What is wrong, in one line.
    pub message: Box<str>,
    /// The places it is about.
    pub labels: Vec<Label>,
    /// What to type next.
    pub helps: Vec<String>,
    /// What else is worth knowing.
    pub notes: Vec<String>,
    /// The statements it was reached through, the innermost first.
    pub via: Vec<Span>,
}

/// How bad a problem is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Severity {
    /// The statement had no effect.
    Error,
    /// The statement took effect, with a reservation.
    Warning,
    /// Worth knowing.
    Note,
}

/// What sort of failure it is: a batch's exit status depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The text asks for something that cannot be done.
    Mistake,
    /// A file cannot be read or written.
    Unreadable,
    /// An `assert` failed or a promise was broken.
    Promise,
    /// The user stopped the command.
    Interrupted,
}

/// Which error it is: what programs tell errors apart by, and `help` explains.
///
/// ```
/// use linkwork::diag::Code;
///
/// assert_eq!(Code::new(201).to_string(), "E0201");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Code(u16);

impl Code {
    /// The code with a number.
    pub const fn new(number: u16) -> Self {
        Self(number)
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "E{:04}", self.0)
    }
}

/// A place and what is to be said about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// Written beside it; may be empty.
    pub text: String,
    /// Is it where the problem is, or does it only explain?
    pub primary: bool,
}

/// The message and what stands at its place, in one line; [`render`](fn@super::render) draws the
/// whole of it, with the text it is about.
///
/// ```
/// use linkwork::diag::{Code, Diagnostic, SourceId, Span};
///
/// let place = Span::new(SourceId(0), 0..6);
/// let problem = Diagnostic::error(Code::new(101), "unknown command `lenght`")
///     .at(place, "not a command");
/// assert_eq!(problem.to_string(), "unknown command `lenght`: not a command");
/// ```
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match self.labels.iter().find(|label| label.primary && !label.text.is_empty()) {
            Some(label) => write!(f, ": {}", label.text),
            None => Ok(()),
        }
    }
}

impl Error for Diagnostic {}

impl Deref for Diagnostic {
    type Target = Problem;

    fn deref(&self) -> &Problem {
        &self.0
    }
}

impl DerefMut for Diagnostic {
    fn deref_mut(&mut self) -> &mut Problem {
        &mut self.0
    }
}

impl Diagnostic {
    /// An error of kind [`Kind::Mistake`].
    pub fn error(code: Code, message: impl Into<String>) -> Self {
        let mut problem = Self::new(Severity::Error, message);
        problem.code = Some(code);
        problem
    }

    /// A warning.
    pub fn warning(message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, message)
    }

    /// A note.
    pub fn note_only(message: impl Into<String>) -> Self {
        Self::new(Severity::Note, message)
    }

    fn new(severity: Severity, message: impl Into<String>) -> Self {
        Self(Box::new(Problem {
            severity,
            kind: Kind::Mistake,
            code: None,
            message: message.into().into_boxed_str(),
            labels: Vec::new(),
            helps: Vec::new(),
            notes: Vec::new(),
            via: Vec::new(),
        }))
    }

    /// Sets the kind.
    #[must_use]
    pub fn kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// Points at the place of the problem; `text` may be empty.
    #[must_use]
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: true });
        self
    }

    /// Points at a place that explains the problem.
    #[must_use]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: false });
        self
    }

    /// Says what to type next.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.helps.push(text.into());
        self
    }

    /// The same where nothing else says it.
    #[must_use]
    pub fn or_help(self, text: impl Into<String>) -> Self {
        if self.helps.is_empty() { self.help(text) } else { self }
    }

    /// Adds what else is worth knowing.
    #[must_use]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// Says that the place was reached from `span`: a `for`, a `use`, an `include`.
    /// Call it from the innermost outwards.
    #[must_use]
    pub fn reached_from(mut self, span: Span) -> Self {
        self.via.push(span);
        self
    }

    /// The first primary place, if it has one.
    pub fn place(&self) -> Option<Span> {
        self.labels.iter().find(|label| label.primary).map(|label| label.span)
    }
}
