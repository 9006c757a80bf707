//! Area lights that are seen: their triangles, in the prepass and where something is drawn at its depth.

use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{
    Blend, Commands, Cull, DepthTest, GraphicsDescription, GraphicsPipeline, RenderPass, Shader,
    Specialization, Vertices, shaders,
};
use crate::gpu_scene::{Luminaire, Triangles};
use crate::shared::{self, DrawConstants};

/// Pipelines by [`Luminaire`].
pub(super) struct Luminaires([GraphicsPipeline; 2]);

impl Luminaires {
    /// Pipelines that draw what the prepass left visible of the lights.
    pub(super) fn new(
        inputs: &PassInputs<'_>,
        fragment: Shader,
        constants: &[(u32, u32)],
        blend: Blend,
        at: (&RenderPass, u32),
    ) -> Result<Self> {
        Self::with(inputs, Some(fragment), constants, (DepthTest::Equal, Some(blend)), at)
    }

    /// Pipelines that write the lights' depth, and with a `surface` image, that there is none.
    pub(super) fn prepass(inputs: &PassInputs<'_>, pass: &RenderPass, surface: bool) -> Result<Self> {
        let fragment = surface.then_some(shaders::PREPASS_LUMINAIRE_FRAG);
        let blend = surface.then_some(Blend::Replace);
        Self::with(inputs, fragment, &[], (DepthTest::WriteNearest, blend), (pass, 0))
    }

    fn with(
        inputs: &PassInputs<'_>,
        fragment: Option<Shader>,
        constants: &[(u32, u32)],
        (depth, blend): (DepthTest, Option<Blend>),
        (pass, subpass): (&RenderPass, u32),
    ) -> Result<Self> {
        let specialization = Specialization::default().with_all(constants);
        let pipeline = |cull| {
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: "luminaires",
                    vertex: shaders::PREPASS_SURFACE_VERT,
                    fragment,
                    specialization: &specialization,
                    vertices: Vertices::Surface,
                    depth,
                    blend,
                    cull,
                    pass,
                    subpass,
                },
            )
        };
        // A flat light has a back; the inside of a line is not there.
        Ok(Self([pipeline(Cull::None)?, pipeline(Cull::Back)?]))
    }

    /// Draws the lights in view, each with its index for the shader.
    pub(super) fn draw(&self, cmd: &mut Commands, view: &View<'_>) {
        self.draw_of(cmd, view, view.scene.geometry());
    }

    /// As [`Luminaires::draw`], with the scene's triangles in another form.
    pub(super) fn draw_of(&self, cmd: &mut Commands, view: &View<'_>, triangles: Triangles<'_>) {
        let scene = view.scene;
        cmd.bind_triangles(triangles.vertices, triangles.triangles);
        for kind in [Luminaire::Flat, Luminaire::Line] {
            let mut draws = view.luminaires.iter().filter(|draw| draw.variant == kind as usize).peekable();
            if draws.peek().is_some() {
                cmd.bind_graphics(&self.0[kind as usize]);
                cmd.bind_sets(shared::frame::SET, &[view.frame, scene.set.get(0)]);
            }
            for draw in draws {
                let lights = [draw.material, draw.material + 1];
                cmd.push(&DrawConstants { lights, ..DrawConstants::default() });
                cmd.draw_triangles(draw.first, draw.count);
            }
        }
    }
}
