//! What is drawn over the picture, and in its place: panels, debug views, comparisons, and shaders that change.

use super::display::Display;
use super::{ESCAPE, O, Open, SCENE, View, amas, rendered, scene, stderr, wait_until};
use std::path::Path;

const SIZE: [u32; 2] = [320, 240];

const I: u8 = 31;
const G: u8 = 42;
const X: u8 = 53;
const B: u8 = 56;
const F1: u8 = 67;

/// Keys of the debug views, and the output variables that they show.
const VIEWS: [(u8, &str); 11] = [
    (68, "albedo"),
    (69, "normal"),
    (70, "roughness"),
    (72, "depth"),
    (73, "slice"),
    (74, "cluster"),
    (75, "light_count"),
    (76, "pair_ratio"),
    (95, "light_error"),
    (B, "ltc_bound"),
    (G, "wireframe"),
];

const AREA_LIGHT: &str = "
[[light]]
type = \"rect\"
center = [-1, 1.5, 0]
u = [0.3, 0, 0]
v = [0, 0, 0.3]
radiance = [3, 3, 3]
visible = true
";

/// Rows that the legend leaves free.
fn upper(pixels: &[[u8; 3]]) -> &[[u8; 3]] {
    &pixels[..SIZE[0] as usize * 140]
}

/// Share of the pixels that differ by more than 1 of 255.
fn differing<'a>(a: impl Iterator<Item = &'a [u8; 3]>, b: impl Iterator<Item = &'a [u8; 3]>) -> f64 {
    let pairs: Vec<bool> = a.zip(b).map(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1)).collect();
    pairs.iter().filter(|off| **off).count() as f64 / pairs.len() as f64
}

fn open(scene: &Path, first: &[[u8; 3]], arguments: &[&str]) -> Open {
    let display = Display::start();
    let mut client = display.connect();
    let view = View::open(&display, scene, &[&["--size", "320x240"], arguments].concat());
    wait_until("the first picture", || display.corner([320, 240]) == first);
    let window = client.window_of_size([320, 240]).unwrap();
    client.focus(window);
    Open { display, client, view, window }
}

impl Open {
    fn screen(&self) -> Vec<[u8; 3]> {
        self.display.corner([320, 240])
    }
}

/// Every panel opens, and none leaves a trace.
#[test]
fn a_hidden_overlay_leaves_the_picture_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let first = rendered(&path, SIZE);
    let mut open = open(&path, &first, &[]);
    open.client.tap(O);
    wait_until("the panels", || differing(open.screen().iter(), first.iter()) > 0.2);
    let panels = open.screen();
    open.client.tap(F1);
    wait_until("the keys", || differing(open.screen().iter(), panels.iter()) > 0.1);
    open.client.tap(F1);
    open.client.tap(O);
    open.shows("the picture", SIZE, &first);
    // The box, which is a material: its values are shown, and the panels with them.
    open.client.point([170, 130]);
    open.client.tap(I);
    wait_until("the panels again", || differing(open.screen().iter(), first.iter()) > 0.2);
    // Out of the way of what is compared.
    open.client.point([319, 239]);
    open.client.tap(O);
    wait_until("the picture again", || differing(upper(&open.screen()).iter(), upper(&first).iter()) == 0.0);
    open.ends_well();
}

#[test]
fn debug_views_are_the_output_variables() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    std::fs::write(&path, format!("{SCENE}{AREA_LIGHT}")).unwrap();
    let file = |name: &str| folder.path().join(format!("{name}.png"));
    let mut render = amas(&["render", "--device", "llvmpipe", "--size", "320x240", "-o"]);
    render.arg(file("picture")).arg(&path);
    for (_, name) in VIEWS {
        render.arg("--aov").arg(format!("{name}={}", file(name).display()));
    }
    let output = render.output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let load = |name: &str| -> Vec<[u8; 3]> {
        image::open(file(name)).unwrap().into_rgb8().pixels().map(|pixel| pixel.0).collect()
    };
    let first = load("picture");
    let mut open = open(&path, &first, &[]);
    for (key, name) in VIEWS {
        let want = load(name);
        open.client.tap(key);
        let same = || differing(upper(&open.screen()).iter(), upper(&want).iter()) == 0.0;
        wait_until(name, same);
    }
    open.client.tap(VIEWS[VIEWS.len() - 1].0);
    open.shows("the picture", SIZE, &first);
    open.ends_well();
}

/// Left the picture, right that of a file: of the same scene under other light.
#[test]
fn a_file_stands_beside_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let [other, truth] = ["other.toml", "truth.exr"].map(|name| folder.path().join(name));
    std::fs::write(&other, SCENE.replace("[3, 2, 1]", "[1, 2, 3]")).unwrap();
    let output =
        amas(&["render", "--device", "llvmpipe", "--size", "320x240", "-o"]).args([&truth, &other]).output();
    assert!(output.unwrap().status.success());
    let (first, second) = (rendered(&path, SIZE), rendered(&other, SIZE));
    let mut open = open(&path, &first, &["--compare", &truth.display().to_string()]);
    // But for the line between them.
    let column = |index: usize| index % SIZE[0] as usize;
    let half = |screen: &[[u8; 3]], left: bool| -> Vec<[u8; 3]> {
        let pixels = upper(screen).iter().enumerate();
        let of =
            |&(index, _): &(usize, &[u8; 3])| if left { column(index) < 155 } else { column(index) > 165 };
        pixels.filter(of).map(|(_, pixel)| *pixel).collect()
    };
    open.client.tap(X);
    wait_until("both", || {
        let screen = open.screen();
        let off = |left, want: &[[u8; 3]]| {
            let (have, want) = (half(&screen, left), half(want, left));
            differing(have.iter(), want.iter())
        };
        off(true, &first) == 0.0 && off(false, &second) == 0.0
    });
    open.client.tap(X);
    wait_until("the difference", || differing(upper(&open.screen()).iter(), upper(&first).iter()) > 0.5);
    open.client.tap(X);
    open.shows("the picture", SIZE, &first);
    open.ends_well();
}

/// The oracle, computed meanwhile, agrees with the picture: but for outlines, which pixels' centres hit or miss.
#[test]
fn the_reference_stands_beside_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let first = rendered(&path, SIZE);
    let mut open = open(&path, &first, &[]);
    open.client.tap(X);
    wait_until("the split", || differing(open.screen().iter(), first.iter()) > 0.01);
    wait_until("the reference", || differing(upper(&open.screen()).iter(), upper(&first).iter()) < 0.01);
    open.client.tap(X);
    // Black: no error.
    wait_until("no difference", || {
        let screen = open.screen();
        let dark = upper(&screen).iter().filter(|pixel| pixel.iter().all(|v| *v < 8)).count();
        dark as f64 > 0.97 * upper(&screen).len() as f64
    });
    open.ends_well();
}

/// A broken shader is reported over the picture, which stays; a good one is used; the old one is, too, once it is back.
#[test]
fn shaders_change_under_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let glsl = folder.path().join("glsl");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl"), &glsl);
    let present = glsl.join("present/encode.glsl");
    let text = std::fs::read_to_string(&present).unwrap();
    let first = rendered(&path, SIZE);
    let mut open = open(&path, &first, &["--glsl", &glsl.display().to_string()]);

    std::fs::write(&present, text.replace("return vec4(c, 1.0);", "return vec4(d, 1.0);")).unwrap();
    wait_until("the error", || differing(upper(&open.screen()).iter(), upper(&first).iter()) > 0.05);
    let screen = open.screen();
    assert_eq!(screen[screen.len() - 320..], first[first.len() - 320..], "the picture stays below");

    let swapped = text.replace("return vec4(c, 1.0);", "return vec4(c.bgr, 1.0);");
    assert_ne!(swapped, text);
    std::fs::write(&present, swapped).unwrap();
    let want: Vec<[u8; 3]> = first.iter().map(|&[r, g, b]| [b, g, r]).collect();
    open.shows("red and blue swapped", SIZE, &want);
    std::fs::write(&present, text).unwrap();
    open.shows("the picture", SIZE, &first);
    open.client.tap(ESCAPE);
    open.view.ends_well();
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in from.read_dir().unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(&path, &target).unwrap();
        }
    }
}

/// The README's pictures of the window: `cargo test --release --test viewer screenshots -- --ignored`.
#[test]
#[ignore = "writes docs/view"]
fn screenshots() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let docs = root.join("docs/view");
    std::fs::create_dir_all(&docs).unwrap();
    let (width, height) = (960, 540);
    let display = Display::of_size([width, height]);
    let mut client = display.connect();
    let view = View::open_plain(&display, &root.join("scenes/light_grid.toml"), &["--size", "960x540"]);
    let screen = || display.corner([width, height]);
    let dark =
        |screen: &[[u8; 3]]| screen.iter().all(|pixel| pixel.iter().all(|v| *v < 64) || pixel[0] > 190);
    wait_until("the window", || client.window_of_size([width as u16, height as u16]).is_some());
    let window = client.window_of_size([width as u16, height as u16]).unwrap();
    client.focus(window);
    wait_until("the picture", || !dark(&screen()));
    let mut shoot = |keys: &[u8], name: &str, seconds: u64| {
        keys.iter().for_each(|&key| client.tap(key));
        std::thread::sleep(std::time::Duration::from_secs(seconds));
        let bytes = screen().concat();
        let file = docs.join(name);
        image::save_buffer(file, &bytes, width as u32, height as u32, image::ColorType::Rgb8).unwrap();
    };
    const LIGHTS: u8 = 75;
    shoot(&[O], "panels.png", 6);
    shoot(&[O, LIGHTS], "lights.png", 6);
    // The oracle takes its time.
    shoot(&[LIGHTS, X], "split.png", 25);
    client.tap(ESCAPE);
    view.ends_well();
}
