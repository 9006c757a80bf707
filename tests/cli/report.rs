//! The report and the figures of `amas bench`: every key of the contract, with values that can be.

use crate::Folder;
use serde_json::Value;

/// On a software device, where compute shades; on others fragments do.
const PASSES: [[&str; 5]; 2] = [
    ["prepass", "cluster", "resolve", "direct", "present"],
    ["prepass", "cluster", "direct", "indirect", "present"],
];

fn number(value: &Value) -> f64 {
    let number = value.as_f64();
    number.unwrap_or_else(|| panic!("no number: {value}"))
}

/// `{median, mad, n}` of times.
fn figure(value: &Value, n: u64) {
    assert!(number(&value["median"]) > 0.0, "{value}");
    assert!(number(&value["mad"]) >= 0.0, "{value}");
    assert_eq!(value["n"], n, "{value}");
}

fn device(value: &Value) {
    for key in ["name", "driver", "api", "type"] {
        assert!(!value[key].as_str().unwrap().is_empty(), "{key}: {value}");
    }
}

/// Names in frame order, and times.
fn passes(value: &Value, n: u64) {
    let passes = value.as_array().unwrap();
    let names: Vec<_> = passes.iter().map(|pass| pass["name"].as_str().unwrap()).collect();
    assert!(PASSES.iter().any(|passes| names == passes), "{names:?}");
    for pass in passes {
        // Devices without timestamps report null.
        if !pass["gpu_ms"].is_null() {
            figure(&pass["gpu_ms"], n);
        }
        assert!(number(&pass["cpu_ms"]) >= 0.0, "{pass}");
    }
}

/// At 64 × 48 with a single light that reaches a part of the floor.
fn clusters(value: &Value) {
    let grid = value["grid"].as_array().unwrap();
    let grid: Vec<_> = grid.iter().map(number).collect();
    assert_eq!(grid[..2], [8.0, 6.0]);
    assert!((1.0..=256.0).contains(&grid[2]), "{grid:?}");
    let occupied = number(&value["occupied"]);
    assert!((1.0..=grid.iter().product()).contains(&occupied), "{value}");
    let entries = number(&value["list_entries"]);
    assert!((1.0..=occupied).contains(&entries), "{value}");
    assert_eq!(value["longest_list"], 1, "{value}");
    for key in ["overflowed", "folded_lights", "max_folded_error"] {
        assert_eq!(number(&value[key]), 0.0, "{key}");
    }
}

fn pairs(value: &Value) {
    let evaluated = number(&value["evaluated"]);
    let useful = number(&value["useful"]);
    assert!(0.0 < useful && useful <= evaluated && evaluated <= 64.0 * 48.0, "{value}");
    assert_eq!(number(&value["area_evaluated"]), 0.0, "{value}");
    assert_eq!(number(&value["area_saved"]), 0.0, "{value}");
    let per_pixel = number(&value["per_pixel"]) * 64.0 * 48.0;
    assert!((per_pixel / evaluated - 1.0).abs() < 1e-12, "{value}");
    if !value["ns_per_pair"].is_null() {
        assert!(number(&value["ns_per_pair"]) > 0.0, "{value}");
    }
}

#[test]
fn every_key() {
    let folder = Folder::new();
    folder.done(&["render", "scene.toml", "--report", "r.json"]);
    let report = folder.json("r.json");
    assert_eq!(report["schema"], 1);
    device(&report["device"]);
    let scene = serde_json::json!({ "triangles": 2, "materials": 1, "point_lights": 1, "area_lights": 0 });
    assert_eq!(report["scene"], scene);
    assert_eq!(report["image"], serde_json::json!({ "width": 64, "height": 48 }));
    passes(&report["passes"], 1);
    clusters(&report["clusters"]);
    figure(&report["frame"]["wall_ms"], 1);
    figure(&report["frame"]["cpu_ms"], 1);
    pairs(&report["pairs"]);
    let estimate = &report["error_estimate"];
    let error = number(&estimate["light_relative"]);
    assert!((0.0..=0.01).contains(&error), "beyond the budget: {estimate}");
    assert_eq!(number(&estimate["indirect_relative"]), 0.0);
    assert!(report["validation_messages"].is_null());
    let memory = &report["peak_memory"];
    assert!((0.1..4096.0).contains(&number(&memory["device_mb"])), "{memory}");
    if cfg!(target_os = "linux") {
        assert!((1.0..4096.0).contains(&number(&memory["host_mb"])), "{memory}");
    }
}

#[test]
fn several_frames_and_no_lights() {
    let folder = Folder::new();
    let frames = ["--frames", "0..4", "-o", "a_%04d.pfm"];
    folder.done(&[&["render", "scene.toml", "--report", "r.json"], &frames[..]].concat());
    let report = folder.json("r.json");
    passes(&report["passes"], 4);
    figure(&report["frame"]["wall_ms"], 4);
    // A scene without lights: neither lists nor the passes that would read them.
    let dark = crate::SCENE.split("[[light]]").next().unwrap();
    folder.write("dark.toml", dark);
    folder.done(&["render", "dark.toml", "--report", "r.json"]);
    let report = folder.json("r.json");
    let names = report["passes"].as_array().unwrap().iter().map(|pass| &pass["name"]);
    assert_eq!(names.collect::<Vec<_>>(), ["prepass", "direct", "present"]);
    assert_eq!(report["pairs"]["evaluated"], 0);
    assert_eq!(report["pairs"]["ns_per_pair"], Value::Null);
    assert_eq!(report["clusters"]["list_entries"], 0);
}

/// Ten lights, half of which shine upwards from above everything: masks leave these out. Two are seen.
#[test]
fn area_lights() {
    let folder = Folder::new();
    let light = |index: u32| {
        let [u, v] = if index.is_multiple_of(2) {
            ["[0.1, 0, 0]", "[0, 0, 0.1]"]
        } else {
            ["[0, 0, 0.1]", "[0.1, 0, 0]"]
        };
        let (x, seen) = (0.1 * f64::from(index) - 0.5, index < 2);
        format!(
            "[[light]]\ntype = \"rect\"\ncenter = [{x}, 1, 0]\nu = {u}\nv = {v}\nradiance = [9, 9, 9]\nvisible = {seen}\n"
        )
    };
    let dark = crate::SCENE.split("[[light]]").next().unwrap();
    folder.write("area.toml", (0..10).map(light).fold(dark.to_owned(), |text, light| text + &light));
    let words = ["--validate", "--report", "r.json", "--aov", "material=m.pfm", "-o", "a.png"];
    folder.done(&[&["render", "area.toml"], &words[..]].concat());
    let report = folder.json("r.json");
    assert_eq!(report["scene"]["area_lights"], 10);
    let names = report["passes"].as_array().unwrap().iter().map(|pass| &pass["name"]);
    assert_eq!(names.collect::<Vec<_>>(), ["prepass", "cluster", "direct", "present"]);
    let pairs = &report["pairs"];
    let [evaluated, saved] = ["area_evaluated", "area_saved"].map(|key| number(&pairs[key]));
    assert!(evaluated > 0.0 && pairs["evaluated"] == pairs["area_evaluated"], "{pairs}");
    assert!((0.9..1.1).contains(&(saved / evaluated)), "{pairs}");
    let clusters = &report["clusters"];
    assert!(number(&clusters["occupied"]) > 0.0 && clusters["list_entries"] == 0, "{clusters}");
    assert_eq!(report["validation_messages"], 0);
}

/// Point lights cast shadows where they are asked for: over many frames, which `bench` leaves out and says so.
#[test]
fn shadows_of_point_lights() {
    let folder = Folder::new();
    let sphere = "[[mesh]]\nshape = \"sphere\"\nradius = 0.2\nsegments = [256, 128]\nmaterial = \"floor\"\n";
    folder.write("scene.toml", format!("{}{sphere}", crate::SCENE));
    let warnings = |arguments: &[&str]| {
        let run = folder.run(arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        run.stderr.matches("gathered over many frames").count()
    };
    let render = |name: &str, key: &[&str]| {
        let (picture, report) = (format!("{name}.pfm"), format!("{name}.json"));
        let arguments = ["render", "scene.toml", "-o", &picture, "--report", &report, "--time-limit", "5"];
        let count = warnings(&[&arguments, key].concat());
        let device = number(&folder.json(&report)["peak_memory"]["device_mb"]);
        (count, device, folder.read(&picture))
    };
    let without = render("without", &[]);
    let with = render("with", &["--set", "shadows=true"]);
    assert_eq!((without.0, with.0), (0, 0));
    // The tree over the sphere's 65,024 triangles takes some 3 MB, and is made for shadows alone.
    assert!(with.1 > without.1 + 1.0, "{} and {} MB", with.1, without.1);
    assert!(with.2 != without.2);
    let bench = ["bench", "scene.toml", "--set", "shadows=true", "--frames", "2", "--warmup", "1"];
    assert_eq!(warnings(&bench), 1);
    // Area lights do cast them: nothing to warn of.
    let dark = crate::SCENE.split("[[light]]").next().unwrap();
    let rect = "[[light]]\ntype = \"rect\"\ncenter = [0, 1, 0]\nu = [0.1, 0, 0]\nv = [0, 0, 0.1]\nradiance = [9, 9, 9]\n";
    folder.write("scene.toml", format!("{dark}{sphere}{rect}"));
    let area = render("area", &["--set", "shadows=true"]);
    assert_eq!(area.0, 0);
    assert!(area.1 > without.1 + 1.0, "{} and {} MB", area.1, without.1);
}

/// The validation layers are on, and silent.
#[test]
fn validation() {
    let folder = Folder::new();
    let words = ["--validate", "--report", "r.json", "--aov", "normal=n.exr", "-o", "a.png"];
    folder.done(&[&["render", "scene.toml"], &words[..]].concat());
    assert_eq!(folder.json("r.json")["validation_messages"], 0);
}

#[test]
fn bench() {
    let folder = Folder::new();
    let words = ["--frames", "3", "--warmup", "1", "--floors", "--json", "b.json"];
    let table = folder.done(&[&["bench", "scene.toml", "scene.toml"], &words[..]].concat());
    let json = folder.json("b.json");
    assert_eq!(json["schema"], 1);
    device(&json["device"]);
    assert!(json.as_object().unwrap().contains_key("commit"));
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 2);
    for point in points {
        assert_eq!(point["scene"], "scene.toml");
        assert_eq!(point["size"], serde_json::json!([64, 48]));
        figure(&point["frame_cpu_ms"], 3);
        figure(&point["frame_wall_ms"], 3);
        // Device times are of frames in one piece.
        passes(&point["passes"], 3);
        clusters(&point["clusters"]);
        pairs(&point["pairs"]);
        let floors = point["floors_ns"].as_object().unwrap();
        let keys = ["lambert_arithmetic", "plastic_arithmetic", "fetch", "lambert", "plastic"];
        assert!(keys.iter().all(|key| number(&floors[*key]) >= 0.0), "{point}");
    }
    assert_eq!(table.matches("floors, ns a pair").count(), 2, "{table}");
    for pass in points[0]["passes"].as_array().unwrap() {
        let name = pass["name"].as_str().unwrap();
        assert!(table.contains(&format!("\n{name} ")), "{table}");
    }
}
