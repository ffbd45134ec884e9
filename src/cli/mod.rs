//! The command line: arguments, exit statuses, files, signals.

mod args;
mod examine;
mod files;
pub(crate) mod folders;
mod format;
mod inform;
mod init;
pub(crate) mod interrupt;
mod journal;
mod language_server;
mod lines;
mod manual;
pub(crate) mod output;
pub(crate) mod process_host;
mod progress;
mod run;
mod spool;
mod sweep;
mod view;
mod watch;
mod wrap;

use std::process::ExitCode;

use args::Invocation;

/// Runs the program with the arguments of the process; gives its exit status.
pub fn run() -> ExitCode {
    let args = args::parse();
    interrupt::listen();
    output::set_format(args.message_format);
    let status = match args.command {
        Some(Invocation::Run(batch)) => run::batch(&batch.scripts, &batch.host),
        Some(Invocation::Accuracy(wish)) => examine::accuracy(&wish),
        Some(Invocation::Check(arguments)) => examine::check(&arguments),
        Some(Invocation::Effects(arguments)) => examine::effects(&arguments),
        Some(Invocation::Examples(wish)) => inform::examples(&wish),
        Some(Invocation::Help(wish)) => inform::help(&wish),
        Some(Invocation::Fmt(arguments)) => format::format_all(&arguments),
        Some(Invocation::Sweep(wish)) => sweep::sweep(&wish),
        Some(Invocation::Watch(arguments)) => watch::watch(&arguments),
        Some(Invocation::View(arguments)) => run::view(&arguments),
        Some(Invocation::Completions(arguments)) => {
            manual::completions(&arguments, args::command())
        }
        Some(Invocation::Man) => manual::manual(&args::command()),
        Some(Invocation::Lsp) => language_server::serve(),
        None if args.scripts.is_empty() => run::session(&args.host),
        None => run::batch(&args.scripts, &args.host),
    };
    output::flush();
    if let Some(status) = interrupt::ending() {
        return status.into();
    }
    let is_lost = status == run::ExitStatus::Fine && output::has_failed();
    if is_lost { run::ExitStatus::Unreadable.into() } else { status.into() }
}
