//! `amas bench`: suites, baselines, interruption. Times are not judged: the machine may be busy.

use crate::Folder;
use serde_json::{Value, json};

/// The quickest measurement of [`crate::SCENE`], into `file`.
fn quick<'a>(frames: &'a str, file: &'a str) -> Vec<&'a str> {
    vec!["bench", "scene.toml", "--size", "32x18", "--warmup", "1", "--frames", frames, "--json", file]
}

/// Writes `changed` of the figures in `b.json` as `c.json`.
fn change(folder: &Folder, changed: impl FnOnce(&mut Value)) {
    let mut figures = folder.json("b.json");
    changed(&mut figures);
    folder.write("c.json", figures.to_string());
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn suites_and_scenes() {
    let folder = Folder::new();
    let words = ["--size", "16x9", "--frames", "5", "--warmup", "0", "--validate", "--json", "b.json"];
    let table = folder.done(&[&["bench", "scene.toml", "--suite", "bsdf"], &words[..]].concat());
    let json = folder.json("b.json");
    let points = json["points"].as_array().unwrap();
    let names: Vec<_> = points.iter().map(|point| point["scene"].as_str().unwrap()).collect();
    let suite = ["bsdf/matte", "bsdf/plastic", "bsdf/metal", "bsdf/substrate", "bsdf/principled"];
    assert_eq!(names, [&["scene.toml"], &suite[..]].concat());
    assert_eq!((&json["partial"], &json["baseline"]), (&json!(false), &Value::Null));
    for point in points {
        assert_eq!(point["size"], json!([16, 9]));
        assert!(table.contains(&format!("{}, 16x9, ", point["scene"].as_str().unwrap())), "{table}");
        for key in ["cpu_ms", "wall_ms"] {
            let mut times = numbers(&point["samples"][key]);
            times.sort_by(f64::total_cmp);
            let figure = &point[format!("frame_{key}")];
            assert_eq!((&figure["n"], &figure["min"]), (&json!(5), &json!(times[0])), "{point}");
            assert_eq!(figure["median"], times[2]);
        }
        // The first round of four, and the first of the next.
        assert!(point["passes"].as_array().unwrap().iter().all(|pass| pass["cpu"]["n"] == 2), "{point}");
        assert!(point["peak_memory"]["device_mb"].as_f64().unwrap() > 0.0);
        assert_eq!(point["comparison"], Value::Null);
    }
    if cfg!(target_os = "linux") {
        for when in ["before", "during"] {
            let load = &json["load"][when];
            assert!(load["processors"].as_u64().unwrap() >= 1, "{load}");
            assert!(load["others"].as_f64().unwrap() >= 0.0, "{load}");
        }
        assert!(json["peak_host_mb"].as_f64().unwrap() > 1.0);
    }
}

/// Frames of gathered light, and nothing else.
#[test]
fn gathering() {
    let folder = Folder::new();
    let words = ["--size", "16x9", "--frames", "2", "--warmup", "0", "--validate", "--json", "b.json"];
    folder.done(&[&["bench", "--suite", "indirect"], &words[..]].concat());
    let json = folder.json("b.json");
    let points = json["points"].as_array().unwrap();
    assert!(points.len() >= 3);
    for point in points {
        let passes = point["passes"].as_array().unwrap();
        let names: Vec<_> = passes.iter().map(|pass| pass["name"].as_str().unwrap()).collect();
        assert_eq!(names, ["gather"], "{point}");
        assert_eq!((&point["passes"][0]["cpu"]["n"], &point["pairs"]), (&json!(2), &Value::Null));
    }
}

/// From nothing to a picture, step by step.
#[test]
fn startup() {
    let folder = Folder::new();
    let words = ["--size", "16x9", "--frames", "1", "--warmup", "0", "--validate", "--json", "b.json"];
    folder.done(&[&["bench", "--suite", "startup"], &words[..]].concat());
    let json = folder.json("b.json");
    for point in json["points"].as_array().unwrap() {
        let passes = point["passes"].as_array().unwrap();
        let names: Vec<_> = passes.iter().map(|pass| pass["name"].as_str().unwrap()).collect();
        assert_eq!(names, ["scene", "device", "upload", "pipelines", "picture"]);
        let sum: f64 = passes.iter().map(|pass| pass["cpu_ms"].as_f64().unwrap()).sum();
        let whole = point["frame_cpu_ms"]["median"].as_f64().unwrap();
        assert!((sum / whole - 1.0).abs() < 0.01, "{sum} of {whole}");
        assert_eq!(point["pairs"], Value::Null);
    }
}

#[test]
fn baselines() {
    let folder = Folder::new();
    folder.done(&quick("8", "b.json"));
    let against = |baseline: &str| {
        let table = folder.done(&[&quick("8", "d.json")[..], &["--baseline", baseline]].concat());
        let json = folder.json("d.json");
        let comparison = json["points"][0]["comparison"].clone();
        (table, json["baseline"].clone(), comparison)
    };
    let (table, baseline, comparison) = against("b.json");
    assert!(table.contains("against b.json") && table.contains("scene.toml"), "{table}");
    assert_eq!((&baseline["file"], &baseline["confidence"]), (&json!("b.json"), &json!(0.95)));
    let [low, ratio, high] = ["low", "ratio", "high"].map(|key| comparison[key].as_f64().unwrap());
    assert!(0.0 < low && low <= ratio && ratio <= high, "{comparison}");
    let verdict = comparison["verdict"].as_str().unwrap();
    assert!(table.contains(verdict) && ["faster", "slower", "undecided"].contains(&verdict), "{table}");
    // Beyond doubt, whatever the machine does; by device time on a device that has some.
    for (ms, expected) in [(1e-3, "slower"), (1e9, "faster")] {
        change(&folder, |figures| {
            let samples = &mut figures["points"][0]["samples"];
            for key in ["cpu_ms", "gpu_ms"] {
                samples[key].as_array_mut().unwrap().fill(json!(ms));
            }
        });
        let (table, _, comparison) = against("c.json");
        assert_eq!(comparison["verdict"], expected, "{table}");
        assert_eq!(comparison["baseline_median_ms"], ms);
        assert!(table.contains(&format!("1 {expected}")), "{table}");
    }
    // Fewer measurements than any confidence can be had from.
    change(&folder, |figures| {
        figures["points"][0]["samples"] = json!({ "cpu_ms": [1.0], "wall_ms": [], "gpu_ms": [1.0] })
    });
    assert_eq!(against("c.json").2["verdict"], "undecided");
    // Points that only one side has.
    change(&folder, |figures| {
        let other = json!({ "scene": "other.toml", "size": [9, 9], "samples": { "cpu_ms": [], "wall_ms": [], "gpu_ms": [] } });
        figures["points"].as_array_mut().unwrap().insert(0, other);
        figures["set"] = json!([["samples", "3"]]);
        figures["load"]["before"] = json!({ "processors": 2, "others": 1.5, "stolen": 0.0 });
    });
    let scenes = ["scene.toml", "scene.toml", "--baseline", "c.json"];
    let words = ["bench", "--size", "32x18", "--warmup", "0", "--frames", "1"];
    let table = folder.done(&[&words[..], &scenes].concat());
    assert!(
        table.contains("not in the baseline") && table.contains("--set was samples=3, is nothing"),
        "{table}"
    );
}

#[test]
fn bad_baselines() {
    let folder = Folder::new();
    folder.done(&quick("1", "b.json"));
    let refused = |parts: &[&str]| {
        folder.refused(&["bench", "scene.toml", "--size", "32x18", "--baseline", "c.json"], parts);
    };
    refused(&["c.json", "cannot read the baseline", "amas bench --json"]);
    folder.write("c.json", "{");
    refused(&["c.json", "is not JSON"]);
    folder.write("c.json", "[]");
    refused(&["c.json", "names no schema"]);
    change(&folder, |figures| figures["schema"] = json!(2));
    refused(&["c.json", "schema 2, this amas has 1"]);
    // As older versions wrote it.
    change(&folder, |figures| figures["points"][0]["samples"] = Value::Null);
    refused(&["c.json", "has not what amas bench writes", "anew"]);
    change(&folder, |figures| figures["device"]["name"] = json!("Voodoo 2"));
    refused(&["c.json", "\"Voodoo 2\"", "--device"]);
    change(&folder, |figures| figures["points"][0]["size"] = json!([640, 360]));
    refused(&["c.json", "none of these points", "scene.toml at 640x360", "same size"]);
    let overwrite = ["bench", "scene.toml", "--json", "./b.json", "--baseline", "b.json"];
    folder.refused(&overwrite, &["this is the baseline, and would be overwritten"]);
    folder.refused(&["bench", "--suite", "light"], &["light", "lights", "startup"]);
}

/// Ctrl-C: what was measured is printed and written, and the file says that it is partial.
#[cfg(unix)]
#[test]
fn interrupted() {
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    let words = quick("1000000", "b.json");
    let mut command = folder.command(&words);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The first round is done once there is a file.
    while !folder.path("b.json").exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(folder.json("b.json")["partial"], true);
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    let [stdout, stderr] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("amas: interrupted: ") && stderr.contains(" of 1000000 rounds"), "{stderr}");
    assert!(stdout.contains("\nprepass "), "{stdout}");
    let json = folder.json("b.json");
    assert_eq!(json["partial"], true);
    let point = &json["points"][0];
    let times = numbers(&point["samples"]["cpu_ms"]);
    assert!(!times.is_empty() && point["frame_cpu_ms"]["n"] == times.len(), "{point}");
    assert_eq!(folder.names(), ["b.json", "scene.toml"]);
}

/// A pipe gets one document, not one after every round.
#[cfg(target_os = "linux")]
#[test]
fn into_a_pipe() {
    let folder = Folder::new();
    let output = folder.done(&quick("3", "/dev/stdout"));
    let mut documents = serde_json::Deserializer::from_str(&output).into_iter::<Value>();
    assert_eq!(documents.next().unwrap().unwrap()["partial"], false);
    assert_eq!(output.matches("\"schema\"").count(), 1);
}
