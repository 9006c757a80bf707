//! The order of lights made on the host, which frames have, and on the device, beside one another.

use super::super::super::measure::Figure;
use crate::error::Result;
use crate::gpu::Device;
use crate::hilbert;
use crate::passes::order::OrderPass;
use cpu_time::ProcessTime;
use glam::Vec3;
use indicatif::ProgressBar;
use serde::Serialize;
use std::sync::Arc;

/// What the order of that many lights takes, milliseconds.
#[derive(Serialize)]
pub(super) struct Orders {
    lights: usize,
    /// CPU time on the host.
    host_cpu_ms: Figure,
    /// CPU time of the process while the device makes it; bounds, upload and what comes behind an order are left out.
    device_cpu_ms: Figure,
    /// Device time of that, where it has timestamps.
    device_ms: Option<Figure>,
    /// What the device's order is judged by: on a CPU its CPU time, else its own.
    device_share_of_host: f64,
}

impl Orders {
    /// Both in turn, so many times.
    pub(super) fn measure(
        device: &Arc<Device>,
        points: &[Vec3],
        repetitions: usize,
        bar: &ProgressBar,
    ) -> Result<Self> {
        let pass = OrderPass::new(device, points)?;
        pass.run()?; // the first may still compile
        let (mut host, mut cpu, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..repetitions {
            let clock = ProcessTime::now();
            let order = hilbert::order(points.iter().copied());
            host.push(clock.elapsed().as_secs_f64() * 1e3);
            drop(order);
            let taken = pass.run()?;
            cpu.push(taken.cpu_ms);
            own.extend(taken.device_ms);
            bar.inc(1);
        }
        let [host_cpu_ms, device_cpu_ms] = [host, cpu].map(|ms| Figure::of(&ms).unwrap_or_default());
        let device_ms = Figure::of(&own);
        let judged = device_ms.filter(|_| !device.is_cpu()).unwrap_or(device_cpu_ms);
        let device_share_of_host = judged.median / host_cpu_ms.median.max(f64::MIN_POSITIVE);
        Ok(Self { lights: points.len(), host_cpu_ms, device_cpu_ms, device_ms, device_share_of_host })
    }

    /// Which wins, and what frames have.
    pub(super) fn sentence(&self) -> String {
        let Self { lights, host_cpu_ms, device_cpu_ms, device_ms, device_share_of_host } = self;
        let device_ms = device_ms
            .map_or("it has no timestamps".into(), |ms| format!("{:.1} ms by its timestamps", ms.median));
        let ships = if *device_share_of_host > 1.0 {
            "Frames have the host's, the faster one here."
        } else {
            "Frames have the host's all the same: the device's is not wired into them."
        };
        format!(
            "The Hilbert order of {lights} lights takes {:.1} CPU ms on the host and {:.1} on the device ({device_ms}; keys \
             and sort of positions that are there, without bounds, boxes and lights, by shaders laid out for CPUs): {device_share_of_host:.2} times the \
             host's. {ships}\n",
            host_cpu_ms.median, device_cpu_ms.median
        )
    }
}
