//! Cluster lists against a brute-force list in double precision, pixel by pixel, under every kind of projection.

use crate::support::{Rig, scene};
use amas::gpu::Use;
use amas::passes::aov::Quantity;
use amas::reference::lights::reaching_point;
use amas::shared::{Cluster, LIST_HEIGHT_LOG2, LIST_WIDTH_LOG2, NO_CLUSTER};
use glam::Vec3;

/// Rooms of boxes and spheres; `camera` is the camera's text.
fn world(camera: &str, lights: &str, size: &str) -> String {
    let spheres: String = (0..12)
        .map(|i| {
            let (x, z) = (i % 4 * 3 - 5, i / 4 * 4 - 5);
            format!("[[mesh]]\nshape = \"sphere\"\nradius = 0.8\ntranslate = [{x}, 0.8, {z}]\n")
        })
        .collect();
    format!(
        "[render]\nsize = {size}\nmax_lights_per_cluster = 2048\n[[camera]]\nname = \"main\"\n{camera}\n\
         [[mesh]]\nshape = \"plane\"\nsize = 60\n{spheres}{lights}"
    )
}

const NEAR_LIGHTS: &str = "[[light]]\ntype = \"points\"\ngenerate = { count = 1500, seed = 11, min = [-9, 0, -12], \
                           max = [9, 4, 12], intensity = [1, 1], range = 1.3 }\n";

const PERSPECTIVE: &str = "position = [0, 3, 12]\ntarget = [0, 1, 0]\nvertical_fov = 60\n";

/// Indices of the cluster's list, without padding.
fn list(texels: &[[u32; 4]], cluster: &Cluster) -> Vec<u32> {
    let layer = 1_usize << (LIST_WIDTH_LOG2 + LIST_HEIGHT_LOG2);
    assert!(cluster.list as usize + (cluster.reaching as usize).div_ceil(4) <= texels.len().max(layer));
    (0..cluster.reaching).map(|i| texels[(cluster.list + i / 4) as usize][(i % 4) as usize]).collect()
}

/// The list of each id, empty where no cluster took it.
fn lists(rig: &Rig) -> Vec<Vec<u32>> {
    let (_, targets) = rig.frame.cluster_targets();
    let texels: Vec<[u32; 4]> = targets.lists.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    let clusters = targets.clusters.fetch(Use::ComputeWrite).unwrap();
    let ids = rig.frame.counters().clusters as usize;
    clusters[..ids].iter().map(|cluster| list(&texels, cluster)).collect()
}

/// Asserts that no reaching light is missing from any pixel's list; returns entries over reaching lights.
fn check(text: &str) -> f64 {
    let mut rig = Rig::new(scene(text));
    rig.render();
    check_lists(&rig)
}

/// The same of the picture last rendered.
fn check_lists(rig: &Rig) -> f64 {
    let positions = rig.aov(Quantity::Position);
    let (targets, _) = rig.frame.cluster_targets();
    let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
    let lists = lists(rig);
    let lights = &rig.gpu_scene.lights.lights[..rig.gpu_scene.lights.ranged];
    for list in &lists {
        assert!(list.windows(2).all(|pair| pair[0] < pair[1]), "ascending, so without duplicates");
    }
    let (mut entries, mut reaching) = (0, 0);
    for (&id, position) in ids.iter().zip(&positions) {
        let covered = position[3] > 0.0;
        assert_eq!(id != NO_CLUSTER, covered, "a cluster where a surface is");
        if covered {
            let list = &lists[id as usize];
            let point = Vec3::new(position[0], position[1], position[2]).as_dvec3();
            // Lights are where the device has them.
            let point = point - rig.gpu_scene.origin.as_dvec3();
            let truth = reaching_point(lights, point);
            for light in &truth {
                assert!(
                    list.binary_search(light).is_ok(),
                    "light {light} reaches {point} and is not in its list"
                );
            }
            entries += list.len();
            reaching += truth.len();
        }
    }
    assert!(reaching > 0, "the case tests something");
    entries as f64 / reaching as f64
}

fn report(name: &str, text: &str) {
    println!("{name}: {:.2} entries per reaching light", check(text));
}

#[test]
fn perspective_infinite_and_finite_far() {
    report("infinite", &world(PERSPECTIVE, NEAR_LIGHTS, "[160, 96]"));
    // Lights and surfaces lie across the far plane.
    report("far 14", &world(&format!("{PERSPECTIVE}far = 14\n"), NEAR_LIGHTS, "[160, 96]"));
    report("narrow", &world(&PERSPECTIVE.replace("60", "3"), NEAR_LIGHTS, "[160, 96]"));
    report("wide", &world(&PERSPECTIVE.replace("60", "150"), NEAR_LIGHTS, "[160, 96]"));
}

#[test]
fn orthographic_near_and_far() {
    let camera = "position = [0, 8, 12]\ntarget = [0, 0, 0]\northographic_height = 12\n";
    report("orthographic", &world(camera, NEAR_LIGHTS, "[160, 96]"));
    report("far 15", &world(&format!("{camera}near = 0.001\nfar = 15\n"), NEAR_LIGHTS, "[160, 96]"));
}

#[test]
fn sizes_that_are_no_multiple_of_a_tile() {
    for size in ["[1, 1]", "[7, 9]", "[161, 97]", "[8, 1]", "[16384, 1]", "[1, 16384]"] {
        report(
            size,
            &world("position = [0, 3, 9]\ntarget = [0, 0.5, 0]\nvertical_fov = 20\n", NEAR_LIGHTS, size),
        );
    }
}

#[test]
fn the_eye_inside_lights_and_close_to_a_surface() {
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 300, seed = 3, min = [-1, 0, 8], max = [1, 2, 13], \
                  intensity = [1, 1], range = 6 }\n";
    report(
        "inside",
        &world(
            "position = [0, 0.02, 12]\ntarget = [0, 0, 0]\nvertical_fov = 90\nnear = 0.001\n",
            lights,
            "[160, 96]",
        ),
    );
    report(
        "down",
        &world(
            "position = [0, 0.3, 12]\ntarget = [0, 0, 12]\nup = [0, 0, -1]\nvertical_fov = 60\n",
            lights,
            "[96, 96]",
        ),
    );
}

#[test]
fn far_from_the_origin_and_tiny_ranges() {
    let camera = "position = [1000, 1003, 1012]\ntarget = [1000, 1001, 1000]\nvertical_fov = 60\n";
    let text = world(
        camera,
        &NEAR_LIGHTS
            .replace("min = [-9, 0, -12]", "min = [991, 1000, 988]")
            .replace("max = [9, 4, 12]", "max = [1009, 1004, 1012]"),
        "[160, 96]",
    )
    .replace("size = 60\n", "size = 60\ntranslate = [1000, 1000, 1000]\n");
    report("offset", &text);
    let tiny =
        NEAR_LIGHTS.replace("max = [9, 4, 12]", "max = [9, 0.01, 12]").replace("range = 1.3", "range = 0.2");
    report("tiny", &world(PERSPECTIVE, &tiny, "[160, 96]"));
}

/// Random cameras over the same world.
#[test]
fn random_views() {
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / 16_777_216.0
    };
    for _ in 0..12 {
        let position = [next() * 16.0 - 8.0, 0.2 + next() * 6.0, next() * 20.0 - 10.0];
        let target = [next() * 6.0 - 3.0, 0.1, next() * 6.0 - 3.0];
        let camera = format!(
            "position = {position:?}\ntarget = {target:?}\nvertical_fov = {}\n",
            20.0 + 80.0 * next()
        );
        let name = format!("{position:.1?} to {target:.1?}");
        report(&name, &world(&camera, NEAR_LIGHTS, "[128, 72]"));
    }
}

/// Lights so dense that parents have no room for those that reach them, though clusters have.
#[test]
fn crowded_parents_are_split() {
    let dense = NEAR_LIGHTS.replace("count = 1500", "count = 60000").replace("range = 1.3", "range = 0.3");
    let mut rig = Rig::new(scene(&world(PERSPECTIVE, &dense, "[97, 57]")));
    rig.render();
    println!("dense: {:.2} entries per reaching light", check_lists(&rig));
    let counters = rig.frame.counters();
    assert!(counters.parents > counters.first_parent, "some were split");
    assert_eq!(counters.folded, 0);
}

/// Whatever the size of small workgroups: pictures, ids and lists.
#[test]
fn lanes_change_nothing() {
    // Three crowns, parents that are split, and a last workgroup of tiles that is not full.
    let dense = NEAR_LIGHTS.replace("count = 1500", "count = 300000").replace("range = 1.3", "range = 0.1");
    let results = [8, 16, 32].map(|lanes| {
        let scene = scene(&world(PERSPECTIVE, &dense, "[145, 90]"));
        let mut rig = Rig::with(scene, |settings| settings.lanes = Some(lanes));
        let picture = rig.render();
        let (targets, _) = rig.frame.cluster_targets();
        let ids: Vec<u32> = targets.cluster_ids.fetch(Use::FragmentRead, Use::FragmentRead).unwrap();
        assert!(rig.frame.counters().entries > 0);
        (picture, ids, lists(&rig))
    });
    assert!(results[0] == results[1] && results[0] == results[2]);
}
