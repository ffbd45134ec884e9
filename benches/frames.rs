//! What a frame takes through the whole program: `cargo bench --bench frames`.
//!
//! The scripts of `scripts/bench` in a session with default settings and no output. All of a
//! script but its last statement is setting up and not timed; one iteration is one frame, of as
//! many as the bench asks for in one statement. Times are of the processor. Further: a sweep of
//! the method `relaxation`, what a statement costs, and the functions of `libm`.
#![allow(clippy::disallowed_methods)]

use std::time::Duration;

use cpu_time::ProcessTime;
use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group,
    criterion_main,
};
use linkwork::lang::ast::Statement;
use linkwork::session::{Nowhere, Session};

macro_rules! script {
    ($name:literal) => {
        include_str!(concat!("../scripts/bench/", $name, ".link"))
    };
}

const CHAIN: &str = script!("w5a-chain");
const TRUSS: &str = script!("w5b-truss");
const FOUR_BARS: &str = script!("w5c-four-bars");

/// Frames that a point is dragged one way, before it is dragged back.
const WAY: u64 = 20;

fn statements(session: &mut Session, text: &str) -> Vec<Statement> {
    let source = session.add_source("bench", text, None);
    linkwork::lang::parse(source, text).map(|s| s.expect("a statement")).collect()
}

fn execute(session: &mut Session, text: &str) {
    for statement in statements(session, text) {
        session.execute(&statement, &mut Nowhere).expect("a statement that works");
    }
}

/// A session that has carried out all of a script but its last statement.
fn set_up(script: &str, n: Option<usize>) -> Session {
    let mut session = Session::new();
    if let Some(n) = n {
        session.override_parameter("n", n as f64);
    }
    let all = statements(&mut session, script);
    let (_, setup) = all.split_last().expect("a script");
    setup
        .iter()
        .for_each(|s| _ = session.execute(s, &mut Nowhere).expect("a statement that works"));
    session
}

fn timed(session: &mut Session, text: &str) -> Duration {
    let begun = ProcessTime::now();
    execute(session, text);
    begun.elapsed()
}

/// Frames of a scene that its clock drives.
fn turning(group: &mut BenchmarkGroup<WallTime>, id: BenchmarkId, mut session: Session) {
    execute(&mut session, "step 20");
    group.bench_function(id, |b| {
        b.iter_custom(|frames| timed(&mut session, &format!("step {frames}")));
    });
}

/// Frames of a scene of which a point is dragged there and back.
fn dragging(
    group: &mut BenchmarkGroup<WallTime>,
    id: BenchmarkId,
    mut session: Session,
    point: &str,
    step: (f64, f64),
) {
    let way = WAY as f64;
    let by = |sign: f64| {
        let (x, y) = (sign * way * step.0, sign * way * step.1);
        format!("drag {point} to {point} + ({x}, {y}) over {WAY}")
    };
    let (there, back) = (by(1.0), by(-1.0));
    execute(&mut session, &there);
    execute(&mut session, &back);
    group.bench_function(id, |b| {
        b.iter_custom(|frames| {
            let n_ways = frames.div_ceil(2 * WAY) * 2;
            let spent: Duration = (0..n_ways)
                .map(|k| timed(&mut session, if k % 2 == 0 { &there } else { &back }))
                .sum();
            spent.mul_f64(frames as f64 / (n_ways * WAY) as f64)
        });
    });
}

fn workloads(c: &mut Criterion) {
    let mut group = c.benchmark_group("frame");
    group.throughput(Throughput::Elements(1));
    for (name, script) in [
        ("w1", script!("w1-four-bar")),
        ("w2", script!("w2-jansen")),
        ("w3", script!("w3-peaucellier")),
        ("w4", script!("w4-crankshaft")),
        ("w7", script!("w7-parallelogram")),
        ("w8", script!("w8-three-cranks")),
    ] {
        turning(&mut group, BenchmarkId::from_parameter(name), set_up(script, None));
    }
    let mut session = set_up(script!("w6-triangle"), None);
    group.bench_function("w6 solve", |b| {
        b.iter_custom(|n| {
            let again = "move A to (0, 0); move B to (2.5, 0.1); move C to (1.2, 0.4)";
            (0..n)
                .map(|_| {
                    execute(&mut session, again);
                    timed(&mut session, "solve")
                })
                .sum()
        });
    });
    group.finish();
}

fn growth(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for n in [10, 100, 1000, 10000] {
        let end = format!("p[{n}]");
        dragging(&mut group, BenchmarkId::new("w5a", n), set_up(CHAIN, Some(n)), &end, (0.1, 0.05));
    }
    for n in [4, 8, 16, 32, 64] {
        let session = set_up(TRUSS, Some(n));
        dragging(&mut group, BenchmarkId::new("w5b", n), session, "p[0][0]", (0.01, 0.005));
    }
    for n in [1, 10, 100, 1000, 10000] {
        turning(&mut group, BenchmarkId::new("w5c", n), set_up(FOUR_BARS, Some(n)));
    }
    group.finish();
}

/// Sweeps of a scene before it is pulled off its solution once more.
const SWEEPS: u64 = 200;

/// Sweeps of the paper's relaxation; the rate is of constraints relaxed.
fn relaxation(c: &mut Criterion) {
    let mut group = c.benchmark_group("relaxation sweep");
    for (name, script, n) in [
        ("chain", CHAIN, 100),
        ("chain", CHAIN, 1000),
        ("chain", CHAIN, 10000),
        ("truss", TRUSS, 16),
        ("truss", TRUSS, 64),
    ] {
        let mut session = set_up(script, Some(n));
        // Off its solution, or there would be nothing to do.
        let off = if name == "chain" {
            "move p[0] to p[0] - (0.1, 0.1)"
        } else {
            "move p[0][0] to p[0][0] - (0.1, 0.1)"
        };
        execute(&mut session, "set method relaxation");
        group.throughput(Throughput::Elements(session.world().n_constraints() as u64));
        group.bench_function(BenchmarkId::new(name, n), |b| {
            b.iter_custom(|sweeps| {
                let n_runs = sweeps.div_ceil(SWEEPS);
                let runs = (0..n_runs).map(|_| {
                    execute(&mut session, off);
                    timed(&mut session, &format!("relax {SWEEPS}"))
                });
                runs.sum::<Duration>().mul_f64(sweeps as f64 / (n_runs * SWEEPS) as f64)
            });
        });
    }
    group.finish();
}

/// What a statement costs; the rate is of statements carried out.
fn statement(c: &mut Criterion) {
    let n = 10_000;
    let mut group = c.benchmark_group("statement");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, body, n_each) in [
        ("let in a loop", "let a = 2 * i", 1),
        ("point in a loop", "point p[i] = (i, 0)", 1),
        ("point and length in a loop", "point p[i] = (i, 0); length p[i-1] p[i] = 1", 2),
    ] {
        group.throughput(Throughput::Elements(n * n_each));
        let text = format!("for i in 1..{n} {{ {body} }}");
        group.bench_function(name, |b| {
            b.iter_custom(|times| {
                (0..times)
                    .map(|_| {
                        let mut session = Session::new();
                        execute(&mut session, "point p[0] = (0, 0)");
                        timed(&mut session, &text)
                    })
                    .sum()
            });
        });
    }
    let points = (1..=n).map(|i| format!("point q[{i}] = ({i}, 0)\n"));
    let bars = (1..=n).map(|i| format!("length q[{}] q[{i}] = 1\n", i - 1));
    let both: String = points.clone().zip(bars).flat_map(|(point, bar)| [point, bar]).collect();
    // Names that have no digits, so that hardly any statement is like one before.
    let letter = |digit: u64| char::from(b'a' + digit as u8);
    let named = |i: u64| [1000, 100, 10, 1].map(|unit| letter(i / unit % 10));
    let words = (1..=n).map(|i| format!("point {} = ({i}, 0)\n", String::from_iter(named(i))));
    for (name, text, n_each) in [
        ("point on a line of its own", points.collect(), 1),
        ("point and length on lines of their own", both, 2),
        ("point of another word on a line of its own", words.collect::<String>(), 1),
    ] {
        group.throughput(Throughput::Elements(n * n_each));
        group.bench_function(name, |b| {
            b.iter_custom(|times| {
                let run = |_| {
                    let mut session = Session::new();
                    execute(&mut session, "point q[0] = (0, 0)");
                    timed(&mut session, &text)
                };
                (0..times).map(run).sum()
            });
        });
    }
    group.finish();
}

/// The functions of `libm`, whose bits are the same on every platform, against those of the
/// standard library, whose are not.
fn functions(c: &mut Criterion) {
    let angles: Vec<f64> = (0..1000).map(|k| 0.0123 * f64::from(k)).collect();
    let mut group = c.benchmark_group("function");
    group.throughput(Throughput::Elements(angles.len() as u64));
    let mut both = |name: &str, ours: fn(f64) -> f64, std: fn(f64) -> f64| {
        for (whose, f) in [("libm", ours), ("std", std)] {
            group.bench_function(BenchmarkId::new(name, whose), |b| {
                b.iter(|| angles.iter().map(|a| f(*a)).sum::<f64>());
            });
        }
    };
    both("sin", libm::sin, f64::sin);
    both(
        "sin and cos",
        |a| {
            let (s, c) = libm::sincos(a);
            s + c
        },
        |a| {
            let (s, c) = a.sin_cos();
            s + c
        },
    );
    both("atan2", |a| libm::atan2(a, 3.0), |a| a.atan2(3.0));
    both("hypot", |a| libm::hypot(a, 3.0), |a| a.hypot(3.0));
    group.finish();
}

fn config() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
}

criterion_group! {
    name = benches;
    config = config();
    targets = workloads, growth, relaxation, statement, functions
}
criterion_main!(benches);
