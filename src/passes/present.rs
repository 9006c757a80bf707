//! Subpass *present*: reads the HDR colour at its pixel; exposure, tone curve, encoding.

use super::gather::Gathered;
use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{
    Blend, Commands, Cull, DepthTest, GraphicsDescription, GraphicsPipeline, RenderPass, Specialization,
    Vertices, shaders,
};
use crate::scene::settings::{Encoding, Tonemap};
use crate::shared::{self, DrawConstants};

/// What is compiled into it.
#[derive(Clone, Copy, Debug)]
pub struct Looks {
    /// Tone curve.
    pub tonemap: Tonemap,
    /// Encoding of the picture.
    pub encoding: Encoding,
    /// Light of the frame that is gathered.
    pub gathered: Gathered,
}

/// The subpass's pipeline.
pub struct Present(GraphicsPipeline);

impl Present {
    /// Compiles tone curve and encoding in.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(
        inputs: &PassInputs<'_>,
        Looks { tonemap, encoding, gathered }: Looks,
        at: (&RenderPass, u32),
    ) -> Result<Self> {
        let curve = match tonemap {
            Tonemap::None => 0,
            Tonemap::Aces => 1,
            Tonemap::Agx => 2,
        };
        let mut specialization = Specialization::default()
            .with(shared::SPEC_TONEMAP, curve)
            .with(shared::SPEC_ENCODING, encoding as u32);
        if gathered.anything() {
            specialization = specialization.with_all(&gathered.kinds());
        }
        GraphicsPipeline::new(
            inputs.device,
            &inputs.scene.layout,
            &GraphicsDescription {
                name: "present",
                vertex: shaders::PRESENT_FULLSCREEN_VERT,
                fragment: Some(if gathered.anything() {
                    shaders::PRESENT_GATHERED_FRAG
                } else {
                    shaders::PRESENT_PRESENT_FRAG
                }),
                specialization: &specialization,
                vertices: Vertices::None,
                depth: DepthTest::Off,
                blend: Some(Blend::Replace),
                cull: Cull::None,
                pass: at.0,
                subpass: at.1,
            },
        )
        .map(Self)
    }

    /// Encodes the picture: the sum of samples times the first factor, and that of gathered light times the second.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>, [scale, gathered]: [f32; 2]) {
        cmd.bind_graphics(&self.0);
        cmd.bind_sets(shared::frame::SET, &[view.frame]);
        cmd.push(&DrawConstants { scale, gathered, ..DrawConstants::default() });
        cmd.draw_fullscreen();
    }
}
