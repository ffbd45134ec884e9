//! A picture as colours in rows.

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
