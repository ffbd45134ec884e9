//! Blocks: `for`, `define` and `use`, `include` and `load`.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::diag::{Diagnostic, Kind, Span, format_count, format_number, suggest};
use crate::errors;
use crate::lang::ast::{Definition, Expr, Ident, Name, Range, Statement, Text};
use crate::session::execution::{Execution, Flow};
use crate::session::host::reason;
use crate::session::input::Loaded;
use crate::session::quotas::{LONGEST_ARGUMENT, Quota};
use crate::session::resolve::bind::Term;
use crate::session::resolve::scope::Meaning;
use crate::session::resolve::scopes::{Bound, Scope};
use crate::session::undo::journal::Change;
use crate::session::undo::told::FileRead;
use crate::terms::Shape;
use crate::world::{Depends, Entity, Formula, Node, Value};

/// Up to here each whole number has one that follows it: 2^53 less 1.
const LARGEST_COUNT: f64 = 9_007_199_254_740_991.0;

/// How the statements of a file are carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum As {
    /// As part of a command, which is solved as a whole.
    Part,
    /// As if each were typed: what a session did comes out again.
    Typed,
}

impl Execution<'_> {
    /// Goes one level deeper for as long as `inside` runs.
    fn nested<T>(
        &mut self,
        span: Span,
        inside: impl FnOnce(&mut Self) -> Result<T, Diagnostic>,
    ) -> Result<T, Diagnostic> {
        let most = self.input.quotas.of(Quota::Nesting);
        if self.depth as u64 >= most {
            return Err(Diagnostic::error(errors::TOO_MUCH, "nested too deeply")
                .at(span, format!("{most} levels of `for`, `use` and `include`"))
                .help("does a definition use itself, or a file include itself?"));
        }
        self.depth += 1;
        let result = inside(self);
        self.depth -= 1;
        // Reached through this statement, whatever went wrong in there.
        result.map_err(|problem| match problem.via.last() {
            // Recursion shows each of its places once.
            Some(last) if *last == span => problem,
            _ => problem.reached_from(span),
        })
    }

    fn perform_all(&mut self, body: &[Statement]) -> Result<Flow, Diagnostic> {
        for statement in body {
            let flow = self.dispatch(statement)?;
            if flow != Flow::On {
                return Ok(flow);
            }
        }
        Ok(Flow::On)
    }

    /// A round of a loop; one without statements ends it where the user wants that, too.
    fn round(&mut self, body: &[Statement]) -> Result<Flow, Diagnostic> {
        if body.is_empty() {
            if self.is_to_stop() {
                self.note_stop("stopped");
                return Ok(Flow::Stopped);
            }
            self.n_done += 1;
        }
        self.perform_all(body)
    }

    pub(crate) fn repeat(
        &mut self,
        variable: &Ident,
        range: &Range,
        body: &Arc<[Statement]>,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let whole = |execution: &mut Self, expr: &Expr| -> Result<f64, Diagnostic> {
            let value = execution.resolve().number(expr)?;
            if value.fract() == 0.0 {
                return Ok(value);
            }
            Err(Diagnostic::error(errors::OUT_OF_RANGE, "expected a whole number")
                .at(expr.span, format!("this is {}", format_number(value))))
        };
        let (from, to) = (whole(self, &range.from)?, whole(self, &range.to)?);
        for (value, expr) in [(from, &range.from), (to, &range.to)] {
            if value.abs() > LARGEST_COUNT {
                let text = format!("no number beyond {LARGEST_COUNT} has one that follows it");
                return Err(Diagnostic::error(errors::TOO_MUCH, "a loop cannot count so far")
                    .at(expr.span, text));
            }
        }
        // Loops within loops multiply; one that is long in every round is found in the first.
        let n_rounds = (to - from + 1.0).max(1.0);
        let n_outer = self.n_rounds;
        let most = self.input.quotas.of(Quota::Statements) as f64;
        if n_rounds * n_outer > 2.0 * most || n_rounds > most {
            let mut text = format!("{} rounds", format_count(n_rounds));
            if n_outer > 1.0 {
                let _ = write!(text, " in each of {}", format_count(n_outer));
            }
            let text = format!("{text}, no more than {} statements a command", format_count(most));
            return Err(Diagnostic::error(errors::TOO_MUCH, "this loop has too many rounds")
                .at(range.from.span.to(range.to.span), text)
                .help("`--limit statements=N` on the command line allows more"));
        }
        self.n_rounds = n_rounds * n_outer;
        let result = self.nested(span, |execution| {
            let slot = execution.scopes.bind(variable.text.clone(), from);
            let mut flow = Flow::On;
            let mut value = from;
            let is_told = n_rounds > 1.0 && execution.begin_work();
            while value <= to && flow == Flow::On {
                if is_told {
                    execution.host.progress((value - from) / n_rounds);
                }
                execution.scopes.rebind(slot, value);
                flow = execution.round(body)?;
                value += 1.0;
            }
            execution.scopes.unbind(slot);
            if is_told {
                execution.end_work();
            }
            Ok(flow)
        });
        self.n_rounds = n_outer;
        result
    }

    pub(crate) fn define(&mut self, definition: &Arc<Definition>) {
        let name = definition.name.text.clone();
        self.change(Change::Definition(Box::new((name, Some(definition.clone())))));
    }

    pub(crate) fn use_definition(
        &mut self,
        word: &Ident,
        arguments: &[Expr],
        instance: Option<&Name>,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let Some(definition) = self.state.definitions.get(&word.text).cloned() else {
            let problem = Diagnostic::error(
                errors::UNKNOWN_DEFINITION,
                format!("unknown definition `{}`", word.text),
            )
            .at(word.span, "nothing is defined under this name");
            return Err(suggest(problem, &word.text, self.state.definitions.keys().map(|n| &**n)));
        };
        let wanted = definition.parameters.len();
        if wanted != arguments.len() {
            let names: Vec<&str> = definition.parameters.iter().map(|p| &*p.text).collect();
            let plural = if wanted == 1 { "argument" } else { "arguments" };
            let given = arguments.len();
            let message = format!("`{}` takes {wanted} {plural}, not {given}", word.text);
            return Err(Diagnostic::error(errors::ARGUMENTS, message)
                .at(span, format!("expected `{}({})`", word.text, names.join(", ")))
                .also(definition.name.span, "defined here"));
        }
        let mut bindings = Vec::with_capacity(wanted);
        for (parameter, argument) in definition.parameters.iter().zip(arguments) {
            bindings.push((parameter.text.clone(), self.argument(argument)?));
        }
        let name = match instance {
            Some(name) => self.resolve().declare(name)?.to_string(),
            None => self.resolve().numbered(&word.text),
        };
        for (parameter, bound) in &mut bindings {
            if let Bound::Formula(formula) = bound
                && formula.extent().n_terms > LONGEST_ARGUMENT
            {
                *formula = self.as_parameter(&format!("{name}.{parameter}"), formula.clone())?;
            }
        }
        let result = self.nested(span, |execution| {
            execution.scopes.enter(Scope { prefix: format!("{name}."), bindings });
            let flow = execution.perform_all(&definition.body)?;
            execution.scopes.leave();
            Ok(flow)
        });
        result.map_err(|problem| self.blame_argument(problem, &definition, arguments))
    }

    /// Points at the argument where a parameter turned out to stand for the wrong sort of thing.
    fn blame_argument(
        &self,
        mut problem: Diagnostic,
        definition: &Definition,
        arguments: &[Expr],
    ) -> Diagnostic {
        let is_of_sort = matches!(problem.code, Some(errors::WRONG_SORT | errors::MIXED_SORTS));
        let Some(place) = problem.place().filter(|_| is_of_sort) else { return problem };
        let text = self.input.sources.slice(place);
        let parameters = definition.parameters.iter();
        let passed = parameters.zip(arguments).find(|(parameter, _)| *parameter.text == *text);
        let Some((parameter, argument)) = passed else { return problem };
        if argument.span == place {
            return problem;
        }
        problem.labels.iter_mut().for_each(|label| label.primary = false);
        problem.via.clear();
        problem.at(argument.span, format!("passed for `{}`", parameter.text))
    }

    /// What an argument stands for: a point itself, or a number that stays live.
    fn argument(&mut self, argument: &Expr) -> Result<Bound, Diagnostic> {
        if let Some(name) = argument.as_name()
            && let (Meaning::Entity(Entity::Point(id)) | Meaning::Bound(Bound::Point(id)), None) =
                self.resolve().meaning(name)?
        {
            return Ok(Bound::Point(id));
        }
        match self.resolve().live(argument)? {
            Term::Constant(Value::Number(n), unit) => Ok(Bound::Number(n, unit)),
            Term::Live(formula) if formula.shape() == Shape::Number => Ok(Bound::Formula(formula)),
            _ => Err(Diagnostic::error(errors::MIXED_SORTS, "expected a point or a number")
                .at(argument.span, "this is a vector")
                .help("make it a point first: `point P = ... frozen`")),
        }
    }

    /// A parameter of an instance that stands for a long argument.
    fn as_parameter(&mut self, name: &str, formula: Formula) -> Result<Formula, Diagnostic> {
        let world = &mut self.state.world;
        let is_free = world.names().is_free(name);
        let name = if is_free { name.to_owned() } else { world.numbered_name(name) };
        let id = world.next_parameter();
        let span = formula.span();
        self.set_parameter(id, name.as_str().into(), formula)?;
        let depends = Depends { on_parameters: true, ..Depends::default() };
        Ok(Formula::new(Node::Parameter(id), Shape::Number, depends, span))
    }

    pub(crate) fn include(&mut self, path: &Text, span: Span) -> Result<Flow, Diagnostic> {
        let (file, known) = match self.input.next_files.pop_front() {
            Some(FileRead { path, text }) => (path, Some(text)),
            None => (self.find(path)?, None),
        };
        if self.included.contains(&file) {
            return Err(Diagnostic::error(
                errors::INCLUDES_ITSELF,
                format!("`{}` includes itself", path.value),
            )
            .at(path.span, "this file is being included already"));
        }
        let text = match known {
            Some(text) => text,
            None => self.read(&file, path)?.text,
        };
        self.included.push(file.clone());
        let result = self.perform_text(&FileRead { path: file, text }, span, As::Part);
        self.included.pop();
        result
    }

    /// Reads what may have been written here: from where it would be, or from beside the text that
    /// names it.
    pub(super) fn read_back(&mut self, path: &Text) -> Result<FileRead, Diagnostic> {
        if let Some(known) = self.input.next_files.pop_front() {
            return Ok(known);
        }
        if let Some(found) = self.saved(Path::new(&*path.value)) {
            return Ok(found);
        }
        let file = self.find(path)?;
        self.read(&file, path)
    }

    /// What lies where `save` would put a file of this name.
    fn saved(&mut self, path: &Path) -> Option<FileRead> {
        let file = self.host.resolve(path).ok()?;
        let text = self.host.read(&file).ok()?;
        Some(self.note_read(file, text))
    }

    /// A file was read: who repeats the statement has to find the same.
    fn note_read(&mut self, path: PathBuf, text: String) -> FileRead {
        let read = FileRead { path, text: text.into() };
        let input = &mut *self.input;
        input.n_bytes_read += read.text.len() as u64;
        if input.n_bytes_read > input.quotas.of(Quota::SourceBytes) / 2 {
            // A journal with all of it could not be read.
            input.is_unrepeatable = true;
            input.files_read.clear();
        } else if self.host.is_keeping() {
            input.files_read.push(read.clone());
        }
        read
    }

    /// Where a file lies that is to be read.
    fn find(&self, path: &Text) -> Result<PathBuf, Diagnostic> {
        let folder = self.input.folder(path.span.source);
        self.host.find(&folder, Path::new(&*path.value)).map_err(|e| match e.kind() {
            io::ErrorKind::PermissionDenied => elsewhere(path),
            _ => unreadable(path, &e),
        })
    }

    fn read(&mut self, file: &Path, path: &Text) -> Result<FileRead, Diagnostic> {
        let text = self.host.read(file).map_err(|e| unreadable(path, &e))?;
        Ok(self.note_read(file.to_path_buf(), text))
    }

    /// Carries out the statements of a file as part of the command under way.
    fn perform_text(
        &mut self,
        FileRead { path: file, text }: &FileRead,
        span: Span,
        how: As,
    ) -> Result<Flow, Diagnostic> {
        let folder = file.parent().map(Path::to_path_buf);
        let source = self.input.add_piece(&file.to_string_lossy(), text.clone(), 1, folder);
        let mut n_done = 0;
        let result = self.nested(span, |execution| {
            for statement in crate::lang::parse(source, text) {
                let advised = |problem| execution.state.advise(problem, &execution.input.sources);
                let statement = statement.map_err(advised)?;
                if how == As::Typed {
                    let (reached, n_done_before) = (statement.span.range(), execution.n_done);
                    execution.input.loaded = Some(Loaded { reached, n_done_before });
                }
                let flow = execution.dispatch(&statement)?;
                if how == As::Typed {
                    execution.solve_where_live(&statement)?;
                }
                if flow != Flow::On {
                    return Ok(flow);
                }
                n_done += 1;
            }
            Ok(Flow::On)
        });
        // What is no script at all may hold what is not for everybody's eyes.
        let is_script = n_done > 0 || file.extension().is_some_and(|ending| ending == "link");
        result.map_err(|problem| match problem.kind {
            Kind::Mistake if !is_script => no_script(file, span),
            _ => problem,
        })
    }

    /// Replaces the world by what a file makes. The file is looked for where `save` puts one,
    /// then beside the text that loads it.
    pub(crate) fn load(&mut self, path: &Text, span: Span) -> Result<Flow, Diagnostic> {
        self.must_stand_alone("load", span)?;
        let file = self.read_back(path)?;
        self.clear();
        self.input.loaded = Some(Loaded::default());
        let result = self.perform_text(&file, span, As::Typed);
        // A journal may end between what stands before a statement and the statement.
        self.input.next_files.clear();
        self.input.next_stop = None;
        result
    }
}

fn unreadable(path: &Text, error: &io::Error) -> Diagnostic {
    Diagnostic::error(errors::CANNOT_READ, format!("cannot read `{}`", path.value))
        .kind(Kind::Unreadable)
        .at(path.span, reason(error))
}

/// What is wrong with a path that leads where scripts may not read.
fn elsewhere(path: &Text) -> Diagnostic {
    Diagnostic::error(
        errors::READ_OUTSIDE,
        "files are read below the folder of the first script only",
    )
    .at(path.span, "this path leads elsewhere")
    .help("`-I DIR` on the command line adds a folder")
    .help("`--allow-any-path` on the command line permits it")
}

/// What is wrong where a file was read that is no script; nothing of it is shown.
fn no_script(file: &Path, span: Span) -> Diagnostic {
    Diagnostic::error(errors::NO_SCRIPT, format!("`{}` is no script", file.display()))
        .at(span, "its first statement cannot be carried out")
        .help("what is wrong with it is shown where its name ends in `.link`")
}
