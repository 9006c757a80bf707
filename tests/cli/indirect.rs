//! Pictures that are refined: goals, limits, output variables, the report.

use crate::{Folder, Run, picture};

/// A lamp between a floor and two walls, behind a post; and a point light.
const SCENE: &str = r#"
[render]
size = [24, 16]
shadows = true
samples = 2
tonemap = "none"
indirect = { vpls = 512, bounces = 3 }

[[camera]]
name = "main"
position = [0, 1, 3]
target = [0, 0.6, 0]
vertical_fov = 45

[[material]]
name = "grey"
type = "matte"
color = [0.7, 0.6, 0.5]

[[mesh]]
shape = "plane"
size = 2
material = "grey"

[[mesh]]
shape = "plane"
size = 2
material = "grey"
translate = [0, 1, -1]
rotate = [90, 0, 0]

[[mesh]]
shape = "box"
size = [0.2, 1, 0.2]
material = "grey"
translate = [0.4, 0.5, 0]

[[light]]
type = "rect"
center = [0, 1.9, 0]
u = [0.25, 0, 0]
v = [0, 0, 0.25]
radiance = [14, 12, 9]
visible = false

[[light]]
type = "point"
position = [-0.5, 0.8, 0.3]
intensity = [1, 1, 1]
range = 2
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("room.toml", SCENE);
    folder
}

fn estimate(folder: &Folder, report: &str) -> f64 {
    folder.json(report)["error_estimate"]["indirect_relative"].as_f64().unwrap()
}

/// Refined until the estimate is below the goal, which the report says; what comes directly and what comes by way of other
/// surfaces add up to the picture.
#[test]
fn goals_and_shares() {
    let folder = folder();
    let render = |goal: &str| {
        let words = ["render", "room.toml", "--indirect-error", goal, "--report", "r.json", "-o", "all.exr"];
        folder
            .done(&[&words[..], &["--aov", "direct=direct.exr", "--aov", "indirect=indirect.exr"]].concat());
        estimate(&folder, "r.json")
    };
    let rough = render("0.2");
    assert!(rough > 0.0 && rough <= 0.2, "{rough}");
    let [all, direct, indirect] =
        ["all", "direct", "indirect"].map(|name| picture(&folder.path(&format!("{name}.exr"))));
    let sum = direct.plus(&indirect);
    let mut lit = 0;
    for (all, sum) in all.pixels.iter().flatten().zip(sum.pixels.iter().flatten()) {
        // Negative estimates are shown as black.
        assert!((all - sum.max(0.0)).abs() <= 1e-5 * sum.abs().max(1e-3), "{all} {sum}");
        lit += u32::from(*sum > 0.0);
    }
    assert!(lit > 500, "{lit} values of 1152");
    assert!(indirect.pixels.iter().flatten().filter(|value| **value > 0.0).count() > 500);
    let fine = render("0.05");
    assert!(fine > 0.0 && fine <= 0.05, "{fine}");
    assert!(folder.json("r.json")["passes"].as_array().unwrap().iter().any(|pass| pass["name"] == "gather"));
}

/// A goal out of reach ends with the time.
#[test]
fn time_limit() {
    let folder = folder();
    let words =
        ["render", "room.toml", "--indirect-error", "1e-9", "--time-limit", "1.5", "--report", "r.json"];
    folder.done(&[&words[..], &["-o", "a.exr"]].concat());
    assert!(estimate(&folder, "r.json") > 1e-9);
    assert!(picture(&folder.path("a.exr")).pixels.iter().flatten().any(|value| *value > 0.0));
    // Too short for an estimate: a picture nevertheless.
    folder.done(&["render", "room.toml", "--time-limit", "0", "-o", "b.exr"]);
    picture(&folder.path("b.exr"));
}

/// What stays black is refined at once.
#[test]
fn black() {
    let folder = folder();
    let (dark, _) = SCENE.split_once("[[light]]").unwrap();
    folder.write("room.toml", dark);
    folder.done(&["render", "room.toml", "--report", "r.json", "-o", "a.exr"]);
    assert_eq!(estimate(&folder, "r.json"), 0.0);
    assert!(picture(&folder.path("a.exr")).pixels.iter().all(|pixel| *pixel == [0.0; 3]));
}

#[test]
fn bad_values() {
    let folder = folder();
    for (option, values, hint) in [
        ("--indirect-error", ["0", "-0.1", "nan", "inf", "much"], "a number above 0, such as 0.02"),
        ("--time-limit", ["-1", "nan", "inf", "1e10", "long"], "seconds, such as 30"),
    ] {
        for value in values {
            folder.refused(&["render", "room.toml", &format!("{option}={value}")], &[option, hint]);
        }
    }
    let set = |pair: &str, parts: &[&str]| folder.refused(&["render", "room.toml", "--set", pair], parts);
    set("indirect.vpls=1048577", &["from 0 to 1048576"]);
    set("indirect.vpls=-1", &["from 0 to 1048576"]);
    set("indirect.bounces=65", &["from 0 to 64"]);
    set("indirect.bounce=1", &["unknown key", "did you mean `indirect.bounces`?"]);
}

/// The same bytes whatever the number of lavapipe's threads and of our own.
#[test]
fn deterministic() {
    let folder = folder();
    let render = |threads: &str| {
        let arguments = ["render", "room.toml", "--indirect-error", "0.2", "-o", "a.exr", "-o", "a.png"];
        let mut command = folder.command(&arguments);
        command.env("LP_NUM_THREADS", threads).env("RAYON_NUM_THREADS", threads);
        let run = Run::of(&mut command, &arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        ["a.exr", "a.png"].map(|name| folder.read(name))
    };
    let one = render("1");
    assert!(render("3") == one);
}

/// Ctrl-C: the picture at hand is saved as far as it came, and no other is begun.
#[cfg(unix)]
#[test]
fn interrupted() {
    use std::process::{Command, Stdio};
    let folder = folder();
    let words = ["render", "room.toml", "--frames", "0..9999", "--indirect-error", "1", "-o", "p_%04d.pfm"];
    let mut command = folder.command(&words);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while !folder.path("p_0000.pfm").exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    let pictures = folder.names().iter().filter(|name| name.starts_with("p_")).count();
    let said = match pictures {
        1 => "interrupted: the picture is saved".into(),
        several => format!("interrupted: {several} pictures are saved"),
    };
    assert!(stderr.contains(&said), "{pictures}: {stderr}");
    assert!(folder.names().iter().all(|name| !name.starts_with('.')), "nothing half-written");
}
