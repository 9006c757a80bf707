//! Where a scene's files come from: the disk, or a table in the program.

use std::borrow::Cow;
use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};

/// The files that a scene names, by paths relative to the scene file.
pub(super) enum Files<'a> {
    /// Below the folder of the scene file.
    Disk(Folder),
    /// Names and contents, for a scene that is part of the program.
    Embedded(&'a [(&'a str, &'a [u8])]),
}

/// A folder, and what was read in it.
pub(super) struct Folder {
    path: PathBuf,
    read: RefCell<Vec<PathBuf>>,
}

impl<'a> Files<'a> {
    /// The files below a folder.
    pub(super) fn below(path: PathBuf) -> Self {
        Self::Disk(Folder { path, read: RefCell::default() })
    }

    /// Every file of the disk that was read so far, once.
    pub(super) fn names(&self) -> Vec<PathBuf> {
        let mut names = match self {
            Self::Disk(folder) => folder.read.borrow().clone(),
            Self::Embedded(_) => Vec::new(),
        };
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The path under which messages name `path`.
    pub(super) fn display(&self, path: &str) -> PathBuf {
        match self {
            Self::Disk(folder) => folder.path.join(path),
            Self::Embedded(_) => PathBuf::from(path),
        }
    }

    /// The bytes of `path`.
    pub(super) fn read(&self, path: &str) -> io::Result<Cow<'a, [u8]>> {
        match self {
            Self::Disk(folder) => {
                let path = folder.path.join(path);
                folder.read.borrow_mut().push(path.clone());
                std::fs::read(path).map(Cow::Owned)
            }
            Self::Embedded(files) => {
                let found = files.iter().find(|(name, _)| *name == path.trim_start_matches("./"));
                found.map(|(_, bytes)| Cow::Borrowed(*bytes)).ok_or_else(|| io::ErrorKind::NotFound.into())
            }
        }
    }

    fn exists(&self, path: &str) -> bool {
        match self {
            Self::Disk(folder) => folder.path.join(path).is_file(),
            Self::Embedded(_) => self.read(path).is_ok(),
        }
    }

    /// The path of the file that `base` calls `reference`: as written, or with `\` for `/` as on Windows.
    pub(super) fn find(&self, base: &str, reference: &str) -> Option<String> {
        let candidates = [reference, &reference.replace('\\', "/")].map(|reference| beside(base, reference));
        candidates.into_iter().find(|path| self.exists(path))
    }

    /// As [`Files::find`], or else by the mere name beside `base`: OBJ and MTL files often carry the absolute
    /// paths of their author's machine.
    pub(super) fn find_nearby(&self, base: &str, reference: &str) -> Option<String> {
        let name = reference.rsplit(['/', '\\']).next().unwrap_or_default();
        self.find(base, reference).or_else(|| self.find(base, name))
    }
}

/// `reference` as seen from the folder of `base`.
fn beside(base: &str, reference: &str) -> String {
    let folder = Path::new(base).parent().unwrap_or(Path::new(""));
    folder.join(reference).to_string_lossy().into_owned()
}
