//! Scene files that are wrong: every message names file, line, cause and remedy.

use amas::scene::load_embedded;

use crate::{CAMERA, try_load};

/// Asserts that `toml`, after the four lines of the camera, fails at `line` for a reason that contains `part`.
pub(crate) fn fails(toml: &str, line: usize, part: &str) {
    let error = try_load(toml, &[("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")], &[]);
    message(error.err(), toml, line, part);
}

fn message(error: Option<amas::Error>, toml: &str, line: usize, part: &str) {
    let Some(error) = error else { panic!("loads, but should not: {toml}") };
    let text = error.to_string();
    let (cause, remedy) = text.split_once("\n  remedy: ").unwrap_or_else(|| panic!("no remedy: {text}"));
    assert!(cause.starts_with(&format!("test.toml:{line}: ")), "wrong line (want {line}): {text}\n{toml}");
    assert!(text.contains(part), "`{part}` is not in: {text}");
    assert!(cause.len() > 20 && remedy.len() > 5, "says too little: {text}");
    assert_eq!(error.exit_code(), 2);
}

#[test]
fn documents() {
    assert_eq!(CAMERA.lines().count(), 4, "the line numbers count on it");
    fails("[render\n", 5, "not valid TOML");
    fails("[[light]]\ntype = \"point\"\nrange = 1 km\n", 7, "write the number alone, such as `1`");
    fails("a = 1\n", 5, "unknown key `a`");
    fails("[rendr]\n", 5, "did you mean `render`?");
    fails("[[meshes]]\n", 5, "did you mean `mesh`?");
    fails("[light]\ntype = \"point\"\n", 5, "[[light]]");
    fails("render = 3\n", 4 + 1, "unknown key `render`");
    fails("[render]\nsize = [1, 1]\nsize = [2, 2]\n", 7, "not valid TOML");
    let error = load_embedded("test.toml", "# nothing\n", &[], &[]).err();
    message(error, "", 1, "no camera");
    let error = load_embedded("test.toml", "render = 3\n", &[], &[]).err();
    message(error, "", 1, "must be a table");
}

#[test]
fn render() {
    let cases = [
        ("sise = [1, 1]", "did you mean `size`?"),
        ("size = 5", "must be an array of 2 numbers"),
        ("size = [0, 720]", "`size[0]` must be from 1 to 16384, but is 0"),
        ("size = [1280, -1]", "but is -1"),
        ("size = [1280, 720.5]", "must be a whole number"),
        ("size = [99999999999999999999, 1]", "from 1 to 16384"),
        ("size = [16384, 16384]", "more than 67108864 pixels"),
        ("exposure = nan", "not a number"),
        ("exposure = inf", "infinite"),
        ("exposure = 1e999", "infinite"),
        ("exposure = \"1\"", "must be a number, but is a string"),
        ("samples = 0", "must be from 1 to 65536"),
        ("tonemap = \"filmic\"", "use one of: none, aces, agx"),
        ("background = [0, -1, 0]", "0 or more"),
        ("background = [0, 0]", "an array of 3 numbers, but is an array of 2"),
        ("light_error = -0.1", "from 0 to 1"),
        ("max_lights_per_cluster = 64", "from 128 to 2048"),
        ("max_lights_per_cluster = 4096", "from 128 to 2048"),
        ("indirect = 5", "must be a table"),
        ("indirect = { vpl = 5 }", "did you mean `vpls`?"),
        ("indirect = { vpls = 2000000 }", "1048576"),
        ("shadows = 1", "true or false"),
        ("shadows = 1979-05-27", "true or false"),
    ];
    for (key, part) in cases {
        fails(&format!("[render]\n\n{key}\n"), 7, part);
    }
}

#[test]
fn cameras() {
    let camera = |keys: &str| format!("[[camera]]\nname = \"c\"\n{keys}\n");
    let pose = "position = [0, 0, 1]\ntarget = [0, 0, 0]\n";
    fails(&camera("target = [0, 0, 0]\nvertical_fov = 45"), 5, "lacks the key `position`");
    fails(&camera("position = [0, 0, 0]\nvertical_fov = 45"), 5, "lacks the key `target`");
    fails(&camera("position = [1, 1, 1]\ntarget = [1, 1, 1]\nvertical_fov = 45"), 8, "own position");
    fails(&camera("position = [0, 9, 0]\ntarget = [0, 0, 0]\nvertical_fov = 45"), 8, "lies along `up`");
    fails(&camera(pose), 5, "neither `vertical_fov` nor");
    let cases = [
        ("vertical_fov = 0", "between 0 and 180"),
        ("vertical_fov = 180", "between 0 and 180"),
        ("vertical_fov = -45", "between 0 and 180"),
        ("orthographic_height = 0", "greater than 0"),
        ("vertical_fov = 45\northographic_height = 3", "keep one of the two"),
        ("vertical_fov = 45\nnear = 0", "greater than 0"),
        ("vertical_fov = 45\nnear = -1", "greater than 0"),
        ("vertical_fov = 45\nfar = 0.05", "greater than near"),
        ("vertical_fov = 45\nup = [0, 0, 0]", "length zero"),
        ("vertical_fov = 45\nfov = 45", "unknown key `fov`"),
        ("vertical_fov = 45\npath = 4", "must be an array"),
        ("vertical_fov = 45\npath = [{ t = 0 }]", "lacks the key `position`"),
    ];
    for (keys, part) in cases {
        fails(&camera(&format!("{pose}{keys}")), 9 + keys.lines().count() - 1, part);
    }
    let path = "path = [{ t = 1, position = [0, 0, 1], target = [0, 0, 0] },\n{ t = 1, position = [0, 0, 2], target = [0, 0, 0] }]";
    fails(&camera(&format!("{pose}vertical_fov = 45\n{path}")), 11, "ascending");
    let path = "path = [{ t = 0, position = [0, 0, 1], target = [0, 0, 0] },\n{ t = 1, position = [0, 0, -1], target = [0, 0, 0] }]";
    fails(&camera(&format!("{pose}vertical_fov = 45\n{path}")), 11, "along `up`");
    let twice = camera(&format!("{pose}vertical_fov = 45"));
    fails(&format!("{twice}{twice}"), 10, "two cameras");
}
