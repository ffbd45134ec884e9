//! The command line: arguments, exit statuses, files, signals.

mod args;
mod examine;
mod files;
mod format;
pub(crate) mod interrupt;
mod language_server;
mod manual;
pub(crate) mod output;
mod process_host;
mod progress;
mod run;
mod spool;
mod watch;

use std::process::ExitCode;

/// Runs the program with the arguments of the process; gives its exit status.
pub fn run() -> ExitCode {
    let args = args::parse();
    interrupt::listen();
    output::set_format(args.message_format);
    let status = match args.command {
        Some(args::Invocation::Run(batch)) => run::batch(&batch),
        Some(args::Invocation::Accuracy(wish)) => examine::accuracy(&wish),
        Some(args::Invocation::Check(arguments)) => examine::check(&arguments),
        Some(args::Invocation::Effects(arguments)) => examine::effects(&arguments),
        Some(args::Invocation::Fmt(arguments)) => format::format_all(&arguments),
        Some(args::Invocation::Watch(arguments)) => watch::watch(&arguments),
        Some(args::Invocation::Completions(arguments)) => {
            manual::completions(&arguments, args::command())
        }
        Some(args::Invocation::Man) => manual::manual(&args::command()),
        Some(args::Invocation::Lsp) => language_server::serve(),
        None => run::session(&args.session),
    };
    output::flush();
    if let Some(status) = interrupt::ending() {
        return status.into();
    }
    let is_lost = status == run::ExitStatus::Fine && output::has_failed();
    if is_lost { run::ExitStatus::Unreadable.into() } else { status.into() }
}
