//! What can be written behind `linkwork`.

use std::path::PathBuf;

use clap::builder::Resettable;
use clap::{ArgMatches, Args, Command, CommandFactory, FromArgMatches, Parser, Subcommand};

use super::environment;
use super::graphics::Graphics;
use super::output::MessageFormat;

use crate::diag::visible;
use crate::session::{Axis, Quota, Shard};

/// Planar mechanisms under geometric constraints: sketch, run and draw them.
///
/// With files, runs them as `run` does. Without any a session begins: a prompt on a terminal, or
/// statements read from standard input.
#[derive(Debug, Parser)]
#[command(version, about, disable_help_subcommand = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Invocation>,
    /// What to run where no command is said.
    #[command(flatten)]
    pub scripts: Scripts,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
    /// How errors, warnings and notes are written.
    #[arg(long, global = true, value_name = "FORMAT", default_value = "full")]
    pub message_format: MessageFormat,
    /// How pictures are shown in a terminal.
    #[arg(
        long,
        global = true,
        value_name = "HOW",
        default_value = "auto",
        env = environment::if_set("LINKWORK_GRAPHICS")
    )]
    pub graphics: Graphics,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Invocation {
    /// Run scripts, one after the other, each in a world of its own.
    Run(Deferred<RunArguments>),
    /// Tell what accuracy costs in time on a script's own motion: a table, `accuracy.csv` and
    /// `accuracy.svg`.
    Accuracy(Deferred<AccuracyArguments>),
    /// Run a script and examine what is there at its end: freedoms, redundant and conflicting
    /// constraints, singular poses. Exit status 1 if something conflicts.
    Check(Deferred<ExamineArguments>),
    /// Run a script and tell which effects its scene has switched on at the end, why, and what
    /// each costs.
    Effects(Deferred<ExamineArguments>),
    /// List the mechanisms that come with the program; print one, or run it.
    Examples(Deferred<ExampleArguments>),
    /// Say how a command is written and what it does: one of the language, or of the shell.
    Help(Deferred<HelpArguments>),
    /// Set scripts in canonical form; comments and line breaks are kept.
    Fmt(Deferred<FormatArguments>),
    /// Run a script again whenever it is saved, or a file that it includes.
    Watch(Deferred<WatchArguments>),
    /// Run a script for every combination of the values that `--set` gives, into one table: what
    /// `result` says, how it ended, dead points.
    Sweep(Deferred<SweepArguments>),
    /// Run a script, show the mechanism in a browser, and go on at the prompt: what is typed shows at
    /// once, and what the mouse does is written as statements.
    View(Deferred<ViewArguments>),
    /// Print what completes the command line in a shell.
    Completions(Deferred<CompletionArguments>),
    /// Print the manual page.
    Man,
    /// Serve an editor as a language server, on standard input and output: mistakes, help,
    /// completion, form.
    Lsp,
}

/// Arguments of a command that are set up only where it is the one: the rest costs a start nothing.
#[derive(Debug)]
pub struct Deferred<T>(pub T);

impl<T: Args> Args for Deferred<T> {
    fn augment_args(command: Command) -> Command {
        command.defer(set_up::<T>)
    }

    fn augment_args_for_update(command: Command) -> Command {
        command.defer(set_up::<T>)
    }
}

impl<T: FromArgMatches> FromArgMatches for Deferred<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        T::from_arg_matches(matches).map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        self.0.update_from_arg_matches(matches)
    }
}

/// Adds the arguments; what the command does was said of it, not of them.
fn set_up<T: Args>(command: Command) -> Command {
    let about = command.get_about().cloned();
    let long_about = command.get_long_about().cloned();
    T::augment_args(command).about(Resettable::from(about)).long_about(Resettable::from(long_about))
}

/// A script to be examined.
#[derive(Debug, Args)]
pub struct ExamineArguments {
    /// The script; `-` is standard input.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
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
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// Scripts to run.
#[derive(Debug, Args)]
#[command(arg_required_else_help = true)]
pub struct RunArguments {
    /// What to run.
    #[command(flatten)]
    pub scripts: Scripts,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

/// An example to look at.
#[derive(Debug, Args)]
pub struct ExampleArguments {
    /// Which; without one all are listed.
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// Run it.
    #[arg(long, requires = "name")]
    pub run: bool,
    /// Run it, then go on at the prompt.
    #[arg(long, short, requires = "name")]
    pub interactive: bool,
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

/// A script to be run many times.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// The script. What it prints and writes is left out.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Work on so many cores, not on all.
    #[arg(long, short, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Run one of so many parts, for several machines: `2/8`.
    #[arg(long, value_name = "I/N", value_parser = parse_shard)]
    pub shard: Option<Shard>,
    /// Go on with the table that is there.
    #[arg(long)]
    pub resume: bool,
    /// Draw the poses that variants end in, side by side: up to a hundred, evenly chosen.
    #[arg(long)]
    pub pictures: bool,
    /// The table, in the output folder; `-` is standard output. By default `sweep.csv`, with `--json`
    /// `sweep.jsonl`.
    #[arg(long, value_name = "NAME")]
    pub to: Option<String>,
    /// The grid and how it talks.
    #[command(flatten)]
    pub host: HostArguments,
}

/// A session to be looked at.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// The script; without one the world is empty.
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Serve the page at this port of this machine, not at any that is free.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub port: Option<u16>,
    /// How it talks and where it writes.
    #[command(flatten)]
    pub host: HostArguments,
}

impl SweepArguments {
    /// What the table is called.
    pub fn table_name(&self) -> &str {
        let usual = if self.host.json { "sweep.jsonl" } else { "sweep.csv" };
        self.to.as_deref().unwrap_or(usual)
    }
}

/// What to say more about.
#[derive(Debug, Args)]
pub struct HelpArguments {
    /// A command, a function, a setting or a subject of the language, or a command of the shell.
    #[arg(value_name = "TOPIC")]
    pub topic: Option<String>,
    /// How it talks.
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

/// Texts to run.
#[derive(Debug, Clone, Args)]
pub struct Scripts {
    /// Scripts; `-` is standard input.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Carry out the statements of this text, after the files; may be said again.
    #[arg(long = "eval", short, value_name = "TEXT", allow_hyphen_values = true)]
    pub eval: Vec<String>,
    /// Go on at the prompt after the files and texts, all in one world.
    #[arg(long, short)]
    pub interactive: bool,
}

impl Scripts {
    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty() && self.eval.is_empty()
    }
}

/// How a session talks and where it writes.
#[derive(Debug, Clone, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct HostArguments {
    /// The folder that pictures, recordings and saved sessions are written to; by default the
    /// working folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Give a parameter a value; wins over the script's own `let`. For `sweep` several: `a=1..5:0.5`,
    /// `b=1,2,4`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = parse_setting)]
    pub set: Vec<Axis>,
    /// Say nothing on standard error but errors.
    #[arg(long, short)]
    pub quiet: bool,
    /// Say all that is to be said as JSON on standard output, an object a line; docs/json.md has them.
    #[arg(long)]
    pub json: bool,
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
    /// Keep no journal of the session.
    #[arg(long)]
    pub no_journal: bool,
    /// Do not read `init.link` of the configuration folder before the prompt.
    #[arg(long)]
    pub no_init: bool,
    /// Print long answers at once, not page by page.
    #[arg(long)]
    pub no_pager: bool,
}

impl HostArguments {
    /// The folder that files are written to.
    pub fn out(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| PathBuf::from("."))
    }

    /// What was said before the command and behind it: what is behind wins, lists are joined.
    pub fn followed_by(self, behind: Self) -> Self {
        // Taken apart, so that none is forgotten.
        let Self {
            out,
            set,
            quiet,
            json,
            threads,
            allow_any_path,
            libraries,
            force,
            no_journal,
            no_init,
            no_pager,
            limits,
        } = behind;
        Self {
            out: out.or(self.out),
            set: self.set.into_iter().chain(set).collect(),
            quiet: quiet || self.quiet,
            json: json || self.json,
            threads: threads.or(self.threads),
            allow_any_path: allow_any_path || self.allow_any_path,
            libraries: self.libraries.into_iter().chain(libraries).collect(),
            force: force || self.force,
            no_journal: no_journal || self.no_journal,
            no_init: no_init || self.no_init,
            no_pager: no_pager || self.no_pager,
            limits: self.limits.into_iter().chain(limits).collect(),
        }
    }
}

impl Invocation {
    /// The options behind the command, if it takes any.
    fn host_mut(&mut self) -> Option<&mut HostArguments> {
        match self {
            Self::Run(Deferred(RunArguments { host, .. }))
            | Self::Accuracy(Deferred(AccuracyArguments { host, .. }))
            | Self::Check(Deferred(ExamineArguments { host, .. }))
            | Self::Effects(Deferred(ExamineArguments { host, .. }))
            | Self::Examples(Deferred(ExampleArguments { host, .. }))
            | Self::Sweep(Deferred(SweepArguments { host, .. }))
            | Self::Watch(Deferred(WatchArguments { host, .. }))
            | Self::View(Deferred(ViewArguments { host, .. }))
            | Self::Help(Deferred(HelpArguments { host, .. })) => Some(host),
            Self::Fmt(_) | Self::Completions(_) | Self::Man | Self::Lsp => None,
        }
    }
}

/// The arguments of this process; on a mistake, or for `--help`, the process ends here.
pub fn parse() -> Arguments {
    let mut arguments = Arguments::try_parse().unwrap_or_else(|problem| {
        // What is wrong is told with what was typed, as a terminal may show it.
        let shown = std::env::args_os().map(|word| visible(&word.to_string_lossy()).into_owned());
        Arguments::try_parse_from(shown).err().unwrap_or(problem).exit()
    });
    let is_sweep = matches!(arguments.command, Some(Invocation::Sweep(_)));
    if let Some(invocation) = &mut arguments.command {
        if !arguments.scripts.is_empty() || arguments.scripts.interactive {
            let problem = "files, `-e` and `-i` stand behind the command, or alone";
            clap::Error::raw(clap::error::ErrorKind::ArgumentConflict, format!("{problem}\n"))
                .with_cmd(&command())
                .exit();
        }
        if let Some(behind) = invocation.host_mut() {
            *behind = arguments.host.clone().followed_by(behind.clone());
        }
    }
    let host = match &mut arguments.command {
        Some(invocation) => invocation.host_mut(),
        None => Some(&mut arguments.host),
    };
    let many = host.and_then(|host| host.set.iter().find(|axis| axis.values.len() > 1));
    if let Some(axis) = many.filter(|_| !is_sweep) {
        let n = axis.values.len();
        let problem =
            format!("`--set {}=...` has {n} values: `linkwork sweep` takes them", axis.name);
        clap::Error::raw(clap::error::ErrorKind::ValueValidation, format!("{problem}\n"))
            .with_cmd(&command())
            .exit();
    }
    arguments
}

/// What the shell's own commands are called.
pub fn command_names() -> Vec<String> {
    command().get_subcommands().map(|command| command.get_name().to_owned()).collect()
}

/// What `--help` says of one of the shell's commands, or of the whole program.
pub fn help_on(name: Option<&str>) -> Option<String> {
    let mut all = command();
    let command = match name {
        Some(name) => all.find_subcommand_mut(name)?,
        None => &mut all,
    };
    Some(command.render_help().to_string())
}

/// The command line as data.
pub fn command() -> Command {
    let mut command = Arguments::command();
    // Usage lines begin with the name of the program.
    command.build();
    command
}

/// `name=value`, the value a number as the language writes it (`90deg`, `1/3`), or several of them.
fn parse_setting(text: &str) -> Result<Axis, String> {
    crate::session::parse_axis(text).map_err(|problem| problem.message.to_string())
}

/// `2/8`: the second of eight parts.
fn parse_shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(number, of)| {
        Some(Shard { number: number.parse().ok()?, of: of.parse().ok()? })
    });
    parts
        .filter(|shard| (1..=shard.of).contains(&shard.number) && shard.of <= 1_000_000)
        .ok_or_else(|| {
            "expected I/N, a number from 1 and how many parts there are: `2/8`".to_owned()
        })
}

/// `name=number`, a limit of a session.
fn parse_limit(text: &str) -> Result<(Quota, u64), String> {
    crate::session::parse_limit(text).map_err(|problem| problem.message.to_string())
}
