//! Compute: the many lights of each cluster, for what the surface image says of its pixels.
//!
//! 1. `gather`: for each variant, the clusters that have pixels of it, by how many.
//! 2. `many`: per variant and number of pixels an invocation, those lights; their light is added to the HDR image.
//!
//! The same shading as subpass *indirect*, which keeps the variants that this one cannot shade. A fetched light serves up
//! to four pixels, and triangles are drawn once.

use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, Commands, ComputePipeline, DescriptorSets, Device, Format, Image, ImageDescription,
    PipelineLayout, Shader, Specialization, Use, shaders,
};
use crate::gpu_scene::GpuScene;
use crate::shared::{self, MaterialRecord, ResolveDispatch, TILE_PIXELS};
use crate::targets::Targets;
use rayon::prelude::*;
use std::sync::Arc;

/// By pixels an invocation.
const MANY: [Shader; shared::RESOLVE_PIXELS as usize] = [
    shaders::RESOLVE_MANY_1_COMP,
    shaders::RESOLVE_MANY_2_COMP,
    shaders::RESOLVE_MANY_3_COMP,
    shaders::RESOLVE_MANY_4_COMP,
];

/// Pipelines of the pass, and what only they read.
pub struct Resolve {
    gather: ComputePipeline,
    // By variant, then by pixels an invocation.
    many: Vec<Vec<ComputePipeline>>,
    set: DescriptorSets,
    work: Buffer<u32>,
    materials: Image,
}

impl Resolve {
    /// Compiles the scene's variants, and makes room for the work of `clusters`; `folded` where some lists end in nodes of
    /// lights beyond the cap.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets, folded: bool, clusters: u32) -> Result<Self> {
        let &PassInputs { device, scene, .. } = inputs;
        let sets = [shared::frame::BINDINGS, shared::scene::BINDINGS, shared::resolve::BINDINGS];
        let layout = Arc::new(PipelineLayout::new(device, &sets)?);
        let lanes = inputs.lanes;
        let most = (TILE_PIXELS / lanes).min(shared::RESOLVE_PIXELS);
        let base = Specialization::default().with(shared::SPEC_LANES, lanes);
        let variants = scene.resolved.specializations.par_iter().enumerate();
        let many = variants.map(|(index, variant)| {
            let pipelines = (1..=most).map(|pixels| {
                let specialization = variant
                    .clone()
                    .with(shared::SPEC_PERSPECTIVE, u32::from(inputs.perspective))
                    .with(shared::SPEC_LANES, lanes)
                    .with(shared::SPEC_FOLDED, u32::from(folded))
                    .with(shared::SPEC_RESOLVED, index as u32);
                ComputePipeline::new(device, &layout, MANY[pixels as usize - 1], &specialization)
            });
            pipelines.collect::<Result<_>>()
        });
        let materials = material_records(device, &scene.records)?;
        let set = layout.allocate(shared::resolve::SET, 1)?;
        set.get(0).image(shared::resolve::RESOLVE_MATERIALS, &materials, Use::Texture);
        let resolve = Self {
            gather: ComputePipeline::new(device, &layout, shaders::RESOLVE_GATHER_COMP, &base)?,
            many: many.collect::<Result<_>>()?,
            set,
            work: work(device, scene, clusters)?,
            materials,
        };
        resolve.set.get(0).buffer(shared::resolve::RESOLVE_WORK, &resolve.work);
        resolve.resize(targets);
        Ok(resolve)
    }

    /// Binds another picture.
    pub fn resize(&self, targets: &Targets) {
        self.set.get(0).image(shared::resolve::RESOLVE_HDR, &targets.hdr, Use::ComputeWrite);
    }

    /// Takes other constants of the same materials.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn set_materials(&self, records: &[MaterialRecord]) -> Result<()> {
        upload_records(&self.materials, records)
    }

    /// Makes room for the work of more clusters.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn grow(&mut self, device: &Arc<Device>, scene: &GpuScene, clusters: u32) -> Result<()> {
        self.work = work(device, scene, clusters)?;
        self.set.get(0).buffer(shared::resolve::RESOLVE_WORK, &self.work);
        Ok(())
    }

    /// Adds every listed light.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        let sets = [view.frame, view.scene.set.get(0), self.set.get(0)];
        cmd.labelled("resolve", |cmd| {
            cmd.bind_compute(&self.gather, &sets);
            cmd.dispatch([self.many.len() as u32, 1, 1]);
            cmd.memory_barrier(Use::ComputeWrite, Use::IndirectRead);
            for (variant, pipelines) in self.many.iter().enumerate() {
                for (pixels, pipeline) in pipelines.iter().enumerate() {
                    let dispatch = variant * shared::RESOLVE_PIXELS as usize + pixels;
                    cmd.bind_compute(pipeline, &sets);
                    cmd.dispatch_indirect_at(&self.work, dispatch * size_of::<ResolveDispatch>());
                }
            }
        });
    }
}

/// Dispatches, then up to two entries of each cluster for every variant.
fn work(device: &Arc<Device>, scene: &GpuScene, clusters: u32) -> Result<Buffer<u32>> {
    let dispatches = (shared::RESOLVE_VARIANTS * shared::RESOLVE_PIXELS) as usize;
    let entries = scene.resolved.specializations.len() * 2 * clusters as usize;
    let words = dispatches * size_of::<ResolveDispatch>() / size_of::<u32>() + entries;
    Buffer::new(device, "resolve work", BufferUse::Storage, words)
}

/// The records as texels, a row of each.
fn material_records(device: &Arc<Device>, records: &[MaterialRecord]) -> Result<Image> {
    let across = 1 << shared::MATERIALS_PER_ROW_LOG2;
    let rows = records.len().div_ceil(across).max(1);
    let width = (across as u32) << shared::MATERIAL_RECORD_LOG2;
    let image = Image::new(
        device,
        &ImageDescription {
            name: "material records",
            format: Format::R32G32B32A32_SFLOAT,
            size: [width, rows as u32],
            layers: None,
            mips: 1,
            uses: &[Use::TransferWrite, Use::Texture],
        },
    )?;
    upload_records(&image, records)?;
    Ok(image)
}

/// The records, padded to whole rows of the image.
fn upload_records(image: &Image, records: &[MaterialRecord]) -> Result<()> {
    let mut texels = records.to_vec();
    let rows = image.size()[1] as usize;
    texels.resize(rows << shared::MATERIALS_PER_ROW_LOG2, MaterialRecord::default());
    image.upload(&[bytemuck::cast_slice::<_, [f32; 4]>(&texels)], Use::Texture)
}
