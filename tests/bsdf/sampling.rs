//! Sampling, of the oracle and of the shaders that ship: chi-square, densities, albedos, weights.

use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use amas::shared;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::albedo::spread;
use crate::chi_square::{Chart, Outcome, SIGNIFICANCE};
use crate::common::albedo::{at_cosine, figures, white_metal, white_principled};
use crate::common::gpu::CheckedGpu;
use crate::common::tables::{MODELS, albedos};
use crate::mixed::{ask, eval_mixed, mixed_cases};
use crate::probe::Case;
use crate::random::MODEL_NAMES;

/// Samples of a chi-square test.
const SAMPLES: u32 = 1 << 19;

/// SplitMix64's finaliser of a counter: two numbers of [0, 1) that float32 holds.
pub(crate) fn random_pair(seed: u64, index: u32) -> DVec2 {
    let mut z = (seed << 32 | u64::from(index)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    DVec2::new((z >> 40) as f64, ((z >> 16) & 0xff_ffff) as f64) / 16_777_216.0
}

/// A BSDF, a viewer, and the width of the narrowest lobe; 1 of a wide one, whose cells are even.
struct Setting {
    name: &'static str,
    bsdf: Bsdf,
    wo: DVec3,
    width: f64,
}

impl Setting {
    fn chart(&self) -> Chart {
        if self.width < 1.0 { Chart::mirror(self.case().wo.normalize(), self.width) } else { Chart::polar() }
    }

    /// Rounded to float32, for both sides.
    fn case(&self) -> Case {
        Case::new(&self.bsdf, self.wo, DVec3::Z)
    }
}

fn settings() -> Vec<Setting> {
    let ggx = |alpha_x, alpha_y| Ggx { alpha_x, alpha_y };
    let color = DVec3::new(0.8, 0.5, 0.2);
    let matte = |sigma| Bsdf::Matte(Matte { color, sigma });
    let plastic =
        |alpha| Bsdf::Plastic(Plastic { diffuse: color, specular: DVec3::splat(0.9), eta: 1.5, alpha });
    let metal = |ggx| Bsdf::Metal(Metal { eta: color, k: 3.0 * color, ggx });
    let substrate = |ggx| Bsdf::Substrate(Substrate { diffuse: color, specular: DVec3::splat(0.1), ggx });
    let principled = |ggx: Ggx, metallic, clearcoat, gloss| {
        let roughness = (ggx.alpha_x * ggx.alpha_y).powf(0.25);
        let plain = Principled { base_color: color, ggx, ..white_principled(roughness, gloss) };
        let mixed = Principled { metallic, clearcoat, sheen: 1.0, subsurface: 0.6, ..plain };
        Bsdf::Principled(mixed)
    };
    let coated = principled(ggx(0.3, 0.3), 0.2, 1.0, 0.0);
    let all = vec![
        ("matte, grazing", matte(0.0), 0.01, 1.0),
        ("matte, rough", matte(40.0), 0.5, 1.0),
        ("matte, rough, grazing", matte(90.0), 0.02, 1.0),
        ("plastic", plastic(0.3), 0.7, 1.0),
        ("plastic, mirror", plastic(1e-3), 0.6, 1e-3),
        ("plastic, grazing", plastic(0.1), 0.05, 0.2),
        ("metal, roughest", metal(ggx(1.0, 1.0)), 0.4, 1.0),
        ("metal, from the normal", metal(ggx(0.2, 0.2)), 1.0, 0.4),
        ("metal, anisotropic", metal(ggx(0.4, 0.1)), 0.5, 0.3),
        ("metal, hair-fine", metal(ggx(0.05, 0.005)), 0.8, 0.02),
        ("metal, mirror", metal(ggx(1e-3, 1e-3)), 0.9, 2e-3),
        ("metal, fine, grazing", metal(ggx(0.02, 0.01)), 0.1, 0.03),
        ("metal, rough, grazing", metal(ggx(0.6, 0.3)), 1e-4, 1.0),
        ("substrate, rough", substrate(ggx(0.5, 0.3)), 0.3, 1.0),
        ("substrate, grazing", substrate(ggx(0.05, 0.05)), 0.05, 0.1),
        ("substrate, rough, grazing", substrate(ggx(0.4, 0.2)), 0.02, 0.1),
        ("principled, all lobes", coated, 0.6, 1.0),
        ("principled, all lobes, grazing", coated, 0.05, 1.0),
        ("principled, satin coat", principled(ggx(0.8, 0.8), 0.5, 1.0, 0.0), 0.5, 0.2),
        ("principled, glossy coat", principled(ggx(0.5, 0.2), 0.0, 1.0, 1.0), 0.7, 2e-3),
        ("principled, metallic", principled(ggx(0.2, 0.05), 1.0, 0.3, 0.5), 0.6, 0.2),
    ];
    let place =
        |(i, (name, bsdf, cos, width))| Setting { name, bsdf, wo: at_cosine(cos, 37.0 * i as f64), width };
    all.into_iter().enumerate().map(place).collect()
}

fn require(setting: &Setting, sampler: &str, outcome: &Outcome) {
    let Setting { name, .. } = setting;
    assert!(outcome.accepted(), "{name}, {sampler}: {outcome:?}, significance {SIGNIFICANCE}");
    // Both sides of what is not below the surface. A chart around the mirror leaves out its ends.
    let spread = 5.0 * (outcome.above * (1.0 - outcome.above) / f64::from(SAMPLES)).sqrt();
    let most = outcome.above + spread + 1e-4;
    assert!(outcome.integral <= most, "{name}, {sampler}: {outcome:?}");
    if setting.width == 1.0 {
        assert!(outcome.integral >= outcome.above - spread - 1e-4, "{name}, {sampler}: {outcome:?}");
    }
    println!("{name}, {sampler}: {:+.2} deviations, {} cells", outcome.deviations, outcome.freedom + 1);
}

#[test]
fn chi_square_of_the_oracle() {
    settings().par_iter().enumerate().for_each(|(seed, setting)| {
        let case = setting.case();
        let wo = case.wo.normalize();
        let sample = |i| case.bsdf.sample(wo, random_pair(seed as u64, i));
        let outcome = setting.chart().test((0..SAMPLES).map(sample), |wi| case.bsdf.pdf(wo, wi));
        require(setting, "oracle", &outcome);
    });
}

#[test]
fn chi_square_of_the_device() {
    let gpu = CheckedGpu::open();
    for (seed, setting) in settings().iter().enumerate() {
        let case = setting.case();
        let wo = case.wo.normalize();
        let sampled = sampled(&gpu, &case, 100 + seed as u64, SAMPLES);
        // A device's density is the oracle's: `densities_of_device_and_oracle_agree`.
        let samples = sampled.iter().map(|&(wi, _)| wi.normalize());
        let outcome = setting.chart().test(samples, |wi| case.bsdf.pdf(wo, wi));
        require(setting, "device", &outcome);
    }
    gpu.finish();
}

/// Directions that the device samples, and their densities.
fn sampled(gpu: &CheckedGpu, case: &Case, seed: u64, count: u32) -> Vec<(DVec3, f64)> {
    let row = |i| {
        let xi = random_pair(seed, i).as_vec2();
        shared::BsdfProbeRow { wi: [xi.x, xi.y, 0.0, 0.0], ..case.row() }
    };
    let rows: Vec<_> = (0..count).map(row).collect();
    let values = ask(gpu, shared::BSDF_PROBE_SAMPLE, &rows);
    values.into_iter().map(|v| (Vec3::from_slice(&v).as_dvec3(), f64::from(v[3]))).collect()
}

/// The test can fail: it rejects a sampler that is wrong by 2 % in alpha, and accepts the right one of the same samples.
#[test]
fn chi_square_rejects_a_wrong_alpha() {
    let metal = |alpha| white_metal(Ggx::isotropic(alpha));
    for (alpha, width) in [(0.3, 1.0), (1e-2, 2e-2)] {
        let wo = at_cosine(0.8, 10.0);
        let chart = if width < 1.0 { Chart::mirror(wo, width) } else { Chart::polar() };
        let outcome = |wrong: f64| {
            let samples = (0..4 * SAMPLES).map(|i| metal(wrong * alpha).sample(wo, random_pair(7, i)));
            chart.test(samples, |wi| metal(alpha).pdf(wo, wi))
        };
        let (right, wrong) = (outcome(1.0), outcome(1.02));
        assert!(right.accepted(), "alpha {alpha}: {right:?}");
        assert!(!wrong.accepted(), "alpha {alpha}, 2 % off: {wrong:?}");
        println!("alpha {alpha}: {:+.1} deviations, 2 % off {:+.1}", right.deviations, wrong.deviations);
    }
}

/// Every density of the device against the oracle's at the same direction, which float32's directions, unit only to
/// 6e-8, move by more than the arithmetic does.
#[test]
fn densities_of_device_and_oracle_agree() {
    let gpu = CheckedGpu::open();
    let cases = mixed_cases(40_000);
    let mut worst = [0.0_f64; 5];
    for (i, (case, (_, got))) in
        cases.iter().zip(eval_mixed(&gpu, shared::BSDF_PROBE_EVAL, &cases)).enumerate()
    {
        let pdf = |wo: DVec3, wi: DVec3| case.bsdf.pdf(wo, wi);
        let want = pdf(case.wo.normalize(), case.wi.normalize());
        let rounding = (pdf(case.wo, case.wi) - want).abs() + moves(case, &pdf);
        let error = (got - want).abs();
        assert!(error <= 1e-3 * want + rounding, "{case}\n  got {got}\n  want {want}, rounding {rounding}");
        if rounding < 1e-5 * want {
            worst[i % 5] = worst[i % 5].max(error / want);
        }
    }
    for (model, worst) in MODEL_NAMES.into_iter().zip(worst) {
        println!("{model}: densities within {worst:.1e}, relative, where directions' rounding is below 1e-5");
    }
    gpu.finish();
}

/// How much half a unit in the last place of each component moves it.
fn moves(case: &Case, pdf: &impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let here = pdf(case.wo, case.wi);
    let moved = |axis: usize| {
        let (mut wo, mut wi) = (case.wo, case.wi);
        let direction = if axis < 3 { &mut wo } else { &mut wi };
        direction[axis % 3] *= 1.0 + f64::from(f32::EPSILON) / 2.0;
        (pdf(wo, wi) - here).abs()
    };
    (0..6).map(moved).sum()
}

/// Ends of [0, 1), and viewers where float32 is at its end.
#[test]
fn samples_are_unit_and_have_a_density() {
    const ENDS: [f32; 5] = [0.0, 1e-30, 6e-8, 0.5, 1.0 - 1.0 / 16_777_216.0];
    let gpu = CheckedGpu::open();
    let viewers = [1e-4, 1e-6, 0.3, 1.0].map(|cos| at_cosine(cos, 20.0));
    let mut cases = Vec::new();
    for (i, case) in mixed_cases(2_000).into_iter().enumerate() {
        let wo = if i % 3 == 0 { viewers[i / 3 % 4] } else { case.wo };
        let case = Case::new(&case.bsdf, wo, case.wi);
        cases.extend((0..25).map(|k| (case, [ENDS[k / 5], ENDS[k % 5]])));
        cases.extend((0..10).map(|k| (case, random_pair(i as u64, k).as_vec2().to_array())));
    }
    let row =
        |(case, xi): &(Case, [f32; 2])| shared::BsdfProbeRow { wi: [xi[0], xi[1], 0.0, 0.0], ..case.row() };
    let rows: Vec<_> = cases.iter().map(row).collect();
    let mut below = 0;
    for ((case, xi), value) in cases.iter().zip(ask(&gpu, shared::BSDF_PROBE_SAMPLE, &rows)) {
        let (wi, pdf) = (Vec3::from_slice(&value).as_dvec3(), value[3]);
        assert!((wi.length() - 1.0).abs() <= 2e-7, "{case}\n  xi {xi:?}\n  wi {wi}");
        let possible = if wi.z > 0.0 { pdf > 0.0 && pdf.is_finite() } else { pdf == 0.0 };
        assert!(possible, "{case}\n  xi {xi:?}\n  wi {wi}, density {pdf}");
        below += u32::from(wi.z <= 0.0);
    }
    println!("{} samples, {below} below the surface", cases.len());
    gpu.finish();
}

/// Mean and variance of f cosθ/pdf, of one channel.
#[derive(Default)]
struct Weights {
    n: f64,
    mean: f64,
    squares: f64,
}

impl Weights {
    fn add(&mut self, weight: f64) {
        self.n += 1.0;
        let step = weight - self.mean;
        self.mean += step / self.n;
        self.squares += step * (weight - self.mean);
    }

    fn variance(&self) -> f64 {
        self.squares / (self.n - 1.0)
    }
}

/// Directions that the device samples for each case, and f cosθ/pdf there.
fn weights(gpu: &CheckedGpu, cases: &[Case], seed: u64) -> Vec<(Case, DVec3)> {
    let row = |(i, case): (usize, &Case)| {
        let xi = random_pair(seed, i as u32).as_vec2();
        shared::BsdfProbeRow { wi: [xi.x, xi.y, 0.0, 0.0], ..case.row() }
    };
    let rows: Vec<_> = cases.iter().enumerate().map(row).collect();
    let sampled = ask(gpu, shared::BSDF_PROBE_SAMPLE, &rows);
    let aim = |(case, v): (&Case, [f32; 4])| Case { wi: Vec3::from_slice(&v).as_dvec3(), ..*case };
    let cases: Vec<_> = cases.iter().zip(sampled).map(aim).collect();
    let values = eval_mixed(gpu, shared::BSDF_PROBE_EVAL, &cases);
    let weight = |(case, (f, pdf)): (Case, (DVec3, f64))| {
        (case, if pdf > 0.0 { f * (case.wi.z / pdf) } else { DVec3::ZERO })
    };
    cases.into_iter().zip(values).map(weight).collect()
}

#[test]
fn monte_carlo_albedos_of_the_tables() {
    const N: usize = 1 << 14;
    let gpu = CheckedGpu::open();
    for (model, ..) in MODELS {
        let (mut variance, mut worst) = (0.0_f64, 0.0_f64);
        let figures = figures(model, &albedos(model));
        for (seed, figure) in spread(figures.len()).into_iter().map(|i| (i as u64, &figures[i])) {
            let case = Case::new(&figure.bsdf, figure.wo, DVec3::Z);
            let mut sum = Weights::default();
            weights(&gpu, &vec![case; N], 1000 + seed).iter().for_each(|(_, weight)| sum.add(weight.y));
            let error = (sum.mean - figure.want.y).abs();
            // The tables are good to 2e-4.
            let allowed = 4.0 * (sum.variance() / sum.n).sqrt() + 2e-4;
            assert!(error <= allowed, "{figure}: got {}, within {allowed}", sum.mean);
            variance = variance.max(sum.variance());
            worst = worst.max(error / allowed);
        }
        println!("{model}: variance of white weights ≤ {variance:.3}; error ≤ {worst:.2} of the bound");
    }
    gpu.finish();
}

/// Greatest f cosθ/pdf of materials with reflectances of 1 at most. Visible normals leave F times the shadowing, over the
/// share of the lobe, which is 0.1 at least; diffuse lobes of plastic and substrate leave at most 1 over theirs.
const MOST: [f64; 5] = [4.0, 10.0, 1.001, 10.0, 10.0];

#[test]
fn weights_are_bounded() {
    let gpu = CheckedGpu::open();
    let sampled = weights(&gpu, &mixed_cases(100_000), 5);
    for (model, (name, bound)) in MODEL_NAMES.into_iter().zip(MOST).enumerate() {
        let own = sampled.iter().skip(model).step_by(MODEL_NAMES.len());
        let (case, most) = own
            .map(|(case, weight)| (case, weight.max_element()))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        println!("{name}: weights ≤ {most:.3}");
        assert!(most <= bound, "{case}\n  weight {most}");
    }
    gpu.finish();
}
