//! Scenes that have little to trace, or what numbers break on.

use amas::scene::{AreaShape, Scene};
use amas::shared::VirtualPair;
use amas::virtual_lights::{LightSet, Tracer, VirtualTree};
use glam::Vec3;

use crate::{sane, scene};

fn traced(scene: &Scene, origin: Vec3) -> LightSet {
    let set = Tracer::new(scene, origin).trace(2000, 1);
    sane(&set.bounced);
    sane(&set.emitters);
    assert!(set.spacing.is_finite());
    for lights in [&set.bounced, &set.emitters] {
        let tree = VirtualTree::new(lights);
        let powers = |pair: &VirtualPair| [pair.powers << 16, pair.powers & 0xffff_0000].map(f32::from_bits);
        assert!(tree.pairs.iter().flat_map(powers).all(|power| power.is_finite() && power >= 0.0));
    }
    set
}

const BOX: &str = "[[mesh]]\nshape = \"box\"\nsize = 2\nmaterial = \"m\"\n";
const POINT: &str = "[[light]]\ntype = \"point\"\nposition = [0.1, 0.2, 0.3]\nintensity = [1, 1, 1]\n";
const RECT: &str = "[[light]]\ntype = \"rect\"\ncenter = [0, 0.5, 0]\nu = [0.5, 0, 0]\nv = [0, 0, 0.5]\nradiance = [1, 1, 1]\n";

#[test]
fn nothing_to_trace() {
    let empty = |set: LightSet| assert!(set.bounced.is_empty(), "{} lights", set.bounced.len());
    empty(traced(&scene(0.5, 3, BOX), Vec3::ZERO));
    empty(traced(&scene(0.0, 3, &format!("{BOX}{POINT}")), Vec3::ZERO));
    empty(traced(&scene(0.5, 0, &format!("{BOX}{POINT}")), Vec3::ZERO));
    let lone = traced(&scene(0.5, 3, RECT), Vec3::ZERO);
    assert_eq!(lone.emitters.len(), 500);
    empty(lone);
    let mut sky = scene(0.5, 3, "");
    sky.render.background = [1.0; 3];
    empty(traced(&sky, Vec3::ZERO));
}

#[test]
fn emitters_without_area() {
    let mut scene = scene(0.5, 3, &format!("{BOX}{RECT}"));
    let corners = vec![Vec3::ZERO, Vec3::X, 0.5 * Vec3::X];
    for shape in [
        AreaShape::Rect { center: Vec3::ZERO, u: Vec3::X, v: Vec3::X },
        AreaShape::Disk { center: Vec3::ZERO, u: Vec3::ZERO, v: Vec3::X },
        AreaShape::Line { a: Vec3::ZERO, b: Vec3::ZERO, radius: 0.1 },
        AreaShape::Line { a: Vec3::ZERO, b: Vec3::X, radius: 0.0 },
        AreaShape::Polygon { vertices: corners, holes: vec![], uvs: None },
    ] {
        scene.area_lights[0].shape = shape;
        let set = traced(&scene, Vec3::ZERO);
        assert!(set.bounced.is_empty() && set.emitters.is_empty());
        // Beside one that shines it changes nothing.
        let mut both = scene.clone();
        both.area_lights.push(crate::scene(0.5, 3, RECT).area_lights.remove(0));
        assert!(traced(&both, Vec3::ZERO).bounced.len() > 1000);
    }
}

/// Light does not leave a closed box.
#[test]
fn a_closed_box_keeps_its_light() {
    let floor = "[[mesh]]\nshape = \"plane\"\nsize = 9\nmaterial = \"m\"\ntranslate = [0, -3, 0]\n";
    let set = traced(&scene(0.9, 20, &format!("{BOX}{POINT}{floor}")), Vec3::ZERO);
    assert!(set.bounced.len() > 1000);
    assert!(set.bounced.iter().all(|light| Vec3::from(light.position).abs().max_element() <= 1.0));
}

#[test]
fn all_on_one_triangle() {
    let tiny = "[[mesh]]\nshape = \"plane\"\nsize = 1e-3\nmaterial = \"m\"\n\
                [[light]]\ntype = \"rect\"\ncenter = [0, 1e-3, 0]\nu = [1e-3, 0, 0]\nv = [0, 0, 1e-3]\nradiance = [1e6, 1, 1]\n";
    assert!(traced(&scene(0.5, 3, tiny), Vec3::ZERO).bounced.len() > 500);
    // A light on the floor, and one on its edge.
    let touching = format!("{BOX}{}", POINT.replace("[0.1, 0.2, 0.3]", "[0, 1, 0]"));
    traced(&scene(0.5, 3, &touching), Vec3::ZERO);
    traced(&scene(0.5, 3, &touching.replace("[0, 1, 0]", "[1, 1, 0]")), Vec3::ZERO);
}

#[test]
fn large_numbers() {
    let bright = RECT.replace("[1, 1, 1]", "[1e18, 1, 0]").replace("0.5", "1e17");
    traced(&scene(0.5, 3, &format!("{bright}{}", BOX.replace("size = 2", "size = 1e18"))), Vec3::ZERO);
}

/// 1e5 m out the same lights as at home, to float32 of the scene's own coordinates.
#[test]
fn far_away() {
    let place = Vec3::new(1e5, -2e5, 3e5);
    let at = |offset: Vec3| {
        let [x, y, z] = offset.to_array();
        let text = format!("{BOX}translate = [{x}, {y}, {z}]\n{RECT}")
            .replace("center = [0, 0.5, 0]", &format!("center = [{x}, {}, {z}]", y + 0.5));
        traced(&scene(0.5, 3, &text), offset)
    };
    let (near, far) = (at(Vec3::ZERO), at(place));
    assert!(far.bounced.len() > 1000);
    assert!(far.bounced.iter().all(|light| Vec3::from(light.position).abs().max_element() < 1.0));
    let total = |set: &LightSet| set.bounced.iter().map(|light| light.color[0]).sum::<f32>();
    assert!((total(&near) / total(&far) - 1.0).abs() < 0.05);
}
