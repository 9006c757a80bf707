//! Lists longer than the cap: the strongest lights stay, the others are folded, and the report says what that did.

use crate::support::{FIVE_MATERIALS, Rig, ranged_lights, scene};
use amas::HdrImage;
use amas::gpu::Use;
use amas::scene::PointLight;
use amas::shared::{Cluster, Counters, NO_CLUSTER};
use glam::{DVec3, Vec3};

/// Lights that overlap evenly, and lights in a few tight groups, some within the surfaces' reach.
fn cases() -> [(&'static str, String); 2] {
    let group = |min: [f32; 3], max: [f32; 3], seed: u32| {
        format!(
            "[[light]]\ntype = \"points\"\ngenerate = {{ count = 250, seed = {seed}, min = {min:?}, max = {max:?}, \
             intensity = [0.05, 1.0], range = 2.5 }}\n"
        )
    };
    let groups = [
        group([-2.0, 1.0, 0.5], [-1.2, 1.6, 1.4], 1),
        group([0.5, 0.8, 0.8], [0.9, 1.2, 1.3], 2),
        group([1.5, 1.5, -1.0], [2.5, 2.2, 0.2], 3),
        ranged_lights(300, 1.5),
    ];
    [("grid", ranged_lights(3000, 1.3)), ("groups", groups.concat())]
}

fn capped(lights: &str, cap: u32) -> Rig {
    Rig::with(scene(&format!("{FIVE_MATERIALS}{lights}")), |settings| settings.max_lights_per_cluster = cap)
}

fn energy(image: &HdrImage) -> f64 {
    image.pixels.iter().flatten().map(|&v| f64::from(v)).sum()
}

/// Lists, as boxes and lights make them in double precision.
fn expected(clusters: &[Cluster], lights: &[PointLight], cap: u32) -> Counters {
    let mut sums = Counters::default();
    let wide = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    for cluster in clusters {
        let (lower, upper) = (wide(cluster.lower), wide(cluster.upper));
        let reaches = |light: &&PointLight| {
            let position = light.position.as_dvec3();
            let range = f64::from(light.range.unwrap());
            let to_box = (lower - position).max(position - upper).max(DVec3::ZERO);
            to_box.length_squared() / (range * range) <= 1.00001
        };
        let reaching = lights.iter().filter(reaches).count() as u32;
        sums.entries += reaching.min(cap);
        sums.longest = sums.longest.max(reaching);
        sums.overflowed += u32::from(reaching > cap);
        sums.folded += reaching.saturating_sub(cap);
    }
    sums
}

/// Clusters that have pixels.
fn occupied(rig: &Rig) -> (Vec<u32>, Vec<Cluster>) {
    let (targets, lists) = rig.frame.cluster_targets();
    let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    (ids, lists.clusters.fetch(Use::ComputeWrite).unwrap())
}

fn check_counters(rig: &Rig, cap: u32) {
    let (ids, clusters) = occupied(rig);
    let mut used: Vec<u32> = ids.into_iter().filter(|&id| id != NO_CLUSTER).collect();
    used.sort_unstable();
    used.dedup();
    let used: Vec<Cluster> = used.iter().map(|&id| clusters[id as usize]).collect();
    let lights = &rig.gpu_scene.lights.lights[..rig.gpu_scene.lights.ranged];
    let (want, got) = (expected(&used, lights, cap), rig.frame.counters());
    assert_eq!(got.occupied as usize, used.len());
    assert_eq!(
        (got.entries, got.longest, got.overflowed, got.folded),
        (want.entries, want.longest, want.overflowed, want.folded)
    );
}

/// Mean error relative to the mean.
fn mean_error(capped: &HdrImage, whole: &HdrImage) -> f64 {
    let values = capped.pixels.iter().flatten().zip(whole.pixels.iter().flatten());
    values.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / energy(whole)
}

/// Energy, counters and the estimate, for caps from tight to loose.
#[test]
fn caps_keep_the_energy_and_say_what_they_cost() {
    for (name, lights) in cases() {
        let mut whole = capped(&lights, 2048);
        let picture = whole.render();
        assert_eq!(whole.frame.counters().folded, 0);
        assert_eq!(whole.frame.counters().fold_error, 0);
        for cap in [8, 16, 64, 128] {
            let mut rig = capped(&lights, cap);
            let folded = rig.render();
            check_counters(&rig, cap);
            let bias = energy(&folded) / energy(&picture) - 1.0;
            let mean = mean_error(&folded, &picture);
            let estimate = f64::from(f32::from_bits(rig.frame.counters().fold_error));
            println!(
                "{name}, {cap}: {} folded, energy {bias:+.2e}, mean error {mean:.2e}, estimate {estimate:.2e}",
                rig.frame.counters().folded
            );
            assert!(rig.frame.counters().folded > 0, "the cap cuts something");
            assert!(bias.abs() <= 0.01, "{name}, {cap}: energy {bias:+.4}");
            assert!(
                (mean..=4.0 * mean).contains(&estimate),
                "{name}, {cap}: estimate {estimate:.2e}, mean error {mean:.2e}"
            );
        }
    }
}

/// Bytes of lists and picture, from frame to frame.
#[test]
fn twenty_frames_are_the_same_to_the_byte() {
    let (_, lights) = &cases()[1];
    let mut rig = capped(lights, 32);
    let first = rig.render();
    let bytes = |rig: &Rig| {
        let lists = &rig.frame.cluster_targets().1.lists;
        let texels: Vec<[u32; 4]> = lists.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
        texels[..rig.frame.counters().list_texels as usize].to_vec()
    };
    let lists = bytes(&rig);
    for _ in 1..20 {
        assert!(rig.render() == first, "the picture");
        assert!(bytes(&rig) == lists, "the lists");
    }
}
