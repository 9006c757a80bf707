//! Arbitrary output variables: one quantity of the visible surface per pixel, in an image of its own.
//!
//! Recorded only when asked for, after the frame, against the frame's depth. A light that is seen has a position, a
//! normal turned to the viewer, the material −1, no lights and no colour; clusters, and what is estimated of them, it has none.

mod corners;

use super::luminaires::Luminaires;
use super::sheet::{Sheet, sheet_pass};
use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{Blend, Commands, Framebuffer, Image, RenderPass, Use, shaders};
use crate::shared;
use crate::targets::Targets;
use corners::Corners;

/// What the variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Quantity {
    /// World position.
    Position = shared::AOV_POSITION,
    /// Shading normal, turned to the viewer.
    Normal = shared::AOV_NORMAL,
    /// Index of the material.
    Material = shared::AOV_MATERIAL,
    /// Lights evaluated.
    LightCount = shared::AOV_LIGHT_COUNT,
    /// Number of the cluster; −1 without.
    Cluster = shared::AOV_CLUSTER,
    /// Depth slice.
    Slice = shared::AOV_SLICE,
    /// Lights of the list that are evaluated, over those within range; then both. 1 where no light is within range.
    PairRatio = shared::AOV_PAIR_RATIO,
    /// Lights of the pixel's cluster for which nodes stand: beyond the list's cap; then those of the list.
    Folded = shared::AOV_FOLDED,
    /// Estimated relative error of the pixel's cluster, from folded lists and cuts.
    LightError = shared::AOV_LIGHT_ERROR,
    /// Colour of the material: what its diffuse part reflects; of metal, what it reflects at normal incidence.
    Albedo = shared::AOV_ALBEDO,
    /// Alpha of the specular lobe: its mean over the axes, then along tangent and bitangent. 1 where there is no such lobe.
    Roughness = shared::AOV_ROUGHNESS,
    /// Distance along the view, metres.
    Depth = shared::AOV_DEPTH,
    /// How far the transformed cosine of the specular lobe is from it at most, in total variation, as a share of the lobe:
    /// what area lights' closed form may be off by, and quadrature may not. 0 without such a lobe or an area light.
    LtcBound = shared::AOV_LTC_BOUND,
    /// Distance to the nearest edge of the triangle that is seen, pixels: exact at the edge, to first order beside it.
    Wireframe = shared::AOV_WIREFRAME,
    /// How often the pixel is shaded.
    Coverage = shared::AOV_COVERAGE,
}

/// One variable's pass.
pub struct Aov {
    pass: RenderPass,
    framebuffer: Framebuffer,
    pipelines: SurfacePipelines,
    luminaires: Option<Luminaires>,
    /// In the place of the scene's vertices.
    corners: Option<Corners>,
    image: Image,
}

impl Aov {
    /// Makes image, pass and pipelines.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets, quantity: Quantity) -> Result<Self> {
        let pass = sheet_pass(inputs, "aov")?;
        let Sheet { framebuffer, image } = Sheet::new(inputs, targets, &pass, "aov")?;
        let blend = if quantity == Quantity::Coverage { Blend::Add } else { Blend::Replace };
        let extra = [(shared::SPEC_AOV, quantity as u32)];
        let pipelines = SurfacePipelines::new(inputs, shaders::AOV_AOV_FRAG, &extra, blend, (&pass, 0))?;
        let seen = !inputs.scene.area.luminaires.is_empty();
        let luminaires = || Luminaires::new(inputs, shaders::AOV_LUMINAIRE_FRAG, &extra, blend, (&pass, 0));
        let luminaires = seen.then(luminaires).transpose()?;
        let edges = quantity == Quantity::Wireframe;
        let corners = edges.then(|| Corners::new(inputs.device, inputs.scene)).transpose()?;
        Ok(Self { pass, framebuffer, pipelines, luminaires, corners, image })
    }

    /// Draws the variable.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        cmd.labelled("aov", |cmd| {
            cmd.begin_pass(&self.pass, &self.framebuffer);
            let triangles = match &self.corners {
                Some(corners) => corners.triangles(),
                None => view.scene.geometry(),
            };
            self.pipelines.draw_of(cmd, view, triangles);
            if let Some(luminaires) = &self.luminaires {
                luminaires.draw_of(cmd, view, triangles);
            }
            cmd.end_pass();
        });
    }

    /// The values, four a pixel; the fourth is 1 where a surface is.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn fetch(&self) -> Result<Vec<[f32; 4]>> {
        self.image.fetch(Use::TransferRead, Use::TransferRead)
    }

    /// The values at a pixel.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn texel(&self, pixel: [u32; 2]) -> Result<[f32; 4]> {
        self.image.fetch_texel(pixel, Use::TransferRead, Use::TransferRead)
    }
}
