//! Pictures in pixels: a document as PNG, several as a GIF that moves.
//!
//! They take the feature `pictures`; a library without it says so when it is asked for one. Names
//! are written in a font that comes along, so a picture has the same bytes on every machine.

#[cfg(feature = "pictures")]
mod drawn;
#[cfg(not(feature = "pictures"))]
mod missing;

#[cfg(feature = "pictures")]
pub use drawn::{Motion, png};
#[cfg(not(feature = "pictures"))]
pub use missing::{Motion, png};

/// Whether pictures in pixels can be made.
pub const IS_BUILT_IN: bool = cfg!(feature = "pictures");

/// What a PNG of this program has near its beginning.
pub const PNG_MARK: &[u8] = b"tEXtSoftware\0linkwork";

/// What a GIF of this program has near its beginning.
pub const GIF_MARK: &[u8] = b"\x21\xfe\x08linkwork\0";

/// The shortest time that browsers show a frame of a GIF, seconds: they slow down what is shorter.
pub const SHORTEST_FRAME: f64 = 0.02;
