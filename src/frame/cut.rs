//! How fine the cuts of the tree over lights without a range are, by the error that the scene allows.

use crate::gpu_scene::moment_row;
use crate::light_tree::LightTree;
use crate::shared::FrameConstants;

/// Below it every light is evaluated: finer cuts would hold most of the lights.
pub(super) const LEAST_ERROR: f32 = 0.002;

/// What a node must keep to stand for its lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    /// Least distance from it, in its radii.
    open: f32,
    /// Largest error, as a share of the light at the cluster; of cuts of few nodes a quarter of it.
    share: f32,
    /// Largest radius as seen from a pixel, of the scale on which the surface's narrowest lobe changes there.
    lobe: f32,
    /// Largest error where the horizon cuts nodes, as a share of a pixel's irradiance.
    horizon: f32,
}

/// The limits that keep mean, tail and bias of the relative error within what `light_error` promises.
///
/// Calibrated on the scenes of `tests/render/cut.rs`, each for several seeds and turned in several ways, which changes the
/// order of the lights and with it the tree. The bias of few nodes far away is what binds, for all pixels share it; the 99th
/// percentile of matte surfaces stays below the `light_error` itself, because pixels look after their horizons. Above 0.01 the least opening
/// binds too, nearer than which no series converges. Metal and plastic of alpha 0.05 to 0.4 stay within half the
/// `light_error` in the mean and a sixth in bias.
pub(super) fn limits(light_error: f32) -> Limits {
    Limits {
        open: (2.2 * (0.005 / light_error).powf(0.75)).max(1.2),
        share: (5.0 * light_error * light_error).min(0.045 * light_error),
        lobe: (8.5 * light_error.sqrt()).min(1.7),
        horizon: light_error,
    }
}

impl Limits {
    /// Tells the shaders.
    pub(super) fn set(self, constants: &mut FrameConstants, lights: &LightTree) {
        // Without the null node behind them.
        constants.moment_nodes = lights.moments.len() as u32 - 1;
        constants.moment_row = moment_row(lights) as u32;
        constants.cut_open2 = self.open * self.open;
        constants.cut_share = self.share;
        constants.cut_lobe2 = self.lobe * self.lobe;
        constants.cut_horizon = self.horizon;
    }
}
