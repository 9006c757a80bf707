//! Area lights as the device wants them: everything about them in one texture of words.
//!
//! Records come first, then vertices of outlines and of convex pieces, then points of cubature, then textures. A texture,
//! not storage buffers: lavapipe vectorises texel fetches. One of words, not of floats: no device rounds these, and what a
//! stage may have of textures is short.

mod compress;
mod cubature;
mod filter;
mod heap;
mod pieces;
mod plane;

use crate::error::{Error, Result};
use crate::scene::mips::{Level, levels};
use crate::scene::{AreaLight, AreaShape, Scene};
use crate::shared::{self, AreaRecord};
use cubature::{Choice, Node};
use glam::{DVec2, DVec3, Vec3};
use heap::Heap;
use pieces::{pieces, triangles};
use plane::{Outline, Plane};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Longest side of a texture: 16 bits.
const LONGEST_SIDE: u32 = 65_535;
/// Vertices of a record's pieces at most: all that a pixel may spend on them is within what one draw may.
pub const MOST_VERTICES: usize = 92;
/// Largest radiance and area that a shader multiplies without overflow.
const LARGEST: f64 = 1e18;

/// A point that stands for a part of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaPoint {
    /// Relative to the device's origin.
    pub position: [f32; 3],
    /// Square metres; of a line, metres along its axis.
    pub weight: f32,
    /// Emitted by that part on average.
    pub radiance: [f32; 3],
}

/// A scene's area lights; numbers in the records count from the beginning of each list.
#[derive(Clone, Debug, Default)]
pub struct AreaLights {
    /// One a light, in the scene's order; then what else there is of lights that one record cannot hold.
    pub records: Vec<AreaRecord>,
    /// Position and 1 at the last vertex of a loop; counter-clockwise seen from the front, holes of rings clockwise.
    pub vertices: Vec<[f32; 4]>,
    /// Points of all lights.
    pub points: Vec<AreaPoint>,
    heap: Heap,
}

/// What one light adds to the lists.
struct Parts {
    record: AreaRecord,
    rings: Vec<[f32; 4]>,
    pieces: Vec<[f32; 4]>,
    coarse: Vec<AreaPoint>,
    fine: Vec<AreaPoint>,
}

impl AreaLights {
    /// The lights of `scene`, relative to `origin`.
    ///
    /// # Errors
    /// [`Error::Usage`] where there are too many of them, or a texture is too large.
    pub fn new(scene: &Scene, origin: Vec3) -> Result<Self> {
        if scene.area_lights.len() > shared::MAX_AREA_LIGHTS as usize {
            let cause =
                format!("{} area lights, more than {}", scene.area_lights.len(), shared::MAX_AREA_LIGHTS);
            return Err(Error::usage(cause, "use fewer"));
        }
        let mut lights = Self::default();
        let textures = lights.textures(scene)?;
        let part = |light: &AreaLight| {
            let texture = light.texture.and_then(|index| textures.get(&index));
            parts(light, texture.map(|(levels, _)| levels.as_slice()), origin.as_dvec3())
        };
        let parts: Vec<_> = scene.area_lights.par_iter().map(part).collect();
        let heap = |light: &AreaLight| {
            light.texture.and_then(|index| textures.get(&index)).map_or(0, |(_, first)| *first)
        };
        let mut rest = Vec::new();
        for (light, parts) in scene.area_lights.iter().zip(parts) {
            let mut parts = parts.into_iter().map(|part| (part, heap(light)));
            parts.by_ref().take(1).for_each(|(part, heap)| lights.push(part, heap));
            rest.extend(parts);
        }
        rest.into_iter().for_each(|(part, heap)| lights.push(part, heap));
        if lights.records.len() > shared::MAX_AREA_LIGHTS as usize {
            let cause = format!(
                "the area lights make {} parts of at most {MOST_VERTICES} vertices, more than {}",
                lights.records.len(),
                shared::MAX_AREA_LIGHTS
            );
            return Err(Error::usage(cause, "give them fewer corners and holes"));
        }
        Ok(lights)
    }

    /// Packs every texture that a light has; its levels and its first texel.
    fn textures(&mut self, scene: &Scene) -> Result<BTreeMap<u32, (Vec<Level>, u32)>> {
        let mut known = BTreeMap::new();
        for index in scene.area_lights.iter().filter_map(|light| light.texture) {
            let Some(texture) = scene.textures.get(index as usize).filter(|_| !known.contains_key(&index))
            else {
                continue;
            };
            if texture.width.max(texture.height) > LONGEST_SIDE {
                let cause = format!(
                    "texture {:?} of a light has a side of more than {LONGEST_SIDE} texels",
                    texture.name
                );
                return Err(Error::usage(cause, "make it smaller"));
            }
            let levels = levels(texture);
            let first = self.heap.push(&levels);
            known.insert(index, (levels, first));
        }
        Ok(known)
    }

    fn push(&mut self, parts: Parts, heap: u32) {
        let Parts { mut record, rings, pieces, coarse, fine } = parts;
        record.heap = heap;
        record.ring_first = self.vertices.len() as u32;
        record.ring_count = rings.len() as u32;
        self.vertices.extend(&rings);
        // Convex outlines are their own pieces.
        record.piece_first = if pieces == rings { record.ring_first } else { self.vertices.len() as u32 };
        record.piece_count = pieces.len() as u32;
        if pieces != rings {
            self.vertices.extend(pieces);
        }
        record.point_first = self.points.len() as u32;
        record.points = coarse.len() as u32 | (fine.len() as u32) << 16;
        self.points.push(whole(&fine));
        self.points.extend(coarse.into_iter().chain(fine));
        self.records.push(record);
    }

    /// All texels of the texture that `glsl/bind/area_lights.glsl` reads.
    #[must_use]
    pub fn texels(&self) -> Vec<[u32; 4]> {
        let vertices = self.records.len() << shared::AREA_RECORD_LOG2;
        // Points are two texels each and are counted by pairs.
        let points = (vertices + self.vertices.len()).next_multiple_of(2);
        let heap = points + 2 * self.points.len();
        let mut texels = Vec::with_capacity(heap + self.heap.texels.len());
        for &record in &self.records {
            let moved = AreaRecord {
                ring_first: record.ring_first + vertices as u32,
                piece_first: record.piece_first + vertices as u32,
                point_first: record.point_first + points as u32 / 2,
                heap: record.heap + heap as u32,
                ..record
            };
            texels.extend_from_slice(bytemuck::cast_slice::<AreaRecord, [u32; 4]>(&[moved]));
        }
        texels.extend(self.vertices.iter().map(|vertex| vertex.map(f32::to_bits)));
        texels.resize(points, [0; 4]);
        for AreaPoint { position: [x, y, z], weight, radiance: [r, g, b] } in &self.points {
            texels.extend([[*x, *y, *z, *weight], [*r, *g, *b, 0.0]].map(|texel| texel.map(f32::to_bits)));
        }
        texels.extend(&self.heap.texels);
        texels
    }
}

/// Everything of a light but where its texture lies: one record, or several where its pieces have too many vertices.
fn parts(light: &AreaLight, texture: Option<&[Level]>, origin: DVec3) -> Vec<Parts> {
    let plane = match &light.shape {
        AreaShape::Line { a, b, radius } => {
            return vec![line(light, [a.as_dvec3() - origin, b.as_dvec3() - origin], f64::from(*radius))];
        }
        &AreaShape::Rect { center, u, v } => Plane::new([center, u, v], Outline::Parallelogram),
        &AreaShape::Disk { center, u, v } => Plane::new([center, u, v], Outline::Ellipse),
        AreaShape::Polygon { vertices, holes, uvs } => Plane::polygon(vertices, holes, uvs.as_deref()),
    };
    let pieces = pieces(&plane, light);
    if pieces.iter().map(Vec::len).sum::<usize>() <= MOST_VERTICES {
        return vec![flat(light, &plane, plane.rings(), pieces, texture, origin)];
    }
    // Disjoint pieces are lights of their own, and their light adds up.
    let mut groups: Vec<Vec<Vec<DVec2>>> = vec![vec![]];
    let mut vertices = 0;
    for piece in pieces {
        vertices += piece.len();
        if vertices > MOST_VERTICES {
            vertices = piece.len();
            groups.push(vec![]);
        }
        groups.last_mut().into_iter().for_each(|group| group.push(piece.clone()));
    }
    groups.into_iter().map(|group| flat(light, &plane, group.clone(), group, texture, origin)).collect()
}

/// A light in a plane, by the rings of its outline and its convex pieces.
fn flat(
    light: &AreaLight,
    plane: &Plane,
    rings: Vec<Vec<DVec2>>,
    pieces: Vec<Vec<DVec2>>,
    texture: Option<&[Level]>,
    origin: DVec3,
) -> Parts {
    let at = |st: DVec2| (plane.at(st) - origin).as_vec3();
    let triangles = triangles(&pieces);
    let area = plane.scale() * cubature::area_of(plane, &triangles);
    let radiance = light.radiance.as_dvec3();
    let points = |choice| {
        let nodes = cubature::flat(plane, &triangles, choice);
        let means = match texture {
            Some(levels) => filter::means(plane, &triangles, &nodes, levels),
            None => vec![DVec3::ONE; nodes.len()],
        };
        let point = |(node, mean): (&Node, DVec3)| point(at(node.st), area * node.share, radiance * mean);
        nodes.iter().zip(means).map(point).collect::<Vec<_>>()
    };
    let loops =
        |loops: Vec<Vec<DVec2>>| loops.into_iter().flat_map(|l| marked(l.into_iter().map(at))).collect();
    let flags = if light.two_sided { shared::AREA_TWO_SIDED } else { 0 }
        | if texture.is_some() { shared::AREA_TEXTURED } else { 0 };
    let ellipse = matches!(plane.outline, Outline::Ellipse);
    let kind = if ellipse { shared::AREA_ELLIPSE } else { shared::AREA_POLYGON };
    let [uv_s, uv_t] = plane.uv.map(|row| row.as_vec3().to_array());
    let size = texture.map_or([0, 0], |levels| levels[0].size);
    let record = AreaRecord {
        center: at(DVec2::ZERO).to_array(),
        kind: kind | flags,
        u: plane.u.as_vec3().to_array(),
        v: plane.v.as_vec3().to_array(),
        normal: plane.u.cross(plane.v).normalize_or_zero().as_vec3().to_array(),
        extent: plane.extent() as f32,
        radiance: light.radiance.to_array(),
        uv_s,
        uv_t,
        size: size[0] as u32 | (size[1] as u32) << 16,
        ..AreaRecord::default()
    };
    Parts {
        record,
        rings: loops(rings),
        pieces: loops(pieces),
        coarse: points(Choice::Coarse),
        fine: points(Choice::Fine),
    }
}

fn line(light: &AreaLight, [a, b]: [DVec3; 2], radius: f64) -> Parts {
    let along = b - a;
    let points = |choice| {
        let at = |x: f64| (a + along * (0.5 + 0.5 * x)).as_vec3();
        let point = |[x, share]: [f64; 2]| point(at(x), share * along.length(), light.radiance.as_dvec3());
        cubature::line(choice).into_iter().map(point).collect::<Vec<_>>()
    };
    let record = AreaRecord {
        center: a.as_vec3().to_array(),
        kind: shared::AREA_LINE,
        u: along.as_vec3().to_array(),
        extent: (0.5 * along.length()).hypot(radius) as f32,
        radius: radius as f32,
        radiance: light.radiance.to_array(),
        ..AreaRecord::default()
    };
    Parts {
        record,
        rings: vec![],
        pieces: vec![],
        coarse: points(Choice::Coarse),
        fine: points(Choice::Fine),
    }
}

/// Clamped to what float32 multiplies without overflow.
fn point(position: Vec3, weight: f64, radiance: DVec3) -> AreaPoint {
    AreaPoint {
        position: position.to_array(),
        weight: weight.min(LARGEST) as f32,
        radiance: radiance.min(DVec3::splat(LARGEST)).as_vec3().to_array(),
    }
}

/// The point that stands for all others: their sum, where their light has its middle.
fn whole(points: &[AreaPoint]) -> AreaPoint {
    let mut area = 0.0;
    let (mut sum, mut light, mut middle) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for point in points {
        let (position, radiance) =
            (Vec3::from(point.position).as_dvec3(), Vec3::from(point.radiance).as_dvec3());
        let weight = f64::from(point.weight);
        // A black light has its middle where its area has.
        let power = weight * (radiance.element_sum() + f64::MIN_POSITIVE);
        area += weight;
        sum += weight * radiance;
        light += power;
        middle += power * position;
    }
    // A sliver that no triangle is left of has no points.
    let middle = if light > 0.0 { middle / light } else { DVec3::ZERO };
    point(middle.as_vec3(), area, if area > 0.0 { sum / area } else { DVec3::ZERO })
}

fn marked(ring: impl ExactSizeIterator<Item = Vec3>) -> impl Iterator<Item = [f32; 4]> {
    let last = ring.len() - 1;
    ring.enumerate().map(move |(i, p)| p.extend(if i == last { 1.0 } else { 0.0 }).to_array())
}
