//! What can be read from a frame once it is rendered.

use super::{Frame, FrameSettings, encoded, pass_inputs, tiles, tiles_of};
use crate::error::Result;
use crate::gpu::{Image, Use};
use crate::image::HdrImage;
use crate::passes::aov::Quantity;
use crate::passes::cluster::ClusterTargets;
use crate::passes::cut_check::CutCheck;
use crate::passes::floors::{FloorPass, Floors};
use crate::passes::pairs::{PairCount, PairPass};
use crate::shared::Counters;
use crate::targets::Targets;
use std::sync::Arc;

impl Frame {
    /// The scene-linear picture.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn hdr(&self) -> Result<HdrImage> {
        self.picture_of(self.gathered_light()?.as_ref())
    }

    /// The picture with that of gathered light.
    pub(super) fn picture_of(&self, gathered: Option<&[HdrImage; 2]>) -> Result<HdrImage> {
        let texels: Vec<[f32; 4]> = self.targets.hdr.fetch(Use::TransferRead, Use::TransferRead)?;
        let samples = self.samples.max(1) as f32;
        let shaded =
            self.image(texels.iter().map(|&[r, g, b, _]| [r / samples, g / samples, b / samples]).collect());
        let Some([indirect, points]) = gathered else { return Ok(shaded) };
        let mut picture = shaded.plus(indirect).plus(points);
        // See glsl/present/gathered.frag.
        picture.pixels.iter_mut().flatten().for_each(|value| *value = value.max(0.0));
        Ok(picture)
    }

    /// The display-referred picture, sRGB-encoded.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn ldr(&self) -> Result<Vec<[u8; 4]>> {
        encoded::fetch_srgb(&self.targets.ldr, self.settings.encoding)
    }

    /// The display-referred picture on the device, in use [`Use::TransferRead`].
    #[must_use]
    pub fn picture(&self) -> &Arc<Image> {
        &self.targets.ldr
    }

    /// Samples that the picture has.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// What the frame was made for.
    #[must_use]
    pub fn settings(&self) -> &FrameSettings {
        &self.settings
    }

    /// One quantity of the surface last rendered, without jitter if the picture had one sample.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn aov(&self, quantity: Quantity) -> Result<Vec<[f32; 4]>> {
        let aov = self.aov_pass(quantity)?;
        self.draw_aov(&aov)?;
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

    /// Estimated mean relative error of the picture last rendered, over the pixels with a surface: of folded lists, as the
    /// clusters note it; for what nodes of the tree over lights without a range stood for, measured against every light at
    /// some of the pixels, or all of a small picture. 0 where every light that reaches a pixel is evaluated.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn light_error(&self) -> Result<f64> {
        if !self.has_points() || !self.work.cut && !self.work.folded {
            return Ok(0.0);
        }
        Ok(self.fold_error()? + self.cut_error()?)
    }

    fn fold_error(&self) -> Result<f64> {
        if !self.work.folded {
            return Ok(0.0);
        }
        let clusters = self.lists.clusters.fetch(Use::ComputeWrite)?;
        let occupied = &clusters[..clusters.len().min(self.counters.clusters as usize)];
        let pixels: f64 = occupied.iter().map(|cluster| f64::from(cluster.pixel_count)).sum();
        let errors = occupied.iter().map(|cluster| f64::from(cluster.pixel_count) * f64::from(cluster.error));
        Ok(errors.sum::<f64>() / pixels.max(1.0))
    }

    fn cut_error(&self) -> Result<f64> {
        if !self.work.cut {
            return Ok(0.0);
        }
        let inputs = pass_inputs(&self.device, &self.scene, &self.settings);
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

    pub(super) fn image(&self, pixels: Vec<[f32; 3]>) -> HdrImage {
        HdrImage { width: self.settings.size[0], height: self.settings.size[1], pixels }
    }
}
