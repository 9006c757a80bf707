//! What a frame cost: wall time, CPU time of the whole process, and time per pass.

use crate::error::Result;
use cpu_time::ProcessTime;
use std::time::{Duration, Instant};

/// One pass of a frame.
#[derive(Clone, Debug)]
pub struct PassTime {
    /// As in `frame.rs`.
    pub name: &'static str,
    /// Between timestamps; `None` where the device has none.
    pub gpu_ms: Option<f64>,
    /// CPU time of the process while the pass ran alone; `None` unless the frame was split.
    pub cpu_ms: Option<f64>,
}

/// A frame's cost, summed over its samples.
#[derive(Clone, Debug, Default)]
pub struct Timings {
    /// Passes in frame order.
    pub passes: Vec<PassTime>,
    /// Wall time.
    pub wall_ms: f64,
    /// CPU time of the whole process; on a CPU device, that is the rendering.
    pub cpu_ms: f64,
}

impl Timings {
    /// What a step on the host costs, as a pass of that name.
    ///
    /// # Errors
    /// The step's.
    pub fn of(name: &'static str, step: impl FnOnce() -> Result<()>) -> Result<Self> {
        let mut watch = Stopwatch::start(&[name]);
        let before = watch.cpu();
        step()?;
        watch.add_cpu(1, before);
        Ok(watch.stop())
    }

    /// Adds what further work on the picture cost: pass by pass of the same name, new ones behind.
    pub fn add(&mut self, further: &Self) {
        let sum = |a: Option<f64>, b: Option<f64>| a.map(|a| a + b.unwrap_or(0.0)).or(b);
        for pass in &further.passes {
            match self.passes.iter_mut().find(|known| known.name == pass.name) {
                Some(known) => {
                    known.gpu_ms = sum(known.gpu_ms, pass.gpu_ms);
                    known.cpu_ms = sum(known.cpu_ms, pass.cpu_ms);
                }
                None => self.passes.push(pass.clone()),
            }
        }
        self.wall_ms += further.wall_ms;
        self.cpu_ms += further.cpu_ms;
    }

    /// With what happened before on the host: the moving of the lights.
    pub(super) fn after(mut self, lights: Option<Self>) -> Self {
        if let Some(lights) = lights {
            let pass = PassTime { name: "lights", gpu_ms: None, cpu_ms: Some(lights.cpu_ms) };
            self.passes.insert(0, pass);
            self.wall_ms += lights.wall_ms;
            self.cpu_ms += lights.cpu_ms;
        }
        self
    }
}

/// Measures a frame.
pub(super) struct Stopwatch {
    wall: Instant,
    cpu: ProcessTime,
    passes: Vec<PassTime>,
    // CPU time of steps that hold several passes: first pass, milliseconds.
    shared: Vec<(usize, f64)>,
    next: usize,
}

impl Stopwatch {
    pub(super) fn start(names: &[&'static str]) -> Self {
        let passes = names.iter().map(|&name| PassTime { name, gpu_ms: None, cpu_ms: None }).collect();
        Self { wall: Instant::now(), cpu: ProcessTime::now(), passes, shared: Vec::new(), next: 0 }
    }

    pub(super) fn cpu(&self) -> Duration {
        self.cpu.elapsed()
    }

    /// CPU time since `before` was spent on the next `passes` passes, or on all that are left.
    pub(super) fn add_cpu(&mut self, passes: usize, before: Duration) {
        let ms = milliseconds(self.cpu.elapsed().saturating_sub(before));
        match passes {
            0 => {}
            1 => {
                *self.passes[self.next].cpu_ms.get_or_insert(0.0) += ms;
                self.next += 1;
            }
            _ => {
                self.shared.push((self.next, ms));
                self.next = 0;
            }
        }
    }

    pub(super) fn add_gpu(&mut self, intervals: Option<Vec<f64>>) {
        for (pass, ms) in self.passes.iter_mut().zip(intervals.unwrap_or_default()) {
            *pass.gpu_ms.get_or_insert(0.0) += ms;
        }
    }

    pub(super) fn stop(mut self) -> Timings {
        // Subpasses cannot be submitted alone: they share their step's CPU time as they share its device time.
        for (first, ms) in &self.shared {
            let passes = &mut self.passes[*first..];
            let total: f64 = passes.iter().filter_map(|pass| pass.gpu_ms).sum();
            let even = 1.0 / passes.len().max(1) as f64;
            for pass in passes {
                let share = pass.gpu_ms.filter(|_| total > 0.0).map_or(even, |gpu| gpu / total);
                *pass.cpu_ms.get_or_insert(0.0) += ms * share;
            }
        }
        Timings {
            passes: self.passes,
            wall_ms: milliseconds(self.wall.elapsed()),
            cpu_ms: milliseconds(self.cpu.elapsed()),
        }
    }
}

fn milliseconds(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
