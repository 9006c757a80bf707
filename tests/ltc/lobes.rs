//! What is fitted is what the oracle computes, and what a table stores of it is its integral.

use crate::{Random, at, tables};
use amas::ltc::{Layer, Lobe, PLASTIC_ETAS, project_conductor, project_dielectric};
use amas::reference::bsdf::{
    Bsdf, Ggx, Matte, Plastic, Principled, Substrate, fresnel_conductor, fresnel_dielectric,
};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

const PRINCIPLED: Principled = Principled {
    base_color: DVec3::ONE,
    metallic: 0.0,
    eta: 1.0,
    roughness: 0.0,
    ggx: Ggx::isotropic(0.5),
    specular_tint: 0.0,
    sheen: 0.0,
    sheen_tint: 0.0,
    clearcoat: 0.0,
    clearcoat_gloss: 0.0,
    subsurface: 0.0,
};

/// f of `layer` by the oracle's public BSDFs; lobes that have none of their own are the difference of two.
fn oracle(layer: Layer, r: f64, wo: DVec3, wi: DVec3) -> f64 {
    let ggx = Ggx::isotropic(r * r);
    let h = (wi + wo).normalize();
    let schlick = |f0: f64| f0 + (1.0 - f0) * (1.0 - h.dot(wi)).powi(5);
    let principled = |with: Principled, without: Principled| {
        Bsdf::Principled(with).eval(wo, wi).x - Bsdf::Principled(without).eval(wo, wi).x
    };
    let black = Principled { base_color: DVec3::ZERO, roughness: r, ..PRINCIPLED };
    let white = Principled { base_color: DVec3::ONE, ..black };
    let substrate = |diffuse: f64, specular: f64| {
        let (diffuse, specular) = (DVec3::splat(diffuse), DVec3::splat(specular));
        Bsdf::Substrate(Substrate { diffuse, specular, ggx }).eval(wo, wi).x
    };
    match layer {
        Layer::Metal => ggx.density(h) * ggx.visibility_correlated(wo, wi),
        Layer::Plastic => {
            let plastic = Plastic { diffuse: DVec3::ZERO, specular: DVec3::ONE, eta: 1.5, alpha: r * r };
            Bsdf::Plastic(plastic).eval(wo, wi).x
        }
        Layer::PrincipledSpecular => ggx.density(h) * ggx.visibility_separable(wo, wi),
        Layer::PrincipledDielectric => ggx.density(h) * ggx.visibility_separable(wo, wi) * schlick(0.04),
        Layer::SubstrateSpecular => substrate(0.0, 1.0),
        Layer::SubstrateDielectric => substrate(0.0, 0.05),
        Layer::Clearcoat => {
            let clearcoat_gloss = (0.1 - r * r) / 0.099;
            principled(Principled { clearcoat: 1.0, clearcoat_gloss, ..black }, black)
        }
        Layer::Matte => Bsdf::Matte(Matte { color: DVec3::ONE, sigma: 90.0 * r }).eval(wo, wi).x,
        Layer::PrincipledDiffuse => principled(white, black),
        Layer::Subsurface => {
            let subsurface = 1.0;
            principled(Principled { subsurface, ..white }, Principled { subsurface, ..black })
        }
        Layer::Sheen => principled(Principled { sheen: 1.0, ..black }, black),
        Layer::SubstrateDiffuse => substrate(1.0, 0.0) - substrate(0.0, 0.0),
    }
}

#[test]
fn lobes_are_the_oracles() {
    let mut random = Random(1);
    for layer in Layer::ALL {
        for _ in 0..200 {
            let parameters = random.parameters(layer, 89.0);
            let lobe = Lobe::new(layer, amas::ltc::Parameters { r: parameters.r.max(0.1), ..parameters });
            let wi = random.above();
            let (got, want) = (lobe.eval(wi), oracle(layer, parameters.r.max(0.1), lobe.wo, wi) * wi.z);
            assert!(
                (got - want).abs() <= 1e-9 * want.abs() + 1e-12,
                "{layer:?} {parameters:?} {wi}: {got} {want}"
            );
        }
    }
}

/// The midpoint rule over the hemisphere, in cosine and azimuth.
fn over_hemisphere(f: impl Fn(DVec3) -> f64) -> f64 {
    let (rings, sectors) = (1500, 1000);
    let mut sum = 0.0;
    for ring in 0..rings {
        // Denser towards the horizon and the zenith, where lobes bend.
        let t = PI * (f64::from(ring) + 0.5) / f64::from(rings);
        let (z, dz) = (0.5 - 0.5 * t.cos(), 0.5 * t.sin() * PI / f64::from(rings));
        let sin = (1.0 - z * z).sqrt();
        for sector in 0..sectors {
            let phi = TAU * (f64::from(sector) + 0.5) / f64::from(sectors);
            sum += dz * f(DVec3::new(sin * phi.cos(), sin * phi.sin(), z));
        }
    }
    sum * TAU / f64::from(sectors)
}

#[test]
fn albedos_are_integrals_of_the_oracle() {
    for layer in Layer::ALL {
        let [first, last] = layer.axis();
        for (share, degrees) in [(0.6, 0.0), (0.6, 50.0), (1.0, 80.0)] {
            let parameters = at(first + share * (last - first), degrees);
            let lobe = Lobe::new(layer, parameters);
            let want = over_hemisphere(|wi| oracle(layer, parameters.r, lobe.wo, wi) * wi.z);
            let got = lobe.albedo();
            assert!((got - want).abs() < 2e-5 * want.max(0.1), "{layer:?} {parameters:?}: {got} {want}");
            let stored = tables().lookup(layer, parameters.r, parameters.cos).mass();
            assert!((stored - want).abs() < 1e-2 * want, "{layer:?} {parameters:?}: {stored} {want}");
        }
    }
}

/// At normal incidence the metal's albedo is an integral over one angle.
#[test]
fn moments_at_normal_incidence() {
    for r in [0.2, 0.5, 0.8, 1.0] {
        let ggx = Ggx::isotropic(r * r);
        let mut want = [0.0; 3];
        let steps = 400_000;
        for i in 0..steps {
            let theta = 0.25 * PI * (f64::from(i) + 0.5) / f64::from(steps);
            let h = DVec3::new(theta.sin(), 0.0, theta.cos());
            let wi = 2.0 * h.z * h - DVec3::Z;
            let f = ggx.density(h) * ggx.visibility_correlated(DVec3::Z, wi);
            let value = f * wi.z * 4.0 * h.z * h.x * TAU * 0.25 * PI / f64::from(steps);
            let factors = [1.0, (1.0 - h.z).powi(5), h.z * (1.0 - h.z).powi(6)];
            want = std::array::from_fn(|n| want[n] + value * factors[n]);
        }
        let got = Lobe::new(Layer::Metal, at(r, 0.0)).moments();
        for (got, want) in got.into_iter().zip(want) {
            assert!((got - want).abs() < 1e-6, "r {r}: {got} {want}");
        }
    }
}

/// Values to seven digits that do not come from this program; alpha is (21/63)², (23/63)², (24/63)².
#[test]
fn known_albedos() {
    let known = [(21.0, 0.985_330_5), (23.0, 0.978_265_3), (24.0, 0.973_861_1)];
    for (step, want) in known {
        let lobe = Lobe::new(Layer::Metal, at(step / 63.0, 0.0));
        assert!((lobe.moments()[0] - want).abs() < 1e-7, "{step}: {:?}", lobe.moments());
        let stored = tables().lookup(Layer::Metal, step / 63.0, 1.0).moments[0];
        assert!((stored - want).abs() < 3e-4, "{step}: {stored}");
    }
    let all = Lobe::new(Layer::Metal, at(1.0, 0.0)).moments()[0];
    assert!((all - (1.0 - 2.0_f64.ln())).abs() < 1e-7, "{all}");
}

/// 1 − (1 − n·wo/2)⁵, which a shader computes instead of looking it up.
#[test]
fn albedo_of_the_substrates_base() {
    for degrees in [0.0, 20.0, 60.0, 85.0] {
        let lobe = Lobe::new(Layer::SubstrateDiffuse, at(0.0, degrees));
        let want = 1.0 - (1.0 - 0.5 * lobe.wo.z).powi(5);
        assert!((lobe.albedo() - want).abs() < 1e-7, "{degrees}: {} {want}", lobe.albedo());
    }
}

/// Relative error of a dielectric's albedo by three others', from index 1.2 and below it.
#[test]
fn plastics_of_other_indices() {
    let mut worst = [0.0_f64; 2];
    for eta in [1.1, 1.15, 1.2, 1.3, 1.4, 1.5, 1.7, 2.0, 2.2, 2.5] {
        let weights = project_dielectric(eta);
        for (r, degrees) in [(0.1, 0.0), (0.3, 45.0), (0.3, 75.0), (0.5, 85.0), (0.9, 60.0), (1.0, 0.0)] {
            let lobe = Lobe::new(Layer::Plastic, at(r, degrees));
            let got: f64 = lobe.moments().into_iter().zip(weights).map(|(m, w)| m * w).sum();
            let want = exact(r, degrees, |cos| fresnel_dielectric(cos, eta));
            let error = (got - want).abs() / want;
            let class = usize::from(eta < 1.2);
            worst[class] = worst[class].max(error);
        }
    }
    println!("worst relative error of a dielectric's albedo: {worst:?}");
    assert!(worst[0] < 0.008 && worst[1] < 0.06, "{worst:?}");
    for (n, eta) in PLASTIC_ETAS.into_iter().enumerate() {
        let weights = project_dielectric(eta);
        assert!((0..3).all(|i| (weights[i] - f64::from(u8::from(i == n))).abs() < 1e-6), "{weights:?}");
    }
}

#[test]
fn conductors() {
    let mut worst = 0.0_f64;
    // Gold, copper, aluminium, iron and tungsten, at one wavelength each.
    for (eta, k) in [(0.18, 3.4), (0.2, 3.9), (1.1, 6.8), (2.9, 3.0), (3.5, 2.7)] {
        let weights = project_conductor(eta, k);
        for (r, degrees) in [(0.1, 0.0), (0.3, 75.0), (0.5, 85.0), (0.9, 60.0), (1.0, 0.0)] {
            let lobe = Lobe::new(Layer::Metal, at(r, degrees));
            let got: f64 = lobe.moments().into_iter().zip(weights).map(|(m, w)| m * w).sum();
            let want = exact(r, degrees, |cos| fresnel_conductor(cos, eta, k));
            worst = worst.max((got - want).abs() / want);
        }
    }
    println!("worst relative error of a conductor's albedo: {worst}");
    assert!(worst < 0.01, "{worst}");
}

/// ∫ GGX × `fresnel`, over visible normals: f cos / density of the reflection about them is G2/G1.
fn exact(r: f64, degrees: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
    let lobe = Lobe::new(Layer::Metal, at(r, degrees));
    let ggx = Ggx::isotropic(r * r);
    let metal = Bsdf::Metal(amas::reference::bsdf::Metal { eta: DVec3::ONE, k: DVec3::ONE, ggx });
    let (side, mut sum) = (300, 0.0);
    for i in 0..side {
        for j in 0..side {
            let xi = glam::DVec2::new(
                (f64::from(i) + 0.5) / f64::from(side),
                (f64::from(j) + 0.5) / f64::from(side),
            );
            let wi = metal.sample(lobe.wo, xi);
            if wi.z > 0.0 {
                let cos = (0.5 * (wi + lobe.wo).length()).min(1.0);
                sum += lobe.eval(wi) * fresnel(cos) / metal.pdf(lobe.wo, wi);
            }
        }
    }
    sum / f64::from(side * side)
}
