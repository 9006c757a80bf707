//! Triangles in world space.

use bytemuck::{Pod, Zeroable};

/// A vertex, exactly as the vertex shader reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// World position.
    pub position: [f32; 3],
    /// Unit shading normal.
    pub normal: [f32; 3],
    /// Unit ∂p/∂u orthogonalised against the normal, and ±1 for the bitangent w·(n × t); zero without texture coordinates.
    pub tangent: [f32; 4],
    /// Texture coordinates, (0, 0) at the image's lower left.
    pub uv: [f32; 2],
}

/// Triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Counter-clockwise triangles; no degenerate ones.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `Scene::materials`.
    pub material: u32,
}
