//! Subpass *direct*: the background, lights that are seen, area lights, and point lights without a range.
//!
//! The latter reach everything, so a list would only repeat them: few are evaluated one by one, many through a cut of
//! their tree for each cluster. Of many area lights, masks say which reach a cluster.

use super::forward::Work;
use super::luminaires::Luminaires;
use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{
    Blend, Commands, Cull, DepthTest, GraphicsDescription, GraphicsPipeline, RenderPass, Specialization,
    Vertices, shaders,
};
use crate::shared;
use std::ops::Range;

/// Lights of one draw; the draws of a surface add up. lavapipe ends a shader's loops, without a word, after 65,535
/// iterations, and a GPU's watchdog ends draws that last seconds.
pub(super) const LIGHTS_PER_DRAW: u32 = 1 << 15;

/// Pipelines of the subpass; absent where the scene has no use for them.
pub struct Direct {
    unranged: Option<SurfacePipelines>,
    cut: Option<SurfacePipelines>,
    area: Option<SurfacePipelines>,
    luminaires: Option<Luminaires>,
    background: Option<GraphicsPipeline>,
    work: Work,
}

impl Direct {
    /// Makes what the scene needs.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, work: Work, at: (&RenderPass, u32)) -> Result<Self> {
        let unranged = || SurfacePipelines::new(inputs, shaders::DIRECT_UNRANGED_FRAG, &[], Blend::Add, at);
        let cut = || SurfacePipelines::new(inputs, shaders::DIRECT_CUT_FRAG, &[], Blend::Add, at);
        let area = || {
            let masks = [(shared::SPEC_LIGHT_MASKS, u32::from(work.masks))];
            let (area, rays) = (&inputs.scene.area.specialization, &inputs.scene.occluders.specialization);
            let extra = [&area[..], rays, &masks].concat();
            SurfacePipelines::new(inputs, shaders::DIRECT_AREA_FRAG, &extra, Blend::Add, at)
        };
        let luminaires = || {
            let extra = &inputs.scene.area.specialization;
            Luminaires::new(inputs, shaders::DIRECT_LUMINAIRE_FRAG, extra, Blend::Add, at)
        };
        let background = || {
            GraphicsPipeline::new(
                inputs.device,
                &inputs.scene.layout,
                &GraphicsDescription {
                    name: "background",
                    vertex: shaders::PRESENT_FULLSCREEN_VERT,
                    fragment: Some(shaders::DIRECT_BACKGROUND_FRAG),
                    specialization: &Specialization::default(),
                    vertices: Vertices::None,
                    // The triangle lies at depth 0: it passes where the prepass left none.
                    depth: DepthTest::Equal,
                    blend: Some(Blend::Add),
                    cull: Cull::None,
                    pass: at.0,
                    subpass: at.1,
                },
            )
        };
        Ok(Self {
            unranged: work.unranged.then(unranged).transpose()?,
            cut: work.cut.then(cut).transpose()?,
            area: (work.area > 0).then(area).transpose()?,
            luminaires: work.luminaires.then(luminaires).transpose()?,
            background: work.background.then(background).transpose()?,
            work,
        })
    }

    /// Draws background, luminaires and area lights, and unranged lights where `points` are wanted.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>, points: bool) {
        let count = view.scene.lights.lights.len() as u32;
        if let Some(background) = &self.background {
            cmd.bind_graphics(background);
            cmd.bind_sets(shared::frame::SET, &[view.frame]);
            cmd.draw_fullscreen();
        }
        if let Some(luminaires) = &self.luminaires {
            luminaires.draw(cmd, view);
        }
        if let Some(cut) = self.cut.as_ref().filter(|_| points) {
            cut.draw(cmd, view, [0; 2]);
        }
        let mut draw = |pipelines: &SurfacePipelines, lights: Range<u32>, most: u32| {
            for first in lights.clone().step_by(most as usize) {
                pipelines.draw(cmd, view, [first, lights.end.min(first + most)]);
            }
        };
        if let Some(area) = &self.area {
            draw(area, 0..self.work.area, view.scene.area.per_draw);
        }
        if let Some(unranged) = self.unranged.as_ref().filter(|_| points) {
            draw(unranged, self.work.first_unranged..count, LIGHTS_PER_DRAW);
        }
    }
}
