//! The graphics protocol of kitty: <https://sw.kovidgoyal.net/kitty/graphics-protocol/>.

use super::png;
use crate::render::{Pixels, base64};

/// Letters in one piece, at most.
const PIECE: usize = 4096;

/// A picture that is shown where the cursor is, so many columns wide.
pub fn picture(pixels: &Pixels, n_columns: usize) -> Vec<u8> {
    let text = base64::encode(&png::encode(pixels));
    let text = text.as_bytes();
    let n_pieces = text.len().div_ceil(PIECE);
    let mut bytes = Vec::with_capacity(text.len() + 16 * n_pieces);
    for (k, piece) in text.chunks(PIECE).enumerate() {
        let more = u8::from(k + 1 < n_pieces);
        // A PNG that is shown at once; nothing is answered.
        let what = if k == 0 { format!("f=100,a=T,q=2,c={n_columns},") } else { String::new() };
        bytes.extend(format!("\x1b_G{what}m={more};").bytes());
        bytes.extend(piece);
        bytes.extend(b"\x1b\\");
    }
    bytes.push(b'\n');
    bytes
}
