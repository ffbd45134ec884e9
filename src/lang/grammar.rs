//! What pest derives from the grammar: its parser, and a name for each of its rules.

#![allow(missing_docs, reason = "what is derived has none")]

/// The parser of `grammar/linkwork.pest`.
#[derive(pest_derive::Parser)]
#[grammar = "../grammar/linkwork.pest"]
pub struct LinkworkParser;
