//! The results as tables in Markdown.

use crate::measure::Outcome;
use crate::work::Work;
use crate::{OURS, Results};

/// Three digits, without an exponent.
fn digits(value: f64) -> String {
    let places = (2 - value.abs().log10().floor() as i32).clamp(0, 4) as usize;
    format!("{value:.places$}")
}

fn time(o: &Outcome) -> String {
    let time = digits(o.micros);
    let lost = if o.n_failed == o.n_frames { ", calls it unsolved" } else { "" };
    format!("{time} ({}x{lost})", digits(o.ratio))
}

fn error(o: &Outcome) -> String {
    match o.n_failed {
        0 => format!("{:.0e}", o.error),
        n => format!("{:.0e}, {n} of {} unsolved", o.error, o.n_frames),
    }
}

fn wrong(o: &Outcome) -> String {
    match o.n_failed {
        0 => format!("{}", o.n_wrong),
        n => format!("{}, {n} unsolved", o.n_wrong),
    }
}

/// A line of Markdown.
fn line(cells: impl IntoIterator<Item = String>) {
    println!("| {} |", cells.into_iter().collect::<Vec<_>>().join(" | "));
}

/// How time grew over the last two sizes, as an exponent of the number of constraints.
fn growth(name: &str, works: &[&Work], results: &Results) -> String {
    let mut last: Vec<(f64, f64)> = works
        .iter()
        .filter_map(|w| {
            let o = results.get(&(name.to_owned(), w.name.clone()))?.as_ref().ok()?;
            (o.n_failed < o.n_frames).then_some((w.relations.len() as f64, o.micros))
        })
        .collect();
    match (last.pop(), last.pop()) {
        (Some((n2, t2)), Some((n1, t1))) => format!("{:.2}", (t2 / t1).ln() / (n2 / n1).ln()),
        _ => "-".into(),
    }
}

fn grid(
    title: &str,
    names: &[&str],
    works: &[&Work],
    results: &Results,
    has_growth: bool,
    cell: impl Fn(&Outcome) -> String,
) {
    if works.is_empty() {
        return;
    }
    println!("\n{title}\n");
    let tail = |text: &str| has_growth.then(|| text.to_owned());
    let head = works.iter().map(|w| w.name.clone());
    line([String::new()].into_iter().chain(head).chain(tail("growth")));
    line((0..=works.len()).map(|_| "---".to_owned()).chain(tail("---")));
    for name in names {
        let cells: Vec<String> = works
            .iter()
            .map(|w| match results.get(&((*name).to_owned(), w.name.clone())) {
                Some(Ok(o)) => cell(o),
                Some(Err(why)) if why == "none" => "-".into(),
                Some(Err(why)) => why.clone(),
                None => "-".into(),
            })
            .collect();
        if cells.iter().any(|c| c != "-") {
            let growth = has_growth.then(|| growth(name, works, results));
            line([(*name).to_owned()].into_iter().chain(cells).chain(growth));
        }
    }
}

/// All tables.
pub fn print(names: &[&str], groups: &[(&str, Vec<Work>)], results: &Results) {
    let of = |wanted: &[&str]| -> Vec<&Work> {
        groups.iter().filter(|g| wanted.contains(&g.0)).flat_map(|g| &g.1).collect()
    };
    let small = of(&["W1", "W2", "W3", "W4", "W7", "W8"]);
    let title = format!("Microseconds a frame, and how many times {OURS} that is");
    grid(&title, names, &small, results, false, time);
    grid("Worst constraint error / size", names, &small, results, false, error);
    let all = [small.clone(), of(&["steps"])].concat();
    let title = "Frames on a wrong branch, of 360; 1° a frame where nothing is said";
    grid(title, names, &all, results, false, wrong);
    for group in ["W5a", "W5b", "W5c"] {
        let works = of(&[group]);
        let title = format!(
            "{group}: microseconds a frame, and how many times {OURS} that is; growth as an \
             exponent of the number of constraints"
        );
        grid(&title, names, &works, results, true, time);
        grid(
            &format!("{group}: worst constraint error / size"),
            names,
            &works,
            results,
            false,
            error,
        );
    }
}
