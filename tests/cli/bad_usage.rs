//! Command lines that are wrong: status 2.

use crate::Folder;

#[test]
fn words_that_do_not_exist() {
    let folder = Folder::new();
    folder.refused(&["rendr"], &["rendr", "--help"]);
    folder.refused(&["render", "--sise", "1x1"], &["--sise", "'--size'"]);
    folder.refused(&["render", "scene.toml", "other.toml"], &["unexpected argument 'other.toml'"]);
    folder.refused(&["compare", "a.exr"], &["<B>"]);
    folder.refused(&["reference", "scene.toml"], &["--output"]);
    folder.refused(&["bench", "--frames", "0"], &["--frames"]);
    folder.refused(&["bench", "--warmup", "-1"], &["-1"]);
    folder.refused(&["reference", "-o", "a.exr", "--spp", "0"], &["--spp"]);
    folder.refused(&["reference", "-o", "a.exr", "--integrator", "bdpt"], &["bdpt", "shadowed"]);
    folder.refused(&["compare", "a.exr", "b.exr", "--block", "0"], &["--block"]);
}

/// The message is that of the option, not of a word that begins with a dash.
#[test]
fn negative_numbers() {
    let folder = Folder::new();
    let refused = |command: &[&str], option: &str, remedy: &str| {
        folder.refused(&[command, &[option, "-1"]].concat(), &["'-1'", option, "remedy: ", remedy]);
    };
    let render = ["render", "scene.toml"];
    refused(&render, "--frames", "A..B");
    refused(&render, "--indirect-error", "a number above 0");
    refused(&render, "--time-limit", "seconds");
    let reference = ["reference", "scene.toml", "-o", "a.exr"];
    for (option, remedy) in [
        ("--spp", "from 1"),
        ("--paths", "from 1"),
        ("--seed", "such as 0"),
        ("--frame", "such as 0"),
        ("--bounces", "such as 0"),
    ] {
        refused(&reference, option, remedy);
    }
    refused(&reference, "--tolerance", "1e-9 to 1");
    refused(&["bench", "scene.toml"], "--warmup", "such as 0");
    refused(&["bench", "scene.toml"], "--frames", "from 1");
    refused(&["view", "scene.toml"], "--frames", "from 1");
    refused(&["compare", "a.exr", "b.exr"], "--block", "from 1");
}

/// `amas scene.toml`, as other programs take it.
#[test]
fn a_scene_is_no_subcommand() {
    let folder = Folder::new();
    folder.refused(&["scene.toml"], &["scene.toml is no subcommand", "`amas render scene.toml`"]);
    folder.refused(&["some/model.obj"], &["`amas view some/model.obj`"]);
}

/// What `view` is given beside the scene is looked at before there is a window.
#[test]
fn files_of_the_window() {
    let folder = Folder::new();
    folder.write("a.png", crate::png(2, 2, |_, _| [9; 4]));
    folder.write("bad.exr", "no picture");
    let view = |words: &[&str], parts: &[&str]| {
        folder.refused(&[&["view", "scene.toml"], words].concat(), parts);
    };
    view(&["--compare", "none.exr"], &["none.exr"]);
    view(&["--compare", "bad.exr"], &["bad.exr"]);
    view(&["--compare", "a.png"], &["a.png", "give a .exr or .pfm"]);
    view(&["--glsl", "none"], &["--glsl none", "no such folder"]);
    view(&["--glsl", "."], &["--glsl .", "none of amas's shaders"]);
}

#[test]
fn fits() {
    let folder = Folder::new();
    folder.refused(&["fit", "--objective", "l3"], &["l3", "l1", "l2"]);
    folder.refused(&["fit", "--layer", "tin"], &["\"tin\"", "metal"]);
    folder.refused(&["fit", "--layer", "metal", "--out", "t.bin"], &["t.bin", "--layer"]);
    folder.refused(&["fit", "--out", "none/t.bin"], &["no folder none"]);
    folder.refused(&["fit", "--layer", "sheen", "--maps", "none/maps"], &["none/maps", "cannot be made"]);
}

#[test]
fn sizes() {
    let folder = Folder::new();
    for size in ["5", "64x", "x48", "64*48", "64.5x48", "-64x48", "big", ""] {
        folder.refused(&["render", "scene.toml", "--size", size], &["--size", "remedy: ", "640x360"]);
    }
    for tolerance in ["0", "2", "1e-10", "nan", "x"] {
        folder.refused(&["reference", "scene.toml", "-o", "a.exr", "--tolerance", tolerance], &["1e-9 to 1"]);
    }
    let size = |size| folder.refused(&["render", "scene.toml", "--size", size], &["--size "]);
    size("0x0");
    size("0x48");
    size("100000x100000");
    size("16384x16384");
}

#[test]
fn frames() {
    let folder = Folder::new();
    for frames in ["0", "5..2", "5..5", "5", "a..b", "..", "0..-1", "-1..5", "0..=5"] {
        folder.refused(&["render", "scene.toml", "--frames", frames], &["A..B"]);
    }
    let several = ["render", "scene.toml", "--frames", "0..3", "-o"];
    for name in ["a.png", "a_%04x.png", "100%.exr"] {
        folder.refused(&[&several[..], &[name]].concat(), &[name, "%04d"]);
    }
    let aov = ["a_%04d.png", "--aov", "normal=n.exr"];
    folder.refused(&[&several[..], &aov].concat(), &["n.exr", "%04d"]);
}

#[test]
fn names_of_things() {
    let folder = Folder::new();
    let render = |words: &[&str], parts: &[&str]| {
        folder.refused(&[&["render", "scene.toml"], words].concat(), parts);
    };
    render(&["--camera", "side"], &["scene.toml", "\"side\"", "choose one of: main"]);
    render(&["--aov", "shine=a.exr"], &["\"shine\"", "wireframe, direct or indirect"]);
    render(&["--aov", "normal"], &["no NAME=FILE", "remedy: ", "normal=normal.exr"]);
    render(&["--aov", "normal="], &["no NAME=FILE"]);
    folder.refused(
        &["reference", "scene.toml", "-o", "a.exr", "--camera", "side"],
        &["scene.toml", "\"side\"", "main"],
    );
}

#[test]
fn overrides() {
    let folder = Folder::new();
    let set = |pair: &str, parts: &[&str]| {
        folder.refused(&["render", "scene.toml", "--set", pair], parts);
        folder.refused(&["bench", "scene.toml", "--set", pair], parts);
    };
    set("samples", &["no KEY=VALUE", "remedy: ", "samples=16"]);
    set("=4", &["no KEY=VALUE"]);
    set("sampels=4", &["--set sampels=4", "unknown key", "did you mean `samples`?"]);
    set("camera.near=1", &["--set camera.near=1", "unknown key"]);
    set("samples=many", &["--set samples=many", "whole number"]);
    set("samples=0", &["from 1 to 65536"]);
    set("samples=[1", &["--set samples=[1", "not valid TOML"]);
    set("exposure=nan", &["--set exposure=nan", "not a number"]);
    set("exposure=1e999", &["infinite"]);
    set("light_error=2", &["from 0 to 1"]);
    set("tonemap=filmic", &["none, aces, agx"]);
    set("background=[1, 1]", &["3 numbers"]);
    set("render.max_lights_per_cluster=4", &["from 128 to 2048"]);
}
