//! `[render]`, cameras and overrides.

use amas::scene::{
    Projection, load_embedded,
    settings::{FrontEnd, Tonemap},
};
use glam::DVec3;

use crate::{CAMERA, load, try_load};

#[test]
fn a_scene_may_be_a_camera_alone() {
    let scene = load("", &[]);
    assert_eq!(scene.render, Default::default());
    assert_eq!((scene.meshes.len(), scene.point_lights.len(), scene.cameras.len()), (0, 0, 1));
    let camera = &scene.cameras[0];
    assert_eq!((camera.near, camera.far, camera.up), (0.05, None, DVec3::Y));
    assert_eq!(camera.projection, Projection::Perspective { vertical_fov: 45.0 });
}

#[test]
fn every_key_of_render_arrives() {
    let toml = "[render]\nsize = [320, 240]\nexposure = -1\nsamples = 16\ntonemap = \"aces\"\n\
        background = [0.1, 0.2, 0.3]\nlight_error = 0\nmax_lights_per_cluster = 2_048\n\
        indirect = { vpls = 1000, bounces = 5 }\nshadows = true\n";
    let render = load(toml, &[]).render;
    assert_eq!((render.size, render.exposure, render.samples), ([320, 240], -1.0, 16));
    assert_eq!((render.tonemap, render.background), (Tonemap::Aces, [0.1, 0.2, 0.3]));
    assert_eq!((render.light_error, render.max_lights_per_cluster), (0.0, 2048));
    assert_eq!((render.vpls, render.bounces, render.shadows), (1000, 5, true));
}

#[test]
fn a_table_below_render_is_as_good_as_an_inline_one() {
    let render = load("[render.indirect]\nvpls = 7\n", &[]).render;
    assert_eq!((render.vpls, render.bounces), (7, 3));
}

#[test]
fn overrides_win_over_the_file_and_the_last_one_over_all() {
    let set = [
        ("render.size", "[64, 32]"),
        ("exposure", "2"),
        ("tonemap", "none"),
        ("render.tonemap", "\"aces\""),
        ("shadows", "true"),
        ("indirect", "{ vpls = 5 }"),
        ("render.indirect.bounces", "1"),
        ("front_end", "fragment"),
        ("render.front_end", "compute"),
        ("light_error", "0.5"),
        ("light_error", " 0.25 "),
    ];
    let render = try_load("[render]\nexposure = 1\nlight_error = 0.1\n", &[], &set).unwrap().render;
    assert_eq!((render.size, render.exposure, render.tonemap), ([64, 32], 2.0, Tonemap::Aces));
    assert_eq!((render.shadows, render.vpls, render.bounces), (true, 5, 1));
    assert_eq!((render.light_error, render.front_end), (0.25, FrontEnd::Compute));
}

#[test]
fn bad_overrides_name_the_set() {
    let cases = [
        ("sizes", "[1, 1]", "did you mean `size`?"),
        ("camera.near", "1", "use one of"),
        ("size", "[0, 1]", "`size[0]` must be from 1 to 16384"),
        ("size", "[1, 1", "not valid TOML"),
        ("exposure", "", "not valid TOML"),
        ("exposure", "bright", "`exposure` must be a number"),
        ("exposure", "nan", "nan"),
        ("tonemap", "acess", "did you mean `aces`?"),
        ("front_end", "computer", "did you mean `compute`?"),
        ("shadows", "True", "must be true or false"),
        ("samples", "0", "must be from 1 to 65536"),
        ("samples", "1\nsize = [1, 1]", "not valid TOML"),
        ("max_lights_per_cluster", "127", "must be from 128 to 2048"),
        ("indirect", "{ vlps = 5 }", "did you mean `vpls`?"),
        ("light_error", "-1", "must be from 0 to 1"),
        ("light_error", "5%", "write a share, `0.05`"),
        ("size", "160x90", "write `[160, 90]`"),
        ("indirect", "256", "did you mean `indirect.vpls`"),
        ("vpls", "256", "did you mean `indirect.vpls`?"),
    ];
    for (key, value, part) in cases {
        let error = try_load("", &[], &[(key, value)]).unwrap_err();
        let text = error.to_string();
        assert_eq!(error.exit_code(), 2);
        assert!(text.contains(&format!("--set {key}={value}")), "{text}");
        assert!(text.contains(part) && text.contains("remedy: "), "{text}");
    }
}

#[test]
fn cameras_have_names_planes_and_paths() {
    let toml = "[[camera]]\nname = \"top\"\nposition = [0, 10, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -2]\n\
        orthographic_height = 10\nnear = 1\nfar = 20\n\
        path = [{ t = 0, position = [0, 10, 0], target = [0, 0, 0] },\n\
        { t = 2, position = [4, 10, 0], target = [4, 0, 0] }]\n";
    let scene = load(toml, &[]);
    assert_eq!(scene.cameras[0].name, "camera 1");
    let top = &scene.cameras[1];
    assert_eq!((top.name.as_str(), top.near, top.far), ("top", 1.0, Some(20.0)));
    assert_eq!(top.projection, Projection::Orthographic { height: 10.0 });
    assert_eq!(top.up, DVec3::NEG_Z);
    assert_eq!(top.at(1.0).position, DVec3::new(2.0, 10.0, 0.0));
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_fine() {
    let toml = format!("\u{feff}{CAMERA}").replace('\n', "\r\n");
    assert_eq!(load_embedded("t", &toml, &[], &[]).unwrap().cameras.len(), 1);
    let error = load_embedded("t", &format!("{toml}nera = 1\r\n"), &[], &[]).unwrap_err();
    assert!(error.to_string().starts_with("t:5: unknown key `nera`"), "{error}");
}

#[test]
fn files_come_from_beside_the_scene_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("my models")).unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::fs::write(folder.path().join("my models/m.obj"), obj).unwrap();
    let path = folder.path().join("s.toml");
    std::fs::write(&path, format!("{CAMERA}[[mesh]]\nobj = \"my models/m.obj\"\n")).unwrap();
    assert_eq!(amas::scene::load(&path, &[]).unwrap().meshes.len(), 1);
    std::fs::write(&path, b"# \xff\n").unwrap();
    let error = amas::scene::load(&path, &[]).unwrap_err().to_string();
    assert!(error.contains("s.toml:1: ") && error.contains("UTF-8"), "{error}");
    let error = amas::scene::load(&folder.path().join("none.toml"), &[]).unwrap_err().to_string();
    assert!(error.contains("none.toml: cannot read"), "{error}");
}
