//! Where light comes close, and where it must not come.

use crate::support::{MATTE, Rig, Truth, judge_by, mean, room, scene};

/// Two boards that cross above the floor: narrow grooves, where virtual lights lie next to what they light.
const BOARDS: &str = "[[mesh]]\nshape = \"box\"\nsize = [0.6, 1.9, 0.05]\nmaterial = \"white\"\n\
     translate = [0, 0.95, -0.2]\nrotate = [0, 60, 0]\n\
     [[mesh]]\nshape = \"box\"\nsize = [0.6, 1.9, 0.05]\nmaterial = \"white\"\ntranslate = [-0.2, 0.95, -0.2]\n\
     rotate = [0, 120, 0]\n\
     [[light]]\ntype = \"point\"\nposition = [0.5, 1.5, 0.6]\nintensity = [2, 2, 2]\n\
     [[light]]\ntype = \"point\"\nposition = [-0.6, 0.4, 0.5]\nintensity = [0.5, 0.7, 1]\nrange = 1.5\n";

/// What the bound takes from gathering in corners, paths bring back; and no pixel is brighter than 20 times the truth
/// around it.
#[test]
fn grooves() {
    let render = "size = [40, 30]\nindirect = { vpls = 2048, bounces = 6 }";
    let scene = scene(&room(render, "type = \"matte\"\ncolor = [0.9, 0.9, 0.9]", BOARDS), &[]);
    let truth = Truth::gathered(&scene, 800);
    let rig = judge_by("grooves", Rig::new(scene), &truth);
    let picture = rig.gathered();
    let [width, height] = [picture.width, picture.height].map(|side| side as i32);
    let luminance = |pixel: &[f32; 3]| pixel.iter().sum::<f32>();
    for (index, pixel) in picture.pixels.iter().enumerate() {
        let (x, y) = (index as i32 % width, index as i32 / width);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
        let inside = around.filter(|(x, y)| (0..width).contains(x) && (0..height).contains(y));
        let values: Vec<f32> =
            inside.map(|(x, y)| luminance(&truth.image.pixels[(y * width + x) as usize])).collect();
        let around = values.iter().sum::<f32>() / values.len() as f32;
        assert!(luminance(pixel) <= 20.0 * around.max(1e-3), "{pixel:?} at {x}, {y}; around it {around}");
    }
}

/// A closed room in two halves, of which one has a lamp: the wall between them is 1 cm thick.
#[test]
fn thin_wall() {
    let text = room(
        "size = [40, 30]\nindirect = { vpls = 2048, bounces = 4 }",
        MATTE,
        "[[material]]\nname = \"front\"\ntype = \"matte\"\ncolor = [0.7, 0.7, 0.7]\ntwo_sided = false\n\
         [[mesh]]\nshape = \"plane\"\nsize = 2\nmaterial = \"front\"\ntranslate = [0, 1, 1]\nrotate = [-90, 0, 0]\n\
         [[mesh]]\nshape = \"box\"\nsize = [0.01, 2.2, 2.2]\nmaterial = \"white\"\ntranslate = [0, 1, 0]\n\
         [[light]]\ntype = \"rect\"\ncenter = [-0.5, 1.98, 0]\nu = [0.25, 0, 0]\nv = [0, 0, 0.25]\n\
         radiance = [14, 12, 9]\nvisible = false\n",
    );
    let scene = scene(&text, &[]);
    let truth = Truth::gathered(&scene, 800);
    let rig = judge_by("thin wall", Rig::new(scene), &truth);
    // The viewer is in the wall's plane: what is left of the middle is lit.
    let picture = rig.gathered();
    let half = |right: bool| {
        let pixels = picture.pixels.iter().enumerate();
        let of_half =
            pixels.filter(move |(index, _)| (*index as u32 % picture.width >= picture.width / 2) == right);
        of_half.flat_map(|(_, pixel)| *pixel).collect::<Vec<f32>>()
    };
    let (lit, dark) = (half(false), half(true));
    let lit = lit.iter().sum::<f32>() / lit.len() as f32;
    let leak = dark.iter().fold(0.0_f32, |most, value| most.max(value.abs()));
    println!("lit {lit}, behind the wall at most {leak}; picture {}", mean(&picture));
    assert!(leak <= 1e-4 * lit, "{leak} behind the wall, {lit} before it");
}
