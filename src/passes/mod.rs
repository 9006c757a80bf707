//! The passes of a frame, one file each, paired with `glsl/<same name>/`.
//!
//! A pass is a struct with its pipelines, made once per scene (`new`), and a `record` that reads like the pass's own
//! list of commands. It emits barriers only between its own steps; those between passes stand in `frame.rs`.

pub mod aov;
pub mod cluster;
pub mod direct;
pub mod forward;
pub mod indirect;
pub mod pairs;
pub mod prepass;
pub mod present;

use crate::error::Result;
use crate::gpu::{
    Blend, Commands, DepthTest, DescriptorSet, Device, GraphicsDescription, GraphicsPipeline,
    RenderPass, Shader, shaders,
};
use crate::gpu_scene::GpuScene;
use crate::shared::{self, DrawConstants};
use std::sync::Arc;

/// What every pass is made from.
pub struct PassInputs<'a> {
    /// Device.
    pub device: &'a Arc<Device>,
    /// Scene to draw.
    pub scene: &'a GpuScene,
    /// Perspective camera; orthographic otherwise.
    pub perspective: bool,
}

/// One pipeline per variant of the scene's materials, for a subpass that shades what the prepass left visible.
pub struct SurfacePipelines(Vec<GraphicsPipeline>);

impl SurfacePipelines {
    fn new(
        inputs: &PassInputs<'_>,
        fragment: Shader,
        extra: &[(u32, u32)],
        blend: Blend,
        (pass, subpass): (&RenderPass, u32),
    ) -> Result<Self> {
        let pipelines = inputs.scene.variants.iter().map(|variant| {
            let mut specialization = variant
                .specialization
                .clone()
                .with(shared::SPEC_PERSPECTIVE, u32::from(inputs.perspective));
            for &(id, value) in extra {
                specialization = specialization.with(id, value);
            }
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: fragment.name,
                    vertex: shaders::PREPASS_SURFACE_VERT,
                    fragment: Some(fragment),
                    specialization: &specialization,
                    vertices: true,
                    depth: DepthTest::Equal,
                    blend: Some(blend),
                    cull: variant.cull(),
                    pass,
                    subpass,
                },
            )
        });
        Ok(Self(pipelines.collect::<Result<_>>()?))
    }

    /// Draws the whole scene; `lights` is for the shaders that evaluate a range of lights.
    fn draw(
        &self,
        cmd: &mut Commands,
        scene: &GpuScene,
        frame: DescriptorSet<'_>,
        lights: [u32; 2],
    ) {
        draw_scene(cmd, scene, frame, lights, |variant| &self.0[variant]);
    }
}

/// Draws the scene, each draw with the pipeline of its variant.
fn draw_scene<'a>(
    cmd: &mut Commands,
    scene: &GpuScene,
    frame: DescriptorSet<'_>,
    lights: [u32; 2],
    pipeline: impl Fn(usize) -> &'a GraphicsPipeline,
) {
    cmd.bind_triangles(&scene.vertices, &scene.triangles);
    let mut bound = None;
    for draw in &scene.draws {
        if bound != Some(draw.variant) {
            cmd.bind_graphics(pipeline(draw.variant));
            if bound.is_none() {
                cmd.bind_sets(shared::frame::SET, &[frame, scene.set.get(0)]);
            }
            bound = Some(draw.variant);
        }
        cmd.bind_sets(
            shared::material::SET,
            &[scene.materials.get(draw.material as usize)],
        );
        cmd.push(&DrawConstants {
            material: draw.material,
            scale: 0.0,
            lights,
        });
        cmd.draw_triangles(draw.first, draw.count);
    }
}
