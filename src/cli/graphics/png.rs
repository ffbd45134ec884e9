//! PNG (third edition): eight bits a channel, three channels; the only file that knows `miniz_oxide`.

use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::render::{Pixels, push_chunk};

/// How hard it tries to be small, of 10: the steps above this one gain little on drawings.
const EFFORT: u8 = 6;

/// The bytes of a file.
pub fn encode(pixels: &Pixels) -> Vec<u8> {
    let [width, height] = pixels.size();
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = Vec::new();
    header.extend((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    // Eight bits, red green blue, the one compression, the one set of filters, not interlaced.
    header.extend([8, 2, 0, 0, 0]);
    push_chunk(&mut bytes, *b"IHDR", &header);
    let mut rows = Vec::with_capacity(pixels.rgb().len() + height);
    for row in pixels.rgb().chunks(3 * width) {
        // As it is: the areas of drawings have one colour.
        rows.push(0);
        rows.extend(row);
    }
    push_chunk(&mut bytes, *b"IDAT", &compress_to_vec_zlib(&rows, EFFORT));
    push_chunk(&mut bytes, *b"IEND", &[]);
    bytes
}
