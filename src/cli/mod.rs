//! The command line: arguments, exit statuses, files, signals.

mod args;
pub(crate) mod environment;
mod examine;
mod files;
pub(crate) mod folders;
mod format;
pub(crate) mod graphics;
mod inform;
mod init;
pub(crate) mod interrupt;
mod journal;
mod language_server;
mod lines;
mod lone_word;
mod manual;
pub(crate) mod output;
pub(crate) mod process_host;
mod progress;
mod run;
mod seen;
mod spool;
mod sweep;
mod view;
mod watch;
mod wrap;

use std::process::ExitCode;

use args::{Deferred, Invocation};

/// Runs the program with the arguments of the process; gives its exit status.
pub fn run() -> ExitCode {
    let args = args::parse();
    interrupt::listen();
    output::set_format(args.message_format);
    graphics::set(args.graphics);
    let status = match args.command {
        Some(Invocation::Run(Deferred(batch))) => run::batch(&batch.scripts, &batch.host),
        Some(Invocation::Accuracy(Deferred(wish))) => examine::accuracy(&wish),
        Some(Invocation::Check(Deferred(arguments))) => examine::check(&arguments),
        Some(Invocation::Effects(Deferred(arguments))) => examine::effects(&arguments),
        Some(Invocation::Examples(Deferred(wish))) => inform::examples(&wish),
        Some(Invocation::Help(Deferred(wish))) => inform::help(&wish),
        Some(Invocation::Fmt(Deferred(arguments))) => format::format_all(&arguments),
        Some(Invocation::Sweep(Deferred(wish))) => sweep::sweep(&wish),
        Some(Invocation::Watch(Deferred(arguments))) => watch::watch(&arguments),
        Some(Invocation::View(Deferred(arguments))) => run::view(&arguments),
        Some(Invocation::Completions(Deferred(arguments))) => {
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
