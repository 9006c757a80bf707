//! The default scene, masks and luminaires.

use std::path::Path;

use amas::reference::rays::{Geometry, Ray};
use amas::scene::{self, AreaLight, AreaShape, Luminaire, Parameter, Scene, Texels, Texture};
use amas::shared::RayProbeRow;
use glam::{Vec3, vec3};
use rayon::prelude::*;

use crate::common::gpu::CheckedGpu;
use crate::common::square;
use crate::exact::{Answer, answer, judge};
use crate::probe::{Random, occluded, ray, soup, triangles};

/// The oracle's word on a ray.
fn oracle(geometry: &Geometry, row: &RayProbeRow) -> bool {
    let [origin, direction] = [row.origin, row.direction].map(|v| Vec3::from(v).as_dvec3());
    // Roundings of its length would shift the ends.
    let scale = direction.length();
    let range = [row.t_min, row.t_max].map(|t| f64::from(t) * scale);
    geometry.occludes(&Ray::new(origin, direction / scale), range, None)
}

#[test]
fn default_scene() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    let scene = scene::load(&path, &[]).unwrap();
    let gpu = CheckedGpu::open();
    let mut random = Random(11);
    let lights = &scene.point_lights;
    let vertices: Vec<_> = scene.meshes.iter().flat_map(|mesh| &mesh.vertices).collect();
    let rows: Vec<_> = (0..24_576)
        .map(|i| {
            let vertex = vertices[(random.number() * vertices.len() as f32) as usize];
            let origin =
                Vec3::from(vertex.position) + Vec3::from(vertex.normal) * 0.01 + random.place() * 0.05;
            let light = lights[(random.number() * lights.len() as f32) as usize].position;
            let to = light - origin;
            if i % 2 == 0 {
                ray(origin, to.normalize(), 0.0, to.length())
            } else {
                ray(origin, random.direction(), 0.0, 1e3)
            }
        })
        .collect();
    let got = occluded(&gpu, &scene, &rows);
    let geometry = Geometry::new(&scene);
    let want: Vec<_> = rows.par_iter().map(|row| oracle(&geometry, row)).collect();
    let differ: Vec<_> = (0..rows.len()).filter(|&i| got[i] != want[i]).collect();
    let hidden = want.iter().filter(|&&hidden| hidden).count();
    println!("{} rays, {hidden} hidden, {} differ", rows.len(), differ.len());
    assert!(hidden > 2000 && rows.len() - hidden > 2000);
    assert!(differ.len() * 2000 < rows.len(), "{} rays differ", differ.len());
    // Each of them is within rounding of an edge, but for those that meet a mask's border.
    let masked = |m: u32| scene.materials[m as usize].value(Parameter::Mask).texture.is_some();
    let mut opaque = scene.clone();
    opaque.meshes.retain(|mesh| !masked(mesh.material));
    let opaque = triangles(&opaque);
    let wrong = differ.iter().filter(|&&i| answer(&opaque, &rows[i]) == Answer::Hidden);
    assert_eq!(wrong.count(), 0);
    let all = triangles(&scene);
    let wrong = differ.iter().filter(|&&i| got[i] && answer(&all, &rows[i]) == Answer::Free);
    assert_eq!(wrong.count(), 0);
    gpu.finish();
}

/// A random mask on a tilted sheet that repeats it: the device's answers are the oracle's, but for places where the
/// mask is within rounding of its threshold.
#[test]
fn masks() {
    let gpu = CheckedGpu::open();
    let mut random = Random(12);
    for size in [[1_u32, 1], [2, 1], [5, 3], [64, 33]] {
        let texels = (0..size[0] * size[1]).map(|_| [(random.number() * 255.0) as u8; 4]).collect();
        let mut scene = square::scene();
        scene.textures = vec![Texture {
            name: "mask".into(),
            width: size[0],
            height: size[1],
            texels: Texels::Linear8(texels),
        }];
        scene.materials[0].parameters[Parameter::Mask as usize].texture = Some(0);
        for vertex in &mut scene.meshes[0].vertices {
            vertex.uv = vertex.uv.map(|u| 2.6 * u - 1.3);
        }
        let rows: Vec<_> = (0..8192)
            .map(|_| {
                let target = random.place() * vec3(2.1, 2.1, 0.0);
                let origin = target + random.direction() * 3.0;
                ray(origin, (target - origin).normalize(), 0.0, 10.0)
            })
            .collect();
        let got = occluded(&gpu, &scene, &rows);
        let geometry = Geometry::new(&scene);
        let differ = rows.iter().zip(&got).filter(|(row, got)| oracle(&geometry, row) != **got).count();
        let hidden = got.iter().filter(|&&hidden| hidden).count();
        println!("{size:?}: {hidden} of {} hidden, {differ} differ", rows.len());
        assert!(differ <= 4, "{size:?}: {differ} differ");
    }
    gpu.finish();
}

fn light(shape: AreaShape, visible: bool) -> AreaLight {
    AreaLight { shape, radiance: Vec3::ONE, two_sided: false, visible, texture: None }
}

/// Luminaires hide what is behind their triangles, if they are seen.
#[test]
fn luminaires() {
    let outer = [[-1.0, -1.0], [1.0, -1.0], [0.2, 0.1], [1.0, 1.0], [-1.0, 1.0]];
    let hole = [[-0.7, -0.5], [-0.2, -0.5], [-0.5, 0.5]];
    let flat = |[x, z]: [f32; 2]| vec3(x, 1.5, z);
    let polygon = AreaShape::Polygon {
        vertices: outer.map(flat).into(),
        holes: vec![hole.map(flat).into()],
        uvs: None,
    };
    let shapes = [
        AreaShape::Rect { center: Vec3::ZERO, u: vec3(0.5, 0.1, 0.0), v: vec3(0.0, 0.3, 0.8) },
        AreaShape::Disk { center: vec3(0.0, -1.0, 0.0), u: Vec3::X, v: vec3(0.0, 0.2, 0.6) },
        polygon,
        AreaShape::Line { a: vec3(-1.0, 0.5, -1.0), b: vec3(1.0, -0.5, 1.0), radius: 0.2 },
    ];
    let gpu = CheckedGpu::open();
    let mut random = Random(13);
    let rows: Vec<_> = (0..8192).map(|_| ray(random.place() * 2.0, random.direction(), 0.0, 3.0)).collect();
    let lit = |visible| Scene {
        area_lights: shapes.iter().map(|shape| light(shape.clone(), visible)).collect(),
        ..soup(&[])
    };
    let got = occluded(&gpu, &lit(true), &rows);
    let surfaces = shapes.iter().map(|shape| Luminaire::new(&light(shape.clone(), true)));
    let all: Vec<_> = surfaces
        .flat_map(|surface| {
            let place = |i: u32| Vec3::from(surface.vertices[i as usize].position).as_dvec3();
            surface.triangles.iter().map(|triangle| triangle.map(place)).collect::<Vec<_>>()
        })
        .collect();
    let counts = judge("luminaires", &all, &rows, &got);
    assert!(counts[2] > 800, "{counts:?}");
    assert!(!occluded(&gpu, &lit(false), &rows).contains(&true), "what is not seen hides nothing");
    gpu.finish();
}
