//! Lights and their units.

use glam::Vec3;

/// An isotropic point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// World position.
    pub position: Vec3,
    /// Radiant intensity, W·sr⁻¹, per colour channel.
    pub intensity: Vec3,
    /// Window (1 − (d/range)⁴)²₊ on 1/max(d², 1e-4); `None` is pure inverse square, d² floored at 1e-12.
    pub range: Option<f32>,
}

/// An area light of uniform or textured radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLight {
    /// Where it is.
    pub shape: AreaShape,
    /// Emitted radiance, W·sr⁻¹·m⁻².
    pub radiance: Vec3,
    /// Emits on both sides.
    pub two_sided: bool,
    /// Seen by the camera and occluding.
    pub visible: bool,
    /// Multiplies the radiance; index into `Scene::textures`.
    pub texture: Option<u32>,
}

/// Shapes of area lights; the front is where the normal points.
#[derive(Clone, Debug, PartialEq)]
pub enum AreaShape {
    /// Planar outline of 3…64 vertices with holes.
    Polygon {
        /// Outer loop; its Newell normal is the front.
        vertices: Vec<Vec3>,
        /// Inner loops, wound either way.
        holes: Vec<Vec<Vec3>>,
        /// Texture coordinates per outer vertex, if given.
        uvs: Option<Vec<[f32; 2]>>,
    },
    /// Parallelogram center ± u ± v; normal u × v.
    Rect {
        /// Centre.
        center: Vec3,
        /// Half axis.
        u: Vec3,
        /// Half axis.
        v: Vec3,
    },
    /// Disk or ellipse center + u cos φ + v sin φ; normal u × v.
    Disk {
        /// Centre.
        center: Vec3,
        /// Half axis.
        u: Vec3,
        /// Half axis.
        v: Vec3,
    },
    /// Thin diffuse cylinder.
    Line {
        /// One end.
        a: Vec3,
        /// Other end.
        b: Vec3,
        /// Radius of the cylinder.
        radius: f32,
    },
}
