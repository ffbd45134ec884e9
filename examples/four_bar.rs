//! A four-bar frame by frame: where its coupler point goes, and how fast.
//!
//! `cargo run --example four_bar`

use linkwork::session::Nowhere;
use linkwork::{Diagnostic, Session, lang};

/// Runs the example.
pub fn main() -> Result<(), Diagnostic> {
    let mut session = Session::new();
    session.run(
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3), E = (2, 3)
         crank: motor A B radius 1 speed 1rev
         coupler: length B C = 3.5
         rocker: length C D = 3
         solve
         rigid B C E
         set dt 1/360",
    )?;
    // What is said often is read once.
    let source = session.add_source("thirty frames", "step 30", None);
    let statements = lang::parse(source, "step 30").collect::<Result<Vec<_>, _>>()?;
    for _ in 0..12 {
        for statement in &statements {
            session.execute(statement, &mut Nowhere)?;
        }
        let e = session.position("E").expect("E is a point");
        let speed = session.evaluate("norm(velocity(E))")?.number();
        println!("E is at ({:8.5}, {:8.5}) and moves at {speed:7.4}", e.x, e.y);
    }
    let run = session.last_run().expect("frames have passed");
    println!("largest residual of the last frames: {:.1e}", run.worst_residual);
    for name in ["crank", "coupler", "rocker"] {
        println!("{name} is missed by {:.1e}", session.residual(name).expect("it is on"));
    }
    Ok(())
}
