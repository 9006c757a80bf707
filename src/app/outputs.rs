//! Output files: checked before anything is rendered, written all or nothing.

use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// What an output file holds, by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Display-referred, 8-bit.
    Display,
    /// Scene-linear, float32.
    Linear,
}

/// What a picture file holds; an error where no format has its extension.
pub(super) fn kind(path: &Path) -> Result<Kind> {
    match extension(path).as_str() {
        "png" => Ok(Kind::Display),
        "exr" | "pfm" => Ok(Kind::Linear),
        other => Err(Error::usage(
            format!("{}: no picture format {other:?}", path.display()),
            "end the name in .png, .exr or .pfm",
        )),
    }
}

/// Checks extension and folder of a picture file.
pub(super) fn check_picture(path: &Path) -> Result<Kind> {
    let kind = kind(path)?;
    check_folder(path)?;
    Ok(kind)
}

/// As [`check_picture`], for scene-linear files only.
pub(super) fn check_linear(path: &Path) -> Result<()> {
    match check_picture(path)? {
        Kind::Linear => Ok(()),
        Kind::Display => Err(Error::usage(
            format!("{}: numbers do not fit into 8 bits", path.display()),
            "end the name in .exr or .pfm",
        )),
    }
}

/// Makes a folder for files, unless it is there; what it lies in must be.
pub(super) fn make_folder(folder: &Path) -> Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    std::fs::create_dir(folder).map_err(|error| {
        Error::usage(
            format!("{}: the folder cannot be made: {error}", folder.display()),
            "make the folder that it lies in first, or write elsewhere",
        )
    })
}

/// Fails early where a file could not be written late.
pub(super) fn check_folder(path: &Path) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(Error::usage(
            format!("{}: there is no folder {}", path.display(), folder.display()),
            "make the folder first, or write elsewhere",
        ));
    }
    if path.is_dir() {
        return Err(Error::usage(format!("{} is a folder", path.display()), "name a file in it"));
    }
    // A pipe or a device is written directly, so nothing is put beside it.
    if path.metadata().is_ok_and(|old| !old.is_file()) {
        return Ok(());
    }
    let probe = folder.join(format!(".amas-{}-probe", std::process::id()));
    std::fs::write(&probe, []).map_err(|error| {
        Error::usage(
            format!("{}: the folder cannot be written to: {error}", path.display()),
            "change its rights, or write elsewhere",
        )
    })?;
    // The probe is empty and ours; a failure to remove it is reported by the real write.
    let _ = std::fs::remove_file(&probe);
    Ok(())
}

/// No file is written twice, and none over the scene.
pub(super) fn check_distinct<'a>(
    paths: impl IntoIterator<Item = &'a PathBuf>,
    scene: Option<&Path>,
) -> Result<()> {
    let paths: Vec<_> = paths.into_iter().collect();
    for (i, path) in paths.iter().enumerate() {
        let cause = if scene.is_some_and(|scene| same_file(path, scene)) {
            "this is the scene, and would be overwritten"
        } else if paths[..i].iter().any(|other| same_file(path, other)) {
            "named for two outputs"
        } else {
            continue;
        };
        return Err(Error::usage(
            format!("{}: {cause}", path.display()),
            "give every output a file of its own",
        ));
    }
    Ok(())
}

/// Whether two paths name one file.
pub(super) fn same_file(a: &Path, b: &Path) -> bool {
    a == b || a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

/// The file of frame `index`: `%04d` and the like are replaced.
pub(super) fn frame_path(path: &Path, index: u32) -> PathBuf {
    let text = path.to_string_lossy();
    match placeholder(&text) {
        Some((begin, end, width)) => {
            PathBuf::from(format!("{}{index:0width$}{}", &text[..begin], &text[end..]))
        }
        None => path.to_path_buf(),
    }
}

/// Several frames need a place for their number.
pub(super) fn check_frames(paths: &[PathBuf], frames: u32) -> Result<()> {
    match paths.iter().find(|path| frames > 1 && placeholder(&path.to_string_lossy()).is_none()) {
        Some(path) => Err(Error::usage(
            format!("{}: every frame would overwrite the one before", path.display()),
            "put %04d into the name",
        )),
        None => Ok(()),
    }
}

/// A file for all frames has no place for a number.
pub(super) fn check_single(path: &Path) -> Result<()> {
    match placeholder(&path.to_string_lossy()) {
        Some(_) => Err(Error::usage(
            format!("{}: one report covers all frames", path.display()),
            "name it without a frame's number",
        )),
        None => Ok(()),
    }
}

/// Begin, end and width of `%04d` or `%d`.
fn placeholder(text: &str) -> Option<(usize, usize, usize)> {
    let begin = text.find('%')?;
    let digits = text[begin + 1..].find(|c: char| !c.is_ascii_digit())?;
    let end = begin + 1 + digits;
    let width = text[begin + 1..end].parse().unwrap_or(0);
    (text[end..].starts_with('d') && width <= 20).then_some((begin, end + 1, width))
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbered() {
        assert_eq!(frame_path(Path::new("a_%04d.png"), 7), Path::new("a_0007.png"));
        assert_eq!(frame_path(Path::new("a_%d.png"), 12), Path::new("a_12.png"));
        assert_eq!(frame_path(Path::new("100%.png"), 1), Path::new("100%.png"));
        assert!(check_frames(&["a.png".into()], 2).is_err());
        assert!(check_frames(&["a.png".into()], 1).is_ok());
        assert!(check_single(Path::new("a_%04d.json")).is_err());
        assert!(check_single(Path::new("a.json")).is_ok());
    }
}
