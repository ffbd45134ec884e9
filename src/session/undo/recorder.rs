//! Recordings under way: frames for a folder or an animation, rows for a table.

use std::fmt::Write;
use std::path::PathBuf;

use crate::constraint::Point;
use crate::diag::{Span, format_number};
use crate::render::Scene;
use crate::session::file_kind::FileKind;
use crate::world::World;

/// One recording.
#[derive(Debug, Clone)]
pub struct Recorder {
    /// Where it will be written.
    pub path: PathBuf,
    /// The statement's path, for errors.
    pub span: Span,
    /// One shot every so many frames.
    pub every: u64,
    /// What it will become.
    pub format: Format,
    shots: Vec<Shot>,
}

/// What a recording becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A folder of numbered pictures.
    Frames,
    /// One animated picture.
    Movie,
    /// A table of the traced points.
    Table,
}

impl Format {
    /// What each of its files is.
    pub const fn kind(self) -> FileKind {
        match self {
            Self::Frames | Self::Movie => FileKind::Picture,
            Self::Table => FileKind::PathTable,
        }
    }
}

/// What is kept of one frame.
#[derive(Debug, Clone)]
enum Shot {
    Scene(Box<Scene>, f64),
    Row(f64, Vec<(Box<str>, Point)>),
}

/// How much of a recording to keep, and what follows it: the end that an undo takes away.
#[derive(Debug)]
pub struct Reel {
    keep: usize,
    then: Vec<Shot>,
}

impl Shot {
    /// Roughly how many bytes it takes.
    fn n_bytes(&self) -> usize {
        let inside = match self {
            Self::Scene(scene, _) => scene.n_bytes(),
            Self::Row(_, row) => {
                let names: usize = row.iter().map(|(name, _)| name.len()).sum();
                size_of_val(&**row) + names
            }
        };
        size_of::<Self>() + inside
    }
}

impl Reel {
    /// Roughly how many bytes it takes.
    pub fn n_bytes(&self) -> usize {
        size_of::<Self>() + self.then.iter().map(Shot::n_bytes).sum::<usize>()
    }
}

impl Recorder {
    /// A recording that has taken nothing yet.
    pub const fn new(path: PathBuf, span: Span, every: u64, format: Format) -> Self {
        Self { path, span, every, format, shots: Vec::new() }
    }

    /// Another that takes the same and has taken nothing yet.
    pub fn emptied(&self) -> Self {
        Self::new(self.path.clone(), self.span, self.every, self.format)
    }

    /// Its reel as it is.
    pub const fn mark(&self) -> Reel {
        Reel { keep: self.shots.len(), then: Vec::new() }
    }

    /// Whether this is its reel as it is.
    pub const fn is_at(&self, reel: &Reel) -> bool {
        reel.keep == self.shots.len() && reel.then.is_empty()
    }

    /// Winds to the end that `reel` describes; gives the end it had.
    pub fn wind(&mut self, reel: Reel) -> Reel {
        let keep = reel.keep.min(self.shots.len());
        let then = self.shots.split_off(keep);
        self.shots.extend(reel.then);
        Reel { keep, then }
    }

    /// Takes the frame that was just solved, if it is due.
    pub fn take(&mut self, world: &World) {
        let clock = world.clock();
        if !clock.frame.is_multiple_of(self.every) {
            return;
        }
        self.shots.push(match self.format {
            Format::Frames | Format::Movie => {
                // A scene shares with the one before it what did not change.
                let scene = match self.shots.last() {
                    Some(Shot::Scene(last, _)) => last.next(world),
                    _ => Scene::new(world),
                };
                Shot::Scene(Box::new(scene), clock.time())
            }
            Format::Table => {
                let points = world.points();
                let row = world.traces().iter();
                let row = row.map(|t| (points.name(t.point).into(), points.at(t.point)));
                Shot::Row(clock.time(), row.collect())
            }
        });
    }

    /// Roughly how many bytes its frames take.
    pub fn n_bytes(&self) -> usize {
        self.shots.iter().map(Shot::n_bytes).sum()
    }

    /// The scenes taken, each with its time.
    pub fn scenes(&self) -> impl Iterator<Item = (&Scene, f64)> {
        self.shots.iter().filter_map(|shot| match shot {
            Shot::Scene(scene, time) => Some((&**scene, *time)),
            Shot::Row(..) => None,
        })
    }

    /// Whether no row of a table says where a point is.
    pub fn has_times_only(&self) -> bool {
        !self.shots.is_empty()
            && self.shots.iter().all(|shot| matches!(shot, Shot::Row(_, row) if row.is_empty()))
    }

    /// The table: a line of names, then a line a frame. A point that was not traced at a
    /// frame leaves its cells empty.
    pub fn table(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for shot in &self.shots {
            if let Shot::Row(_, row) = shot {
                for (name, _) in row {
                    if !names.contains(&&**name) {
                        names.push(name);
                    }
                }
            }
        }
        let mut text = String::from("time");
        for name in &names {
            // Writing to a string cannot fail.
            let _ = write!(text, ",{name}.x,{name}.y");
        }
        text.push('\n');
        for shot in &self.shots {
            let Shot::Row(time, row) = shot else { continue };
            text.push_str(&format_number(*time));
            for name in &names {
                match row.iter().find(|(n, _)| &**n == *name) {
                    Some((_, p)) => {
                        let _ = write!(text, ",{},{}", format_number(p.x), format_number(p.y));
                    }
                    None => text.push_str(",,"),
                }
            }
            text.push('\n');
        }
        text
    }
}
