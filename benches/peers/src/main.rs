//! The same mechanisms solved by linkwork and by others: prints tables in Markdown.
//!
//! Arguments: names of works (`W2`, `W5a`; none means all), and for each program that runs
//! beside this one `--beside NAME=COMMAND`.

mod beside;
mod engine;
mod exact;
mod ezpz;
mod lm;
mod measure;
mod ours;
mod peer;
mod table;
mod work;

use std::collections::BTreeMap;

use measure::Outcome;
use peer::Peer;
use work::Work;

/// The row of the program that all others are compared with.
pub const OURS: &str = "linkwork";
/// A larger scene of a kind is not begun by a peer that took longer than this for a frame of
/// the one before.
const TOO_LONG: f64 = 0.1e6;

/// What came of every peer on every work.
pub type Results = BTreeMap<(String, String), Result<Outcome, String>>;

/// Starts a peer on a work; the error says why there is none.
type Start<'a> = Box<dyn Fn(&'a Work) -> Result<Box<dyn Peer + 'a>, String> + 'a>;

fn peers<'a>(beside: &'a [(String, String)]) -> Vec<(String, Start<'a>)> {
    fn boxed<'a>(peer: Option<impl Peer + 'a>, why: &str) -> Result<Box<dyn Peer + 'a>, String> {
        peer.map(|peer| Box::new(peer) as Box<dyn Peer>).ok_or_else(|| why.to_owned())
    }
    let mut all: Vec<(String, Start<'a>)> = vec![
        ("closed form".into(), Box::new(|w| boxed(exact::Exact::start(w), "none"))),
        (
            OURS.into(),
            Box::new(|w| ours::Ours::start(w).map(|peer| Box::new(peer) as Box<dyn Peer>)),
        ),
        ("levenberg-marquardt".into(), Box::new(|w| boxed(lm::Lm::start(w), "not its kind"))),
        ("kcl-ezpz".into(), Box::new(|w| boxed(Some(ezpz::Ezpz::start(w)), ""))),
        ("rapier2d".into(), Box::new(|w| boxed(engine::Engine::start(w), "not its kind"))),
    ];
    for (name, command) in beside {
        all.push((
            name.clone(),
            Box::new(move |w| {
                beside::Beside::start(command, w).map(|peer| Box::new(peer) as Box<dyn Peer>)
            }),
        ));
    }
    all
}

fn main() {
    let mut beside: Vec<(String, String)> = Vec::new();
    let mut wanted: Vec<String> = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--beside" {
            let value = arguments.next().unwrap_or_default();
            let (name, command) = value.split_once('=').expect("--beside NAME=COMMAND");
            beside.push((name.to_owned(), command.to_owned()));
        } else {
            wanted.push(argument);
        }
    }
    let is_wanted = |group: &str| wanted.is_empty() || wanted.iter().any(|w| w == group);

    let mut groups: Vec<(&str, Vec<Work>)> = vec![
        ("W1", vec![work::four_bar()]),
        ("W2", vec![work::jansen()]),
        ("W3", vec![work::peaucellier()]),
        ("W4", vec![work::crankshaft()]),
        ("W7", vec![work::parallelogram()]),
        ("W8", vec![work::three_cranks()]),
        ("W5a", [10, 100, 1000, 10000].map(work::chain).to_vec()),
        ("W5b", [4, 8, 16, 32, 64].map(work::truss).to_vec()),
        ("W5c", [1, 10, 100, 1000, 10000].map(work::four_bars).to_vec()),
    ];
    let steps = [10.0, 30.0, 60.0];
    let coarse = |work: Work| steps.map(|degrees| work.at_degrees(degrees)).to_vec();
    groups.push(("steps", [coarse(work::four_bar()), coarse(work::jansen())].concat()));
    groups.retain(|(group, _)| is_wanted(group));

    let peers = peers(&beside);
    let mut results = Results::new();
    for (group, works) in &groups {
        // Why a peer is not asked for more of this kind.
        let mut lost: BTreeMap<&str, String> = BTreeMap::new();
        for work in works {
            eprintln!("{}", work.name);
            let started = peers
                .iter()
                .map(|(name, start)| {
                    let peer = match lost.get(name.as_str()) {
                        Some(why) => Err(why.clone()),
                        None => start(work),
                    };
                    (name.clone(), peer)
                })
                .collect();
            for (name, outcome) in measure::compare(work, started) {
                let (name, _) = peers.iter().find(|p| p.0 == name).expect("it was asked");
                match &outcome {
                    _ if *group == "steps" => {}
                    Err(why) if why != "none" => drop(lost.insert(name, why.clone())),
                    Ok(o) if o.micros > TOO_LONG => drop(lost.insert(name, "too slow".into())),
                    Ok(o) if o.n_failed == o.n_frames => {
                        lost.insert(name, "no convergence".into());
                    }
                    _ => {}
                }
                results.insert((name.clone(), work.name.clone()), outcome);
            }
        }
    }
    let names: Vec<&str> = peers.iter().map(|p| p.0.as_str()).collect();
    table::print(&names, &groups, &results);
}
