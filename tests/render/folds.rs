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

/// What folding did to a picture, and what the frame says that it did.
struct Cost {
    /// Of the picture's sum.
    energy: f64,
    /// Mean error, of the picture's mean.
    mean: f64,
    /// Mean over the pixels with a surface of the error of their cluster, of its mean.
    clusters: f64,
    /// What the frame takes for that.
    estimate: f64,
    /// The largest of a cluster.
    largest: f64,
}

impl Cost {
    fn of(name: &str, rig: &mut Rig, truth: &HdrImage) -> Self {
        let picture = rig.render();
        let counters = rig.frame.counters();
        assert!(counters.folded > 0, "{name}: the cap cuts something");
        let pairs = || picture.pixels.iter().flatten().zip(truth.pixels.iter().flatten());
        let cost = Self {
            energy: energy(&picture) / energy(truth) - 1.0,
            mean: pairs().map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / energy(truth),
            clusters: cluster_error(rig, &picture, truth),
            estimate: rig.frame.light_error().unwrap(),
            largest: f64::from(f32::from_bits(counters.fold_error)),
        };
        println!(
            "{name}: {} of {} folded, energy {:+.2e}, mean error {:.2e}, clusters {:.2e}, estimate {:.2e} ({:.2}), largest {:.2e}",
            counters.folded,
            counters.folded + counters.entries,
            cost.energy,
            cost.mean,
            cost.clusters,
            cost.estimate,
            cost.estimate / cost.clusters,
            cost.largest
        );
        cost
    }

    /// Energy, and where something is moved the estimate, as a multiple of the error.
    fn check(self, [least, most]: [f64; 2]) -> Self {
        assert!(self.energy.abs() <= 0.01, "energy {:+.4}", self.energy);
        let allowed = least * self.clusters..=most * self.clusters;
        assert!(
            self.clusters < 1e-6 || allowed.contains(&self.estimate),
            "estimate {}, {allowed:?}",
            self.estimate
        );
        assert!(self.largest >= self.estimate, "the largest is not below the mean");
        self
    }
}

fn cluster_error(rig: &Rig, picture: &HdrImage, truth: &HdrImage) -> f64 {
    let (ids, clusters) = occupied(rig);
    let mut sums = vec![[0.0; 3]; clusters.len()];
    let covered =
        ids.iter().zip(picture.pixels.iter().zip(&truth.pixels)).filter(|(id, _)| **id != NO_CLUSTER);
    for (&id, (a, b)) in covered {
        let [error, light, pixels] = &mut sums[id as usize];
        *error += a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
        *light += b.iter().map(|&b| f64::from(b)).sum::<f64>();
        *pixels += 1.0;
    }
    let lit = sums.iter().filter(|[_, light, _]| *light > 0.0);
    let errors: f64 = lit.map(|[error, light, pixels]| error / light * pixels).sum();
    errors / sums.iter().map(|[_, _, pixels]| pixels).sum::<f64>()
}

const CAPS: [u32; 4] = [8, 16, 64, 128];

/// Every light evaluated at every pixel.
fn truth(text: &str) -> HdrImage {
    Rig::with(scene(text), |settings| settings.brute_force = true).render()
}

/// Energy, counters and the estimate, for caps from tight to loose.
#[test]
fn caps_keep_the_energy_and_say_what_they_cost() {
    for (name, lights) in cases() {
        let truth = truth(&format!("{FIVE_MATERIALS}{lights}"));
        for cap in CAPS {
            let mut rig = capped(&lights, cap);
            Cost::of(&format!("{name}, {cap}"), &mut rig, &truth).check([0.5, 2.0]);
            check_counters(&rig, cap);
        }
    }
}

/// A matte plane seen from above, in clusters of 4 × 4 pixels a metre wide, and lights.
fn plane(rotate: [f64; 3], lights: &str) -> String {
    format!(
        "[render]\nsize = [24, 24]\n[[camera]]\nname = \"main\"\nposition = [0, 9, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\n\
         orthographic_height = 6.0\n[[material]]\nname = \"grey\"\ntype = \"matte\"\ncolor = [0.5, 0.5, 0.5]\n\
         [[mesh]]\nshape = \"plane\"\nsize = 20\nmaterial = \"grey\"\nrotate = {rotate:?}\n{lights}"
    )
}

/// Lights with a range.
fn points(count: usize, [min, max]: [[f64; 3]; 2], range: f64) -> String {
    format!(
        "[[light]]\ntype = \"points\"\ngenerate = {{ count = {count}, seed = 3, min = {min:?}, max = {max:?}, \
         intensity = [0.1, 1.0], range = {range:?} }}\n"
    )
}

/// Thousands of lights in every cluster that reach 2 cm, over it and below, level with its box and not.
#[test]
fn lights_smaller_than_their_cluster() {
    let layer =
        |low: f64, high: f64, range: f64| points(250_000, [[-3.5, low, -3.5], [3.5, high, 3.5]], range);
    let scenes = [
        ("floor", plane([0.0; 3], &layer(0.002, 0.018, 0.02))),
        ("both sides", plane([0.0; 3], &layer(-0.018, 0.018, 0.02))),
        ("slope", plane([20.0, 0.0, 25.0], &layer(-1.5, 1.5, 0.3))),
    ];
    for (name, text) in scenes {
        let truth = truth(&text);
        for cap in CAPS {
            let mut rig = Rig::with(scene(&text), |settings| settings.max_lights_per_cluster = cap);
            Cost::of(&format!("{name}, {cap}"), &mut rig, &truth).check([0.5, 2.0]);
        }
    }
}

/// Clusters 2 m wide, and many lights at one point, near and far.
#[test]
fn one_point_over_wide_clusters() {
    for height in [1.0, 3.0] {
        let lights = points(20_000, [[0.2, height, 0.3]; 2], 9.0);
        let text = plane([0.0; 3], &lights)
            .replace("orthographic_height = 6", "orthographic_height = 12")
            .replace("size = 20", "size = 40");
        let truth = truth(&text);
        for cap in [8, 1024] {
            let mut rig = Rig::with(scene(&text), |settings| settings.max_lights_per_cluster = cap);
            Cost::of(&format!("{height} m, {cap}"), &mut rig, &truth).check([0.5, 2.0]);
        }
    }
}

/// A million lights at one point in every list, each of which each invocation of lavapipe has iterations for: it ends a shader's
/// loops after 65,535, silently, and what is folded by then would be all.
#[test]
fn a_million_lights_in_a_list() {
    let lights = points(1 << 20, [[0.0, 1.5, 1.0]; 2], 20.0);
    let text = format!("{FIVE_MATERIALS}{lights}").replace("size = [96, 64]", "size = [16, 16]");
    let truth = truth(&text);
    let mut rig = Rig::new(scene(&text));
    let energy = energy(&rig.render()) / energy(&truth) - 1.0;
    assert_eq!(rig.frame.counters().longest, 1 << 20);
    assert!(energy.abs() < 0.01, "energy {energy:+.2e}");
}

/// Two planes far apart, so that neither is at the origin, and the camera over one of them.
#[test]
fn far_from_the_origin() {
    let mut near = None;
    for x in [0.0, 1e4, 1e5, 1e6] {
        let scale = if x < 1e6 { 1.0 } else { 8.0 };
        let wide = |v: f64| scale * v;
        let text = plane(
            [0.0; 3],
            &points(
                4000,
                [[x - wide(4.0), wide(0.3), wide(-4.0)], [x + wide(4.0), wide(2.0), wide(4.0)]],
                wide(3.0),
            ),
        )
        .replace("position = [0, 9, 0]", &format!("position = [{x:?}, {:?}, 0]", wide(9.0)))
        .replace("target = [0, 0, 0]", &format!("target = [{x:?}, 0, 0]"))
        .replace("orthographic_height = 6.0", &format!("orthographic_height = {:?}", wide(6.0)))
        .replace("size = 20", &format!("size = {:?}\ntranslate = [{x:?}, 0, 0]", wide(20.0)));
        let text = format!(
            "{text}[[mesh]]\nshape = \"plane\"\nsize = 1\nmaterial = \"grey\"\ntranslate = [{:?}, -1, 0]\n",
            -x
        );
        let truth = truth(&text);
        let mut rig = Rig::with(scene(&text), |settings| settings.max_lights_per_cluster = 64);
        let cost = Cost::of(&format!("{x:e} m"), &mut rig, &truth).check([0.5, 2.0]);
        near.get_or_insert(cost.mean);
        let ratio = cost.mean / near.unwrap();
        assert!((0.9..=1.1).contains(&ratio), "{x:e} m: error {ratio} times that at the origin");
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
