//! A world becomes a picture, and frames become one that moves; both are texts in SVG.
//!
//! `cargo run --example pictures > slider.svg`

use linkwork::render::{Animation, Options, Scene, View, svg};
use linkwork::{Diagnostic, Session};

/// Runs the example.
pub fn main() -> Result<(), Diagnostic> {
    let mut session = Session::new();
    session.run(
        "point O = (0, 0) frozen, R = (6, 0) frozen, P = (1, 0), S = (4, 0), M = P + (S - P) / 2
         motor O P radius 1 speed 1rev
         length P S = 3
         glider S on O R unbounded
         hinge M on P S at 1/2
         set dt 1/60
         trace M",
    )?;
    let options = Options { title: Some("a slider-crank".to_owned()), ..Options::default() };
    let mut scenes = vec![(Scene::new(session.world()), session.world().clock().time())];
    for _ in 0..60 {
        session.run("step")?;
        let (last, _) = &scenes[scenes.len() - 1];
        // Shares with the scene before what did not change.
        let scene = last.next(session.world());
        scenes.push((scene, session.world().clock().time()));
    }
    let still = svg(&scenes[scenes.len() - 1].0, &options);

    // The page holds all that is ever in sight.
    let mut film = Animation::new(View::of(scenes.iter().map(|(scene, _)| scene)), &options);
    scenes.iter().for_each(|(scene, time)| film.push(scene, *time));
    let film = film.finish();

    eprintln!("a picture of {} bytes, and one of {} that moves", still.len(), film.len());
    println!("{film}");
    Ok(())
}
