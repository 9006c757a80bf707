//! Every node of the tree holds its lights.

use amas::scene::PointLight;
use amas::shared::{VIRTUAL_ISOTROPIC, VirtualLight, VirtualPair};
use amas::virtual_lights::VirtualTree;
use amas::virtual_lights::octahedral::{Cone, pack_normal, unpack_normal};
use glam::{DVec3, Vec3};

use crate::color;

/// Numbers in [0, 1).
pub(crate) fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn direction(next: &mut impl FnMut() -> f64) -> DVec3 {
    loop {
        let p = DVec3::new(next(), next(), next()) * 2.0 - 1.0;
        if (1e-3..1.0).contains(&p.length()) {
            return p.normalize();
        }
    }
}

fn lights(count: usize, spread: f64) -> Vec<VirtualLight> {
    let mut next = random(count as u64);
    let mut light = |index| {
        let (around, turn) = (direction(&mut next), direction(&mut next));
        let normal = if index % 3 == 0 { DVec3::Y } else { (around + spread * turn).normalize_or(DVec3::X) };
        VirtualLight {
            position: [next() as f32 * 10.0 - 5.0, next() as f32, next() as f32 * 3.0],
            normal: pack_normal(normal),
            color: [next() as f32, next() as f32, 0.1],
            extra: 1,
        }
    };
    (0..count).map(&mut light).collect()
}

/// A child: the lights it holds, and what its parent says of it.
pub(crate) struct Child<'a> {
    pub(crate) lights: &'a [VirtualLight],
    pub(crate) pairs: &'a [VirtualPair],
    pub(crate) lower: Vec3,
    pub(crate) upper: Vec3,
    pub(crate) power: f32,
    pub(crate) cone: u32,
}

/// Both children of the first node over these lights.
pub(crate) fn children<'a>(lights: &'a [VirtualLight], pairs: &'a [VirtualPair]) -> [Child<'a>; 2] {
    let pair = &pairs[0];
    let count = pair.left_count as usize;
    let ((left, right), (left_pairs, right_pairs)) = (lights.split_at(count), pairs[1..].split_at(count - 1));
    let child = |lights, pairs, lower: [f32; 3], upper: [f32; 3], bits, cone| Child {
        lights,
        pairs,
        lower: lower.into(),
        upper: upper.into(),
        power: f32::from_bits(bits),
        cone,
    };
    [
        child(left, left_pairs, pair.left_lower, pair.left_upper, pair.powers << 16, pair.left_cone),
        child(
            right,
            right_pairs,
            pair.right_lower,
            pair.right_upper,
            pair.powers & 0xffff_0000,
            pair.right_cone,
        ),
    ]
}

fn check_child(child: &Child<'_>) {
    let inside = |place: Vec3| place.cmpge(child.lower).all() && place.cmple(child.upper).all();
    for light in child.lights {
        assert!(inside(light.position.into()));
        if light.normal == VIRTUAL_ISOTROPIC {
            let range = f32::from_bits(light.extra).sqrt().recip();
            assert!(f32::from_bits(child.cone) >= range, "{range}");
        } else {
            let cone = Cone::unpack(child.cone);
            let cosine = unpack_normal(light.normal).dot(cone.axis);
            assert!(cosine >= cone.angle.cos() - 1e-15, "{cosine} {cone:?}");
        }
    }
    let power: f64 = child.lights.iter().map(|light| color(light).element_sum() / 3.0).sum();
    assert!((f64::from(child.power) - power).abs() <= 0.004 * power, "{} {power}", child.power);
    assert_eq!(child.power > 0.0, power > 0.0);
}

fn check(tree: &VirtualTree, count: usize) {
    assert_eq!((tree.lights.len(), tree.pairs.len()), (count, count.saturating_sub(1)));
    let mut open = vec![(&tree.lights[..], &tree.pairs[..])];
    while let Some((lights, pairs)) = open.pop() {
        if lights.len() < 2 {
            continue;
        }
        for child in children(lights, pairs) {
            check_child(&child);
            open.push((child.lights, child.pairs));
        }
    }
}

#[test]
fn nodes_hold_their_lights() {
    for count in [0, 1, 2, 3, 5, 64, 1000, 5000] {
        for spread in [0.0, 0.1, 1.0] {
            check(&VirtualTree::new(&lights(count, spread)), count);
        }
    }
    // Lights on one wall have that wall's normal, exactly.
    let mut wall = lights(100, 0.0);
    wall.iter_mut().for_each(|light| light.normal = pack_normal(DVec3::NEG_Z));
    assert_eq!(Cone::unpack(VirtualTree::new(&wall).pairs[0].left_cone), Cone::along(DVec3::NEG_Z));
    // All at one place, or closer than their middle is exact.
    wall.iter_mut().for_each(|light| light.position = [1.0, 2.0, 3e-45]);
    check(&VirtualTree::new(&wall), 100);
}

#[test]
fn every_light_is_in_the_tree_once() {
    let lights = lights(777, 1.0);
    let tree = VirtualTree::new(&lights);
    let key = |light: &VirtualLight| bytemuck::cast::<_, [u32; 8]>(*light);
    let [mut a, mut b] = [&lights, &tree.lights].map(|lights| lights.iter().map(key).collect::<Vec<_>>());
    a.sort_unstable();
    b.sort_unstable();
    assert_eq!(a, b);
    assert_eq!(tree, VirtualTree::new(&lights));
}

#[test]
fn point_lights_shine_all_around() {
    let mut next = random(9);
    let origin = Vec3::new(1e5, 0.0, -1e5);
    let lights: Vec<_> = (0..300)
        .map(|i| PointLight {
            position: origin + Vec3::new(next() as f32, next() as f32, next() as f32) * 8.0,
            intensity: Vec3::splat(i as f32),
            range: (i % 2 == 0).then_some(2.0),
        })
        .collect();
    let tree = VirtualTree::of_points(&lights, origin);
    check(&tree, 300);
    for light in &tree.lights {
        let index = light.color[0] as usize;
        assert_eq!(Vec3::from(light.position), lights[index].position - origin);
        assert_eq!(f32::from_bits(light.extra), if index.is_multiple_of(2) { 0.25 } else { 0.0 });
    }
}

/// Codes are within half a step of their vectors; a cone's code holds it.
#[test]
fn codes() {
    let mut next = random(4);
    let mut worst = 0.0_f64;
    for _ in 0..100_000 {
        let normal = direction(&mut next);
        let code = pack_normal(normal);
        assert_ne!(code, VIRTUAL_ISOTROPIC);
        worst = worst.max(unpack_normal(code).cross(normal).length());
        let other = Cone { axis: direction(&mut next), angle: next() };
        let cone = Cone { axis: normal, angle: 0.3 * next() }.around(other);
        let coded = Cone::unpack(cone.pack());
        let between = coded.axis.cross(cone.axis).length().atan2(coded.axis.dot(cone.axis));
        assert!(coded.angle >= (between + cone.angle).min(coded.angle), "{cone:?} {coded:?}");
        if cone.angle < 1.4 {
            assert!(
                coded.angle >= between + cone.angle && coded.angle < cone.angle + 0.1,
                "{cone:?} {coded:?}"
            );
        }
        for part in [other.axis, normal] {
            let between = cone.axis.cross(part).length().atan2(cone.axis.dot(part));
            assert!(between <= cone.angle + 1e-9);
        }
    }
    println!("worst error of a normal: {worst:.1e}");
    assert!((1e-5..7e-5).contains(&worst), "{worst}");
}
