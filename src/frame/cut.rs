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
    /// Largest error, as a share of the light at the cluster.
    share: f32,
    /// Largest radius as seen from a pixel, of the scale on which the surface's narrowest lobe changes there.
    lobe: f32,
    /// Largest error where the horizon cuts nodes, as a share of a pixel's light.
    horizon: f32,
}

/// The limits that keep mean, tail and bias of the relative error within what `light_error` promises.
///
/// Calibrated on the scenes of `tests/render/cut.rs`, where the worst is: up to 0.01 the bias at horizons that cut nodes and
/// in lobes, both of one sign; above it the least opening, nearer than which no series converges.
pub(super) fn limits(light_error: f32) -> Limits {
    let e = |name: &str, d: f32| std::env::var(name).map_or(d, |v| v.parse().unwrap_or(d));
    Limits {
        open: (e("OPEN", 2.2) * (0.005 / light_error).powf(e("OPENP", 0.75))).max(e("OPENM", 1.2)),
        share: (e("SHARE2", 4.0) * light_error * light_error).min(e("SHARE1", 0.08) * light_error),
        lobe: (e("LOBE", 6.0) * light_error.sqrt()).min(1.2),
        horizon: e("HORIZON", 0.5) * light_error,
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
        constants.cut_dark = std::env::var("DARK").map_or(0.25, |v| v.parse().unwrap_or(0.25));
    }
}
