//! From loose triangles to meshes: transform, clean, give normals, share vertices.

use foldhash::fast::RandomState;
use std::collections::{HashMap, HashSet};

use glam::{DMat3, DQuat, DVec3, Vec3};

use super::mesh::{Mesh, Vertex};
use super::parse::LARGEST;
use super::tangents;

/// One corner of a loose triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) position: Vec3,
    /// Zero where the normal is to be computed.
    pub(super) normal: Vec3,
    pub(super) uv: Option<[f32; 2]>,
}

/// Loose triangles of one material: three corners each.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The `usemtl` name.
    pub(super) material: Option<String>,
    pub(super) corners: Vec<Corner>,
}

/// Scale, then rotation, then translation.
pub(super) struct Transform {
    linear: DMat3,
    normals: DMat3,
    translate: DVec3,
}

impl Transform {
    /// `rotate` are Euler degrees, x first; `scale` has no zero.
    pub(super) fn new(scale: DVec3, rotate: DVec3, translate: DVec3) -> Self {
        let [x, y, z] = rotate.to_array().map(f64::to_radians);
        let rotation = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
        let rotation = DMat3::from_quat(rotation);
        let linear = rotation * DMat3::from_diagonal(scale);
        // The inverse transpose of R·S is R·S⁻¹.
        Self { linear, normals: rotation * DMat3::from_diagonal(scale.recip()), translate }
    }

    /// False where a coordinate leaves the sane range.
    fn apply(&self, triangle: &mut [Corner]) -> bool {
        for corner in &mut *triangle {
            let position = self.linear * corner.position.as_dvec3() + self.translate;
            // Adding zero turns −0 into +0, so that equal positions have equal bits.
            corner.position = position.as_vec3() + Vec3::ZERO;
            let normal = self.normals * corner.normal.as_dvec3();
            corner.normal = normal.normalize_or_zero().as_vec3();
        }
        if self.linear.determinant() < 0.0 {
            triangle.swap(1, 2);
        }
        triangle.iter().all(|corner| corner.position.abs().max_element() <= LARGEST as f32)
    }
}

/// What becomes of missing normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Normals {
    /// Those of the faces around the position, weighted by angle.
    Smooth,
    /// That of the face.
    Flat,
}

/// The groups in world space, as one mesh each; groups left without triangles vanish. Degenerate triangles and
/// repeated ones (same positions, same winding) are dropped, across all groups. `None` if a coordinate leaves
/// the sane range.
pub(super) fn bake(
    groups: &[Group],
    transform: &Transform,
    normals: Normals,
) -> Option<Vec<(Option<String>, Mesh)>> {
    let mut welder = Welder::default();
    let mut clean = Vec::with_capacity(groups.len());
    for group in groups {
        clean.push(welder.clean(group, transform)?);
    }
    let smooth = welder.normals();
    let mut meshes = Vec::new();
    for (group, mut triangles) in groups.iter().zip(clean) {
        for triangle in &mut triangles {
            triangle.complete(&smooth, normals);
        }
        if !triangles.is_empty() {
            let mut mesh = index(&triangles);
            tangents::add(&mut mesh);
            meshes.push((group.material.clone(), mesh));
        }
    }
    Some(meshes)
}

struct Triangle {
    corners: [Corner; 3],
    /// Equal numbers are equal positions.
    positions: [u32; 3],
}

impl Triangle {
    /// Fills in missing normals.
    fn complete(&mut self, smooth: &[DVec3], normals: Normals) {
        let [a, b, c] = self.corners.map(|corner| corner.position.as_dvec3());
        let face = (b - a).cross(c - a).normalize();
        for (corner, position) in self.corners.iter_mut().zip(self.positions) {
            if corner.normal == Vec3::ZERO {
                let shared = if normals == Normals::Smooth { smooth[position as usize] } else { DVec3::ZERO };
                // Around a sheet with two sides the sum vanishes.
                let shared = if shared.length() > 1e-6 { shared.normalize() } else { face };
                corner.normal = shared.as_vec3();
            }
        }
    }
}

/// Finds equal positions over all groups.
#[derive(Default)]
struct Welder {
    index: HashMap<[u32; 3], u32, RandomState>,
    seen: HashSet<[u32; 3], RandomState>,
    /// Sum of unit face normals, weighted by angle, per position.
    sums: Vec<DVec3>,
}

impl Welder {
    fn clean(&mut self, group: &Group, transform: &Transform) -> Option<Vec<Triangle>> {
        let mut triangles = Vec::with_capacity(group.corners.len() / 3);
        for corners in group.corners.as_chunks::<3>().0 {
            let mut corners = *corners;
            if !transform.apply(&mut corners) {
                return None;
            }
            let positions = corners.map(|corner| self.position(corner.position));
            let least = positions.iter().enumerate().min_by_key(|(_, p)| **p).map_or(0, |(i, _)| i);
            let rotated = [0, 1, 2].map(|i| positions[(least + i) % 3]);
            if !degenerate(&corners) && self.seen.insert(rotated) {
                self.accumulate(&corners, positions);
                triangles.push(Triangle { corners, positions });
            }
        }
        Some(triangles)
    }

    fn position(&mut self, position: Vec3) -> u32 {
        *self.index.entry(position.to_array().map(f32::to_bits)).or_insert_with(|| {
            self.sums.push(DVec3::ZERO);
            self.sums.len() as u32 - 1
        })
    }

    fn accumulate(&mut self, corners: &[Corner; 3], positions: [u32; 3]) {
        let points = corners.map(|corner| corner.position.as_dvec3());
        let normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize();
        for (i, position) in positions.into_iter().enumerate() {
            self.sums[position as usize] += normal * angle(points, i);
        }
    }

    fn normals(self) -> Vec<DVec3> {
        self.sums
    }
}

/// The angle of a triangle at its corner `i`, in radians.
pub(super) fn angle(points: [DVec3; 3], i: usize) -> f64 {
    let (a, b) = (points[(i + 1) % 3] - points[i], points[(i + 2) % 3] - points[i]);
    a.cross(b).length().atan2(a.dot(b))
}

/// No area worth the name, even in double precision.
fn degenerate(corners: &[Corner; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.position.as_dvec3());
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (b - a).cross(c - a).length() <= 1e-12 * longest || longest < f64::from(f32::MIN_POSITIVE)
}

/// Shares equal vertices.
fn index(triangles: &[Triangle]) -> Mesh {
    let mut mesh = Mesh::default();
    let mut known: HashMap<[u32; 8], u32, RandomState> = HashMap::default();
    for triangle in triangles {
        let indices = triangle.corners.map(|corner| {
            let vertex = Vertex {
                position: corner.position.to_array(),
                normal: (corner.normal + Vec3::ZERO).to_array(),
                tangent: [0.0; 4],
                uv: corner.uv.unwrap_or_default(),
            };
            let ([x, y, z], [i, j, k], [u, v]) = (vertex.position, vertex.normal, vertex.uv);
            *known.entry([x, y, z, i, j, k, u, v].map(f32::to_bits)).or_insert_with(|| {
                mesh.vertices.push(vertex);
                mesh.vertices.len() as u32 - 1
            })
        });
        mesh.triangles.push(indices);
    }
    mesh
}
