//! Point lights: falloff, the exact sum over all of them or over those in sight, and which of them reach a place.

use glam::DVec3;

use super::shading::Surface;
pub use super::tree::Bounds;
use super::tree::Tree;
use super::visibility::Shadow;
use crate::scene::PointLight;

/// Radiant intensity to irradiance at normal incidence, m⁻²: the window (1 − (d/range)⁴)²₊ on 1/max(d², 1e-4), or pure
/// 1/max(d², 1e-12) without a range.
#[must_use]
pub fn falloff(distance_squared: f64, range: Option<f64>) -> f64 {
    let Some(range) = range else {
        return 1.0 / distance_squared.max(1e-12);
    };
    let ratio2 = distance_squared / (range * range);
    let window = (1.0 - ratio2 * ratio2).max(0.0);
    window * window / distance_squared.max(1e-4)
}

/// A light in double precision.
#[derive(Clone, Copy, Debug)]
struct Light {
    position: DVec3,
    intensity: DVec3,
    range: Option<f64>,
}

/// The point lights of a scene. Lights with a range lie in a tree by their range's box: beyond it a light contributes
/// exactly 0, so leaving it out changes nothing.
#[derive(Debug)]
pub struct PointLights {
    unranged: Vec<Light>,
    ranged: Vec<Light>,
    tree: Tree,
}

impl PointLights {
    /// Sorts the lights by whether they have a range.
    #[must_use]
    pub fn new(lights: &[PointLight]) -> Self {
        let light = |light: &PointLight| Light {
            position: light.position.as_dvec3(),
            intensity: light.intensity.as_dvec3(),
            range: light.range.map(f64::from),
        };
        let (ranged, unranged): (Vec<_>, Vec<_>) =
            lights.iter().map(light).partition(|light| light.range.is_some());
        let bounds = |light: &Light| {
            let reach = DVec3::splat(light.range.unwrap_or(0.0));
            Bounds { min: light.position - reach, max: light.position + reach }
        };
        let boxes: Vec<_> = ranged.iter().map(bounds).collect();
        Self { unranged, ranged, tree: Tree::new(&boxes) }
    }

    /// Reflected radiance Σ f cosθ I falloff(d) of the lights that `shadow` leaves, all of them without one.
    #[must_use]
    pub fn reflected(&self, surface: &Surface, shadow: Option<&Shadow>) -> DVec3 {
        let every: DVec3 = self.unranged.iter().map(|light| light.reflected(surface, shadow)).sum();
        let mut near = DVec3::ZERO;
        self.tree.at_point(surface.position, |index| near += self.ranged[index].reflected(surface, shadow));
        every + near
    }

    /// What one light reflects, chosen in proportion to its irradiance, over the probability of the choice: the sum's
    /// unbiased estimate for a uniform `xi` in [0, 1).
    pub(super) fn reflected_by_one(&self, surface: &Surface, shadow: &Shadow, xi: f64) -> DVec3 {
        let mut sum = 0.0;
        let mut upper = Vec::new();
        let mut add = |light| {
            sum += Light::irradiance(light, surface);
            upper.push((sum, light));
        };
        self.unranged.iter().for_each(&mut add);
        self.tree.at_point(surface.position, |index| add(&self.ranged[index]));
        let chosen = upper.partition_point(|(upper, _)| *upper <= xi * sum);
        upper.get(chosen).map_or(DVec3::ZERO, |(_, light)| {
            light.reflected(surface, Some(shadow)) * (sum / light.irradiance(surface))
        })
    }
}

impl Light {
    /// The largest channel's.
    fn irradiance(&self, surface: &Surface) -> f64 {
        let to_light = self.position - surface.position;
        let distance_squared = to_light.length_squared();
        let cos = surface.frame.normal.dot(to_light) / distance_squared.sqrt();
        if cos > 0.0 {
            self.intensity.max_element() * falloff(distance_squared, self.range) * cos
        } else {
            0.0
        }
    }

    fn reflected(&self, surface: &Surface, shadow: Option<&Shadow>) -> DVec3 {
        let to_light = self.position - surface.position;
        let distance_squared = to_light.length_squared();
        let falloff = falloff(distance_squared, self.range);
        // Below the surface, out of range, or exactly on the surface, where it has no direction.
        if surface.frame.normal.dot(to_light) <= 0.0 || falloff == 0.0 {
            return DVec3::ZERO;
        }
        let distance = distance_squared.sqrt();
        let wi = surface.frame.to_local(to_light / distance);
        let reflected = surface.bsdf.eval(surface.wo, wi) * self.intensity * (wi.z * falloff);
        let dark = || shadow.is_some_and(|shadow| shadow.covers(to_light / distance, distance, None));
        if reflected == DVec3::ZERO || dark() { DVec3::ZERO } else { reflected }
    }
}

/// Indices of the lights that reach into a box, ascending, by brute force: those without a range, and those whose
/// range is greater than their distance from the box. For tests of clusters.
#[must_use]
pub fn reaching(lights: &[PointLight], bounds: &Bounds) -> Vec<u32> {
    let reaches = |light: &PointLight| {
        light
            .range
            .is_none_or(|range| bounds.distance_squared(light.position.as_dvec3()) < f64::from(range).powi(2))
    };
    (0_u32..).zip(lights).filter(|(_, light)| reaches(light)).map(|(index, _)| index).collect()
}

/// Indices of the lights that reach a point, ascending; see [`reaching`].
#[must_use]
pub fn reaching_point(lights: &[PointLight], point: DVec3) -> Vec<u32> {
    reaching(lights, &Bounds { min: point, max: point })
}
