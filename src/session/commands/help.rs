//! `help` and `examples`: what comes with the program.

use std::fmt::Write;

use super::setting_table::{SETTINGS, Setting};
use crate::diag::{Diagnostic, suggest};
use crate::errors;
use crate::lang::ast::Ident;
use crate::lang::catalogue::{self, Entry, Outside, Trade};
use crate::session::examples::Example;
use crate::session::execution::Execution;
use crate::session::state::State;
use crate::solve::Method;
use crate::terms::Function;

impl Execution<'_> {
    pub(crate) fn examples(&mut self, name: Option<&Ident>) -> Result<(), Diagnostic> {
        let lines: Vec<String> = match name {
            None => Example::overview(),
            Some(word) => Example::named(&word.text)
                .map_err(|problem| problem.at(word.span, "no such example"))?
                .text
                .lines()
                .map(str::to_owned)
                .collect(),
        };
        self.print_all(&lines);
        Ok(())
    }

    pub(crate) fn help(&mut self, topic: Option<&Ident>) -> Result<(), Diagnostic> {
        let text = match topic {
            None => overview(),
            Some(topic) => self.state.help_on(topic)?,
        };
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        self.print_all(&lines);
        Ok(())
    }
}

impl State {
    fn help_on(&self, topic: &Ident) -> Result<String, Diagnostic> {
        let word = &*topic.text;
        if let Some(kind) = errors::explained(word) {
            return Ok(error_explained(kind));
        }
        let mut text = catalogue::entry(word).map(explained).unwrap_or_default();
        // Writing to a string cannot fail.
        for function in Function::named(word) {
            let _ = writeln!(text, "{word}: {}", function.help());
        }
        if let Some(Setting { name, what, text: now, .. }) = Setting::named(word) {
            let _ = writeln!(text, "set {name}: {what}; now {}", now(self));
            if *name == "method" {
                let _ = writeln!(text, "  {}", Method::ALL.map(Method::word).join(", "));
            }
        }
        if text.is_empty()
            && let Some(entry) = catalogue::about(word)
        {
            text = explained(entry);
        }
        if let Some(trade) = catalogue::trade(word) {
            text.push_str(&trade_explained(word, trade));
        }
        if let Some(Outside { says, example, .. }) = catalogue::outside(word) {
            let _ = writeln!(text, "{word} {says}, from a shell:\n  {example}");
        }
        if text.is_empty() {
            let problem = Diagnostic::error(errors::NO_HELP, format!("no help on `{word}`"))
                .at(topic.span, "unknown topic");
            let known = catalogue::commands()
                .chain(catalogue::topics())
                .map(|entry| entry.keyword)
                .chain(Function::ALL.iter().map(|f| f.name()))
                .chain(SETTINGS.iter().map(|setting| setting.name));
            return Err(suggest(problem, word, known).help("`help` alone lists the commands"));
        }
        Ok(text)
    }
}

/// A command or subject in full.
fn explained(entry: &Entry) -> String {
    // Writing to a string cannot fail.
    let mut text = String::new();
    let _ = writeln!(text, "{}\n  {}.", entry.usage, entry.summary);
    for part in [entry.help, entry.example] {
        if !part.is_empty() {
            let _ = writeln!(text, "\n{part}");
        }
    }
    text
}

/// A word of the trade: what it is here, what to type, and how the command goes on.
fn trade_explained(word: &str, trade: &Trade) -> String {
    let Trade { command, says, example, .. } = trade;
    let mut text = format!("{word} {says}:\n  {example}\n");
    if let Some(entry) = catalogue::entry(command) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\n{}", entry.usage);
    }
    let _ = writeln!(text, "`help {command}` says more.");
    text
}

/// A kind of error in full.
fn error_explained(kind: &errors::Kind) -> String {
    // Writing to a string cannot fail.
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}.", kind.code, kind.title);
    if !kind.help.is_empty() {
        let _ = writeln!(text, "{}", kind.help);
    }
    for (heading, example) in [("so it goes wrong:", kind.wrong), ("put right:", kind.right)] {
        if !example.is_empty() {
            let _ = writeln!(text, "\n{heading}\n  {}", example.replace('\n', "\n  "));
        }
    }
    text
}

/// The commands under their headings, a line each.
fn overview() -> String {
    let mut text = String::new();
    for section in catalogue::Section::ALL {
        let entries: Vec<_> = catalogue::commands()
            .chain(catalogue::topics())
            .filter(|entry| entry.section == section)
            .collect();
        if entries.is_empty() {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", section.title());
        for entry in entries {
            let _ = writeln!(text, "  {:<14}{}", entry.keyword, entry.summary);
        }
    }
    text.push_str("`help WORD` says more: `help motor`\n");
    text
}
