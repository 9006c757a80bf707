//! Compiled shaders, as `build.rs` made them.

use ash::vk;

/// A shader stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Vertex.
    Vertex,
    /// Fragment.
    Fragment,
    /// Compute.
    Compute,
}

impl Stage {
    pub(super) fn flags(self) -> vk::ShaderStageFlags {
        match self {
            Self::Vertex => vk::ShaderStageFlags::VERTEX,
            Self::Fragment => vk::ShaderStageFlags::FRAGMENT,
            Self::Compute => vk::ShaderStageFlags::COMPUTE,
        }
    }
}

/// SPIR-V as bytes in the binary; [`Shader::words`] reads them as words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words(pub(super) &'static [u8]);

/// A compiled shader.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// Path below `glsl/`.
    pub name: &'static str,
    /// Its stage.
    pub stage: Stage,
    spirv: Words,
    /// The same with ray queries in the place of walks over our own tree, of shaders that ask about rays.
    ray_queries: Option<Words>,
}

impl Shader {
    /// The SPIR-V words, of a shader that asks about rays with or without ray queries.
    #[must_use]
    pub fn words(&self, ray_queries: bool) -> Vec<u32> {
        let words = self.ray_queries.filter(|_| ray_queries).unwrap_or(self.spirv);
        bytemuck::pod_collect_to_vec(words.0)
    }

    /// Whether there are words without ray queries, and with them.
    pub fn kinds(&self) -> impl Iterator<Item = bool> + use<> {
        std::iter::once(false).chain(self.ray_queries.map(|_| true))
    }
}

/// One constant per file in `glsl/`.
pub mod shaders {
    use super::{Shader, Stage, Words};
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
