//! The order of points along a Hilbert curve, on the device: outside the frame, for `amas report --chapter lights` and the
//! tests to hold against [`crate::hilbert::order`], which is the order that frames have.
//!
//! 1. `keys`: each point's place along the curve through the bounds of all, which the host finds.
//! 2. `count`, once a digit of eight bits, the last first: how many of each block of points have each of its values.
//! 3. `places`: where each block's elements of each value go, by one workgroup's scan.
//! 4. `scatter`: there they go, in order: the sort is stable, and nothing depends on timing.
//!
//! On lavapipe 2²⁰ points take 84 CPU ms, where the host takes 23: 14 for the keys, 18 for the counts, 3 for the places and
//! 49 for the scatter. So what would follow, the lights' own places and the boxes, is not made here. Counters in shared
//! memory, or blocks of twice as many points, change less than one run differs from the next.
//!
//! Far points and crowds, which the host orders along curves of their own, are ordered along that of all.

use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, Commands, ComputePipeline, DescriptorSets, Device, PipelineLayout, Specialization,
    Timestamps, Use, shaders,
};
use crate::hilbert;
use crate::shared::{self, LINEAR_GROUP, ORDER_BLOCK, ORDER_DIGIT_BITS, ORDER_DIGITS, OrderConstants};
use cpu_time::ProcessTime;
use glam::Vec3;
use std::sync::Arc;

/// An even number, so that the last takes the elements where the keys were.
const DIGITS: u32 = shared::HILBERT_KEY_BITS / ORDER_DIGIT_BITS;
const _: () = assert!(DIGITS.is_multiple_of(2) && DIGITS * ORDER_DIGIT_BITS == shared::HILBERT_KEY_BITS);

/// The set of the shader that makes the keys; those before it are the digits'.
const KEYS: usize = 2;

/// What an order on the device took, milliseconds.
#[derive(Clone, Copy, Debug)]
pub struct OrderTime {
    /// CPU time of the process: on a CPU device, that is the order's.
    pub cpu_ms: f64,
    /// Device time, where it has timestamps.
    pub device_ms: Option<f64>,
}

/// Points on the device, and the shaders that put them in order.
pub struct OrderPass {
    device: Arc<Device>,
    keys: ComputePipeline,
    count: ComputePipeline,
    places: ComputePipeline,
    scatter: ComputePipeline,
    /// From the first elements to the second, and back; from the table to the first.
    sets: DescriptorSets,
    elements: [Buffer<[u32; 2]>; 2],
    constants: OrderConstants,
    lanes: u32,
    timestamps: Timestamps,
    _points: Buffer<[f32; 4]>,
    _steps: Buffer<u32>,
    _counts: Buffer<u32>,
}

impl OrderPass {
    /// For those points, 4,194,240 at most: as many as a row of workgroups takes.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, points: &[Vec3]) -> Result<Self> {
        let grid = hilbert::grid(points.iter().copied());
        let count = points.len() as u32;
        let blocks = count.div_ceil(ORDER_BLOCK);
        let storage = |name, len| Buffer::new(device, name, BufferUse::Storage, len);
        let elements = [storage("keys", points.len())?, storage("keys in order", points.len())?];
        let places: Vec<_> = points.iter().map(|point| point.extend(0.0).to_array()).collect();
        let places = Buffer::with(device, "points", BufferUse::Storage, &places)?;
        let steps = Buffer::with(device, "steps of the curve", BufferUse::Storage, &hilbert::steps())?;
        let counts =
            Buffer::new(device, "counts of digits", BufferUse::Storage, (blocks * ORDER_DIGITS) as usize)?;
        let layout = Arc::new(PipelineLayout::new(device, &[shared::order::BINDINGS])?);
        let sets = layout.allocate(shared::order::SET, 3)?;
        for (index, [from, to]) in [[0, 1], [1, 0]].into_iter().enumerate() {
            sets.get(index).buffer(shared::order::ORDER_FROM, &elements[from]);
            sets.get(index).buffer(shared::order::ORDER_TO, &elements[to]);
            sets.get(index).buffer(shared::order::ORDER_COUNTS, &counts);
        }
        sets.get(KEYS).buffer(shared::order::ORDER_POINTS, &places);
        sets.get(KEYS).buffer(shared::order::ORDER_FROM, &steps);
        sets.get(KEYS).buffer(shared::order::ORDER_TO, &elements[0]);
        // A vector of lavapipe, or a warp.
        let lanes = if device.is_cpu() { 8 } else { 32 };
        let wide = Specialization::default().with(shared::SPEC_LANES, lanes);
        let pipeline = |shader, specialization| ComputePipeline::new(device, &layout, shader, specialization);
        Ok(Self {
            device: device.clone(),
            keys: pipeline(shaders::ORDER_KEYS_COMP, &Specialization::default())?,
            count: pipeline(shaders::ORDER_COUNT_COMP, &wide)?,
            places: pipeline(shaders::ORDER_PLACES_COMP, &Specialization::default())?,
            scatter: pipeline(shaders::ORDER_SCATTER_COMP, &wide)?,
            sets,
            elements,
            constants: OrderConstants {
                lower: grid.lower.to_array(),
                scale: grid.scale,
                count,
                blocks,
                ..OrderConstants::default()
            },
            lanes,
            timestamps: Timestamps::new(device, 2)?,
            _points: places,
            _steps: steps,
            _counts: counts,
        })
    }

    /// Puts them in order, anew each time.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn run(&self) -> Result<OrderTime> {
        let begin = ProcessTime::now();
        self.device.run("order", |cmd| {
            cmd.reset_timestamps(&self.timestamps);
            cmd.timestamp(&self.timestamps, 0);
            self.record(cmd);
            cmd.timestamp(&self.timestamps, 1);
            Ok(())
        })?;
        let cpu_ms = begin.elapsed().as_secs_f64() * 1e3;
        Ok(OrderTime { cpu_ms, device_ms: self.timestamps.intervals()?.map(|intervals| intervals[0]) })
    }

    fn record(&self, cmd: &mut Commands) {
        let OrderConstants { count, blocks, .. } = self.constants;
        let dispatch = |cmd: &mut Commands, pipeline, set, shift, groups| {
            cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
            cmd.bind_compute(pipeline, &[self.sets.get(set)]);
            cmd.push(&OrderConstants { shift, ..self.constants });
            cmd.dispatch([groups, 1, 1]);
        };
        dispatch(cmd, &self.keys, KEYS, 0, count.div_ceil(LINEAR_GROUP));
        for digit in 0..DIGITS {
            let (set, shift) = ((digit % 2) as usize, digit * ORDER_DIGIT_BITS);
            dispatch(cmd, &self.count, set, shift, blocks.div_ceil(self.lanes));
            dispatch(cmd, &self.places, set, shift, 1);
            dispatch(cmd, &self.scatter, set, shift, blocks.div_ceil(self.lanes));
        }
    }

    /// Indices of the points in the order that the last run put them in.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn fetch(&self) -> Result<Vec<u32>> {
        let mut elements = self.elements[0].fetch(Use::ComputeWrite)?;
        // A buffer of no points has one element all the same.
        elements.truncate(self.constants.count as usize);
        Ok(elements.into_iter().map(|[_, index]| index).collect())
    }
}
