//! The window on a Wayland compositor without a screen.

use super::display::Display;
use super::{SCENE, View, amas, rendered, scene, stderr, wait_until};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A running weston.
struct Compositor {
    server: Child,
    folder: tempfile::TempDir,
}

impl Compositor {
    /// With a shell that leaves windows their size, or one that gives them the whole output.
    fn start(shell: &str) -> Self {
        Self::with(shell, 1)
    }

    /// On an output of that scale.
    fn with(shell: &str, scale: u32) -> Self {
        let scale = format!("--scale={scale}");
        let headless =
            ["--backend=headless-backend.so", "--width=200", "--height=140", "--no-config", &scale];
        Self::launch(tempfile::tempdir().unwrap(), shell, Command::new("weston").args(headless))
    }

    /// With two outputs, the first of scale 1, the second of scale 2 to its right: windows of an X server, with its keyboard
    /// and pointer.
    fn with_two_outputs(display: &Display) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let config = folder.path().join("weston.ini");
        let output = |name: &str, scale: u32| format!("[output]\nname={name}\nmode=200x140\nscale={scale}\n");
        let shell = "[shell]\npanel-position=none\nanimation=none\nstartup-animation=none\nlocking=false\n";
        std::fs::write(&config, [shell, &output("X1", 1), &output("X2", 2)].concat()).unwrap();
        let mut command = Command::new("weston");
        command.args(["--backend=x11-backend.so", "--use-pixman", "--output-count=2"]);
        command.arg(format!("--config={}", config.display())).env("DISPLAY", &display.name);
        Self::launch(folder, "desktop-shell.so", &mut command)
    }

    fn launch(folder: tempfile::TempDir, shell: &str, command: &mut Command) -> Self {
        let server = command
            .args(["--idle-time=0", "--socket=amas-test", &format!("--shell={shell}")])
            .env("XDG_RUNTIME_DIR", folder.path())
            .env_remove("WAYLAND_DISPLAY")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("weston: {error}; run ./setup, which installs it"));
        let compositor = Self { server, folder };
        wait_until("weston", || compositor.folder.path().join("amas-test").exists());
        compositor
    }

    fn open(&self, scene: &Path, arguments: &[&str]) -> View {
        View::of(self.command(scene).args(arguments).spawn().unwrap())
    }

    /// Says in a file what it tells the compositor.
    fn open_telling(&self, scene: &Path) -> View {
        let said = std::fs::File::create(told(scene)).unwrap();
        View::of(self.command(scene).env("WAYLAND_DEBUG", "client").stderr(said).spawn().unwrap())
    }

    fn command(&self, scene: &Path) -> Command {
        let mut command = amas(&["view", "--device", "llvmpipe", "--validate"]);
        command.arg(scene).env("XDG_RUNTIME_DIR", self.folder.path()).env("WAYLAND_DISPLAY", "amas-test");
        command
    }
}

/// Beside the scene.
fn told(scene: &Path) -> PathBuf {
    scene.with_extension("log")
}

impl Drop for Compositor {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

#[test]
fn a_wayland_window_shows_pictures_and_closes() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("desktop-shell.so");
    for vsync in [&["--frames", "20"][..], &["--frames", "20", "--no-vsync"]] {
        compositor.open(&scene, vsync).ends_well();
    }
}

/// A scene that asks for another size gets it; a signal ends the window that rests.
#[test]
fn a_wayland_window_follows_its_scene() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("desktop-shell.so");
    let view = compositor.open_telling(&scene);
    wait_until("the first size", || sizes(&scene).last().is_some_and(|size| size == "96, 64"));
    std::fs::write(&scene, SCENE.replace("[96, 64]", "[120, 80]")).unwrap();
    wait_until("the second size", || sizes(&scene).last().is_some_and(|size| size == "120, 80"));
    view.signal("TERM");
    assert_eq!(view.output().status.code(), Some(0));
}

/// This shell gives windows the whole output. Without a seat it keeps them behind its background and asks for no picture: a
/// hidden window ends, too.
#[test]
fn a_wayland_window_takes_the_size_that_it_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("kiosk-shell.so");
    let view = compositor.open_telling(&scene);
    wait_until("the size", || sizes(&scene).last().is_some_and(|size| size == "200, 140"));
    view.signal("TERM");
    assert_eq!(view.output().status.code(), Some(0));
}

/// Which sizes the images of a window had so far that tells what it does, in order.
fn sizes(scene: &Path) -> Vec<String> {
    let said = std::fs::read_to_string(told(scene)).unwrap();
    // Of libwayland: -> wl_shm_pool@40.create_buffer(new id wl_buffer@42, 0, 200, 140, 832, 1)
    let buffers =
        said.lines().filter_map(|line| line.split_once("create_buffer(new id ")?.1.split_once(", 0, "));
    let mut sizes: Vec<String> =
        buffers.filter_map(|(_, rest)| Some(rest.rsplitn(3, ", ").last()?.to_owned())).collect();
    // Title bars.
    sizes.retain(|size| !size.ends_with(", 24"));
    sizes.dedup();
    sizes
}

/// The window learns of the output's scale once it is on it, and keeps its size in points: twice the pixels.
#[test]
fn a_wayland_window_follows_the_scale_of_its_output() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::with("desktop-shell.so", 2);
    let view = compositor.open_telling(&scene);
    wait_until("the size", || sizes(&scene).last().is_some_and(|size| size == "192, 128"));
    view.signal("TERM");
    assert_eq!(view.output().status.code(), Some(0));
}

/// From an output of scale 1 to one of scale 2 and back, dragged there as users do it: twice the pixels, half of them again.
#[test]
fn a_wayland_window_follows_the_scales_of_two_outputs() {
    /// Left "super", with which weston moves windows.
    const SUPER: u8 = 133;
    /// In the lower right corner of the second output, where no window is in this test.
    const ASIDE: [u16; 2] = [595, 275];
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let display = Display::of_size([640, 320]);
    let compositor = Compositor::with_two_outputs(&display);
    let mut client = display.connect();
    let mut outputs = None;
    wait_until("the outputs", || {
        outputs = client.window_of_size([200, 140]).zip(client.window_of_size([400, 280]));
        outputs.is_some()
    });
    client.place(outputs.unwrap().1, [200, 0]);
    let [small, large] = [[96, 64], [192, 128]].map(|size| rendered(&scene, size));
    // New windows open where the pointer is.
    client.point([10, 10]);
    let view = compositor.open_telling(&scene);
    let told = || std::fs::read_to_string(told(&scene)).unwrap();
    wait_until("the window", || told().contains("enter(wl_output"));
    client.point(ASIDE);
    // Where a picture's upper left corner is on the screen.
    let find = |picture: &[[u8; 3]], [width, height]: [usize; 2]| {
        let screen = display.corner([640, 280]);
        let begins = |&at: &usize| (0..width).all(|x| screen.get(at + x) == Some(&picture[x]));
        let same = |&at: &usize| {
            (0..height).all(|y| {
                screen.get(at + 640 * y..at + 640 * y + width) == Some(&picture[width * y..][..width])
            })
        };
        (0..screen.len()).filter(begins).find(same).map(|at| [(at % 640) as u16, (at / 640) as u16])
    };
    let wait = |what: &str, picture: &[[u8; 3]], size: [usize; 2]| {
        let mut found = None;
        wait_until(what, || {
            found = find(picture, size);
            found.is_some()
        });
        found.unwrap()
    };
    let mut drag = |from: [u16; 2], to: u16| {
        client.point(from);
        client.key(SUPER, true);
        client.button(1, true);
        for step in 1..=8 {
            std::thread::sleep(Duration::from_millis(30));
            let x = i32::from(from[0]) + (i32::from(to) - i32::from(from[0])) * step / 8;
            client.point([x as u16, from[1]]);
        }
        client.button(1, false);
        client.key(SUPER, false);
        // It hides a part of the picture.
        std::thread::sleep(Duration::from_millis(300));
        client.point(ASIDE);
    };
    let [x, y] = wait("the picture at scale 1", &small, [96, 64]);
    // The pointer does not leave its output while a button is down: its left end stays behind at first.
    drag([x + 2, y + 32], 198);
    wait_until("twice the pixels", || sizes(&scene).last().is_some_and(|size| size == "192, 128"));
    let y = 2 * (y + 32);
    drag([260, y], 330);
    let [x, _] = wait("the picture at scale 2", &large, [192, 128]);
    assert!(x >= 200, "{x}");
    drag([x + 190, y], 202);
    drag([150, y / 2], 100);
    wait("the picture at scale 1 again", &small, [96, 64]);
    view.signal("TERM");
    assert_eq!(view.output().status.code(), Some(0));
}

/// A compositor that goes away takes the window along, without a crash.
#[test]
fn a_compositor_that_dies_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("desktop-shell.so");
    let view = compositor.open(&scene, &[]);
    std::thread::sleep(Duration::from_secs(2));
    drop(compositor);
    let output = view.output();
    let said = stderr(&output);
    assert!(output.status.code().is_some_and(|code| code != 0 && code != 101), "{:?}: {said}", output.status);
    assert!(said.contains("remedy"), "{said}");
}
