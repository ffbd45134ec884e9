//! Draws documents in pixels; the only file that knows `resvg` and `gif`.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::Duration;

use gif::{AnyExtension, DisposalMethod, Encoder, Frame, Repeat};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

use crate::interrupt;
use crate::render::push_chunk;

/// How much the colours of a frame are thinned out while they are chosen, from 1 to 30: 10 is what
/// the crate advises.
const COLOUR_SPEED: i32 = 10;

/// The fonts of pictures.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for font in [
        &include_bytes!("../../../fonts/Arimo-Regular.ttf")[..],
        include_bytes!("../../../fonts/Arimo-Italic.ttf"),
    ] {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("Arimo");
    Arc::new(fonts)
});

/// Whether something is being drawn, wanted still or not.
static IS_BUSY: AtomicBool = AtomicBool::new(false);

/// Holds the place of what is being drawn.
struct Place;

impl Drop for Place {
    fn drop(&mut self) {
        IS_BUSY.store(false, Ordering::Release);
    }
}

/// How long is waited until it is asked whether a picture is still wanted.
const LOOK: Duration = Duration::from_millis(10);

/// Draws on a thread of its own: `resvg` asks nobody while it draws, so that who does not want the picture
/// any more leaves it behind. What is left behind is drawn to its end, and the next waits for that: no
/// more than one is ever in memory.
fn apart<T: Send + 'static>(
    draw: impl FnOnce() -> io::Result<T> + Send + 'static,
    is_left: &dyn Fn() -> bool,
) -> io::Result<T> {
    while IS_BUSY.swap(true, Ordering::Acquire) {
        if is_left() {
            return Err(io::ErrorKind::Interrupted.into());
        }
        thread::sleep(LOOK);
    }
    let place = Place;
    let (to, picture) = sync_channel(1);
    thread::Builder::new().spawn(move || {
        let result = draw();
        drop(place);
        drop(to.send(result));
    })?;
    loop {
        match picture.recv_timeout(LOOK) {
            Ok(result) => return result,
            Err(RecvTimeoutError::Timeout) if is_left() => {
                return Err(io::ErrorKind::Interrupted.into());
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(io::Error::other("it cannot be drawn"));
            }
        }
    }
}

fn drawn(svg: &str, scale: f32) -> io::Result<Pixmap> {
    let options = Options { fontdb: FONTS.clone(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(io::Error::other)?;
    let side = |px: f32| ((px * scale).round() as u32).max(1);
    let (width, height) = (side(tree.size().width()), side(tree.size().height()));
    let mut pixels =
        Pixmap::new(width, height).ok_or_else(|| io::Error::other("too large for a picture"))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    Ok(pixels)
}

/// A document as PNG, `scale` pixels for each of its px; it carries `notes` along.
///
/// # Errors
/// Where the document cannot be drawn.
pub fn png(svg: String, scale: f32, notes: &[(String, String)]) -> io::Result<Vec<u8>> {
    let draw = move || drawn(&svg, scale)?.encode_png().map_err(io::Error::other);
    let is_left = || {
        // Whoever wants to stop is unwound to.
        interrupt::tick(usize::MAX);
        false
    };
    let bytes = apart(draw, &is_left)?;
    // Behind the signature and the header, which are always as long.
    let (head, rest) = bytes.split_at(33);
    let mut all = head.to_vec();
    push_text(&mut all, "Software", "linkwork");
    for (key, value) in notes {
        push_text(&mut all, key, value);
    }
    all.extend_from_slice(rest);
    Ok(all)
}

/// Adds a chunk of text as the PNG specification has it (third edition, 11.3.3.2).
fn push_text(bytes: &mut Vec<u8>, key: &str, value: &str) {
    let is_plain = |text: &str| text.bytes().all(|byte| (0x20..0x7f).contains(&byte));
    if !is_plain(key) || !is_plain(value) || key.len() > 79 {
        return;
    }
    push_chunk(bytes, *b"tEXt", &[key.as_bytes(), b"\0", value.as_bytes()].concat());
}

/// A GIF that grows frame by frame and plays without an end.
pub struct Motion<'a> {
    out: Option<&'a mut dyn Write>,
    encoder: Option<Encoder<&'a mut dyn Write>>,
    is_transparent: bool,
    last: Option<Pixmap>,
}

impl<'a> Motion<'a> {
    /// An empty one.
    pub fn new(out: &'a mut dyn Write, is_transparent: bool) -> Self {
        Self { out: Some(out), encoder: None, is_transparent, last: None }
    }

    /// Adds a document, shown for so many seconds.
    ///
    /// # Errors
    /// Where it cannot be drawn or written; [`Interrupted`](io::ErrorKind::Interrupted) where it is not
    /// wanted any more.
    pub fn add(&mut self, svg: String, seconds: f64, is_left: &dyn Fn() -> bool) -> io::Result<()> {
        let pixels = apart(move || drawn(&svg, 1.0), is_left)?;
        let (width, height) = (side(pixels.width())?, side(pixels.height())?);
        if let Some(out) = self.out.take() {
            let mut encoder = Encoder::new(out, width, height, &[]).map_err(io::Error::other)?;
            let mark = AnyExtension(0xfe);
            encoder.write_raw_extension(mark, &[b"linkwork"]).map_err(io::Error::other)?;
            encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
            self.encoder = Some(encoder);
        }
        let Some(encoder) = &mut self.encoder else { return Ok(()) };
        let part = match &self.last {
            // What shows through would show the frame before.
            Some(last) if !self.is_transparent => changed(last, &pixels),
            _ => Part { left: 0, top: 0, width: pixels.width(), height: pixels.height() },
        };
        let mut colours = part.colours(&pixels);
        let (width, height) = (side(part.width)?, side(part.height)?);
        let mut frame = Frame::from_rgba_speed(width, height, &mut colours, COLOUR_SPEED);
        (frame.left, frame.top) = (side(part.left)?, side(part.top)?);
        frame.delay = (seconds * 100.0).round() as u16;
        frame.dispose =
            if self.is_transparent { DisposalMethod::Background } else { DisposalMethod::Keep };
        encoder.write_frame(&frame).map_err(io::Error::other)?;
        self.last = Some(pixels);
        Ok(())
    }
}

fn side(px: u32) -> io::Result<u16> {
    u16::try_from(px).map_err(|_| io::Error::other("too large for a GIF"))
}

/// A rectangle of a picture.
struct Part {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

impl Part {
    /// Its colours, red, green, blue and how opaque, not multiplied.
    fn colours(&self, pixels: &Pixmap) -> Vec<u8> {
        let rows = self.top..self.top + self.height;
        let places = rows.flat_map(|y| (self.left..self.left + self.width).map(move |x| (x, y)));
        places
            .flat_map(|(x, y)| {
                let colour = pixels.pixel(x, y).expect("within the picture").demultiply();
                [colour.red(), colour.green(), colour.blue(), colour.alpha()]
            })
            .collect()
    }
}

/// The least rectangle that holds all that changed; of pictures that are the same, one pixel.
fn changed(last: &Pixmap, next: &Pixmap) -> Part {
    let width = next.width() as usize;
    let differs = |k: &usize| last.pixels()[*k] != next.pixels()[*k];
    let changed = (0..next.pixels().len()).filter(differs);
    let bounds = changed.fold(None, |bounds: Option<[u32; 4]>, k| {
        let (x, y) = ((k % width) as u32, (k / width) as u32);
        let [left, top, right, bottom] = bounds.unwrap_or([x, y, x, y]);
        Some([left.min(x), top.min(y), right.max(x), bottom.max(y)])
    });
    let [left, top, right, bottom] = bounds.unwrap_or_default();
    Part { left, top, width: right - left + 1, height: bottom - top + 1 }
}
