//! What leaves the lights: rays with the flux that each of them carries.
//!
//! A light is chosen in proportion to its power, then a place on it and a direction, so that flux over density is the
//! same for all rays of a light, but for textures, whose texels it follows in steps. The mean over rays is the light's
//! flux, exactly.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::area::Area;
use super::steps::Steps;
use crate::reference::bsdf::sampling::cosine;
use crate::reference::lights::falloff;
use crate::reference::rays::Ray;
use crate::reference::sampler::concentric_disk;
use crate::reference::shading::Frame;
use crate::reference::visibility::MARGIN;
use crate::scene::{Luminaire, PointLight, Scene};

/// A ray from a light.
#[derive(Clone, Copy, Debug)]
pub struct Emission {
    /// From the light outwards.
    pub ray: Ray,
    /// Distance from which on it meets surfaces: the light itself is none.
    pub t_min: f64,
    /// Flux over density, W.
    pub flux: DVec3,
    /// Whose falloff the flux still lacks.
    falloff: Option<Option<f64>>,
}

impl Emission {
    /// The share of the flux that is left at a distance: a point light's falloff over 1/d², 0 beyond its range.
    #[must_use]
    pub fn left_at(&self, distance: f64) -> f64 {
        let squared = distance * distance;
        self.falloff.map_or(1.0, |range| falloff(squared, range) * squared)
    }
}

/// A point of an area light with the light that leaves it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// World position.
    pub position: DVec3,
    /// Unit, of the side that emits.
    pub normal: DVec3,
    /// Radiance over density per area, W·sr⁻¹.
    pub intensity: DVec3,
    /// Largest coordinate of the light about the origin asked for, metres.
    pub reach: f64,
}

/// A light of the scene.
#[derive(Clone, Debug)]
enum Source<'a> {
    Point(PointLight),
    Area(Area<'a>),
    Sky(Sky),
}

/// The background, from infinity through the sphere around all triangles.
#[derive(Clone, Copy, Debug)]
struct Sky {
    radiance: DVec3,
    center: DVec3,
    radius: f64,
    /// Distance from the centre beyond which nothing is, luminaires included.
    beyond: f64,
}

/// Everything in a scene that emits.
#[derive(Clone, Debug)]
pub struct Sources<'a> {
    sources: Vec<Source<'a>>,
    by_power: Steps,
    areas: Vec<Area<'a>>,
    areas_by_power: Steps,
}

impl<'a> Sources<'a> {
    /// Area lights, point lights at a time in seconds, and the background.
    #[must_use]
    pub fn new(scene: &'a Scene, time: f64) -> Self {
        let areas: Vec<_> = scene.area_lights.iter().map(|light| Area::new(light, &scene.textures)).collect();
        let points = scene.point_lights_at(time).into_iter().map(Source::Point);
        let sources: Vec<_> = areas
            .iter()
            .cloned()
            .map(Source::Area)
            .chain(points)
            .chain(Sky::new(scene).map(Source::Sky))
            .collect();
        let by_power = Steps::new(sources.iter().map(Source::power));
        let areas_by_power = Steps::new(areas.iter().map(Area::power));
        Self { sources, by_power, areas, areas_by_power }
    }

    /// Flux of all lights in the mean channel, W; of textured ones about, of lights with a range as if they had none.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.by_power.total()
    }

    /// The ray of five numbers in [0, 1), of which `choice` chooses the light. `None` where nothing emits.
    #[must_use]
    pub fn ray(&self, choice: f64, xi: [DVec2; 2]) -> Option<Emission> {
        let pick = self.by_power.pick(choice)?;
        let emission = match &self.sources[pick.index] {
            Source::Point(light) => from_point(light, xi[1]),
            Source::Area(area) => from_area(area, pick.within, xi)?,
            Source::Sky(sky) => sky.ray(xi),
        };
        Some(Emission { flux: emission.flux / pick.probability, ..emission })
    }

    /// The point of an area light of three numbers in [0, 1), its largest coordinate about `origin`.
    #[must_use]
    pub fn place(&self, choice: f64, xi: DVec2, origin: DVec3) -> Option<Place> {
        let pick = self.areas_by_power.pick(choice)?;
        let area = &self.areas[pick.index];
        let (point, intensity) = area.point(xi)?;
        let (side, sides) = side(area, pick.within);
        let intensity = intensity * (sides / pick.probability);
        let reach = area.reach(origin);
        Some(Place { position: point.position, normal: side * point.normal, intensity, reach })
    }
}

/// Which side a number in [0, 1) chooses, and over its probability.
fn side(area: &Area, xi: f64) -> (f64, f64) {
    match area.two_sided {
        true if xi < 0.5 => (-1.0, 2.0),
        true => (1.0, 2.0),
        false => (1.0, 1.0),
    }
}

impl Source<'_> {
    fn power(&self) -> f64 {
        match self {
            Self::Point(light) => 4.0 * PI * light.intensity.as_dvec3().element_sum() / 3.0,
            Self::Area(area) => area.power(),
            Self::Sky(sky) => sky.flux().element_sum() / 3.0,
        }
    }
}

fn from_point(light: &PointLight, xi: DVec2) -> Emission {
    let position = light.position.as_dvec3();
    Emission {
        ray: Ray::new(position, on_sphere(xi)),
        t_min: 0.0,
        flux: 4.0 * PI * light.intensity.as_dvec3(),
        falloff: Some(light.range.map(f64::from)),
    }
}

fn from_area(area: &Area, choice: f64, xi: [DVec2; 2]) -> Option<Emission> {
    let (point, intensity) = area.point(xi[0])?;
    let (side, sides) = side(area, choice);
    let direction = Frame::about(side * point.normal).to_world(cosine(xi[1])).normalize();
    Some(Emission {
        ray: Ray::new(point.position, direction),
        t_min: MARGIN * point.position.abs().max_element(),
        flux: intensity * (PI * sides),
        falloff: None,
    })
}

impl Sky {
    /// `None` where it is black, or nothing is lit.
    fn new(scene: &Scene) -> Option<Self> {
        let radiance = DVec3::from_array(scene.render.background.map(f64::from));
        let places = || scene.meshes.iter().flat_map(|mesh| &mesh.vertices);
        let place = |position: [f32; 3]| DVec3::from_array(position.map(f64::from));
        let all = places().map(|vertex| place(vertex.position));
        let [low, high] =
            all.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)]);
        if radiance == DVec3::ZERO || low.x > high.x {
            return None;
        }
        let center = 0.5 * (low + high);
        let distance = |p: [f32; 3]| place(p).distance(center);
        let radius = places().map(|vertex| distance(vertex.position)).fold(0.0, f64::max);
        let seen = scene.area_lights.iter().filter(|light| light.visible).map(Luminaire::new);
        let seen = seen.flat_map(|surface| surface.vertices).map(|vertex| distance(vertex.position));
        // Edges of a cylinder's polygon cut into it: twice its distance lies beyond it.
        let beyond = 2.0 * seen.fold(radius, f64::max);
        Some(Self { radiance, center, radius, beyond })
    }

    /// Through the sphere, from all sides.
    fn flux(&self) -> DVec3 {
        self.radiance * (4.0 * PI * PI * self.radius * self.radius)
    }

    fn ray(&self, xi: [DVec2; 2]) -> Emission {
        let frame = Frame::about(on_sphere(xi[1]));
        let place = self.radius * concentric_disk(xi[0]);
        let origin = self.center + frame.to_world(place.extend(-self.beyond));
        Emission { ray: Ray::new(origin, frame.normal), t_min: 0.0, flux: self.flux(), falloff: None }
    }
}

/// All directions alike.
fn on_sphere(xi: DVec2) -> DVec3 {
    let z = 1.0 - 2.0 * xi.x;
    let (sin, cos) = (2.0 * PI * xi.y).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cos, r * sin, z)
}
