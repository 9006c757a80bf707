//! Output variables of the frame, again and again.

use super::{Frame, pass_inputs};
use crate::error::Result;
use crate::passes::aov::{Aov, Quantity};
#[cfg(feature = "viewer")]
use crate::passes::{develop::Develop, gather::Gathered, present::Looks};

impl Frame {
    /// Compiles the pass of one quantity, for [`Frame::draw_aov`]; it fits the frame until that changes its size.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn aov_pass(&self, quantity: Quantity) -> Result<Aov> {
        let inputs = pass_inputs(&self.device, &self.scene, &self.settings);
        Aov::new(&inputs, &self.targets, quantity)
    }

    /// Draws a quantity of the surface last rendered, without jitter if the picture had one sample.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn draw_aov(&self, aov: &Aov) -> Result<()> {
        self.device.run("aov", |cmd| {
            aov.record(cmd, &self.view());
            Ok(())
        })
    }

    /// Index of the material seen at a pixel of the picture last rendered: `None` where nothing is, `Some(None)` where a
    /// light is.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn material_at(&self, pixel: [u32; 2]) -> Result<Option<Option<u32>>> {
        let aov = self.aov_pass(Quantity::Material)?;
        self.draw_aov(&aov)?;
        let [index, .., there] = aov.texel(pixel)?;
        Ok((there > 0.0).then_some((index >= 0.0).then_some(index as u32)))
    }

    /// Compiles a pass that develops pictures from elsewhere as the frame's, for [`Frame::develop`].
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    #[cfg(feature = "viewer")]
    pub fn develop_pass(&self) -> Result<Develop> {
        let inputs = pass_inputs(&self.device, &self.scene, &self.settings);
        let looks = Looks { gathered: Gathered::default(), ..self.work.looks() };
        Develop::new(&inputs, looks, self.settings.size)
    }

    /// Develops a scene-linear picture, four numbers a pixel, times `scale`.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    #[cfg(feature = "viewer")]
    pub fn develop(&self, develop: &Develop, pixels: &[[f32; 4]], scale: f32) -> Result<()> {
        develop.develop(&self.view(), pixels, scale)
    }
}
