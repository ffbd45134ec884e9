//! Any text: each statement is read or refused, and what was read prints as text that reads as
//! the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use linkwork::diag::Sources;
use linkwork::lang::parse;

fuzz_target!(|text: &str| {
    let mut sources = Sources::new();
    let source = sources.add("fuzz", text);
    for statement in parse(source, text) {
        let Ok(statement) = statement else { continue };
        let printed = statement.command.to_string();
        let again = sources.add("printed", printed.as_str());
        let mut statements = parse(again, &printed);
        let read = statements.next().expect("a statement prints as one").unwrap_or_else(|why| {
            panic!("{text:?} prints as {printed:?}: {}", why.message)
        });
        assert!(statements.next().is_none(), "{text:?} prints as {printed:?}");
        assert_eq!(read.command.to_string(), printed);
    }
});
