//! Scene files that are wrong: status 2, with file and line.

use crate::{Folder, SCENE};

/// `amas render` of [`SCENE`] with `old` replaced by `new` names `scene.toml` with the line of `new`, and `parts`.
fn refused(old: &str, new: &str, parts: &[&str]) {
    assert_eq!(SCENE.matches(old).count(), 1, "{old}");
    let line = SCENE.replace(old, &format!("\0{new}")).lines().position(|line| line.contains('\0'));
    let line = format!("scene.toml:{}: ", line.unwrap() + 1);
    let folder = Folder::new();
    folder.write("scene.toml", SCENE.replace(old, new));
    let parts = [&[line.as_str()], parts].concat();
    folder.refused(&["render", "scene.toml", "-o", "a.png"], &parts);
}

#[test]
fn missing_or_no_file() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder")).unwrap();
    folder.write("binary.toml", b"[render]\n\xff\xfe\0");
    folder.write("empty.toml", "");
    for command in [&["render"][..], &["bench"], &["reference", "-o", "a.exr"]] {
        let refused = |scene: &str, parts: &[&str]| {
            folder.refused(&[command, &[scene]].concat(), parts);
        };
        refused("none.toml", &["none.toml", "No such file"]);
        refused("folder", &["folder", "directory"]);
        refused("binary.toml", &["binary.toml:2: ", "UTF-8"]);
        refused("empty.toml", &["empty.toml", "no camera"]);
        refused("scene.toml/x", &["scene.toml/x", "Not a directory"]);
    }
}

#[test]
fn keys_and_types() {
    refused("[render]", "[render", &["not valid TOML"]);
    refused("[render]", "[rendr]", &["did you mean `render`?"]);
    refused("size = [64, 48]", "sise = [64, 48]", &["did you mean `size`?"]);
    refused("range =", "rnage =", &["`rnage`", "did you mean `range`?"]);
    refused("size = [64, 48]", "size = \"64x48\"", &["an array of 2 numbers"]);
    refused("size = [64, 48]", "size = [0, 48]", &["`size[0]`", "from 1 to"]);
    refused("size = 4.0", "size = true", &["`size`"]);
    refused("type = \"matte\"", "type = \"velvet\"", &["velvet", "matte"]);
    refused("type = \"point\"", "type = \"spot\"", &["spot", "point"]);
    refused("material = \"floor\"", "material = \"flor\"", &["flor", "floor"]);
    refused("shape = \"plane\"\nsize = 4.0", "obj = \"none.obj\"", &["none.obj"]);
}

#[test]
fn numbers() {
    refused("vertical_fov = 45.0", "vertical_fov = 0", &["`vertical_fov`"]);
    refused("vertical_fov = 45.0", "vertical_fov = 180", &["`vertical_fov`"]);
    refused("range = 1.5", "range = -1.5", &["`range`", "-1.5"]);
    refused("range = 1.5", "range = 0", &["`range`"]);
    refused("range = 1.5", "range = nan", &["`range`", "not a number"]);
    refused("range = 1.5", "range = \"far\"", &["`range`", "a number"]);
    refused("[3, 2, 1]", "[3, nan, 1]", &["`intensity[1]`", "not a number"]);
    refused("[3, 2, 1]", "[3, -2, 1]", &["`intensity[1]`", "0 or more"]);
    refused("[3, 2, 1]", "[3, 2, 1e30]", &["`intensity[2]`"]);
    refused("position = [0, 1, 0]", "position = [0, inf, 0]", &["infinite"]);
    refused("position = [0, 1, 0]", "position = [0, 1]", &["3 numbers"]);
    refused("color = [0.5, 0.5, 0.5]", "color = [0.5, -1, 0.5]", &["`color[1]`"]);
    refused("t = 1.0", "t = 0.0", &["path"]);
}

#[test]
fn shapes_of_lights() {
    let light = |keys: &str, parts: &[&str]| {
        let folder = Folder::new();
        let begin = SCENE.lines().count() + 1;
        folder.write("scene.toml", format!("{SCENE}[[light]]\n{keys}\n"));
        let file = format!("scene.toml:{begin}");
        let found = parts.iter().copied().chain(["scene.toml:"]);
        folder.refused(&["reference", "scene.toml", "-o", "a.exr"], &found.collect::<Vec<_>>());
        // The line is that of the table or of one of its keys.
        let run = folder.run(&["render", "scene.toml", "-o", "a.png"]);
        let place = run.stderr.split(':').nth(2).unwrap().trim().parse::<usize>();
        let lines = begin..=begin + keys.lines().count();
        assert!(lines.contains(&place.unwrap()), "{file}: {run:?}");
    };
    let disk = "type = \"disk\"\ncenter = [0, 2, 0]\nradiance = [1, 1, 1]\n";
    light(&format!("{disk}normal = [0, 0, 0]\nradius = 1.0"), &["`normal`"]);
    light(&format!("{disk}normal = [0, 1, 0]\nradius = -1.0"), &["`radius`", "-1"]);
    light(&format!("{disk}u = [1, 0, 0]\nv = [2, 0, 0]"), &["`v`", "parallel"]);
    let polygon = "type = \"polygon\"\nradiance = [1, 1, 1]\n";
    light(&format!("{polygon}vertices = [[0, 0, 0], [1, 0, 0]]"), &["3 to 64 vertices"]);
    light(&format!("{polygon}vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]"), &["`vertices`"]);
    light(
        "type = \"line\"\na = [0, 1, 0]\nb = [0, 1, 0]\nradius = 0.1\nradiance = [1, 1, 1]",
        &["same point"],
    );
    light(
        "type = \"points\"\ngenerate = { count = 1048577, min = [0, 0, 0], max = [1, 1, 1], intensity = [1, 2] }",
        &["`count`", "1048576"],
    );
    light(
        "type = \"points\"\ngenerate = { count = 1048576, min = [0, 0, 0], max = [1, 1, 1], intensity = [1, 2] }",
        &["1048577 lights"],
    );
    light("type = \"points\"\nfile = \"none.csv\"", &["none.csv"]);
    let rect = "type = \"rect\"\ncenter = [0, 2, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nradiance = [1, 1, 1]\n";
    light(&[rect; 4097].join("[[light]]\n"), &["more than 4096 area lights"]);
}
