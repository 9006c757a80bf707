//! What shaders know of a frame.

use super::{Frame, FrameInputs, FrameSettings, cut};
use crate::camera_constants::camera_constants;
use crate::draws::visible;
use crate::error::Result;
use crate::shared;

impl Frame {
    /// Writes them for a sample, and finds out what of the scene is in view.
    pub(super) fn update_constants(&mut self, inputs: &FrameInputs<'_>, sample: u32) -> Result<()> {
        let jitter = jitter(sample, inputs.samples);
        let origin = self.scene.origin.as_dvec3();
        let mut camera = inputs.camera.clone();
        camera.position -= origin;
        camera.target -= origin;
        let range = self.scene.median_range;
        let FrameSettings { size, clusters, .. } = self.settings;
        let mut constants = camera_constants(&camera, size, jitter, self.scene.bounds, range, clusters);
        // N samples share a pixel, so each filters its textures over an N-th of it.
        constants.sample_index = sample;
        constants.light_error = self.settings.light_error;
        constants.texture_bias = -0.5 * (inputs.samples as f32).log2();
        constants.light_count = self.scene.lights.lights.len() as u32;
        constants.direct_begin = if self.settings.brute_force { 0 } else { self.scene.lights.ranged as u32 };
        constants.top_nodes = self.scene.lights.top_nodes();
        constants.max_list = self.settings.max_lights_per_cluster;
        constants.cluster_capacity = self.lists.capacity.clusters;
        constants.parent_capacity = self.lists.capacity.parents;
        [constants.parent_texels, constants.sibling_texels, constants.list_texels] =
            self.lists.capacity.first_texels().map(|texel| texel as u32);
        constants.list_capacity = self.lists.capacity.texels;
        constants.fold_nodes = if self.work.folded { shared::FOLD_NODES } else { 0 };
        constants.area_lights = self.scene.area.count;
        constants.area_texels = self.lists.capacity.mask;
        if self.work.cut {
            cut::limits(self.settings.light_error).set(&mut constants, &self.scene.lights);
        }
        constants.background = self.settings.background;
        self.slices = constants.slice_count;
        self.draws = visible(&self.scene.draws, &constants);
        self.luminaires = visible(&self.scene.area.luminaires, &constants);
        self.last = constants;
        self.constants.write(&[constants])
    }
}

/// Offset of a sample from its pixel's centre: the R2 sequence (Roberts 2018), starting at the centre.
fn jitter(index: u32, samples: u32) -> [f64; 2] {
    if samples == 1 {
        return [0.0; 2];
    }
    // Powers of the inverse of the plastic number.
    [0.754_877_666_246_692_8, 0.569_840_290_998_053_2]
        .map(|alpha| (0.5 + alpha * f64::from(index)).fract() - 0.5)
}
