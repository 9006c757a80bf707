//! The tables are as near to their lobes as matrices of four numbers come, at the texels and between them.

use crate::{Random, at, tables};
use amas::ltc::{
    Assessment, Basis, Layer, Lobe, Objective, Parameters, assess, fit_layer, fit_texel, fit_work,
};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

fn of_table(layer: Layer, parameters: Parameters) -> Assessment {
    let lookup = tables().layer(layer).lookup(parameters);
    assess(&Lobe::new(layer, parameters), &lookup.inverse, lookup.mass())
}

/// A fit made now, started from the table and from the analytic limit.
fn anew(layer: Layer, parameters: Parameters, objective: Objective) -> Assessment {
    let lobe = Lobe::new(layer, parameters);
    let near = tables().layer(layer).shape_at(parameters);
    let shape = fit_texel(layer, parameters, objective, Some(near));
    assess(&lobe, &Basis::new(layer.frame(), &lobe).inverse(shape), lobe.albedo())
}

/// Angle in degrees, then total variation at r = 0.1, 0.2, 0.3, 0.5, 0.8 by another fitter of four
/// numbers, for GGX. Published matrices have up to .54.
const OTHERS: [(f64, [f64; 5]); 7] = [
    (0.0, [0.000, 0.001, 0.005, 0.016, 0.013]),
    (34.0, [0.001, 0.003, 0.009, 0.023, 0.020]),
    (61.0, [0.006, 0.020, 0.041, 0.069, 0.034]),
    (70.0, [0.010, 0.034, 0.069, 0.108, 0.044]),
    (78.0, [0.019, 0.067, 0.117, 0.143, 0.055]),
    (85.0, [0.049, 0.173, 0.199, 0.182, 0.073]),
    (88.0, [0.155, 0.339, 0.270, 0.201, 0.089]),
];

#[test]
fn as_good_as_others() {
    let cells = OTHERS.iter().flat_map(|(degrees, row)| {
        [0.1, 0.2, 0.3, 0.5, 0.8].into_iter().zip(row).map(|(r, others)| (at(r, *degrees), *others))
    });
    for (parameters, others) in cells {
        let (ours, best) =
            (of_table(Layer::Metal, parameters), anew(Layer::Metal, parameters, Objective::L1));
        println!("{parameters:?}: {:.4}; {others}", ours.variation);
        // Ours counts what leaks below the surface; at 85° and r = 0.3 the least there is, by a random search, is .2078.
        let slack = if others == 0.199 { 0.0105 } else { 0.003 };
        assert!(ours.variation < others + slack, "{parameters:?}: {ours:?} {others}");
        // And from below: no table is better than a fit for the very place, but for the noise of its 8,000 directions.
        let (slack, noise) = if parameters.cos < 0.05 { (0.012, 0.004) } else { (0.002, 0.002) };
        assert!(ours.variation > best.variation - noise, "{parameters:?}: {ours:?} {best:?}");
        assert!(ours.variation < best.variation + slack, "{parameters:?}: {ours:?} {best:?}");
    }
}

/// The most that interpolation adds to a layer's variation, below 87°.
const fn excess(layer: Layer) -> f64 {
    match layer {
        // Its lobe has two minima that change places at 84°.
        Layer::Clearcoat => 0.11,
        _ => 0.002,
    }
}

#[test]
fn interpolation_costs_little() {
    for layer in Layer::ALL {
        let mut random = Random(3 + layer as u64);
        let count = if layer == Layer::Metal { 500 } else { 60 };
        let places: Vec<_> = (0..count).map(|_| random.parameters(layer, 87.0)).collect();
        let excesses: Vec<_> = places
            .into_par_iter()
            .map(|place| {
                let (table, best) = (of_table(layer, place), anew(layer, place, Objective::L1));
                assert!(best.variation < table.variation + 0.002, "{layer:?} {place:?}: {best:?} {table:?}");
                (table.variation - best.variation, place)
            })
            .collect();
        let worst = excesses.iter().copied().reduce(|a, b| if b.0 > a.0 { b } else { a }).unwrap();
        println!("{layer:?}: {worst:?}");
        assert!(worst.0 < excess(layer), "{layer:?}: {worst:?}");
    }
}

/// The stored TV bounds the error of what the table makes of a lobe, at every angle.
#[test]
fn the_bound_holds() {
    for layer in Layer::ALL.into_iter().filter(|layer| *layer != Layer::SubstrateDiffuse) {
        let mut random = Random(77 + layer as u64);
        let [columns, rows] = layer.size().map(|side| (side - 1) as f64);
        let places: Vec<_> = (0..300)
            .map(|_| layer.parameters(random.between(0.0, columns), random.between(0.0, rows)))
            .collect();
        places.into_par_iter().for_each(|place| {
            let stored = tables().layer(layer).lookup(place).moments[3];
            let found = of_table(layer, place).bound;
            assert!(found <= stored, "{layer:?} {place:?}: {found} {stored}");
            assert!(stored <= 1.05, "{layer:?} {place:?}: {stored}");
        });
    }
}

/// A whole layer made anew is the one checked in, to the last bit on the machine that made it.
#[test]
fn the_table_is_what_the_fitter_makes() {
    let steps = AtomicU64::new(0);
    let count = || _ = steps.fetch_add(1, Ordering::Relaxed);
    let made = fit_layer(Layer::Sheen, Objective::L1, &count).table;
    assert_eq!(steps.into_inner(), fit_work(Layer::Sheen));
    let stored = tables().layer(Layer::Sheen);
    let pairs = |a: &[[f32; 4]], b: &[[f32; 4]]| -> Vec<[f32; 2]> {
        a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| [*a, *b]).collect()
    };
    let numbers = [pairs(&made.shape, &stored.shape), pairs(&made.moments, &stored.moments)].concat();
    for [made, stored] in numbers {
        assert!((made - stored).abs() < 2e-3, "{made} {stored}");
    }
    let again = fit_layer(Layer::Sheen, Objective::L1, &|| ()).table;
    assert_eq!(made, again);
}

/// Leaks stay small where surfaces are usually seen.
#[test]
fn leaks() {
    for degrees in [0.0, 30.0, 61.0, 78.0, 85.0] {
        for r in [0.05, 0.1, 0.3, 0.5, 0.8, 1.0] {
            let leak = of_table(Layer::Metal, at(r, degrees)).leak;
            assert!((0.0..0.03).contains(&leak), "{degrees}° r {r}: {leak}");
        }
    }
}

/// Mean squares keep the peak; total variation keeps the mass.
#[test]
fn objectives() {
    let parameters = at(0.508, 78.0);
    let [l1, l2] = [Objective::L1, Objective::L2].map(|o| anew(Layer::Metal, parameters, o));
    println!("L1 {l1:?}\nL2 {l2:?}");
    assert!(l1.variation < l2.variation && l2.variation < 0.19, "{l1:?} {l2:?}");
    assert!(l2.peak_shift < l1.peak_shift && l2.peak_shift < 4.5, "{l1:?} {l2:?}");
    assert!((l2.peak_height - 1.0).abs() < 0.08, "{l2:?}");
}

/// Between a layer for a low reflectance and one for F = 1, matrices of any reflectance: little worse than their own fits.
#[test]
fn other_reflectances() {
    let pairs = [
        [Layer::PrincipledDielectric, Layer::PrincipledSpecular],
        [Layer::SubstrateDielectric, Layer::SubstrateSpecular],
    ];
    let mut worst = 0.0_f64;
    for pair in pairs {
        for f0 in [0.04, 0.08, 0.15, 0.3, 0.6, 1.0] {
            for (r, degrees) in [(0.3, 30.0), (0.5, 60.0), (0.8, 60.0), (0.5, 75.0), (0.8, 80.0), (0.5, 85.0)]
            {
                let lobe = Lobe::new(pair[1], at(r, degrees));
                let lookup = tables().lookup_schlick(pair, r, lobe.wo.z, f0);
                let blended = variation(&lobe, f0, &lookup.inverse);
                let metal = variation(&lobe, f0, &tables().lookup(pair[1], r, lobe.wo.z).inverse);
                let low = variation(&lobe, f0, &tables().lookup(pair[0], r, lobe.wo.z).inverse);
                worst = worst.max(blended);
                let either = metal.min(low);
                assert!(blended < either + 0.012, "{pair:?} {f0} r {r} {degrees}°: {blended} {either}");
            }
        }
    }
    println!("worst total variation at any reflectance: {worst:.4}");
    assert!(worst < 0.2, "{worst}");
}

/// Total variation of a cosine and the lobe times Schlick's Fresnel, by the midpoint rule.
fn variation(lobe: &Lobe, f0: f64, inverse: &glam::DMat3) -> f64 {
    let (rings, sectors) = (400, 400);
    let mut cells = Vec::new();
    for ring in 0..rings {
        let z = (f64::from(ring) + 0.5) / f64::from(rings);
        let sin = (1.0 - z * z).sqrt();
        for sector in 0..sectors {
            let phi = std::f64::consts::PI * (f64::from(sector) + 0.5) / f64::from(sectors);
            let wi = glam::DVec3::new(sin * phi.cos(), sin * phi.sin(), z);
            let rest = 1.0 - 0.5 * (wi + lobe.wo).length();
            let fresnel = f0 + (1.0 - f0) * rest.powi(5);
            cells.push((lobe.eval(wi) * fresnel, amas::ltc::density(inverse, wi)));
        }
    }
    let cell = std::f64::consts::TAU / f64::from(rings * sectors);
    let mass: f64 = cells.iter().map(|(f, _)| f).sum::<f64>() * cell;
    let apart: f64 = cells.iter().map(|(f, d)| (f / mass - d).abs()).sum();
    0.5 * (apart * cell + amas::ltc::leak(inverse))
}
