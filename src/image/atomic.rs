//! All-or-nothing writing: a temporary file beside the target, renamed when it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::{Error, Result};

/// Writes `path` by `writer`, all or nothing: on failure no new file is left and an old one is as it was.
///
/// A link is followed, so its target is replaced and the link stays. What is not a plain file (a pipe, `/dev/stdout`)
/// cannot be renamed over and is written directly.
///
/// # Errors
/// [`Error::Write`] with the first failure, of `writer` or of the file system.
pub fn write_atomically(
    path: impl AsRef<Path>,
    writer: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<()> {
    let path = path.as_ref();
    write(path, writer).map_err(|source| Error::Write { file: path.to_path_buf(), source })
}

fn write(path: &Path, writer: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    match fs::metadata(&target) {
        Ok(old) if old.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(old) if !old.is_file() => {
            return finish(File::options().write(true).open(&target)?, writer);
        }
        _ => {}
    }
    let temporary = Temporary::beside(&target)?;
    finish(File::options().write(true).create_new(true).open(&temporary.path)?, writer)?;
    fs::rename(&temporary.path, &target)
}

fn finish(file: File, writer: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut file = BufWriter::new(file);
    writer(&mut file)?;
    file.flush()
}

/// Removes its file when dropped; after the rename there is none.
struct Temporary {
    path: PathBuf,
}

impl Temporary {
    fn beside(target: &Path) -> io::Result<Self> {
        // Threads of one process may write beside each other.
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = target.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
        Ok(Self { path: target.with_file_name(hidden) })
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // Nothing is lost if this fails: the write's own error is the one that is reported.
        let _ = fs::remove_file(&self.path);
    }
}
