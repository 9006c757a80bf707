//! Tangents from texture coordinates.

use glam::{DVec3, Vec3, Vec4};

use super::geometry::angle;
use super::mesh::Mesh;

/// Gives every vertex the direction ∂p/∂u of its triangles, weighted by angle and orthogonalised against the
/// normal, and the sign w for which w·(n × t) points along ∂p/∂v. A vertex between mirrored halves of the
/// texture becomes two; one without usable texture coordinates keeps zero.
pub(super) fn add(mesh: &mut Mesh) {
    let mut sums = vec![DVec3::ZERO; mesh.vertices.len()];
    // Per vertex the sign that came first (0: none yet), and the vertex with the other sign.
    let mut signs = vec![0_i8; mesh.vertices.len()];
    let mut twins: Vec<Option<u32>> = vec![None; mesh.vertices.len()];
    for triangle in &mut mesh.triangles {
        let vertices = triangle.map(|index| mesh.vertices[index as usize]);
        let points = vertices.map(|vertex| Vec3::from(vertex.position).as_dvec3());
        let Some((along_u, along_v)) = derivatives(points, vertices.map(|vertex| vertex.uv)) else {
            continue;
        };
        for i in 0..3 {
            let normal = Vec3::from(vertices[i].normal).as_dvec3();
            let sign = if normal.cross(along_u).dot(along_v) < 0.0 { -1 } else { 1 };
            let mut index = triangle[i] as usize;
            if signs[index] == -sign {
                index = *twins[index].get_or_insert(mesh.vertices.len() as u32) as usize;
                triangle[i] = index as u32;
                if index == mesh.vertices.len() {
                    mesh.vertices.push(vertices[i]);
                    sums.push(DVec3::ZERO);
                    signs.push(sign);
                    twins.push(None);
                }
            }
            signs[index] = sign;
            sums[index] += along_u * angle(points, i);
        }
    }
    for ((vertex, sum), sign) in mesh.vertices.iter_mut().zip(sums).zip(signs) {
        let normal = Vec3::from(vertex.normal).as_dvec3();
        let tangent = sum.reject_from(normal);
        // What is left of a sum along the normal, or of one that cancelled, is rounding.
        if tangent.length() > 1e-6 {
            let tangent = tangent.normalize().as_vec3();
            vertex.tangent = Vec4::from((tangent, f32::from(sign))).to_array();
        }
    }
}

/// Unit ∂p/∂u and ∂p/∂v of a triangle; `None` where the texture coordinates span no area.
fn derivatives(points: [DVec3; 3], uvs: [[f32; 2]; 3]) -> Option<(DVec3, DVec3)> {
    let (e1, e2) = (points[1] - points[0], points[2] - points[0]);
    let difference = |i: usize, axis: usize| f64::from(uvs[i][axis]) - f64::from(uvs[0][axis]);
    let (u1, u2, v1, v2) = (difference(1, 0), difference(2, 0), difference(1, 1), difference(2, 1));
    let determinant = u1 * v2 - u2 * v1;
    if determinant.abs() <= 1e-12 * (u1.hypot(v1) * u2.hypot(v2)) {
        return None;
    }
    let along_u = (e1 * v2 - e2 * v1) * determinant.signum();
    let along_v = (e2 * u1 - e1 * u2) * determinant.signum();
    Some((along_u.try_normalize()?, along_v.try_normalize()?))
}
