//! Triangles that share no vertices, so that a fragment knows where in its triangle it is.
//!
//! Barycentric coordinates of a fragment's own would ask for an extension, its triangle's number for geometry shaders, and
//! lines for depths that a prepass of triangles does not have. These are drawn by the prepass's own vertex module from the
//! same positions, so that their depths are equal. 156 bytes a triangle, for as long as they are looked at.

use crate::error::Result;
use crate::gpu::{Buffer, BufferUse, Device, Use};
use crate::gpu_scene::{GpuScene, Triangles};
use crate::scene::Vertex;
use std::sync::Arc;

/// Weights of a triangle's corners at the corners.
const WEIGHTS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A scene's triangles in their order. What a vertex has as its normal is the weight of each corner there, which
/// interpolation makes the fragment's barycentric coordinates.
pub(super) struct Corners {
    vertices: Buffer<Vertex>,
    triangles: Buffer<[u32; 3]>,
}

impl Corners {
    pub(super) fn new(device: &Arc<Device>, scene: &GpuScene) -> Result<Self> {
        let shared = scene.vertices.fetch(Use::TransferWrite)?;
        let triangles = scene.triangles.fetch(Use::TransferWrite)?;
        let corner = |(&index, normal): (&u32, [f32; 3])| Vertex { normal, ..shared[index as usize] };
        let vertices: Vec<Vertex> =
            triangles.iter().flat_map(|triangle| triangle.iter().zip(WEIGHTS).map(corner)).collect();
        let own: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|index| [0, 1, 2].map(|corner| 3 * index + corner)).collect();
        Ok(Self {
            vertices: Buffer::with(device, "corners", BufferUse::Vertex, &vertices)?,
            triangles: Buffer::with(device, "triangles of corners", BufferUse::Index, &own)?,
        })
    }

    pub(super) fn triangles(&self) -> Triangles<'_> {
        Triangles { vertices: &self.vertices, triangles: &self.triangles }
    }
}
