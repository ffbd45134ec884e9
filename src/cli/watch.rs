//! `linkwork watch`: runs a script again whenever it, or a file that it reads, is saved.
//!
//! On a terminal each run ends with a picture of what it came to.

use std::thread::sleep;
use std::time::Duration;

use super::args::WatchArguments;
use super::process_host::ProcessHost;
use super::run::{self, ExitStatus};
use super::seen::Seen;
use super::{files, interrupt, output};
use crate::session::Undeclared;

/// How long a change goes unnoticed at most: short beside the time it takes to look up.
const PAUSE: Duration = Duration::from_millis(100);

/// Runs the script again and again, until the user stops it.
pub fn watch(arguments: &WatchArguments) -> ExitStatus {
    let file = &arguments.file;
    loop {
        output::clear_page();
        let mut host = ProcessHost::new(&arguments.host, files::folder_of(file));
        let mut seen = Seen::default();
        seen.note(file);
        host.watch(seen);
        let mut session = run::begin(&arguments.host);
        if run::script(file, &mut session, &mut host) == ExitStatus::Fine {
            run::refuse(&Undeclared::in_session(&session), &mut host);
        }
        if output::is_terminal() && session.world().points().ids().next().is_some() {
            let look = session.add_source("<watch>", "show", None);
            session.run_text(look, &mut host);
        }
        let seen = host.seen();
        if !arguments.host.quiet {
            let what = match seen.n_files() {
                1 => "it changes".to_owned(),
                n => format!("one of {n} files changes"),
            };
            output::remark(&format!("-- {} runs again when {what}; Ctrl-C ends", file.display()));
        }
        output::flush();
        while !seen.has_changed() {
            if interrupt::is_asked() {
                return ExitStatus::Interrupted;
            }
            sleep(PAUSE);
        }
    }
}
