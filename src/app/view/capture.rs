//! Pictures of the window as files: what is seen as PNG, the radiance behind it as EXR.

use super::picture::Picture;
use crate::app::terminal::{complain, print};
use crate::error::Result;
use crate::image::{HdrImage, save_png8};
use std::path::{Path, PathBuf};
use std::thread::JoinHandle;

/// Pictures that are being written.
#[derive(Default)]
pub(super) struct Captures(Vec<JoinHandle<()>>);

impl Captures {
    /// Reads the picture back and writes it on another thread, to `amas_0001.png` and `.exr` or the next free number.
    pub(super) fn take(&mut self, picture: &Picture) -> Result<()> {
        let (seen, radiance) = (picture.frame.ldr()?, picture.frame.hdr()?);
        self.0.retain(|writer| !writer.is_finished());
        // One at a time, so that two do not find the same number free.
        let before = std::mem::take(&mut self.0);
        self.0.push(std::thread::spawn(move || {
            before.into_iter().for_each(join);
            if let Err(error) = save(Path::new("."), &seen, &radiance) {
                complain(error);
            }
        }));
        Ok(())
    }
}

/// None is lost when the window closes.
impl Drop for Captures {
    fn drop(&mut self) {
        self.0.drain(..).for_each(join);
    }
}

fn join(writer: JoinHandle<()>) {
    // A panic was reported on its thread.
    let _ = writer.join();
}

fn save(folder: &Path, seen: &[[u8; 4]], radiance: &HdrImage) -> Result<()> {
    let [png, exr] = free(folder);
    let seen: Vec<[u8; 3]> = seen.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    save_png8(&png, radiance.width, radiance.height, &seen)?;
    radiance.save(&exr)?;
    print(format_args!("{} and {}", png.display(), exr.display()))
}

/// The names of the first number that has neither.
fn free(folder: &Path) -> [PathBuf; 2] {
    let names = |number| ["png", "exr"].map(|kind| folder.join(format!("amas_{number:04}.{kind}")));
    (1_u32..).map(names).find(|names| !names.iter().any(|name| name.exists())).unwrap_or_else(|| names(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let radiance = HdrImage::new(2, 1);
        std::fs::write(folder.path().join("amas_0002.exr"), "kept").unwrap();
        for _ in 0..3 {
            save(folder.path(), &[[1, 2, 3, 255]; 2], &radiance).unwrap();
        }
        let mut names: Vec<_> =
            folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        let want = ["0001.exr", "0001.png", "0002.exr", "0003.exr", "0003.png", "0004.exr", "0004.png"];
        assert_eq!(names, want.map(|name| std::ffi::OsString::from(format!("amas_{name}"))));
        assert_eq!(std::fs::read(folder.path().join("amas_0002.exr")).unwrap(), b"kept");
    }
}
