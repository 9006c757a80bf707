//! How far the cuts of the picture last rendered are off: blocks of its pixels by their cuts, and by every light. Outside the
//! frame, only for reports.
//!
//! No model of the error is needed then, and none has to be believed: it holds for any lobe, order and place of the lights.

use super::sheet::{Sheet, sheet_pass};
use super::{PassInputs, SurfacePipelines, View};
use crate::error::Result;
use crate::gpu::{Blend, Commands, RenderPass, Use, shaders};
use crate::passes::direct::LIGHTS_PER_DRAW;
use crate::shared;
use crate::targets::Targets;

/// Pairs of pixel and light about, of those that are checked: half a second of one core.
const PAIRS: u64 = 1 << 26;
/// Pixels of them at least, so that the mean is known within some 10 %.
const LEAST_PIXELS: u64 = 1024;

/// The pass, its two pictures and their pipelines.
pub struct CutCheck {
    pass: RenderPass,
    pictures: [Sheet; 2],
    cut: SurfacePipelines,
    exact: SurfacePipelines,
}

impl CutCheck {
    /// Makes pictures and pipelines.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets) -> Result<Self> {
        let pass = sheet_pass(inputs, "cut check")?;
        let picture = || Sheet::new(inputs, targets, &pass, "cut check");
        let pictures = [picture()?, picture()?];
        let lights = inputs.scene.lights.lights.len() - inputs.scene.lights.ranged;
        let one_in = [(shared::SPEC_ONE_IN, one_in(targets.depth.size(), lights as u64))];
        let surfaces = |shader, extra: &[(u32, u32)]| {
            SurfacePipelines::new(inputs, shader, extra, Blend::Add, (&pass, 0))
        };
        let cut = surfaces(shaders::DIRECT_CUT_FRAG, &[])?;
        let exact = surfaces(shaders::DIRECT_UNRANGED_FRAG, &one_in)?;
        Ok(Self { pass, pictures, cut, exact })
    }

    /// Draws both pictures.
    pub fn record(&self, cmd: &mut Commands, view: &View<'_>) {
        let [cut, exact] = &self.pictures;
        let lights = &view.scene.lights;
        cmd.labelled("cut check", |cmd| {
            cmd.begin_pass(&self.pass, &cut.framebuffer);
            self.cut.draw(cmd, view, [0; 2]);
            cmd.end_pass();
            cmd.begin_pass(&self.pass, &exact.framebuffer);
            let end = lights.lights.len() as u32;
            for first in (lights.ranged as u32..end).step_by(LIGHTS_PER_DRAW as usize) {
                self.exact.draw(cmd, view, [first, end.min(first + LIGHTS_PER_DRAW)]);
            }
            cmd.end_pass();
        });
    }

    /// Mean over the values of the pixels checked of the relative error, that of the cuts over what the whole `picture` has
    /// there, 1 % of its mean at least.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn relative_error(&self, picture: &[[f32; 3]]) -> Result<f64> {
        let [cut, exact] = &self.pictures;
        let fetch = |sheet: &Sheet| -> Result<Vec<[f32; 4]>> {
            sheet.image.fetch(Use::TransferRead, Use::TransferRead)
        };
        let (cut, exact) = (fetch(cut)?, fetch(exact)?);
        let checked: Vec<usize> = (0..picture.len()).filter(|&pixel| exact[pixel][3] > 0.0).collect();
        let values = (3 * checked.len()).max(1) as f64;
        let values_of = || checked.iter().flat_map(|&pixel| (0..3).map(move |channel| (pixel, channel)));
        let mean = values_of().map(|(pixel, c)| f64::from(picture[pixel][c])).sum::<f64>() / values;
        let floor = (0.01 * mean).max(f64::MIN_POSITIVE);
        let errors = values_of().map(|(pixel, c)| {
            let off = f64::from(cut[pixel][c]) - f64::from(exact[pixel][c]);
            off.abs() / f64::from(picture[pixel][c]).max(floor)
        });
        Ok(errors.sum::<f64>() / values)
    }
}

/// Of how many blocks one is checked.
fn one_in([width, height]: [u32; 2], lights: u64) -> u32 {
    let pixels = u64::from(width) * u64::from(height);
    (pixels * lights).div_ceil(PAIRS).min(pixels / LEAST_PIXELS).max(1) as u32
}
