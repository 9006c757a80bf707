//! The built-in shapes, centred at the origin: triangles with normals and texture coordinates.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::geometry::{Corner, Group};

fn corner(position: DVec3, normal: DVec3, u: f64, v: f64) -> Corner {
    Corner { position: position.as_vec3(), normal: normal.as_vec3(), uv: Some([u as f32, v as f32]) }
}

/// Without a material name.
fn group(corners: Vec<Corner>) -> Group {
    Group { material: None, corners }
}

/// Two triangles: centre ± `u` ± `v`, facing u × v, the texture's u along `u`.
fn quad(center: DVec3, u: DVec3, v: DVec3) -> [Corner; 6] {
    let normal = u.cross(v).normalize();
    let at = |a: f64, b: f64| corner(center + u * a + v * b, normal, a * 0.5 + 0.5, b * 0.5 + 0.5);
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    [a, b, c, a, c, d]
}

/// A rectangle of `size` along x and z that faces +Y; the texture's up is −Z.
pub(super) fn plane(size: [f64; 2]) -> Group {
    let (u, v) = (DVec3::X * size[0] * 0.5, DVec3::NEG_Z * size[1] * 0.5);
    group(quad(DVec3::ZERO, u, v).to_vec())
}

/// A box of edge lengths `size`; every face has the whole texture, upright on the four sides.
pub(super) fn cuboid(size: [f64; 3]) -> Group {
    let [x, y, z] = [DVec3::X * size[0], DVec3::Y * size[1], DVec3::Z * size[2]].map(|axis| axis * 0.5);
    // Per face: outwards, u, v, with u × v pointing outwards.
    let faces = [(x, -z, y), (-x, z, y), (y, x, -z), (-y, x, z), (z, x, y), (-z, -x, y)];
    group(faces.into_iter().flat_map(|(out, u, v)| quad(out, u, v)).collect())
}

/// A UV sphere of `segments` along longitude and latitude; u runs eastwards from +Z over +X, v from the south
/// pole (−Y) to the north pole.
pub(super) fn sphere(radius: f64, segments: [u32; 2]) -> Group {
    let [longitudes, latitudes] = segments;
    let at = |i: u32, j: u32, u: f64| {
        // The last meridian is the first one, to the bit.
        let phi = TAU * f64::from(i % longitudes) / f64::from(longitudes);
        let theta = PI * f64::from(j) / f64::from(latitudes);
        let ring = if j == 0 || j == latitudes { 0.0 } else { theta.sin() };
        let normal = DVec3::new(ring * phi.sin(), -theta.cos(), ring * phi.cos());
        corner(normal * radius, normal, u / f64::from(longitudes), f64::from(j) / f64::from(latitudes))
    };
    let mut corners = Vec::new();
    for j in 0..latitudes {
        for i in 0..longitudes {
            let (west, east, middle) = (f64::from(i), f64::from(i + 1), f64::from(i) + 0.5);
            if j > 0 {
                let top = if j + 1 == latitudes { middle } else { east };
                corners.extend([at(i, j, west), at(i + 1, j, east), at(i + 1, j + 1, top)]);
            }
            if j + 1 < latitudes {
                let bottom = if j == 0 { middle } else { west };
                corners.extend([at(i, j, bottom), at(i + 1, j + 1, east), at(i, j + 1, west)]);
            }
        }
    }
    group(corners)
}

/// A disk that faces +Y, of `segments` sectors; the texture's circle touches its borders, up is −Z.
pub(super) fn disk(radius: f64, segments: u32) -> Group {
    let at = |i: u32| {
        let (sin, cos) = (TAU * f64::from(i % segments) / f64::from(segments)).sin_cos();
        corner(DVec3::new(cos, 0.0, -sin) * radius, DVec3::Y, 0.5 + 0.5 * cos, 0.5 + 0.5 * sin)
    };
    let center = Corner { position: Vec3::ZERO, normal: Vec3::Y, uv: Some([0.5, 0.5]) };
    group((0..segments).flat_map(|i| [center, at(i), at(i + 1)]).collect())
}
