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
        Some(args::Command::Run(batch)) => run::batch(&batch),
        Some(args::Command::Accuracy(wish)) => examine::accuracy(&wish),
        Some(args::Command::Check(examination)) => examine::check(&examination),
        Some(args::Command::Effects(examination)) => examine::effects(&examination),
        None => run::session(&args.session),
    };
    output::flush();
    status.into()
}
