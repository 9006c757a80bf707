//! What is seen at a pixel.

use super::Frame;
use crate::error::Result;
use crate::gpu::Use;
use crate::shared::FrameConstants;
use glam::{DVec3, Vec3};

impl Frame {
    /// World position of the surface seen at a pixel of the picture last rendered, or `None` where there is none.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn position_at(&self, pixel: [u32; 2]) -> Result<Option<DVec3>> {
        if self.samples == 0 {
            return Ok(None);
        }
        let depth: f32 = self.targets.depth.fetch_texel(pixel, Use::DepthRead, Use::DepthRead)?;
        // Reversed: 0 is where nothing was drawn.
        let origin = self.scene.origin.as_dvec3();
        Ok((depth > 0.0).then(|| origin + position(&self.last, pixel, f64::from(depth))))
    }
}

/// About the device's origin.
fn position(constants: &FrameConstants, pixel: [u32; 2], depth: f64) -> DVec3 {
    let of = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let [x, y] = pixel.map(|at| f64::from(at) + 0.5);
    let v = constants.view_depth.map(f64::from);
    let z = (v[0] + v[1] * depth) / (v[2] + v[3] * depth);
    let c = constants;
    let origin = of(c.ray_origin) + x * of(c.ray_origin_dx) + y * of(c.ray_origin_dy);
    of(c.eye) + origin + z * (of(c.ray_direction) + x * of(c.ray_direction_dx) + y * of(c.ray_direction_dy))
}
