//! What egui wants drawn, as the overlay's pass takes it.

use crate::error::Result;
use crate::passes::overlay::{Batch, Corner, Drawing, Overlay};
use egui::epaint::{ClippedPrimitive, ImageData, Primitive};
use egui::{Rect, TextureId, TexturesDelta};
use std::collections::HashMap;

/// Number of the texture that covers the whole picture; those of egui count from 0.
pub(super) const COVER: u64 = u64::MAX;

/// Textures as the host has them: egui changes parts, the pass takes wholes.
#[derive(Default)]
pub(super) struct Textures(HashMap<TextureId, Texels>);

struct Texels {
    size: [usize; 2],
    texels: Vec<[u8; 4]>,
}

impl Textures {
    /// Uploads what is new; what is to be freed was drawn for the last time before.
    pub(super) fn update(&mut self, delta: &mut TexturesDelta, pass: &mut Overlay) -> Result<()> {
        for (id, parts) in std::mem::take(&mut delta.set) {
            for part in parts {
                let ImageData::Color(image) = part.image;
                let texels: &[[u8; 4]] = bytemuck::cast_slice(&image.pixels);
                match part.pos {
                    None => {
                        self.0.insert(id, Texels { size: image.size, texels: texels.to_vec() });
                    }
                    Some(corner) => {
                        if let Some(whole) = self.0.get_mut(&id) {
                            whole.patch(corner, image.size, texels);
                        }
                    }
                }
            }
            if let Some(Texels { size, texels }) = self.0.get(&id) {
                pass.set_texture(number(id), size.map(|side| side as u32), texels)?;
            }
        }
        for id in std::mem::take(&mut delta.free) {
            self.0.remove(&id);
            pass.free_texture(number(id));
        }
        Ok(())
    }
}

impl Texels {
    fn patch(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], texels: &[[u8; 4]]) {
        for (y, row) in texels.chunks_exact(width).enumerate().take(height) {
            let begin = (top + y) * self.size[0] + left;
            self.texels[begin..begin + width].copy_from_slice(row);
        }
    }
}

/// One number for both kinds of texture.
fn number(id: TextureId) -> u64 {
    match id {
        TextureId::Managed(number) => 2 * number,
        TextureId::User(number) => 2 * number + 1,
    }
}

/// Meshes in one buffer, clipped to a canvas of `size` pixels; below them the cover, if there is one.
pub(super) fn drawing(
    primitives: Vec<ClippedPrimitive>,
    scale: f32,
    size: [u32; 2],
    covered: bool,
) -> Drawing {
    let mut drawing = if covered { cover(scale, size) } else { Drawing { scale, ..Drawing::default() } };
    for ClippedPrimitive { clip_rect, primitive } in primitives {
        let Primitive::Mesh(mesh) = primitive else { continue };
        let Some((corner, size)) = pixels(clip_rect, scale, size) else { continue };
        let first = drawing.corners.len() as u32;
        let begin = drawing.triangles.len() as u32;
        let corners = mesh.vertices.iter().map(|vertex| Corner {
            position: [vertex.pos.x, vertex.pos.y],
            uv: [vertex.uv.x, vertex.uv.y],
            color: vertex.color.to_array(),
        });
        drawing.corners.extend(corners);
        let triangles = mesh.indices.chunks_exact(3).map(|t| [first + t[0], first + t[1], first + t[2]]);
        drawing.triangles.extend(triangles);
        let triangles = begin..drawing.triangles.len() as u32;
        drawing.batches.push(Batch { texture: number(mesh.texture_id), corner, size, triangles });
    }
    drawing
}

/// The whole canvas under the texture of its size.
fn cover(scale: f32, size: [u32; 2]) -> Drawing {
    let [width, height] = size.map(|side| side as f32 / scale);
    let corner = |[u, v]: [f32; 2]| Corner { position: [u * width, v * height], uv: [u, v], color: [255; 4] };
    Drawing {
        scale,
        corners: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(corner).to_vec(),
        triangles: vec![[0, 1, 2], [1, 2, 3]],
        batches: vec![Batch { texture: COVER, corner: [0; 2], size, triangles: 0..2 }],
    }
}

/// A rectangle of points in whole pixels within the canvas: corner and size; `None` where nothing is left.
fn pixels(rect: Rect, scale: f32, size: [u32; 2]) -> Option<([u32; 2], [u32; 2])> {
    let along = |low: f32, high: f32, side: u32| {
        let [low, high] = [low, high].map(|end| ((end * scale).round().max(0.0) as u32).min(side));
        (low, high.saturating_sub(low))
    };
    let (x, width) = along(rect.min.x, rect.max.x, size[0]);
    let (y, height) = along(rect.min.y, rect.max.y, size[1]);
    (width > 0 && height > 0).then_some(([x, y], [width, height]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn rectangles_stay_on_the_canvas() {
        let whole = Rect::from_min_max(pos2(-5.0, -5.0), pos2(1e9, f32::INFINITY));
        assert_eq!(pixels(whole, 2.0, [30, 20]), Some(([0, 0], [30, 20])));
        let part = Rect::from_min_max(pos2(2.0, 3.0), pos2(4.0, 5.0));
        assert_eq!(pixels(part, 1.5, [30, 20]), Some(([3, 5], [3, 3])));
        assert_eq!(pixels(part, 1.5, [3, 20]), None);
        assert_eq!(pixels(Rect::NOTHING, 1.0, [30, 20]), None);
    }

    #[test]
    fn parts_of_a_texture_land_where_they_belong() {
        let mut whole = Texels { size: [3, 2], texels: vec![[0; 4]; 6] };
        whole.patch([1, 0], [2, 2], &[[1; 4], [2; 4], [3; 4], [4; 4]]);
        assert_eq!(whole.texels.iter().map(|t| t[0]).collect::<Vec<_>>(), [0, 1, 2, 0, 3, 4]);
    }
}
