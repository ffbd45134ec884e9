//! What the program says is true, and how far it moves and which branch it takes is right: held
//! against solutions of an independent reference, over random scenes with fixed seeds.

mod constructions;
mod findings;
mod program;
mod reference;
mod self_test;
mod studies;

/// For each study how many seeds it takes, and how many wrong cases are known at most, one number
/// for each rate in the order in which the study counts. What is mended is lowered here; 0 stays 0.
const LIMITS: [(&str, u64, &[usize]); 23] = [
    ("verdict", 300, &[0; 5]),
    ("sequences", 150, &[0; 4]),
    ("replaced", 256, &[0, 0]),
    ("line_of_centres", 200, &[0; 5]),
    ("reach", 200, &[0; 4]),
    ("contradictory", 120, &[0; 4]),
    ("conflict", 60, &[0; 3]),
    ("redundancy", 300, &[0, 0]),
    ("least", 200, &[0, 0]),
    ("drags", 40, &[0, 0]),
    ("triads", 25, &[0; 9]),
    ("six_bars", 25, &[0; 9]),
    ("branches", 40, &[0; 12]),
    ("motor", 40, &[0, 0]),
    ("arcs", 60, &[0, 0]),
    ("ranges", 100, &[0]),
    ("dead_points", 80, &[0, 0]),
    ("change_points", 20, &[0, 0]),
    ("velocities", 150, &[0]),
    ("receipts", 300, &[0; 4]),
    ("looser", 20, &[0]),
    ("effects", 2, &[0]),
    ("order", 60, &[0]),
];

/// A test for each study, and their names.
macro_rules! studies {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            hold(stringify!($name));
        })*

        #[test]
        fn every_study_is_held() {
            let held = [$(stringify!($name)),*];
            assert!(studies::ALL.iter().map(|study| study.name).eq(held));
            assert!(LIMITS.iter().map(|(name, ..)| *name).eq(held));
        }
    };
}

studies! {
    verdict
    sequences
    replaced
    line_of_centres
    reach
    contradictory
    conflict
    redundancy
    least
    drags
    triads
    six_bars
    branches
    motor
    arcs
    ranges
    dead_points
    change_points
    velocities
    receipts
    looser
    effects
    order
}

/// Runs a study and compares what it counts with what is known.
fn hold(name: &str) {
    let study = studies::ALL.iter().find(|study| study.name == name).expect("a study");
    let (_, n, limits) = LIMITS.iter().find(|(known, ..)| *known == name).expect("a limit");
    let counts = (study.run)(0..*n);
    counts.iter().for_each(|count| println!("{}", count.line()));
    assert_eq!(counts.len(), limits.len(), "{name} has so many rates");
    let mut above = Vec::new();
    for (count, most) in counts.iter().zip(*limits) {
        if count.n_wrong > *most {
            above.push(format!("at most {most} are known:\n{}", count.line()));
        }
    }
    assert!(above.is_empty(), "{}\n{}", studies::Count::HEAD, above.join("\n"));
}
