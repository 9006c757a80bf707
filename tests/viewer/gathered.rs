//! Indirect light and point lights with shadows: gathered while the view rests, and out of the way while it moves.

use super::display::Display;
use super::{ESCAPE, F12, Open, P, R, SCENE, TWO, View, amas, rendered, rendered_from, stderr, wait_until};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const SIZE: [u32; 2] = [96, 64];
const ONE: u8 = 10;

/// What asks for it, in `[render]`.
const INDIRECT: &str = "indirect = { vpls = 4096, bounces = 3 }";
const SHADOWS: &str = "shadows = true";

/// A wall beside the box, which reflects.
const WALL: &str = "
[[mesh]]
shape = \"box\"
size = [0.1, 1.5, 2]
translate = [-0.9, 0.75, 0]
material = \"clay\"
";

/// A walk that stays where it begins: a view that moves, and is known.
const STROLL: &str = "
[[camera]]
name = \"stroll\"
position = [0.4, 1.1, 2.9]
target = [0, 0.4, 0]
vertical_fov = 45
path = [
  { t = 0.0, position = [0.4, 1.1, 2.9], target = [0, 0.4, 0] },
  { t = 1000.0, position = [0.4, 1.1, 2.9], target = [0, 0.4, 0] },
]
";

/// The scene with these keys of `[render]`.
fn scene(folder: &Path, keys: &[&str]) -> PathBuf {
    let path = folder.join("scene.toml");
    write(&path, keys);
    path
}

fn write(path: &Path, keys: &[&str]) {
    let render = format!("[render]\ntonemap = \"none\"\n{}\n", keys.join("\n"));
    std::fs::write(path, format!("{}{WALL}{STROLL}", SCENE.replace("[render]", &render))).unwrap();
}

/// The picture of its direct light, without shadows.
fn direct(path: &Path, size: [u32; 2]) -> Vec<[u8; 3]> {
    rendered_from(path, size, &["--set", "indirect.vpls=0", "--set", "shadows=false"])
}

/// Share of the pixels that differ by more than 2 of 255.
fn differing(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let off = a.iter().zip(b).filter(|(a, b)| (0..3).any(|i| a[i].abs_diff(b[i]) > 2));
    off.count() as f64 / a.len() as f64
}

/// Names of the threads of a process.
fn threads(view: &View) -> Vec<String> {
    let tasks = std::fs::read_dir(format!("/proc/{}/task", view.id())).unwrap();
    tasks.filter_map(|task| std::fs::read_to_string(task.unwrap().path().join("comm")).ok()).collect()
}

fn traces(view: &View) -> bool {
    threads(view).iter().any(|name| name.trim() == "lights")
}

/// Bias and root mean square error of a picture against another, both over its mean.
fn errors(picture: &Path, truth: &Path) -> [f64; 2] {
    let [a, b] = [picture, truth].map(|path| amas::HdrImage::load(path).unwrap().pixels.concat());
    let mean = b.iter().map(|&v| f64::from(v)).sum::<f64>() / b.len() as f64;
    let sum = |of: fn(f64) -> f64| {
        a.iter().zip(&b).map(|(&a, &b)| of(f64::from(a) - f64::from(b))).sum::<f64>() / a.len() as f64
    };
    [sum(|off| off) / mean, sum(|off| off * off).sqrt() / mean]
}

/// What the window shows converges to what `amas render` makes of the scene.
#[test]
fn the_picture_at_rest_is_the_rendered_one() {
    for keys in [&[INDIRECT, SHADOWS][..], &[SHADOWS]] {
        let folder = tempfile::tempdir().unwrap();
        let path = scene(folder.path(), keys);
        let truth = folder.path().join("truth.exr");
        let render = amas(&["render", "--device", "llvmpipe", "--indirect-error", "0.01", "-o"])
            .args([&truth, &path])
            .output()
            .unwrap();
        assert!(render.status.success(), "{}", stderr(&render));
        let mut open = Open::new(&path, SIZE, &direct(&path, SIZE));
        let mut count = 0;
        let mut capture = || {
            count += 1;
            open.client.tap(F12);
            let file = folder.path().join(format!("amas_{count:04}.exr"));
            wait_until("the capture", || file.exists());
            errors(&file, &truth)
        };
        let mut error = capture();
        let start = Instant::now();
        // Both have noise: the picture 1 %, the window less and less. A hundredth of the pixels are independent at least.
        let close = |[mean, rmse]: [f64; 2]| rmse <= 0.02 && mean.abs() < 0.003;
        while !close(error) && start.elapsed() < Duration::from_secs(120) {
            std::thread::sleep(Duration::from_millis(500));
            error = capture();
        }
        println!("{keys:?}: {error:?} after {:.1} s", start.elapsed().as_secs_f64());
        assert!(close(error), "{error:?}");
        open.ends_well();
    }
}

/// While the view moves, there is direct light and nothing else; then the rest comes back.
#[test]
fn moving_shows_direct_light() {
    for keys in [&[INDIRECT][..], &[INDIRECT, SHADOWS], &[SHADOWS]] {
        let folder = tempfile::tempdir().unwrap();
        let path = scene(folder.path(), keys);
        let first = direct(&path, SIZE);
        let off = ["--set", "indirect.vpls=0", "--set", "shadows=false", "--camera", "stroll"];
        let strolling = rendered_from(&path, SIZE, &off);
        let mut open = Open::new(&path, SIZE, &first);
        for _ in 0..3 {
            wait_until("gathered light", || differing(&open.display.corner([96, 64]), &first) > 0.2);
            open.client.tap(P);
            open.shows("direct light", SIZE, &strolling);
            std::thread::sleep(Duration::from_millis(200));
            assert_eq!(open.display.corner([96, 64]), strolling, "{keys:?}");
            open.client.tap(P);
            wait_until("gathered light", || differing(&open.display.corner([96, 64]), &strolling) > 0.2);
            open.client.tap(R);
        }
        open.ends_well();
    }
}

/// Switched off, nothing of it is left, no thread either; switched on, it comes back.
#[test]
fn what_is_off_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &[]);
    let first = rendered(&path, SIZE);
    let open = Open::new(&path, SIZE, &first);
    assert!(!traces(&open.view));
    for keys in [&[INDIRECT][..], &[SHADOWS]] {
        write(&path, keys);
        wait_until("gathered light", || differing(&open.display.corner([96, 64]), &first) > 0.2);
        write(&path, &[]);
        open.shows("direct light", SIZE, &first);
        wait_until("the thread's end", || !traces(&open.view));
    }
    open.ends_well();
}

/// Milliseconds of CPU time that a process has used; `None` once it has ended.
fn cpu_ms(view: &View) -> Option<u64> {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", view.id())).ok()?;
    let fields: Vec<&str> = stat.rsplit_once(") ")?.1.split(' ').collect();
    // In hundredths of a second; a process that has ended and is not waited for keeps its own.
    Some((fields.get(11)?.parse::<u64>().ok()? + fields.get(12)?.parse::<u64>().ok()?) * 10)
}

/// The window does not wait for lights that nobody will see.
#[test]
fn closing_does_not_wait_for_lights() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &["indirect = { vpls = 1048576, bounces = 8 }"]);
    let mut open = Open::new(&path, SIZE, &direct(&path, SIZE));
    wait_until("the thread", || traces(&open.view));
    std::thread::sleep(Duration::from_millis(300));
    let (start, before) = (Instant::now(), cpu_ms(&open.view).unwrap());
    open.client.tap(ESCAPE);
    let mut last = before;
    wait_until("the end", || {
        last = cpu_ms(&open.view).map_or(last, |now| last.max(now));
        open.view.has_ended()
    });
    println!("ended after {:.0} ms, {} ms of CPU time", start.elapsed().as_secs_f64() * 1e3, last - before);
    // A round of so many lights takes some seconds.
    assert!(last - before < 1000, "{} ms", last - before);
    open.view.ends_well();
}

/// How soon a camera's first picture is on screen: `cargo test --release --test viewer response -- --ignored --nocapture`.
/// Environment: AMAS_SCENE, a scene with two cameras of the same kind.
#[test]
#[ignore = "measures"]
fn response() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scene = std::env::var("AMAS_SCENE").map_or(root.join("scenes/default.toml"), PathBuf::from);
    let size = [640, 360];
    for vpls in ["0", "1048576", "0", "1048576"] {
        let display = Display::of_size(size);
        let mut client = display.connect();
        let set = format!("indirect.vpls={vpls}");
        let options = ["--size", "640x360", "--set", "samples=1", "--set", &set];
        let view = View::open_plain(&display, &scene, &options);
        let mut window = None;
        wait_until("the window", || {
            window = client.window_of_size([640, 360]);
            window.is_some()
        });
        client.focus(window.unwrap());
        std::thread::sleep(Duration::from_secs(20));
        let mut taken = Vec::new();
        for step in 0..20 {
            // Cameras differ so much that most pixels change.
            let before = display.corner(size);
            let start = Instant::now();
            client.tap(if step % 2 == 0 { TWO } else { ONE });
            wait_until("the other view", || differing(&display.corner(size), &before) > 0.5);
            taken.push(start.elapsed().as_secs_f64() * 1e3);
            std::thread::sleep(Duration::from_millis(400 + 173 * step % 1100));
        }
        taken.sort_by(f64::total_cmp);
        println!("vpls {vpls}: median {:.0} ms, worst {:.0} ms", 0.5 * (taken[9] + taken[10]), taken[19]);
        client.tap(ESCAPE);
        view.ends_well();
    }
}

/// The README's picture of the window with indirect light, as far as it is after a minute and a half; see `screenshots`.
#[test]
#[ignore = "writes docs/view"]
fn screenshots_of_gathered_light() {
    const O: u8 = 32;
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let size = [960, 540];
    let display = Display::of_size(size);
    let mut client = display.connect();
    let options = ["--size", "960x540", "--set", "indirect.vpls=65536", "--set", "samples=1"];
    let view = View::open_plain(&display, &root.join("scenes/default.toml"), &options);
    let mut window = None;
    wait_until("the window", || {
        window = client.window_of_size([960, 540]);
        window.is_some()
    });
    client.focus(window.unwrap());
    std::thread::sleep(Duration::from_secs(5));
    client.tap(O);
    std::thread::sleep(Duration::from_secs(90));
    let bytes = display.corner(size).concat();
    image::save_buffer(root.join("docs/view/indirect.png"), &bytes, 960, 540, image::ColorType::Rgb8)
        .unwrap();
    client.tap(ESCAPE);
    view.ends_well();
}
