//! `amas view` on a display of its own: what is on screen, what keys and sizes do, and how it ends.
//!
//! The tests bring their own X server, even on a desktop: they read the screen back, and no window pops up.
#![cfg(feature = "viewer")]
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod cameras;
mod display;
mod exchange;
mod gathered;
mod loading;
mod overlay;
mod robust;
mod surface;
mod wayland;

use display::{Client, Display};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Both kinds of point light, and no symmetry that hides a flip or a swap of colours.
const SCENE: &str = r#"
[render]
size = [96, 64]
background = [0.02, 0.05, 0.2]

[[camera]]
name = "main"
position = [0.5, 1, 3]
target = [0, 0.4, 0]
vertical_fov = 45

[[material]]
name = "clay"
type = "plastic"
diffuse = [0.6, 0.3, 0.2]

[[mesh]]
shape = "plane"
size = [4, 4]
material = "clay"

[[mesh]]
shape = "box"
size = [0.6, 0.6, 0.6]
translate = [0.4, 0.3, 0]
material = "clay"

[[light]]
type = "point"
position = [-0.5, 1, 0.5]
intensity = [3, 2, 1]
range = 4

[[light]]
type = "point"
position = [2, 2, 2]
intensity = [1, 1, 2]
"#;

/// Longest wait for anything; validation makes the first picture slow.
const PATIENCE: Duration = Duration::from_secs(30);

/// Codes of keys on the keyboard of Xvfb.
const ESCAPE: u8 = 9;
const TWO: u8 = 11;
const W: u8 = 25;
const R: u8 = 27;
const O: u8 = 32;
const P: u8 = 33;
const D: u8 = 40;
const L: u8 = 46;
const C: u8 = 54;
const F5: u8 = 71;
const F12: u8 = 96;

fn amas(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_amas"));
    command
        .args(arguments)
        .env_remove("AMAS_DEVICE")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .env("XDG_STATE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn scene(folder: &Path) -> PathBuf {
    let path = folder.join("scene.toml");
    std::fs::write(&path, SCENE).unwrap();
    path
}

/// The picture that `amas render` makes of the scene.
fn rendered(scene: &Path, size: [u32; 2]) -> Vec<[u8; 3]> {
    rendered_from(scene, size, &[])
}

fn rendered_from(scene: &Path, size: [u32; 2], arguments: &[&str]) -> Vec<[u8; 3]> {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("picture.png");
    let size = format!("{}x{}", size[0], size[1]);
    let output = amas(&["render", "--device", "llvmpipe", "--size", &size, "-o"])
        .args([&picture, scene])
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let picture = image::open(picture).unwrap().into_rgb8();
    picture.pixels().map(|pixel| pixel.0).collect()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A running `amas view --validate`; killed if its test fails.
struct View(Option<Child>);

impl View {
    fn open(display: &Display, scene: &Path, arguments: &[&str]) -> Self {
        Self::open_plain(display, scene, &[&["--validate"], arguments].concat())
    }

    /// Without validation, which takes memory of its own.
    fn open_plain(display: &Display, scene: &Path, arguments: &[&str]) -> Self {
        let mut command = amas(&["view", "--device", "llvmpipe"]);
        command.arg(scene).args(arguments).env("DISPLAY", &display.name);
        // Where captures go.
        Self::of(command.current_dir(scene.parent().unwrap()).spawn().unwrap())
    }

    fn of(child: Child) -> Self {
        Self(Some(child))
    }

    /// `None` once it has ended.
    fn resident_kilobytes(&self) -> Option<u64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.id())).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
        line.trim().strip_suffix(" kB")?.parse().ok()
    }

    /// Processor time so far, hundredths of a second.
    fn ticks(&self) -> u64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.id())).unwrap();
        // After the name, which may hold anything: state is the third field, user and system time the 14th and 15th.
        let fields: Vec<&str> = stat.rsplit_once(") ").unwrap().1.split(' ').collect();
        [11, 12].iter().map(|&index| fields[index].parse::<u64>().unwrap()).sum()
    }

    fn id(&self) -> u32 {
        self.0.as_ref().unwrap().id()
    }

    fn has_ended(&mut self) -> bool {
        self.0.as_mut().unwrap().try_wait().unwrap().is_some()
    }

    fn signal(&self, name: &str) {
        let status = Command::new("kill").args(["-s", name, &self.id().to_string()]).status();
        assert!(status.unwrap().success());
    }

    /// Waits for its end, which has to be a good one.
    fn ends_well(self) {
        let output = self.output();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert_eq!(stderr(&output), "");
    }
}

impl View {
    /// Waits for its end.
    #[track_caller]
    fn output(mut self) -> Output {
        wait_until("the window's end", || self.has_ended());
        self.0.take().unwrap().wait_with_output().unwrap()
    }
}

impl Drop for View {
    fn drop(&mut self) {
        if let Some(mut child) = self.0.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// A window with the scene's first picture in it, and the keyboard.
struct Open {
    display: Display,
    client: Client,
    view: View,
    window: u32,
}

impl Open {
    /// At a size; waits for that picture.
    fn new(scene: &Path, size: [u32; 2], first: &[[u8; 3]]) -> Self {
        let display = Display::start();
        let mut client = display.connect();
        let view = View::open(&display, scene, &["--size", &format!("{}x{}", size[0], size[1])]);
        wait_until("the first picture", || display.corner(size.map(|side| side as usize)) == first);
        let window = client.window_of_size(size.map(|side| side as u16)).unwrap();
        client.focus(window);
        Self { display, client, view, window }
    }

    #[track_caller]
    fn shows(&self, what: &str, size: [u32; 2], picture: &[[u8; 3]]) {
        wait_until(what, || self.display.corner(size.map(|side| side as usize)) == picture);
    }

    fn close(mut self) -> Output {
        self.client.tap(ESCAPE);
        self.view.output()
    }

    fn ends_well(mut self) {
        self.client.tap(ESCAPE);
        self.view.ends_well();
    }
}

#[track_caller]
fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < PATIENCE, "in vain waited for {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn the_window_shows_the_rendered_picture() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let [first, larger] = [[96, 64], [120, 80]].map(|size| rendered(&scene, size));
    let display = Display::start();
    let mut client = display.connect();
    let view = View::open(&display, &scene, &[]);
    wait_until("the picture", || display.corner([96, 64]) == first);

    let window = client.window_of_size([96, 64]).unwrap();
    client.resize(window, [120, 80]);
    wait_until("the larger picture", || display.corner([120, 80]) == larger);

    client.focus(window);
    client.key(W, true);
    wait_until("a step forward", || display.corner([120, 80]) != larger);
    client.key(W, false);
    client.tap(ESCAPE);
    view.ends_well();
}

#[test]
fn the_window_closes_after_the_last_picture() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let display = Display::start();
    View::open(&display, &scene, &["--frames", "20"]).ends_well();
}

#[test]
fn without_a_display_the_advice_is_to_render() {
    let folder = tempfile::tempdir().unwrap();
    let output = amas(&["view"]).arg(scene(folder.path())).output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    for part in ["no display", "WAYLAND_DISPLAY", "remedy", "amas render"] {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}

#[test]
fn help_lists_the_keys() {
    let output = amas(&["view", "--help"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let keys = [
        "W A S D",
        "Q E",
        "drag",
        "right drag",
        "wheel",
        "pinch",
        "1 … 9",
        " P ",
        " R ",
        " C ",
        " V ",
        "F5",
        "F12",
        "Esc",
    ];
    for part in keys.into_iter().chain(["dropped", "Example"]) {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}
