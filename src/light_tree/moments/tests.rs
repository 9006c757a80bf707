use super::*;
use glam::Vec3;

fn random(seed: u32) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    }
}

fn uniform(count: usize) -> Vec<PointLight> {
    let mut next = random(7);
    let mut vec = || Vec3::new(next(), next(), next());
    (0..count).map(|_| PointLight { position: vec() * 10.0, intensity: vec(), range: None }).collect()
}

/// Each with what makes it hard.
fn cases(count: usize) -> Vec<(&'static str, Vec<PointLight>)> {
    let with = |change: &dyn Fn(usize, &mut PointLight)| {
        let mut lights = uniform(count);
        lights.iter_mut().enumerate().for_each(|(i, light)| change(i, light));
        lights
    };
    vec![
        ("uniform", uniform(count)),
        ("one point", with(&|_, light| light.position = Vec3::new(1.0, 2.0, 3.0))),
        ("dark", with(&|_, light| light.intensity = Vec3::ZERO)),
        ("half dark", with(&|i, light| light.intensity *= (i % 2) as f32)),
        ("red and blue", with(&|i, light| light.intensity = if i % 2 == 0 { Vec3::X } else { Vec3::Z })),
        ("ten decades", with(&|i, light| light.intensity *= 10_f32.powi(i as i32 * 7 % 11 - 5))),
        ("extreme", with(&|i, light| light.intensity *= if i % 3 == 0 { 1e18 } else { 1e-38 })),
        ("far away", with(&|_, light| light.position += 1e5)),
    ]
}

fn power(light: &PointLight) -> f64 {
    f64::from(light.intensity.element_sum()) / 3.0
}

#[test]
fn every_light_is_in_one_leaf_and_within_every_node_above_it() {
    for count in [1, 7, 8, 9, 64, 65, 1000] {
        for (name, lights) in cases(count) {
            let nodes = build(&lights, 5);
            let (null, nodes) = nodes.split_last().unwrap();
            assert_eq!((null.power, null.skip as usize), (0.0, nodes.len() + 1));
            let mut seen = vec![0; count];
            for (i, node) in nodes.iter().enumerate() {
                assert!(node.skip as usize > i && node.skip as usize <= nodes.len(), "{name}");
                let first = node.first as usize - 5;
                for leaf in nodes[i..node.skip as usize].iter().filter(|leaf| is_leaf(nodes, leaf)) {
                    for place in leaf.first as usize - 5..count.min(leaf.first as usize - 5 + LEAF) {
                        assert!(place >= first);
                        seen[place] += usize::from(std::ptr::eq(leaf, node));
                        let distance = (lights[place].position - Vec3::from(node.center)).length();
                        assert!(distance <= node.radius * 1.000_001, "{name}: {distance} of {}", node.radius);
                    }
                }
            }
            assert_eq!(seen, vec![1; count], "{name}");
        }
    }
}

fn is_leaf(nodes: &[MomentNode], node: &MomentNode) -> bool {
    let index = nodes.iter().position(|other| std::ptr::eq(other, node)).unwrap();
    node.skip as usize == index + 1
}

/// The root's moments against sums over the lights: what comes up through the levels is not lost.
#[test]
fn moments_equal_direct_sums() {
    for (name, lights) in cases(1000) {
        let root = build(&lights, 0)[0];
        let total: f64 = lights.iter().map(power).sum();
        let weights: Vec<f64> =
            lights.iter().map(|light| if total > 0.0 { power(light) / total } else { 1e-3 }).collect();
        let mean: glam::DVec3 =
            lights.iter().zip(&weights).map(|(light, w)| light.position.as_dvec3() * *w).sum();
        let close = |got: f32, want: f64, scale: f64, what: &str| {
            assert!(
                (f64::from(got) - want).abs() <= 2e-6 * scale + 1e-25,
                "{name}, {what}: {got}, {want} wanted"
            );
        };
        close(root.power, total, total, "power");
        for axis in 0..3 {
            // Weights of 1/1000 each are none.
            close(root.center[axis], mean[axis], if total > 0.0 { mean.length() } else { 1e6 }, "centre");
            let channel: f64 = lights.iter().map(|light| f64::from(light.intensity[axis])).sum();
            close(root.intensity[axis], channel, channel, "intensity");
        }
        let second = |a: usize, b: usize| -> f64 {
            let sum = lights.iter().zip(&weights).map(|(light, w)| {
                let d = light.position.as_dvec3() - mean;
                w * d[a] * d[b]
            });
            if total > 0.0 { sum.sum() } else { 0.0 }
        };
        let size = f64::from(root.radius).powi(2);
        for (axis, (a, b)) in [(0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
            close(root.diagonal[axis], second(axis, axis), size, "variance");
            close(root.mixed[axis], second(a, b), size, "covariance");
        }
        let shift = |axis: usize, channel: u32| {
            let word = [root.shift_x, root.shift_y, root.shift_z][axis];
            f64::from((word << (22 - 10 * channel)) as i32 >> 22) / 511.0
        };
        for channel in 0..3 {
            let sum: f64 = lights.iter().map(|light| f64::from(light.intensity[channel])).sum();
            for axis in 0..3 {
                let first: f64 = lights
                    .iter()
                    .map(|light| {
                        f64::from(light.intensity[channel]) * (f64::from(light.position[axis]) - mean[axis])
                    })
                    .sum();
                let want =
                    if sum > 0.0 && root.radius > 0.0 { first / sum / f64::from(root.radius) } else { 0.0 };
                assert!((shift(axis, channel as u32) - want).abs() <= 1.01 * 0.5 / 511.0, "{name}: shift");
            }
        }
    }
}

/// The series of `sums.rs` to second order, for 1/r² and for n·r/r³: what is left falls with the third power of the
/// node's size, without it with the second.
#[test]
fn second_moments_leave_third_order_errors() {
    let u = glam::DVec3::new(0.6, 0.48, 0.64);
    let n = glam::DVec3::new(0.0, 0.8, 0.6);
    let errors = |scale: f64| -> [f64; 4] {
        let mut lights = uniform(64);
        lights.iter_mut().for_each(|light| light.position *= scale as f32 / 10.0);
        let root = Sums::of_lights(&lights);
        let eye = root.center - u;
        let mean = |f: &dyn Fn(glam::DVec3) -> f64| {
            let sum = lights.iter().map(|light| power(light) * f(light.position.as_dvec3() - eye));
            sum.sum::<f64>() / root.power()
        };
        let [d, m] = root.covariance();
        let s = glam::DMat3::from_cols_array(&[d.x, m.x, m.y, m.x, d.y, m.z, m.y, m.z, d.z]);
        let (usu, nsu, trace) = (u.dot(s * u), n.dot(s * u), d.element_sum());
        let falloff = mean(&|r| r.length_squared().recip());
        let cosine = mean(&|r| n.dot(r) / r.length().powi(3));
        [
            falloff - 1.0,
            falloff - (1.0 + 4.0 * usu - trace),
            cosine - n.dot(u),
            cosine - (n.dot(u) * (1.0 + 7.5 * usu - 1.5 * trace) - 3.0 * nsu),
        ]
    };
    let (coarse, fine) = (errors(0.04), errors(0.02));
    for (i, order) in [4.0, 8.0, 4.0, 8.0].into_iter().enumerate() {
        let ratio = coarse[i] / fine[i];
        assert!((ratio / order - 1.0).abs() < 0.2, "{i}: {ratio}, about {order} expected");
        if i % 2 == 1 {
            assert!(coarse[i].abs() < 0.25 * coarse[i - 1].abs(), "{coarse:?}");
        }
    }
}

#[test]
fn nodes_of_one_place_or_without_light_have_no_error() {
    for (name, lights) in cases(100) {
        let exact = name == "one point" || name == "dark";
        for node in build(&lights, 0) {
            let values = [node.radius, node.power, node.diagonal[0], node.mixed[0], node.intensity[0]];
            assert!(values.iter().all(|value| value.is_finite()), "{name}");
            assert!(!exact || node.error == 0.0, "{name}");
        }
    }
}
