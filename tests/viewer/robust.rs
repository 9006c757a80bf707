//! What happens to windows: sizes, places, signals, a long run.

use super::display::Display;
use super::{O, SCENE, View, amas, rendered, scene, stderr, wait_until};
use std::time::Duration;

/// Numbers that look random and are the same on every run (Knuth's MMIX generator, upper bits).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(end)) as u32
    }
}

/// 200 sizes, faster than pictures follow, and then the picture of the last.
#[test]
fn any_size_is_survived() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let last = rendered(&scene, [120, 80]);
    let display = Display::start();
    let mut client = display.connect();
    let view = View::open(&display, &scene, &[]);
    let mut window = None;
    wait_until("the window", || {
        window = client.window_of_size([96, 64]);
        window.is_some()
    });
    let window = window.unwrap();
    let mut numbers = Numbers(5);
    for step in 0..200 {
        let size = match step % 20 {
            0 => [1, 1],
            1 => [400, 1],
            2 => [1, 300],
            _ => [1 + numbers.below(300), 1 + numbers.below(200)],
        };
        client.resize(window, size);
        client.place(window, [numbers.below(100), numbers.below(100)]);
        // Some sizes in a row without a picture, some with one in between.
        std::thread::sleep(Duration::from_millis(u64::from(numbers.below(40))));
    }
    client.resize(window, [120, 80]);
    client.place(window, [0, 0]);
    wait_until("the picture of the last size", || display.corner([120, 80]) == last);
    view.signal("TERM");
    view.ends_well();
}

#[test]
fn signals_close_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let picture = rendered(&scene, [96, 64]);
    for (name, arguments) in [("INT", &[][..]), ("TERM", &["--no-vsync", "--hdr"])] {
        let display = Display::start();
        let view = View::open(&display, &scene, arguments);
        wait_until("the picture", || display.corner([96, 64]) == picture);
        view.signal(name);
        let output = view.output();
        assert_eq!(output.status.code(), Some(0), "{name}");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(said.contains("no high dynamic range"), arguments.contains(&"--hdr"), "{said}");
    }
}

/// Memory of a window whose pictures never rest: that of the last quarter of its time is that of the second.
#[test]
fn a_long_run_takes_no_more_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    std::fs::write(&path, SCENE.replace("[render]", "[render]\nsamples = 7")).unwrap();
    let display = Display::start();
    let mut view = View::open_plain(&display, &path, &["--frames", "2000", "--no-vsync"]);
    let mut resident = Vec::new();
    while !view.has_ended() {
        resident.extend(view.resident_kilobytes());
        std::thread::sleep(Duration::from_millis(10));
    }
    view.ends_well();
    let quarter = resident.len() / 4;
    assert!(quarter > 5, "{} readings", resident.len());
    let median = |readings: &[u64]| {
        let mut sorted = readings.to_vec();
        sorted.sort_unstable();
        sorted[sorted.len() / 2] as f64
    };
    let ratio = median(&resident[3 * quarter..]) / median(&resident[quarter..2 * quarter]);
    println!("{} readings, ratio {ratio:.4}", resident.len());
    assert!((0.98..1.02).contains(&ratio), "{ratio}");
}

/// Memory of a window whose scene changes again and again. The first loads find out how much two pictures take, the one that
/// is there and the one that takes its place.
#[test]
fn reloads_take_no_more_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path());
    let display = Display::start();
    let view = View::open_plain(&display, &path, &[]);
    let background = || display.corner([1, 1])[0];
    let waiting = [[0; 3], [24; 3]];
    wait_until("the picture", || !waiting.contains(&background()));
    let mut resident = Vec::new();
    for reload in 0..50 {
        let before = background();
        // Written under another name: a reload never sees half of it.
        let next = path.with_extension("next");
        let shade = 0.1 + 0.8 * f64::from(reload % 2);
        std::fs::write(&next, SCENE.replace("[0.02, 0.05, 0.2]", &format!("[{shade}, 0.05, 0.2]"))).unwrap();
        std::fs::rename(&next, &path).unwrap();
        wait_until("the reload", || background() != before);
        // The picture before has gone once the next event is handled.
        std::thread::sleep(Duration::from_millis(50));
        resident.push(view.resident_kilobytes().unwrap() as f64);
    }
    view.signal("TERM");
    view.ends_well();
    let ratio = resident[49] / resident[4];
    println!("{resident:?} kB, ratio {ratio:.4}");
    assert!((0.98..1.02).contains(&ratio), "{ratio}");
}

/// By another program, without asking.
#[test]
fn a_destroyed_window_ends_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let picture = rendered(&scene, [96, 64]);
    let display = Display::start();
    let view = View::open(&display, &scene, &[]);
    wait_until("the picture", || display.corner([96, 64]) == picture);
    let mut client = display.connect();
    let window = client.window_of_size([96, 64]).unwrap();
    client.destroy(window);
    view.ends_well();
}

/// Lights that move, so that pictures follow one another without a pause.
fn moving(folder: &std::path::Path) -> std::path::PathBuf {
    let path = folder.join("moving.toml");
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 500, seed = 1, min = [-2, 0.1, -2], max = [2, 1, 2], intensity = [0.1, 0.2], range = 0.5 }\nanimate = { type = \"drift\", speed = 0.5, seed = 1 }\n";
    std::fs::write(&path, format!("{SCENE}{lights}")).unwrap();
    path
}

/// At any moment: before the first picture, while pictures follow one another, with and without panels. The driver may know
/// before the window does, and fail to draw.
#[test]
fn a_window_destroyed_while_it_is_drawn_ends_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let scene = moving(folder.path());
    let display = Display::start();
    let mut client = display.connect();
    let mut numbers = Numbers(7);
    for kill in 0..30 {
        let plain = kill % 5 != 0;
        let arguments = if kill % 2 == 0 { &["--no-vsync"][..] } else { &[] };
        let view = match plain {
            true => View::open_plain(&display, &scene, arguments),
            false => View::open(&display, &scene, arguments),
        };
        let mut window = None;
        wait_until("the window", || {
            window = client.window_of_size([96, 64]);
            window.is_some()
        });
        let window = window.unwrap();
        if kill % 3 != 0 {
            wait_until("the picture", || ![[0; 3], [24; 3]].contains(&display.corner([1, 1])[0]));
            client.focus(window);
        }
        if kill % 3 == 2 {
            client.tap(O);
        }
        std::thread::sleep(Duration::from_millis(u64::from(numbers.below(300))));
        client.destroy(window);
        let output = view.output();
        assert_eq!(output.status.code(), Some(0), "kill {kill}: {}", stderr(&output));
        assert_eq!(stderr(&output), "", "kill {kill}");
        wait_until("an empty screen", || client.window_of_size([96, 64]).is_none());
    }
}

/// A window of a scene that moves, in front of the others.
fn moves(display: &Display, what: &str) {
    let before = display.corner([96, 64]);
    wait_until(what, || display.corner([96, 64]) != before);
}

/// Hundredths of a second that a window takes of a second, once what was under way is done.
fn ticks_at_rest(view: &View) -> u64 {
    std::thread::sleep(Duration::from_millis(500));
    let before = view.ticks();
    std::thread::sleep(Duration::from_secs(1));
    let spent = view.ticks() - before;
    println!("{spent} ticks of 100 at rest");
    spent
}

/// Behind another window and minimised nothing is drawn, though the scene moves; once it is seen again, it goes on.
#[test]
fn a_window_that_nobody_sees_rests() {
    let folder = tempfile::tempdir().unwrap();
    let scene = moving(folder.path());
    let display = Display::start();
    let view = View::open(&display, &scene, &[]);
    wait_until("the picture", || ![[0; 3], [24; 3]].contains(&display.corner([1, 1])[0]));
    let mut client = display.connect();
    moves(&display, "a picture that moves");
    let cover = client.cover([320, 240]);
    assert!(ticks_at_rest(&view) <= 3);
    client.destroy(cover);
    moves(&display, "a picture that moves again");
    let window = client.window_of_size([96, 64]).unwrap();
    client.minimise(window, true);
    assert!(ticks_at_rest(&view) <= 3);
    client.minimise(window, false);
    moves(&display, "a picture that moves once more");
    client.ask_to_close(window);
    view.ends_well();
}

/// Whether pictures wait for the display is changed while they follow one another.
#[test]
fn pictures_go_on_with_and_without_waiting_for_the_display() {
    const V: u8 = 55;
    let folder = tempfile::tempdir().unwrap();
    let scene = moving(folder.path());
    let display = Display::start();
    let view = View::open(&display, &scene, &[]);
    wait_until("the picture", || ![[0; 3], [24; 3]].contains(&display.corner([1, 1])[0]));
    let mut client = display.connect();
    let window = client.window_of_size([96, 64]).unwrap();
    client.focus(window);
    for _ in 0..4 {
        client.tap(V);
        moves(&display, "a picture that moves");
    }
    client.ask_to_close(window);
    view.ends_well();
}

/// Without a driver there is nothing to show pictures on.
#[test]
fn without_a_driver_the_advice_is_to_render() {
    let folder = tempfile::tempdir().unwrap();
    let display = Display::start();
    let mut command = amas(&["view"]);
    command.arg(scene(folder.path())).env("DISPLAY", &display.name);
    // The loader's name for it, and the one before.
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(name, folder.path().join("none.json"));
    }
    let output = command.output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    for part in ["VK_KHR_surface", "remedy", "amas render"] {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}
