//! What can be read from a frame once it is rendered.

use super::{Frame, tiles, tiles_of};
use crate::error::Result;
use crate::gpu::{Image, Use};
use crate::image::HdrImage;
use crate::passes::PassInputs;
use crate::passes::aov::{Aov, Quantity};
use crate::passes::cluster::ClusterTargets;
use crate::passes::cut_check::CutCheck;
use crate::passes::floors::{FloorPass, Floors};
use crate::passes::pairs::{PairCount, PairPass};
use crate::shared::Counters;
use crate::targets::Targets;

impl Frame {
    /// The scene-linear picture.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn hdr(&self) -> Result<HdrImage> {
        let texels: Vec<[f32; 4]> = self.targets.hdr.fetch(Use::TransferRead, Use::TransferRead)?;
        let samples = self.samples.max(1) as f32;
        Ok(self.image(texels.iter().map(|&[r, g, b, _]| [r / samples, g / samples, b / samples]).collect()))
    }

    /// The display-referred picture, sRGB-encoded.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn ldr(&self) -> Result<Vec<[u8; 4]>> {
        self.targets.ldr.fetch(Use::TransferRead, Use::TransferRead)
    }

    /// The display-referred picture on the device, in use [`Use::TransferRead`].
    #[must_use]
    pub fn picture(&self) -> &Image {
        &self.targets.ldr
    }

    /// One quantity of the surface last rendered, without jitter if the picture had one sample.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn aov(&self, quantity: Quantity) -> Result<Vec<[f32; 4]>> {
        let inputs =
            PassInputs { device: &self.device, scene: &self.scene, perspective: self.settings.perspective };
        let aov = Aov::new(&inputs, &self.targets, quantity)?;
        self.device.run("aov", |cmd| {
            aov.record(cmd, &self.view());
            Ok(())
        })?;
        let mut values = aov.fetch()?;
        if quantity == Quantity::Position {
            let origin = self.scene.origin.to_array();
            // The fourth value is 1 where a surface is, and 0 elsewhere.
            values.iter_mut().for_each(|v| (0..3).for_each(|axis| v[axis] += v[3] * origin[axis]));
        }
        Ok(values)
    }

    /// Pairs of pixel and light in the picture last rendered.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn pairs(&self) -> Result<PairCount> {
        PairPass::new(&self.device, tiles(self.settings.size))?.count(
            &self.device,
            &self.scene,
            self.set.get(0),
            tiles_of(self.settings.size),
        )
    }

    /// What a pair of pixel and light costs at least on this device, over the lists of the picture last rendered; `None`
    /// where it had none.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn floors(&self) -> Result<Option<Floors>> {
        if self.cluster.is_none() {
            return Ok(None);
        }
        let pass = FloorPass::new(&self.device, tiles(self.settings.size))?;
        pass.measure(&self.scene, self.set.get(0), tiles_of(self.settings.size))
    }

    /// What the cluster pass counted for the last sample; zero where it was not needed.
    #[must_use]
    pub fn counters(&self) -> Counters {
        if self.cluster.is_some() { self.counters } else { Counters::default() }
    }

    /// Estimated mean relative error of the picture last rendered, for what nodes of the tree over lights without a range
    /// stood for: measured against every light at some of the pixels with a surface, or all of a small picture. 0 where every
    /// light that reaches a pixel is evaluated.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn light_error(&self) -> Result<f64> {
        if !self.work.cut {
            return Ok(0.0);
        }
        let inputs =
            PassInputs { device: &self.device, scene: &self.scene, perspective: self.settings.perspective };
        let check = CutCheck::new(&inputs, &self.targets)?;
        self.device.run("cut check", |cmd| {
            check.record(cmd, &self.view());
            Ok(())
        })?;
        check.relative_error(&self.hdr()?.pixels)
    }

    /// The cluster pass's results, for tests of the lists.
    #[must_use]
    pub fn cluster_targets(&self) -> (&Targets, &ClusterTargets) {
        (&self.targets, &self.lists)
    }

    /// Tiles across, tiles down, depth slices of the picture last rendered.
    #[must_use]
    pub fn grid(&self) -> [u32; 3] {
        let [x, y] = tiles_of(self.settings.size);
        [x, y, self.slices]
    }

    fn image(&self, pixels: Vec<[f32; 3]>) -> HdrImage {
        HdrImage { width: self.settings.size[0], height: self.settings.size[1], pixels }
    }
}
