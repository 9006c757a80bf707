//! Nearest hits against double precision.

use std::path::Path;

use amas::bvh::Bvh;
use amas::gpu::{Specialization, shaders};
use amas::gpu_scene::hits::Hits;
use amas::gpu_scene::occluders::Occluders;
use amas::reference::rays::{CameraRay, Geometry, Hit, Ray};
use amas::scene::{self, AreaLight, AreaShape, Luminaire, Material, Mesh, Scene};
use amas::shared::{HitProbeRow, NO_HIT, RayProbeRow, SPEC_ANISOTROPIC};
use glam::{DVec3, Vec3, vec3};
use rayon::prelude::*;

use crate::common::gpu::CheckedGpu;
use crate::exact::{Answer, answer};
use crate::probe::{Random, random_soup, ray, soup, sphere};

/// A row's answer, and which triangle of which mesh it names; luminaires follow the scene's meshes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) row: HitProbeRow,
    pub(crate) triangle: Option<(usize, usize)>,
}

/// What the device finds along each ray, of a scene whose `origin` is the device's.
pub(crate) fn found(gpu: &CheckedGpu, scene: &Scene, origin: Vec3, rows: &[RayProbeRow]) -> Vec<Found> {
    let bvh = Bvh::new(scene, origin);
    let (occluders, hits) = (Occluders::new(gpu, &bvh).unwrap(), Hits::new(gpu, scene, &bvh).unwrap());
    let specialization =
        Specialization::default().with_all(&occluders.specialization).with(SPEC_ANISOTROPIC, 1);
    let bind = |set: amas::gpu::DescriptorSet<'_>| {
        occluders.bind(set);
        hits.bind(set);
    };
    let values: Vec<HitProbeRow> =
        amas::probe::run_among(gpu, shaders::PROBE_HIT_COMP, &specialization, &bind, rows).unwrap();
    let named = |row: HitProbeRow| {
        let triangle = (row.triangle != NO_HIT).then(|| &bvh.triangles()[row.triangle as usize]);
        Found { row, triangle: triangle.map(|found| (found.mesh as usize, found.triangle as usize)) }
    };
    let numbers: &[f32] = bytemuck::cast_slice(&values);
    let words: &[u32] = bytemuck::cast_slice(&values);
    // `NO_HIT` is no number.
    assert!(numbers.iter().zip(words).all(|(number, &word)| number.is_finite() || word == NO_HIT));
    values.into_iter().map(named).collect()
}

/// A scene as hits see it: both sides of everything, and luminaires that are seen as meshes behind the others.
pub(crate) fn solid(scene: &Scene) -> Scene {
    let mut solid = scene.clone();
    solid.materials.iter_mut().for_each(|material| material.two_sided = true);
    for light in scene.area_lights.iter().filter(|light| light.visible) {
        let Luminaire { vertices, triangles } = Luminaire::new(light);
        solid.meshes.push(Mesh { vertices, triangles, material: solid.materials.len() as u32 });
    }
    let plain = scene.materials.first().map(|material| Material {
        parameters: Default::default(),
        two_sided: true,
        ..material.clone()
    });
    solid.materials.extend(plain);
    solid
}

pub(crate) fn double(row: &RayProbeRow) -> Ray {
    let [origin, direction] = [row.origin, row.direction].map(|v| Vec3::from(v).as_dvec3());
    Ray::new(origin, direction.normalize())
}

fn nearest(geometry: &Geometry, row: &RayProbeRow) -> Option<Hit> {
    let scale = Vec3::from(row.direction).as_dvec3().length();
    geometry.closest(&CameraRay { ray: double(row), t_min: 0.0, t_max: f64::from(row.t_max) * scale })
}

fn corners(scene: &Scene, (mesh, triangle): (usize, usize)) -> [DVec3; 3] {
    let mesh = &scene.meshes[mesh];
    mesh.triangles[triangle].map(|corner| Vec3::from(mesh.vertices[corner as usize].position).as_dvec3())
}

/// What float32 may make of a distance: edge tests are off by a few roundings of the corners' distance, which count for
/// more where the ray grazes the plane.
fn blur(corners: &[DVec3; 3], ray: &Ray) -> f64 {
    let reach = corners.iter().map(|corner| corner.distance(ray.origin)).fold(0.0, f64::max);
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    1e-6 * reach * (1.0 + normal.length() / normal.dot(ray.direction).abs())
}

/// How a device's hit stands to the exact one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Miss,
    Same,
    /// Another triangle at the same distance, or one of the two within rounding of an edge or of an end.
    Rounding,
    Wrong,
}

fn verdict(solid: &Scene, row: &RayProbeRow, got: &Found, want: Option<Hit>) -> Verdict {
    let ray = double(row);
    let uncertain = |triangle| answer(&[corners(solid, triangle)], row) == Answer::Either;
    let t = f64::from(got.row.t);
    let wanted = want.map(|hit| (hit.mesh, hit.triangle));
    let explained = match (got.triangle, want) {
        (None, None) => return Verdict::Miss,
        (Some(triangle), Some(hit)) => {
            let [a, b] = [triangle, (hit.mesh, hit.triangle)].map(|name| blur(&corners(solid, name), &ray));
            let tie = (t - hit.t).abs() <= a + b;
            if Some(triangle) == wanted {
                let place = Vec3::from(got.row.position).as_dvec3();
                let beside = place.distance(ray.origin + hit.t * ray.direction);
                let turned = (got.row.front == 1) != hit.front && !uncertain(triangle);
                // Positions are float32, and sums of three.
                let rounding = 3e-7 * place.abs().max_element();
                return if tie && beside <= 2.0 * b + rounding && !turned {
                    Verdict::Same
                } else {
                    Verdict::Wrong
                };
            }
            tie && answer(&[corners(solid, triangle)], row) != Answer::Free
                || if t > hit.t { uncertain((hit.mesh, hit.triangle)) } else { uncertain(triangle) }
        }
        (Some(triangle), None) => uncertain(triangle),
        (None, Some(hit)) => uncertain((hit.mesh, hit.triangle)),
    };
    if explained { Verdict::Rounding } else { Verdict::Wrong }
}

/// Fails where a hit is not the exact one, but for `wrong` of them, which meet the border of a mask; returns how many
/// missed, are the same, and differ by rounding.
fn judge(what: &str, solid: &Scene, rows: &[RayProbeRow], got: &[Found], wrong: usize) -> [usize; 3] {
    let geometry = Geometry::new(solid);
    let verdicts: Vec<_> = rows
        .par_iter()
        .zip(got)
        .map(|(row, got)| verdict(solid, row, got, nearest(&geometry, row)))
        .collect();
    let count = |which| verdicts.iter().filter(|&&verdict| verdict == which).count();
    let counts = [Verdict::Miss, Verdict::Same, Verdict::Rounding].map(count);
    println!(
        "{what}: {} rays, miss, same, rounding: {counts:?}, {} wrong",
        rows.len(),
        count(Verdict::Wrong)
    );
    if count(Verdict::Wrong) > wrong {
        let shown = (0..rows.len()).filter(|&i| verdicts[i] == Verdict::Wrong).take(5);
        for i in shown {
            println!("{:?}\n{:?}\n{:?}", rows[i], got[i], nearest(&geometry, &rows[i]));
        }
        panic!("{what}");
    }
    counts
}

fn any(random: &mut Random, center: Vec3, half: f32) -> RayProbeRow {
    let origin = center + random.place() * (1.3 * half);
    let to = (center + random.place() * half - origin).normalize();
    let direction = if random.number() < 0.5 { to } else { random.direction() };
    ray(origin, direction, 0.0, if random.number() < 0.3 { half * random.number() } else { 1e6 * half })
}

#[test]
fn hits_of_random_triangles() {
    let gpu = CheckedGpu::open();
    let mut random = Random(31);
    for (count, half, size) in
        [(1, 1.0, 1.0), (60, 1.0, 1.0), (3000, 1.0, 0.1), (20_000, 1e3, 30.0), (2000, 1e-3, 2e-4)]
    {
        for center in [Vec3::ZERO, vec3(90.0, -40.0, 7.0) * half] {
            let soup = soup(&random_soup(&mut random, count, center, half, size));
            let rows: Vec<_> = (0..16_384).map(|_| any(&mut random, center, half)).collect();
            let got = found(&gpu, &soup, Vec3::ZERO, &rows);
            let counts = judge(&format!("{count} of {size}"), &solid(&soup), &rows, &got, 0);
            assert!(counts[1] > 20 && counts[2] * 100 < rows.len(), "{counts:?}");
        }
    }
    gpu.finish();
}

/// Coordinates of a coarse grid: triangles in one place, in one plane, without area; rays along axes and edges. Of two
/// triangles in one place always the same one is met.
#[test]
fn ties_edges_and_no_area() {
    let gpu = CheckedGpu::open();
    let mut random = Random(32);
    let grid = |random: &mut Random| (random.place() * 2.5).round();
    let mut all: Vec<[Vec3; 3]> = (0..160).map(|_| [(); 3].map(|()| grid(&mut random))).collect();
    all.extend(all.clone());
    all.extend((0..40).map(|_| [grid(&mut random); 3]));
    all.extend((0..40).map(|_| [Vec3::ONE, Vec3::ONE, grid(&mut random)]));
    all.extend((0..40).map(|i| [0.0, 1.0, 2.0].map(|t| vec3(t, t, i as f32 / 20.0 - 1.0))));
    let soup = soup(&all);
    let rows: Vec<_> = (0..16_384)
        .map(|i| {
            let jitter = if i % 4 < 2 { Vec3::ZERO } else { random.place() * 0.4 };
            let origin = grid(&mut random) + jitter;
            let to = grid(&mut random) - origin;
            let mut axis = [0.0; 3];
            axis[i % 3] = if i % 8 < 4 { 1.0 } else { -1.0 };
            ray(origin, if i % 2 == 0 { axis.into() } else { to.normalize_or(Vec3::Y) }, 0.0, 1e9)
        })
        .collect();
    let got = found(&gpu, &soup, Vec3::ZERO, &rows);
    let counts = judge("grid", &solid(&soup), &rows, &got, 0);
    assert!(counts[1] > 1000, "{counts:?}");
    let again = found(&gpu, &soup, Vec3::ZERO, &rows);
    assert!(got.iter().zip(&again).all(|(a, b)| bytemuck::bytes_of(&a.row) == bytemuck::bytes_of(&b.row)));
    gpu.finish();
}

/// Through edges and corners too, and at the distance of the shell.
#[test]
fn no_hit_beyond_a_closed_surface() {
    let gpu = CheckedGpu::open();
    let mut random = Random(33);
    let center = vec3(0.3, 0.1, -0.2);
    let sphere = sphere(center);
    let rows: Vec<_> = (0..32_768)
        .map(|i| {
            let origin = center + random.place() * 0.8;
            let [a, b, _] = sphere[(random.number() * sphere.len() as f32) as usize];
            let target = [a, a + (b - a) * random.number(), origin + random.direction()][i % 3];
            ray(origin, (target - origin).normalize(), 0.0, 100.0)
        })
        .collect();
    let got = found(&gpu, &soup(&sphere), Vec3::ZERO, &rows);
    for found in &got {
        let radius = Vec3::from(found.row.position).distance(center);
        // The facets' middles lie inside by 1 − cos(π/24) at most, along both angles.
        assert!(found.triangle.is_some() && (1.65..1.7001).contains(&radius), "{found:?}");
    }
    gpu.finish();
}

/// Masks, and a scene as people make them.
#[test]
fn hits_of_the_default_scene() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    let scene = scene::load(&path, &[]).unwrap();
    let gpu = CheckedGpu::open();
    let mut random = Random(34);
    let vertices: Vec<_> = scene.meshes.iter().flat_map(|mesh| &mesh.vertices).collect();
    let rows: Vec<_> = (0..49_152)
        .map(|_| {
            let vertex = vertices[(random.number() * vertices.len() as f32) as usize];
            let origin =
                Vec3::from(vertex.position) + Vec3::from(vertex.normal) * 0.01 + random.place() * 0.05;
            ray(origin, random.direction(), 0.0, 1e3)
        })
        .collect();
    let got = found(&gpu, &scene, Vec3::ZERO, &rows);
    let counts = judge("default", &solid(&scene), &rows, &got, rows.len() / 2000);
    assert!(counts[1] > rows.len() / 2 && counts[2] * 50 < rows.len(), "{counts:?}");
    gpu.finish();
}

fn lights(visible: bool) -> Vec<AreaLight> {
    let shapes = [
        AreaShape::Rect { center: Vec3::ZERO, u: vec3(0.5, 0.1, 0.0), v: vec3(0.0, 0.3, 0.8) },
        AreaShape::Disk { center: vec3(0.0, -1.0, 0.0), u: Vec3::X, v: vec3(0.0, 0.2, 0.6) },
        AreaShape::Line { a: vec3(-1.0, 0.5, -1.0), b: vec3(1.0, -0.5, 1.0), radius: 0.2 },
    ];
    let light = |shape| AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible, texture: None };
    shapes.map(light).into()
}

/// Luminaires are met where they are seen, and have no material; the back of a one-sided surface is met and has none.
#[test]
fn luminaires_and_backs() {
    let gpu = CheckedGpu::open();
    let mut random = Random(35);
    let mut scene = soup(&random_soup(&mut random, 40, Vec3::ZERO, 1.5, 1.0));
    scene.materials[0].two_sided = false;
    let rows: Vec<_> = (0..16_384).map(|_| any(&mut random, Vec3::ZERO, 2.0)).collect();
    for visible in [true, false] {
        scene.area_lights = lights(visible);
        let got = found(&gpu, &scene, Vec3::ZERO, &rows);
        judge(&format!("visible {visible}"), &solid(&scene), &rows, &got, 0);
        let luminaires = got.iter().filter(|found| found.triangle.is_some_and(|(mesh, _)| mesh > 0)).count();
        assert_eq!(luminaires > 1000, visible, "{luminaires}");
        for Found { row, triangle } in &got {
            let drawn = row.front == 1 && triangle.is_some_and(|(mesh, _)| mesh == 0);
            assert_eq!(row.drawn == 1, drawn, "{row:?}");
        }
    }
    gpu.finish();
}

/// Of a scene 1e5 m out, on the device's origin.
#[test]
fn hits_far_from_the_origin() {
    let gpu = CheckedGpu::open();
    let mut random = Random(36);
    let center = vec3(1e5, -7e4, 3e4);
    let near = random_soup(&mut random, 2000, Vec3::ZERO, 1.0, 0.2);
    let far = soup(&near.iter().map(|corners| corners.map(|corner| corner + center)).collect::<Vec<_>>());
    let rows: Vec<_> = (0..16_384).map(|_| any(&mut random, Vec3::ZERO, 1.0)).collect();
    let got = found(&gpu, &far, center, &rows);
    let mut moved = solid(&far);
    for vertex in moved.meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices) {
        vertex.position = (Vec3::from(vertex.position) - center).to_array();
    }
    let counts = judge("far", &moved, &rows, &got, 0);
    assert!(counts[1] > 4000 && counts[2] * 100 < rows.len(), "{counts:?}");
    gpu.finish();
}

#[test]
fn no_hit_in_an_empty_scene() {
    let gpu = CheckedGpu::open();
    let rows: Vec<_> = (0..64).map(|_| any(&mut Random(37), Vec3::ZERO, 1.0)).collect();
    let got = found(&gpu, &Scene::default(), Vec3::ZERO, &rows);
    assert!(got.iter().zip(&rows).all(|(found, row)| found.triangle.is_none() && found.row.t == row.t_max));
    gpu.finish();
}
