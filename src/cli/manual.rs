//! `linkwork man` and `linkwork completions`: what a shell and `man` want to know, made from the
//! command line itself.

use std::io;

use clap::Command;

use super::args::CompletionArguments;
use super::output;
use super::run::ExitStatus;

/// Prints what completes the words of the command line in a shell.
pub fn completions(arguments: &CompletionArguments, mut command: Command) -> ExitStatus {
    let mut text = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(arguments.shell, &mut command, name, &mut text);
    answer(&text)
}

/// Prints the manual page, in the form that `man` reads.
pub fn manual(command: &Command) -> ExitStatus {
    let mut text = Vec::new();
    let written = page(command, &mut text);
    written.expect("a vector takes all that is written");
    answer(&text)
}

fn page(command: &Command, text: &mut Vec<u8>) -> io::Result<()> {
    let man = clap_mangen::Man::new(command.clone());
    man.render_title(text)?;
    man.render_name_section(text)?;
    man.render_synopsis_section(text)?;
    man.render_description_section(text)?;
    man.render_options_section(text)?;
    man.render_subcommands_section(text)?;
    text.extend_from_slice(EXIT_STATUS.as_bytes());
    man.render_version_section(text)
}

const EXIT_STATUS: &str = "\
.SH \"EXIT STATUS\"
.TP
0
everything was done
.TP
1
an assert failed, or a run broke its promise
.TP
2
a statement asked for something that cannot be done
.TP
3
a file could not be read or written
.TP
130
the user stopped it
";

fn answer(text: &[u8]) -> ExitStatus {
    let text = String::from_utf8_lossy(text);
    text.lines().for_each(output::answer);
    ExitStatus::Fine
}
