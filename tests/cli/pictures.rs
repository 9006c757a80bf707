//! What `amas render` and `amas reference` write.

use crate::{Folder, Run, SCENE, picture};

/// The pixel right of and below the middle, which sees the floor under the light.
const MIDDLE: usize = 24 * 64 + 32;

/// Albedo/π · intensity · (1 − (d/range)⁴)²/d² · cos θ, in the terms of the scene.
fn matte_under_point([x, y, z]: [f32; 3], intensity: f32) -> f32 {
    let height = 1.0 - y;
    let d2 = x * x + height * height + z * z;
    let window = (1.0 - (d2 / (1.5 * 1.5)).powi(2)).powi(2);
    0.5 / std::f32::consts::PI * intensity * window / d2 * height / d2.sqrt()
}

#[test]
fn formats_and_sizes() {
    let folder = Folder::new();
    let outputs = ["-o", "a.png", "-o", "a.exr", "-o", "A.PFM"];
    let others = ["--set", "tonemap=none", "--aov", "position=p.exr"];
    folder.done(&[&["render", "scene.toml"], &outputs[..], &others].concat());
    let names = ["A.PFM", "a.exr", "a.png", "p.exr", "scene.toml"];
    assert_eq!(folder.names(), names);
    let [png, exr, pfm] = ["a.png", "a.exr", "A.PFM"].map(|name| picture(&folder.path(name)));
    assert_eq!((exr.width, exr.height), (64, 48));
    assert_eq!(exr, pfm);
    let position = picture(&folder.path("p.exr")).pixels[MIDDLE];
    let expected = [3.0, 2.0, 1.0].map(|intensity| matte_under_point(position, intensity));
    for (value, expected) in exr.pixels[MIDDLE].iter().zip(expected) {
        assert!((value / expected - 1.0).abs() < 1e-5, "{value} {expected}");
    }
    let decoded = image::open(folder.path("a.png")).unwrap();
    assert_eq!(decoded.color(), image::ColorType::Rgb8);
    // Half a step of 8 bits is at most 0.0046 in linear light.
    for (display, linear) in png.pixels.iter().zip(&exr.pixels) {
        for (display, linear) in display.iter().zip(linear) {
            assert!((display - linear.min(1.0)).abs() < 0.005, "{display} {linear}");
        }
    }
}

#[test]
fn size_by_option_and_by_set() {
    let folder = Folder::new();
    for (words, size) in [
        (["--size", "20x10"], (20, 10)),
        (["--size", "1x1"], (1, 1)),
        (["--set", "size=[9, 7]"], (9, 7)),
        (["--set", "render.size=[33, 1]"], (33, 1)),
    ] {
        folder.done(&[&["render", "scene.toml", "-o", "a.exr"], &words[..]].concat());
        let picture = picture(&folder.path("a.exr"));
        assert_eq!((picture.width, picture.height), size);
    }
}

#[test]
fn output_variables() {
    let folder = Folder::new();
    let names = ["position", "normal", "material", "light_count", "direct", "indirect"];
    let aovs = names.map(|name| format!("{name}={name}.exr"));
    let aovs = aovs.iter().flat_map(|aov| ["--aov", aov.as_str()]);
    let arguments: Vec<_> = ["render", "scene.toml"].into_iter().chain(aovs).collect();
    folder.done(&arguments);
    let mut written = names.map(|name| format!("{name}.exr")).to_vec();
    written.push("scene.toml".into());
    written.sort();
    assert_eq!(folder.names(), written, "no picture unless one is asked for");
    folder.done(&["render", "scene.toml", "-o", "picture.exr"]);
    let load = |name: &str| picture(&folder.path(&format!("{name}.exr")));
    let [position, normal, material, count, direct, indirect] = names.map(load);
    let [x, y, z] = position.pixels[MIDDLE];
    assert!(x.abs() < 0.2 && y.abs() < 1e-5 && z.abs() < 0.2, "{x} {y} {z}");
    assert_eq!(normal.pixels[MIDDLE], [0.0, 1.0, 0.0]);
    assert_eq!(material.pixels[MIDDLE], [0.0; 3]);
    assert_eq!(material.pixels[0], [-2.0; 3], "no surface there");
    assert_eq!(count.pixels[MIDDLE][0], 1.0);
    let corner = count.pixels.last().unwrap()[0];
    assert_eq!(corner, 0.0, "the light does not reach there");
    assert_eq!(direct, load("picture"));
    assert!(indirect.pixels.iter().all(|pixel| *pixel == [0.0; 3]));
}

/// What the clusters did, as numbers and as pictures.
#[test]
fn debug_views() {
    let folder = Folder::new();
    let names =
        ["cluster", "slice", "pair_ratio", "folded", "light_error", "light_count", "normal", "material"];
    let aovs = names.map(|name| [format!("{name}={name}.exr"), format!("{name}={name}.png")]).concat();
    let aovs = aovs.iter().flat_map(|aov| ["--aov", aov.as_str()]);
    let said = folder.done(&["render", "scene.toml"].into_iter().chain(aovs).collect::<Vec<_>>());
    assert!(said.contains("light_count.png: 0 (dark) to 1 (bright)"), "{said}");
    let load = |name: &str| picture(&folder.path(name));
    let [cluster, slice, ratio] = ["cluster.exr", "slice.exr", "pair_ratio.exr"].map(load);
    // A cluster lies in one tile and slice; without a surface it is −1.
    let id = |i: usize| cluster.pixels[i][0];
    let differ = (0..64 * 48).filter(|&i| {
        let corner = (i / 64 / 8 * 8) * 64 + i % 64 / 8 * 8;
        let beyond = (0..64 * 48).filter(|j| j / 64 / 8 != i / 64 / 8 || j % 64 / 8 != i % 64 / 8);
        assert!(id(i) == -1.0 || beyond.into_iter().all(|j| id(j) != id(i)), "{i}");
        id(corner) == id(i) && slice.pixels[corner] != slice.pixels[i]
    });
    // Another pipeline may round a depth between two slices to the other one.
    let differ = differ.count();
    assert!(differ <= 30, "{differ}");
    // Without a surface all are 0.
    for &[ratio, all, within] in ratio.pixels.iter().filter(|pixel| **pixel != [0.0; 3]) {
        assert_eq!(ratio, if within > 0.0 { all / within } else { 1.0 });
    }
    // A heat map is dark where the count is 0 and bright where it is 1.
    let (count, map) = (load("light_count.exr"), load("light_count.png"));
    for (count, color) in count.pixels.iter().zip(&map.pixels) {
        assert_eq!(color[0], count[0], "{color:?}");
    }
}

#[test]
fn frames() {
    let folder = Folder::new();
    folder.done(&[
        "render",
        "scene.toml",
        "--frames",
        "0..3",
        "-o",
        "a_%04d.png",
        "--aov",
        "position=p%d.exr",
    ]);
    let names = ["a_0000.png", "a_0001.png", "a_0002.png", "p0.exr", "p1.exr", "p2.exr", "scene.toml"];
    assert_eq!(folder.names(), names);
    assert_ne!(folder.read("a_0000.png"), folder.read("a_0002.png"));
    // Frame 30 of 30 a second stands where the path ends.
    folder.done(&["render", "scene.toml", "--frames", "30..31", "-o", "f_%04d.exr"]);
    let camera = "position = [0, 2, 5]\ntarget = [0, 0, 0]\nvertical";
    assert!(SCENE.contains(camera));
    folder.write("end.toml", SCENE.replace(camera, "position = [3, 2, 5]\ntarget = [0, 0, 0]\nvertical"));
    folder.done(&["render", "end.toml", "-o", "end.exr"]);
    assert_eq!(folder.read("f_0030.exr"), folder.read("end.exr"));
}

/// The oracle of one frame sees camera and lights where they are then.
#[test]
fn a_frame_of_the_reference() {
    let folder = Folder::new();
    let orbit = "animate = { type = \"orbit\", center = [0.3, 1, 0], axis = [0, 1, 0], period = 2 }\n";
    folder.write("scene.toml", format!("{SCENE}{orbit}"));
    folder.done(&["render", "scene.toml", "--frames", "20..21", "-o", "a%d.pfm"]);
    let compare = |frame: &[&str]| {
        folder.done(&[&["reference", "scene.toml", "-o", "b.pfm", "--tolerance", "1e-4"], frame].concat());
        let figures = folder.done(&["compare", "a20.pfm", "b.pfm", "--json"]);
        serde_json::from_str::<serde_json::Value>(&figures).unwrap()["p99"].as_f64().unwrap()
    };
    assert!(compare(&["--frame", "20"]) < 1e-3);
    assert!(compare(&[]) > 0.1);
}

/// An old picture is replaced at once: who has it open keeps it whole.
#[test]
fn replaced_atomically() {
    let folder = Folder::new();
    for name in ["a.png", "a.exr", "a.pfm", "r.json"] {
        folder.write(name, "old");
        std::fs::hard_link(folder.path(name), folder.path("held")).unwrap();
        let option = if name == "r.json" { "--report" } else { "-o" };
        let outputs = ["-o", "z.pfm", option, name];
        folder.done(&[&["render", "scene.toml"], &outputs[..]].concat());
        assert_eq!(folder.read("held"), b"old");
        assert!(folder.read(name).len() > 100);
        std::fs::remove_file(folder.path("held")).unwrap();
    }
    let names = ["a.exr", "a.pfm", "a.png", "r.json", "scene.toml", "z.pfm"];
    assert_eq!(folder.names(), names, "no temporary is left");
}

/// The embedded scene, into the default file.
#[test]
fn without_a_scene() {
    let folder = Folder::new();
    folder.done(&["render", "--size", "64x48"]);
    assert_eq!(folder.names(), ["amas.png", "scene.toml"]);
    let picture = picture(&folder.path("amas.png"));
    let lit = picture.pixels.iter().filter(|pixel| **pixel != [0.0; 3]);
    assert!(lit.count() > 1000);
}

/// The same bytes on every run, whatever the number of lavapipe's threads and of our own.
#[test]
fn deterministic() {
    let folder = Folder::new();
    // More lights over the floor than a list holds: they are folded.
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 500, seed = 2, min = [-1, 0.2, -1], max = [1, 1, 1], \
                  intensity = [0.1, 1], range = 3 }\n";
    std::fs::write(folder.path("folds.toml"), format!("{SCENE}{lights}")).unwrap();
    let render = |scene: &[&str], threads: Option<&str>, name: &str| {
        let size = ["--size", "64x48", "--set", "samples=2"];
        let files = ["-o", name, "-o", "last.png", "--aov", "light_count=count.exr"];
        let arguments = [&["render"], scene, &size, &files].concat();
        let mut command = folder.command(&arguments);
        if let Some(threads) = threads {
            command.env("LP_NUM_THREADS", threads).env("RAYON_NUM_THREADS", threads);
        }
        let run = Run::of(&mut command, &arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        [name, "last.png", "count.exr"].map(|name| folder.read(name))
    };
    for scene in [&["scene.toml"][..], &["folds.toml", "--set", "max_lights_per_cluster=128"], &[]] {
        let first = render(scene, None, "first.exr");
        for threads in [None, Some("0"), Some("1"), Some("2")] {
            let again = render(scene, threads, "again.exr");
            assert!(first == again, "{scene:?} with {threads:?} threads");
        }
    }
}

#[test]
fn oracle() {
    let folder = Folder::new();
    let reference = ["reference", "scene.toml", "-o", "a.exr", "--error", "e.pfm"];
    folder.done(&reference);
    assert_eq!(folder.names(), ["a.exr", "e.pfm", "scene.toml"]);
    let error = picture(&folder.path("e.pfm"));
    assert!(error.pixels.iter().all(|pixel| *pixel == [0.0; 3]));
    let first = folder.read("a.exr");
    folder.done(&reference);
    assert_eq!(folder.read("a.exr"), first);
    // The device's picture against it.
    folder.done(&["render", "scene.toml", "-o", "b.exr"]);
    let figures = folder.done(&["compare", "b.exr", "a.exr", "--json"]);
    let figures: serde_json::Value = serde_json::from_str(&figures).unwrap();
    assert!(figures["mean_relative_error"].as_f64().unwrap() < 1e-4, "{figures:#}");
}
