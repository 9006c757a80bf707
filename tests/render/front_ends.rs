//! Fragments against compute: the same light on the same pixels, whatever shades it.

use crate::support::{FIVE_MATERIALS, Rig, png, ranged_lights, scene_with, unranged_lights};
use amas::HdrImage;
use amas::scene::settings::FrontEnd;

type Files<'a> = [(&'a str, &'a [u8])];

fn rig(front_end: FrontEnd, text: &str, files: &Files<'_>) -> Rig {
    Rig::with(scene_with(text, files), |settings| settings.front_end = front_end)
}

/// Passes of the last picture.
fn passes(rig: &mut Rig) -> Vec<&'static str> {
    let inputs = amas::FrameInputs {
        time: 0.0,
        camera: &rig.scene.cameras[0],
        samples: 1,
        exposure: 0.0,
        split: true,
        progress: indicatif::ProgressBar::hidden(),
    };
    rig.frame.render(&inputs).unwrap().passes.iter().map(|pass| pass.name).collect()
}

/// Largest difference of a channel, relative to the largest channel of its pixel; black must be black.
fn difference(a: &HdrImage, b: &HdrImage) -> f32 {
    let of = |(a, b): (&[f32; 3], &[f32; 3])| {
        let largest = a.iter().chain(b).fold(0.0_f32, |m, v| m.max(*v));
        let off = a.iter().zip(b).fold(0.0_f32, |m, (a, b)| m.max((a - b).abs()));
        if largest > 0.0 { off / largest } else { 0.0 }
    };
    a.pixels.iter().zip(&b.pixels).map(of).fold(0.0, f32::max)
}

/// Both front ends draw the same picture; compute with `resolve`, and with `indirect` if fragments must help.
fn same(text: &str, files: &Files<'_>, mixed: bool) {
    let mut fragment = rig(FrontEnd::Fragment, text, files);
    let mut compute = rig(FrontEnd::Compute, text, files);
    let (a, b) = (fragment.render(), compute.render());
    assert!(a.pixels.iter().any(|p| p[0] > 0.0), "something is lit");
    let worst = difference(&a, &b);
    println!("{worst:.1e}");
    assert!(worst <= 1e-6, "{worst}");
    assert_eq!(b, compute.render(), "the same bits again");
    assert_eq!(fragment.frame.counters(), compute.frame.counters());
    let (a, b) = (passes(&mut fragment), passes(&mut compute));
    assert!(!a.contains(&"resolve") && a.contains(&"indirect"), "{a:?}");
    let behind = b.iter().position(|name| *name == "resolve").unwrap();
    assert_eq!(b[behind - 1..=behind + 1], ["cluster", "resolve", "direct"]);
    assert_eq!(b.contains(&"indirect"), mixed, "{b:?}");
}

/// The five materials without anisotropy: compute shades all of them.
fn round() -> String {
    let text = FIVE_MATERIALS.replace("alpha = [0.2, 0.4]", "alpha = 0.3");
    let kept = text.lines().filter(|line| !line.starts_with("anisotropic"));
    kept.map(|line| format!("{line}\n")).collect()
}

#[test]
fn all_materials() {
    same(&format!("{}{}", round(), ranged_lights(500, 1.0)), &[], false);
}

/// 6 × 4 pixels more than whole tiles, lights without a range beside, a background, samples.
#[test]
fn odd_sizes_samples_and_lights_beside() {
    let text =
        round().replace("size = [96, 64]", "size = [75, 53]\nsamples = 5\nbackground = [0.1, 0.2, 0.3]");
    same(&format!("{text}{}{}", ranged_lights(300, 1.5), unranged_lights(7)), &[], false);
    let text = round().replace("size = [96, 64]", "size = [1, 1]");
    same(&format!("{text}{}", ranged_lights(300, 1.5)), &[], false);
}

#[test]
fn orthographic_cameras() {
    let text = round().replace("vertical_fov = 40", "orthographic_height = 3");
    same(&format!("{text}{}", ranged_lights(300, 1.0)), &[], false);
}

/// Anisotropic lobes need tangents: fragments shade them, and compute the rest.
#[test]
fn anisotropy_is_left_to_fragments() {
    same(&format!("{FIVE_MATERIALS}{}", ranged_lights(500, 1.0)), &[], true);
}

#[test]
fn few_and_many_lights() {
    let one = "[[light]]\ntype = \"point\"\nposition = [0, 1, 1]\nintensity = [1, 2, 3]\nrange = 3\n";
    same(&format!("{}{one}", round()), &[], false);
    let text = round().replace("[render]", "[render]\nmax_lights_per_cluster = 2048");
    same(&format!("{text}{}", ranged_lights(20_000, 0.6)), &[], false);
}

/// Lists that are cut at their cap are cut alike.
#[test]
fn full_lists() {
    let text = round().replace("[render]", "[render]\nmax_lights_per_cluster = 128");
    same(&format!("{text}{}", ranged_lights(3000, 3.0)), &[], false);
}

/// Sheets before the spheres: one masked, which compute shades through its holes' rims, one textured, one seen from its
/// back, which is turned to the viewer or not drawn.
#[test]
fn masked_textured_and_two_sided_sheets() {
    let sheet = |name: &str, x: f32, rest: &str| {
        format!(
            "[[material]]\nname = \"{name}\"\n{rest}\n[[mesh]]\nshape = \"plane\"\nsize = 0.9\nrotate = [80, 0, 0]\n\
             translate = [{x}, 0.6, 1]\nmaterial = \"{name}\"\n"
        )
    };
    let sheets = [
        sheet("masked", -1.4, "type = \"matte\"\ncolor = [0.5, 0.6, 0.7]\nalpha_mask = \"m.png\""),
        sheet("textured", -0.4, "type = \"plastic\"\ndiffuse = { texture = \"t.png\" }\nroughness = 0.3"),
        sheet("one", 0.6, "type = \"matte\"\ncolor = [0.9, 0.6, 0.1]\ntwo_sided = false"),
        sheet(
            "two",
            1.6,
            "type = \"substrate\"\ndiffuse = [0.9, 0.6, 0.1]\nspecular = [0.1, 0.1, 0.1]\nroughness = 0.2",
        ),
    ];
    let mask = png([8, 8], |x, y| [if (x ^ y) & 1 == 0 { 255 } else { 0 }; 4]);
    let color = png([8, 8], |x, y| [30 * x as u8, 30 * y as u8, 90, 255]);
    let text = format!("{}{}{}", round(), sheets.concat(), ranged_lights(400, 1.5));
    same(&text, &[("m.png", &mask), ("t.png", &color)], true);
    let from_behind = text.replace("position = [0, 1.5, 5]", "position = [0, 1.5, -5]");
    same(&from_behind, &[("m.png", &mask), ("t.png", &color)], true);
}

/// Area lights that are seen hide what compute would shade behind them; enough of them for masks.
#[test]
fn area_lights_beside() {
    let lights: String = (0..9)
        .map(|i| {
            format!(
                "[[light]]\ntype = \"rect\"\ncenter = [{}, 0.8, 1.2]\nu = [0.1, 0, 0]\nv = [0, 0.3, 0]\nradiance = [3, 2, 1]\n",
                f64::from(i) * 0.4 - 1.6
            )
        })
        .collect();
    same(&format!("{}{lights}{}", round(), ranged_lights(300, 1.5)), &[], false);
}

/// Nothing that compute could shade, or nothing in lists: no resolve, and no surface image.
#[test]
fn scenes_without_use_for_it_do_not_pay() {
    let text = "[render]\nsize = [40, 40]\n[[camera]]\nname = \"c\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\n\
                vertical_fov = 40\n[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = { texture = \"t.png\" }\n\
                [[mesh]]\nshape = \"plane\"\nsize = 4\nmaterial = \"m\"\n";
    let color = png([8, 8], |x, y| [30 * x as u8, 30 * y as u8, 90, 255]);
    let files: [(&str, &[u8]); 1] = [("t.png", &color)];
    let textured = format!("{text}{}", ranged_lights(50, 2.0));
    let mut rig_textured = rig(FrontEnd::Compute, &textured, &files);
    assert_eq!(passes(&mut rig_textured), ["prepass", "cluster", "direct", "indirect", "present"]);
    let mut unranged = rig(FrontEnd::Compute, &format!("{}{}", round(), unranged_lights(3)), &[]);
    assert_eq!(passes(&mut unranged), ["prepass", "direct", "present"]);
    for rig in [&rig_textured, &unranged] {
        assert_eq!(rig.frame.cluster_targets().0.surface.size(), [1, 1]);
    }
}
