//! A thin safe layer over `ash`: the only module with `unsafe`.
//!
//! What it promises: objects free themselves in `Drop`, buffers are typed, an image's aspect follows from its format, raw
//! handles do not leave this module. What it does not, as marking all of Vulkan `unsafe` would only be noise: that
//! whatever is recorded outlives the recording ([`Device::run`] submits and waits before it returns, so an object made
//! outside its closure does, and one made and dropped inside does not; pictures on their way to a window are held until they
//! have landed), and that layouts, bounds and hazards are right.
//! The validation layers check the latter in every GPU test.

mod allocation;
mod barrier;
mod buffer;
mod cache;
mod candidate;
mod command;
#[cfg(feature = "viewer")]
pub(crate) mod compile;
mod descriptor;
mod device;
#[cfg(feature = "viewer")]
mod flight;
mod image;
mod instance;
mod pipeline;
mod query;
mod ray_tree;
mod render_pass;
mod requirements;
mod sampler;
mod shader;
#[cfg(feature = "viewer")]
mod surface;
#[cfg(feature = "viewer")]
mod swapchain;

pub use barrier::Use;
pub use buffer::{Buffer, BufferUse};
pub use command::Commands;
pub use descriptor::{DescriptorSet, DescriptorSets, PipelineLayout, SetLayout};
pub use device::{Device, DeviceInfo, Options, Replaced};
pub use image::{Image, ImageDescription};
pub use pipeline::{
    Blend, ComputePipeline, Cull, DepthTest, GraphicsDescription, GraphicsPipeline, Specialization, Vertices,
};
pub use query::Timestamps;
pub use ray_tree::RayTree;
pub use render_pass::{Attachment, Framebuffer, Outside, RenderPass, Subpass};
pub use requirements::{Check, Report};
pub use sampler::Sampler;
pub use shader::{Shader, Stage, shaders};
#[cfg(feature = "viewer")]
pub use surface::WindowOptions;
#[cfg(feature = "viewer")]
pub use swapchain::{Shown, Swapchain};

pub(crate) use ash::vk::Format;

use crate::error::{Error, Result};
use ash::vk;

/// A failed call as an [`Error`].
fn failed(call: impl Into<String>, result: vk::Result) -> Error {
    let remedy = match result {
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
            "render a smaller picture or fewer lights, or free memory"
        }
        vk::Result::ERROR_DEVICE_LOST => {
            "render a smaller picture, fewer lights or with a larger light_error, which take the device less time at once; or update the driver, or choose another device with --device"
        }
        vk::Result::ERROR_FORMAT_NOT_SUPPORTED => "update the driver, or choose another device with --device",
        _ => "run again with --validate, and report what it says",
    };
    Error::Vulkan { call: call.into(), result: format!("{result:?}"), remedy: remedy.into() }
}

/// A request beyond what the device has, as an [`Error`]: to ask the driver nevertheless would be undefined.
fn too_large(what: &str, asked: &str, most: &str) -> Error {
    Error::Vulkan {
        call: what.into(),
        result: format!("{asked}, of which the device allows {most}"),
        remedy: "use a smaller picture, smaller textures or fewer lights, or another device with --device"
            .into(),
    }
}

/// Attaches the call's name to a raw result.
trait Called<T> {
    fn called(self, call: &str) -> Result<T>;
}

impl<T> Called<T> for Result<T, vk::Result> {
    fn called(self, call: &str) -> Result<T> {
        self.map_err(|result| failed(call, result))
    }
}
