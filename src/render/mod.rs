//! stub
use crate::world::World;
#[derive(Debug, Clone)]
pub struct Scene;
impl Scene {
    pub fn new(_w: &World) -> Self {
        Self
    }
}
#[derive(Default)]
pub struct Options;
#[derive(Clone)]
pub struct View;
impl View {
    pub fn of<'a>(_s: impl Iterator<Item = &'a Scene>) -> Self {
        Self
    }
}
pub fn svg(_s: &Scene, _o: &Options) -> String {
    String::new()
}
pub fn svg_with_view(_s: &Scene, _v: &View, _o: &Options) -> String {
    String::new()
}
pub struct Animation;
impl Animation {
    pub fn new(_v: View, _o: &Options) -> Self {
        Self
    }
    pub fn push(&mut self, _s: &Scene, _t: f64) {}
    pub fn finish(self) -> String {
        String::new()
    }
}
