//! Textures, normal maps and masks against the oracle, magnified so that both filter the same texels.

use crate::support::{Rig, assert_close, oracle, png, scene_with};
use amas::passes::aov::Quantity;

fn wall(material: &str) -> String {
    format!(
        "[render]\nsize = [120, 120]\n[[camera]]\nname = \"c\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\nup = [0.3, 0, -1]\n\
         vertical_fov = 40\n[[material]]\nname = \"m\"\n{material}\n[[mesh]]\nshape = \"plane\"\nsize = 4\nmaterial = \"m\"\n\
         [[light]]\ntype = \"point\"\nposition = [1.5, 1.2, 0.7]\nintensity = [3, 3, 3]\n\
         [[light]]\ntype = \"point\"\nposition = [-1, 2, -0.4]\nintensity = [3, 2, 1]\n"
    )
}

fn check(material: &str, texel: impl Fn(u32, u32) -> [u8; 4]) {
    let mut rig = Rig::new(scene_with(&wall(material), &[("t.png", &png([8, 8], texel))]));
    // Filter weights have 8 bits or more on every device: 1/256 of the difference of two texels.
    assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-2);
}

/// Every row and column differs, so a flipped or shifted picture fails.
fn gradient(x: u32, y: u32) -> [u8; 4] {
    [20 + 25 * x as u8, 40 + 20 * y as u8, 100 + 10 * (x as u8 ^ y as u8), 255]
}

#[test]
fn colours_are_decoded_and_upright() {
    check("type = \"matte\"\ncolor = { texture = \"t.png\" }", gradient);
    check("type = \"principled\"\nbase_color = { texture = \"t.png\" }\nroughness = 0.6", gradient);
}

#[test]
fn scalars_are_linear() {
    check("type = \"plastic\"\ndiffuse = [0.2, 0.2, 0.2]\nroughness = { texture = \"t.png\" }", |x, y| {
        [120 + 8 * x as u8 + 6 * y as u8, 0, 0, 255]
    });
}

#[test]
fn two_textures_take_two_slots() {
    let material = "type = \"plastic\"\ndiffuse = { texture = \"t.png\" }\nspecular = { texture = \"t.png\" }\nroughness = 0.5";
    check(material, gradient);
}

#[test]
fn normal_maps_tilt_along_tangent_and_bitangent() {
    check("type = \"matte\"\ncolor = [0.8, 0.8, 0.8]\nnormal_map = \"t.png\"", |x, y| {
        [128 + 9 * (x as u8 % 4), 118 + 5 * (y as u8 % 5), 230, 255]
    });
}

#[test]
fn anisotropy_follows_the_tangent() {
    let brushed = "type = \"metal\"\npreset = \"aluminium\"\nroughness = 0.5\nanisotropic = 0.9";
    check(brushed, gradient);
    check(
        "type = \"metal\"\npreset = \"copper\"\nroughness = 0.6\nanisotropic = { texture = \"t.png\" }",
        gradient,
    );
}

#[test]
fn masks_cut_and_what_is_behind_shows() {
    let text = wall("type = \"matte\"\ncolor = [0.8, 0.8, 0.8]\nalpha_mask = \"t.png\"");
    let half = png([8, 8], |x, _| [if x < 4 { 0 } else { 255 }, 0, 0, 255]);
    let mut rig = Rig::new(scene_with(&text, &[("t.png", &half)]));
    let picture = rig.render();
    let expected = oracle(&rig.scene);
    let lit = |image: &amas::HdrImage| image.pixels.iter().map(|p| p[0] > 0.0).collect::<Vec<_>>();
    let differing = lit(&picture).iter().zip(lit(&expected)).filter(|(a, b)| **a != *b).count();
    // The cut is a line through the picture: a pixel on it may fall on either side.
    assert!(differing <= 4, "{differing}");
    let share = lit(&picture).iter().filter(|lit| **lit).count() as f64 / 14400.0;
    assert!((0.4..0.6).contains(&share), "{share}");
    for count in rig.aov(Quantity::Coverage) {
        assert!(count[0] == 0.0 || count[0] == 1.0);
    }
}
