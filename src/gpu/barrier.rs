//! How a resource is used, in words: the one table from a use to stage, access and layout.

use ash::vk;

/// A use of a buffer or image. A barrier states the use before and the use after.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// Contents are not needed.
    Nothing,
    /// Copied to, or cleared.
    TransferWrite,
    /// Copied from.
    TransferRead,
    /// Read by the host after the work has finished.
    HostRead,
    /// Written, or read and written, by a compute shader.
    ComputeWrite,
    /// Buffer or storage image read by a compute shader.
    ComputeRead,
    /// Dispatch arguments.
    IndirectRead,
    /// Buffer or storage image read by a fragment shader.
    FragmentRead,
    /// Texture sampled by a fragment shader.
    Texture,
    /// Storage image that fragment and compute shaders read.
    StorageRead,
    /// Depth attachment, tested and written.
    DepthWrite,
    /// Depth attachment tested only.
    DepthTest,
    /// Depth attachment tested only, and texture of a compute shader.
    DepthRead,
    /// Colour attachment, blended.
    ColorWrite,
    /// Colour attachment that a fragment shader reads as its input.
    InputRead,
    /// A ray tree, built, then asked.
    RayTree,
    /// Image of a window, free to be copied to.
    Acquired,
    /// Shown in a window.
    Present,
}

impl Use {
    /// Stage, access and image layout of the use.
    pub(super) const fn scope(self) -> (vk::PipelineStageFlags, vk::AccessFlags, vk::ImageLayout) {
        use vk::{AccessFlags as A, ImageLayout as L, PipelineStageFlags as S};
        const DEPTH_TESTS: S =
            S::from_raw(S::EARLY_FRAGMENT_TESTS.as_raw() | S::LATE_FRAGMENT_TESTS.as_raw());
        const SHADING: S = S::from_raw(S::FRAGMENT_SHADER.as_raw() | S::COMPUTE_SHADER.as_raw());
        match self {
            Self::Nothing => (S::TOP_OF_PIPE, A::empty(), L::UNDEFINED),
            Self::TransferWrite => (S::TRANSFER, A::TRANSFER_WRITE, L::TRANSFER_DST_OPTIMAL),
            Self::TransferRead => (S::TRANSFER, A::TRANSFER_READ, L::TRANSFER_SRC_OPTIMAL),
            Self::HostRead => (S::HOST, A::HOST_READ, L::GENERAL),
            Self::ComputeWrite => (
                S::COMPUTE_SHADER,
                A::from_raw(A::SHADER_READ.as_raw() | A::SHADER_WRITE.as_raw()),
                L::GENERAL,
            ),
            Self::ComputeRead => (S::COMPUTE_SHADER, A::SHADER_READ, L::GENERAL),
            Self::IndirectRead => (
                S::from_raw(S::DRAW_INDIRECT.as_raw() | S::COMPUTE_SHADER.as_raw()),
                A::from_raw(A::INDIRECT_COMMAND_READ.as_raw() | A::SHADER_READ.as_raw()),
                L::UNDEFINED,
            ),
            // GENERAL: the same images are written as storage images each frame.
            Self::FragmentRead => (S::FRAGMENT_SHADER, A::SHADER_READ, L::GENERAL),
            Self::Texture => (SHADING, A::SHADER_READ, L::SHADER_READ_ONLY_OPTIMAL),
            Self::StorageRead => (SHADING, A::SHADER_READ, L::GENERAL),
            Self::DepthWrite => (
                DEPTH_TESTS,
                A::from_raw(
                    A::DEPTH_STENCIL_ATTACHMENT_READ.as_raw() | A::DEPTH_STENCIL_ATTACHMENT_WRITE.as_raw(),
                ),
                L::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            ),
            Self::DepthTest => {
                (DEPTH_TESTS, A::DEPTH_STENCIL_ATTACHMENT_READ, L::DEPTH_STENCIL_READ_ONLY_OPTIMAL)
            }
            Self::DepthRead => (
                S::from_raw(DEPTH_TESTS.as_raw() | S::COMPUTE_SHADER.as_raw()),
                A::from_raw(A::DEPTH_STENCIL_ATTACHMENT_READ.as_raw() | A::SHADER_READ.as_raw()),
                L::DEPTH_STENCIL_READ_ONLY_OPTIMAL,
            ),
            Self::ColorWrite => (
                S::COLOR_ATTACHMENT_OUTPUT,
                A::from_raw(A::COLOR_ATTACHMENT_READ.as_raw() | A::COLOR_ATTACHMENT_WRITE.as_raw()),
                L::COLOR_ATTACHMENT_OPTIMAL,
            ),
            // What is only read is stored again when the pass ends, and that counts as a write.
            Self::InputRead => (
                S::from_raw(S::FRAGMENT_SHADER.as_raw() | S::COLOR_ATTACHMENT_OUTPUT.as_raw()),
                A::from_raw(A::INPUT_ATTACHMENT_READ.as_raw() | A::COLOR_ATTACHMENT_WRITE.as_raw()),
                L::SHADER_READ_ONLY_OPTIMAL,
            ),
            Self::RayTree => (
                S::from_raw(S::ACCELERATION_STRUCTURE_BUILD_KHR.as_raw() | SHADING.as_raw()),
                A::from_raw(
                    A::ACCELERATION_STRUCTURE_READ_KHR.as_raw()
                        | A::ACCELERATION_STRUCTURE_WRITE_KHR.as_raw(),
                ),
                L::UNDEFINED,
            ),
            // The stage at which the copy waits for the window.
            Self::Acquired => (S::TRANSFER, A::empty(), L::UNDEFINED),
            // Presenting synchronises by itself.
            Self::Present => (S::BOTTOM_OF_PIPE, A::empty(), L::PRESENT_SRC_KHR),
        }
    }

    /// The layout an image has in this use.
    pub(super) const fn layout(self) -> vk::ImageLayout {
        self.scope().2
    }
}

/// A memory barrier over all buffers: `before` happens, then `after` sees it.
pub(super) fn memory(before: Use, after: Use) -> vk::MemoryBarrier<'static> {
    vk::MemoryBarrier::default().src_access_mask(before.scope().1).dst_access_mask(after.scope().1)
}
