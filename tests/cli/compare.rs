//! `amas compare`: known answers through files.

use crate::{Folder, png};
use amas::HdrImage;
use serde_json::Value;

/// Figures that are 0 between equal pictures.
const ERRORS: [&str; 11] = [
    "beyond_one_percent",
    "flip",
    "max",
    "mean_bias",
    "mean_relative_error",
    "non_finite",
    "p50",
    "p99",
    "p99.9",
    "rel_mse",
    "rmse",
];

fn constant(value: f32) -> HdrImage {
    HdrImage { width: 16, height: 8, pixels: vec![[value; 3]; 128] }
}

fn figures(folder: &Folder, arguments: &[&str]) -> Value {
    let json = folder.done(&[&["compare"], arguments, &["--json"]].concat());
    serde_json::from_str(&json).unwrap()
}

#[test]
fn identical_pictures() {
    let folder = Folder::new();
    folder.done(&["render", "scene.toml", "-o", "a.exr", "-o", "a.pfm", "-o", "a.png"]);
    for (a, b) in [("a.exr", "a.exr"), ("a.exr", "a.pfm"), ("a.png", "a.png")] {
        let figures = figures(&folder, &[a, b]);
        for key in ERRORS {
            assert_eq!(figures[key].as_f64(), Some(0.0), "{key} of {a} and {b}");
        }
        assert_eq!(figures["compared"], 64 * 48);
        assert_eq!((&figures["width"], &figures["height"]), (&64.into(), &48.into()));
        assert_eq!(figures["largest_a"], figures["largest_b"]);
    }
    let table = folder.done(&["compare", "a.exr", "a.exr"]);
    for row in ["relMSE", "RMSE", "mean bias", "p50", "p99.9", "max", "beyond 1 %", "FLIP"] {
        assert!(table.contains(row), "{row}: {table}");
    }
}

#[test]
fn known_differences() {
    let folder = Folder::new();
    constant(1.5).save(folder.path("a.exr")).unwrap();
    constant(1.0).save(folder.path("b.pfm")).unwrap();
    let half = figures(&folder, &["a.exr", "b.pfm"]);
    for key in ["rmse", "mean_bias", "mean_relative_error", "p50", "p99", "p99.9", "max"] {
        assert_eq!(half[key], 0.5, "{key}");
    }
    assert_eq!(half["beyond_one_percent"], 1.0);
    assert!((half["rel_mse"].as_f64().unwrap() - 0.25 / 1.01).abs() < 1e-12);
    assert!(half["flip"].as_f64().unwrap() > 0.0);
    assert_eq!(figures(&folder, &["b.pfm", "a.exr"])["mean_bias"], -1.0 / 3.0);
    folder.write("c.png", png(16, 8, |_, _| [255; 4]));
    let warned =
        |a: &str| folder.run(&["compare", a, "b.pfm"]).stderr.contains("scene-linear, the other a .png");
    assert_eq!([warned("c.png"), warned("a.exr")], [true, false]);
}

#[test]
fn masks_and_blocks() {
    let folder = Folder::new();
    constant(1.0).save(folder.path("b.pfm")).unwrap();
    let mut a = constant(1.0);
    a.pixels[0] = [2.0; 3];
    a.pixels[1] = [0.0; 3];
    a.save(folder.path("a.pfm")).unwrap();
    folder.write("m.png", png(16, 8, |x, _| if x < 2 { [0, 0, 0, 255] } else { [255; 4] }));
    let masked = figures(&folder, &["a.pfm", "b.pfm", "--mask", "m.png"]);
    assert_eq!((&masked["compared"], &masked["max"]), (&112.into(), &0.0.into()));
    let pixels = figures(&folder, &["a.pfm", "b.pfm"]);
    assert_eq!((&pixels["compared"], &pixels["max"]), (&128.into(), &1.0.into()));
    // The two errors cancel in a block.
    let blocks = figures(&folder, &["a.pfm", "b.pfm", "--block", "4"]);
    assert_eq!((&blocks["compared"], &blocks["max"]), (&8.into(), &0.0.into()));
    a.pixels[0] = [f32::NAN; 3];
    a.save(folder.path("nan.pfm")).unwrap();
    assert_eq!(figures(&folder, &["nan.pfm", "b.pfm"])["non_finite"], 1);
}
