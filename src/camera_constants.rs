//! From a camera to what the shaders know of it; everything is computed in double precision.

use crate::scene::{Camera, Projection};
use crate::shared::{FrameConstants, MAX_SLICES, TILE_SIZE, mat4};
use glam::{DVec2, DVec3};

/// Octaves of depth that get slices of their own; what is nearer shares slice 0.
const OCTAVES: f64 = 10.0;
/// A tile whose side is less than this share of the lights' range needs no slices …
const FINE: f64 = 0.05;
/// … within this many ranges of the eye.
const NEAR: f64 = 4.0;

/// How pixels are parted into clusters. No light depends on it, but how many are tested and evaluated in vain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClusterShape {
    /// Depth of a cluster, relative to its tile's side.
    pub depth: f64,
    /// A tile whose side is at least this share of the lights' range has clusters for each quadrant.
    pub split: f64,
}

impl Default for ClusterShape {
    /// As deep as wide: Olsson et al. 2012. `scenes/million.toml` evaluates 1.64 pairs for a useful one without quadrants, 1.29
    /// with all tiles split.
    fn default() -> Self {
        Self { depth: 1.0, split: 0.18 }
    }
}

/// Fills in the camera's part of the constants; the other fields are zero.
///
/// `size` in pixels; `jitter` in pixels, from the pixel's centre; `bounds` of the scene, which set the slices and the
/// far plane of an orthographic camera without one; `range` of typical point lights, metres, 0 without any.
#[must_use]
pub fn camera_constants(
    camera: &Camera,
    size: [u32; 2],
    jitter: [f64; 2],
    bounds: Option<[DVec3; 2]>,
    range: f32,
    shape: ClusterShape,
) -> FrameConstants {
    let view = View::new(camera, size, jitter, bounds);
    let slices = view.slices(f64::from(range), shape);
    let rays = view.rays();
    FrameConstants {
        clip_from_eye: view.clip_from_eye(),
        eye: single(camera.position),
        forward: single(view.basis.forward),
        ray_origin: single(rays.origin[0]),
        ray_origin_dx: single(rays.origin[1]),
        ray_origin_dy: single(rays.origin[2]),
        ray_direction: single(rays.direction[0]),
        ray_direction_dx: single(rays.direction[1]),
        ray_direction_dy: single(rays.direction[2]),
        view_depth: view.view_depth(),
        slice_start: slices.start as f32,
        slice_scale: slices.scale as f32,
        slice_count: slices.count,
        split_slice: slices.split,
        size,
        tiles: size.map(|side| side.div_ceil(TILE_SIZE)),
        ..FrameConstants::default()
    }
}

fn single(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

/// A camera over a picture.
struct View<'a> {
    camera: &'a Camera,
    basis: crate::scene::camera::Basis,
    size: DVec2,
    jitter: DVec2,
    /// Half the picture: tangents of the half angles, or metres.
    half: DVec2,
    perspective: bool,
    far: Option<f64>,
    /// View depths of the scene.
    depths: [f64; 2],
}

/// Affine in the pixel coordinate: constant, per x, per y.
struct Rays {
    origin: [DVec3; 3],
    direction: [DVec3; 3],
}

impl<'a> View<'a> {
    fn new(camera: &'a Camera, size: [u32; 2], jitter: [f64; 2], bounds: Option<[DVec3; 2]>) -> Self {
        let size = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let (half_height, perspective) = match camera.projection {
            Projection::Perspective { vertical_fov } => ((vertical_fov.to_radians() / 2.0).tan(), true),
            Projection::Orthographic { height } => (height / 2.0, false),
        };
        let basis = camera.basis();
        let depths = depth_range(camera, basis.forward, bounds);
        // An orthographic depth is linear and cannot be infinite: the scene's end is far enough.
        let far = camera.far.or((!perspective).then_some(depths[1] * 1.001 + 1e-3));
        let half = DVec2::new(half_height * size.x / size.y, half_height);
        Self { camera, basis, size, jitter: DVec2::from(jitter), half, perspective, far, depths }
    }

    /// Reversed depth: near to 1, far to 0.
    fn clip_from_eye(&self) -> mat4 {
        let shift = -2.0 * self.jitter / self.size;
        let x = self.basis.right / self.half.x;
        // Vulkan's y points down.
        let y = -self.basis.up / self.half.y;
        let forward = self.basis.forward;
        let near = self.camera.near;
        let zero = DVec3::ZERO;
        let (x, y, z, w) = match (self.perspective, self.far) {
            (true, None) => {
                ((x + shift.x * forward, 0.0), (y + shift.y * forward, 0.0), (zero, near), (forward, 0.0))
            }
            (true, Some(far)) => (
                (x + shift.x * forward, 0.0),
                (y + shift.y * forward, 0.0),
                (-forward * near / (far - near), near * far / (far - near)),
                (forward, 0.0),
            ),
            (false, far) => {
                let far = far.unwrap_or(near + 1.0);
                ((x, shift.x), (y, shift.y), (-forward / (far - near), far / (far - near)), (zero, 1.0))
            }
        };
        // Rows to columns.
        let rows = [x, y, z, w];
        std::array::from_fn(|column| {
            std::array::from_fn(|row| {
                let (linear, constant) = rows[row];
                (if column < 3 { linear[column] } else { constant }) as f32
            })
        })
    }

    fn view_depth(&self) -> [f32; 4] {
        let near = self.camera.near;
        let row = match (self.perspective, self.far) {
            (true, None) => [near, 0.0, 0.0, 1.0],
            (true, Some(far)) => [near * far, 0.0, near, far - near],
            (false, far) => {
                let far = far.unwrap_or(near + 1.0);
                [far, near - far, 1.0, 0.0]
            }
        };
        row.map(|value| value as f32)
    }

    fn rays(&self) -> Rays {
        let right = self.basis.right * self.half.x;
        let up = self.basis.up * self.half.y;
        // Pixel coordinate p plus jitter, to [−1, 1] with y up.
        let start = right * (2.0 * self.jitter.x / self.size.x - 1.0)
            + up * (1.0 - 2.0 * self.jitter.y / self.size.y);
        let spread = [start, right * 2.0 / self.size.x, -up * 2.0 / self.size.y];
        let forward = self.basis.forward;
        if self.perspective {
            Rays { origin: [DVec3::ZERO; 3], direction: [forward + spread[0], spread[1], spread[2]] }
        } else {
            Rays { origin: spread, direction: [forward, DVec3::ZERO, DVec3::ZERO] }
        }
    }

    /// Depth slices where typical lights have the range.
    fn slices(&self, range: f64, shape: ClusterShape) -> Slices {
        let most = f64::from(MAX_SLICES - 1);
        let [nearest, farthest] = self.depths;
        let tile = f64::from(TILE_SIZE) * 2.0 * self.half.y / self.size.y;
        let split = |slice: f64, count: u32| {
            // Without such lights there are no lists to keep short.
            if range > 0.0 { (slice.ceil().max(0.0) as u32).min(count) } else { count }
        };
        if self.perspective {
            let fine = (FINE * range / tile).min(NEAR * range).min(farthest / 2.0);
            let start = nearest.max(farthest / OCTAVES.exp2()).max(fine);
            let octaves = (farthest / start).log2().max(1e-3);
            let scale = (1.0 / (1.0 + shape.depth * tile).log2()).min((most - 1.0) / octaves);
            let count = (octaves * scale).ceil() as u32 + 1;
            let wide = 1.0 + scale * (shape.split * range / tile / start).max(f64::MIN_POSITIVE).log2();
            Slices { start, scale, count, split: split(wide, count) }
        } else {
            let depth = (farthest - nearest).max(1e-6);
            let scale = (1.0 / (shape.depth * tile)).min(most / depth);
            let count = ((depth * scale).ceil() as u32).max(1);
            let wide = if tile < shape.split * range { f64::INFINITY } else { 0.0 };
            Slices { start: nearest, scale: -scale, count, split: split(wide, count) }
        }
    }
}

/// As `FrameConstants` means them.
struct Slices {
    start: f64,
    scale: f64,
    count: u32,
    split: u32,
}

/// Nearest and farthest view depth of the scene, in front of the near plane.
fn depth_range(camera: &Camera, forward: DVec3, bounds: Option<[DVec3; 2]>) -> [f64; 2] {
    let Some([lower, upper]) = bounds else {
        return [camera.near, camera.near * 2.0];
    };
    let depths = (0..8).map(|corner| {
        let pick = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2));
        (lower + (upper - lower) * pick - camera.position).dot(forward)
    });
    let (least, most) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(z), b.max(z)));
    let nearest = least.max(camera.near);
    [nearest, camera.far.map_or(most, |far| most.min(far)).max(nearest * 1.001)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(projection: Projection, far: Option<f64>) -> Camera {
        Camera {
            name: "c".into(),
            position: DVec3::new(1.0, 2.0, 3.0),
            target: DVec3::new(0.5, 1.5, -2.0),
            up: DVec3::Y,
            projection,
            near: 0.1,
            far,
            path: Vec::new(),
        }
    }

    /// A world point goes through the matrix and comes back by depth and ray.
    #[test]
    fn clip_space_and_rays_are_inverse() {
        let bounds = Some([DVec3::splat(-5.0), DVec3::splat(5.0)]);
        for (projection, far) in [
            (Projection::Perspective { vertical_fov: 50.0 }, None),
            (Projection::Perspective { vertical_fov: 50.0 }, Some(40.0)),
            (Projection::Orthographic { height: 6.0 }, None),
            (Projection::Orthographic { height: 6.0 }, Some(40.0)),
        ] {
            let camera = camera(projection, far);
            for jitter in [[0.0, 0.0], [0.3, -0.4]] {
                let c = camera_constants(&camera, [320, 200], jitter, bounds, 0.0, ClusterShape::default());
                let p = DVec3::new(0.2, 1.1, -1.3);
                let rel = (p - camera.position).extend(1.0);
                let clip: [f64; 4] = std::array::from_fn(|row| {
                    (0..4).map(|k| f64::from(c.clip_from_eye[k][row]) * rel[k]).sum()
                });
                let depth = clip[2] / clip[3];
                assert!(depth > 0.0 && depth < 1.0);
                // Framebuffer coordinates, whose pixel centres are half-integers.
                let x = (clip[0] / clip[3] + 1.0) * 160.0;
                let y = (clip[1] / clip[3] + 1.0) * 100.0;
                let v = c.view_depth.map(f64::from);
                let z = (v[0] + v[1] * depth) / (v[2] + v[3] * depth);
                let d = |a: [f32; 3]| glam::Vec3::from(a).as_dvec3();
                let back = d(c.eye)
                    + d(c.ray_origin)
                    + x * d(c.ray_origin_dx)
                    + y * d(c.ray_origin_dy)
                    + z * (d(c.ray_direction) + x * d(c.ray_direction_dx) + y * d(c.ray_direction_dy));
                assert!((back - p).length() < 1e-4, "{back} {p}");
            }
        }
    }

    #[test]
    fn slices_stay_in_range_for_any_depth() {
        for far in [1.0, 10.0, 1e3, 1e6] {
            let bounds = Some([DVec3::splat(-far), DVec3::splat(far)]);
            for projection in
                [Projection::Perspective { vertical_fov: 1.0 }, Projection::Orthographic { height: 0.1 }]
            {
                for range in [0.0, 1e-6, 1.0, 1e6] {
                    let camera = camera(projection, None);
                    let shape = ClusterShape::default();
                    let c = camera_constants(&camera, [64, 64], [0.0; 2], bounds, range, shape);
                    assert!(c.slice_count >= 1 && c.slice_count <= MAX_SLICES, "{}", c.slice_count);
                    assert!(c.slice_start > 0.0 && c.slice_scale.is_finite());
                    assert!(c.split_slice <= c.slice_count);
                }
            }
        }
    }
}
