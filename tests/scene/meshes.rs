//! Shapes, transforms, normals and tangents against known answers.

use glam::Vec3;

use crate::{check, close, load, obj};

/// A cube of edge 2 around the origin, without normals.
const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn shape(keys: &str) -> amas::Scene {
    let scene =
        load(&format!("[[material]]\nname=\"m\"\ntype=\"matte\"\n[[mesh]]\nmaterial=\"m\"\n{keys}"), &[]);
    check(&scene);
    scene
}

/// Signed volume: positive where the triangles face outwards.
fn volume(mesh: &amas::scene::Mesh) -> f32 {
    let p = |i: u32| Vec3::from(mesh.vertices[i as usize].position);
    mesh.triangles.iter().map(|[a, b, c]| p(*a).dot(p(*b).cross(p(*c))) / 6.0).sum()
}

#[test]
fn angle_weights_give_a_cube_diagonal_normals_however_its_faces_are_split() {
    let mesh = obj(CUBE, "");
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    for vertex in &mesh.vertices {
        let expected = Vec3::from(vertex.position).normalize();
        close(&vertex.normal, &expected.to_array());
        assert_eq!(vertex.tangent, [0.0; 4]);
    }
    close(&[volume(&mesh)], &[8.0]);
}

#[test]
fn flat_normals_are_those_of_the_faces() {
    let mesh = obj(CUBE, "normals = \"flat\"");
    assert_eq!(mesh.vertices.len(), 24);
    for [a, b, c] in &mesh.triangles {
        let [a, b, c] = [a, b, c].map(|i| mesh.vertices[*i as usize]);
        let face = Vec3::from(b.position) - Vec3::from(a.position);
        let face = face.cross(Vec3::from(c.position) - Vec3::from(a.position)).normalize();
        close(&a.normal, &face.to_array());
        assert_eq!((a.normal, b.normal), (b.normal, c.normal));
    }
}

#[test]
fn a_sheet_of_two_sides_gets_the_normals_of_its_faces() {
    let mesh = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n", "");
    assert_eq!(mesh.triangles.len(), 2, "the other winding is no duplicate");
    assert_eq!(mesh.vertices.iter().filter(|v| v.normal[2] == 1.0).count(), 3);
    assert_eq!(mesh.vertices.iter().filter(|v| v.normal[2] == -1.0).count(), 3);
}

#[test]
fn a_transform_scales_then_rotates_x_y_z_then_moves() {
    let text = "v 1 2 3\nv 2 2 3\nv 1 3 3\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    let mesh = obj(text, "scale = [2, 1, 1]\nrotate = [90, 90, 0]\ntranslate = [10, 0, 0]");
    // (1, 2, 3) → (2, 2, 3) → about x: (2, −3, 2) → about y: (2, −3, −2) → (12, −3, −2).
    close(&mesh.vertices[0].position, &[12.0, -3.0, -2.0]);
    // +z → about x: −y → about y: −y.
    close(&mesh.vertices[0].normal, &[0.0, -1.0, 0.0]);
}

#[test]
fn normals_go_by_the_inverse_transpose_and_a_mirror_keeps_fronts_in_front() {
    let text = "v 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0.57735 0.57735 0.57735\nf 1//1 2//1 3//1\n";
    let mesh = obj(text, "scale = [-2, 1, 1]");
    let expected = Vec3::new(-0.5, 1.0, 1.0).normalize();
    close(&mesh.vertices[0].normal, &expected.to_array());
    let [a, b, c] = mesh.triangles[0].map(|i| Vec3::from(mesh.vertices[i as usize].position));
    assert!((b - a).cross(c - a).dot(expected) > 0.0);
    close(&[volume(&obj(CUBE, "scale = [1, -1, 1]"))], &[8.0]);
}

#[test]
fn tangents_follow_u_and_split_at_a_mirror() {
    // Two squares that share an edge; the texture of the left one is mirrored.
    let text = "v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 1 0 0\nv 1 1 0\n\
        vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\nf 1/1 2/2 3/3 4/4\nf 2/2 5/1 6/4 3/3\n";
    let mesh = obj(text, "");
    assert_eq!(mesh.vertices.len(), 8, "the two shared vertices became four");
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| mesh.vertices[i as usize]);
        let right = corners.iter().any(|v| v.position[0] > 0.0);
        let expected = if right { [1.0, 0.0, 0.0, 1.0] } else { [-1.0, 0.0, 0.0, -1.0] };
        corners.iter().for_each(|v| close(&v.tangent, &expected));
    }
}

#[test]
fn the_bitangent_is_w_times_n_cross_t() {
    // u along +y, v along +x: seen from +z the texture is mirrored.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0 1\nvt 1 0\nf 1/1 2/2 3/3\n";
    let vertex = obj(text, "").vertices[0];
    close(&vertex.tangent, &[0.0, 1.0, 0.0, -1.0]);
    let t = Vec3::from_slice(&vertex.tangent[..3]);
    let bitangent = vertex.tangent[3] * Vec3::from(vertex.normal).cross(t);
    close(&bitangent.to_array(), &[1.0, 0.0, 0.0]);
}

#[test]
fn texture_coordinates_without_area_give_no_tangent() {
    let mesh = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1/1 2/1 3/1\n", "");
    assert!(mesh.vertices.iter().all(|v| v.tangent == [0.0; 4]));
}

#[test]
fn a_sphere_has_its_triangles_normals_and_eastward_tangents() {
    let mesh = &shape("shape = \"sphere\"\nradius = 0.4\nsegments = [32, 16]").meshes[0];
    assert_eq!(mesh.triangles.len(), 2 * 32 * 15);
    let full = 4.0 / 3.0 * std::f32::consts::PI * 0.4_f32.powi(3);
    let part = volume(mesh) / full;
    assert!(part > 0.97 && part < 1.0, "{part}");
    for vertex in &mesh.vertices {
        let [x, _, z] = vertex.position;
        close(&(Vec3::from(vertex.normal) * 0.4).to_array(), &vertex.position);
        assert_eq!(vertex.tangent[3], 1.0);
        if x.hypot(z) > 0.01 {
            let east = Vec3::new(z, 0.0, -x).normalize();
            assert!(east.dot(Vec3::from_slice(&vertex.tangent[..3])) > 0.99, "{vertex:?}");
        }
    }
    assert_eq!(shape("shape = \"sphere\"\nsegments = 8").meshes[0].triangles.len(), 2 * 8 * 3);
}

#[test]
fn plane_box_and_disk_have_their_size_and_face_the_right_way() {
    let plane = &shape("shape = \"plane\"\nsize = [4, 2]").meshes[0];
    assert_eq!((plane.vertices.len(), plane.triangles.len()), (4, 2));
    for vertex in &plane.vertices {
        let [u, v] = vertex.uv;
        close(&vertex.position, &[4.0 * u - 2.0, 0.0, 1.0 - 2.0 * v]);
        assert_eq!((vertex.normal, vertex.tangent), ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0]));
    }
    let cuboid = &shape("shape = \"box\"\nsize = [1, 2, 3]").meshes[0];
    assert_eq!((cuboid.vertices.len(), cuboid.triangles.len()), (24, 12));
    close(&[volume(cuboid)], &[6.0]);
    assert!(cuboid.vertices.iter().all(|v| Vec3::from(v.normal).dot(v.position.into()) > 0.0));
    let disk = &shape("shape = \"disk\"\nradius = 2\nsegments = 6").meshes[0];
    assert_eq!((disk.vertices.len(), disk.triangles.len()), (7, 6));
    assert!(disk.vertices.iter().all(|v| v.normal == [0.0, 1.0, 0.0] && v.tangent[3] == 1.0));
    let up = |[a, b, c]: &[u32; 3]| {
        let p = |i: &u32| Vec3::from(disk.vertices[*i as usize].position);
        (p(b) - p(a)).cross(p(c) - p(a)).y > 0.0
    };
    assert!(disk.triangles.iter().all(up));
}

#[test]
fn a_shape_without_material_is_grey_and_said_so() {
    let scene = load("[[mesh]]\nshape = \"box\"\n", &[]);
    assert_eq!(scene.materials[0].parameters[0].constant, [0.5; 3]);
    assert!(scene.warnings[0].contains("test.toml:5"), "{:?}", scene.warnings);
}
