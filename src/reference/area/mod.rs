//! Direct light of area lights, with or without visibility, by multiple importance sampling in double precision.
//!
//! One strategy samples the light's area, the other the BSDF; the balance heuristic weighs them (Veach 1997), so that
//! the integrand over the summed densities is bounded both for a light that touches the surface and for a mirror-like
//! lobe. Each strategy runs eight independent random shifts of a quasi-random sequence; their spread is the
//! standard error. The number of points doubles until that error is small enough. With visibility the estimates begin
//! with more points, so that the edge of a shadow is noticed wherever it may lie: what hides, or lets through, less than
//! about a thousandth of the light may go unseen at the usual tolerance.

mod cylinder;
mod planar;

use glam::{DVec2, DVec3};

use self::cylinder::Cylinder;
use self::planar::Planar;
use super::rays::Ray;
use super::sampler::{Sequence, hash};
use super::shading::Surface;
use super::texture::{Wrap, sample};
use super::visibility::Shadow;
use crate::scene::{AreaLight, AreaShape, Texture};

/// Independent estimates from which the standard error is taken.
const SHIFTS: usize = 8;
/// Points of each strategy and shift at first, and at most.
const POINTS: [u32; 2] = [32, 16384];

/// Points of a light that has given none of its light so far: all shifts together find what sends a two-thousandth of it.
const UNSEEN: u32 = 512;

/// An area light in double precision.
#[derive(Clone, Debug)]
pub struct Emitter<'a> {
    shape: Shape,
    radiance: DVec3,
    two_sided: bool,
    visible: bool,
    texture: Option<&'a Texture>,
}

#[derive(Clone, Debug)]
enum Shape {
    Planar(Planar),
    Cylinder(Cylinder),
}

/// A point of a light as seen from a point in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// Unit direction towards the light.
    pub(super) wi: DVec3,
    /// Metres.
    pub(super) distance: f64,
    /// The light's front is seen.
    front: bool,
    /// Texture coordinates.
    uv: DVec2,
    /// Density of the light's sampling per solid angle at the point, sr⁻¹.
    pub(super) pdf: f64,
}

/// A number per channel with its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub value: DVec3,
    /// Standard error of the mean.
    pub standard_error: DVec3,
}

impl<'a> Emitter<'a> {
    /// Prepares a light; `textures` are the scene's.
    #[must_use]
    pub fn new(light: &AreaLight, textures: &'a [Texture]) -> Self {
        let shape = match &light.shape {
            AreaShape::Line { a, b, radius } => {
                Shape::Cylinder(Cylinder::new(a.as_dvec3(), b.as_dvec3(), f64::from(*radius)))
            }
            AreaShape::Rect { center, u, v } => {
                Shape::Planar(Planar::rect(center.as_dvec3(), u.as_dvec3(), v.as_dvec3()))
            }
            AreaShape::Disk { center, u, v } => {
                Shape::Planar(Planar::ellipse(center.as_dvec3(), u.as_dvec3(), v.as_dvec3()))
            }
            AreaShape::Polygon { vertices, holes, uvs } => {
                Shape::Planar(Planar::polygon(vertices, holes, uvs.as_deref()))
            }
        };
        Self {
            shape,
            radiance: light.radiance.as_dvec3(),
            two_sided: light.two_sided,
            visible: light.visible,
            texture: light.texture.and_then(|index| textures.get(index as usize)),
        }
    }

    /// Where a ray meets a luminaire that is seen: the distance, and the radiance (black on the back of a one-sided
    /// one, which occludes all the same).
    #[must_use]
    pub fn seen_by(&self, ray: &Ray) -> Option<(f64, DVec3)> {
        let seen = if self.visible { self.along(ray.origin, ray.direction) } else { None };
        seen.map(|seen| (seen.distance, self.emitted(&seen)))
    }

    /// Distance along a ray at which a luminaire that is seen lies, from either side.
    pub(crate) fn occluder(&self, ray: &Ray) -> Option<f64> {
        if self.visible { self.along(ray.origin, ray.direction).map(|seen| seen.distance) } else { None }
    }

    pub(super) fn along(&self, origin: DVec3, direction: DVec3) -> Option<Seen> {
        match &self.shape {
            Shape::Planar(shape) => shape.along(origin, direction),
            Shape::Cylinder(shape) => shape.along(origin, direction),
        }
    }

    pub(super) fn sample(&self, origin: DVec3, xi: DVec2) -> Option<Seen> {
        match &self.shape {
            Shape::Planar(shape) => shape.sample(origin, xi),
            Shape::Cylinder(shape) => shape.sample(origin, xi),
        }
    }

    /// Whether none of the light can reach the surface's upper side.
    fn below(&self, surface: &Surface) -> bool {
        let normal = surface.frame.to_world(DVec3::Z);
        let (highest, front) = match &self.shape {
            Shape::Planar(shape) => shape.highest(surface.position, normal),
            Shape::Cylinder(shape) => (shape.highest(surface.position, normal), true),
        };
        highest <= 0.0 || !(front || self.two_sided)
    }

    /// A guess of what the light does at a surface, to choose among lights; 0 only where it does nothing.
    pub(super) fn weight(&self, surface: &Surface) -> f64 {
        let (center, size2, area) = match &self.shape {
            Shape::Planar(shape) => shape.extent(),
            Shape::Cylinder(shape) => shape.extent(),
        };
        let solid_angle = area / (center.distance_squared(surface.position) + size2);
        if self.below(surface) { 0.0 } else { self.radiance.max_element() * solid_angle }
    }

    /// Radiance leaving towards the observer.
    pub(super) fn emitted(&self, seen: &Seen) -> DVec3 {
        if !(seen.front || self.two_sided) {
            return DVec3::ZERO;
        }
        let texel = self.texture.map_or(DVec3::ONE, |t| sample(t, seen.uv, Wrap::Clamp));
        self.radiance * texel
    }

    /// One point of each strategy; `hidden` says of a point that reflects something whether it is out of sight.
    fn reflected_once(&self, surface: &Surface, xi: [DVec2; 2], hidden: impl Fn(&Seen) -> bool) -> DVec3 {
        let by_light = self.sample(surface.position, xi[0]);
        let local = surface.bsdf.sample(surface.wo, xi[1]);
        let by_bsdf =
            if local.z > 0.0 { self.along(surface.position, surface.frame.to_world(local)) } else { None };
        let term = |seen: Option<Seen>| {
            let Some(seen) = seen else { return DVec3::ZERO };
            let weighed = self.weighed(surface, &seen);
            if weighed == DVec3::ZERO || hidden(&seen) { DVec3::ZERO } else { weighed }
        };
        term(by_light) + term(by_bsdf)
    }

    /// f cosθ L over the sum of both densities.
    fn weighed(&self, surface: &Surface, seen: &Seen) -> DVec3 {
        let wi = surface.frame.to_local(seen.wi);
        let pdf = seen.pdf + surface.bsdf.pdf(surface.wo, wi);
        if wi.z <= 0.0 || pdf.is_nan() || pdf <= 0.0 {
            return DVec3::ZERO;
        }
        surface.bsdf.eval(surface.wo, wi) * self.emitted(seen) * (wi.z / pdf)
    }
}

/// The running estimate of one light at one surface.
struct Running<'a> {
    emitter: &'a Emitter<'a>,
    /// Among all.
    index: usize,
    sequences: [[Sequence; 2]; SHIFTS],
    sums: [DVec3; SHIFTS],
    points: u32,
}

impl<'a> Running<'a> {
    fn new(emitter: &'a Emitter<'a>, index: usize, seed: u64) -> Self {
        let seed = hash(&[seed, index as u64]);
        let sequence = |shift: usize, strategy: u64| Sequence::new(hash(&[seed, shift as u64, strategy]));
        let sequences = std::array::from_fn(|shift| [sequence(shift, 0), sequence(shift, 1)]);
        Self { emitter, index, sequences, sums: [DVec3::ZERO; SHIFTS], points: 0 }
    }

    fn extend(&mut self, surface: &Surface, shadow: Option<&Shadow>, points: u32) {
        let own = Some(self.index);
        let hidden = |seen: &Seen| shadow.is_some_and(|shadow| shadow.covers(seen.wi, seen.distance, own));
        for (sum, sequences) in self.sums.iter_mut().zip(&self.sequences) {
            for index in self.points..points {
                let xi = sequences.map(|sequence| sequence.point(index));
                *sum += self.emitter.reflected_once(surface, xi, hidden);
            }
        }
        self.points = points;
    }

    /// Whether no point has given light so far, though the light's corner above the horizon may be one that few points
    /// find: eight estimates of 0 have no spread.
    fn unseen(&self, surface: &Surface) -> bool {
        self.points < UNSEEN && self.sums == [DVec3::ZERO; SHIFTS] && !self.emitter.below(surface)
    }

    fn estimate(&self) -> Estimate {
        mean(&self.sums.map(|sum| sum / f64::from(self.points)))
    }
}

/// Mean of independent estimates, with its standard error.
pub(super) fn mean(estimates: &[DVec3]) -> Estimate {
    let n = estimates.len() as f64;
    let value = estimates.iter().sum::<DVec3>() / n;
    let squares: DVec3 = estimates.iter().map(|e| (e - value) * (e - value)).sum();
    let variance = squares / (n * (n - 1.0).max(1.0));
    Estimate { value, standard_error: variance.map(f64::sqrt) }
}

/// Light of all `emitters` reflected by `surface` towards the viewer, W·sr⁻¹·m⁻², without visibility.
#[must_use]
pub fn reflected(surface: &Surface, emitters: &[Emitter], tolerance: f64, seed: u64) -> Estimate {
    reflected_where(surface, emitters, None, tolerance, seed)
}

/// Light of all `emitters` reflected by `surface` towards the viewer, W·sr⁻¹·m⁻²; only what `shadow` leaves, if there is
/// one: its emitters are these.
///
/// Points are added until each light's standard error is at most `tolerance` of the sum (shared by the square root of
/// the number of lights), or 16384 points of each of the eight shifts are spent. Stopping when the error looks small favours estimates that are high:
/// a bias of about 2 % of `tolerance`, measured. Same seed, same result.
pub(super) fn reflected_where(
    surface: &Surface,
    emitters: &[Emitter],
    shadow: Option<&Shadow>,
    tolerance: f64,
    seed: u64,
) -> Estimate {
    if surface.wo.z <= 0.0 || emitters.is_empty() {
        return Estimate::default();
    }
    let first = if shadow.is_some() { first_points(tolerance) } else { POINTS[0] };
    let start = |(index, emitter)| {
        let mut running = Running::new(emitter, index, seed);
        running.extend(surface, shadow, first);
        running
    };
    let mut all: Vec<_> = emitters.iter().enumerate().map(start).collect();
    let share = tolerance / (emitters.len() as f64).sqrt();
    loop {
        let total = total(&all);
        let allowed = share * total.value.element_sum();
        let mut settled = true;
        for running in &mut all {
            let error = running.estimate().standard_error.element_sum();
            if running.unseen(surface) || (error > allowed && running.points < POINTS[1]) {
                running.extend(surface, shadow, 2 * running.points);
                settled = false;
            }
        }
        if settled {
            return total;
        }
    }
}

/// Points of each strategy and shift at first where light may be cut: all shifts together have one over the tolerance.
fn first_points(tolerance: f64) -> u32 {
    let wanted = (SHIFTS as f64 * tolerance).max(f64::MIN_POSITIVE).recip();
    (wanted.min(f64::from(POINTS[1])) as u32).next_power_of_two().clamp(POINTS[0], POINTS[1] / 16)
}

fn total(all: &[Running]) -> Estimate {
    let add = |sum: Estimate, running: &Running| {
        let one = running.estimate();
        Estimate {
            value: sum.value + one.value,
            // Holds variances until the end: independent errors add in squares.
            standard_error: sum.standard_error + one.standard_error * one.standard_error,
        }
    };
    let sum = all.iter().fold(Estimate::default(), add);
    Estimate { standard_error: sum.standard_error.map(f64::sqrt), ..sum }
}
