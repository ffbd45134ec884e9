//! A picture as colours in rows.

use std::ops::Range;

/// Bytes that are compared at once.
const PIECE: usize = 96;

/// A picture, three bytes a pixel, red, green and blue, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixels {
    width: usize,
    rgb: Vec<u8>,
}

/// A colour and how much of what lies below it hides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    pub rgb: [u8; 3],
    pub opacity: f32,
}

impl Pixels {
    /// Paper.
    pub(super) fn white(width: usize, height: usize) -> Self {
        Self { width, rgb: vec![255; 3 * width * height] }
    }

    /// Lets some rows of another picture of this size show through where it differs: this hides so much of
    /// them.
    pub(super) fn lie_over(&mut self, below: &Self, opacity: f32, rows: Range<usize>) {
        let bytes = 3 * rows.start.min(rows.end) * self.width..3 * rows.end * self.width;
        let below = below.rgb[bytes.clone()].chunks(PIECE);
        for (over, below) in self.rgb[bytes].chunks_mut(PIECE).zip(below) {
            // Most of a picture is not touched by what lies over it.
            if over == below {
                continue;
            }
            for (byte, below) in over.iter_mut().zip(below) {
                let (over, below) = (f32::from(*byte), f32::from(*below));
                *byte = (below + (over - below) * opacity).round() as u8;
            }
        }
    }

    /// The bytes of a row.
    pub(super) fn row_mut(&mut self, row: usize) -> &mut [u8] {
        &mut self.rgb[3 * row * self.width..][..3 * self.width]
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.rgb.len() / 3 / self.width]
    }

    /// Its bytes, three a pixel.
    pub fn rgb(&self) -> &[u8] {
        &self.rgb
    }
}
