//! Files: read whole within bounds, written whole or not at all.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use tempfile::NamedTempFile;

use crate::session::Quota;

/// What some editors put before a text in UTF-8.
pub const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// How the name of a file begins that is being written.
const DRAFT: &str = ".linkwork-";

/// So many bytes of a file show what it is: the heading of a table may be long.
const OPENING: u64 = 8 << 10;

/// Bytes of a text that are read at most.
static MOST_BYTES: AtomicU64 = AtomicU64::new(Quota::SourceBytes.usual());

/// From here on no text of more bytes is read.
pub fn limit_bytes(most: u64) {
    MOST_BYTES.store(most, Ordering::Relaxed);
}

/// Bytes of a text that are read at most.
pub fn most_bytes() -> u64 {
    MOST_BYTES.load(Ordering::Relaxed)
}

/// Reads a text in UTF-8 from a file, or from a pipe by the name of one.
pub fn read(path: &Path) -> io::Result<String> {
    read_text(File::open(path)?)
}

/// Reads a text from a file at a place without links. If somebody has put a link in its way since, there is
/// nothing.
pub fn read_at(place: &Path) -> io::Result<String> {
    let is_there = is_regular(place)? && real(place)?.is_some_and(|real| real == place);
    let nothing = || io::Error::from(io::ErrorKind::NotFound);
    let file = is_there.then(|| File::open(place)).ok_or_else(nothing)??;
    // What was opened is looked at: it may have been replaced meanwhile.
    if !is_same_file(&fs::symlink_metadata(place)?, &file)? {
        return Err(nothing());
    }
    read_text(file)
}

/// Reads a text in UTF-8, of which so much is there that it may be a script.
pub fn read_text(source: impl Read) -> io::Result<String> {
    let mut bytes = Vec::new();
    let most = most_bytes();
    source.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    text(bytes)
}

/// The text that `bytes` are. A byte order mark is no part of it: columns count from behind it.
fn text(mut bytes: Vec<u8>) -> io::Result<String> {
    if bytes.starts_with(BYTE_ORDER_MARK) {
        bytes.drain(..BYTE_ORDER_MARK.len());
    }
    String::from_utf8(bytes).map_err(|_| io::Error::from(io::ErrorKind::InvalidData))
}

/// How a regular file begins; none where there is none, or where it is empty.
pub fn opening(path: &Path) -> io::Result<Option<Vec<u8>>> {
    if !is_regular(path)? {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(OPENING).read_to_end(&mut bytes)?;
    Ok(Some(bytes))
}

/// Whether there is a regular file.
///
/// # Errors
/// Where there is something else, or where it cannot be told.
pub fn is_regular(path: &Path) -> io::Result<bool> {
    match fs::metadata(path) {
        Ok(what) if what.is_file() => Ok(true),
        Ok(what) if what.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(_) => Err(io::ErrorKind::InvalidInput.into()),
        Err(e) if is_nothing(&e) => Ok(false),
        Err(e) => Err(e),
    }
}

/// Whether what a path leads to, symbolic links followed, lies in a folder or is still to be made
/// there. A link that leads nowhere does not, and in a folder that is not there nothing does.
pub fn is_below(folder: &Path, path: &Path) -> io::Result<bool> {
    let Some(folder) = real(folder)? else { return Ok(false) };
    let mut existing = path;
    loop {
        if let Some(place) = real(existing)? {
            return Ok(place.starts_with(&folder));
        }
        match existing.parent() {
            Some(parent) if !existing.is_symlink() => existing = parent,
            _ => return Ok(false),
        }
    }
}

/// Whether a file that was just made lies in a folder or below it. What its path leads to now need not be
/// that file: it has to be found there. Nobody else knows its name, so if a link is put in its way later
/// it is not there to be renamed.
fn is_really_below(folder: &Path, file: &NamedTempFile) -> io::Result<bool> {
    let (Some(folder), Some(place)) = (real(folder)?, real(file.path())?) else { return Ok(false) };
    Ok(place.starts_with(folder) && is_same_file(&fs::symlink_metadata(place)?, file.as_file())?)
}

#[cfg(unix)]
fn is_same_file(there: &fs::Metadata, file: &File) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let open = file.metadata()?;
    Ok((there.dev(), there.ino()) == (open.dev(), open.ino()))
}

#[cfg(not(unix))]
fn is_same_file(_there: &fs::Metadata, _file: &File) -> io::Result<bool> {
    Ok(true)
}

/// A path without links; none if it leads nowhere.
fn real(path: &Path) -> io::Result<Option<PathBuf>> {
    match or_here(path).canonicalize() {
        Ok(place) => Ok(Some(place)),
        Err(e) if is_nothing(&e) => Ok(None),
        Err(e) => Err(e),
    }
}

/// Whether this says that there is nothing.
fn is_nothing(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}

/// Writes a file as [`write_in_pieces`] does.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_in_pieces(path, None, &mut |out| out.write_all(bytes))
}

/// Writes a file beside its place, then renames it into place; makes the folders it needs. It is
/// on the disk before it has its name. Where it is to stay `within` a folder, that is seen of the new
/// file itself: somebody may have put a link in its way since its path was looked at.
pub fn write_in_pieces(
    path: &Path,
    within: Option<&Path>,
    content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // A link stays one, and what it leads to is written.
    let place = if path.is_symlink() { path.canonicalize()? } else { path.to_path_buf() };
    let folder = folder_of(&place);
    fs::create_dir_all(folder)?;
    let draft = draft_in(folder)?;
    if let Some(root) = within
        && !is_really_below(root, &draft)?
    {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    let mut out = BufWriter::with_capacity(1 << 16, draft.as_file());
    content(&mut out)?;
    out.flush()?;
    drop(out);
    if let Ok(old) = fs::metadata(&place) {
        draft.as_file().set_permissions(old.permissions())?;
    }
    publish(Draft { file: draft, place: &place })
}

/// A file that is written and has no name yet that anybody knows.
trait Unpublished {
    /// Waits until it is on the disk.
    fn flush(&self) -> io::Result<()>;

    /// Gives it its name, in place of what had it.
    fn rename(self) -> io::Result<()>;
}

/// Gives a file its name once it is on the disk: whenever the power fails, there is the old one or the
/// new one, whole.
fn publish(file: impl Unpublished) -> io::Result<()> {
    file.flush()?;
    file.rename()
}

/// A draft, and where it belongs.
struct Draft<'a> {
    file: NamedTempFile,
    place: &'a Path,
}

impl Unpublished for Draft<'_> {
    fn flush(&self) -> io::Result<()> {
        self.file.as_file().sync_all()
    }

    fn rename(self) -> io::Result<()> {
        self.file.persist(self.place).map_err(|e| e.error)?;
        #[cfg(unix)]
        // A file system without this keeps names in its own way.
        drop(File::open(folder_of(self.place)).and_then(|folder| folder.sync_all()));
        Ok(())
    }
}

/// A file without a name, which is gone when nobody has it open, however that comes: in a folder, or
/// where temporary files lie while there is no such folder.
pub fn nameless(folder: &Path) -> io::Result<File> {
    let folder = or_here(folder);
    if folder.is_dir() { tempfile::tempfile_in(folder) } else { tempfile::tempfile() }
}

/// A new file in a folder, as the user wants new files to be readable. It is locked for as long as
/// it is being written: that tells it from one that a killed run left behind.
fn draft_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(DRAFT);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    loop {
        let draft = builder.tempfile_in(folder)?;
        // Before it was locked it looked like one that was left behind, and may be gone.
        let is_ours = match draft.as_file().try_lock() {
            Err(fs::TryLockError::WouldBlock) => false,
            Ok(()) => draft.path().exists(),
            // Where nothing can be locked nothing is taken for left behind.
            Err(fs::TryLockError::Error(_)) => true,
        };
        if is_ours {
            return Ok(draft);
        }
    }
}

/// Removes what runs left behind in a folder that were killed while they wrote.
pub fn remove_leftovers(folder: &Path) {
    let Ok(entries) = fs::read_dir(or_here(folder)) else { return };
    let is_draft = |name: &OsStr| name.to_string_lossy().starts_with(DRAFT);
    for entry in entries.flatten().filter(|entry| is_draft(&entry.file_name())) {
        let is_file = entry.file_type().is_ok_and(|it| it.is_file());
        if is_file
            && let Ok(draft) = File::open(entry.path())
            && draft.try_lock().is_ok()
        {
            // What cannot be removed is no reason not to go on.
            drop(fs::remove_file(entry.path()));
        }
    }
}

/// The folder that a file is in.
pub fn folder_of(file: &Path) -> &Path {
    file.parent().map_or(Path::new("."), or_here)
}

/// A path; that of the working folder if it is empty.
fn or_here(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}

#[cfg(all(test, unix))]
mod tests {
    use std::cell::RefCell;
    use std::os::unix::fs::symlink;

    use super::*;

    /// Notes what is done with it.
    struct Noted<'a> {
        done: &'a RefCell<Vec<&'static str>>,
        is_disk_full: bool,
    }

    impl Unpublished for Noted<'_> {
        fn flush(&self) -> io::Result<()> {
            self.done.borrow_mut().push("flush");
            if self.is_disk_full { Err(io::ErrorKind::StorageFull.into()) } else { Ok(()) }
        }

        fn rename(self) -> io::Result<()> {
            self.done.borrow_mut().push("rename");
            Ok(())
        }
    }

    #[test]
    fn a_file_has_its_name_when_it_is_on_the_disk() {
        let done = RefCell::default();
        publish(Noted { done: &done, is_disk_full: false }).unwrap();
        assert_eq!(done.take(), ["flush", "rename"]);
        publish(Noted { done: &done, is_disk_full: true }).unwrap_err();
        assert_eq!(done.take(), ["flush"]);
    }

    #[test]
    fn a_link_that_is_put_in_the_way_late_leads_nothing_out() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir_all(at("out/in")).unwrap();
        fs::create_dir(at("else")).unwrap();
        symlink(at("else"), at("out/dir")).unwrap();
        symlink(at("out/in"), at("out/near")).unwrap();
        let write = |name: &str| {
            write_in_pieces(&at(name), Some(&at("out")), &mut |out| out.write_all(b"it"))
        };
        assert_eq!(write("out/dir/a").unwrap_err().kind(), io::ErrorKind::PermissionDenied);
        assert_eq!(fs::read_dir(at("else")).unwrap().count(), 0);
        write("out/a").unwrap();
        write("out/near/a").unwrap();
        assert_eq!(fs::read(at("out/in/a")).unwrap(), b"it");
        assert_eq!(fs::read_dir(at("out")).unwrap().count(), 4);
    }
}
