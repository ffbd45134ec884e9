//! The inline images of iTerm2: <https://iterm2.com/documentation-images.html>.

use super::png;
use crate::render::{Pixels, base64};

/// A picture that is shown where the cursor is, so many columns wide.
pub fn picture(pixels: &Pixels, n_columns: usize) -> Vec<u8> {
    let png = png::encode(pixels);
    let head = format!("\x1b]1337;File=inline=1;size={};width={n_columns};height=auto:", png.len());
    [head.as_bytes(), base64::encode(&png).as_bytes(), b"\x07\n"].concat()
}
