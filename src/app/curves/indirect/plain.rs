//! Virtual lights without a tree: every one of them at every pixel, in double precision (Keller 1997, *Instant
//! Radiosity*), and the same with the geometry term clamped, as is usual. What the clamp takes away is lost, and so is
//! all that surfaces reflect but by their Lambertian share.

use super::figures::{Family, Sample};
use super::truth::Truth;
use crate::image::HdrImage;
use crate::reference::area::Emitter;
use crate::reference::rays::{Geometry, camera_ray};
use crate::reference::shading::Surface;
use crate::reference::visibility::{Occluders, Shadow};
use crate::scene::Scene;
use crate::shared::VirtualLight;
use crate::virtual_lights::Tracer;
use crate::virtual_lights::octahedral::unpack_normal;
use cpu_time::ProcessTime;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::time::Instant;

/// Largest geometry term, m⁻²: that of two surfaces that face each other a third of a metre, a sixth of the room, apart.
pub(super) const CLAMP: f64 = 10.0;
/// Rounds of their own.
const FIRST: u64 = 1 << 40;

/// A scene seen from its camera, ready for shadow rays.
pub(super) struct Plain<'a> {
    scene: &'a Scene,
    origin: Vec3,
    geometry: Geometry<'a>,
    emitters: Vec<Emitter<'a>>,
}

/// Light without and with the clamp.
type Both = [DVec3; 2];

impl<'a> Plain<'a> {
    pub(super) fn new(scene: &'a Scene, origin: Vec3) -> Self {
        let emitters = scene.area_lights.iter().map(|light| Emitter::new(light, &scene.textures)).collect();
        Self { scene, origin, geometry: Geometry::new(scene), emitters }
    }

    /// A picture by about so many virtual lights, and the same with the clamp.
    pub(super) fn samples(&self, truth: &Truth, count: usize, repetition: u32) -> [Sample; 2] {
        let clocks = (Instant::now(), ProcessTime::now());
        let tracer = Tracer::new(self.scene, self.origin);
        let lights = tracer.trace(count, FIRST + u64::from(repetition)).bounced;
        let pictures = self.pictures(&lights);
        let (wall_s, cpu_s) = (clocks.0.elapsed().as_secs_f64(), clocks.1.elapsed().as_secs_f64());
        let sample = |(family, image): (Family, HdrImage)| {
            let [square, bias] = truth.judge(&image);
            Sample { family, count: count as u32, rounds: 1, cpu_s, wall_s, square, bias, estimate: None }
        };
        let [plain, clamped] = pictures;
        [(Family::Plain, plain), (Family::Clamped, clamped)].map(sample)
    }

    fn pictures(&self, lights: &[VirtualLight]) -> [HdrImage; 2] {
        let [width, height] = self.scene.render.size;
        let pixel = |index: u32| self.pixel(index % width, index / width, lights);
        let pixels: Vec<Both> = (0..width * height).into_par_iter().map(pixel).collect();
        [0, 1].map(|which| HdrImage {
            width,
            height,
            pixels: pixels.iter().map(|both| both[which].as_vec3().to_array()).collect(),
        })
    }

    fn pixel(&self, x: u32, y: u32, lights: &[VirtualLight]) -> Both {
        let view = camera_ray(
            &self.scene.cameras[0],
            self.scene.render.size,
            f64::from(x) + 0.5,
            f64::from(y) + 0.5,
        );
        let hit = self.geometry.closest(&view);
        let beyond = hit.map_or(view.t_max, |hit| hit.t);
        let mut seen = self.emitters.iter().filter_map(|emitter| emitter.seen_by(&view.ray));
        let luminaire = seen.any(|(t, _)| (view.t_min..=beyond).contains(&t));
        let Some(hit) = hit.filter(|_| !luminaire) else { return [DVec3::ZERO; 2] };
        let occluders = Occluders { geometry: &self.geometry, emitters: &self.emitters };
        let surface = Surface::new(self.scene, &view.ray, &hit);
        let shadow = Shadow::new(&occluders, &view.ray, &hit);
        let of = |light| self.reflected(&surface, &shadow, light);
        lights.iter().map(of).fold([DVec3::ZERO; 2], |[a, b], [c, d]| [a + c, b + d])
    }

    fn reflected(&self, surface: &Surface, shadow: &Shadow<'_>, light: &VirtualLight) -> Both {
        let to_light = Vec3::from(light.position).as_dvec3() + self.origin.as_dvec3() - surface.position;
        let distance = to_light.length();
        let direction = to_light / distance;
        let wi = surface.frame.to_local(direction);
        let facing = -direction.dot(unpack_normal(light.normal));
        if wi.z <= 0.0 || facing <= 0.0 {
            return [DVec3::ZERO; 2];
        }
        let reflected = surface.bsdf.eval(surface.wo, wi) * DVec3::from_array(light.color.map(f64::from));
        if reflected == DVec3::ZERO || shadow.covers(direction, distance, None) {
            return [DVec3::ZERO; 2];
        }
        let geometry = wi.z * facing / (distance * distance);
        [geometry, geometry.min(CLAMP)].map(|geometry| reflected * geometry)
    }
}
