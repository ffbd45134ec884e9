//! One page that looks on: what it was told, and what it is told next.
//!
//! A page says which frames it has shown. It is told no more than a few ahead, each time of the
//! newest there is, so that one that is slow misses frames and nothing piles up.

use serde_json::{Map, Value, json};

use super::anchor::Places;
use super::drawn;
use super::message::Message;
use super::pieces::Pieces;
use super::pose::Pose;
use crate::render::{Drawing, Followed, Scene};
use crate::session::Session;

/// Frames that a page may be told of before it has shown them: one is on its way while the other is
/// being drawn.
const AHEAD: u64 = 2;

/// A page.
#[derive(Debug, Default)]
pub struct Viewer {
    /// Whether it said that it is there: before, it is told nothing.
    pub is_here: bool,
    /// The text that it sends in pieces.
    pub pieces: Pieces,
    /// px a world unit, where it wants that.
    scale: Option<f64>,
    drawing: Option<Drawing>,
    /// Where it has the figures.
    places: Places,
    topology: u32,
    /// Of how many points it is, by handles.
    n_points: usize,
    seq: u64,
    seen: u64,
    /// The numbers of what it was told last.
    pose: u64,
    state: u64,
    off: String,
    traces: Vec<drawn::Told>,
    /// How many statements of the journal it was told.
    pub n_journal: u64,
}

/// What there is to be told.
pub struct News<'a> {
    pub session: &'a Session,
    pub scene: &'a Scene,
    pub pose: &'a Pose,
    /// Counts poses.
    pub pose_number: u64,
    pub state: &'a Map<String, Value>,
    /// Counts states.
    pub state_number: u64,
}

impl Viewer {
    /// It is told everything again.
    pub fn begin_anew(&mut self) {
        let (scale, topology, seq) = (self.scale, self.topology, self.seq);
        *self = Self { is_here: true, scale, topology, seq, seen: seq, ..Self::default() };
    }

    /// It wants drawings of this scale.
    pub fn set_scale(&mut self, scale: Option<f64>) {
        if self.scale != scale {
            self.scale = scale;
            self.drawing = None;
            self.pose = 0;
        }
    }

    /// It has shown a frame.
    pub const fn has_seen(&mut self, seq: u64) {
        if seq <= self.seq && seq > self.seen {
            self.seen = seq;
        }
    }

    /// px a world unit, as it is shown.
    pub fn scale(&self) -> f64 {
        self.drawing.as_ref().map_or(1.0, Drawing::scale)
    }

    /// Whether it is ready to be told, and there is something to tell.
    pub const fn is_due(&self, pose_number: u64, state_number: u64) -> bool {
        let is_behind = self.pose != pose_number || self.state != state_number;
        self.is_here && is_behind && self.seq < self.seen + AHEAD
    }

    /// Tells what is new.
    pub fn tell(&mut self, news: &News, say: &mut impl FnMut(Message)) {
        if self.state != news.state_number {
            self.state = news.state_number;
            say(Message::Text(json!({ "state": news.state }).to_string()));
        }
        if self.pose == news.pose_number {
            return;
        }
        self.pose = news.pose_number;
        let off = off(news.pose);
        if off != self.off {
            say(Message::Text(off.clone()));
            self.off = off;
        }
        self.draw(news, say);
        if let Some(traces) = drawn::traces(news.session.world(), &mut self.traces) {
            say(Message::Text(traces.to_string()));
        }
        self.seq += 1;
        let drawing = self.drawing.as_ref().expect("it was drawn");
        let moved = self.places.news(drawing, &news.pose.at);
        say(Message::Frame(news.pose.frame(self.seq, self.topology, &moved)));
    }

    /// Follows the mechanism, or draws it anew.
    fn draw(&mut self, news: &News, say: &mut impl FnMut(Message)) {
        // Frames are read by it, so it is of as many points as they tell of, those included that are not
        // drawn: most handles of points that were deleted are not given out again.
        let drawing = self.drawing.as_mut().filter(|_| self.n_points == news.pose.at.len());
        match drawing.map_or(Followed::Another, |drawing| drawing.follow(news.scene)) {
            Followed::Moved(changed) if changed.is_empty() => {}
            Followed::Moved(changed) => {
                let drawing = self.drawing.as_ref().expect("it was followed");
                say(Message::Text(drawn::shapes(drawing, self.topology, &changed).to_string()));
            }
            Followed::Another => {
                let drawing = Drawing::new(news.scene, self.scale);
                self.topology += 1;
                let at = &news.pose.at;
                self.n_points = at.len();
                self.places = Places::new(&drawing, at, news.session.world());
                let anchors = self.places.anchors();
                for text in drawn::drawing(&drawing, news.scene, self.topology, at.len(), anchors) {
                    say(Message::Text(text.to_string()));
                }
                self.drawing = Some(drawing);
            }
        }
    }
}

/// What is off, as a page is told: at most so many.
const MOST_OFF: usize = 100;

fn off(pose: &Pose) -> String {
    let off = pose.off.iter().take(MOST_OFF).map(|it| {
        json!({ "constraint": it.id.0, "name": it.name, "residual": it.residual, "shown": it.miss })
    });
    json!({ "off": off.collect::<Vec<_>>() }).to_string()
}
