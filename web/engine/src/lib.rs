//! A session that a page looks at, as WebAssembly: a thin shell around `linkwork::live`, which imports
//! nothing.
//!
//! The page puts a message into [`room`] and [`tell`]s it, lets time pass with [`tick`], and takes
//! what there is to hear with [`next`], [`out`] and [`length`]. A trap leaves its cause in [`fault`].
//! `docs/protocol.md` has the messages.

use std::cell::RefCell;
use std::collections::VecDeque;

use linkwork::Session;
use linkwork::live::{Live, Message};
use linkwork::session::{Answer, EXAMPLES, Example};

/// Who is on the other side.
const PAGE: u32 = 0;

/// The session and what it has to say.
struct Engine {
    session: Session,
    live: Live,
    /// Files that may be read: those that statements wrote, and the examples, of which some include
    /// others.
    files: Answer,
    outbox: VecDeque<Message>,
}

thread_local! {
    static ENGINE: RefCell<Option<Engine>> = const { RefCell::new(None) };
    /// What the page puts in.
    static ROOM: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    /// What it takes out.
    static OUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

impl Engine {
    fn new() -> Self {
        let mut live = Live::new("wasm");
        live.join(PAGE);
        let example = |it: &Example| (format!("{}.link", it.name).into(), it.text.into());
        let files = Answer { files: EXAMPLES.iter().map(example).collect(), ..Answer::default() };
        Self { session: Session::new(), live, files, outbox: VecDeque::new() }
    }

    fn work(&mut self, now: f64) {
        self.live.work(now, &mut self.session, &mut self.files);
        self.gather();
    }

    fn gather(&mut self) {
        // Kept are files: what is said goes to the page.
        self.files.lines.clear();
        self.files.told.clear();
        let told = self.live.take(&mut self.session);
        self.outbox.extend(told.into_iter().map(|(_, message)| message));
    }
}

fn with<T>(work: impl FnOnce(&mut Engine) -> T) -> T {
    ENGINE.with_borrow_mut(|engine| work(engine.get_or_insert_with(Engine::new)))
}

/// Begins a session, once.
#[unsafe(no_mangle)]
pub extern "C" fn begin() {
    std::panic::set_hook(Box::new(|panic| {
        let cause = panic.to_string().into_bytes();
        drop(OUT.try_with(|out| out.try_borrow_mut().map(|mut out| *out = cause)));
    }));
    with(|_| ());
}

/// A place in memory for a message of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    ROOM.with_borrow_mut(|room| {
        room.clear();
        room.resize(length, 0);
        room.as_mut_ptr()
    })
}

/// Takes the message of so many bytes that lies in [`room`]. What is held is led at once, unless time
/// passes.
#[unsafe(no_mangle)]
pub extern "C" fn tell(length: usize) {
    let message = ROOM.with_borrow(|room| {
        String::from_utf8_lossy(&room[..length.min(room.len())]).into_owned()
    });
    with(|engine| {
        let Engine { session, live, files, .. } = engine;
        live.receive(PAGE, &message, session, files);
        live.lead(session, files);
        engine.gather();
    });
}

/// Lets time pass, if it does; `now` is what a clock shows, ms.
#[unsafe(no_mangle)]
pub extern "C" fn tick(now: f64) {
    with(|engine| engine.work(now / 1000.0));
}

/// Whether [`tick`] has something to do.
#[unsafe(no_mangle)]
pub extern "C" fn busy() -> i32 {
    with(|engine| i32::from(engine.live.is_busy()))
}

/// The next that the page is to hear: 0 nothing, 1 a text, 2 a frame. It lies at [`out`].
#[unsafe(no_mangle)]
pub extern "C" fn next() -> i32 {
    let (kind, bytes) = match with(|engine| engine.outbox.pop_front()) {
        None => (0, Vec::new()),
        Some(Message::Text(text)) => (1, text.into_bytes()),
        Some(Message::Frame(frame)) => (2, frame),
    };
    OUT.with_borrow_mut(|out| *out = bytes);
    kind
}

/// Where what [`next`] found begins.
#[unsafe(no_mangle)]
pub extern "C" fn out() -> *const u8 {
    OUT.with_borrow(|out| out.as_ptr())
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    OUT.with_borrow(Vec::len)
}

/// Where the cause of a trap lies.
#[unsafe(no_mangle)]
pub extern "C" fn fault() -> *const u8 {
    out()
}
