//! Lights without a range through the cuts of their tree, against brute force.

use crate::cut_worlds::{KINDS, Kind, TURNS, glossy, lights, matte, seeded, smooth, turned, world};
use crate::support::{FIVE_MATERIALS, Rig};
use amas::gpu::Use;
use amas::shared::NO_CLUSTER;
use amas::{HdrImage, Scene};
use glam::Vec3;

/// Relative errors against brute force over the values of all pixels with a surface, 1 % of the mean being the floor of
/// the denominator; and what the report says of them.
#[derive(Debug)]
struct Figures {
    mean: f64,
    p99: f64,
    bias: f64,
    estimate: f64,
}

fn brute(world: &Scene) -> HdrImage {
    Rig::with(world.clone(), |settings| settings.brute_force = true).render()
}

fn cut(world: &Scene, light_error: f32) -> Rig {
    Rig::with(world.clone(), |settings| settings.light_error = light_error)
}

fn covered(rig: &Rig) -> Vec<usize> {
    let (targets, _) = rig.frame.cluster_targets();
    let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    (0..ids.len()).filter(|&i| ids[i] != NO_CLUSTER).collect()
}

fn figures(world: &Scene, brute: &HdrImage, light_error: f32) -> Figures {
    let mut rig = cut(world, light_error);
    let picture = rig.render();
    let counters = rig.frame.counters();
    assert!(counters.cut_entries > 0, "there is a cut");
    let values = |image: &HdrImage, pixels: &[usize]| -> Vec<f64> {
        pixels.iter().flat_map(|&i| image.pixels[i]).map(f64::from).collect()
    };
    let covered = covered(&rig);
    let (got, want) = (values(&picture, &covered), values(brute, &covered));
    let n = want.len() as f64;
    let floor = 0.01 * want.iter().sum::<f64>() / n;
    let errors: Vec<f64> = got.iter().zip(&want).map(|(got, want)| (got - want) / want.max(floor)).collect();
    let mut sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let found = Figures {
        mean: sizes.iter().sum::<f64>() / n,
        p99: sizes[(0.99 * n) as usize],
        bias: errors.iter().sum::<f64>() / n,
        estimate: rig.frame.light_error().unwrap(),
    };
    println!("  {light_error}: {} entries a cluster, {found:.5?}", counters.cut_entries / counters.occupied);
    found
}

/// What `light_error` promises.
fn assert_kept(found: &Figures, light_error: f32, context: &str) {
    let allowed = f64::from(light_error);
    assert!(found.mean <= allowed, "{context}: mean {found:?}");
    assert!(found.p99 <= 4.0 * allowed, "{context}: p99 {found:?}");
    assert!(found.bias.abs() <= 0.25 * allowed, "{context}: bias {found:?}");
}

fn assert_estimate(found: &Figures, context: &str) {
    // What float32 rounds of a picture is no error of the cut.
    let rounding = 1e-5;
    assert!(found.estimate <= 2.0 * found.mean + rounding, "{context}: estimate {found:?}");
    assert!(found.mean <= 2.0 * found.estimate + rounding, "{context}: estimate {found:?}");
}

const LIGHT_ERRORS: [f32; 4] = [0.05, 0.02, 0.01, 0.005];

/// Three seeds of each, each turned otherwise: the order of the lights along their curve, and with it the tree, is another.
#[test]
fn seven_scenes_of_thirty_thousand_lights() {
    for kind in KINDS {
        for (seed, turn) in TURNS.into_iter().enumerate() {
            println!("{kind:?}, seed {seed}");
            let world = turned(world(&matte(0), seeded(kind, 30_000, seed as u32)), turn);
            let brute = brute(&world);
            for light_error in LIGHT_ERRORS {
                let found = figures(&world, &brute, light_error);
                let context = format!("{kind:?}, seed {seed}, at {light_error}");
                assert_kept(&found, light_error, &context);
                assert_estimate(&found, &context);
            }
        }
    }
}

/// A quarter of the pixels: brute force takes 10 CPU seconds then.
#[test]
fn a_million_lights() {
    let mut world = world(&matte(0), lights(Kind::Uniform, 1 << 20));
    world.render.size = [32, 32];
    let brute = brute(&world);
    for light_error in LIGHT_ERRORS {
        let found = figures(&world, &brute, light_error);
        assert_kept(&found, light_error, "a million");
        assert_estimate(&found, "a million");
    }
}

/// Oren and Nayar's, and lobes of alpha 0.02 to 0.1: a mirrored light neither vanishes nor spreads.
#[test]
fn rough_and_smooth_materials() {
    for (name, text) in [("rough", matte(30)), ("smooth", smooth())] {
        for kind in [Kind::Uniform, Kind::OneDominant] {
            println!("{name}, {kind:?}");
            let world = world(&text, lights(kind, 10_000));
            let brute = brute(&world);
            for light_error in [0.02, 0.005] {
                let found = figures(&world, &brute, light_error);
                assert_kept(&found, light_error, name);
                assert_estimate(&found, name);
            }
        }
    }
}

/// Lobes as wide as nodes: to them each node is a spread, not a point.
#[test]
fn glossy_surfaces() {
    let materials = [
        ("metal", 0.4),
        ("metal", 0.2),
        ("metal", 0.1),
        ("metal", 0.05),
        ("plastic", 0.4),
        ("plastic", 0.05),
    ];
    for (material, alpha) in materials {
        for kind in [Kind::Uniform, Kind::BeyondFar, Kind::HalfBehind] {
            println!("{material} of alpha {alpha}, {kind:?}");
            let world = world(&glossy(material, alpha), lights(kind, 20_000));
            let brute = brute(&world);
            for light_error in [0.05, 0.01] {
                let found = figures(&world, &brute, light_error);
                let context = format!("{material} of alpha {alpha}, {kind:?}, at {light_error}");
                assert_kept(&found, light_error, &context);
                assert_estimate(&found, &context);
            }
        }
    }
}

/// One far and bright light among many, mirrored in a metal floor of alpha 0.02: its highlight is that of brute force.
#[test]
fn a_far_bright_light_mirrored_in_smooth_metal() {
    let mut all = lights(Kind::BeyondFar, 5000);
    for (i, light) in all.iter_mut().enumerate() {
        // Some around it, so that it is in no node alone.
        if i < 500 {
            let around = Vec3::new((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32);
            light.position = Vec3::new(0.0, 60.0, -150.0) + around;
        }
    }
    all[0].intensity = Vec3::splat(1e5);
    let floor = "size = 8\nmaterial = \"matte\"";
    let text = FIVE_MATERIALS.replace("alpha = [0.2, 0.4]", "alpha = 0.02");
    let world = world(&text.replace(floor, &floor.replace("matte", "metal")), all);
    let brute = brute(&world);
    let picture = cut(&world, 0.01).render();
    let red = |image: &HdrImage| -> Vec<f32> { image.pixels.iter().map(|pixel| pixel[0]).collect() };
    let (got, want) = (red(&picture), red(&brute));
    let peak = want.iter().copied().fold(0.0, f32::max);
    let median = {
        let mut sorted: Vec<_> = want.iter().copied().filter(|v| *v > 0.0).collect();
        sorted.sort_by(f32::total_cmp);
        sorted[sorted.len() / 2]
    };
    assert!(peak > 50.0 * median, "there is a highlight: {peak}, {median} elsewhere");
    let bright = (0..want.len()).filter(|&i| want[i] > 0.1 * peak);
    let worst = bright.map(|i| (got[i] / want[i] - 1.0).abs()).fold(0.0, f32::max);
    println!("{worst:.5} off at most in the highlight");
    assert!(worst <= 0.01, "{worst}");
}

/// Neighbouring pixels of a smooth diffuse floor: the error of the cut changes no more across a border of clusters, on
/// average, than a 200th of the picture, nor more than twice what it changes within them plus a tenth of the budget.
#[test]
fn borders_of_clusters_do_not_show() {
    for kind in [Kind::Uniform, Kind::BeyondFar, Kind::HalfBehind] {
        let floor = matte(0).split("[[mesh]]\nshape = \"sphere\"").next().unwrap().to_owned();
        let world = world(&floor.replace("target = [0, 0.5, 0]", "target = [0, 0, 3]"), lights(kind, 30_000));
        let brute = brute(&world);
        let mut rig = cut(&world, 0.01);
        let picture = rig.render();
        let (targets, _) = rig.frame.cluster_targets();
        let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
        // Jump of the error, and of the picture, from each pixel to the one on its right.
        let (mut across, mut inside, mut gradient) = (Vec::new(), Vec::new(), Vec::new());
        for i in (0..64 * 64).filter(|i| i % 64 < 63 && ids[*i] != NO_CLUSTER && ids[*i + 1] != NO_CLUSTER) {
            let at = |i: usize| f64::from(picture.pixels[i][1] / brute.pixels[i][1]);
            let jump = (at(i + 1) - at(i)).abs();
            if ids[i] == ids[i + 1] {
                inside.push(jump)
            } else {
                across.push(jump)
            }
            gradient.push(f64::from((brute.pixels[i + 1][1] / brute.pixels[i][1] - 1.0).abs()));
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let worst = across.iter().copied().fold(0.0, f64::max);
        println!(
            "{kind:?}: across {:.5} (worst {worst:.5}), inside {:.5}, picture {:.5}",
            mean(&across),
            mean(&inside),
            mean(&gradient)
        );
        assert!(mean(&across) <= 0.002 && worst <= 0.01, "{kind:?}");
        assert!(mean(&across) <= 2.0 * mean(&inside) + 0.001, "{kind:?}");
    }
}

#[test]
fn cuts_and_pictures_are_the_same_bytes_on_every_run() {
    let world = world(FIVE_MATERIALS, lights(Kind::Uniform, 5000));
    let run = || {
        let mut rig = cut(&world, 0.01);
        let picture = rig.render();
        let (_, targets) = rig.frame.cluster_targets();
        let count = rig.frame.counters().clusters as usize;
        let texels: Vec<[u32; 4]> = targets.lists.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
        let used = rig.frame.counters().list_texels as usize;
        let clusters = targets.clusters.fetch(Use::ComputeWrite).unwrap();
        (picture, texels[..used].to_vec(), clusters[..count].to_vec())
    };
    let first = run();
    for _ in 0..4 {
        assert!(run() == first);
    }
}

/// Every node, leaf and root of every cut: together they hold each light exactly once.
#[test]
fn every_cut_holds_every_light_once() {
    for kind in [Kind::Uniform, Kind::AlongSurfaces, Kind::TenDecades] {
        let mut rig = cut(&world(&matte(0), lights(kind, 20_000)), 0.01);
        rig.render();
        let (_, targets) = rig.frame.cluster_targets();
        let texels: Vec<[u32; 4]> = targets.lists.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
        let clusters = targets.clusters.fetch(Use::ComputeWrite).unwrap();
        let nodes = &rig.gpu_scene.lights.moments;
        let ids = &clusters[..rig.frame.counters().clusters as usize];
        // Some numbers are left out between blocks.
        for cluster in ids.iter().filter(|cluster| cluster.pixel_count > 0) {
            let entry = |first: u32, i: u32| texels[(first + i / 4) as usize][(i % 4) as usize];
            let roots = cluster.cut + cluster.cut_nodes.div_ceil(4);
            let leaves = roots + cluster.cut_roots.div_ceil(4);
            let of_node = |index: u32| (nodes[index as usize].first, nodes[index as usize].count);
            let mut spans: Vec<(u32, u32)> =
                (0..cluster.cut_nodes).map(|i| of_node(entry(cluster.cut, i))).collect();
            spans.extend((0..cluster.cut_roots).map(|i| of_node(entry(roots, i))));
            spans.extend((0..cluster.cut_leaves).map(|i| (entry(leaves, i), 8)));
            spans.sort_unstable();
            let mut next = 0;
            for (first, count) in spans {
                assert_eq!(first, next, "{kind:?}");
                next = first + count;
            }
            assert_eq!(next, 20_000, "{kind:?}");
        }
    }
}

/// Support asserts that every value is finite, and the validation layers that nothing is out of bounds.
#[test]
fn hard_cases_stay_finite() {
    let at = |place: Vec3, scale: f32| {
        let mut all = lights(Kind::Uniform, 600);
        all.iter_mut().for_each(|light| (light.position, light.intensity) = (place, light.intensity * scale));
        all
    };
    let in_plane = |size: f32| {
        let mut all = lights(Kind::Uniform, 5000);
        for (i, light) in all.iter_mut().enumerate() {
            let height = if i % 3 == 0 { 1e-6 * light.position.y } else { 0.0 };
            light.position = (light.position * Vec3::new(1.0, 0.0, 1.0)).with_y(height) * size;
            light.intensity *= if i % 5 == 0 { 1e18 } else { 1.0 };
        }
        all
    };
    let mut extreme = lights(Kind::Uniform, 600);
    extreme
        .iter_mut()
        .enumerate()
        .for_each(|(i, light)| light.intensity *= if i % 2 == 0 { 1e18 } else { 1e-38 });
    let cases = [
        ("on the floor", at(Vec3::new(0.0, 0.0, 1.0), 1.0)),
        ("at the eye", at(Vec3::new(0.0, 1.5, 5.0), 1.0)),
        ("in the floor's plane, near", in_plane(0.3)),
        ("in the floor's plane, far", in_plane(1e4)),
        ("in the floor's plane, at the end of the world", in_plane(1e12)),
        ("dark", at(Vec3::ONE, 0.0)),
        ("extreme", extreme),
        ("one light", lights(Kind::Uniform, 1)),
        ("none", vec![]),
    ];
    for (name, all) in cases {
        println!("{name}");
        let mut world = world(FIVE_MATERIALS, all);
        for size in [[64, 64], [1, 1], [67, 9]] {
            world.render.size = size;
            cut(&world, 0.01).render();
        }
    }
    let text = FIVE_MATERIALS.replace("vertical_fov = 40", "orthographic_height = 4");
    let world = world(&text, lights(Kind::Uniform, 5000));
    let found = figures(&world, &brute(&world), 0.02);
    assert_kept(&found, 0.02, "orthographic");
}

/// More lights than a tile has pixels, all in one cluster.
#[test]
fn all_lights_within_one_cluster() {
    let mut all = lights(Kind::Uniform, 60_000);
    for light in &mut all {
        light.position = Vec3::new(0.2, 0.05, 2.0) + 0.01 * light.position;
    }
    let world = world(&matte(0), all);
    let found = figures(&world, &brute(&world), 0.002);
    assert_kept(&found, 0.002, "one cluster");
}

/// Sum of all values over that of brute force, less 1.
fn energy(picture: &HdrImage, brute: &HdrImage) -> f64 {
    let sum = |image: &HdrImage| image.pixels.iter().flatten().map(|&v| f64::from(v)).sum::<f64>();
    sum(picture) / sum(brute) - 1.0
}

/// The frame is rendered again with more room, and nothing is lost.
#[test]
fn cuts_that_do_not_fit_get_room() {
    let mut world = world(&matte(0), lights(Kind::Uniform, 30_000));
    world.render.size = [320, 200];
    let mut rig = cut(&world, 0.0021);
    let room = |rig: &Rig| rig.frame.cluster_targets().1.capacity.texels;
    let before = room(&rig);
    let picture = rig.render();
    let counters = rig.frame.counters();
    println!("{before} texels at first, {} needed", counters.list_texels);
    assert!(counters.list_texels > before, "they do not fit at first");
    assert!(counters.list_texels <= room(&rig) && counters.cut_given_up == 0);
    let energy = energy(&picture, &brute(&world));
    assert!(energy.abs() <= 0.0021, "{energy}");
}

/// 90,000 lights so far away that float32 has no squares of their distances: no node of them is far enough to stand for its
/// lights, and their leaves are more than a draw may have steps for. The frame says so, and evaluates every light instead.
#[test]
fn cuts_of_too_many_steps_are_given_up_for_every_light() {
    let mut all = lights(Kind::Uniform, 100_000);
    all[10_000..].iter_mut().for_each(|light| light.position = (light.position - Vec3::Y) * 1e20);
    let mut world = world(FIVE_MATERIALS, all);
    world.render.size = [16, 16];
    let mut rig = cut(&world, 0.01);
    let picture = rig.render();
    assert_eq!((rig.frame.counters().cut_entries, rig.frame.light_error().unwrap()), (0, 0.0), "no cuts");
    assert_eq!(picture, brute(&world), "every light");
}

/// 500,000 lights so far away that no node of them stands for its lights, all but 1,500 dark: no cluster's walk over their tree
/// comes to its end, which leaves each the whole tree to be opened by its pixels. For these it is not too large.
#[test]
fn walks_of_too_many_visits_leave_the_tree_to_the_pixels() {
    let mut all = lights(Kind::Uniform, 502_000);
    for (i, light) in all[2000..].iter_mut().enumerate() {
        light.position = (light.position - Vec3::Y) * 1e20;
        light.intensity *= if i % 333 == 0 { 1.0 } else { 0.0 };
    }
    let mut world = world(&matte(0), all);
    world.render.size = [16, 16];
    let mut rig = cut(&world, 0.01);
    let picture = rig.render();
    let counters = rig.frame.counters();
    assert_eq!((counters.cut_entries, counters.cut_given_up), (counters.occupied, 0), "a root each");
    assert!(counters.occupied > 0);
    let energy = energy(&picture, &brute(&world));
    assert!(energy.abs() <= 0.01, "{energy}");
}

/// An error of 0 or next to it evaluates every light, and so does a scene with few of them.
#[test]
fn no_error_is_no_cut() {
    for (count, light_error) in [(600, 0.0), (600, 0.0019), (500, 0.01)] {
        let world = world(FIVE_MATERIALS, lights(Kind::Uniform, count));
        let mut rig = cut(&world, light_error);
        assert_eq!(rig.render(), brute(&world));
        assert_eq!((rig.frame.counters().cut_entries, rig.frame.light_error().unwrap()), (0, 0.0));
    }
}
