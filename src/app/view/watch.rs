//! Files that change under the running window.
//!
//! Looked at four times a second, on a thread of its own: the inotify of the `notify` crate would bring nine crates, misses
//! changes on network folders, and has to watch folders, because editors replace files.

use super::Event;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};
use winit::event_loop::EventLoopProxy;

/// Between two looks. A file is whole once it stays the same from one look to the next.
const PERIOD: Duration = Duration::from_millis(250);

/// What tells one version of a file from another: time of its last change, and size. `None`: there is no such file.
type Stamp = Option<(SystemTime, u64)>;

/// The files that are watched.
#[derive(Clone, Default)]
pub(super) struct Watch(Arc<Mutex<Vec<(PathBuf, Stamp)>>>);

impl Watch {
    /// Watches from now on; a change arrives as [`Event::Changed`].
    pub(super) fn start(proxy: EventLoopProxy<Event>) -> Self {
        let watch = Self::default();
        let theirs = watch.clone();
        std::thread::spawn(move || {
            let mut waits = false;
            loop {
                std::thread::sleep(PERIOD);
                let changed = theirs.look();
                // The event loop has ended where an event has nowhere to go.
                if waits && !changed && proxy.send_event(Event::Changed).is_err() {
                    return;
                }
                waits = changed;
            }
        });
        watch
    }

    /// Watches these files, which were read from time `since` on.
    pub(super) fn files(&self, files: &[PathBuf], since: SystemTime) {
        let now = SystemTime::now();
        let first = |path: &PathBuf| {
            // What changed while it was read is reported at once.
            let stamp = stamp(path).filter(|&(time, _)| time < since || time > now);
            (path.clone(), stamp)
        };
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = files.iter().map(first).collect();
    }

    /// Watches one more, whatever it is now.
    pub(super) fn also(&self, file: &Path) {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !files.iter().any(|(known, _)| known == file) {
            files.push((file.to_path_buf(), stamp(file)));
        }
    }

    /// Whether a file is not what it was at the last look.
    fn look(&self) -> bool {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.iter_mut().fold(false, |changed, (path, last)| {
            let now = stamp(path);
            std::mem::replace(last, now) != now || changed
        })
    }
}

fn stamp(path: &Path) -> Stamp {
    let metadata = path.metadata().ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_seen_once() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        std::fs::write(&a, "1").unwrap();
        let watch = Watch::default();
        watch.files(&[a.clone(), b.clone()], SystemTime::now() + Duration::from_secs(1));
        assert!(!watch.look());
        std::fs::write(&b, "").unwrap();
        assert!(watch.look());
        assert!(!watch.look());
        std::fs::write(&a, "12").unwrap();
        assert!(watch.look());
        std::fs::remove_file(&b).unwrap();
        assert!(watch.look());
        assert!(!watch.look());
        // Changed after reading began, before it was watched.
        watch.files(&[a], SystemTime::UNIX_EPOCH);
        assert!(watch.look());
        assert!(!watch.look());
    }
}
