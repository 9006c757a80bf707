//! Timestamps around named passes.

use super::device::Device;
use super::{Called, Commands};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;

/// Room for `count` timestamps, where the device has them.
pub struct Timestamps {
    // `None` on a queue without timestamps: every reading is then `None`.
    pool: Option<vk::QueryPool>,
    count: u32,
    device: Arc<Device>,
}

impl Timestamps {
    /// Makes room.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, count: u32) -> Result<Self> {
        let pool = if device.timestamp_bits == 0 {
            None
        } else {
            let info = vk::QueryPoolCreateInfo::default()
                .query_type(vk::QueryType::TIMESTAMP)
                .query_count(count.max(1));
            // SAFETY: the count is not 0.
            Some(unsafe { device.raw.create_query_pool(&info, None) }.called("vkCreateQueryPool")?)
        };
        Ok(Self { pool, count, device: device.clone() })
    }

    /// Milliseconds between neighbouring timestamps of finished work; `None` where the device has none.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn intervals(&self) -> Result<Option<Vec<f64>>> {
        let Some(pool) = self.pool else {
            return Ok(None);
        };
        let mut ticks = vec![0_u64; self.count as usize];
        // SAFETY: every query of the pool was written by the work just waited for.
        unsafe {
            self.device.raw.get_query_pool_results(
                pool,
                0,
                &mut ticks,
                vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT,
            )
        }
        .called("vkGetQueryPoolResults")?;
        let mask = u64::MAX >> (64 - self.device.timestamp_bits.clamp(1, 64));
        let period = f64::from(self.device.limits.timestamp_period) * 1e-6;
        Ok(Some(
            ticks.windows(2).map(|pair| (pair[1].wrapping_sub(pair[0]) & mask) as f64 * period).collect(),
        ))
    }
}

impl Drop for Timestamps {
    fn drop(&mut self) {
        if let Some(pool) = self.pool {
            // SAFETY: no work is pending outside `Device::run`.
            unsafe { self.device.raw.destroy_query_pool(pool, None) };
        }
    }
}

impl Commands {
    /// Makes all timestamps writable again; outside render passes.
    pub fn reset_timestamps(&mut self, timestamps: &Timestamps) {
        if let Some(pool) = timestamps.pool {
            // SAFETY: the range is the whole pool.
            unsafe { self.device.raw.cmd_reset_query_pool(self.raw, pool, 0, timestamps.count) };
        }
    }

    /// Writes timestamp `index` once everything before it has finished.
    pub fn timestamp(&mut self, timestamps: &Timestamps, index: u32) {
        if let Some(pool) = timestamps.pool {
            // SAFETY: the index is below the count; out of range is a validation error.
            unsafe {
                self.device.raw.cmd_write_timestamp(
                    self.raw,
                    vk::PipelineStageFlags::BOTTOM_OF_PIPE,
                    pool,
                    index,
                );
            };
        }
    }
}
