//! Everything that is drawn, in one buffer of vertices and one of triangles.

use super::MeshVariants;
use super::area::Luminaire;
use super::coincident::Drawn;
use crate::draws::Draw;
use crate::scene::{AreaShape, Luminaire as Surface, Scene, Vertex};
use glam::{DVec3, Vec3};

/// Triangles, relative to the device's origin, and runs of them.
#[derive(Default)]
pub(super) struct Geometry {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// One a mesh, sorted by variant and material, so that pipelines change as rarely as they can.
    pub(super) draws: Vec<Draw>,
    /// One an area light that is seen: variants by [`Luminaire`], materials are lights.
    pub(super) luminaires: Vec<Draw>,
    drawn: Drawn,
}

impl Geometry {
    /// The meshes of `scene`, and those of its area lights that are `seen`.
    pub(super) fn new(
        scene: &Scene,
        variants: &[MeshVariants],
        seen: &[Option<Surface>],
        origin: Vec3,
    ) -> Self {
        let mut order: Vec<_> =
            scene.meshes.iter().zip(variants).filter(|(mesh, _)| !mesh.triangles.is_empty()).collect();
        order.sort_by_key(|(mesh, variants)| (variants.own, variants.from_outside, mesh.material));
        let mut all = Self::default();
        // First, so that of a light and a surface on the same place the light is seen.
        for (index, (light, surface)) in scene.area_lights.iter().zip(seen).enumerate() {
            let Some(surface) = surface else { continue };
            let line = matches!(light.shape, AreaShape::Line { .. });
            let kind = if line { Luminaire::Line } else { Luminaire::Flat };
            let run = all.run((&surface.vertices, &surface.triangles), !line, origin);
            all.luminaires.push(Draw { variant: kind as usize, material: index as u32, ..run });
        }
        for (mesh, variants) in order {
            let both_sides = scene.materials[mesh.material as usize].two_sided;
            let run = all.run((&mesh.vertices, &mesh.triangles), both_sides, origin);
            all.draws.push(Draw {
                variant: variants.own,
                from_outside: variants.from_outside,
                material: mesh.material,
                ..run
            });
        }
        all
    }

    /// Appends triangles, without those that lie where others are drawn.
    fn run(
        &mut self,
        (vertices, triangles): (&[Vertex], &[[u32; 3]]),
        both_sides: bool,
        origin: Vec3,
    ) -> Draw {
        let base = self.vertices.len();
        let first = self.triangles.len() as u32;
        let moved = |vertex: &Vertex| Vertex {
            position: (Vec3::from(vertex.position) - origin).to_array(),
            ..*vertex
        };
        self.vertices.extend(vertices.iter().map(moved));
        let corners = |triangle: &[u32; 3]| triangle.map(|index| vertices[index as usize].position);
        let fresh = triangles.iter().filter(|triangle| self.drawn.insert(corners(triangle), both_sides));
        self.triangles.extend(fresh.map(|triangle| triangle.map(|index| index + base as u32)));
        Draw {
            variant: 0,
            from_outside: None,
            material: 0,
            first,
            count: self.triangles.len() as u32 - first,
            bounds: bounds(&self.vertices[base..]).unwrap_or_default(),
        }
    }
}

/// The scene's middle where it lies far from the world's origin for its size, else that origin. Differences of
/// neighbouring float32 values are exact.
pub(super) fn origin(scene: &Scene, seen: &[Option<Surface>]) -> Vec3 {
    let meshes = scene.meshes.iter().map(|mesh| &mesh.vertices);
    let all = meshes.chain(seen.iter().flatten().map(|surface| &surface.vertices));
    let all = all.flat_map(|vertices| bounds(vertices));
    let Some([lower, upper]) = all.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else { return Vec3::ZERO };
    let middle = (lower + upper) / 2.0;
    let far = middle.abs().max_element() > 4.0 * (upper - lower).max_element();
    if far { middle.as_vec3() } else { Vec3::ZERO }
}

pub(super) fn bounds(vertices: &[Vertex]) -> Option<[DVec3; 2]> {
    let place = |vertex: &Vertex| Vec3::from(vertex.position).as_dvec3();
    let first = place(vertices.first()?);
    Some(
        vertices
            .iter()
            .fold([first; 2], |[lower, upper], vertex| [lower.min(place(vertex)), upper.max(place(vertex))]),
    )
}
