//! What may stand at the end of a line that is being typed: commands where a statement begins,
//! else names, settings, functions.

use std::collections::BTreeSet;

use super::commands::setting_table::Setting;
use crate::lang::ast::{Function, Unit};
use crate::lang::catalogue;
use crate::solve::Method;
use crate::terms::Member;
use crate::world::{Entity, World};

/// Names offered; more than this are no help, and are not looked through.
const MOST_NAMES: usize = 10_000;

/// What can be offered: the words of the language, and the names of a world.
#[derive(Debug, Clone, Default)]
pub struct Completion {
    names: BTreeSet<String>,
    /// Members of constraints: offered once the dot is there.
    members: BTreeSet<String>,
    /// The world's revision at which it had these names.
    revision: u64,
}

impl Completion {
    /// Takes in the names that there are now.
    pub fn refresh(&mut self, world: &World) {
        if self.revision == world.revision() {
            return;
        }
        self.revision = world.revision();
        let names = world.names();
        let all = names.instances().chain(names.iter().map(|(name, _)| name));
        self.names = all.take(MOST_NAMES).map(str::to_owned).collect();
        let constraints = world.constraints().map(|(id, _)| id).take(MOST_NAMES);
        let members = constraints.flat_map(|id| {
            let name = world.name_of(Entity::Constraint(id));
            let members = Member::ALL.into_iter().filter(move |&m| world.has_member(id, m));
            members.map(move |member| format!("{name}.{}", member.word()))
        });
        self.members = members.collect();
    }

    /// Where the word at the end of `before` begins, and what it may become, in order.
    pub fn candidates(&self, before: &str) -> (usize, Vec<String>) {
        let start = before.rfind(ends_word).map_or(0, |k| k + 1);
        let word = &before[start..];
        let statement = before[..start].rfind(['\n', ';', '{', '}']).map_or(0, |k| k + 1);
        let said: Vec<&str> = before[statement..start].split_whitespace().collect();
        let commands = || catalogue::commands().map(|entry| entry.keyword);
        let mut found: Vec<&str> = match said[..] {
            // After a label too.
            [] => commands().collect(),
            [label] if label.ends_with(':') => commands().collect(),
            ["help"] => commands().chain(catalogue::topics().map(|entry| entry.keyword)).collect(),
            ["print", .., "in"] => Unit::ALL.iter().map(|unit| unit.suffix()).collect(),
            ["set"] => Setting::names().collect(),
            ["set", "method"] => Method::ALL.iter().map(|method| method.word()).collect(),
            ["list"] => vec!["points", "constraints", "traces", "parameters", "definitions"],
            _ => self.names.iter().map(String::as_str).collect(),
        };
        // A value may be computed; what a command is about is named.
        let is_unit = matches!(said[..], ["print", .., "in"]);
        let is_value = before[statement..start].contains(['=', '('])
            || matches!(said.first(), Some(&("print" | "assert" | "let" | "sample")));
        if is_value && !is_unit {
            Function::ALL.iter().for_each(|function| found.push(function.name()));
            let is_member = word.contains('.');
            found.extend(self.members.iter().filter(|_| is_member).map(String::as_str));
        }
        found.retain(|candidate| candidate.starts_with(word));
        found.sort_unstable();
        found.dedup();
        (start, found.into_iter().map(str::to_owned).collect())
    }
}

/// Whether a character is no part of a name with its indices and members.
fn ends_word(c: char) -> bool {
    !(c.is_alphanumeric() || "_'.[]".contains(c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(before: &str, wanted: (usize, &[&str])) {
        let names = ["A", "coupler", "p[10]", "p[1]", "left.P"].map(str::to_owned).into();
        let members = ["coupler.value", "coupler.residual"].map(str::to_owned).into();
        let (start, found) = Completion { names, members, revision: 0 }.candidates(before);
        assert_eq!(
            (start, found.iter().map(String::as_str).collect::<Vec<_>>()),
            (wanted.0, wanted.1.to_vec()),
            "{before}"
        );
    }

    #[test]
    fn what_fits_the_place_is_offered() {
        check("len", (0, &["length"]));
        check("  dr", (2, &["drag"]));
        check("step 3; und", (8, &["undo"]));
        check("bar: mot", (5, &["motor"]));
        check("show c", (5, &["coupler"]));
        check("print c", (6, &["ceil", "clamp", "cos", "coupler", "cross", "curvature"]));
        check("print coupler.", (6, &["coupler.residual", "coupler.value"]));
        check("show coupler.", (5, &[]));
        check("print coupler.value in r", (23, &["rad", "rev", "rpm"]));
        check("length A coupler = co", (19, &["cos", "coupler"]));
        check("length A p[1", (9, &["p[10]", "p[1]"]));
        check("delete le", (7, &["left.P"]));
        check("set dead", (4, &["dead-points"]));
        check("set method con", (11, &["conjugate"]));
        check("help expr", (5, &["expressions"]));
        check("print (A - coup", (11, &["coupler"]));
    }
}
