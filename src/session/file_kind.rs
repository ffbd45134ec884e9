//! Kinds of files that statements write: their endings, and what shows that a file is one of them.

use super::fnv::fnv_1a;
use crate::render::FIRST_WORDS as PICTURE_MARK;
use crate::render::raster::{GIF_MARK, PNG_MARK};

/// How a file that `save` wrote begins.
pub const SCRIPT_MARK: &str = "# A linkwork session.";

/// How a DXF begins that `export` wrote: with a comment.
pub const DXF_MARK: &str = "999\nlinkwork\n";

/// What each ending says that a statement writes.
pub const ENDINGS: [(&str, &str); 6] = [
    (".svg", "svg"),
    (".png", "svg"),
    (".gif", "record"),
    (".csv", "record"),
    (".dxf", "export"),
    (".link", "save"),
];

/// A kind of file, told by its ending. A file that is there already is replaced only by one of the
/// same kind that this program wrote: its first bytes show that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A script that brings a world back.
    Script,
    /// A drawing or a chart, still or moving, or outlines for a machine.
    Picture,
    /// A drawing or a chart in pixels.
    Pixels,
    /// A moving picture in pixels.
    Gif,
    /// Outlines for a machine.
    Dxf,
    /// A table of the times and the places of traced points.
    PathTable,
    /// A table with these words over its columns.
    Table(&'static str),
    /// A table with words over its columns that have this hash.
    Columns(u64),
}

impl FileKind {
    /// A table with these words over its columns.
    pub fn of_columns(heading: &str) -> Self {
        Self::Columns(fnv_1a(heading.as_bytes()))
    }

    /// The ending that says so; none where a file may have any.
    pub const fn ending(self) -> Option<&'static str> {
        match self {
            Self::Script => None,
            Self::Picture => Some(".svg"),
            Self::Pixels => Some(".png"),
            Self::Gif => Some(".gif"),
            Self::Dxf => Some(".dxf"),
            Self::PathTable | Self::Table(_) | Self::Columns(_) => Some(".csv"),
        }
    }

    /// Whether a file that begins like this is one of the kind that this program wrote. Of an empty
    /// file nothing is lost.
    pub fn wrote(self, opening: &[u8]) -> bool {
        let (line, is_whole) = first_line(opening);
        opening.is_empty()
            || match self {
                Self::Script => opening.starts_with(SCRIPT_MARK.as_bytes()),
                Self::Picture => opening.starts_with(PICTURE_MARK.as_bytes()),
                Self::Pixels => opening.starts_with(b"\x89PNG") && holds(opening, PNG_MARK),
                Self::Gif => opening.starts_with(b"GIF89a") && holds(opening, GIF_MARK),
                Self::Dxf => opening.starts_with(DXF_MARK.as_bytes()),
                Self::PathTable => is_heading_of_paths(line, is_whole),
                Self::Table(words) => line == words.as_bytes(),
                Self::Columns(hash) => fnv_1a(line) == hash,
            }
    }
}

fn holds(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

/// The first line without its end, and whether it is there to its end.
fn first_line(text: &[u8]) -> (&[u8], bool) {
    let end = text.iter().position(|&byte| byte == b'\n');
    let line = &text[..end.unwrap_or(text.len())];
    (line.strip_suffix(b"\r").unwrap_or(line), end.is_some())
}

/// Whether these words stand over times and the places of points: `time,A.x,A.y`.
fn is_heading_of_paths(heading: &[u8], is_whole: bool) -> bool {
    let mut columns: Vec<&[u8]> = heading.split(|&byte| byte == b',').collect();
    if !is_whole && columns.len() > 1 {
        columns.pop();
    }
    columns[0] == b"time"
        && columns[1..].chunks(2).all(|pair| match pair {
            [x, y] => x.strip_suffix(b".x").is_some_and(|x| y.strip_suffix(b".y") == Some(x)),
            _ => !is_whole,
        })
}

/// Whether a name has an ending, in large letters or small.
pub fn ends_in(name: &str, ending: &str) -> bool {
    name.to_ascii_lowercase().ends_with(ending)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_paths_is_known_by_its_heading() {
        let is_ours = |text: &str| FileKind::PathTable.wrote(text.as_bytes());
        for text in [
            "",
            "time\n",
            "time\n1\n",
            "time,A.x,A.y\n",
            "time,A.x,A.y\r\n0,1,2",
            "time,A.x,A.y,p[1",
        ] {
            assert!(is_ours(text), "{text:?}");
        }
        for text in
            ["A.x,A.y\n", "time,x,y\n", "time,A.x,B.y\n", "time,A.x\n", "times\n", "time;A.x;A.y\n"]
        {
            assert!(!is_ours(text), "{text:?}");
        }
    }
}
