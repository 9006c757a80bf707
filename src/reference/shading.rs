//! From a hit to a frame and a BSDF.
//!
//! Facing: a hit is on the front if the ray comes from the side from which the triangle winds counter-clockwise (the
//! GPU's `gl_FrontFacing`). The shading normal is interpolated, normalised, perturbed by the normal map, and **negated
//! on the back** of a two-sided surface. Where interpolation then leaves it facing away from the viewer (n·wo ≤ 0, at
//! silhouettes), f = 0 by the BSDFs' own rule; the GPU does the same.

use glam::{DVec2, DVec3};

use super::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use super::rays::{Hit, Ray};
use super::texture::{Wrap, sample};
use crate::scene::{Material, Mesh, Model, Parameter, Scene};

/// An orthonormal frame whose z axis is the shading normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// x, along ∂p/∂u where there are texture coordinates.
    pub tangent: DVec3,
    /// y = normal × tangent.
    pub bitangent: DVec3,
    /// z.
    pub normal: DVec3,
}

impl Frame {
    /// A frame about a unit normal, the tangent orthogonalised against it; `None` if the tangent is parallel or zero.
    #[must_use]
    pub fn with_tangent(normal: DVec3, tangent: DVec3) -> Option<Self> {
        let tangent = (tangent - normal * normal.dot(tangent)).try_normalize()?;
        Some(Self { tangent, bitangent: normal.cross(tangent), normal })
    }

    /// Any frame about a unit normal.
    #[must_use]
    pub fn about(normal: DVec3) -> Self {
        let tangent = normal.any_orthonormal_vector();
        Self { tangent, bitangent: normal.cross(tangent), normal }
    }

    /// A world direction in the frame.
    #[must_use]
    pub fn to_local(&self, w: DVec3) -> DVec3 {
        DVec3::new(w.dot(self.tangent), w.dot(self.bitangent), w.dot(self.normal))
    }

    /// A direction of the frame in the world.
    #[must_use]
    pub fn to_world(&self, w: DVec3) -> DVec3 {
        self.tangent * w.x + self.bitangent * w.y + self.normal * w.z
    }
}

/// A point to be shaded.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// World position.
    pub position: DVec3,
    /// Shading frame, turned to the viewer.
    pub frame: Frame,
    /// Towards the viewer, in the frame.
    pub wo: DVec3,
    /// Material at the point.
    pub bsdf: Bsdf,
}

impl Surface {
    /// Resolves a hit of `ray`.
    #[must_use]
    pub fn new(scene: &Scene, ray: &Ray, hit: &Hit) -> Self {
        let mesh = &scene.meshes[hit.mesh];
        let material = &scene.materials[mesh.material as usize];
        let parameters = Parameters { scene, material, uv: vertex_uv(mesh, hit) };
        let (frame, has_tangent) = shading_frame(mesh, hit, &parameters, -ray.direction);
        Self {
            position: ray.origin + hit.t * ray.direction,
            frame,
            wo: frame.to_local(-ray.direction),
            bsdf: parameters.bsdf(has_tangent),
        }
    }
}

/// The frame at a hit, and whether its tangent means anything.
///
/// A two-sided surface's interpolated normal is turned to the viewer by its own cosine, not by the triangle's facing:
/// at the silhouette of a smooth mesh the two differ, and a normal turned away would leave a black rim. A normal map
/// is applied on the front and turned with it.
fn shading_frame(mesh: &Mesh, hit: &Hit, parameters: &Parameters, wo: DVec3) -> (Frame, bool) {
    let normal = interpolate(mesh, hit, |v| v.normal.map(f64::from)).normalize_or(DVec3::Y);
    let turn = if parameters.material.two_sided && normal.dot(wo) < 0.0 { -1.0 } else { 1.0 };
    let tangent = interpolate(mesh, hit, |v| {
        let [x, y, z, _] = v.tangent.map(f64::from);
        [x, y, z]
    });
    let Some(frame) = Frame::with_tangent(normal, tangent) else {
        return (Frame::about(turn * normal), false);
    };
    let handedness = interpolate(mesh, hit, |v| [f64::from(v.tangent[3]); 3]).x.signum();
    let mapped = parameters.mapped_normal(&frame, handedness).map(|mapped| facing(turn * mapped, wo));
    let normal = mapped.unwrap_or(turn * normal);
    match Frame::with_tangent(normal, frame.tangent) {
        Some(frame) => (frame, true),
        None => (Frame::about(normal), false),
    }
}

/// Least cosine of a mapped normal to the viewer.
const FACING: f64 = 0.01;

/// A normal map's normal bent just far enough to face the viewer: one that faces away belongs to a bump's far side,
/// which the viewer cannot see, and would leave a black hole.
fn facing(normal: DVec3, wo: DVec3) -> DVec3 {
    let away = FACING - normal.dot(wo);
    if away > 0.0 { (normal + away * wo).normalize_or(wo) } else { normal }
}

/// Texture coordinates at a hit.
pub(super) fn vertex_uv(mesh: &Mesh, hit: &Hit) -> DVec2 {
    interpolate(mesh, hit, |v| [f64::from(v.uv[0]), f64::from(v.uv[1]), 0.0]).truncate()
}

fn interpolate(mesh: &Mesh, hit: &Hit, attribute: impl Fn(&crate::scene::Vertex) -> [f64; 3]) -> DVec3 {
    let corners = mesh.triangles[hit.triangle];
    corners
        .iter()
        .zip(hit.weights)
        .map(|(&vertex, weight)| weight * DVec3::from_array(attribute(&mesh.vertices[vertex as usize])))
        .sum()
}

/// A material's table at one texture coordinate.
struct Parameters<'a> {
    scene: &'a Scene,
    material: &'a Material,
    uv: DVec2,
}

impl Parameters<'_> {
    fn rgb(&self, parameter: Parameter) -> DVec3 {
        let value = self.material.value(parameter);
        match value.texture {
            Some(index) => sample(&self.scene.textures[index as usize], self.uv, Wrap::Repeat),
            None => DVec3::from_array(value.constant.map(f64::from)),
        }
    }

    fn scalar(&self, parameter: Parameter) -> f64 {
        self.rgb(parameter).x
    }

    /// The normal map's normal in the world, of a tangent space with +y up; `None` without a map.
    fn mapped_normal(&self, frame: &Frame, handedness: f64) -> Option<DVec3> {
        self.material.value(Parameter::Normal).texture?;
        let local = 2.0 * self.rgb(Parameter::Normal) - DVec3::ONE;
        let bitangent = handedness * frame.bitangent;
        (frame.tangent * local.x + bitangent * local.y + frame.normal * local.z).try_normalize()
    }

    /// Perceptual roughness and raw alpha.
    fn roughness_and_alpha(&self) -> (f64, f64) {
        let value = self.scalar(Parameter::Roughness);
        if self.material.squared_roughness { (value, value * value) } else { (value.max(0.0).sqrt(), value) }
    }

    /// alpha_x = alpha/aspect, alpha_y = alpha·aspect, each at least 1e-3; isotropic with √(alpha_x alpha_y) where
    /// there is no tangent.
    fn ggx(&self, has_tangent: bool) -> Ggx {
        let (_, alpha) = self.roughness_and_alpha();
        let value = self.scalar(Parameter::Aspect);
        let aspect = match self.material.value(Parameter::Aspect).texture {
            Some(_) => (1.0 - 0.9 * value).max(0.0).sqrt(),
            None => value,
        };
        let ggx = Ggx { alpha_x: (alpha / aspect).max(1e-3), alpha_y: (alpha * aspect).max(1e-3) };
        if has_tangent { ggx } else { Ggx::isotropic((ggx.alpha_x * ggx.alpha_y).sqrt()) }
    }

    fn bsdf(&self, has_tangent: bool) -> Bsdf {
        let (color, specular) = (self.rgb(Parameter::Color), self.rgb(Parameter::Specular));
        match self.material.model {
            Model::Matte => Bsdf::Matte(Matte { color, sigma: self.scalar(Parameter::Sigma) }),
            Model::Plastic => Bsdf::Plastic(Plastic {
                diffuse: color,
                specular,
                eta: self.scalar(Parameter::Eta),
                alpha: self.roughness_and_alpha().1.max(1e-3),
            }),
            Model::Metal => Bsdf::Metal(Metal { eta: color, k: specular, ggx: self.ggx(has_tangent) }),
            Model::Substrate => {
                Bsdf::Substrate(Substrate { diffuse: color, specular, ggx: self.ggx(has_tangent) })
            }
            Model::Principled => Bsdf::Principled(self.principled(color, has_tangent)),
        }
    }

    fn principled(&self, base_color: DVec3, has_tangent: bool) -> Principled {
        Principled {
            base_color,
            metallic: self.scalar(Parameter::Metallic),
            eta: self.scalar(Parameter::Eta),
            roughness: self.roughness_and_alpha().0,
            ggx: self.ggx(has_tangent),
            specular_tint: self.scalar(Parameter::SpecularTint),
            sheen: self.scalar(Parameter::Sheen),
            sheen_tint: self.scalar(Parameter::SheenTint),
            clearcoat: self.scalar(Parameter::Clearcoat),
            clearcoat_gloss: self.scalar(Parameter::ClearcoatGloss),
            subsurface: self.scalar(Parameter::Subsurface),
        }
    }
}
