//! Places that cannot be written to: status 2 where that shows before the work, 1 where it shows in writing.

use crate::Folder;

#[test]
fn names_and_folders() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    for name in ["a.jpg", "a", "a.png.bak", ".png"] {
        folder.refused(&["render", "scene.toml", "-o", name], &[".png, .exr or .pfm"]);
    }
    folder.refused(&["render", "scene.toml", "-o", ""], &["--output"]);
    for (name, cause) in [
        ("none/a.png", "no folder none"),
        ("scene.toml/a.png", "no folder scene.toml"),
        ("folder.png", "is a folder"),
        // The kernel's own folders take no files, not even from root.
        ("/proc/self/a.png", "cannot be written to"),
        ("/sys/kernel/a.exr", "cannot be written to"),
    ] {
        folder.refused(&["render", "scene.toml", "-o", name], &[name, cause]);
    }
    let render = |words: &[&str], parts: &[&str]| {
        folder.refused(&[&["render", "scene.toml"], words].concat(), parts);
    };
    render(&["--report", "none/r.json"], &["none/r.json", "no folder"]);
    render(&["--report", "r%04d.json"], &["r%04d.json", "one report"]);
    render(&["--aov", "normal=none/n.exr"], &["none/n.exr", "no folder"]);
    render(&["--aov", "position=n.png"], &["n.png", ".exr or .pfm"]);
    folder.refused(&["bench", "scene.toml", "--json", "none/b.json"], &["none/b.json", "no folder"]);
    folder.refused(
        &["report", "--out", "none/deeper"],
        &["none/deeper", "cannot be made", "the folder that it lies in"],
    );
    folder.refused(&["report", "--out", "scene.toml"], &["scene.toml", "cannot be made"]);
    for words in [["-o", "a.png"].as_slice(), &["-o", "a.exr", "--error", "e.png"]] {
        folder.refused(&[&["reference", "scene.toml"], words].concat(), &[".exr or .pfm"]);
    }
}

#[test]
fn one_file_for_two_things() {
    let folder = Folder::new();
    let render = |words: &[&str], parts: &[&str]| {
        folder.refused(&[&["render", "scene.toml"], words].concat(), parts);
    };
    render(&["-o", "a.png", "-o", "a.png"], &["a.png", "two outputs"]);
    render(&["-o", "a.exr", "--aov", "normal=a.exr"], &["a.exr", "two outputs"]);
    render(&["-o", "a.png", "--report", "./scene.toml"], &["./scene.toml", "is the scene"]);
    folder.refused(&["bench", "scene.toml", "--json", "scene.toml"], &["scene.toml", "is the scene"]);
    folder
        .refused(&["reference", "scene.toml", "-o", "a.exr", "--error", "a.exr"], &["a.exr", "two outputs"]);
}

/// A disk that is full: the message names the file and the system's answer.
#[cfg(target_os = "linux")]
#[test]
fn full_disk() {
    let folder = Folder::new();
    for name in ["full.png", "full.exr", "full.pfm"] {
        std::os::unix::fs::symlink("/dev/full", folder.path(name)).unwrap();
        folder.fails(1, &["render", "scene.toml", "-o", name], &[name, "cannot write", "No space left"]);
    }
    let cause = ["/dev/full", "cannot write", "No space left"];
    let bench = ["bench", "scene.toml", "--frames", "1", "--json"];
    folder.fails(1, &[&bench[..], &["/dev/full"]].concat(), &cause);
    folder.fails(1, &["reference", "scene.toml", "-o", "full.exr"], &["full.exr", "cannot write"]);
}

/// Neither a full disk behind stdout nor a reader that has gone away is a panic.
#[cfg(target_os = "linux")]
#[test]
fn stdout_that_does_not_take_it() {
    let folder = Folder::new();
    for arguments in [&["info"][..], &["info", "--json"], &["render", "scene.toml"]] {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let run = crate::Run::of(folder.command(arguments).stdout(full), arguments);
        run.fails(1, &["stdout", "cannot write", "No space left"]);
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let run = crate::Run::of(folder.command(arguments).stdout(writer), arguments);
        assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run:?}");
    }
}

/// A picture that cannot be replaced stays as it was.
#[test]
fn old_pictures_survive_a_failure() {
    let folder = Folder::new();
    folder.write("a.png", "old");
    folder.refused(&["render", "scene.toml", "-o", "a.png", "--camera", "none"], &["none"]);
    assert_eq!(folder.read("a.png"), b"old");
}
