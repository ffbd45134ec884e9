//! `linkwork help` and `examples`: what comes with the program.

use std::path::{Path, PathBuf};

use super::args::{ExampleArguments, HelpArguments, help_on};
use super::output;
use super::process_host::{EXAMPLES_FOLDER, ProcessHost};
use super::run::{ExitStatus, Talk, begin, play, refuse};
use crate::diag::Diagnostic;
use crate::errors;
use crate::session::{Example, Host, Session, Undeclared};

/// Says what there is to know about a command of the shell, of the language, or both.
pub fn help(wish: &HelpArguments) -> ExitStatus {
    let topic = wish.topic.as_deref();
    let of_the_shell = help_on(topic);
    let mut session = Session::new();
    let of_the_language = match topic {
        Some(topic) if topic.contains(|c: char| !c.is_alphanumeric() && c != '-') => {
            Err(Diagnostic::error(errors::NO_HELP, "this is no word")
                .help("`linkwork help` lists the commands"))
        }
        topic => session.run(&format!("help {}", topic.unwrap_or_default())),
    };
    let mut lines: Vec<String> = Vec::new();
    if let Some(text) = &of_the_shell {
        lines.extend(text.lines().map(str::to_owned));
    }
    match of_the_language {
        Ok(answer) => {
            if !lines.is_empty() {
                lines.extend([String::new(), "In the language:".to_owned(), String::new()]);
            }
            lines.extend(answer.lines);
        }
        Err(problem) if lines.is_empty() => {
            output::show(&problem, session.sources());
            return ExitStatus::Mistake;
        }
        Err(_) => {}
    }
    ProcessHost::new(&wish.host, Path::new(".")).print_all(&lines);
    ExitStatus::Fine
}

/// Lists the examples, prints one, or runs it.
pub fn examples(wish: &ExampleArguments) -> ExitStatus {
    let Some(name) = &wish.name else {
        ProcessHost::new(&wish.host, Path::new(".")).print_all(&Example::overview());
        return ExitStatus::Fine;
    };
    let example = match Example::named(name) {
        Ok(example) => example,
        Err(problem) => {
            output::show(&problem, Session::new().sources());
            return ExitStatus::Mistake;
        }
    };
    if !wish.run && !wish.interactive {
        let lines: Vec<String> = example.text.lines().map(str::to_owned).collect();
        ProcessHost::new(&wish.host, Path::new(".")).print_all(&lines);
        return ExitStatus::Fine;
    }
    let mut session = begin(&wish.host);
    let file = format!("{}.link", example.name);
    let read = |session: &mut Session, _: &mut dyn Host| {
        let folder = PathBuf::from(EXAMPLES_FOLDER);
        Ok(vec![session.add_source(&file, example.text, Some(folder))])
    };
    let mut process = ProcessHost::new(&wish.host, Path::new("."));
    let status = play(read, &mut session, &mut process, &wish.host, wish.interactive);
    if status != ExitStatus::Fine || wish.interactive {
        return status;
    }
    refuse(&Undeclared::in_session(&session), Talk::going_on(&mut process, &wish.host).host())
}
