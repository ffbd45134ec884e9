//! What files in PNG are made of (third edition, 5.3).

/// Adds a chunk: its length, its name, its content and a checksum of both.
pub fn push_chunk(bytes: &mut Vec<u8>, name: [u8; 4], content: &[u8]) {
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
