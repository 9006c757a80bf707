//! Light paths, and the lights that they leave (Keller 1997, *Instant Radiosity*).
//!
//! 1. A pilot of paths says how many lights one leaves, and so how many paths to trace. What it found is thrown away:
//!    neither number nor light of the real paths depends on them.
//! 2. Path i of n takes its light by (i + ξ)/n, place and direction from a rank-1 sequence with a random shift, and
//!    hashes of (seed, i) for all that follows: the same lights on any number of threads.
//! 3. Every surface that a path meets gets a light. From the second surface on Russian roulette decides whether the path
//!    comes that far, by how much of the largest channel is left: paths thin out as their light does, and lights of
//!    every depth are of about the same power.
//! 4. Light goes on by the adjoint BSDF, which differs where shading normals do (Veach 1997, *Robust Monte Carlo Methods
//!    for Light Transport Simulation*, 5.3). Luminaires that are seen absorb, and so do backs of one-sided surfaces.

use std::f64::consts::FRAC_1_PI;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::emit::{Emission, Sources};
use super::lambert::lambert;
use super::{LightSet, light_at, spacing};
use crate::reference::area::Emitter;
use crate::reference::rays::{Geometry, Hit, Ray};
use crate::reference::sampler::{Random, hash};
use crate::reference::shading::Surface;
use crate::reference::visibility::MARGIN;
use crate::scene::Scene;
use crate::shared::VirtualLight;

/// Paths of the pilot: their mean is within 1 %.
const PILOT: usize = 16_384;
/// Paths for each light wanted at most, where hardly any meets a surface.
const MOST_PATHS: usize = 16;
/// Standard deviations by which the lights wanted exceed those expected.
const SAFETY: f64 = 4.0;
/// Points on area lights at most: as many as that, and their spread is less than the gather's.
const MOST_EMITTERS: usize = 4096;
/// And at least: paths find the light of these alone where there are hardly any virtual lights.
const LEAST_EMITTERS: usize = 256;
/// Paths that one task traces.
const CHUNK: usize = 512;
/// Whether to go on with a long job; a job may be paused by keeping it waiting for the answer.
pub type Proceed<'a> = &'a (dyn Fn() -> bool + Sync);

/// No triangle.
const NOWHERE: (usize, usize) = (usize::MAX, usize::MAX);

/// Lights that paths leave, in number: moments over the pilot's paths.
#[derive(Clone, Copy, Debug, Default)]
struct Yield {
    mean: f64,
    variance: f64,
}

/// A scene ready for light paths.
#[derive(Debug)]
pub struct Tracer<'a> {
    scene: &'a Scene,
    geometry: Geometry<'a>,
    /// Those that are seen, and so absorb.
    luminaires: Vec<Emitter<'a>>,
    sources: Sources<'a>,
    origin: DVec3,
    pilot: Yield,
}

impl<'a> Tracer<'a> {
    /// Makes ready what every path needs, with moving lights where they are at time 0. Lights will be relative to `origin`.
    #[must_use]
    pub fn new(scene: &'a Scene, origin: glam::Vec3) -> Self {
        Self::at(scene, origin, 0.0)
    }

    /// As [`Tracer::new`], with moving lights where they are at a time in seconds.
    #[must_use]
    pub fn at(scene: &'a Scene, origin: glam::Vec3, time: f64) -> Self {
        let seen = scene.area_lights.iter().filter(|light| light.visible);
        let mut tracer = Self {
            scene,
            geometry: Geometry::new(scene),
            luminaires: seen.map(|light| Emitter::new(light, &scene.textures)).collect(),
            sources: Sources::new(scene, time),
            origin: origin.as_dvec3(),
            pilot: Yield::default(),
        };
        tracer.pilot = tracer.explore();
        tracer
    }

    /// A set of lights, of about and, with odds of 30,000 to 1, at most `count` of reflected light: as many as so many
    /// paths leave. Sets of different seeds are independent; the mean over seeds of what all bounced lights together do
    /// is what all Lambertian shares of the surfaces do, of up to `bounces` bounces.
    #[must_use]
    pub fn trace(&self, count: usize, seed: u64) -> LightSet {
        self.trace_while(count, seed, &|| true).unwrap_or_default()
    }

    /// As [`Tracer::trace`]; asks between tasks of a millisecond or two whether to go on, which may take its time to
    /// answer. `None` where the answer was no.
    #[must_use]
    pub fn trace_while(&self, count: usize, seed: u64, proceed: Proceed<'_>) -> Option<LightSet> {
        let paths = self.paths(count);
        let bounced = self.bounced(paths, hash(&[seed, 0]), proceed)?.concat();
        let emitters = self.emitters((count / 4).clamp(LEAST_EMITTERS, MOST_EMITTERS), hash(&[seed, 1]));
        proceed().then(|| LightSet { spacing: spacing(&bounced), emitters, bounced, paths })
    }

    fn explore(&self) -> Yield {
        let lights = |path| {
            let mut out = vec![];
            self.path(path, PILOT, 0, &mut out);
            out.len() as f64
        };
        let counts: Vec<f64> = (0..PILOT).into_par_iter().map(lights).collect();
        let mean = counts.iter().sum::<f64>() / PILOT as f64;
        let squares: f64 = counts.iter().map(|count| (count - mean).powi(2)).sum();
        Yield { mean, variance: squares / (PILOT - 1) as f64 }
    }

    /// Paths such that the lights expected, and `SAFETY` standard deviations of their number and of the pilot's mean,
    /// are `count`.
    fn paths(&self, count: usize) -> usize {
        let Yield { mean, variance } = self.pilot;
        if mean == 0.0 || count == 0 {
            return count;
        }
        let wanted = count as f64;
        let most = (MOST_PATHS * count) as f64;
        let all = (wanted / mean).min(most);
        let deviation = SAFETY * (variance * all * (1.0 + all / PILOT as f64)).sqrt();
        // At least half: of a few lights the deviation is more than all.
        ((wanted - deviation).max(0.5 * wanted) / mean).clamp(1.0, most) as usize
    }

    /// The lights of so many paths, in their order.
    fn bounced(&self, paths: usize, seed: u64, proceed: Proceed<'_>) -> Option<Vec<Vec<VirtualLight>>> {
        let chunk = |first: usize| {
            let mut out = Vec::with_capacity(4 * CHUNK);
            (first..paths.min(first + CHUNK)).for_each(|path| self.path(path, paths, seed, &mut out));
            out
        };
        let chunks = (0..paths.div_ceil(CHUNK)).into_par_iter();
        chunks.map(|index| proceed().then(|| chunk(index * CHUNK))).collect()
    }

    /// Points on area lights, each in proportion to its power.
    fn emitters(&self, count: usize, seed: u64) -> Vec<VirtualLight> {
        let sequence = Sequence::new(seed);
        let light = |index: usize| {
            let choice = (index as f64 + Random::new(hash(&[seed, index as u64])).next()) / count as f64;
            let place = self.sources.place(choice, sequence.point(index)[0], self.origin)?;
            let color = place.intensity / count as f64;
            let position = place.position - self.origin;
            (color != DVec3::ZERO).then(|| light_at(position, place.normal, place.reach, color, 0))
        };
        (0..count).into_par_iter().filter_map(light).collect()
    }

    /// Follows path `index` of so many, and leaves its lights.
    fn path(&self, index: usize, paths: usize, seed: u64, out: &mut Vec<VirtualLight>) {
        let mut random = Random::new(hash(&[seed, index as u64]));
        let choice = (index as f64 + random.next()) / paths as f64;
        let Some(emission) = self.sources.ray(choice, Sequence::new(seed).point(index)) else { return };
        let mut flux = emission.flux / paths as f64;
        let Emission { mut ray, mut t_min, .. } = emission;
        let mut from = NOWHERE;
        for depth in 1..=self.scene.render.bounces {
            let Some(hit) = self.next(&ray, t_min, from) else { return };
            if depth == 1 {
                flux *= emission.left_at(hit.t);
            }
            let Some(vertex) = Vertex::new(self, &ray, &hit).filter(|_| flux != DVec3::ZERO) else { return };
            out.extend(vertex.light(self, flux, depth));
            if depth == self.scene.render.bounces {
                return;
            }
            let Some((direction, weight)) = vertex.scatter(random.pair()) else { return };
            let reflected = flux * weight;
            let survival = (reflected.max_element() / flux.max_element()).min(1.0);
            if survival.is_nan() || random.next() >= survival {
                return;
            }
            flux = reflected / survival;
            t_min = MARGIN * vertex.surface.position.abs().max_element().max(hit.t);
            ray = Ray::new(vertex.surface.position, direction);
            from = (hit.mesh, hit.triangle);
        }
    }

    /// The nearest surface along a ray, where it reflects.
    fn next(&self, ray: &Ray, t_min: f64, from: (usize, usize)) -> Option<Hit> {
        let hit = self.geometry.wall(ray, t_min, from).filter(|hit| self.geometry.drawn(hit))?;
        let mut luminaires = self.luminaires.iter().filter_map(|luminaire| luminaire.occluder(ray));
        (!luminaires.any(|t| (t_min..hit.t).contains(&t))).then_some(hit)
    }
}

/// A surface on the path, seen from where its light comes from.
struct Vertex {
    surface: Surface,
    /// Geometric, unit, on the lit side.
    normal: DVec3,
    /// Largest coordinate of its triangle about the device's origin.
    reach: f64,
    /// Cosine of the shading normal to the light over that of the geometric one.
    tilt: f64,
}

impl Vertex {
    /// `None` where the surface reflects nothing of the light.
    fn new(tracer: &Tracer, ray: &Ray, hit: &Hit) -> Option<Self> {
        let surface = Surface::new(tracer.scene, ray, hit);
        let normal = tracer.geometry.normal(hit).normalize();
        let normal = if hit.front { normal } else { -normal };
        let cosine = -normal.dot(ray.direction);
        let mesh = &tracer.scene.meshes[hit.mesh];
        let coordinate = |&corner: &u32| {
            let place = DVec3::from_array(mesh.vertices[corner as usize].position.map(f64::from));
            (place - tracer.origin).abs().max_element()
        };
        let reach = mesh.triangles[hit.triangle].iter().map(coordinate).fold(0.0, f64::max);
        // A two-sided normal turns to the light, the viewer's to the viewer: where it turns away from the lit side these see
        // nothing of the light.
        let lit = surface.wo.z > 0.0 && cosine > 0.0 && surface.frame.normal.dot(normal) > 0.0;
        lit.then_some(Self { surface, normal, reach, tilt: surface.wo.z / cosine })
    }

    /// What the surface's Lambertian share makes of the flux.
    fn light(&self, tracer: &Tracer, flux: DVec3, depth: u32) -> Option<VirtualLight> {
        let color = flux * lambert(&self.surface.bsdf) * (FRAC_1_PI * self.tilt);
        let position = self.surface.position - tracer.origin;
        (color != DVec3::ZERO).then(|| light_at(position, self.normal, self.reach, color, depth))
    }

    /// Where the light goes, and how much of it: the adjoint BSDF times the cosine over the density.
    fn scatter(&self, xi: DVec2) -> Option<(DVec3, DVec3)> {
        let Surface { frame, wo, bsdf, .. } = &self.surface;
        let local = bsdf.sample(*wo, xi);
        let pdf = bsdf.pdf(*wo, local);
        let direction = frame.to_world(local).normalize();
        let cosine = self.normal.dot(direction);
        (pdf > 0.0 && cosine > 0.0).then(|| (direction, bsdf.eval(*wo, local) * (self.tilt * cosine / pdf)))
    }
}

/// Roberts' rank-1 sequence of four dimensions, shifted at random: each point is uniform, and neighbours are well spread.
struct Sequence {
    shift: [DVec2; 2],
}

impl Sequence {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(hash(&[seed, u64::MAX]));
        Self { shift: [random.pair(), random.pair()] }
    }

    fn point(&self, index: usize) -> [DVec2; 2] {
        // Powers of 1/g, g the real root of x⁵ = x + 1.
        const STEPS: [DVec2; 2] = [
            DVec2::new(0.856_674_883_854_502_9, 0.733_891_856_627_126),
            DVec2::new(0.628_706_721_037_808_7, 0.538_597_257_223_610_1),
        ];
        [0, 1].map(|pair| (self.shift[pair] + index as f64 * STEPS[pair]).fract())
    }
}
