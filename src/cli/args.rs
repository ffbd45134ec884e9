//! What can be written behind `linkwork`.

use std::path::PathBuf;

use clap::{Args, CommandFactory, Parser, Subcommand};

use super::output::MessageFormat;

use crate::diag::visible;
use crate::session::Quota;

/// Planar mechanisms under geometric constraints: sketch, run and draw them.
///
/// Without a command a session begins: a prompt on a terminal, or statements read from
/// standard input.
#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Invocation>,
    /// How a session talks and where it writes.
    #[command(flatten)]
    pub session: HostArguments,
    /// How errors, warnings and notes are written.
    #[arg(long, global = true, value_name = "FORMAT", default_value = "full")]
    pub message_format: MessageFormat,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Invocation {
    /// Run scripts, one after the other, each in a world of its own.
    Run(RunArguments),
    /// Tell what accuracy costs in time on a script's own motion: a table, `accuracy.csv` and
    /// `accuracy.svg`.
    Accuracy(AccuracyArguments),
    /// Run a script and examine what is there at its end: freedoms, redundant and conflicting
    /// constraints, singular poses. Exit status 1 if something conflicts.
    Check(ExamineArguments),
    /// Run a script and tell which effects its scene has switched on at the end, why, and what
    /// each costs.
    Effects(ExamineArguments),
    /// Set scripts in canonical form; comments and line breaks are kept.
    Fmt(FormatArguments),
    /// Run a script again whenever it is saved, or a file that it includes.
    Watch(WatchArguments),
    /// Print what completes the command line in a shell.
    Completions(CompletionArguments),
    /// Print the manual page.
    Man,
    /// Serve an editor as a language server, on standard input and output: mistakes, help,
    /// completion, form.
    Lsp,
}

/// A script to be examined.
#[derive(Debug, Args)]
pub struct ExamineArguments {
    /// The script; `-` is standard input.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Print the findings as one JSON object.
    #[arg(long)]
    pub json: bool,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// A script to study.
#[derive(Debug, Args)]
pub struct AccuracyArguments {
    /// The script; `-` is standard input. What it prints and writes is left out.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Study so many frames, not those of the script's longest run.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub frames: Option<u64>,
    /// Print a list of JSON objects, not a table.
    #[arg(long)]
    pub json: bool,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// Scripts to run.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// Scripts; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// Scripts to be set in canonical form.
#[derive(Debug, Args)]
pub struct FormatArguments {
    /// Scripts, each written in its place; `-` is standard input, to standard output.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write nothing; name the scripts that are in another form, with exit status 1 if there are.
    #[arg(long)]
    pub check: bool,
}

/// A script to be watched.
#[derive(Debug, Args)]
pub struct WatchArguments {
    /// The script. It need not be there yet.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// A shell to be told how the program is called.
#[derive(Debug, Args)]
pub struct CompletionArguments {
    /// The shell.
    #[arg(value_name = "SHELL")]
    pub shell: clap_complete::Shell,
}

/// How a session talks and where it writes.
#[derive(Debug, Clone, Args)]
pub struct HostArguments {
    /// The folder that pictures, recordings and saved sessions are written to.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Give a parameter a value; wins over the script's own `let`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, f64)>,
    /// Say nothing on standard error but errors.
    #[arg(long, short)]
    pub quiet: bool,
    /// Work with so many cores, not with all; the results are the same to the bit.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Let scripts read and write anywhere, not only below their own folder and the output folder.
    #[arg(long)]
    pub allow_any_path: bool,
    /// Let scripts read files in this folder and below it too; may be given several times.
    #[arg(short = 'I', value_name = "DIR")]
    pub libraries: Vec<PathBuf>,
    /// Change a limit: `points=1e6`, or `points=none`; the names stand in docs/language.md.
    #[arg(long = "limit", value_name = "NAME=NUMBER", value_parser = parse_limit)]
    pub limits: Vec<(Quota, u64)>,
    /// Replace files even if linkwork did not write them.
    #[arg(long)]
    pub force: bool,
}

/// The arguments of this process; on a mistake, or for `--help`, the process ends here.
pub fn parse() -> Arguments {
    Arguments::try_parse().unwrap_or_else(|problem| {
        // What is wrong is told with what was typed, as a terminal may show it.
        let shown = std::env::args_os().map(|word| visible(&word.to_string_lossy()).into_owned());
        Arguments::try_parse_from(shown).err().unwrap_or(problem).exit()
    })
}

/// The command line as data.
pub fn command() -> clap::Command {
    Arguments::command()
}

/// `name=value`, where the value is a number as the language writes it: `90deg`, `1/3`.
fn parse_setting(text: &str) -> Result<(String, f64), String> {
    crate::session::evaluate_binding(text).map_err(|problem| problem.message.to_string())
}

/// `name=number`, a limit of a session.
fn parse_limit(text: &str) -> Result<(Quota, u64), String> {
    crate::session::parse_limit(text).map_err(|problem| problem.message.to_string())
}
