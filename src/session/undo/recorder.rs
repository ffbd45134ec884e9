//! Recordings under way: frames for a folder or an animation, rows for a table.
//!
//! Where points are in a frame goes to a tape, on disk where the host has one; what frames share, and
//! where on the tape each is, stays in memory. An undo makes a recording shorter and leaves the tape as
//! it is, so that a redo finds all of it there; what a command took that failed is cut off.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;

use crate::constraint::Point;
use crate::diag::{Span, format_number};
use crate::interrupt::tick;
use crate::render::raster::{Motion, SHORTEST_FRAME};
use crate::render::{Animation, Options, Scene, View, is_shown, shown_for, svg_with_view};
use crate::session::csv;
use crate::session::file_kind::FileKind;
use crate::session::spool::Tape;
use crate::world::{Formula, PointId, World};

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
    /// How its pictures look.
    pub look: Options,
    tape: Tape,
    /// Shared with what is written of it.
    shots: Arc<Vec<Shot>>,
    /// The points of a table with their names, in the order in which they came.
    names: Vec<(PointId, Box<str>)>,
    /// What a table has columns of, if not the traced points.
    pub columns: Arc<[TableColumn]>,
}

/// A column of a table, two of a vector.
#[derive(Debug)]
pub struct TableColumn {
    /// The words over it; over each of two.
    pub headings: Vec<String>,
    /// Its values.
    pub formula: Formula,
    /// What they are divided by.
    pub scale: f64,
}

/// What a recording becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A folder of numbered pictures.
    Frames,
    /// One animated picture.
    Movie,
    /// One animated picture in pixels.
    Gif,
    /// A table of the traced points.
    Table,
}

impl Format {
    /// What each of its files is.
    pub const fn kind(self) -> FileKind {
        match self {
            Self::Frames | Self::Movie => FileKind::Picture,
            Self::Gif => FileKind::Gif,
            Self::Table => FileKind::PathTable,
        }
    }
}

/// One frame, the numbers of which are on the tape.
#[derive(Debug, Clone)]
struct Shot {
    time: f64,
    /// Where on the tape its numbers begin: x and y of each point of a scene; of each point of a row
    /// the number of its name, x and y.
    at: u64,
    n_points: u32,
    /// What is drawn, without its places; none of a row.
    scene: Option<Box<Scene>>,
}

/// How much of a recording to keep, and what follows it: the end that an undo takes away.
#[derive(Debug)]
pub struct Reel {
    keep: usize,
    then: Vec<Shot>,
    /// Bytes that were on the tape when it was marked.
    n_taped: u64,
}

/// What a shot takes in memory, roughly.
const SHOT_BYTES: usize = size_of::<Shot>() + size_of::<Scene>();

impl Reel {
    /// Roughly how many bytes it takes in memory.
    pub const fn n_bytes(&self) -> usize {
        size_of::<Self>() + self.then.len() * SHOT_BYTES
    }
}

/// What a look at a shot takes, in ticks.
const SHOT: usize = 20;

/// Rows of a table between two looks at whether it is still wanted.
const ROWS_AT_ONCE: usize = 1024;

impl Recorder {
    /// A recording that has taken nothing yet.
    pub fn new(
        path: PathBuf,
        span: Span,
        every: u64,
        format: Format,
        look: Options,
        tape: Tape,
    ) -> Self {
        let columns = Arc::new([]);
        Self {
            path,
            span,
            every,
            format,
            look,
            tape,
            shots: Arc::default(),
            names: Vec::new(),
            columns,
        }
    }

    /// Another in memory that takes the same and has taken nothing yet.
    pub fn emptied(&self) -> Self {
        let tape = Tape::new(Box::new(Vec::new()));
        let (look, columns) = (self.look.clone(), self.columns.clone());
        let emptied = Self::new(self.path.clone(), self.span, self.every, self.format, look, tape);
        Self { columns, ..emptied }
    }

    /// Its reel as it is.
    pub fn mark(&self) -> Reel {
        Reel { keep: self.shots.len(), then: Vec::new(), n_taped: self.tape.n_bytes() }
    }

    /// Whether this is its reel as it is.
    pub fn is_at(&self, reel: &Reel) -> bool {
        reel.keep == self.shots.len() && reel.then.is_empty()
    }

    /// Winds to the end that `reel` describes; gives the end it had.
    pub fn wind(&mut self, reel: Reel) -> Reel {
        let keep = reel.keep.min(self.shots.len());
        let shots = Arc::make_mut(&mut self.shots);
        let then = shots.split_off(keep);
        shots.extend(reel.then);
        Reel { keep, then, n_taped: reel.n_taped }
    }

    /// Cuts off what was taken since its reel was this one: nobody is to have it again.
    pub fn cut(&self, reel: &Reel) {
        self.tape.cut(reel.n_taped);
    }

    /// Whether a frame is due.
    pub fn is_due(&self, frame: u64) -> bool {
        frame.is_multiple_of(self.every)
    }

    /// Takes a row of a table with columns of its own; what has no value now is no number.
    ///
    /// # Errors
    /// Where the tape takes no more.
    pub fn take_row(&mut self, time: f64, row: &[f64]) -> io::Result<()> {
        let at = self.tape.put(row)?;
        Arc::make_mut(&mut self.shots).push(Shot {
            time,
            at,
            n_points: row.len() as u32,
            scene: None,
        });
        Ok(())
    }

    /// Takes the frame that was just solved, if it is due.
    ///
    /// # Errors
    /// Where the tape takes no more.
    pub fn take(&mut self, world: &World) -> io::Result<()> {
        let clock = world.clock();
        if !self.is_due(clock.frame) || !self.columns.is_empty() {
            return Ok(());
        }
        let (numbers, n_points, scene) = match self.format {
            Format::Frames | Format::Movie | Format::Gif => {
                // A scene shares with the one before it what did not change.
                let last = self.shots.last().and_then(|shot| shot.scene.as_ref());
                let scene = last.map_or_else(|| Scene::new(world), |last| last.next(world));
                let (scene, at) = scene.without_places();
                let numbers: Vec<f64> = at.iter().flat_map(|place| [place.x, place.y]).collect();
                (numbers, at.len(), Some(Box::new(scene)))
            }
            Format::Table => {
                let traces = world.traces();
                let mut numbers = Vec::with_capacity(3 * traces.len());
                let traces: Vec<_> = traces.iter().filter(|trace| !trace.is_ended).collect();
                for (k, trace) in traces.iter().enumerate() {
                    let at = world.points().at(trace.point);
                    let column = self.column(trace.point, world, k);
                    numbers.extend([column as f64, at.x, at.y]);
                }
                (numbers, traces.len(), None)
            }
        };
        let at = self.tape.put(&numbers)?;
        Arc::make_mut(&mut self.shots).push(Shot {
            time: clock.time(),
            at,
            n_points: n_points as u32,
            scene,
        });
        Ok(())
    }

    /// The number of a point's column, most often `likely`. One that was made again after it was deleted
    /// goes on in the column of its name.
    fn column(&mut self, point: PointId, world: &World, likely: usize) -> usize {
        if self.names.get(likely).is_some_and(|(known, _)| *known == point) {
            return likely;
        }
        let points = world.points();
        let name = points.name(point);
        let is_its = |(known, called): &(PointId, Box<str>)| {
            *known == point || !points.is_alive(*known) && **called == *name
        };
        let column = self.names.iter().position(is_its).unwrap_or(self.names.len());
        match self.names.get_mut(column) {
            Some((known, _)) => *known = point,
            None => self.names.push((point, name.into())),
        }
        column
    }

    /// Calls the columns of points as these are called now.
    pub fn name_columns(&mut self, world: &World) {
        for (point, name) in &mut self.names {
            if world.points().is_alive(*point) && **name != *world.points().name(*point) {
                *name = world.points().name(*point).into();
            }
        }
    }

    /// What each of its files is.
    pub fn kind(&self) -> FileKind {
        if self.columns.is_empty() { self.format.kind() } else { kind_of(&self.columns) }
    }

    /// How many frames it has taken.
    pub fn n_frames(&self) -> usize {
        self.shots.len()
    }

    /// Bytes on its tape, those of frames that were taken back included.
    pub fn n_taped(&self) -> u64 {
        self.tape.n_bytes()
    }

    /// Roughly how many bytes its frames take in memory.
    pub fn n_bytes(&self) -> usize {
        self.shots.len() * SHOT_BYTES
    }

    /// The scene of a frame.
    ///
    /// # Errors
    /// Where the tape cannot be read.
    pub fn scene(&self, frame: usize) -> io::Result<Scene> {
        let Shot { at, n_points, scene, .. } = &self.shots[frame];
        let scene = scene.as_ref().expect("a picture is recorded as scenes");
        let numbers = self.tape.get(*at, 2 * *n_points as usize)?;
        let (places, _) = numbers.as_chunks();
        Ok(scene.with_places(places.iter().map(|&[x, y]| Point::new(x, y)).collect()))
    }

    /// The view that shows all of its scenes, so wide, px.
    ///
    /// # Errors
    /// Where the tape cannot be read.
    pub fn view(&self, width: Option<u32>) -> io::Result<View> {
        View::through(self.shots.len(), width, |frame| self.scene(frame))
    }

    /// All of its scenes as one picture that moves.
    ///
    /// # Errors
    /// Where the tape cannot be read.
    pub fn movie(&self, options: &Options) -> io::Result<String> {
        let scenes = self.shots.iter().filter_map(|shot| shot.scene.as_ref());
        let n_symbols = scenes.map(|scene| scene.n_symbols()).max().unwrap_or(0);
        let mut movie = Animation::new(self.view(options.width)?, options);
        for (frame, shot) in self.shots.iter().enumerate() {
            tick(SHOT);
            if is_shown(frame, self.shots.len(), n_symbols) {
                movie.push(&self.scene(frame)?, shot.time);
            }
        }
        Ok(movie.finish())
    }

    /// Writes all of its scenes as a GIF; gives whether it came to its end, which it does not where
    /// `is_stopped` says so on the way.
    ///
    /// # Errors
    /// Where it cannot be drawn or written, or the tape cannot be read.
    pub fn write_gif(
        &self,
        out: &mut dyn Write,
        options: &Options,
        is_stopped: impl Fn() -> bool,
    ) -> io::Result<bool> {
        let view = self.view(options.width)?;
        let n = self.shots.len();
        let span = match &self.shots[..] {
            [first, .., last] => last.time - first.time,
            _ => 0.0,
        };
        let duration = shown_for(span);
        // Frames that are too short to be shown are left out evenly.
        let stride = ((n as f64 * SHORTEST_FRAME / duration).ceil() as usize).max(1);
        let seconds = duration / n.div_ceil(stride).max(1) as f64;
        let mut motion = Motion::new(out, options.is_transparent);
        for frame in (0..n).step_by(stride) {
            if is_stopped() {
                return Ok(false);
            }
            let picture = svg_with_view(&self.scene(frame)?, &view, options);
            match motion.add(picture, seconds, &is_stopped) {
                Err(e) if e.kind() == io::ErrorKind::Interrupted => return Ok(false),
                added => added?,
            }
        }
        Ok(true)
    }

    /// Whether no row of a table says where a point is.
    pub fn has_times_only(&self) -> bool {
        self.columns.is_empty()
            && !self.shots.is_empty()
            && self.shots.iter().all(|shot| shot.n_points == 0)
    }

    fn write_columns(&self, out: &mut dyn Write, is_stopped: impl Fn() -> bool) -> io::Result<()> {
        writeln!(out, "{}", heading(&self.columns))?;
        let cell = |n: f64| if n.is_nan() { String::new() } else { format_number(n) };
        for (k, shot) in self.shots.iter().enumerate() {
            if k % ROWS_AT_ONCE == 0 && is_stopped() {
                return Err(io::ErrorKind::Interrupted.into());
            }
            let row = self.tape.get(shot.at, shot.n_points as usize)?;
            let cells: Vec<String> = row.into_iter().map(cell).collect();
            writeln!(out, "{}", cells.join(","))?;
        }
        Ok(())
    }

    /// The numbers of a row: of each point the number of its name, x and y.
    fn row(&self, shot: &Shot) -> io::Result<Vec<f64>> {
        self.tape.get(shot.at, 3 * shot.n_points as usize)
    }

    /// Writes the table: a line of names, then a line a frame. A point that was not traced at a
    /// frame leaves its cells empty.
    ///
    /// # Errors
    /// Where it cannot be written, or the tape cannot be read.
    pub fn write_table(
        &self,
        out: &mut dyn Write,
        is_stopped: impl Fn() -> bool,
    ) -> io::Result<()> {
        if !self.columns.is_empty() {
            return self.write_columns(out, is_stopped);
        }
        // What was taken back may have left names.
        let mut columns: Vec<usize> = Vec::new();
        for shot in self.shots.iter().filter(|shot| shot.n_points > 0) {
            if columns.len() == self.names.len() {
                break;
            }
            for cell in self.row(shot)?.as_chunks::<3>().0 {
                let column = cell[0] as usize;
                if !columns.contains(&column) {
                    columns.push(column);
                }
            }
        }
        let mut line = String::from("time");
        for &column in &columns {
            let (_, name) = &self.names[column];
            line.extend([",", name, ".x,", name, ".y"]);
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
        for (k, shot) in self.shots.iter().enumerate() {
            if k % ROWS_AT_ONCE == 0 && is_stopped() {
                return Err(io::ErrorKind::Interrupted.into());
            }
            line.clear();
            line.push_str(&format_number(shot.time));
            let row = self.row(shot)?;
            let (cells, _) = row.as_chunks::<3>();
            for (k, &column) in columns.iter().enumerate() {
                let is_there = |cell: &&[f64; 3]| cell[0] as usize == column;
                // Most often the points of a row are those of all rows.
                let likely = cells.get(k).filter(is_there);
                match likely.or_else(|| cells.iter().find(is_there)) {
                    Some([_, x, y]) => {
                        line.extend([",", &format_number(*x), ",", &format_number(*y)]);
                    }
                    None => line.push_str(",,"),
                }
            }
            line.push('\n');
            out.write_all(line.as_bytes())?;
        }
        Ok(())
    }
}

/// The words over some columns.
fn heading(columns: &[TableColumn]) -> String {
    let words = columns.iter().flat_map(|column| &column.headings);
    words.map(|words| csv::cell(words)).collect::<Vec<_>>().join(",")
}

/// What a table with these columns is.
pub fn kind_of(columns: &[TableColumn]) -> FileKind {
    FileKind::of_columns(&heading(columns))
}
