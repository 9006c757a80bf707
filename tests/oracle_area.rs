//! Area lights of the oracle against form factors in closed form, each within its own standard error.

use std::f64::consts::PI;

use amas::reference::area::{Emitter, Estimate, reflected};
use amas::reference::bsdf::{Bsdf, Matte};
use amas::reference::shading::{Frame, Surface};
use amas::scene::{AreaLight, AreaShape, Texels, Texture};
use glam::{DVec3, Vec3, vec3};

/// White Lambert at the origin, facing +z, seen from above: under radiance 1 it reflects the form factor.
fn plane() -> Surface {
    Surface {
        position: DVec3::ZERO,
        frame: Frame { tangent: DVec3::X, bitangent: DVec3::Y, normal: DVec3::Z },
        wo: DVec3::Z,
        bsdf: Bsdf::Matte(Matte { color: DVec3::ONE, sigma: 0.0 }),
    }
}

fn light(shape: AreaShape) -> AreaLight {
    AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible: false, texture: None }
}

/// Facing down.
fn rect(center: [f32; 3], half: [f32; 2]) -> AreaShape {
    AreaShape::Rect { center: center.into(), u: Vec3::X * half[0], v: Vec3::NEG_Y * half[1] }
}

fn disk(offset: f32, height: f32, radius: f32) -> AreaShape {
    let center = vec3(offset, 0.0, height);
    AreaShape::Disk { center, u: Vec3::X * radius, v: Vec3::NEG_Y * radius }
}

fn polygon(vertices: Vec<Vec3>, holes: Vec<Vec<Vec3>>) -> AreaShape {
    AreaShape::Polygon { vertices, holes, uvs: None }
}

/// A regular outline at height 1, facing down.
fn ring(n: u32, radius: f32) -> Vec<Vec3> {
    let angle = |i: u32| -std::f32::consts::TAU * i as f32 / n as f32;
    (0..n).map(|i| vec3(radius * angle(i).cos(), radius * angle(i).sin(), 1.0)).collect()
}

fn estimate(light: &AreaLight, textures: &[Texture]) -> Estimate {
    reflected(&plane(), &[Emitter::new(light, textures)], 2e-5, 7)
}

/// Within five standard errors, of which the estimate must be small, and a rounding of float32 inputs.
fn expect(what: &str, light: &AreaLight, want: f64) {
    let got = estimate(light, &[]);
    let (value, error) = (got.value.x, got.standard_error.x);
    println!("{what}: {value:.9} ± {error:.1e}, want {want:.9}");
    assert!(error <= 5e-4 * want, "{what}: {error:e}");
    let off = (value - want).abs();
    assert!(off <= 5.0 * error + 1e-6 * want, "{what}: {value} ± {error:e}, want {want}");
}

#[test]
fn rectangles() {
    expect("T1 corner above", &light(rect([0.5, 0.5, 1.0], [0.5, 0.5])), 0.138_531_606);
    expect("T2 h = 1", &light(rect([0.0, 0.0, 1.0], [1.0, 1.0])), 0.554_126_424);
    expect("T2 h = 0.1", &light(rect([0.0, 0.0, 0.1], [1.0, 1.0])), 0.991_885_633);
    expect("T3 4 by 1", &light(rect([0.0, 0.0, 2.0], [2.0, 0.5])), 0.197_691_759);
    expect("T3 1 by 1", &light(rect([0.0, 0.0, 1.0], [0.5, 0.5])), 0.239_456_470);
}

#[test]
fn wall_that_stands_on_the_plane() {
    for (d, want) in [(1.0, 0.111_468_394), (1e-3, 0.499_431_690)] {
        let shape = AreaShape::Rect { center: vec3(d, 0.0, 0.5), u: Vec3::NEG_Y, v: Vec3::Z * 0.5 };
        expect("T4", &light(shape), want);
    }
}

#[test]
fn polygons() {
    let octant = vec![Vec3::X, Vec3::Z, Vec3::Y];
    expect("T5", &light(polygon(octant, vec![])), 0.25);
    for (n, want) in [(3, 0.281_455_694), (6, 0.451_816_018), (64, 0.499_598_211)] {
        expect("T6", &light(polygon(ring(n, 1.0), vec![])), want);
    }
    // A hole of either winding: outer minus inner, whose closed forms are T6 scaled.
    let square = |half: f32| {
        vec![[-1, -1], [-1, 1], [1, 1], [1, -1]]
            .into_iter()
            .map(|[x, y]| vec3(x as f32 * half, y as f32 * half, 1.0))
            .collect::<Vec<_>>()
    };
    let mut hole = square(0.5);
    let want = 0.554_126_424 - 0.239_456_470;
    expect("T18 hole", &light(polygon(square(1.0), vec![hole.clone()])), want);
    hole.reverse();
    expect("T18 reversed hole", &light(polygon(square(1.0), vec![hole])), want);
}

#[test]
fn disks_and_ellipses() {
    for (radius, height, want) in [(1.0, 1.0, 0.5), (1.0, 2.0, 0.2), (10.0, 1.0, 0.990_099_01)] {
        expect("T7", &light(disk(0.0, height, radius)), want);
    }
    expect("T7 a = 1", &light(disk(1.0, 1.0, 1.0)), 0.276_393_202);
    expect("T7 a = 2", &light(disk(2.0, 1.0, 1.0)), 0.052_786_405);
}

#[test]
fn line_is_a_thin_cylinder() {
    let line = |radius| AreaShape::Line { a: vec3(-1.0, 0.0, 1.0), b: vec3(1.0, 0.0, 1.0), radius };
    // The closed form (T9) is the limit of no radius; a cylinder's nearer and receding sides differ in order r².
    let thin = 0.008_183_099 / 0.01;
    let got = estimate(&light(line(1e-4)), &[]);
    let off = (got.value.x / (1e-4 * thin) - 1.0).abs();
    assert!(off < 1e-5 + 5.0 * got.standard_error.x / got.value.x, "{got:?}");
    let got = estimate(&light(line(0.01)), &[]);
    assert!((got.value.x / (0.01 * thin) - 1.0).abs() < 5e-3, "{got:?}");
}

#[test]
fn sides() {
    let up = AreaShape::Rect { center: vec3(0.0, 0.0, 1.0), u: Vec3::X, v: Vec3::Y };
    assert_eq!(estimate(&light(up.clone()), &[]).value, DVec3::ZERO, "T14: its back is dark");
    expect("T14", &AreaLight { two_sided: true, ..light(up) }, 0.554_126_424);
    let below = light(rect([0.0, 0.0, -1.0], [1.0, 1.0]));
    assert_eq!(estimate(&below, &[]).value, DVec3::ZERO, "T13");
    let edge_on = AreaShape::Rect { center: vec3(0.0, 0.0, 1.0), u: Vec3::X * 0.0, v: Vec3::Z };
    assert!(estimate(&light(edge_on), &[]).value.is_finite(), "no area is no light");
}

#[test]
fn parts_sum_to_the_whole() {
    let whole = estimate(&light(rect([0.5, 0.0, 1.0], [1.0, 1.0])), &[]);
    let parts: Vec<_> = [0.0, 1.0].map(|x| light(rect([x, 0.0, 1.0], [0.5, 1.0]))).into_iter().collect();
    let emitters: Vec<_> = parts.iter().map(|part| Emitter::new(part, &[])).collect();
    let sum = reflected(&plane(), &emitters, 2e-5, 1);
    let error = whole.standard_error.x + sum.standard_error.x;
    assert!((whole.value.x - sum.value.x).abs() < 5.0 * error + 1e-9, "{whole:?} {sum:?}");
}

#[test]
fn texture_lies_as_the_contract_says() {
    // Two texels, left dark and right bright, top row only: u runs with +x.
    let texels = Texels::Float(vec![[0.0; 4], [1.0; 4]]);
    let texture = Texture { name: "halves".into(), width: 2, height: 1, texels };
    let left = AreaShape::Rect { center: vec3(0.0, 0.0, 1.0), u: Vec3::X, v: Vec3::NEG_Y };
    let textured = AreaLight { texture: Some(0), visible: true, ..light(left) };
    let textures = [texture];
    let emitter = Emitter::new(&textured, &textures);
    let at = |x: f64| {
        let ray = amas::reference::rays::Ray::new(DVec3::new(x, 0.3, 0.0), DVec3::Z);
        emitter.seen_by(&ray).map(|(t, radiance)| (t, radiance.x))
    };
    assert_eq!(at(-0.75), Some((1.0, 0.0)));
    assert_eq!(at(0.0), Some((1.0, 0.5)));
    assert_eq!(at(0.9), Some((1.0, 1.0)));
    assert_eq!(at(1.1), None);
}

#[test]
fn same_seed_same_numbers() {
    let shape = light(disk(0.3, 1.0, 1.0));
    assert_eq!(estimate(&shape, &[]), estimate(&shape, &[]));
    assert!(estimate(&shape, &[]).value.x < 0.5 * PI);
}

/// A square whose corner alone peeps over the horizon: no seed may call that dark. Its radiance on a white Lambert plane is
/// the form factor of the triangle that is above, by Lambert's formula.
#[test]
fn a_corner_above_the_horizon_is_found() {
    let corner = 0.03_f32;
    let (x, y) = (2.0, 0.0);
    let lower = corner - 2.0_f32.sqrt();
    let vertices = vec![
        Vec3::new(x, y, corner),
        Vec3::new(x, y + 0.5 * 2.0_f32.sqrt(), 0.5 * (corner + lower)),
        Vec3::new(x, y, lower),
        Vec3::new(x, y - 0.5 * 2.0_f32.sqrt(), 0.5 * (corner + lower)),
    ];
    let mut light = light(polygon(vertices, vec![]));
    light.two_sided = true;
    // Above the plane: a triangle of height and half base `corner`, seen almost edge-on.
    let above =
        [[x, -corner, 0.0], [x, corner, 0.0], [x, y, corner]].map(|p| Vec3::from(p).as_dvec3().normalize());
    let edges = (0..3).map(|i| (above[i], above[(i + 1) % 3]));
    let want: f64 =
        edges.map(|(a, b)| a.angle_between(b) * a.cross(b).normalize().z).sum::<f64>().abs() / 2.0;
    for seed in 0..20 {
        let emitter = Emitter::new(&light, &[]);
        let found = reflected(&plane(), &[emitter], 1e-2, seed);
        let got = found.value.x * std::f64::consts::PI;
        assert!(got > 0.0 && found.standard_error.x > 0.0, "seed {seed}: {found:?}");
        assert!((got / want - 1.0).abs() < 0.1, "seed {seed}: {got} for {want}");
    }
}
