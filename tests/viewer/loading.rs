//! Scenes that change, that are dropped, that take long; pictures saved from the window; compiled pipelines kept.

use super::display::Display;
use super::{ESCAPE, F5, F12, L, Open, SCENE, TWO, View, amas, rendered, scene, stderr, wait_until};
use std::path::Path;
use std::time::{Duration, Instant};

const SIZE: [u32; 2] = [96, 64];

const OBJ: &str =
    "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 3/3 2/2 1/1\n";

/// An OBJ file of n × n points, two triangles for each square.
fn grid(n: usize) -> String {
    let points = (0..n * n).map(|i| format!("v {} 0 {}\n", i % n, i / n));
    let squares = (0..n * (n - 1)).filter(|i| i % n < n - 1).map(|i| i + 1);
    let triangles =
        squares.map(|a| format!("f {a} {} {}\nf {} {} {}\n", a + n, a + 1, a + 1, a + n, a + n + 1));
    points.chain(triangles).collect()
}

/// A quarter of a million lights, which take their time.
const MANY: &str = "[[light]]\ntype = \"points\"\ngenerate = { count = 250000, seed = 1, min = [-1, 0, -1], max = [1, 2, 1], intensity = [0.1, 0.2], range = 0.01 }\n";

fn texture(path: &Path, color: [u8; 3]) {
    image::RgbImage::from_pixel(4, 4, image::Rgb(color)).save(path).unwrap();
}

/// Each file of a scene changes in turn; a broken one leaves the picture as it is.
#[test]
fn changed_files_are_loaded_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let [obj, map] = ["floor.obj", "floor.png"].map(|name| folder.path().join(name));
    let text = SCENE
        .replace("diffuse = [0.6, 0.3, 0.2]", "diffuse = { texture = \"floor.png\" }")
        .replace("shape = \"plane\"\nsize = [4, 4]", "obj = \"floor.obj\"");
    std::fs::write(&path, &text).unwrap();
    std::fs::write(&obj, OBJ).unwrap();
    texture(&map, [200, 100, 50]);
    let first = rendered(&path, SIZE);
    let mut open = Open::new(&path, SIZE, &first);
    let follows = |open: &Open, what: &str| {
        let picture = rendered(&path, SIZE);
        assert_ne!(picture, first, "{what} changes nothing");
        open.shows(what, SIZE, &picture);
    };

    std::fs::write(&path, text.replace("[0.02, 0.05, 0.2]", "[0.2, 0.05, 0.02]")).unwrap();
    follows(&open, "another background");
    texture(&map, [50, 100, 200]);
    follows(&open, "another texture");
    std::fs::write(&obj, OBJ.replace("-1 0", "-2 0")).unwrap();
    follows(&open, "another OBJ");

    let before = rendered(&path, SIZE);
    std::fs::write(&path, format!("{text}\nnonsense")).unwrap();
    wait_until("the message", || open.display.corner([96, 64]) != before);
    std::fs::write(&path, &text).unwrap();
    follows(&open, "the repaired scene");
    open.client.tap(F5);
    std::thread::sleep(Duration::from_millis(500));
    follows(&open, "the same once more");
    let output = open.close();
    assert_eq!(output.status.code(), Some(0));
    let said = stderr(&output);
    assert!(said.contains("scene.toml") && said.contains("TOML") && said.contains("remedy"), "{said}");
}

/// A scene takes the place of the one that is there, and so does an OBJ file, with a camera and lights of its own.
#[test]
fn dropped_files_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let mut open = Open::new(&path, SIZE, &rendered(&path, SIZE));
    let [other, obj, text] = ["other.toml", "model.obj", "notes.txt"].map(|name| folder.path().join(name));
    std::fs::write(&other, SCENE.replace("[0.5, 1, 3]", "[-0.5, 1, 3]")).unwrap();
    std::fs::write(&obj, OBJ).unwrap();
    std::fs::write(&text, "no scene").unwrap();
    for file in [&other, &obj] {
        open.client.drop_file(open.window, file);
        let picture = rendered(file, SIZE);
        assert!(picture.iter().any(|pixel| pixel[0] > 60), "{file:?} is dark");
        open.shows("what was dropped", SIZE, &picture);
    }
    open.client.drop_file(open.window, &text);
    let before = rendered(&obj, SIZE);
    wait_until("the message", || open.display.corner([96, 64]) != before);
    open.client.drop_file(open.window, &other);
    open.shows("a scene again", SIZE, &rendered(&other, SIZE));
    let output = open.close();
    assert_eq!(output.status.code(), Some(0));
    assert!(stderr(&output).contains("notes.txt: this is no scene"), "{}", stderr(&output));
}

/// The bar is there while a million lights are made; Esc does not wait for them.
#[test]
fn loading_shows_a_bar_and_can_be_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    std::fs::write(&path, format!("{SCENE}{}", MANY.repeat(4))).unwrap();
    let display = Display::start();
    let mut client = display.connect();
    let view = View::open_plain(&display, &path, &["--size", "200x120"]);
    // The bar's rest, in the middle of the window, near its right end.
    let rest = || display.corner([200, 120])[60 * 200 + 148] == [56, 56, 56];
    wait_until("the bar", rest);
    let window = client.window_of_size([200, 120]).unwrap();
    client.focus(window);
    let begin = Instant::now();
    client.tap(ESCAPE);
    view.ends_well();
    println!("ended after {:?}", begin.elapsed());
}

/// Over a picture, too; the button ends it as Esc does, and the picture stays.
#[test]
fn loading_over_a_picture_shows_a_bar_and_can_be_cancelled() {
    const LARGE: [u32; 2] = [320, 240];
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let first = rendered(&path, LARGE);
    let mut open = Open::new(&path, LARGE, &first);
    // 320,000 triangles and the tree over them take more than a second.
    let other = folder.path().join("other.toml");
    std::fs::write(folder.path().join("grid.obj"), grid(400)).unwrap();
    let text = SCENE.replace("shape = \"plane\"\nsize = [4, 4]", "obj = \"grid.obj\"");
    std::fs::write(&other, text.replace("[render]", "[render]\nshadows = true")).unwrap();
    // In the middle half of the window, at its top; the rows below are the picture's.
    let bar = |open: &Open| {
        let screen = open.display.corner([320, 240]);
        let done = |pixel: &&[u8; 3]| pixel.iter().zip([200, 160, 80]).all(|(a, b)| a.abs_diff(b) <= 1);
        assert!(screen[320 * 120..] == first[320 * 120..], "the picture below");
        screen.iter().filter(done).count() > 50
    };
    open.client.drop_file(open.window, &other);
    wait_until("the bar", || bar(&open));
    open.client.point([100, 28]);
    open.client.button(1, true);
    open.client.button(1, false);
    open.shows("the picture", LARGE, &first);
    open.client.drop_file(open.window, &other);
    wait_until("the bar again", || bar(&open));
    open.client.tap(ESCAPE);
    open.shows("the picture once more", LARGE, &first);
    open.ends_well();
}

/// A scene with an error is not shown: what is wrong is said over the picture, until another is there.
#[test]
fn a_scene_that_is_refused_is_said_over_the_picture() {
    const LARGE: [u32; 2] = [320, 240];
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let first = rendered(&path, LARGE);
    let mut open = Open::new(&path, LARGE, &first);
    let broken = folder.path().join("broken.toml");
    std::fs::write(&broken, SCENE.replace("plastic", "plastik")).unwrap();
    open.client.drop_file(open.window, &broken);
    let screen = |open: &Open| open.display.corner([320, 240]);
    wait_until("the message", || screen(&open)[..320 * 120] != first[..320 * 120]);
    assert!(screen(&open)[320 * 200..] == first[320 * 200..], "the picture below");
    open.client.drop_file(open.window, &path);
    open.shows("the picture", LARGE, &first);
    let output = open.close();
    assert_eq!(output.status.code(), Some(0));
    assert!(stderr(&output).contains("broken.toml:"), "{}", stderr(&output));
}

#[test]
fn captures_are_the_rendered_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    std::fs::write(&path, SCENE.replace("[render]", "[render]\nsamples = 3")).unwrap();
    let first = rendered(&path, SIZE);
    let mut open = Open::new(&path, SIZE, &first);
    open.client.tap(F12);
    open.client.tap(F12);
    let output = open.close();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("amas_0001.png") && said.contains("amas_0002.exr"), "{said}");
    let exr = folder.path().join("want.exr");
    let rendered = amas(&["render", "--device", "llvmpipe", "-o"]).args([&exr, &path]).output().unwrap();
    assert!(rendered.status.success());
    for number in 1..=2 {
        let [png, linear] = ["png", "exr"].map(|kind| folder.path().join(format!("amas_000{number}.{kind}")));
        let seen: Vec<[u8; 3]> =
            image::open(png).unwrap().into_rgb8().pixels().map(|pixel| pixel.0).collect();
        assert_eq!(seen, first);
        assert_eq!(amas::HdrImage::load(&linear).unwrap(), amas::HdrImage::load(&exr).unwrap());
    }
}

/// The second start reads what the first has left, and says how long things took.
#[test]
fn pipelines_are_kept_and_starts_are_timed() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let cache = folder.path().join("cache");
    let display = Display::start();
    for _ in 0..2 {
        let output = amas(&["view", "--device", "llvmpipe", "--validate", "--frames", "2", "--startup"])
            .arg(&path)
            .env("DISPLAY", &display.name)
            .env("XDG_CACHE_HOME", &cache)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        for step in ["device", "scene read", "scene on the device", "first picture"] {
            assert!(said.contains(step), "{said}");
        }
        let kept: Vec<_> = cache.join("amas").read_dir().unwrap().collect();
        assert_eq!(kept.len(), 1);
        let name = kept[0].as_ref().unwrap().file_name().into_string().unwrap();
        assert!(name.starts_with("pipelines-"), "{name}");
    }
}

/// A list of what was shown, from one start to the next: the second of it is the one before.
#[test]
fn scenes_shown_before_are_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let [one, other] = ["one.toml", "other.toml"].map(|name| folder.path().join(name));
    std::fs::write(&one, SCENE).unwrap();
    std::fs::write(&other, SCENE.replace("[0.02, 0.05, 0.2]", "[0.2, 0.05, 0.02]")).unwrap();
    let pictures = [&one, &other].map(|path| rendered(path, SIZE));
    let display = Display::start();
    let mut client = display.connect();
    let mut open = |path: &Path, picture: &[[u8; 3]]| {
        let mut command = amas(&["view", "--device", "llvmpipe", "--validate"]);
        command.arg(path).env("DISPLAY", &display.name).env("XDG_STATE_HOME", folder.path());
        let view = View::of(command.spawn().unwrap());
        wait_until("the first picture", || display.corner([96, 64]) == picture);
        let window = client.window_of_size([96, 64]).unwrap();
        client.focus(window);
        view
    };
    let first = open(&one, &pictures[0]);
    first.signal("TERM");
    first.ends_well();
    let second = open(&other, &pictures[1]);
    let mut client = display.connect();
    client.tap(L);
    client.tap(TWO);
    wait_until("the scene before", || display.corner([96, 64]) == pictures[0]);
    client.tap(ESCAPE);
    second.ends_well();
    let kept = std::fs::read_to_string(folder.path().join("amas/recent")).unwrap();
    assert_eq!(kept, format!("{}\n{}\n", one.display(), other.display()));
}
