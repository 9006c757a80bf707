//! The estimators, and how each is timed on the device.

use super::configurations::Configuration;
use crate::error::Result;
use crate::gpu::{
    Buffer, BufferUse, ComputePipeline, DescriptorSets, Device, PipelineLayout, Specialization, Timestamps,
    Use, shaders,
};
use crate::gpu_scene::GpuScene;
use crate::scene::Model;
use crate::shared::{self, LINEAR_GROUP, TIER_LIGHTS};
use glam::Vec3;
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;

/// What an estimator is of, and how the plot shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Family {
    /// Subtracted from the others.
    None,
    Representative,
    Cubature,
    ClosedForm,
    Quadrature,
    Shipped,
    AreaSamples,
    ProxySamples,
}

impl Family {
    pub(super) fn random(self) -> bool {
        matches!(self, Self::AreaSamples | Self::ProxySamples)
    }

    /// `shared::TIER_*`.
    fn id(self) -> u32 {
        match self {
            Self::None => shared::TIER_NONE,
            Self::Representative => shared::TIER_REPRESENTATIVE,
            Self::Cubature => shared::TIER_CUBATURE,
            Self::ClosedForm => shared::TIER_CLOSED_FORM,
            Self::Quadrature => shared::TIER_QUADRATURE,
            Self::Shipped => shared::TIER_SHIPPED,
            Self::AreaSamples => shared::TIER_AREA_SAMPLES,
            Self::ProxySamples => shared::TIER_PROXY_SAMPLES,
        }
    }
}

/// An estimator.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tier {
    pub(super) name: &'static str,
    pub(super) family: Family,
    pub(super) points: u32,
}

const fn tier(name: &'static str, family: Family, points: u32) -> Tier {
    Tier { name, family, points }
}

/// The first is the one that does nothing.
pub(super) const TIERS: [Tier; 18] = [
    tier("nothing", Family::None, 0),
    tier("representative point", Family::Representative, 1),
    tier("cubature 2x2", Family::Cubature, 4),
    tier("cubature 4x4", Family::Cubature, 16),
    tier("LTC closed form", Family::ClosedForm, 0),
    tier("quadrature 2", Family::Quadrature, 2),
    tier("quadrature 4", Family::Quadrature, 4),
    tier("quadrature 8", Family::Quadrature, 8),
    tier("amas, error 0", Family::Shipped, 0),
    tier("amas, error .01", Family::Shipped, 10),
    tier("area samples 1", Family::AreaSamples, 1),
    tier("area samples 4", Family::AreaSamples, 4),
    tier("area samples 16", Family::AreaSamples, 16),
    tier("area samples 64", Family::AreaSamples, 64),
    tier("LTC samples 1", Family::ProxySamples, 1),
    tier("LTC samples 4", Family::ProxySamples, 4),
    tier("LTC samples 16", Family::ProxySamples, 16),
    tier("LTC samples 64", Family::ProxySamples, 64),
];

/// Pipelines of all [`TIERS`] for one model and one kind of light.
pub(super) struct Pipelines {
    layout: Arc<PipelineLayout>,
    pipelines: Vec<ComputePipeline>,
}

impl Pipelines {
    pub(super) fn new(
        device: &Arc<Device>,
        model: Model,
        lights: &[(u32, u32)],
        mut done: impl FnMut(),
    ) -> Result<Self> {
        let bindings = [shared::probe::BINDINGS, shared::scene::BINDINGS];
        let layout = Arc::new(PipelineLayout::new(device, &bindings)?);
        let base = Specialization::default().with(shared::SPEC_MODEL, model as u32);
        let base = lights.iter().fold(base, |all, &(id, value)| all.with(id, value));
        let one = |tier: &Tier| {
            let closed = match tier.family {
                Family::ClosedForm => true,
                Family::Shipped => tier.points > 0,
                _ => false,
            };
            let own = base
                .clone()
                .with(shared::SPEC_CLOSED_FORM, u32::from(closed))
                .with(shared::SPEC_TIER, tier.family.id())
                .with(shared::SPEC_TIER_POINTS, tier.points);
            done();
            ComputePipeline::new(device, &layout, shaders::PROBE_AREA_TIER_COMP, &own)
        };
        let pipelines = TIERS.iter().map(one).collect::<Result<_>>()?;
        Ok(Self { layout, pipelines })
    }
}

/// Configurations on the device, and the ways to light them.
pub(super) struct Bench<'a> {
    device: &'a Arc<Device>,
    scene: &'a GpuScene,
    pipelines: &'a Pipelines,
    /// With all lights, and with none.
    sets: [DescriptorSets; 2],
    output: Buffer<[f32; 4]>,
    timestamps: Timestamps,
    rows: u32,
    // What the sets refer to.
    _inputs: [Buffer<shared::AreaTierRow>; 2],
}

impl<'a> Bench<'a> {
    /// The lights of the configurations begin with light `first` of the scene.
    pub(super) fn new(
        device: &'a Arc<Device>,
        scene: &'a GpuScene,
        pipelines: &'a Pipelines,
        configurations: &[Configuration],
        first: usize,
    ) -> Result<Self> {
        let position = Vec3::ZERO - scene.origin;
        let input = |lit: bool| {
            let rows = configurations.iter().zip((first..).step_by(TIER_LIGHTS as usize));
            let rows: Vec<_> = rows.map(|(one, first)| one.row(first, position, lit)).collect();
            Buffer::with(device, "probe rows", BufferUse::Storage, &rows)
        };
        let inputs = [input(true)?, input(false)?];
        let values = configurations.len() * (LINEAR_GROUP * TIER_LIGHTS) as usize;
        let output = Buffer::new(device, "probe results", BufferUse::Storage, values)?;
        let set = |input| -> Result<DescriptorSets> {
            let sets = pipelines.layout.allocate(shared::probe::SET, 1)?;
            sets.get(0).buffer(shared::probe::PROBE_IN, input);
            sets.get(0).buffer(shared::probe::PROBE_OUT, &output);
            Ok(sets)
        };
        Ok(Self {
            device,
            scene,
            pipelines,
            sets: [set(&inputs[0])?, set(&inputs[1])?],
            output,
            timestamps: Timestamps::new(device, 2)?,
            rows: configurations.len() as u32,
            _inputs: inputs,
        })
    }

    /// Nanoseconds of a tier with all lights less those with none, per light and invocation.
    pub(super) fn time(&self, tier: usize) -> Result<f64> {
        let [lit, unlit] = [self.dispatch(tier, 0)?, self.dispatch(tier, 1)?];
        Ok((lit - unlit) * 1e6 / f64::from(self.rows * LINEAR_GROUP * TIER_LIGHTS))
    }

    /// What a tier says: of every light of every invocation, the sum over the channels.
    pub(super) fn values(&self, tier: usize) -> Result<Vec<f64>> {
        self.dispatch(tier, 0)?;
        let values = self.output.fetch(Use::ComputeWrite)?;
        Ok(values.iter().map(|value| value[..3].iter().map(|&x| f64::from(x)).sum()).collect())
    }

    /// Milliseconds.
    fn dispatch(&self, tier: usize, set: usize) -> Result<f64> {
        let begin = Instant::now();
        self.device.run("tier", |cmd| {
            cmd.reset_timestamps(&self.timestamps);
            cmd.memory_barrier(Use::ComputeWrite, Use::ComputeWrite);
            cmd.timestamp(&self.timestamps, 0);
            cmd.bind_compute(
                &self.pipelines.pipelines[tier],
                &[self.sets[set].get(0), self.scene.set.get(0)],
            );
            cmd.dispatch([self.rows, 1, 1]);
            cmd.timestamp(&self.timestamps, 1);
            Ok(())
        })?;
        let wall = begin.elapsed().as_secs_f64() * 1e3;
        Ok(self.timestamps.intervals()?.map_or(wall, |intervals| intervals[0]))
    }
}
