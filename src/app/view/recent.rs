//! Scenes that were shown last, newest first, kept from one start to the next.

use crate::image::write_atomically;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Of them, as many as there are number keys.
const MOST: usize = 9;

/// The list, and the file that keeps it: a path in each line.
#[derive(Default)]
pub(super) struct Recent {
    file: Option<PathBuf>,
    scenes: Vec<PathBuf>,
}

impl Recent {
    /// As the folder has it; without one it lasts as long as the window.
    pub(super) fn load(folder: Option<PathBuf>) -> Self {
        let file = folder.map(|folder| folder.join("recent"));
        let scenes = file.as_deref().map(read).unwrap_or_default();
        Self { file, scenes }
    }

    pub(super) fn scenes(&self) -> &[PathBuf] {
        &self.scenes
    }

    /// A scene is shown.
    pub(super) fn add(&mut self, scene: &Path) {
        let Ok(scene) = std::path::absolute(scene) else { return };
        // Other windows may have shown others meanwhile.
        let before = self.file.as_deref().map_or_else(|| self.scenes.clone(), read);
        let others = before.into_iter().filter(|other| *other != scene);
        self.scenes = std::iter::once(scene.clone()).chain(others).take(MOST).collect();
        if let Some(file) = &self.file {
            write(file, &self.scenes);
        }
    }
}

fn read(file: &Path) -> Vec<PathBuf> {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    text.lines().map(PathBuf::from).filter(|path| path.is_absolute()).take(MOST).collect()
}

/// Where this fails, the next start has a shorter list: no reason to stop.
fn write(file: &Path, scenes: &[PathBuf]) {
    if let Some(folder) = file.parent() {
        let _ = std::fs::create_dir_all(folder);
    }
    // Names that are no text, or more than a line of it, are left out.
    let lines = scenes.iter().filter_map(|scene| scene.to_str()).filter(|line| !line.contains('\n'));
    let text: String = lines.flat_map(|line| [line, "\n"]).collect();
    let _ = write_atomically(file, |file| file.write_all(text.as_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_is_first_and_none_is_there_twice() {
        let folder = tempfile::tempdir().unwrap();
        let open = || Recent::load(Some(folder.path().join("amas")));
        assert!(open().scenes().is_empty());
        let [mut one, mut other] = [open(), open()];
        one.add(Path::new("/a.toml"));
        other.add(Path::new("/b.toml"));
        one.add(Path::new("/c\n.toml"));
        one.add(Path::new("/a.toml"));
        let paths = |recent: &Recent| -> Vec<_> {
            recent.scenes().iter().map(|path| path.display().to_string()).collect()
        };
        assert_eq!(paths(&open()), ["/a.toml", "/b.toml"]);
        for number in 0..20 {
            one.add(&PathBuf::from(format!("/{number}.obj")));
        }
        assert_eq!(paths(&open()).len(), MOST);
        assert_eq!(paths(&open()), paths(&one));
        assert_eq!(paths(&one)[..2], ["/19.obj", "/18.obj"]);
        // Without a folder it is remembered, too.
        let mut none = Recent::load(None);
        none.add(Path::new("relative.toml"));
        assert!(none.scenes()[0].is_absolute());
    }
}
