//! Area lights as triangles: what a camera sees of them, and what hides other lights.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3, Vec3};

use super::light::{AreaLight, AreaShape};
use super::mesh::Vertex;
use super::outline_bridge::{bridged, newell_normal};
use super::triangulate::ears;

/// Corners of an ellipse, which lie on it.
const ELLIPSE: u32 = 64;
/// Sides of a line's cylinder, whose edges lie on it.
const CYLINDER: u32 = 24;

/// An area light's surface. Its triangles wind counter-clockwise as seen from the front; texture coordinates are those
/// of the light's texture, (0, 0) at the image's lower left; tangents are zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Luminaire {
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Indices into them.
    pub triangles: Vec<[u32; 3]>,
}

impl Luminaire {
    /// The surface of `light`, whether or not it is visible.
    #[must_use]
    pub fn new(light: &AreaLight) -> Self {
        match &light.shape {
            AreaShape::Rect { center, u, v } => {
                fan(*center, [*u, *v], &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
            }
            AreaShape::Disk { center, u, v } => {
                let at = |i: u32| (TAU * f64::from(i) / f64::from(ELLIPSE)).sin_cos();
                let rim: Vec<_> = (0..ELLIPSE).map(at).map(|(sin, cos)| [cos, sin]).collect();
                fan(*center, [*u, *v], &rim)
            }
            AreaShape::Polygon { vertices, holes, uvs } => polygon(vertices, holes, uvs.as_deref()),
            AreaShape::Line { a, b, radius } => cylinder(a.as_dvec3(), b.as_dvec3(), f64::from(*radius)),
        }
    }
}

fn vertex(position: DVec3, normal: DVec3, uv: DVec2) -> Vertex {
    Vertex {
        position: position.as_vec3().to_array(),
        normal: normal.as_vec3().to_array(),
        tangent: [0.0; 4],
        uv: uv.as_vec2().to_array(),
    }
}

/// A convex outline, given in the coordinates of the half axes `u` and `v`.
fn fan(center: Vec3, axes: [Vec3; 2], outline: &[[f64; 2]]) -> Luminaire {
    let (center, [u, v]) = (center.as_dvec3(), axes.map(|axis| axis.as_dvec3()));
    let normal = u.cross(v).normalize_or_zero();
    let corner = |&[s, t]: &[f64; 2]| vertex(center + s * u + t * v, normal, 0.5 * DVec2::new(s, t) + 0.5);
    let triangles = (2..outline.len() as u32).map(|i| [0, i - 1, i]).collect();
    Luminaire { vertices: outline.iter().map(corner).collect(), triangles }
}

/// The side of a cylinder, open at both ends; u runs along it.
fn cylinder(a: DVec3, b: DVec3, radius: f64) -> Luminaire {
    let axis = (b - a).normalize_or(DVec3::Y);
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..=CYLINDER {
        // The last edge is the first one, to the bit, with another texture coordinate.
        let (sin, cos) = (TAU * f64::from(i % CYLINDER) / f64::from(CYLINDER)).sin_cos();
        let (out, around) = (cos * x + sin * y, f64::from(i) / f64::from(CYLINDER));
        let end = |p: DVec3, along: f64| vertex(p + radius * out, out, DVec2::new(along, around));
        vertices.extend([end(a, 0.0), end(b, 1.0)]);
        if i < CYLINDER {
            let [near, far, next_near, next_far] = [0, 1, 2, 3].map(|k| 2 * i + k);
            triangles.extend([[near, next_near, next_far], [near, next_far, far]]);
        }
    }
    Luminaire { vertices, triangles }
}

/// An outline with holes, cut open along bridges to the holes and then into ears.
fn polygon(outer: &[Vec3], holes: &[Vec<Vec3>], uvs: Option<&[[f32; 2]]>) -> Luminaire {
    let outer: Vec<_> = outer.iter().map(|p| p.as_dvec3()).collect();
    let normal = newell_normal(&outer);
    let edge = outer.iter().zip(outer.iter().cycle().skip(1)).find_map(|(a, b)| (b - a).try_normalize());
    let u = edge.unwrap_or_else(|| normal.any_orthonormal_vector());
    let v = normal.cross(u);
    let flat = |p: DVec3| DVec2::new((p - outer[0]).dot(u), (p - outer[0]).dot(v));
    let all: Vec<_> = outer.iter().copied().chain(holes.iter().flatten().map(|p| p.as_dvec3())).collect();
    let places: Vec<_> = all.iter().map(|&p| flat(p)).collect();
    let mut begin = outer.len();
    let loops = holes.iter().map(|hole| {
        begin += hole.len();
        (begin - hole.len()..begin).collect()
    });
    let open = bridged(&places, (0..outer.len()).collect(), loops.collect());
    let cut: Vec<_> = open.iter().map(|&index| places[index]).collect();
    let triangles = ears(&cut).into_iter().map(|ear| ear.map(|corner| open[corner] as u32)).collect();
    let to_uv = match uvs {
        Some(uvs) => fitted(&places[..outer.len()], uvs),
        None => bounding(&places[..outer.len()]),
    };
    let uv = |place: DVec2| DVec2::from_array(to_uv.map(|row| row.dot(place.extend(1.0))));
    let vertices = all.iter().zip(&places).map(|(&p, &place)| vertex(p, normal, uv(place))).collect();
    Luminaire { vertices, triangles }
}

/// Rows that take (x, y, 1) to texture coordinates: the bounding rectangle to the unit square.
fn bounding(places: &[DVec2]) -> [DVec3; 2] {
    let low = places.iter().fold(DVec2::INFINITY, |low, &p| low.min(p));
    let high = places.iter().fold(DVec2::NEG_INFINITY, |high, &p| high.max(p));
    let scale = (high - low).max(DVec2::splat(f64::MIN_POSITIVE)).recip();
    let offset = -low * scale;
    [DVec3::new(scale.x, 0.0, offset.x), DVec3::new(0.0, scale.y, offset.y)]
}

/// The affine map that fits the outer vertices' own coordinates in the least squares.
pub(crate) fn fitted(places: &[DVec2], uvs: &[[f32; 2]]) -> [DVec3; 2] {
    let mut squares = DMat3::ZERO;
    let mut right = [DVec3::ZERO; 2];
    for (place, uv) in places.iter().zip(uvs) {
        let p = place.extend(1.0);
        squares += DMat3::from_cols(p * p.x, p * p.y, p);
        for (sum, coordinate) in right.iter_mut().zip(uv) {
            *sum += p * f64::from(*coordinate);
        }
    }
    right.map(|sum| squares.inverse() * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn light(shape: AreaShape) -> AreaLight {
        AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: true, texture: None }
    }

    /// Area, and the sum of what the triangles' normals say of the vertices': 2 where all agree.
    fn measure(luminaire: &Luminaire) -> (f64, f64) {
        let mut area = 0.0;
        let mut least = 1.0_f64;
        for triangle in &luminaire.triangles {
            let corners = triangle.map(|i| luminaire.vertices[i as usize]);
            let [a, b, c] = corners.map(|corner| Vec3::from(corner.position).as_dvec3());
            let cross = (b - a).cross(c - a);
            area += 0.5 * cross.length();
            for corner in corners {
                least = least.min(cross.normalize().dot(Vec3::from(corner.normal).as_dvec3()));
            }
        }
        (area, least)
    }

    fn expect(shape: AreaShape, area: f64, facing: f64) {
        let (got, least) = measure(&Luminaire::new(&light(shape)));
        assert!((got / area - 1.0).abs() < 1e-5, "{got} {area}");
        assert!(least > facing, "{least}");
    }

    #[test]
    fn areas_and_facing() {
        let (center, u, v) = (vec3(1.0, 2.0, 3.0), vec3(1.0, 0.0, 0.5), vec3(0.0, 2.0, 0.0));
        let spanned = f64::from(u.cross(v).length());
        expect(AreaShape::Rect { center, u, v }, 4.0 * spanned, 0.9999);
        let inscribed = f64::from(ELLIPSE) / 2.0 * (TAU / f64::from(ELLIPSE)).sin();
        expect(AreaShape::Disk { center, u, v }, inscribed * spanned, 0.9999);
        let around = f64::from(CYLINDER) * 2.0 * (0.5 * TAU / f64::from(CYLINDER)).sin();
        expect(AreaShape::Line { a: center, b: center + 2.0 * v, radius: 0.1 }, around * 0.1 * 4.0, 0.99);
    }

    fn square(x: f32, z: f32, half: f32) -> Vec<Vec3> {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]]
            .map(|[a, b]| vec3(x + a * half, 2.0, z + b * half))
            .into()
    }

    #[test]
    fn holes_of_either_winding_are_cut() {
        let outer = square(0.0, 0.0, 2.0);
        let mut holes: Vec<_> =
            (0..16).map(|i| square((i % 4) as f32 - 1.5, (i / 4) as f32 - 1.5, 0.3)).collect();
        for reversed in 0..2 {
            holes.iter_mut().skip(reversed).step_by(2).for_each(|hole| hole.reverse());
            for count in [0, 1, 2, 5, 16] {
                let holes = holes[..count].to_vec();
                let shape = AreaShape::Polygon { vertices: outer.clone(), holes, uvs: None };
                expect(shape, 16.0 - 0.36 * count as f64, 0.9999);
            }
        }
        let concave =
            [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 1.0], [0.0, 4.0]].map(|[x, y]| vec3(x, y, 0.0));
        let holes = vec![vec![vec3(3.4, 0.3, 0.0), vec3(3.7, 0.3, 0.0), vec3(3.7, 1.5, 0.0)]];
        expect(AreaShape::Polygon { vertices: concave.into(), holes, uvs: None }, 10.0 - 0.18, 0.9999);
    }

    #[test]
    fn texture_lies_in_the_bounding_rectangle_or_as_given() {
        let vertices = square(0.0, 0.0, 1.0);
        let holes = vec![square(0.5, 0.5, 0.1)];
        let shape = |uvs| AreaShape::Polygon { vertices: vertices.clone(), holes: holes.clone(), uvs };
        let luminaire = Luminaire::new(&light(shape(None)));
        assert_eq!(luminaire.vertices[0].uv, [0.0, 0.0]);
        assert_eq!(luminaire.vertices[1].uv, [1.0, 0.0], "u runs along the first edge");
        let given = vec![[0.0, 0.0], [0.0, 2.0], [3.0, 2.0], [3.0, 0.0]];
        let luminaire = Luminaire::new(&light(shape(Some(given))));
        let at_hole = luminaire.vertices[4].uv;
        assert!(
            (at_hole[0] - 3.0 * 0.7).abs() < 1e-5 && (at_hole[1] - 2.0 * 0.7).abs() < 1e-5,
            "{at_hole:?}"
        );
    }
}
