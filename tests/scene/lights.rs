//! Lights of every sort.

use amas::scene::{AreaShape, PointLight};
use glam::Vec3;

use crate::{close, load, png, try_load};

fn points(toml: &str, csv: &str) -> Vec<PointLight> {
    load(toml, &[("l.csv", csv.as_bytes())]).point_lights
}

const FILE: &str = "[[light]]\ntype = \"points\"\nfile = \"l.csv\"\n";

#[test]
fn point_lights_keep_their_order_and_units() {
    let toml = "[[light]]\ntype = \"point\"\nposition = [1, 2, 3]\nintensity = [4, 5, 6]\nrange = 7\n\
        [[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\nvisible = false\n";
    let lights = points(toml, "");
    assert_eq!(lights[0].position, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(lights[0].intensity, Vec3::new(4.0, 5.0, 6.0));
    assert_eq!((lights[0].range, lights[1].range), (Some(7.0), None));
}

#[test]
fn csv_columns_go_by_name_and_no_range_is_none() {
    let csv = "\u{feff}x,y,z,r,g,b,range\r\n1,2,3,4,5,6,7\r\n\r\n# none:\r\n1,2,3,4,5,6,\n1,2,3,4,5,6,0\n1,2,3,4,5,6, inf\n";
    let lights = points(FILE, csv);
    let light = PointLight {
        position: Vec3::new(1.0, 2.0, 3.0),
        intensity: Vec3::new(4.0, 5.0, 6.0),
        range: Some(7.0),
    };
    let unranged = PointLight { range: None, ..light };
    assert_eq!(lights, [light, unranged, unranged, unranged]);
    assert_eq!(points(FILE, "x,y,z,r,g,b\n1,2,3,4,5,6\n"), [unranged]);
    assert_eq!(points(FILE, "B, G, R, Z, Y, X\n6,5,4,3,2,1"), [unranged]);
}

#[test]
fn the_generator_is_the_documented_one() {
    let toml = "[[light]]\ntype = \"points\"\ngenerate = { count = 3, seed = 12345, min = [-20, 0.2, -20], \
        max = [20, 2, 20], intensity = [2, 2], range = 2 }\n";
    let lights = points(toml, "");
    let mut state = 12345_u32;
    let mut next = || {
        state = state.wrapping_mul(1664525).wrapping_add(1013904223);
        f64::from(state >> 8) / 16777216.0
    };
    for light in &lights {
        let (x, z, y, hue) = (next(), next(), next(), next());
        close(
            &light.position.to_array(),
            &[-20.0 + 40.0 * x as f32, 0.2 + 1.8 * y as f32, -20.0 + 40.0 * z as f32],
        );
        // HSV of saturation 0.8 and value 1, twice.
        close(&[light.intensity.max_element(), light.intensity.min_element()], &[2.0, 0.4]);
        let sector = (hue * 6.0) as usize;
        let brightest = [0, 1, 1, 2, 2, 0][sector];
        assert_eq!(light.intensity[brightest], 2.0, "hue {hue}");
        assert_eq!(light.range, Some(2.0));
    }
    let ranged = toml.replace("[2, 2]", "[1, 3]");
    let bright = points(&ranged, "").into_iter().map(|light| light.intensity.max_element());
    let bright: Vec<f32> = bright.collect();
    assert!(bright.iter().all(|x| (1.0..=3.0).contains(x)) && bright[0] != bright[1], "{bright:?}");
}

#[test]
fn a_million_lights_fit() {
    let toml = "[[light]]\ntype = \"points\"\ngenerate = { count = 1048576, min = [0, 0, 0], max = [1, 1, 1], intensity = [0, 1] }\n";
    let lights = points(toml, "");
    assert_eq!(lights.len(), 1 << 20);
    assert!(lights.iter().all(|l| l.position.cmpge(Vec3::ZERO).all() && l.position.cmple(Vec3::ONE).all()));
    let mean = lights.iter().map(|l| l.position.as_dvec3()).sum::<glam::DVec3>() / lights.len() as f64;
    assert!((mean - 0.5).abs().max_element() < 2e-3, "{mean}");
}

#[test]
fn area_lights_of_every_shape() {
    let picture = png(1, 1, |_, _| [255; 4]);
    let toml = "[[light]]\ntype = \"rect\"\ncenter = [0, 2, 0]\nu = [1, 0, 0]\nv = [0.5, 0, 1]\nradiance = [1, 2, 3]\n\
        two_sided = true\nvisible = false\ntexture = \"p.png\"\n\
        [[light]]\ntype = \"disk\"\ncenter = [0, 1, 0]\nnormal = [0, 0, 3]\nradius = 2\nradiance = [1, 1, 1]\n\
        [[light]]\ntype = \"disk\"\ncenter = [0, 1, 0]\nu = [1, 0, 0]\nv = [0, 3, 0]\nradiance = [1, 1, 1]\n\
        [[light]]\ntype = \"line\"\na = [0, 0, 0]\nb = [1, 0, 0]\nradius = 0.1\nradiance = [1, 1, 1]\n\
        [[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[4,0,0],[4,4,0],[2,1,0],[0,4,0]]\n\
        holes = [[[1,0.5,0],[1,0.2,0],[2,0.2,0]]]\nuvs = [[0,0],[1,0],[1,1],[0.5,0.2],[0,1]]\nradiance = [1, 1, 1]\n";
    let scene = load(toml, &[("p.png", &picture)]);
    let [rect, disk, ellipse, line, polygon] = &scene.area_lights[..] else { panic!("five lights") };
    assert_eq!(rect.radiance, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!((rect.two_sided, rect.visible, rect.texture), (true, false, Some(0)));
    assert_eq!((disk.two_sided, disk.visible, disk.texture), (false, true, None));
    let AreaShape::Disk { u, v, .. } = disk.shape else { panic!("a disk") };
    close(&u.cross(v).to_array(), &[0.0, 0.0, 4.0]);
    close(&u.to_array(), &[2.0, 0.0, 0.0]);
    assert!(matches!(ellipse.shape, AreaShape::Disk { v, .. } if v.y == 3.0));
    assert!(matches!(line.shape, AreaShape::Line { radius: 0.1, .. }));
    let AreaShape::Polygon { vertices, holes, uvs } = &polygon.shape else { panic!("a polygon") };
    assert_eq!((vertices.len(), holes.len(), uvs.as_ref().map(Vec::len)), (5, 1, Some(5)));
}

/// The border goes on as far as coordinates reach, which then lie within; a second light shares it, one within does not.
#[test]
fn coordinates_beyond_a_texture_widen_it() {
    let light = |uvs: &str| {
        format!(
            "[[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\nradiance = [1, 1, 1]\n\
             texture = \"t.png\"\nuvs = {uvs}\n"
        )
    };
    let texture = png(4, 2, |x, y| [x as u8, y as u8, 0, 255]);
    let [beyond, within] = ["[[-0.5,0],[1,0],[1,1.5],[-0.5,1.5]]", "[[0,0],[1,0],[1,1],[0,1]]"].map(light);
    let scene = load(&[within.as_str(), &beyond, &beyond].concat(), &[("t.png", &texture)]);
    assert_eq!(
        scene.area_lights.iter().map(|light| light.texture).collect::<Vec<_>>(),
        [Some(0), Some(1), Some(1)]
    );
    let wide = &scene.textures[1];
    assert_eq!((wide.width, wide.height), (6, 3));
    let amas::scene::Texels::Srgb8(texels) = &wide.texels else { panic!("8 bits") };
    assert_eq!(texels.iter().map(|t| t[0]).collect::<Vec<_>>(), [0, 0, 0, 1, 2, 3].repeat(3));
    assert_eq!(texels.iter().step_by(6).map(|t| t[1]).collect::<Vec<_>>(), [0, 0, 1]);
    let AreaShape::Polygon { uvs: Some(uvs), .. } = &scene.area_lights[1].shape else { panic!("a polygon") };
    assert_eq!(*uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let error = try_load(&light("[[0,0],[9999,0],[9999,1],[0,1]]"), &[("t.png", &texture)], &[]).unwrap_err();
    assert!(error.to_string().starts_with("test.toml:10: `uvs` reach over 39996 × 2"), "{error}");
}

#[test]
fn a_line_thicker_than_long_is_a_warning() {
    let line = |radius: f32| {
        let keys = "type = \"line\"\na = [0, 1, 0]\nb = [0.2, 1, 0]\nradiance = [1, 1, 1]";
        load(&format!("[[light]]\n{keys}\nradius = {radius}\n"), &[]).warnings
    };
    assert!(line(0.19).is_empty());
    assert!(line(0.21)[0].starts_with("test.toml:10: the line is thicker"), "{:?}", line(0.21));
}

#[test]
fn a_disk_that_faces_straight_down_has_a_frame() {
    let toml = "[[light]]\ntype = \"disk\"\ncenter = [0, 1, 0]\nnormal = [0, -1, 0]\nradius = 1\nradiance = [1, 1, 1]\n";
    let scene = load(toml, &[]);
    let AreaShape::Disk { u, v, .. } = scene.area_lights[0].shape else { panic!("a disk") };
    close(&u.cross(v).to_array(), &[0.0, -1.0, 0.0]);
}

#[test]
fn a_vertex_within_the_tolerance_of_the_plane_passes() {
    let toml = "[[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0.0001],[0,1,0]]\nradiance = [1, 1, 1]\n";
    assert_eq!(load(toml, &[]).area_lights.len(), 1);
}
