//! Surfaces at hits against the oracle's: frames, and every parameter of every model, textured and not.

use amas::reference::bsdf::{Bsdf, Ggx};
use amas::reference::rays::{Geometry, Hit};
use amas::reference::shading::Surface;
use amas::scene::material::{PARAMETER_COUNT, Value};
use amas::scene::{Material, Mesh, Model, Parameter, Scene, Texels, Texture, Vertex};
use amas::shared::{HitProbeRow, RayProbeRow};
use glam::{DVec3, Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::common::square;
use crate::hits::{Found, double, found};
use crate::probe::{Random, ray};

const MODELS: [Model; 5] = [Model::Matte, Model::Plastic, Model::Metal, Model::Substrate, Model::Principled];
const SCALARS: [Parameter; 11] = [
    Parameter::Roughness,
    Parameter::Aspect,
    Parameter::Sigma,
    Parameter::Eta,
    Parameter::Metallic,
    Parameter::SpecularTint,
    Parameter::Sheen,
    Parameter::SheenTint,
    Parameter::Clearcoat,
    Parameter::ClearcoatGloss,
    Parameter::Subsurface,
];

/// Constants, and up to eight textures, of any of the parameters; every other one has a normal map.
fn material(random: &mut Random, model: Model, textures: u32) -> Material {
    let mut parameters = [Value::default(); PARAMETER_COUNT];
    for parameter in [Parameter::Color, Parameter::Specular] {
        parameters[parameter as usize].constant = [(); 3].map(|()| random.number());
    }
    for parameter in SCALARS {
        parameters[parameter as usize].constant[0] = 0.05 + 0.9 * random.number();
    }
    if textures > 0 && random.number() < 0.5 {
        parameters[Parameter::Normal as usize].texture = Some((random.number() * textures as f32) as u32);
    }
    for _ in 0..if textures > 0 { 7 } else { 0 } {
        let parameter = (random.number() * Parameter::Normal as usize as f32) as usize;
        let texture = (random.number() * textures as f32) as u32;
        parameters[parameter].texture = Some(texture);
    }
    Material {
        name: "any".into(),
        model,
        parameters,
        squared_roughness: random.number() < 0.5,
        two_sided: random.number() < 0.5,
    }
}

/// A triangle with normals, texture coordinates and tangents of its own; of ten, one without tangents.
fn triangle(random: &mut Random) -> [Vertex; 3] {
    let place = random.place() * 3.0;
    let corners = [place, place + random.direction(), place + random.direction()];
    let face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(Vec3::Y);
    let along = random.direction();
    let without = random.number() < 0.1;
    let handed = if random.number() < 0.5 { 1.0 } else { -1.0 };
    corners.map(|position| {
        let normal = (face + 0.4 * random.direction()).normalize();
        let tangent = (along + 0.3 * random.direction()).reject_from(normal).normalize();
        let [x, y, z] = tangent.to_array();
        Vertex {
            position: position.to_array(),
            normal: normal.to_array(),
            tangent: if without { [0.0; 4] } else { [x, y, z, handed] },
            uv: [4.0 * random.number() - 2.0, 4.0 * random.number() - 2.0],
        }
    })
}

fn scene(random: &mut Random, textures: Vec<Texture>) -> Scene {
    let mut scene = Scene { materials: vec![], meshes: vec![], textures, ..square::scene() };
    for index in 0..60 {
        let model = MODELS[index as usize % 5];
        scene.materials.push(material(random, model, scene.textures.len() as u32));
        let vertices: Vec<_> = (0..12).flat_map(|_| triangle(random)).collect();
        let triangles = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        scene.meshes.push(Mesh { vertices, triangles, material: index });
    }
    scene
}

fn rows(random: &mut Random) -> Vec<RayProbeRow> {
    (0..16_384)
        .map(|_| {
            let origin = random.place() * 5.0;
            ray(origin, (random.place() * 3.5 - origin).normalize(), 0.0, 100.0)
        })
        .collect()
}

/// The oracle's numbers at a hit, in the order of [`numbers`].
fn expected(bsdf: &Bsdf) -> (Model, Vec<f64>) {
    let ggx = |Ggx { alpha_x, alpha_y }| [alpha_x, alpha_y];
    let all = |colors: &[DVec3], rest: &[f64]| {
        colors.iter().flat_map(|color| color.to_array()).chain(rest.iter().copied()).collect()
    };
    match *bsdf {
        Bsdf::Matte(b) => (Model::Matte, all(&[b.color], &[b.sigma])),
        Bsdf::Plastic(b) => (Model::Plastic, all(&[b.diffuse, b.specular], &[b.alpha, b.eta])),
        Bsdf::Metal(b) => (Model::Metal, all(&[b.eta, b.k], &ggx(b.ggx))),
        Bsdf::Substrate(b) => (Model::Substrate, all(&[b.diffuse, b.specular], &ggx(b.ggx))),
        Bsdf::Principled(b) => {
            let [x, y] = ggx(b.ggx);
            let lobes = [b.sheen, b.sheen_tint, b.clearcoat, b.clearcoat_gloss, b.subsurface];
            let base = [x, y, b.eta, b.metallic, b.roughness, b.specular_tint];
            (Model::Principled, all(&[b.base_color], &[base.as_slice(), &lobes].concat()))
        }
    }
}

/// The device's, of a model.
fn numbers(row: &HitProbeRow, model: Model) -> Vec<f64> {
    let [r, g, b, alpha_x] = row.color_alpha_x;
    let [s, t, u, alpha_y] = row.specular_alpha_y;
    let [sigma, eta, metallic, roughness] = row.surface;
    let [specular_tint, sheen, sheen_tint, clearcoat] = row.tints;
    let [gloss, subsurface, ..] = row.rest;
    let list = match model {
        Model::Matte => vec![r, g, b, sigma],
        Model::Plastic => vec![r, g, b, s, t, u, alpha_x, eta],
        Model::Metal | Model::Substrate => vec![r, g, b, s, t, u, alpha_x, alpha_y],
        Model::Principled => {
            let base = [r, g, b, alpha_x, alpha_y, eta, metallic, roughness, specular_tint];
            [base.as_slice(), &[sheen, sheen_tint, clearcoat, gloss, subsurface]].concat()
        }
    };
    list.into_iter().map(f64::from).collect()
}

/// The device's hit in the oracle's terms.
fn as_hit(Found { row, triangle }: &Found) -> Option<Hit> {
    let [.., b, c] = row.rest.map(f64::from);
    let (mesh, triangle) = (*triangle)?;
    Some(Hit { t: f64::from(row.t), mesh, triangle, weights: [1.0 - b - c, b, c], front: row.front == 1 })
}

/// Largest errors at all hits: of the frame, of parameters relative to the larger of them and 0.1.
fn errors(scene: &Scene, rows: &[RayProbeRow], got: &[Found]) -> [f64; 2] {
    let geometry = Geometry::new(scene);
    let mut worst = [0.0_f64; 2];
    let mut hits = 0;
    for (row, found) in rows.iter().zip(got) {
        let (Some(hit), ray) = (as_hit(found), double(row)) else { continue };
        let material = &scene.materials[scene.meshes[hit.mesh].material as usize];
        assert_eq!(found.row.drawn == 1, hit.front || material.two_sided, "{found:?}");
        let want = Surface::new(scene, &ray, &hit);
        let (model, wanted) = expected(&want.bsdf);
        assert_eq!(found.row.model, model as u32);
        let [geometric, tangent, bitangent, normal] =
            [found.row.geometric_normal, found.row.tangent, found.row.bitangent, found.row.normal]
                .map(|v| Vec3::from(v).as_dvec3());
        let mut face = geometry.normal(&hit).normalize();
        face *= -face.dot(ray.direction).signum();
        // Where the two are as good as at right angles, a normal may be turned to either side.
        if want.wo.z.abs() < 1e-4 || face.dot(ray.direction).abs() < 1e-4 {
            continue;
        }
        hits += 1;
        // A frame whose tangent nothing depends on may be any.
        let aspect = material.value(Parameter::Aspect);
        let round = [Model::Matte, Model::Plastic].contains(&model)
            || scene.meshes[hit.mesh].vertices[3 * hit.triangle].tangent == [0.0; 4]
            || (aspect.texture.is_none() && aspect.constant[0] == 1.0);
        let frame = want.frame;
        let tangents = if round {
            [tangent.dot(normal), tangent.length() - 1.0, (normal.cross(tangent) - bitangent).length(), 0.0]
        } else {
            [(tangent - frame.tangent).length(), (bitangent - frame.bitangent).length(), 0.0, 0.0]
        };
        let normals = [(normal - frame.normal).length(), (geometric - face).length()];
        worst[0] = normals.iter().chain(&tangents).fold(worst[0], |worst, error| worst.max(error.abs()));
        for (got, want) in numbers(&found.row, model).iter().zip(&wanted) {
            let error = (got - want).abs() / want.abs().max(0.1);
            worst[1] = worst[1].max(error);
        }
    }
    println!("{hits} hits, frame {:.1e}, parameters {:.1e}", worst[0], worst[1]);
    assert!(hits * 2 > rows.len(), "{hits}");
    worst
}

fn texture(random: &mut Random, [width, height]: [u32; 2], encode: impl Fn(Vec<f32>) -> Texels) -> Texture {
    // 0.1 to 0.9, in steps that halves have; of blue the upper part, so that as a normal none is short.
    let least = |channel| if channel == 2 { 0.75 } else { 0.0 };
    let number = |i| least(i % 4) + (1.0 - least(i % 4)) * random.number();
    let values = (0..4 * width * height).map(number).map(|x| (102.0 + (x * 820.0).floor()) / 1024.0);
    Texture { name: "any".into(), width, height, texels: encode(values.collect()) }
}

fn float(values: Vec<f32>) -> Texels {
    Texels::Float(values.as_chunks::<4>().0.to_vec())
}

/// Light enough for alphas far above the least, at which the oracle's isotropic ones end otherwise.
fn srgb(values: Vec<f32>) -> Texels {
    Texels::Srgb8(
        values.as_chunks::<4>().0.iter().map(|texel| texel.map(|v| (128.0 + v * 127.0) as u8)).collect(),
    )
}

#[test]
fn surfaces_are_the_oracles() {
    let gpu = CheckedGpu::open();
    let mut random = Random(41);
    let plain = scene(&mut random, vec![]);
    let halves = [[16, 16], [1, 1], [5, 3], [31, 2]].map(|size| texture(&mut random, size, float)).into();
    let bytes = [[64, 64], [1, 7], [20, 33]].map(|size| texture(&mut random, size, srgb)).into();
    let (halves, bytes) = (scene(&mut random, halves), scene(&mut random, bytes));
    let rows = rows(&mut random);
    // Rounding of float32; of its texture coordinates; of texels to halves, 2⁻¹², and what squares and aspects make of it, and
    // normals that point away until they are bent to face the ray: what is left of them then is short.
    for (scene, limits) in [(plain, [5e-6, 2e-6]), (halves, [1e-4, 1e-4]), (bytes, [2e-2, 1.5e-3])] {
        let got = found(&gpu, &scene, Vec3::ZERO, &rows);
        let worst = errors(&scene, &rows, &got);
        assert!(worst[0] < limits[0] && worst[1] < limits[1], "{worst:?}");
    }
    gpu.finish();
}

/// Without direction, or against each other: normals that are no direction, triangles of next to no area.
#[test]
fn surfaces_without_directions_are_finite() {
    let gpu = CheckedGpu::open();
    let mut random = Random(42);
    let mut scene = scene(&mut random, vec![]);
    for (index, vertex) in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices).enumerate() {
        vertex.normal = [[0.0; 3], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]][index % 3];
        vertex.tangent = [[0.0; 4], [0.0, 1.0, 0.0, 1.0], [0.0; 4]][index / 3 % 3];
        let scale = [1.0, 1e-3, 1e-12][index / 36 % 3];
        vertex.position = vertex.position.map(|x| x * scale);
    }
    let rows: Vec<_> = (0..8192)
        .map(|_| {
            let origin = random.direction() * 5.0;
            let scale = [3.0, 1e-3, 1e-12][(random.number() * 3.0) as usize];
            ray(origin, (random.place() * scale - origin).normalize(), 0.0, 100.0)
        })
        .collect();
    let got = found(&gpu, &scene, Vec3::ZERO, &rows);
    let unit = |v: [f32; 3]| (Vec3::from(v).length() - 1.0).abs() < 1e-5;
    for Found { row, .. } in &got {
        assert!(
            [row.geometric_normal, row.normal, row.tangent, row.bitangent].into_iter().all(unit),
            "{row:?}"
        );
    }
    assert!(got.iter().filter(|found| found.triangle.is_some()).count() > 1000);
    gpu.finish();
}

/// A texture that is larger than the heap keeps of it is reduced by whole powers of two, and keeps its mean.
#[test]
fn large_textures_are_reduced() {
    let gpu = CheckedGpu::open();
    let [width, height] = [1200, 40];
    let texels = (0..width * height).map(|i| [if i % width % 4 < 2 { 1.0 } else { 0.0 }, 0.25, 0.5, 1.0]);
    let stripes = Texture { name: "stripes".into(), width, height, texels: Texels::Float(texels.collect()) };
    let mut scene = Scene { textures: vec![stripes], ..square::scene() };
    scene.materials[0].parameters[Parameter::Color as usize].texture = Some(0);
    let rows: Vec<_> = (0..64)
        .map(|i| ray(vec3(-1.9 + i as f32 * 0.06, 0.1, 1.0), vec3(0.0, 0.0, -1.0), 0.0, 9.0))
        .collect();
    // 1200 → 600 → 300 texels: stripes of two, then of one, then grey.
    for Found { row, .. } in found(&gpu, &scene, Vec3::ZERO, &rows) {
        assert_eq!(row.color_alpha_x[..3], [0.5, 0.25, 0.5]);
    }
    gpu.finish();
}
