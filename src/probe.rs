//! Calls a function of the shaders' library for rows of inputs: how tests reach the GLSL that ships.

use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, ComputePipeline, DescriptorSet, Device, PipelineLayout, Shader, Specialization, Use,
};
use crate::shared::{self, LINEAR_GROUP};
use bytemuck::Pod;
use std::sync::Arc;

/// Runs a probe shader over `rows`; it writes one `Out` per row.
///
/// # Errors
/// [`crate::Error::Vulkan`] from the driver.
pub fn run<In: Pod, Out: Pod>(
    device: &Arc<Device>,
    shader: Shader,
    specialization: &Specialization,
    rows: &[In],
) -> Result<Vec<Out>> {
    run_among(device, shader, specialization, &|_| (), rows)
}

/// As [`run`], for a shader that also sees what `bind` puts into a scene's set.
///
/// # Errors
/// As [`run`].
pub fn run_among<In: Pod, Out: Pod>(
    device: &Arc<Device>,
    shader: Shader,
    specialization: &Specialization,
    bind: &dyn Fn(DescriptorSet<'_>),
    rows: &[In],
) -> Result<Vec<Out>> {
    let layout = PipelineLayout::new(device, &[shared::probe::BINDINGS, shared::scene::BINDINGS])?;
    let layout = Arc::new(layout);
    let scene = layout.allocate(shared::scene::SET, 1)?;
    bind(scene.get(0));
    let pipeline = ComputePipeline::new(device, &layout, shader, specialization)?;
    let input = Buffer::with(device, "probe rows", BufferUse::Storage, rows)?;
    let output = Buffer::<Out>::new(device, "probe results", BufferUse::Storage, rows.len())?;
    let sets = layout.allocate(shared::probe::SET, 1)?;
    sets.get(0).buffer(shared::probe::PROBE_IN, &input);
    sets.get(0).buffer(shared::probe::PROBE_OUT, &output);
    device.run("probe", |cmd| {
        cmd.bind_compute(&pipeline, &[sets.get(0), scene.get(0)]);
        cmd.dispatch([(rows.len() as u32).div_ceil(LINEAR_GROUP), 1, 1]);
        Ok(())
    })?;
    output.fetch(Use::ComputeWrite)
}
