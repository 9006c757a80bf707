//! Picture files and their comparison, against numbers worked out by hand.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

use amas::compare::{Figures, Mask, Options, compare, compare_files, flip};
use amas::image::{save_png8, write_atomically};
use amas::{Error, HdrImage};

fn image(width: u32, pixels: &[[f32; 3]]) -> HdrImage {
    HdrImage { width, height: pixels.len() as u32 / width, pixels: pixels.to_vec() }
}

fn grey(width: u32, values: &[f32]) -> HdrImage {
    image(width, &values.iter().map(|&v| [v; 3]).collect::<Vec<_>>())
}

fn figures(a: &HdrImage, b: &HdrImage, options: &Options) -> Figures {
    compare(a, b, options).unwrap()
}

fn close(got: f64, want: f64) {
    assert!((got - want).abs() <= 1e-7 * want.abs().max(1e-3), "{got} against {want}");
}

#[test]
fn float_files_give_back_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let odd = [[0.0, -1.5, 1e-38], [f32::MAX, 1e-45, 65_504.0], [f32::INFINITY, 0.1, 3.0]];
    let picture = image(3, &odd);
    for name in ["a.exr", "a.pfm", "A.EXR"] {
        let path = folder.path().join(name);
        picture.save(&path).unwrap();
        assert_eq!(HdrImage::load(&path).unwrap(), picture, "{name}");
    }
    assert_eq!(picture.non_finite_count(), 1);
}

#[test]
fn pfm_is_written_from_the_bottom_up() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pfm");
    grey(1, &[1.0, 2.0]).save(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes.starts_with(b"PF\n1 2\n-1.0\n"));
    assert_eq!(bytes[12..16], 2.0_f32.to_le_bytes());
    let mut big_endian = b"Pf 1 2 1.0\n".to_vec();
    big_endian.extend([2.0_f32, 1.0].iter().flat_map(|v| v.to_be_bytes()));
    std::fs::write(&path, big_endian).unwrap();
    assert_eq!(HdrImage::load(&path).unwrap(), grey(1, &[1.0, 2.0]));
}

#[test]
fn png_is_decoded_to_linear() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    save_png8(&path, 3, 1, &[[0; 3], [188; 3], [255; 3]]).unwrap();
    let values: Vec<_> = HdrImage::load(&path).unwrap().pixels.iter().map(|p| p[0]).collect();
    assert_eq!((values[0], values[2]), (0.0, 1.0));
    assert!((values[1] - 0.502_886_5).abs() < 1e-6, "{}", values[1]);
}

#[test]
fn damaged_and_missing_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.exr", "a.pfm", "a.png", "a.hdr"] {
        let path = folder.path().join(name);
        for content in [None, Some(&b"PF\n99999999 99999999\n-1\nxx"[..]), Some(b"")] {
            content.into_iter().for_each(|content| std::fs::write(&path, content).unwrap());
            let error = HdrImage::load(&path).unwrap_err();
            assert!(matches!(error, Error::Input { .. }), "{error}");
            assert!(error.to_string().contains(name), "{error}");
        }
    }
    let error = HdrImage::load("a.tiff").unwrap_err();
    assert!(matches!(&error, Error::Usage { .. }) && error.to_string().contains(".exr"));
    assert_eq!(grey(1, &[1.0]).save("a.png").unwrap_err().exit_code(), 2);
}

#[test]
fn failed_writing_leaves_nothing_new_and_everything_old() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    let fail = |file: &mut std::io::BufWriter<std::fs::File>| {
        std::io::Write::write_all(file, b"half")?;
        Err(std::io::Error::other("the disk is full"))
    };
    let error = write_atomically(&path, fail).unwrap_err();
    assert!(matches!(error, Error::Write { .. }) && error.exit_code() == 1);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    std::fs::write(&path, "old").unwrap();
    write_atomically(&path, fail).unwrap_err();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let nowhere = folder.path().join("none/a.exr");
    assert!(matches!(grey(1, &[1.0]).save(nowhere), Err(Error::Write { .. })));
}

#[test]
fn figures_by_hand() {
    // B has mean 2; A is off by 10 %, 0, 50 % and by all of a floor of 0.02.
    let b = grey(2, &[1.0, 3.0, 4.0, 0.0]);
    let a = grey(2, &[1.1, 3.0, 2.0, 0.02]);
    let got = figures(&a, &b, &Options::default());
    let d = f64::from(1.1_f32) - 1.0;
    let e = f64::from(0.02_f32);
    close(got.mean_relative_error, (d + 0.5 + e / 0.02) / 4.0);
    close(got.p50, d);
    close(got.p99, e / 0.02);
    close(got.max, e / 0.02);
    close(got.rmse, ((d * d + 4.0 + e * e) / 4.0).sqrt());
    close(got.rel_mse, (d * d / 1.04 + 4.0 / 16.04 + e * e / 0.04) / 4.0);
    close(got.mean_bias, (d - 2.0 + e) / 8.0);
    close(got.beyond_one_percent, 0.75);
    assert_eq!((got.largest_a, got.largest_b, got.compared), (3.0, 4.0, 4));
}

#[test]
fn blocks_average_what_the_mask_keeps() {
    // Blocks of 2: the first is whole, the second ends at the border, its lower pixel is masked out.
    let b = grey(3, &[1.0, 1.0, 2.0, 1.0, 1.0, 9.0]);
    let a = grey(3, &[1.2, 0.8, 2.2, 1.0, 1.0, 0.0]);
    let keep = vec![true, true, true, true, true, false];
    let mask = Mask { width: 3, height: 2, keep };
    let options = Options { mask: Some(&mask), block: 2, ..Options::default() };
    let got = figures(&a, &b, &options);
    assert_eq!(got.compared, 2);
    assert!((got.max - 0.1).abs() < 1e-6 && got.p50 < 1e-6, "{got:?}");
    close(got.beyond_one_percent, 0.5);
}

#[test]
fn non_finite_pixels_are_counted_and_left_out() {
    let b = grey(1, &[1.0, 1.0, 1.0]);
    let a = grey(1, &[1.0, f32::NAN, f32::INFINITY]);
    let got = figures(&a, &b, &Options::default());
    assert_eq!((got.non_finite, got.compared, got.max, got.flip), (2, 1, 0.0, 0.0));
}

#[test]
fn sizes_must_agree() {
    let error = compare(&grey(1, &[1.0]), &grey(2, &[1.0; 2]), &Options::default()).unwrap_err();
    assert!(error.to_string().contains("1x1") && error.to_string().contains("2x1"), "{error}");
    let mask = Mask { width: 1, height: 1, keep: vec![false] };
    let options = Options { mask: Some(&mask), ..Options::default() };
    assert_eq!(compare(&grey(1, &[1.0]), &grey(1, &[1.0]), &options).unwrap_err().exit_code(), 2);
}

#[test]
fn files_with_a_mask() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    save_png8(path("mask.png"), 2, 1, &[[255; 3], [254; 3]]).unwrap();
    grey(2, &[1.0, 5.0]).save(path("a.exr")).unwrap();
    grey(2, &[1.0, 1.0]).save(path("b.pfm")).unwrap();
    let mask = path("mask.png");
    let got = compare_files(&path("a.exr"), &path("b.pfm"), Some(&mask), 1).unwrap();
    assert_eq!((got.compared, got.max), (1, 0.0));
    let json = serde_json::to_value(got).unwrap();
    assert!(json["p99.9"].is_number() && json["beyond_one_percent"].is_number());
}

/// NVIDIA's flip-evaluator 1.7 gives 0.967365 (float32) for black against white, and for the pair below.
#[test]
fn flip_agrees_with_the_published_implementation() {
    let (black, white) = (grey(64, &[0.0; 64 * 48]), grey(64, &[1.0; 64 * 48]));
    let mean = |a: &HdrImage, b: &HdrImage| {
        let map = flip::map(a, b, true);
        map.iter().sum::<f64>() / map.len() as f64
    };
    assert_eq!(mean(&white, &white), 0.0);
    assert!((mean(&black, &white) - 0.967_37).abs() < 5e-5);
    let (a, b) = (stripes(0), stripes(2));
    assert!((mean(&a, &b) - FLIP_OF_STRIPES).abs() < 5e-6, "{}", mean(&a, &b));
    // Independent of the exposure of scene-linear pictures.
    let brighter = |image: &HdrImage| image.pixels.iter().map(|p| p.map(|v| v * 64.0)).collect::<Vec<_>>();
    let (flip, scaled) = (flip::map(&a, &b, false), {
        flip::map(&image(96, &brighter(&a)), &image(96, &brighter(&b)), false)
    });
    assert!(flip.iter().zip(scaled).all(|(x, y)| (x - y).abs() < 1e-6));
}

const FLIP_OF_STRIPES: f64 = 0.207_560;

/// Coloured squares, shifted by some pixels: 8-bit values 40, 120, 200 decoded from sRGB.
fn stripes(shift: u32) -> HdrImage {
    let decode = |v: u32| amas::image::srgb_to_linear(f64::from(v) / 255.0) as f32;
    let level = |i: u32| decode(40 + 80 * (i % 3));
    let pixel = |i: u32| {
        let (x, y) = (i % 96 + shift, i / 96);
        [level(x / 11), level(y / 7), level(x / 11 + y / 7)]
    };
    image(96, &(0..96 * 64).map(pixel).collect::<Vec<_>>())
}
