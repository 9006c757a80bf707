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
}

impl Shader {
    /// The SPIR-V words.
    #[must_use]
    pub fn words(&self) -> Vec<u32> {
        bytemuck::pod_collect_to_vec(self.spirv.0)
    }
}

/// One constant per file in `glsl/`.
pub mod shaders {
    use super::{Shader, Stage, Words};
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
