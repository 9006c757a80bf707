//! Distances to the edges of triangles, against those of the same triangles projected in double precision.

use crate::support::{Rig, scene};
use amas::gpu::Use;
use amas::passes::aov::Quantity;
use amas::scene::{Camera, Projection};
use glam::{DVec2, DVec3, Vec3};

const SIZE: [f64; 2] = [120.0, 80.0];

/// A wall, a sphere before it, lights of every kind of triangles.
const WORLD: &str = r#"
[render]
size = [120, 80]
[[camera]]
name = "c"
position = [0.4, 0.7, 4]
target = [0, 0.1, 0]
vertical_fov = 50
[[material]]
name = "m"
type = "matte"
color = [0.5, 0.5, 0.5]
[[mesh]]
shape = "plane"
size = 3
rotate = [70, 10, 0]
material = "m"
[[mesh]]
shape = "sphere"
radius = 0.6
segments = 8
translate = [-0.5, 0.4, 0.9]
material = "m"
[[light]]
type = "rect"
center = [1, 0.8, 0.5]
u = [0.4, 0, 0.3]
v = [0.1, 0.5, 0]
radiance = [3, 2, 1]
[[light]]
type = "line"
a = [-4, -0.7, 0.3]
b = [4, -0.8, 1]
radius = 0.1
radiance = [5, 5, 1]
"#;

/// Where a camera sees a point: pixels from the upper left corner, and metres along the view.
fn projected(camera: &Camera, point: DVec3) -> (DVec2, f64) {
    let forward = (camera.target - camera.position).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let to = point - camera.position;
    let depth = to.dot(forward);
    let half = match camera.projection {
        Projection::Perspective { vertical_fov } => (vertical_fov.to_radians() / 2.0).tan() * depth,
        Projection::Orthographic { height } => height / 2.0,
    };
    let scale = SIZE[1] / 2.0 / half;
    let middle = DVec2::from(SIZE) / 2.0;
    (middle + scale * DVec2::new(to.dot(right), -to.dot(up)), depth)
}

/// Pixels that a projected edge may be off by: vertices lie on a sixteenth of a pixel at least.
const SNAPPED: f64 = 0.04;

/// Distance, pixels, of a point from the nearest side of a triangle, positive inside; `None` where it is farther outside.
fn inside(corners: [DVec2; 3], at: DVec2) -> Option<f64> {
    let area = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]);
    let side = |i: usize| {
        let along = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).normalize();
        along.perp_dot(at - corners[(i + 1) % 3]) * area.signum()
    };
    let distance = [0, 1, 2].map(side).into_iter().fold(f64::INFINITY, f64::min);
    (distance > -SNAPPED).then_some(distance)
}

/// Of each pixel's centre, in the triangle that is nearest there: to its nearest side, pixels. `None` where there is none, or
/// so near to a side of any triangle that it may as well be seen as beyond it.
fn expected(rig: &Rig) -> Vec<Option<f64>> {
    let vertices = rig.gpu_scene.vertices.fetch(Use::TransferWrite).unwrap();
    let triangles = rig.gpu_scene.triangles.fetch(Use::TransferWrite).unwrap();
    let place = |index: u32| Vec3::from(vertices[index as usize].position).as_dvec3();
    let camera = &rig.scene.cameras[0];
    let seen: Vec<_> = triangles.iter().map(|t| t.map(|index| projected(camera, place(index)))).collect();
    let nearest = |at: DVec2| {
        let hits = seen.iter().filter_map(|corners| {
            let distance = inside(corners.map(|(corner, _)| corner), at)?;
            // Along the view, of the plane: in perspective its inverse is linear on the screen.
            let perspective = matches!(camera.projection, Projection::Perspective { .. });
            let of = |depth: f64| if perspective { 1.0 / depth } else { depth };
            let [a, b, c] = corners.map(|(corner, depth)| corner.extend(of(depth)));
            let normal = (b - a).cross(c - a);
            let depth = a.z - normal.truncate().dot(at - a.truncate()) / normal.z;
            Some((of(depth), distance))
        });
        let hits: Vec<_> = hits.collect();
        let clear = hits.iter().all(|(_, distance)| *distance > SNAPPED);
        let first = hits.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).filter(|_| clear);
        first.map(|(_, distance)| distance)
    };
    let [width, height] = SIZE.map(|side| side as usize);
    (0..width * height)
        .map(|i| nearest(DVec2::new((i % width) as f64 + 0.5, (i / width) as f64 + 0.5)))
        .collect()
}

/// Measured and expected distances of the pixels where both see a triangle.
fn distances(text: &str) -> Vec<(f64, f64)> {
    let mut rig = Rig::new(scene(text));
    rig.render();
    let measured = rig.aov(Quantity::Wireframe);
    let pairs = measured.iter().zip(expected(&rig));
    let clear: Vec<_> = pairs.filter_map(|(measured, expected)| Some((*measured, expected?))).collect();
    assert!(clear.iter().all(|(measured, _)| measured[3] == 1.0), "what is hit is drawn");
    let drawn = measured.iter().filter(|value| value[3] > 0.0).count();
    assert!(drawn > 2_000 && clear.len() > drawn * 8 / 10, "{} of {drawn} pixels are clear", clear.len());
    clear.into_iter().map(|(measured, expected)| (f64::from(measured[0]), expected)).collect()
}

#[test]
fn without_perspective_distances_are_exact_everywhere() {
    let text = WORLD.replace("vertical_fov = 50", "orthographic_height = 3.2");
    for (measured, expected) in distances(&text) {
        assert!((measured - expected).abs() <= SNAPPED, "{measured} for {expected}");
    }
}

#[test]
fn in_perspective_distances_are_exact_at_edges() {
    let all = distances(WORLD);
    let near: Vec<_> = all.iter().filter(|(_, expected)| *expected < 1.5).collect();
    assert!(near.len() > 400, "{} pixels are near edges", near.len());
    for (measured, expected) in near {
        assert!((measured - expected).abs() <= SNAPPED + 0.1 * expected, "{measured} for {expected}");
    }
}

/// A floor that goes on behind the eye, where what neighbouring pixels extrapolate is no place at all.
#[test]
fn distances_are_finite_up_to_the_eye() {
    let text = WORLD.replace("size = 3\nrotate = [70, 10, 0]", "size = 4000\ntranslate = [0, 0.699, 0]");
    let mut rig = Rig::new(scene(&text));
    rig.render();
    let values = rig.aov(Quantity::Wireframe);
    assert!(values.iter().filter(|value| value[3] > 0.0).count() > 1_000);
    assert!(values.iter().flatten().all(|value| (0.0..=1e6).contains(value)));
}
