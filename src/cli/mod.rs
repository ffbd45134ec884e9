//! The command line: arguments, exit statuses, files, signals.

mod args;
mod examine;
mod files;
pub(crate) mod interrupt;
pub(crate) mod output;
mod process_host;
mod progress;
mod run;

use std::process::ExitCode;

/// Runs the program with the arguments of the process; gives its exit status.
pub fn run() -> ExitCode {
    let args = args::parse();
    interrupt::listen();
    let status = match args.command {
        Some(args::Invocation::Run(batch)) => run::batch(&batch),
        Some(args::Invocation::Accuracy(wish)) => examine::accuracy(&wish),
        Some(args::Invocation::Check(arguments)) => examine::check(&arguments),
        Some(args::Invocation::Effects(arguments)) => examine::effects(&arguments),
        None => run::session(&args.session),
    };
    output::flush();
    let is_lost = status == run::ExitStatus::Fine && output::has_failed();
    if is_lost { run::ExitStatus::Unreadable.into() } else { status.into() }
}
