//! What stands for pictures in pixels where the program is built without them.

use std::io::{self, Write};

fn missing() -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, "this program is built without pictures in pixels")
}

/// A document as PNG, `scale` pixels for each of its px.
///
/// # Errors
/// Always.
pub fn png(_svg: String, _scale: f32, _notes: &[(String, String)]) -> io::Result<Vec<u8>> {
    Err(missing())
}

/// A GIF that grows frame by frame.
pub struct Motion;

impl Motion {
    /// An empty one.
    pub const fn new(_out: &mut dyn Write, _is_transparent: bool) -> Self {
        Self
    }

    /// Adds a document, shown for so many seconds.
    ///
    /// # Errors
    /// Always.
    pub fn add(
        &mut self,
        _svg: String,
        _seconds: f64,
        _is_left: &dyn Fn() -> bool,
    ) -> io::Result<()> {
        Err(missing())
    }
}
