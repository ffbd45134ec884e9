//! Sixels: pictures in columns of six pixels (DEC, VT330/VT340 Programmer Reference Manual, chapter 14).

use std::collections::BTreeMap;
use std::io::Write;

use crate::render::Pixels;

/// Colours that every terminal with sixels has.
const MOST_COLOURS: usize = 256;

/// Rows that lie in one sixel.
const BAND: usize = 6;

/// A picture that is shown where the cursor is.
pub fn picture(pixels: &Pixels) -> Vec<u8> {
    let [width, height] = pixels.size();
    let (palette, numbers) = reduced(pixels);
    // Writing to memory cannot fail.
    let mut bytes = b"\x1bP0;1q".to_vec();
    let _ = write!(bytes, "\"1;1;{width};{height}");
    for (k, rgb) in palette.iter().enumerate() {
        let [r, g, b] = rgb.map(|byte| (u32::from(byte) * 100 + 127) / 255);
        let _ = write!(bytes, "#{k};2;{r};{g};{b}");
    }
    for band in numbers.chunks(BAND * width) {
        let mut columns: BTreeMap<u8, Vec<u8>> = BTreeMap::new();
        for (at, &number) in band.iter().enumerate() {
            columns.entry(number).or_insert_with(|| vec![0; width])[at % width] |=
                1 << (at / width);
        }
        for (k, (number, sixels)) in columns.iter().enumerate() {
            if k > 0 {
                // Back to the left, over the same rows.
                bytes.push(b'$');
            }
            let _ = write!(bytes, "#{number}");
            push_runs(&mut bytes, sixels);
        }
        bytes.push(b'-');
    }
    bytes.extend(b"\x1b\\\n");
    bytes
}

/// Adds sixels, equal ones by their number; what is left empty on the right is left out.
fn push_runs(bytes: &mut Vec<u8>, sixels: &[u8]) {
    let end = sixels.iter().rposition(|sixel| *sixel != 0).map_or(0, |last| last + 1);
    for run in sixels[..end].chunk_by(|a, b| a == b) {
        let letter = b'?' + run[0];
        if run.len() > 3 {
            let _ = write!(bytes, "!{}", run.len());
            bytes.push(letter);
        } else {
            bytes.extend(std::iter::repeat_n(letter, run.len()));
        }
    }
}

/// The colours that are there most, and for each pixel the number of the nearest of them.
fn reduced(pixels: &Pixels) -> (Vec<[u8; 3]>, Vec<u8>) {
    let all = || pixels.rgb().chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]);
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    all().for_each(|rgb| *counts.entry(rgb).or_default() += 1);
    let mut by_count: Vec<([u8; 3], usize)> = counts.iter().map(|(rgb, n)| (*rgb, *n)).collect();
    by_count.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
    let palette: Vec<[u8; 3]> = by_count.iter().map(|(rgb, _)| *rgb).take(MOST_COLOURS).collect();
    let distance = |a: [u8; 3], b: [u8; 3]| -> u32 {
        a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let nearest = |rgb| {
        let places = palette.iter().enumerate();
        places.min_by_key(|(_, it)| distance(**it, rgb)).map_or(0, |(k, _)| k as u8)
    };
    let numbers: BTreeMap<[u8; 3], u8> = counts.keys().map(|rgb| (*rgb, nearest(*rgb))).collect();
    (palette, all().map(|rgb| numbers[&rgb]).collect())
}
