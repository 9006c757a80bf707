//! The passes of a frame, one file each, paired with `glsl/<same name>/`.
//!
//! A pass is a struct with its pipelines, made once per scene (`new`), and a `record` that reads like the pass's own
//! list of commands. It emits barriers only between its own steps; those between passes stand in `frame.rs`.

pub mod aov;
pub mod cluster;
pub mod cut_check;
#[cfg(feature = "viewer")]
pub mod develop;
pub mod direct;
pub mod floors;
pub mod forward;
pub mod gather;
pub mod indirect;
mod luminaires;
pub mod order;
#[cfg(feature = "viewer")]
pub mod overlay;
pub mod pairs;
pub mod prepass;
pub mod present;
pub mod resolve;
mod sheet;
mod tally;

use crate::draws::VisibleDraw;
use crate::error::Result;
use crate::gpu::{
    Blend, Commands, DepthTest, DescriptorSet, Device, GraphicsDescription, GraphicsPipeline, RenderPass,
    Shader, Vertices, shaders,
};
use crate::gpu_scene::{GpuScene, Triangles};
use crate::shared::{self, DrawConstants};
use rayon::prelude::*;
use std::sync::Arc;

/// What every pass is made from.
pub struct PassInputs<'a> {
    /// Device.
    pub device: &'a Arc<Device>,
    /// Scene to draw.
    pub scene: &'a GpuScene,
    /// Perspective camera; orthographic otherwise.
    pub perspective: bool,
    /// Invocations of small workgroups.
    pub lanes: u32,
}

/// One pipeline per variant of the scene's materials, for a subpass that shades what the prepass left visible; none for
/// those that it leaves out.
pub struct SurfacePipelines(Vec<Option<GraphicsPipeline>>);

impl SurfacePipelines {
    fn new(
        inputs: &PassInputs<'_>,
        fragment: Shader,
        extra: &[(u32, u32)],
        blend: Blend,
        at: (&RenderPass, u32),
    ) -> Result<Self> {
        Self::of(inputs, fragment, extra, blend, at, |_| true)
    }

    /// Of the variants that `wanted` picks by their index.
    fn of(
        inputs: &PassInputs<'_>,
        fragment: Shader,
        extra: &[(u32, u32)],
        blend: Blend,
        (pass, subpass): (&RenderPass, u32),
        wanted: impl Fn(usize) -> bool + Sync,
    ) -> Result<Self> {
        let pipelines = inputs.scene.variants.par_iter().enumerate().map(|(index, variant)| {
            if !wanted(index) {
                return Ok(None);
            }
            let perspective = u32::from(inputs.perspective);
            let specialization =
                variant.specialization.clone().with(shared::SPEC_PERSPECTIVE, perspective).with_all(extra);
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: fragment.name,
                    vertex: shaders::PREPASS_SURFACE_VERT,
                    fragment: Some(fragment),
                    specialization: &specialization,
                    vertices: Vertices::Surface,
                    depth: DepthTest::Equal,
                    blend: Some(blend),
                    cull: variant.cull(),
                    pass,
                    subpass,
                },
            )
            .map(Some)
        });
        Ok(Self(pipelines.collect::<Result<_>>()?))
    }

    /// Draws the whole scene; `lights` is for the shaders that evaluate a range of lights.
    fn draw(&self, cmd: &mut Commands, view: &View<'_>, lights: [u32; 2]) {
        draw_scene(cmd, view, lights, |variant| self.0[variant].as_ref());
    }

    /// As [`SurfacePipelines::draw`], with the scene's triangles in another form.
    fn draw_of(&self, cmd: &mut Commands, view: &View<'_>, triangles: Triangles<'_>) {
        draw_triangles(cmd, view, [0; 2], triangles, |variant| self.0[variant].as_ref());
    }
}

/// What a frame draws: the scene, the part of it that is in view, and the frame's descriptors.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// Scene.
    pub scene: &'a GpuScene,
    /// What of it is in view.
    pub draws: &'a [VisibleDraw],
    /// Area lights that are seen and in view: variants by [`crate::gpu_scene::Luminaire`], materials are lights.
    pub luminaires: &'a [VisibleDraw],
    /// Set 0.
    pub frame: DescriptorSet<'a>,
}

/// Draws what is in view, each draw with the pipeline of its variant, if it has one.
fn draw_scene<'a>(
    cmd: &mut Commands,
    view: &View<'_>,
    lights: [u32; 2],
    pipeline: impl Fn(usize) -> Option<&'a GraphicsPipeline>,
) {
    draw_triangles(cmd, view, lights, view.scene.geometry(), pipeline);
}

fn draw_triangles<'a>(
    cmd: &mut Commands,
    view: &View<'_>,
    lights: [u32; 2],
    triangles: Triangles<'_>,
    pipeline: impl Fn(usize) -> Option<&'a GraphicsPipeline>,
) {
    let scene = view.scene;
    cmd.bind_triangles(triangles.vertices, triangles.triangles);
    let mut variant = None;
    let mut drawn = None;
    for draw in view.draws {
        let Some(pipeline) = pipeline(draw.variant) else { continue };
        if variant != Some(draw.variant) {
            cmd.bind_graphics(pipeline);
            if variant.is_none() {
                cmd.bind_sets(shared::frame::SET, &[view.frame, scene.set.get(0)]);
            }
            variant = Some(draw.variant);
        }
        if drawn != Some((draw.variant, draw.material)) {
            let surface = scene.resolved.word(draw.variant, draw.material);
            cmd.bind_sets(shared::material::SET, &[scene.materials.get(draw.material as usize)]);
            cmd.push(&DrawConstants { material: draw.material, lights, surface, ..DrawConstants::default() });
            drawn = Some((draw.variant, draw.material));
        }
        cmd.draw_triangles(draw.first, draw.count);
    }
}
