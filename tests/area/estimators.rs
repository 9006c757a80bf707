//! Calls `glsl/probe/area_tier.comp`, which includes `glsl/direct/` unchanged.

use amas::gpu::{Buffer, BufferUse, ComputePipeline, PipelineLayout, Specialization, Use, shaders};
use amas::scene::material::{PARAMETER_COUNT, Value};
use amas::scene::{AreaLight, AreaShape, Material, Model, Parameter};
use amas::shared::{self, AreaTierRow, LINEAR_GROUP, TIER_LIGHTS};
use amas::{GpuScene, Scene};
use glam::{DVec3, Vec3};
use std::sync::Arc;

use crate::common::gpu::CheckedGpu;

/// One-sided, of radiance 1.
pub(crate) fn light(shape: AreaShape) -> AreaLight {
    AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: false, texture: None }
}

/// A surface at the origin, normal +z: a lobe of the model without the others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub alpha: f64,
    /// Towards the viewer.
    pub wo: DVec3,
    pub first: u32,
    pub count: u32,
}

/// Lights on a device, and a material of one model for which it has tables.
pub(crate) struct Estimators {
    pub gpu: CheckedGpu,
    scene: GpuScene,
    layout: Arc<PipelineLayout>,
    model: Model,
}

impl Estimators {
    pub(crate) fn new(model: Model, area_lights: Vec<AreaLight>) -> Self {
        let gpu = CheckedGpu::open();
        let mut parameters = [Value::default(); PARAMETER_COUNT];
        for (parameter, value) in
            [(Parameter::Roughness, 0.1), (Parameter::Aspect, 1.0), (Parameter::Eta, 1.5)]
        {
            parameters[parameter as usize] = Value { constant: [value; 3], texture: None };
        }
        let material =
            Material { name: "m".into(), model, parameters, squared_roughness: false, two_sided: true };
        let scene = Scene { area_lights, materials: vec![material], ..Scene::default() };
        let scene = GpuScene::new(&gpu, &scene).unwrap();
        let layout = PipelineLayout::new(&gpu, &[shared::probe::BINDINGS, shared::scene::BINDINGS]).unwrap();
        Self { gpu, scene, layout: Arc::new(layout), model }
    }

    /// Radiance of each light of each row, by the estimator `tier` with so many `points`.
    pub(crate) fn reflected(&self, [tier, points]: [u32; 2], of: &[Row]) -> Vec<Vec<Vec3>> {
        let rows: Vec<_> = of.iter().map(|row| self.row(row)).collect();
        let closed = tier == shared::TIER_CLOSED_FORM || (tier == shared::TIER_SHIPPED && points > 0);
        let constants = Specialization::default()
            .with(shared::SPEC_MODEL, self.model as u32)
            .with(shared::SPEC_CLOSED_FORM, u32::from(closed))
            .with(shared::SPEC_TIER, tier)
            .with(shared::SPEC_TIER_POINTS, points)
            .with(shared::SPEC_TIER_INVOCATIONS, 1)
            .with_all(&self.scene.area.specialization);
        let pipeline =
            ComputePipeline::new(&self.gpu, &self.layout, shaders::PROBE_AREA_TIER_COMP, &constants).unwrap();
        let input = Buffer::with(&self.gpu, "probe rows", BufferUse::Storage, &rows).unwrap();
        let count = rows.len() * TIER_LIGHTS as usize;
        let output = Buffer::<[f32; 4]>::new(&self.gpu, "probe results", BufferUse::Storage, count).unwrap();
        let sets = self.layout.allocate(shared::probe::SET, 1).unwrap();
        sets.get(0).buffer(shared::probe::PROBE_IN, &input);
        sets.get(0).buffer(shared::probe::PROBE_OUT, &output);
        let record = |cmd: &mut amas::gpu::Commands| {
            cmd.bind_compute(&pipeline, &[sets.get(0), self.scene.set.get(0)]);
            cmd.dispatch([(rows.len() as u32).div_ceil(LINEAR_GROUP), 1, 1]);
            Ok(())
        };
        self.gpu.run("estimators", record).unwrap();
        let values = output.fetch(Use::ComputeWrite).unwrap();
        let lights = |(row, values): (&Row, &[[f32; 4]])| {
            values[..row.count as usize].iter().map(|value| Vec3::from_slice(value)).collect()
        };
        of.iter().zip(values.chunks_exact(TIER_LIGHTS as usize)).map(lights).collect()
    }

    /// The lobe alone: a white Lambertian, a metal that reflects everything, a dielectric without a base.
    fn row(&self, row: &Row) -> AreaTierRow {
        let [color, specular] = match self.model {
            Model::Matte => [1.0, 0.0],
            // |R − 1| = 4 eta/k² is below float32's last digit.
            Model::Metal => [1.0, 1e4],
            Model::Plastic => [0.0, 1.0],
            Model::Substrate => [0.0, 0.05],
            Model::Principled => [0.0, 0.0],
        };
        AreaTierRow {
            color_alpha: [color, color, color, row.alpha as f32],
            specular_eta: [specular, specular, specular, 1.5],
            wo: row.wo.as_vec3().to_array(),
            light_first: row.first,
            position: (Vec3::ZERO - self.scene.origin).to_array(),
            light_count: row.count,
        }
    }
}
