//! Calls `glsl/probe/area.comp`, which includes `lib/area/` unchanged.

use amas::gpu::{Specialization, shaders};
use amas::shared::{self, AreaProbeRow};
use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::common::gpu::CheckedGpu;

/// Rings of vertices relative to a center, in numbers that float32 holds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    pub center: Vec3,
    pub rings: Vec<Vec<Vec3>>,
}

impl Outline {
    pub(crate) fn ring(vertices: &[[f32; 3]]) -> Self {
        Self { center: Vec3::ZERO, rings: vec![vertices.iter().map(|&v| v.into()).collect()] }
    }

    /// As the device knows it, in double precision.
    pub(crate) fn exact(&self) -> Vec<Vec<DVec3>> {
        let place = |&v: &Vec3| self.center.as_dvec3() + v.as_dvec3();
        self.rings.iter().map(|ring| ring.iter().map(place).collect()).collect()
    }

    pub(crate) fn map(&self, f: impl Fn(Vec3) -> Vec3) -> Self {
        let rings = self.rings.iter().map(|ring| ring.iter().map(|&v| f(v)).collect()).collect();
        Self { center: f(self.center), rings }
    }

    pub(crate) fn reversed(&self) -> Self {
        let rings = self.rings.iter().map(|ring| ring.iter().rev().copied().collect()).collect();
        Self { rings, ..*self }
    }

    fn row(&self) -> AreaProbeRow {
        let mut row = AreaProbeRow { center: self.center.to_array(), ..AreaProbeRow::default() };
        let mut slots = row.vertices.iter_mut();
        for ring in &self.rings {
            for (i, vertex) in ring.iter().enumerate() {
                let last = if i + 1 == ring.len() { 1.0 } else { 0.0 };
                *slots.next().unwrap() = vertex.extend(last).to_array();
                row.count += 1;
                row.radius = row.radius.max(vertex.length());
            }
        }
        row
    }
}

/// center + a cos ψ + b sin ψ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ellipse {
    pub center: Vec3,
    pub a: Vec3,
    pub b: Vec3,
}

impl Ellipse {
    fn row(&self) -> AreaProbeRow {
        let mut row = AreaProbeRow { center: self.center.to_array(), ..AreaProbeRow::default() };
        row.vertices[0] = self.a.extend(0.0).to_array();
        row.vertices[1] = self.b.extend(0.0).to_array();
        row
    }

    pub(crate) fn point(&self, psi: f64) -> DVec3 {
        let [c, a, b] = [self.center, self.a, self.b].map(|v| v.as_dvec3());
        c + psi.cos() * a + psi.sin() * b
    }
}

/// An open cylinder.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cylinder {
    pub a: Vec3,
    pub b: Vec3,
    pub radius: f32,
}

impl Cylinder {
    fn row(&self) -> AreaProbeRow {
        let mut row = AreaProbeRow { radius: self.radius, ..AreaProbeRow::default() };
        row.vertices[0] = self.a.extend(0.0).to_array();
        row.vertices[1] = self.b.extend(0.0).to_array();
        row
    }
}

fn run(gpu: &CheckedGpu, function: u32, rows: &[AreaProbeRow]) -> Vec<[f32; 4]> {
    let constants = Specialization::default().with(shared::SPEC_AREA_PROBE, function);
    amas::probe::run(gpu, shaders::PROBE_AREA_COMP, &constants, rows).unwrap()
}

/// Signed form factor of each outline.
pub(crate) fn polygons(gpu: &CheckedGpu, outlines: &[Outline]) -> Vec<f64> {
    let rows: Vec<_> = outlines.iter().map(Outline::row).collect();
    run(gpu, shared::PROBE_POLYGON, &rows).into_iter().map(|value| f64::from(value[0])).collect()
}

pub(crate) fn polygon(gpu: &CheckedGpu, outline: &Outline) -> f64 {
    polygons(gpu, std::slice::from_ref(outline))[0]
}

pub(crate) fn ellipses(gpu: &CheckedGpu, all: &[Ellipse]) -> Vec<f64> {
    let rows: Vec<_> = all.iter().map(Ellipse::row).collect();
    run(gpu, shared::PROBE_ELLIPSE, &rows).into_iter().map(|value| f64::from(value[0])).collect()
}

/// Middle of the azimuths that meet an ellipse, and half their range.
pub(crate) fn azimuths(gpu: &CheckedGpu, all: &[Ellipse]) -> Vec<(DVec2, f64)> {
    let rows: Vec<_> = all.iter().map(Ellipse::row).collect();
    let values = run(gpu, shared::PROBE_ELLIPSE, &rows);
    values.into_iter().map(|v| (Vec2::new(v[1], v[2]).as_dvec2(), f64::from(v[3]))).collect()
}

/// An ellipse at one azimuth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub lower: f64,
    pub upper: f64,
    pub contains: [bool; 2],
}

pub(crate) fn intervals(gpu: &CheckedGpu, all: &[(Ellipse, Vec2)]) -> Vec<Interval> {
    let row =
        |(ellipse, e): &(Ellipse, Vec2)| AreaProbeRow { azimuth: e.extend(0.0).to_array(), ..ellipse.row() };
    let rows: Vec<_> = all.iter().map(row).collect();
    let values = run(gpu, shared::PROBE_INTERVAL, &rows);
    values
        .into_iter()
        .map(|v| Interval {
            lower: f64::from(v[0]),
            upper: f64::from(v[1]),
            contains: [v[2] > 0.0, v[3] > 0.0],
        })
        .collect()
}

pub(crate) fn cylinders(gpu: &CheckedGpu, all: &[Cylinder]) -> Vec<f64> {
    let rows: Vec<_> = all.iter().map(Cylinder::row).collect();
    run(gpu, shared::PROBE_LINE, &rows).into_iter().map(|value| f64::from(value[0])).collect()
}
