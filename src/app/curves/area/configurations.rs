//! Surfaces and area lights at random, on which estimators are timed and judged.

use crate::reference::area::{Emitter, reflected};
use crate::reference::bsdf::{Bsdf, Ggx, Metal, Plastic};
use crate::reference::shading::{Frame, Surface};
use crate::scene::material::{PARAMETER_COUNT, Value};
use crate::scene::{AreaLight, AreaShape, Material, Model, Parameter};
use crate::shared::{AreaTierRow, TIER_LIGHTS};
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

/// What the configurations are, for those who read the figures.
pub(super) const DISTRIBUTION: &str = "gold (GGX, conductor Fresnel) and plastic (Lambert .5, .4, .3 under GGX of index 1.5); \
     alpha .05 or .1 (sharp), .25, .5 or .8 (rough); view angles uniform in 0 to 85 degrees; lights at distance 1, \
     half in a direction that the BSDF's own sampling draws, half anywhere above the surface, turned towards the point by \
     a random half vector; rectangles and ellipses with axes, lines with lengths of .04 to 2, log-uniform and independent, \
     lines of radius .005 to .05; the larger ones reach below the horizon";

/// The alphas of the two bands.
pub(super) const BANDS: [(&str, &[f64]); 2] = [("sharp", &[0.05, 0.1]), ("rough", &[0.25, 0.5, 0.8])];
pub(super) const MODELS: [(&str, Model); 2] = [("metal", Model::Metal), ("plastic", Model::Plastic)];
pub(super) const SHAPES: [&str; 3] = ["rectangle", "ellipse", "line"];

/// Solid angles of squares that are swept, over that of the hemisphere.
pub(super) const SHARES: [f64; 6] = [1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.9];

/// Lights of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lights {
    /// Of this shape and any size, turned anyhow.
    Any(&'static str),
    /// Squares that face the point, with this share of the hemisphere's solid angle.
    Squares(f64),
}

impl Lights {
    /// Of the random numbers, with the model's.
    fn seed(self, model: Model) -> u64 {
        let name = match self {
            Self::Any(shape) => shape.to_owned(),
            Self::Squares(share) => share.to_string(),
        };
        name.bytes().fold(model as u64 + 1, |seed, byte| (seed << 7) ^ u64::from(byte))
    }
}

/// Gold at red, green and blue.
const ETA: Vec3 = Vec3::new(0.143, 0.375, 1.442);
const K: Vec3 = Vec3::new(3.983, 2.386, 1.603);
const DIFFUSE: Vec3 = Vec3::new(0.5, 0.4, 0.3);
const INDEX: f32 = 1.5;

/// Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Log-uniform.
    fn between(&mut self, least: f64, most: f64) -> f64 {
        least * (most / least).powf(self.next())
    }

    /// Uniform over the hemisphere.
    fn above(&mut self) -> DVec3 {
        let z = self.next();
        let (sin, cos) = (std::f64::consts::TAU * self.next()).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    }
}

/// A surface, its lights and what the oracle says of each: the sum over the channels.
pub(super) struct Configuration {
    surface: Surface,
    pub(super) lights: Vec<AreaLight>,
    pub(super) truth: Vec<f64>,
    row: AreaTierRow,
}

impl Configuration {
    fn new(random: &mut Random, model: Model, lights: Lights, alphas: &[f64]) -> Self {
        let alpha = alphas[(random.next() * alphas.len() as f64) as usize] as f32;
        let (sin, cos) = (85.0 * random.next()).to_radians().sin_cos();
        let (y, x) = (std::f64::consts::TAU * random.next()).sin_cos();
        let wo = DVec3::new(sin * x, sin * y, cos).as_vec3();
        let (bsdf, color, specular) = if model == Model::Metal {
            let ggx = Ggx::isotropic(f64::from(alpha));
            (Bsdf::Metal(Metal { eta: ETA.as_dvec3(), k: K.as_dvec3(), ggx }), ETA, K)
        } else {
            let plastic = Plastic {
                diffuse: DIFFUSE.as_dvec3(),
                specular: DVec3::ONE,
                eta: f64::from(INDEX),
                alpha: f64::from(alpha),
            };
            (Bsdf::Plastic(plastic), DIFFUSE, Vec3::ONE)
        };
        let frame = Frame { tangent: DVec3::X, bitangent: DVec3::Y, normal: DVec3::Z };
        let surface = Surface { position: DVec3::ZERO, frame, wo: wo.as_dvec3().normalize(), bsdf };
        let lights = (0..TIER_LIGHTS).map(|_| light(random, &surface, lights)).collect();
        let row = AreaTierRow {
            color_alpha: color.extend(alpha).to_array(),
            specular_eta: specular.extend(INDEX).to_array(),
            wo: wo.to_array(),
            ..AreaTierRow::default()
        };
        Self { surface, lights, truth: Vec::new(), row }
    }

    /// The row of the probe whose lights begin at `first`, or a row of none.
    pub(super) fn row(&self, first: usize, position: Vec3, lit: bool) -> AreaTierRow {
        AreaTierRow {
            light_first: first as u32,
            light_count: if lit { self.lights.len() as u32 } else { 0 },
            position: position.to_array(),
            ..self.row
        }
    }
}

fn light(random: &mut Random, surface: &Surface, lights: Lights) -> AreaLight {
    let aimed = surface.bsdf.sample(surface.wo, DVec2::new(random.next(), random.next()));
    let center = match aimed.try_normalize() {
        Some(aimed) if aimed.z > 0.0 && random.next() < 0.5 => aimed,
        _ => random.above(),
    };
    let shape = match lights {
        Lights::Any(shape) => turned(random, center, shape),
        Lights::Squares(share) => square(random, center, share),
    };
    AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: false, texture: None }
}

/// At distance 1, facing the point: its solid angle is 4 asin(h²/(1 + h²)) for half a side of h.
fn square(random: &mut Random, center: DVec3, share: f64) -> AreaShape {
    let sine = (0.5 * std::f64::consts::PI * share).sin();
    let half = (sine / (1.0 - sine)).sqrt();
    let x = center.cross(random.above()).normalize();
    // Its front, u × v, is towards the point.
    AreaShape::Rect {
        center: center.as_vec3(),
        u: (half * x).as_vec3(),
        v: (half * x.cross(center)).as_vec3(),
    }
}

fn turned(random: &mut Random, center: DVec3, shape: &str) -> AreaShape {
    let normal = (random.above() - 2.0 * center).normalize();
    let x = normal.cross(random.above()).normalize();
    let (across, along) = (random.between(0.02, 1.0), random.between(0.02, 1.0));
    let (center, u, v) = (center.as_vec3(), (across * x).as_vec3(), (along * normal.cross(x)).as_vec3());
    match shape {
        "rectangle" => AreaShape::Rect { center, u, v },
        "ellipse" => AreaShape::Disk { center, u, v },
        _ => AreaShape::Line { a: center - u, b: center + u, radius: random.between(0.005, 0.05) as f32 },
    }
}

/// `count` of them with their truth, the same at every call.
pub(super) fn configurations(
    model: Model,
    lights: Lights,
    alphas: &[f64],
    count: usize,
    tolerance: f64,
) -> Vec<Configuration> {
    let seed = lights.seed(model);
    let mut random = Random((alphas[0] * 1e6) as u64 ^ (seed << 20) ^ 0x9e37_79b9_7f4a_7c15);
    let mut all: Vec<_> =
        (0..count).map(|_| Configuration::new(&mut random, model, lights, alphas)).collect();
    all.par_iter_mut().for_each(|one| {
        let truth = |(light, seed)| {
            let emitters = [Emitter::new(light, &[])];
            reflected(&one.surface, &emitters, tolerance, seed).value.element_sum()
        };
        one.truth = one.lights.iter().zip(0..).map(truth).collect();
    });
    all
}

/// A material of the model: the tables that the device needs follow from it.
pub(super) fn material(model: Model) -> Material {
    let mut parameters = [Value::default(); PARAMETER_COUNT];
    let mut set = |parameter, constant| parameters[parameter as usize] = Value { constant, texture: None };
    set(Parameter::Roughness, [0.1; 3]);
    set(Parameter::Aspect, [1.0; 3]);
    set(Parameter::Eta, [INDEX; 3]);
    let name = "measured".into();
    Material { name, model, parameters, squared_roughness: false, two_sided: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solid angles by the triangles of their corners (Van Oosterom and Strackee 1983), and their front.
    #[test]
    fn squares_have_their_share() {
        for share in SHARES {
            let AreaShape::Rect { center, u, v } = square(&mut Random(7), DVec3::new(0.6, 0.0, 0.8), share)
            else {
                panic!("no square")
            };
            assert!(u.cross(v).dot(center) < 0.0, "{share}");
            let corners =
                [-u - v, u - v, u + v, v - u].map(|corner| (center + corner).as_dvec3().normalize());
            let triangle = |a: DVec3, b: DVec3, c: DVec3| {
                2.0 * a.dot(b.cross(c)).abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
            };
            let angle =
                triangle(corners[0], corners[1], corners[2]) + triangle(corners[2], corners[3], corners[0]);
            let got = angle / std::f64::consts::TAU;
            assert!((got / share - 1.0).abs() < 1e-4, "{share}: {got}");
        }
    }
}
