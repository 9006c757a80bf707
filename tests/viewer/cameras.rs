//! Keys and mouse move the camera; what is copied is the camera that is seen.

use super::{C, D, Open, P, R, SCENE, TWO, W, rendered, rendered_from, scene};
use std::path::Path;
use std::time::Duration;

const SIZE: [u32; 2] = [96, 64];

/// Copies the camera, renders its picture offscreen, and waits until it is the window's. Returns the camera's text.
#[track_caller]
fn copied_is_seen(open: &mut Open, scene: &Path) -> String {
    // What moved last has been heard of once this key is.
    open.client.tap(C);
    std::thread::sleep(Duration::from_millis(300));
    let camera = open.client.clipboard();
    let copy = scene.with_file_name("copied.toml");
    let text = std::fs::read_to_string(scene).unwrap();
    std::fs::write(&copy, format!("{text}\n{camera}")).unwrap();
    let picture = rendered_from(&copy, SIZE, &["--camera", "main (copied)"]);
    open.shows("the copied camera's picture", SIZE, &picture);
    camera
}

/// `position` and `target` of a copied camera.
fn position_and_target(camera: &str) -> [[f64; 3]; 2] {
    ["position = ", "target = "].map(|key| {
        let line = camera.lines().find_map(|line| line.strip_prefix(key)).unwrap();
        let numbers = line.trim_matches(['[', ']']).split(", ").map(|number| number.parse().unwrap());
        numbers.collect::<Vec<f64>>().try_into().unwrap()
    })
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Samples, so that a picture at rest is refined; what is seen at last is what `amas render` makes of as many.
#[test]
fn flying_looking_and_orbiting() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    std::fs::write(&path, SCENE.replace("[render]", "[render]\nsamples = 5")).unwrap();
    let mut open = Open::new(&path, SIZE, &rendered(&path, SIZE));
    let home = position_and_target(&copied_is_seen(&mut open, &path));
    assert_eq!(home, [[0.5, 1.0, 3.0], [0.0, 0.4, 0.0]]);

    for key in [W, D] {
        open.client.key(key, true);
        std::thread::sleep(Duration::from_millis(150));
        open.client.key(key, false);
    }
    let flown = position_and_target(&copied_is_seen(&mut open, &path));
    let steps = [0, 1].map(|i| distance(flown[i], home[i]));
    assert!(steps[0] > 0.01 && (steps[0] - steps[1]).abs() < 1e-9, "{steps:?}");

    let drag = |open: &mut Open, button: u8, from: [u16; 2], to: [u16; 2]| {
        open.client.point(from);
        open.client.button(button, true);
        open.client.point(to);
        open.client.button(button, false);
    };
    drag(&mut open, 1, [48, 32], [60, 38]);
    let looked = position_and_target(&copied_is_seen(&mut open, &path));
    assert_eq!(looked[0], flown[0], "looking around moves the camera");
    assert!(distance(looked[1], flown[1]) > 0.1);

    drag(&mut open, 3, [48, 32], [30, 30]);
    let turned = position_and_target(&copied_is_seen(&mut open, &path));
    assert!(distance(turned[0], looked[0]) > 0.1, "turning around a point does not move the camera");
    let lengths = [looked, turned].map(|[position, target]| distance(position, target));
    assert!((lengths[0] - lengths[1]).abs() < 1e-9);

    open.client.tap(R);
    let back = position_and_target(&copied_is_seen(&mut open, &path));
    assert_eq!(back, home);
    let output = open.close();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stdout).matches("[[camera]]").count(), 5, "on stdout, too");
}

#[test]
fn numbers_and_paths() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let other = "[[camera]]\nname = \"other\"\nposition = [-2, 1.5, 2]\ntarget = [0, 0.2, 0]\northographic_height = 2.5\n";
    let walk = "path = [{ t = 0, position = [2, 1, 2], target = [0, 0, 0] }, { t = 0.4, position = [2, 2, 2], target = [0, 0, 0] }]\n";
    std::fs::write(&path, SCENE.replace("[[material]]", &format!("{other}{walk}[[material]]"))).unwrap();
    let mut open = Open::new(&path, SIZE, &rendered(&path, SIZE));
    open.client.tap(TWO);
    open.shows("the second camera", SIZE, &rendered_from(&path, SIZE, &["--camera", "other"]));
    open.client.tap(P);
    let end = std::fs::read_to_string(&path)
        .unwrap()
        .replace("[-2, 1.5, 2]", "[2, 2, 2]")
        .replace("[0, 0.2, 0]", "[0, 0, 0]");
    let at_end = path.with_file_name("end.toml");
    std::fs::write(&at_end, end).unwrap();
    open.shows("the end of the path", SIZE, &rendered_from(&at_end, SIZE, &["--camera", "other"]));
    open.ends_well();
}
