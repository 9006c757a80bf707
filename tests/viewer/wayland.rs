//! The window on a Wayland compositor without a screen.

use super::{View, amas, scene, stderr, wait_until};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A running weston.
struct Compositor {
    server: Child,
    folder: tempfile::TempDir,
}

impl Compositor {
    /// With a shell that leaves windows their size, or one that gives them the whole output.
    fn start(shell: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let server = Command::new("weston")
            .args(["--backend=headless-backend.so", "--width=200", "--height=140", "--idle-time=0"])
            .args(["--no-config", "--socket=amas-test", &format!("--shell={shell}")])
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
        let child = amas(&["view", "--device", "llvmpipe", "--validate"])
            .arg(scene)
            .args(arguments)
            .env("XDG_RUNTIME_DIR", self.folder.path())
            .env("WAYLAND_DISPLAY", "amas-test")
            .spawn()
            .unwrap();
        View::of(child)
    }
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
    for shell in ["desktop-shell.so", "kiosk-shell.so"] {
        for vsync in [&["--frames", "20"][..], &["--frames", "20", "--no-vsync"]] {
            Compositor::start(shell).open(&scene, vsync).ends_well();
        }
    }
}

/// Without a limit of frames it rests, and a signal ends it.
#[test]
fn a_wayland_window_ends_by_signal() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("kiosk-shell.so");
    let view = compositor.open(&scene, &[]);
    std::thread::sleep(std::time::Duration::from_secs(2));
    view.signal("TERM");
    view.ends_well();
}

/// A compositor that goes away takes the window along, without a crash.
#[test]
fn a_compositor_that_dies_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let compositor = Compositor::start("desktop-shell.so");
    let view = compositor.open(&scene, &[]);
    std::thread::sleep(std::time::Duration::from_secs(2));
    drop(compositor);
    let output = view.output();
    assert!(output.status.code().is_some_and(|code| code != 101), "{:?}: {}", output.status, stderr(&output));
}
