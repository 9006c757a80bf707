//! Full light transport: paths from the eye, without bias.
//!
//! At every vertex one light is sampled, and the direction that the BSDF samples both finds lights and leads on; the
//! balance heuristic weighs the two (Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*). Beyond a
//! few bounces Russian roulette ends paths that carry little. The background shines from infinity. A luminaire that is
//! seen reflects nothing, so a path ends on it; so does one on the back of a one-sided surface.

use glam::DVec3;

use super::area::Emitter;
use super::lights::PointLights;
use super::rays::{Geometry, Hit, Ray};
use super::sampler::Random;
use super::shading::Surface;
use super::visibility::{Occluders, Prospect, Shadow};
use crate::scene::Scene;

/// Bounces before roulette, and the most likely survival after them, so that paths end in a white box too.
const SAFE_BOUNCES: u32 = 3;
const SURVIVAL: f64 = 0.95;

/// What paths need to know.
pub(super) struct Transport<'a> {
    pub(super) scene: &'a Scene,
    pub(super) occluders: &'a Occluders<'a>,
    pub(super) points: &'a PointLights,
    /// Bounces between the first surface and the light, at most.
    pub(super) bounces: u32,
    /// And at least.
    pub(super) fewest_bounces: u32,
}

/// A surface on the path.
struct Vertex<'a> {
    surface: Surface,
    shadow: Shadow<'a>,
    /// Running sums of the emitters' weights.
    choice: Vec<f64>,
}

impl Vertex<'_> {
    /// Probability that an emitter is the one sampled.
    fn probability(&self, emitter: usize) -> f64 {
        let before = if emitter == 0 { 0.0 } else { self.choice[emitter - 1] };
        let sum = self.choice.last().copied().unwrap_or(0.0);
        if sum > 0.0 { (self.choice[emitter] - before) / sum } else { 0.0 }
    }
}

impl<'a> Transport<'a> {
    /// Radiance that one path from where `ray` hit carries back along it.
    pub(super) fn radiance(&self, ray: &Ray, hit: &Hit, random: &mut Random) -> DVec3 {
        let (mut light, mut throughput) = (DVec3::ZERO, DVec3::ONE);
        let mut vertex = self.vertex(ray, hit);
        for bounce in 0.. {
            let counts = bounce >= self.fewest_bounces;
            if counts {
                light += throughput * self.sampled(&vertex, random);
            }
            let surface = &vertex.surface;
            let wi = surface.bsdf.sample(surface.wo, random.pair());
            let pdf = surface.bsdf.pdf(surface.wo, wi);
            if pdf.is_nan() || pdf <= 0.0 {
                break;
            }
            throughput *= surface.bsdf.eval(surface.wo, wi) * (wi.z / pdf);
            let world = surface.frame.to_world(wi).normalize();
            let Some(prospect) = vertex.shadow.prospect(world).filter(|_| throughput != DVec3::ZERO) else {
                break;
            };
            if counts {
                light += throughput * self.found(&vertex, &prospect, pdf);
            }
            let Some(hit) = prospect.wall.filter(|hit| bounce < self.bounces && self.geometry().drawn(hit))
            else {
                break;
            };
            if bounce >= SAFE_BOUNCES {
                let survival = throughput.max_element().min(SURVIVAL);
                if random.next() >= survival {
                    break;
                }
                throughput /= survival;
            }
            vertex = self.vertex(&prospect.ray, &hit);
        }
        light
    }

    fn geometry(&self) -> &'a Geometry<'a> {
        self.occluders.geometry
    }

    fn emitters(&self) -> &'a [Emitter<'a>] {
        self.occluders.emitters
    }

    fn vertex(&self, ray: &Ray, hit: &Hit) -> Vertex<'a> {
        let surface = Surface::new(self.scene, ray, hit);
        let mut sum = 0.0;
        let weights = self.emitters().iter().map(|emitter| {
            sum += emitter.weight(&surface);
            sum
        });
        let choice = weights.collect();
        Vertex { surface, shadow: Shadow::new(self.occluders, ray, hit), choice }
    }

    /// Light of one point light and of one point of one emitter.
    fn sampled(&self, vertex: &Vertex, random: &mut Random) -> DVec3 {
        let Vertex { surface, shadow, choice } = vertex;
        let points = self.points.reflected_by_one(surface, shadow, random.next());
        let threshold = random.next() * choice.last().copied().unwrap_or(0.0);
        let index = choice.partition_point(|upper| *upper <= threshold);
        let xi = random.pair();
        let seen = self.emitters().get(index).and_then(|e| Some((e, e.sample(surface.position, xi)?)));
        let Some((emitter, seen)) = seen else {
            return points;
        };
        let wi = surface.frame.to_local(seen.wi);
        let pdf = vertex.probability(index) * seen.pdf + surface.bsdf.pdf(surface.wo, wi);
        if wi.z <= 0.0 || pdf.is_nan() || pdf <= 0.0 {
            return points;
        }
        let light = surface.bsdf.eval(surface.wo, wi) * emitter.emitted(&seen) * (wi.z / pdf);
        let dark = light == DVec3::ZERO || shadow.covers(seen.wi, seen.distance, Some(index));
        if dark { points } else { points + light }
    }

    /// Light along a direction that the BSDF sampled with the density `pdf`.
    fn found(&self, vertex: &Vertex, prospect: &Prospect, pdf: f64) -> DVec3 {
        let Prospect { ray, range: [near, end], luminaire, wall } = prospect;
        let mut light = DVec3::ZERO;
        for (index, emitter) in self.emitters().iter().enumerate() {
            let seen = emitter.along(ray.origin, ray.direction);
            let seen = seen.filter(|s| *luminaire == Some(index) || (*near..*end).contains(&s.distance));
            if let Some(seen) = seen {
                light += emitter.emitted(&seen) * (pdf / (pdf + vertex.probability(index) * seen.pdf));
            }
        }
        if luminaire.is_none() && wall.is_none() {
            light += DVec3::from_array(self.scene.render.background.map(f64::from));
        }
        light
    }
}
