//! Files that a scene names and that are wrong: status 2, with the file at fault, and its line where it has lines.

use crate::{Folder, SCENE, empty_png, png};
use std::io::Cursor;

/// `amas render` of [`SCENE`] with `old` replaced by `new` and `content` in `file`: the message holds `parts`.
fn refused((old, new): (&str, &str), file: &str, content: &[u8], parts: &[&str]) {
    assert_eq!(SCENE.matches(old).count(), 1, "{old}");
    let folder = Folder::new();
    folder.write("scene.toml", SCENE.replace(old, new));
    folder.write(file, content);
    folder.refused(&["render", "scene.toml", "-o", "a.png"], parts);
}

fn texture(file: &str, content: &[u8], parts: &[&str]) {
    let color = format!("color = {{ texture = \"{file}\" }}");
    let parts = [&[file], parts].concat();
    refused(("color = [0.5, 0.5, 0.5]", &color), file, content, &parts);
}

#[test]
fn models() {
    let obj = |text: &str, parts: &[&str]| {
        let place = ("shape = \"plane\"\nsize = 4.0", "obj = \"m.obj\"");
        refused(place, "m.obj", text.as_bytes(), parts);
    };
    obj("", &["m.obj: ", "no faces"]);
    obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n", &["m.obj: ", "no faces"]);
    obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", &["m.obj:4: ", "vertex 4, but 3"]);
    obj("v 0 0 0\nf 1 1 -3\n", &["m.obj:2: ", "vertex -3"]);
    obj("v 0 nan 0\n", &["m.obj:1: ", "not finite"]);
    obj("v 0 zero 0\n", &["m.obj:1: ", "zero"]);
    obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", &["scene.toml:", "no triangle with an area"]);
}

#[test]
fn lists_of_lights() {
    let light = "type = \"point\"\nposition = [0, 1, 0]\nintensity = [3, 2, 1]\nrange = 1.5";
    let csv = |text: &[u8], parts: &[&str]| {
        let place = (light, "type = \"points\"\nfile = \"l.csv\"");
        refused(place, "l.csv", text, parts);
    };
    csv(b"", &["l.csv:1: ", "empty"]);
    csv(b"x,y,z,r,g,b\n", &["l.csv: ", "no lights"]);
    csv(b"x,y,z,r,g\n1,2,3,4,5\n", &["l.csv:1: ", "`b`"]);
    csv(b"x,y,z,r,g,b\n1,2,3,4,5,6\n1,2,3\n", &["l.csv:3: ", "3 fields"]);
    csv(b"x,y,z,r,g,b\n1,2,3,4,nan,6\n", &["l.csv:2: ", "`g` is NaN"]);
    csv(b"x,y,z,r,g,b,range\n1,2,3,4,5,6,-1\n", &["l.csv:2: ", "negative"]);
    csv(b"\x89PNG\r\n\x1a\n", &["l.csv: ", "UTF-8"]);
    // One more than 2^20.
    let mut many = "x,y,z,r,g,b\n".to_owned();
    many.push_str(&"0,1,0,1,1,1\n".repeat((1 << 20) + 1));
    csv(many.as_bytes(), &["1048577 lights, more than 1048576"]);
}

#[test]
fn textures() {
    let whole = png(16, 16, |x, y| [(16 * x) as u8, (16 * y) as u8, (x * y) as u8, 255]);
    texture("t.png", &whole[..whole.len() / 2], &["cannot decode"]);
    texture("t.png", b"", &["cannot decode"]);
    texture("t.png", b"not a picture at all", &["cannot decode"]);
    texture("t.png", &empty_png(0, 0), &["scene.toml:18: ", "\"t.png\": "]);
    texture("t.png", &empty_png(16, 16), &["cannot decode"]);
    texture("t.png", &empty_png(100_000, 100_000), &["16384 texels"]);
    texture("t.txt", b"words", &["cannot decode"]);
    texture("t.exr", b"\x76\x2f\x31\x01\x02\0\0\0", &["cannot decode"]);
    texture("t.hdr", b"#?RADIANCE\n\n-Y 2 +X 2\n", &["cannot decode"]);
}

#[test]
fn jpegs() {
    let picture =
        image::RgbImage::from_fn(64, 64, |x, y| image::Rgb([(4 * x) as u8, (4 * y) as u8, (x * y) as u8]));
    let mut whole = Vec::new();
    picture.write_to(&mut Cursor::new(&mut whole), image::ImageFormat::Jpeg).unwrap();
    texture("t.jpg", &whole[..100], &["cannot decode"]);
    texture("t.jpg", &whole[..whole.len() / 2], &["cannot decode"]);
    // The marker of the frame header becomes one that does not exist.
    let frame = whole.windows(2).position(|pair| pair == [0xff, 0xc0]);
    let mut corrupt = whole.clone();
    corrupt[frame.unwrap() + 1] = 0x02;
    texture("t.jpg", &corrupt, &["cannot decode"]);
}
