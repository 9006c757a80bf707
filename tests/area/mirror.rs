//! T12: what a nearly perfect mirror shows, by the estimators that ship.

use amas::ltc::{Layer, Lobe, Parameters};
use amas::scene::{AreaLight, AreaShape, Model};
use amas::shared::{TIER_CLOSED_FORM, TIER_LIGHTS, TIER_SHIPPED};
use glam::DVec3;

use crate::estimators::{Estimators, Row, light};

/// Least that a surface has: r = 0 … 0.03.
const ALPHA: f64 = 1e-3;
const DEGREES: [f64; 7] = [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0];

/// Towards the viewer, in the plane of x and z; the mirror direction; across it, in that plane and out of it.
fn frame(degrees: f64) -> [DVec3; 4] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [DVec3::new(-sin, 0.0, cos), DVec3::new(sin, 0.0, cos), DVec3::new(cos, 0.0, -sin), DVec3::Y]
}

/// At distance 1 and turned to the origin, moved from the mirror direction by two offsets.
fn square(degrees: f64, [in_plane, out]: [f64; 2], [half_in, half_out]: [f64; 2]) -> AreaLight {
    let [_, mirror, x, y] = frame(degrees);
    // y × x turns to the origin.
    let [center, u, v] = [mirror + in_plane * x + out * y, half_out * y, half_in * x].map(DVec3::as_vec3);
    light(AreaShape::Rect { center, u, v })
}

/// All of the albedo from a square that the mirror image fills, half of it from one that it fills half, none from others.
#[test]
fn a_mirror_shows_what_it_mirrors() {
    const FAR: f64 = 0.3;
    const SHARES: [f64; 8] = [1.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0];
    let squares = |&degrees: &f64| {
        let place = |at| square(degrees, at, [0.2, 0.2]);
        [[0.0, 0.0], [0.0, 0.2], [0.0, -0.2], [FAR, 0.0], [-FAR, 0.0], [0.0, FAR], [0.0, -FAR], [FAR, FAR]]
            .map(place)
    };
    let lights = DEGREES.iter().flat_map(squares).collect();
    let estimators = Estimators::new(Model::Metal, lights);
    let row = |(k, &degrees): (u32, &f64)| Row {
        alpha: ALPHA,
        wo: frame(degrees)[0],
        first: TIER_LIGHTS * k,
        count: TIER_LIGHTS,
    };
    let rows: Vec<_> = (0..).zip(&DEGREES).map(row).collect();
    // Beyond the nearest edge, 50 alpha in slopes from the mirror direction, lies 1/(4 · 50²) of the lobe; its quadrature
    // without the closed form is that of a square which is 200 times as wide as the lobe.
    let tiers = [([TIER_SHIPPED, 0], 1e-2), ([TIER_SHIPPED, 10], 1.5e-3), ([TIER_CLOSED_FORM, 0], 1.5e-3)];
    for (tier, bound) in tiers {
        for (values, degrees) in estimators.reflected(tier, &rows).iter().zip(DEGREES) {
            let parameters = Parameters { r: ALPHA.sqrt(), cos: degrees.to_radians().cos() };
            let albedo = Lobe::new(Layer::Metal, parameters).albedo();
            for (value, want) in values.iter().zip(SHARES) {
                let share = f64::from(value.x) / albedo;
                let bound = if want == 0.0 { 6e-4 } else { bound };
                assert!((share - want).abs() < bound, "{tier:?} {degrees}°: {share}, want {want}");
            }
        }
    }
    estimators.gpu.finish();
}

/// The highlight of a light of a tenth of alpha moves from the mirror direction by no more than .05 alpha.
#[test]
fn the_peak_lies_in_the_mirror_direction() {
    const STEPS: i32 = 40;
    const STEP: f64 = 0.025;
    let offsets: Vec<f64> = (-STEPS..STEPS).map(|i| f64::from(i) * STEP).collect();
    let scan = |degrees: f64, out: bool| {
        offsets
            .iter()
            .map(move |offset| {
                let at = if out { [0.0, offset * ALPHA] } else { [offset * ALPHA, 0.0] };
                square(degrees, at, [0.05 * ALPHA; 2])
            })
            .collect::<Vec<_>>()
    };
    let lights =
        DEGREES.iter().flat_map(|&degrees| [scan(degrees, false), scan(degrees, true)]).flatten().collect();
    let estimators = Estimators::new(Model::Metal, lights);
    let rows_of = offsets.len() / TIER_LIGHTS as usize;
    let row = |k: usize| {
        let wo = frame(DEGREES[k / (2 * rows_of)])[0];
        Row { alpha: ALPHA, wo, first: TIER_LIGHTS * k as u32, count: TIER_LIGHTS }
    };
    let rows: Vec<_> = (0..2 * rows_of * DEGREES.len()).map(row).collect();
    for tier in [[TIER_SHIPPED, 0], [TIER_CLOSED_FORM, 0]] {
        let values = estimators.reflected(tier, &rows);
        for (k, scan) in values.chunks_exact(rows_of).enumerate() {
            let scan: Vec<_> = scan.iter().flatten().map(|value| f64::from(value.x)).collect();
            let peak = (1..scan.len() - 1).max_by(|&a, &b| scan[a].total_cmp(&scan[b])).unwrap();
            assert!(
                offsets[peak].abs() < 0.05 + 1e-9,
                "{tier:?} {}°: {} alpha",
                DEGREES[k / 2],
                offsets[peak]
            );
        }
    }
    estimators.gpu.finish();
}
