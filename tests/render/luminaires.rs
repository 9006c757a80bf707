//! Area lights that are seen.

use crate::support::{Rig, oracle, png, scene, scene_with};
use amas::HdrImage;
use amas::passes::aov::Quantity;

/// A camera before a wall of lights; nothing else.
fn view(lights: &str) -> String {
    format!(
        "[render]\nsize = [60, 44]\nbackground = [0.1, 0.2, 0.3]\n[[camera]]\nname = \"c\"\nposition = [0.1, 0.2, 4]\n\
         target = [0, 0, 0]\nvertical_fov = 50\n{lights}"
    )
}

const SHAPES: &str = "[[light]]\ntype = \"rect\"\ncenter = [-1.4, 0.8, 0]\nu = [0.5, 0, 0.1]\nv = [0.1, 0.6, 0]\nradiance = [3, 2, 1]\n\
    [[light]]\ntype = \"disk\"\ncenter = [0.2, 0.7, 0]\nnormal = [0.2, 0, 1]\nradius = 0.7\nradiance = [1, 2, 3]\n\
    [[light]]\ntype = \"rect\"\ncenter = [1.6, 0.8, -1]\nu = [-0.5, 0, 0]\nv = [0, 0.6, 0]\nradiance = [9, 9, 9]\n\
    [[light]]\ntype = \"line\"\na = [-1.5, -0.4, 0]\nb = [1.2, -0.6, 0.3]\nradius = 0.2\nradiance = [5, 5, 1]\n\
    [[light]]\ntype = \"polygon\"\nvertices = [[-1, -1.6, 0], [1, -1.6, 0], [1, -0.9, 0], [0, -1.4, 0], [-1, -0.9, 0]]\n\
    holes = [[[0.6, -1.5, 0], [0.9, -1.5, 0], [0.9, -1.3, 0]]]\nradiance = [2, 7, 2]\n";

/// Pixels that differ.
fn differing(a: &HdrImage, b: &HdrImage, bound: f32) -> usize {
    let close =
        |(a, b): (&[f32; 3], &[f32; 3])| (0..3).all(|c| (a[c] - b[c]).abs() <= bound * b[c].abs().max(1e-3));
    a.pixels.iter().zip(&b.pixels).filter(|pair| !close(*pair)).count()
}

/// Backs of one-sided lights are black and hide what is behind them.
#[test]
fn luminaires_are_seen_as_the_oracle_sees_them() {
    let mut rig = Rig::new(scene(&view(SHAPES)));
    let (picture, expected) = (rig.render(), oracle(&rig.scene));
    let black = |image: &HdrImage| image.pixels.iter().filter(|p| **p == [0.0; 3]).count();
    assert!(black(&expected) > 50, "a back is in view");
    // Rims of disk and cylinder are polygons here.
    let count = differing(&picture, &expected, 1e-6);
    assert!(count <= 8, "{count} pixels differ");
    let hidden = SHAPES.replace("radiance", "visible = false\nradiance");
    let picture = Rig::new(scene(&view(&hidden))).render();
    assert!(picture.pixels.iter().all(|p| *p == [0.1, 0.2, 0.3]));
}

fn ramp() -> Vec<u8> {
    png([6, 5], |x, y| [40 * x as u8 + 20, 50 * y as u8 + 5, 30 * (x ^ y) as u8, 255])
}

/// Magnified, so that both look at the same texels: upright, clamped, decoded.
#[test]
fn textures_of_luminaires_are_the_oracle_s() {
    let textured = SHAPES.replace("radiance = [3, 2, 1]", "radiance = [3, 2, 1]\ntexture = \"t.png\"");
    let textured = textured.replace("radiance = [1, 2, 3]", "radiance = [1, 2, 3]\ntexture = \"t.png\"");
    let textured = textured.replace(
        "radiance = [2, 7, 2]",
        "radiance = [2, 7, 2]\ntexture = \"t.png\"\nuvs = [[-0.5, 0.1], [1.2, 0], [1.2, 0.9], [0.35, 0.34], [-0.5, 1]]",
    );
    assert_eq!(textured.matches("t.png").count(), 3);
    let mut rig = Rig::new(scene_with(&view(&textured), &[("t.png", &ramp())]));
    let (picture, expected) = (rig.render(), oracle(&rig.scene));
    let count = differing(&picture, &expected, 2e-4);
    assert!(count <= 8, "{count} pixels differ");
}

/// Beyond 0…1 the border goes on, and nothing of what lies near it, however few pixels see it: a white square with a black
/// border of a sixteenth is the lower left quarter of a light.
#[test]
fn borders_of_textures_go_on_when_blurred() {
    let black = |x: u32| x == 0 || x == 15;
    let bytes = png([16, 16], |x, y| [if black(x) || black(y) { 0 } else { 255 }; 4]);
    let polygon = "[[light]]\ntype = \"polygon\"\nvertices = [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]]\n\
        uvs = [[0, 0], [2, 0], [2, 2], [0, 2]]\nradiance = [1, 1, 1]\ntexture = \"t.png\"\n";
    let text = view(polygon).replace("[60, 44]", "[8, 8]").replace("[0.1, 0.2, 4]", "[0, 0, 4]");
    let text = text.replace("vertical_fov = 50", "orthographic_height = 4");
    let mut rig = Rig::new(scene_with(&text, &[("t.png", &bytes)]));
    let picture = rig.render();
    let value = |x: usize, y: usize| f64::from(picture.pixels[y * 8 + x][0]);
    // A pixel is four texels wide; next to the picture a look-up may reach into it.
    for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))).filter(|(x, y)| *x > 4 || *y < 3) {
        assert!(value(x, y).abs() < 1e-6, "{x}, {y}: {}", value(x, y));
    }
    let sum: f64 = (0..64).map(|i| value(i % 8, i / 8)).sum();
    let expected = 196.0 / 256.0 / 4.0;
    assert!((sum / 64.0 / expected - 1.0).abs() < 0.02, "{sum}");
}

/// Far away a pixel holds many texels, and shows their mean.
#[test]
fn small_pictures_of_luminaires_are_filtered() {
    let texture = |x: u32, y: u32| if (x + y).is_multiple_of(2) { 255 } else { 0 };
    let bytes = png([255, 129], |x, y| [texture(x, y), 255, 0, 255]);
    let rect = "[[light]]\ntype = \"rect\"\ncenter = [0, 0, 0]\nu = [3, 0, 0]\nv = [0, 3, 0]\nradiance = [1, 1, 1]\ntexture = \"t.png\"\n";
    let mut rig = Rig::new(scene_with(&view(rect).replace("[60, 44]", "[8, 8]"), &[("t.png", &bytes)]));
    for [r, g, b] in rig.render().pixels {
        assert!((r - 0.5).abs() < 0.02 && (g - 1.0).abs() < 1e-4 && b == 0.0, "{r} {g} {b}");
    }
}

/// What is behind a luminaire is hidden, what is before it hides it, and each pixel is one of them.
#[test]
fn luminaires_and_surfaces_hide_each_other() {
    let wall = "[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = [0.5, 0.5, 0.5]\n\
        [[mesh]]\nshape = \"plane\"\nsize = 12\nrotate = [90, 0, 0]\ntranslate = [0, 0, -2]\nmaterial = \"m\"\n\
        [[mesh]]\nshape = \"sphere\"\nradius = 0.3\ntranslate = [-1.2, 0.7, 0.7]\nmaterial = \"m\"\n\
        [[light]]\ntype = \"point\"\nposition = [0, 0, 6]\nintensity = [9, 9, 9]\n";
    for samples in [1, 3] {
        let text = view(&format!("{wall}{SHAPES}"))
            .replace("background", &format!("samples = {samples}\nbackground"));
        let mut rig = Rig::new(scene(&text));
        let picture = rig.render();
        let coverage = rig.aov(Quantity::Coverage);
        assert!(coverage.iter().all(|count| count[0] == 1.0), "the wall fills the picture");
        let materials = rig.aov(Quantity::Material);
        let normals = rig.aov(Quantity::Normal);
        let positions = rig.aov(Quantity::Position);
        let counts = rig.aov(Quantity::LightCount);
        let mut seen = 0;
        for index in 0..materials.len() {
            let luminaire = materials[index][0] < 0.0;
            seen += usize::from(luminaire);
            assert_eq!(materials[index][0], if luminaire { -1.0 } else { 0.0 });
            assert_eq!(counts[index][0], if luminaire { 0.0 } else { 6.0 });
            // The normals of a cylinder of 24 sides turn away before its sides do.
            assert!(normals[index][2] > -0.2, "turned to the viewer");
            assert!(!luminaire || positions[index][2] > -1.5);
        }
        let lit = |p: &&[f32; 3]| {
            [[3.0, 2.0, 1.0], [1.0, 2.0, 3.0], [5.0, 5.0, 1.0], [2.0, 7.0, 2.0], [0.0; 3]].contains(*p)
        };
        if samples == 1 {
            assert_eq!(picture.pixels.iter().filter(lit).count(), seen);
        }
        assert!(seen > 200);
    }
}

/// Of clusters and their lights a luminaire has what a pixel without a surface has.
#[test]
fn luminaires_are_in_no_cluster() {
    let floor = "[[material]]\nname = \"m\"\ntype = \"plastic\"\n\
        [[mesh]]\nshape = \"plane\"\nsize = 3\nrotate = [90, 0, 0]\nmaterial = \"m\"\ntranslate = [0, 0, -2]\n\
        [[light]]\ntype = \"point\"\nposition = [0, 0, 2]\nintensity = [9, 9, 9]\nrange = 9\n";
    let mut rig = Rig::new(scene(&view(&format!("{floor}{SHAPES}"))));
    rig.render();
    let materials = rig.aov(Quantity::Material);
    for quantity in [
        Quantity::LightCount,
        Quantity::Cluster,
        Quantity::Slice,
        Quantity::PairRatio,
        Quantity::Folded,
        Quantity::LightError,
        Quantity::Albedo,
        Quantity::Roughness,
        Quantity::LtcBound,
    ] {
        let values = rig.aov(quantity);
        let of = |kind: fn(&[f32; 4]) -> bool| {
            let chosen = materials.iter().zip(&values).filter(move |(material, _)| kind(material));
            chosen.map(|(_, value)| *value).collect::<Vec<_>>()
        };
        let [light, nothing] = [of(|m| m[3] > 0.0 && m[0] < 0.0), of(|m| m[3] == 0.0)];
        assert!(light.len() > 200 && nothing.len() > 200, "{} {}", light.len(), nothing.len());
        assert!(light.iter().chain(&nothing).all(|value| *value == [0.0; 4]), "{quantity:?}: {:?}", light[0]);
        let surface = of(|m| m[3] > 0.0 && m[0] >= 0.0);
        assert!(surface.len() > 50 && surface.iter().all(|value| value[3] == 1.0), "{quantity:?}");
    }
}
