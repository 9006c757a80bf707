//! Area lights against the oracle, against each other, and against brute force.

use crate::support::{FIVE_MATERIALS, Rig, assert_close, oracle, png, relative_errors, scene, scene_with};
use amas::Scene;
use amas::gpu::Use;
use amas::passes::aov::Quantity;
use amas::scene::settings::FrontEnd;
use amas::scene::{AreaLight, AreaShape};
use amas::shared::{AREA_MASK_LIGHTS, NO_CLUSTER};
use glam::{DVec3, Vec3};

/// A light of each shape, small for its distance from everything in [`FIVE_MATERIALS`].
const SHAPES: [&str; 5] = [
    "type = \"rect\"\ncenter = [1, 4, 2]\nu = [0.15, 0, 0.02]\nv = [0.02, 0.03, 0.1]\ntwo_sided = true\n",
    "type = \"disk\"\ncenter = [-1, 4, 2]\nnormal = [0.2, -1, -0.1]\nradius = 0.15\n",
    "type = \"disk\"\ncenter = [-2, 3.5, 2.5]\nu = [0.15, 0, 0]\nv = [0.05, -0.1, 0.05]\ntwo_sided = true\n",
    "type = \"line\"\na = [-0.2, 3.5, 2]\nb = [0.1, 3.7, 2.1]\nradius = 0.02\n",
    "type = \"polygon\"\nvertices = [[0, 4, 2], [0.3, 4, 2], [0.3, 4, 2.2], [0.1, 4, 2.1], [0, 4, 2.3]]\n\
     holes = [[[0.05, 4, 2.05], [0.05, 4, 2.1], [0.1, 4, 2.05]]]\n",
];

fn light(shape: &str) -> String {
    format!("[[light]]\n{shape}radiance = [300, 200, 250]\nvisible = false\n")
}

fn small(text: &str) -> String {
    text.replace("size = [96, 64]", "size = [48, 32]")
}

#[test]
fn small_lights_of_every_shape_are_the_oracle_s() {
    for shape in SHAPES {
        let mut rig = Rig::new(scene(&small(&format!("{FIVE_MATERIALS}{}", light(shape)))));
        println!("{shape}");
        // The oracle's own standard error is 1e-3.
        assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 4e-3);
    }
}

#[test]
fn textured_lights_are_the_oracle_s() {
    let texture = png([16, 16], |x, y| [if x < 8 { 250 } else { 20 }, 16 * y as u8, 90, 255]);
    for shape in [SHAPES[0], SHAPES[1], SHAPES[4]] {
        let text = small(&format!("{FIVE_MATERIALS}{}texture = \"t.png\"\n", light(shape)));
        let mut rig = Rig::new(scene_with(&text, &[("t.png", &texture)]));
        assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 6e-3);
    }
}

/// A dark border that goes on: what the picture's inside would give by its smaller copies is not there. Held to the scene's
/// `light_error`, as points of cubature stand for a light of which but a corner is bright.
#[test]
fn textures_beyond_their_borders_are_the_oracle_s() {
    let dark = |x: u32| x == 0 || x == 15;
    let texture = png([16, 16], |x, y| [if dark(x) || dark(y) { 10 } else { 250 }, 200, 90, 255]);
    let light = "type = \"polygon\"\nvertices = [[0, 4, 2], [0.3, 4, 2], [0.3, 4, 2.3], [0, 4, 2.3]]\n\
        uvs = [[0, 0], [3, 0], [3, 3], [0, 3]]\ntwo_sided = true\ntexture = \"t.png\"\n";
    let text = small(&format!("{FIVE_MATERIALS}{}", self::light(light)));
    let mut rig = Rig::new(scene_with(&text, &[("t.png", &texture)]));
    assert_close(&rig.render(), &oracle(&rig.scene), 0.99, 1e-2);
}

#[test]
fn light_leaves_on_the_side_of_the_normal() {
    let up = |extra: &str| {
        let rect = "type = \"rect\"\ncenter = [0, 4, 0]\nu = [0, 0, 0.2]\nv = [0.2, 0, 0]\n";
        Rig::new(scene(&small(&format!("{FIVE_MATERIALS}{}", light(&format!("{rect}{extra}")))))).render()
    };
    assert!(up("").pixels.iter().all(|p| *p == [0.0; 3]), "nothing lies above it");
    let down = "type = \"rect\"\ncenter = [0, 4, 0]\nu = [0.2, 0, 0]\nv = [0, 0, 0.2]\n";
    let down = Rig::new(scene(&small(&format!("{FIVE_MATERIALS}{}", light(down))))).render();
    assert_close(&up("two_sided = true\n"), &down, 1.0, 1e-5);
}

/// A plate with 64 holes and the 64 plugs that fit them light as the plate without holes: lavapipe, which ends a shader's
/// loops after 65,535 iterations, must not lose a part.
#[test]
fn a_light_of_hundreds_of_corners_is_whole() {
    let room = "[render]\nsize = [12, 8]\n[[camera]]\nname = \"c\"\nposition = [0, 2, 5]\ntarget = [0, 0, 0]\n\
        vertical_fov = 40\n[[material]]\nname = \"m\"\ntype = \"plastic\"\ndiffuse = [0.5, 0.5, 0.5]\nalpha = 0.2\n\
        [[mesh]]\nshape = \"plane\"\nsize = 12\nmaterial = \"m\"\n";
    let points = |[x, y]: [f64; 2], count: u32, radius: f64| -> Vec<[f64; 3]> {
        let angle = |i| std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count);
        (0..count).map(|i| [x + radius * angle(i).cos(), y + radius * angle(i).sin(), -1.5]).collect()
    };
    let light = |vertices: &[[f64; 3]], holes: &[Vec<[f64; 3]>]| {
        format!(
            "[[light]]\ntype = \"polygon\"\nvertices = {vertices:?}\nholes = {holes:?}\nradiance = [3, 3, 3]\nvisible = false\n"
        )
    };
    let plugs: Vec<_> = (0..64)
        .map(|i| points([f64::from(i % 8) * 0.25 - 0.875, f64::from(i / 8) * 0.25 + 0.325], 6, 0.1))
        .collect();
    let plate = [[-1.0, 0.2, -1.5], [1.0, 0.2, -1.5], [1.0, 2.2, -1.5], [-1.0, 2.2, -1.5]];
    let parts: String = plugs.iter().map(|plug| light(plug, &[])).collect();
    let whole = Rig::new(scene(&format!("{room}{}", light(&plate, &[])))).render();
    let parts = Rig::new(scene(&format!("{room}{}{parts}", light(&plate, &plugs)))).render();
    assert_close(&parts, &whole, 0.99, 2e-2);
}

/// A generated ceiling and walls of textured polygons that face all ways.
fn hundred_polygons() -> Scene {
    let mut state = 5_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / 16_777_216.0
    };
    let mut text = small(FIVE_MATERIALS);
    for index in 0..100 {
        let center = DVec3::new(next() * 6.0 - 3.0, next() * 3.0 + 0.3, next() * 6.0 - 3.0);
        let normal = (DVec3::new(next(), next(), next()) - 0.5).normalize();
        let (u, v) = (normal.any_orthonormal_vector(), normal.cross(normal.any_orthonormal_vector()));
        let size = 0.02 + 0.2 * next();
        let corners = 3 + index % 6;
        let vertices: Vec<_> = (0..corners)
            .map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(corners)).sin_cos();
                (center + size * (cos * u + sin * v)).to_array()
            })
            .collect();
        let texture = if index % 3 == 0 { "texture = \"t.png\"\n" } else { "" };
        let (radiance, two_sided) = (if index == 50 { 0.0 } else { 2.0 + 5.0 * next() }, index % 7 == 0);
        text += &format!(
            "[[light]]\ntype = \"polygon\"\nvertices = {vertices:?}\nradiance = [{radiance}, {radiance}, 1e-9]\n\
             visible = false\ntwo_sided = {two_sided}\n{texture}"
        );
    }
    let texture = png([9, 7], |x, y| [28 * x as u8, 36 * y as u8, 200, 255]);
    scene_with(&text, &[("t.png", &texture)])
}

#[test]
fn masks_leave_out_no_light() {
    let mut rig = Rig::new(hundred_polygons());
    let masked = rig.render();
    let brute = Rig::with(hundred_polygons(), |settings| settings.brute_force = true).render();
    let errors = relative_errors(&masked, &brute);
    println!("worst {:.2e}", errors[errors.len() - 1]);
    assert!(errors[errors.len() - 1] <= 1e-6);
    let pairs = rig.frame.pairs().unwrap();
    println!("{pairs:?}");
    assert!(pairs.area * 10 < pairs.area_all * 8, "one-sided lights have backs: {pairs:?}");
    assert!(pairs.useful <= pairs.evaluated && pairs.evaluated == pairs.area);
    let counted: f64 = rig.aov(Quantity::LightCount).iter().map(|v| f64::from(v[0])).sum();
    assert_eq!(counted, pairs.area as f64);
}

/// Whether a light sends anything towards a point, in double precision, but for what rounding may decide.
fn reaches(light: &AreaLight, p: DVec3) -> bool {
    let front = match &light.shape {
        AreaShape::Line { .. } => return light.radiance != Vec3::ZERO,
        AreaShape::Rect { center, u, v } | AreaShape::Disk { center, u, v } => (*center, u.cross(*v)),
        AreaShape::Polygon { vertices, .. } => {
            let next = vertices.iter().cycle().skip(1);
            let area = |(a, b): (&Vec3, &Vec3)| (*a - vertices[0]).cross(*b - vertices[0]);
            (vertices[0], vertices.iter().zip(next).map(area).sum())
        }
    };
    let height = (p - front.0.as_dvec3()).dot(front.1.as_dvec3().normalize());
    light.radiance != Vec3::ZERO && (light.two_sided || height > 1e-5)
}

#[test]
fn masks_against_brute_force() {
    let mut scene = hundred_polygons();
    let shrunk = scene.area_lights.clone().into_iter().map(|mut light| {
        if let AreaShape::Polygon { vertices, .. } = &mut light.shape {
            let middle = vertices.iter().sum::<Vec3>() / vertices.len() as f32;
            vertices.iter_mut().for_each(|v| *v = middle + (*v - middle) * 0.05);
        }
        light
    });
    scene.area_lights.extend(shrunk.collect::<Vec<_>>());
    let mut rig = Rig::new(scene);
    rig.render();
    let positions = rig.aov(Quantity::Position);
    let (targets, clusters) = rig.frame.cluster_targets();
    let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    let texels: Vec<[u32; 4]> = clusters.lists.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    let mask = clusters.capacity.mask;
    assert_eq!(mask, 200_u32.div_ceil(AREA_MASK_LIGHTS));
    let (mut set, mut reached) = (0, 0);
    for (&id, p) in ids.iter().zip(&positions).filter(|(id, _)| **id != NO_CLUSTER) {
        let p = Vec3::new(p[0], p[1], p[2]).as_dvec3();
        for (index, light) in (0..).zip(&rig.scene.area_lights) {
            let texel = texels[(id * mask + index / AREA_MASK_LIGHTS) as usize];
            let bit = index % AREA_MASK_LIGHTS;
            let has = texel[(bit / 32) as usize] >> (bit % 32) & 1 == 1;
            assert!(has || !reaches(light, p), "light {index} reaches {p} and is not in its mask");
            set += u32::from(has);
            reached += u32::from(reaches(light, p));
        }
    }
    println!("{:.3} set per reaching light", f64::from(set) / f64::from(reached));
    assert!(reached > 0 && f64::from(set) < 1.15 * f64::from(reached));
}

/// Masks and lists share one image, and only what a scene has is recorded.
#[test]
fn passes_are_those_that_the_lights_need() {
    let lights = crate::support::ranged_lights(300, 1.0);
    let mut both = hundred_polygons();
    both.point_lights = scene(&format!("{FIVE_MATERIALS}{lights}")).point_lights;
    let names = |rig: &mut Rig| {
        let inputs = amas::FrameInputs {
            camera: &rig.scene.cameras[0],
            time: 0.0,
            samples: 1,
            exposure: 0.0,
            split: true,
            progress: indicatif::ProgressBar::hidden(),
        };
        rig.frame.render(&inputs).unwrap().passes.iter().map(|pass| pass.name).collect::<Vec<_>>()
    };
    let few = small(&format!("{FIVE_MATERIALS}{}", light(SHAPES[0])));
    let fragment = |scene| Rig::with(scene, |settings| settings.front_end = FrontEnd::Fragment);
    assert_eq!(names(&mut fragment(scene(&few))), ["prepass", "direct", "present"]);
    assert_eq!(names(&mut fragment(hundred_polygons())), ["prepass", "cluster", "direct", "present"]);
    let mut rig = fragment(both.clone());
    assert_eq!(names(&mut rig), ["prepass", "cluster", "direct", "indirect", "present"]);
    let brute = Rig::with(both, |settings| settings.brute_force = true).render();
    assert!(relative_errors(&rig.render(), &brute).last().unwrap() <= &1e-5);
}

/// More lights than a draw takes, and more than a word of masks holds.
#[test]
fn a_thousand_lights() {
    let mut scene = hundred_polygons();
    scene.area_lights = scene.area_lights.iter().cycle().take(997).cloned().collect();
    let mut rig = Rig::new(scene.clone());
    let brute = Rig::with(scene, |settings| settings.brute_force = true).render();
    assert!(relative_errors(&rig.render(), &brute).last().unwrap() <= &1e-5);
}

/// Lights that touch surfaces, that are slivers, immense, tiny, blinding or under the floor: every value stays finite.
#[test]
fn extreme_lights_stay_finite() {
    let light = |shape: &str, radiance: &str| {
        let shape = format!("[[light]]\n{shape}\nradiance = [{radiance}, 1, 1e-30]\n");
        [format!("{shape}visible = true\n"), format!("{shape}visible = false\n")].concat()
    };
    let text = [
        light("type = \"rect\"\ncenter = [0, 0, 1]\nu = [1, 0, 0]\nv = [0, 1, 0]\ntwo_sided = true", "1e18"),
        light("type = \"rect\"\ncenter = [0, 0, 0]\nu = [9, 0, 0]\nv = [0, 0, -9]", "1"),
        light("type = \"rect\"\ncenter = [0, 9e8, 0]\nu = [1e9, 0, 0]\nv = [0, 0, 1e9]", "1e9"),
        light("type = \"disk\"\ncenter = [0, 1, 0]\nnormal = [0, 1, 0]\nradius = 1e-12", "1e18"),
        light("type = \"disk\"\ncenter = [0, 1, 0]\nu = [1, 0, 0]\nv = [1, 1e-5, 0]", "1"),
        light("type = \"line\"\na = [0, -1, 0]\nb = [0, 1, 0]\nradius = 1e-9", "1e18"),
        light("type = \"line\"\na = [0, 1, 0]\nb = [1e-6, 1, 0]\nradius = 5", "1"),
        light("type = \"polygon\"\nvertices = [[0, 1, 0], [2, 1, 0], [1, 1, 1e-6]]", "1"),
        light(
            "type = \"polygon\"\nvertices = [[0, 1, 0], [1, 1, 0], [2, 1, 0], [2, 1, 1], [1, 1, 1], [1, 1, 1e-3]]\n\
             holes = [[[1.2, 1, 0.2], [1.8, 1, 0.2], [1.8, 1, 0.8]], [[1.3, 1, 0.5], [1.2, 1, 0.2], [1.4, 1, 0.9]]]",
            "1",
        ),
    ];
    for samples in [1, 2] {
        let text = small(&format!("{FIVE_MATERIALS}{}", text.concat()))
            .replace("[render]", &format!("[render]\nsamples = {samples}"));
        Rig::new(scene(&text)).render();
    }
}
