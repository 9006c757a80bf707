//! Pictures that cannot be compared: status 2.

use crate::{Folder, empty_png, png};
use amas::HdrImage;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("a.png", png(4, 4, |x, y| [x as u8, y as u8, 9, 255]));
    folder.write("wide.png", png(5, 4, |_, _| [255; 4]));
    folder.write("black.png", png(4, 4, |_, _| [0, 0, 0, 255]));
    HdrImage::new(4, 4).save(folder.path("a.exr")).unwrap();
    folder
}

#[test]
fn sizes() {
    let folder = folder();
    for arguments in [&["wide.png", "a.png"][..], &["a.exr", "wide.png"], &["wide.png", "a.exr", "--json"]] {
        let parts = [arguments[0], arguments[1], "5x4", "4x4"];
        folder.refused(&[&["compare"], arguments].concat(), &parts);
    }
    folder.refused(&["compare", "a.png", "a.exr", "--mask", "wide.png"], &["the mask has 5x4", "4x4"]);
    folder.refused(&["compare", "a.png", "a.exr", "--mask", "black.png"], &["no pixel is left"]);
}

#[test]
fn files() {
    let folder = folder();
    let whole = folder.read("a.exr");
    folder.write("cut.exr", &whole[..whole.len() / 2]);
    folder.write("cut.png", &folder.read("a.png")[..40]);
    folder.write("empty.png", empty_png(0, 0));
    folder.write("huge.png", empty_png(100_000, 100_000));
    folder.write("text.png", "words");
    folder.write("cut.pfm", "PF\n4 4\n-1.0\nabc");
    folder.write("huge.pfm", "PF\n100000 100000\n-1.0\nabc");
    folder.write("none.pfm", "PF\n0 0\n-1.0\n");
    folder.write("odd.pfm", "P6\n4 4\n255\n");
    for name in [
        "none.exr",
        "cut.exr",
        "cut.png",
        "empty.png",
        "huge.png",
        "text.png",
        "cut.pfm",
        "huge.pfm",
        "none.pfm",
        "odd.pfm",
        "scene.toml",
        ".",
    ] {
        folder.refused(&["compare", name, "a.png"], &[name]);
        folder.refused(&["compare", "a.png", name, "--json"], &[name]);
        folder.refused(&["compare", "a.png", "a.png", "--mask", name], &[name]);
    }
}
