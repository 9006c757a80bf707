//! The oracle against Mitsuba 3's pictures of `../shared/reference`, where that folder is.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

use std::path::PathBuf;

use amas::HdrImage;
use amas::compare::{Figures, Mask, Options as Compare, compare};
use amas::reference::{Integrator, Options, render};
use amas::scene::{self, Scene};

/// The scene's oracle picture against one of Mitsuba's, and the figures under its mask; `None` without the folder.
///
/// `seen_from_behind`: pixels where Mitsuba's is exactly black although something is there. Its surfaces are one-sided,
/// ours turn to the viewer, so the inside of the vase differs by rule; these pixels are left out.
fn figures(name: &str, tolerance: f64, block: u32, seen_from_behind: bool) -> Option<Figures> {
    let options = |scene: &Scene| Options { tolerance, ..Options::of_scene(scene) };
    figures_of([name, "reference.exr"], options, block, seen_from_behind)
}

fn figures_of(
    [name, picture]: [&str; 2],
    options: impl Fn(&Scene) -> Options,
    block: u32,
    seen_from_behind: bool,
) -> Option<Figures> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/reference").join(name);
    if !folder.is_dir() {
        println!("{} is not there: nothing is compared", folder.display());
        return None;
    }
    let scene = scene::load(&folder.join("scene.toml"), &[]).unwrap();
    let got = render(&scene, &scene.cameras[0], &options(&scene)).unwrap().image;
    let want = HdrImage::load(folder.join(picture)).unwrap();
    let mut mask = Mask::load(folder.join("mask.png")).unwrap();
    if seen_from_behind {
        let black = want.pixels.iter().map(|pixel| *pixel == [0.0; 3]);
        mask.keep.iter_mut().zip(black).for_each(|(keep, black)| *keep &= !black);
    }
    let options = Compare { mask: Some(&mask), block, ..Compare::default() };
    let figures = compare(&got, &want, &options).unwrap();
    println!("{name}: {figures:#?}");
    Some(figures)
}

#[test]
fn points_on_all_five_models_are_exact() {
    if let Some(figures) = figures("f_points64", 1e-3, 1, false) {
        assert!(figures.p99 < 1e-5, "{figures:#?}");
        assert!(figures.max < 1e-4, "{figures:#?}");
        assert!(figures.mean_bias.abs() < 1e-6, "{figures:#?}");
    }
}

/// Bounds: the reference's own error (its README), which block means divide by about 8, and the tolerance.
#[test]
fn rectangle_over_metal() {
    within_noise(figures("a_rect_metal", 1e-2, 8, false), 1.2e-2 / 2.0);
}

#[test]
fn rectangles_over_plastic() {
    within_noise(figures("b_rect_plastic", 2e-2, 8, false), 1.1e-2 / 2.0);
}

#[test]
fn disk_over_mixed_materials() {
    within_noise(figures("d_disk_mixed", 2e-2, 8, true), 0.4e-2 / 2.0);
}

/// The box with visibility; the light is not seen and hides nothing.
#[test]
fn shadows_in_a_box() {
    let options = |scene: &Scene| Options {
        integrator: Integrator::Shadowed,
        tolerance: 1e-2,
        ..Options::of_scene(scene)
    };
    within_noise(figures_of(["g_cornell", "reference_direct.exr"], options, 8, false), 0.4e-2 / 2.0);
}

fn within_noise(figures: Option<Figures>, mean: f64) {
    if let Some(figures) = figures {
        assert!(figures.mean_relative_error < mean, "{figures:#?}");
        assert!(figures.mean_bias.abs() < 3e-4, "{figures:#?}");
    }
}
