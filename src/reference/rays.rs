//! Camera rays, and where they meet the triangles, in double precision.
//!
//! Triangles by Woop, Benthin and Wald 2013, *Watertight Ray/Triangle Intersection*: the edge tests of two triangles
//! are exactly opposite on their common edge, so no ray slips through.

use glam::{DVec2, DVec3};

use super::shading::vertex_uv;
use super::texture::{Wrap, sample};
pub use super::tree::Ray;
use super::tree::{Bounds, Tree};
use crate::scene::{Camera, Mesh, Parameter, Projection, Scene};

/// A ray with the distances between which it sees.
#[derive(Clone, Copy, Debug)]
pub struct CameraRay {
    /// Origin and unit direction.
    pub ray: Ray,
    /// Distance along the ray of the near plane.
    pub t_min: f64,
    /// Distance of the far plane, infinite without one.
    pub t_max: f64,
}

/// The ray through the picture at (`x`, `y`) pixels from its upper left corner; a pixel's centre is at +½.
#[must_use]
pub fn camera_ray(camera: &Camera, size: [u32; 2], x: f64, y: f64) -> CameraRay {
    let basis = camera.basis();
    let [width, height] = size.map(f64::from);
    let plane =
        basis.right * (width / height * (2.0 * x / width - 1.0)) + basis.up * (1.0 - 2.0 * y / height);
    let (origin, direction) = match camera.projection {
        Projection::Perspective { vertical_fov } => {
            let tangent = (0.5 * vertical_fov.to_radians()).tan();
            (camera.position, (basis.forward + plane * tangent).normalize())
        }
        Projection::Orthographic { height } => (camera.position + plane * (0.5 * height), basis.forward),
    };
    // Near and far are planes: distances along the view, not along the ray.
    let per_view = 1.0 / direction.dot(basis.forward);
    CameraRay {
        ray: Ray::new(origin, direction),
        t_min: camera.near * per_view,
        t_max: camera.far.map_or(f64::INFINITY, |far| far * per_view),
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the ray, metres.
    pub t: f64,
    /// Index into `Scene::meshes`.
    pub mesh: usize,
    /// Index into `Mesh::triangles`.
    pub triangle: usize,
    /// Weights of the three vertices.
    pub weights: [f64; 3],
    /// The ray comes from the side from which the triangle winds counter-clockwise.
    pub front: bool,
}

/// The triangles of a scene, ready for rays.
#[derive(Debug)]
pub struct Geometry<'a> {
    scene: &'a Scene,
    /// Mesh and triangle of each item of the tree.
    triangles: Vec<(u32, u32)>,
    tree: Tree,
}

impl<'a> Geometry<'a> {
    /// Builds the hierarchy.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let of_mesh = |(m, mesh): (usize, &Mesh)| {
            let count = mesh.triangles.len() as u32;
            (0..count).map(move |t| (m as u32, t)).collect::<Vec<_>>()
        };
        let triangles: Vec<_> = scene.meshes.iter().enumerate().flat_map(of_mesh).collect();
        let bounds = |&(m, t): &(u32, u32)| Bounds::around(corners(&scene.meshes[m as usize], t as usize));
        let boxes: Vec<_> = triangles.iter().map(bounds).collect();
        Self { scene, triangles, tree: Tree::new(&boxes) }
    }

    /// The nearest surface that is drawn: back faces of one-sided materials and what an alpha mask cuts are not there.
    #[must_use]
    pub fn closest(&self, view: &CameraRay) -> Option<Hit> {
        self.first(&view.ray, [view.t_min, view.t_max], |hit| self.drawn(hit) && self.uncut(hit))
    }

    /// The nearest triangle beyond `t_min`, from either side, except what an alpha mask cuts and the triangle `except`
    /// (mesh, triangle), on which the ray begins.
    pub(crate) fn wall(&self, ray: &Ray, t_min: f64, except: (usize, usize)) -> Option<Hit> {
        self.first(ray, [t_min, f64::INFINITY], |hit| (hit.mesh, hit.triangle) != except && self.uncut(hit))
    }

    fn first(&self, ray: &Ray, [t_min, t_max]: [f64; 2], counts: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let sheared = Sheared::new(ray);
        let mut closest = None;
        self.tree.along_ray(ray, t_max, |item, t_max| {
            let (m, t) = self.triangles[item];
            let (mesh, triangle) = (m as usize, t as usize);
            let (t, weights, front) = sheared.meets(corners(&self.scene.meshes[mesh], triangle))?;
            let hit = Hit { t, mesh, triangle, weights, front };
            if t < t_min || t > t_max || !counts(&hit) {
                return None;
            }
            closest = Some(hit);
            Some(t)
        });
        closest
    }

    /// Whether a triangle lies in the way between two distances along a ray, from either side: a wall is a wall even
    /// where its back is not drawn. What an alpha mask cuts is no wall, nor is the triangle `except` (mesh, triangle),
    /// on which the ray begins.
    #[must_use]
    pub fn occludes(&self, ray: &Ray, [t_min, t_max]: [f64; 2], except: Option<(usize, usize)>) -> bool {
        let sheared = Sheared::new(ray);
        self.tree.any_along_ray(ray, t_max, |item| {
            let (m, t) = self.triangles[item];
            let (mesh, triangle) = (m as usize, t as usize);
            if except == Some((mesh, triangle)) {
                return false;
            }
            let met = sheared.meets(corners(&self.scene.meshes[mesh], triangle));
            met.is_some_and(|(t, weights, front)| {
                (t_min..t_max).contains(&t) && self.uncut(&Hit { t, mesh, triangle, weights, front })
            })
        })
    }

    /// Normal of the triangle that a hit lies in, on the side from which it winds counter-clockwise; not of unit length.
    #[must_use]
    pub fn normal(&self, hit: &Hit) -> DVec3 {
        let [a, b, c] = corners(&self.scene.meshes[hit.mesh], hit.triangle);
        (b - a).cross(c - a)
    }

    /// The side that a ray hit has a material: a one-sided one's back has none.
    pub(crate) fn drawn(&self, hit: &Hit) -> bool {
        let mesh = &self.scene.meshes[hit.mesh];
        hit.front || self.scene.materials[mesh.material as usize].two_sided
    }

    /// The material's alpha mask leaves the place of a hit.
    fn uncut(&self, hit: &Hit) -> bool {
        let mesh = &self.scene.meshes[hit.mesh];
        let mask = self.scene.materials[mesh.material as usize].value(Parameter::Mask).texture;
        mask.is_none_or(|index| {
            let uv = vertex_uv(mesh, hit);
            sample(&self.scene.textures[index as usize], uv, Wrap::Repeat).x >= 0.5
        })
    }
}

fn corners(mesh: &Mesh, triangle: usize) -> [DVec3; 3] {
    let corner = |vertex: u32| DVec3::from_array(mesh.vertices[vertex as usize].position.map(f64::from));
    mesh.triangles[triangle].map(corner)
}

/// A ray as the shear that makes it the z axis, once for all triangles.
struct Sheared {
    origin: DVec3,
    /// Axes of the ray's space; z is the one along which the direction is longest.
    axes: [usize; 3],
    shear: DVec2,
    scale: f64,
}

impl Sheared {
    fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if d[z] < 0.0 {
            // Keeps the winding.
            std::mem::swap(&mut x, &mut y);
        }
        let scale = 1.0 / d[z];
        Self { origin: ray.origin, axes: [x, y, z], shear: DVec2::new(d[x], d[y]) * scale, scale }
    }

    /// Distance, weights, and whether the front faces the ray.
    fn meets(&self, corners: [DVec3; 3]) -> Option<(f64, [f64; 3], bool)> {
        let [x, y, z] = self.axes;
        let [a, b, c] = corners.map(|corner| {
            let p = corner - self.origin;
            (DVec2::new(p[x], p[y]) - self.shear * p[z], self.scale * p[z])
        });
        let edges = [c.0.perp_dot(b.0), a.0.perp_dot(c.0), b.0.perp_dot(a.0)];
        let (outside, inside) = (edges.iter().any(|&e| e < 0.0), edges.iter().any(|&e| e > 0.0));
        let sum: f64 = edges.iter().sum();
        if (outside && inside) || sum == 0.0 {
            return None;
        }
        let weights = edges.map(|edge| edge / sum);
        let t = weights[0] * a.1 + weights[1] * b.1 + weights[2] * c.1;
        (t > 0.0).then_some((t, weights, sum > 0.0))
    }
}
