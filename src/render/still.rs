//! A picture that stands still, made from one scene.

use super::canvas::{Canvas, Lettering};
use super::document::{self, Group, Options};
use super::legend;
use super::scene::Scene;
use super::unmet;
use super::view::View;

/// A scene as an SVG document, fitted to the page.
pub fn svg(scene: &Scene, options: &Options) -> String {
    svg_with_view(scene, &View::shown([scene], options.width), options)
}

/// A scene as an SVG document, one of several with a view in common.
pub fn svg_with_view(scene: &Scene, view: &View, options: &Options) -> String {
    let mut groups = view.ghosts(scene.ghosts.iter().map(|ghost| &**ghost));
    let none = Lettering::new();
    let lettering = if options.without_names { &none } else { view.lettering() };
    let mut canvas = Canvas::new(view.page(), &scene.pose.at, lettering);
    scene.pose.symbols.iter().for_each(|symbol| symbol.draw(&mut canvas));
    for curve in &scene.curves {
        curve.draw(&mut canvas);
    }
    legend::draw(&mut canvas, &scene.curves);
    let mut figures = canvas.finish();
    unmet::mark(&mut figures, scene);
    figures.extend(unmet::amounts(&figures, scene, view, lettering));
    groups.push(Group::of(figures));
    document::write(view.page(), &groups, options)
}
