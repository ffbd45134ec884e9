//! PNG (third edition): eight bits a channel, three channels; the only file that knows `miniz_oxide`.

use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::render::Pixels;

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

fn push_chunk(bytes: &mut Vec<u8>, name: [u8; 4], content: &[u8]) {
    bytes.extend((content.len() as u32).to_be_bytes());
    let begin = bytes.len();
    bytes.extend(name);
    bytes.extend(content);
    let sum = crc_32(&bytes[begin..]);
    bytes.extend(sum.to_be_bytes());
}

/// The checksum of a chunk (ISO 3309).
fn crc_32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, &byte: &u8| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 }
        })
    };
    !bytes.iter().fold(!0, step)
}

#[cfg(test)]
mod tests {
    use super::crc_32;

    #[test]
    fn checksums_are_those_of_the_standard() {
        assert_eq!(crc_32(b"123456789"), 0xcbf4_3926);
        // Of the chunk that ends every PNG.
        assert_eq!(crc_32(b"IEND"), 0xae42_6082);
    }
}
