//! The order of points on the device is that of the host.

use crate::common::gpu::CheckedGpu;
use amas::hilbert;
use amas::passes::order::OrderPass;
use glam::Vec3;

/// Points strewn evenly over a box.
fn strewn(count: usize) -> Vec<Vec3> {
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    (0..count).map(|_| Vec3::new(100.0 * next() - 50.0, 20.0 * next(), 100.0 * next() - 50.0)).collect()
}

#[test]
fn the_device_has_the_order_of_the_host() {
    let gpu = CheckedGpu::open();
    let random = strewn(65_537);
    // A vector, a workgroup, a block and 32 blocks of points, and one more or less of each.
    let mut worlds: Vec<Vec<Vec3>> = [0, 1, 7, 8, 9, 255, 256, 257, 2047, 2048, 2049, 65_536, 65_537]
        .into_iter()
        .map(|count: usize| random[..count].to_vec())
        .collect();
    worlds.push(vec![Vec3::new(3.0, -2.0, 1e-3); 5000]);
    // Each place 17 times, scattered over all of the order.
    worlds.push((0..8500).map(|i| random[i * 7 % 500]).collect());
    // A plane, a line, far from the origin.
    worlds.push(random[..5000].iter().map(|p| Vec3::new(p.x, 0.0, p.z)).collect());
    worlds.push(random[..500].iter().map(|p| Vec3::new(1e6, p.y, -1e6)).collect());
    for points in worlds {
        let pass = OrderPass::new(&gpu, &points).unwrap();
        let want = hilbert::order(points.iter().copied());
        for _ in 0..2 {
            pass.run().unwrap();
            assert_eq!(pass.fetch().unwrap(), want, "{} points", points.len());
        }
    }
    // A few far points have a curve of their own on the host alone.
    let mut points = random[..5000].to_vec();
    points[17] = Vec3::splat(1e6);
    let pass = OrderPass::new(&gpu, &points).unwrap();
    pass.run().unwrap();
    let (one_curve, two) = (pass.fetch().unwrap(), hilbert::order(points.iter().copied()));
    assert_ne!(one_curve, two);
    let sorted = |order: &[u32]| {
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        sorted
    };
    assert_eq!(sorted(&one_curve), sorted(&two));
    gpu.finish();
}
