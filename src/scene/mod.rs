//! What the world is: plain data, no Vulkan.
//!
//! Right-handed, +Y up, metres. Colours are scene-linear Rec.709; radiance in W·sr⁻¹·m⁻², radiant intensity in W·sr⁻¹.

mod bind;
mod bump;
pub mod camera;
mod decode;
mod files;
mod geometry;
pub mod light;
mod load;
pub mod luminaire;
pub mod material;
pub mod mesh;
pub mod mips;
pub mod motion;
mod mtl;
mod obj;
mod obj_scan;
mod outline;
mod outline_bridge;
mod parse;
mod points;
mod presets;
pub mod settings;
mod shapes;
mod studio;
mod tangents;
pub mod texture;
mod triangulate;
mod widen;
pub mod write;

pub use camera::{Camera, KeyFrame, Projection};
pub use light::{AreaLight, AreaShape, PointLight};
pub use load::{Origin, load, load_embedded};
pub use luminaire::Luminaire;
pub use material::{Material, Model, Parameter};
pub use mesh::{Mesh, Vertex};
pub use motion::Motion;
pub use settings::RenderSettings;
pub use texture::{Texels, Texture};

use std::ops::Range;
use std::path::PathBuf;

/// A whole scene, in world space, validated: every index is in range and every number finite.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// `[render]`.
    pub render: RenderSettings,
    /// At least one; the first is the default.
    pub cameras: Vec<Camera>,
    /// Materials that meshes refer to by index.
    pub materials: Vec<Material>,
    /// Textures that material parameters refer to by index.
    pub textures: Vec<Texture>,
    /// Triangles in world space, one material a mesh.
    pub meshes: Vec<Mesh>,
    /// Point lights, in file order, where they are at time 0.
    pub point_lights: Vec<PointLight>,
    /// The point lights of each `[[light]]` that has any, in file order.
    pub point_groups: Vec<Range<usize>>,
    /// Groups of them that move.
    pub motions: Vec<Motion>,
    /// Area lights, in file order.
    pub area_lights: Vec<AreaLight>,
    /// Every file that was read for it, the scene file first; none of a scene that is part of the program.
    pub files: Vec<PathBuf>,
    /// What loading noticed and repaired, each with file, line, cause and remedy.
    pub warnings: Vec<String>,
}

impl Scene {
    /// The point lights at time `t`, in seconds; only by their positions do they differ from those of time 0.
    #[must_use]
    pub fn point_lights_at(&self, t: f64) -> Vec<PointLight> {
        let mut lights = self.point_lights.clone();
        for motion in &self.motions {
            motion.apply(t, &mut lights[motion.lights.clone()]);
        }
        lights
    }
}
