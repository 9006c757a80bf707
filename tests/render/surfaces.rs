//! What is drawn: every covered pixel once, nothing where nothing is.

use crate::support::{
    FIVE_MATERIALS, Rig, oracle, ranged_lights, relative_errors, scene, scene_with, unranged_lights,
};
use amas::passes::aov::Quantity;

/// Every covered pixel is shaded exactly once, every other pixel never.
fn shaded_once(rig: &mut Rig) {
    rig.render();
    let coverage = rig.aov(Quantity::Coverage);
    let position = rig.aov(Quantity::Position);
    let covered = position.iter().filter(|p| p[3] > 0.0).count();
    assert!(covered > 0, "something is seen");
    for (count, place) in coverage.iter().zip(&position) {
        assert_eq!(count[0], if place[3] > 0.0 { 1.0 } else { 0.0 });
    }
    let expected = oracle(&rig.scene).pixels.iter().filter(|p| p.iter().any(|v| *v > 0.0)).count();
    assert!(expected > 0);
}

#[test]
fn covered_pixels_are_shaded_exactly_once() {
    shaded_once(&mut Rig::new(scene(&format!("{FIVE_MATERIALS}{}", unranged_lights(3)))));
}

#[test]
fn thin_and_overlapping_triangles_are_shaded_once() {
    let blades: String = (0..40)
        .map(|i| {
            let angle = i * 9;
            format!("[[mesh]]\nshape = \"box\"\nsize = [3, 0.004, 0.3]\nrotate = [{angle}, {}, 17]\ntranslate = [0, 1, 0]\n", i * 4)
        })
        .collect();
    shaded_once(&mut Rig::new(scene(&format!("{FIVE_MATERIALS}{blades}{}", unranged_lights(3)))));
}

/// The same triangle twice, degenerate ones, and a duplicate in another rotation: shaded once all the same.
#[test]
fn duplicate_triangles_are_shaded_once() {
    let obj = b"v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\nf 2 3 1\nf 1 2 3\nf 1 1 2\nf 1 2 1\n";
    let text = "[render]\nsize = [40, 40]\n[[camera]]\nname = \"c\"\nposition = [0, 1, 4]\ntarget = [0, 1, 0]\n\
                vertical_fov = 40\n[[mesh]]\nobj = \"t.obj\"\n[[light]]\ntype = \"point\"\nposition = [0, 1, 3]\n\
                intensity = [1, 1, 1]\n";
    shaded_once(&mut Rig::new(scene_with(text, &[("t.obj", obj)])));
}

/// The same sheet again with the other winding, and as another mesh: lit once.
#[test]
fn coincident_sheets_are_lit_once() {
    let mesh = |obj: &str| format!("[[mesh]]\nobj = \"{obj}\"\n");
    let text = "[render]\nsize = [40, 40]\n[[camera]]\nname = \"c\"\nposition = [0, 1, 4]\ntarget = [0, 1, 0]\n\
                vertical_fov = 40\n[[light]]\ntype = \"point\"\nposition = [0, 1, 3]\nintensity = [1, 1, 1]\n";
    let one = b"v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";
    let two = b"v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\nf 1 3 2\n";
    let files: [(&str, &[u8]); 2] = [("one.obj", one), ("two.obj", two)];
    let single = Rig::new(scene_with(&format!("{text}{}", mesh("one.obj")), &files)).render();
    let doubled = format!("{text}{}{}", mesh("two.obj"), mesh("one.obj"));
    assert_eq!(Rig::new(scene_with(&doubled, &files)).render(), single);
}

#[test]
fn nothing_but_background() {
    let text = "[render]\nsize = [20, 10]\nbackground = [0.25, 0.5, 1]\n[[camera]]\nname = \"c\"\nposition = [0, 0, 1]\n\
                target = [0, 0, 0]\nvertical_fov = 40\n";
    let mut rig = Rig::new(scene(text));
    assert!(rig.render().pixels.iter().all(|p| *p == [0.25, 0.5, 1.0]));
    // Lights alone show nothing.
    let mut rig = Rig::new(scene(&format!("{text}{}", ranged_lights(10, 1.0))));
    assert!(rig.render().pixels.iter().all(|p| *p == [0.25, 0.5, 1.0]));
    let mut rig = Rig::new(scene(&text.replace("background = [0.25, 0.5, 1]", "samples = 5")));
    assert!(rig.render().pixels.iter().all(|p| *p == [0.0; 3]));
}

#[test]
fn meshes_without_lights_are_black_before_the_background() {
    let text = FIVE_MATERIALS.replace("[render]", "[render]\nbackground = [1, 1, 1]");
    let mut rig = Rig::new(scene(&text));
    let picture = rig.render();
    let position = rig.aov(Quantity::Position);
    assert!(position.iter().any(|p| p[3] > 0.0) && position.iter().any(|p| p[3] == 0.0));
    for (pixel, place) in picture.pixels.iter().zip(&position) {
        assert_eq!(*pixel, if place[3] > 0.0 { [0.0; 3] } else { [1.0; 3] });
    }
}

/// The background neither leaks onto surfaces nor is added twice over samples.
#[test]
fn background_and_lights_add_up_over_samples() {
    let text = format!("{FIVE_MATERIALS}{}", unranged_lights(5))
        .replace("[render]", "[render]\nbackground = [3, 2, 1]");
    let mut rig = Rig::new(scene(&text));
    let errors = relative_errors(&rig.render(), &oracle(&rig.scene));
    assert!(errors[errors.len() * 99 / 100] < 1e-4);
    let mut rig = Rig::new(scene(&text.replace("[render]", "[render]\nsamples = 4")));
    assert_eq!(rig.render().pixels[0], [3.0, 2.0, 1.0]);
}

#[test]
fn one_sided_back_faces_are_not_drawn() {
    let text = "[render]\nsize = [16, 16]\n[[camera]]\nname = \"c\"\nposition = [0, -3, 0.1]\ntarget = [0, 0, 0]\n\
                vertical_fov = 20\n[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = [1, 1, 1]\ntwo_sided = false\n\
                [[mesh]]\nshape = \"plane\"\nsize = 9\nmaterial = \"m\"\n[[light]]\ntype = \"point\"\n\
                position = [0, -2, 0]\nintensity = [1, 1, 1]\n";
    assert!(Rig::new(scene(text)).render().pixels.iter().all(|p| *p == [0.0; 3]));
    let two_sided = text.replace("two_sided = false", "two_sided = true");
    let mut rig = Rig::new(scene(&two_sided));
    assert!(rig.render().pixels.iter().all(|p| p[0] > 0.0));
}

#[test]
fn the_same_scene_twice_is_the_same_picture() {
    let text = format!("{FIVE_MATERIALS}{}{}", ranged_lights(3000, 1.0), unranged_lights(9));
    let first = Rig::new(scene(&text)).render();
    assert_eq!(first, Rig::new(scene(&text)).render());
}
