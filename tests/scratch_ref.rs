use amas::HdrImage;
use amas::reference::{Options, render};
use amas::scene::*;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
fn v3(v: &serde_json::Value) -> [f64; 3] {
    let a = v.as_array().unwrap();
    [0, 1, 2].map(|i| a[i].as_f64().unwrap())
}
fn val(c: [f64; 3]) -> material::Value {
    material::Value {
        constant: c.map(|x| x as f32),
        texture: None,
    }
}
fn load(dir: &str) -> Scene {
    let t: serde_json::Value = serde_json::from_str(
        &std::fs::read_to_string(format!("/tmp/{}.json", dir.rsplit('/').next().unwrap())).unwrap(),
    )
    .unwrap();
    let mut s = Scene::default();
    s.render.size = [320, 240];
    let c = &t["camera"][0];
    s.cameras.push(Camera {
        name: "main".into(),
        position: v3(&c["position"]).into(),
        target: v3(&c["target"]).into(),
        up: DVec3::Y,
        projection: Projection::Perspective {
            vertical_fov: c["vertical_fov"].as_f64().unwrap(),
        },
        near: 0.01,
        far: None,
        path: vec![],
    });
    let mut names = HashMap::new();
    for m in t["material"].as_array().unwrap() {
        let name = m["name"].as_str().unwrap().to_string();
        names.insert(name.clone(), s.materials.len() as u32);
        let mut p = [material::Value::default(); material::PARAMETER_COUNT];
        let ty = m["type"].as_str().unwrap();
        let mut squared = false;
        p[Parameter::Aspect as usize] = val([1.0; 3]);
        p[Parameter::Eta as usize] = val([1.5; 3]);
        for (k, v) in m.as_object().unwrap() {
            let slot = match (k.as_str(), ty) {
                ("color" | "diffuse" | "base_color", _) | ("eta", "metal") => Parameter::Color,
                ("specular" | "k", _) => Parameter::Specular,
                ("roughness", _) => {
                    squared = true;
                    Parameter::Roughness
                }
                ("alpha", _) => Parameter::Roughness,
                ("sigma", _) => Parameter::Sigma,
                ("eta", _) => Parameter::Eta,
                ("metallic", _) => Parameter::Metallic,
                ("specular_tint", _) => Parameter::SpecularTint,
                ("sheen", _) => Parameter::Sheen,
                ("sheen_tint", _) => Parameter::SheenTint,
                ("clearcoat", _) => Parameter::Clearcoat,
                ("clearcoat_gloss", _) => Parameter::ClearcoatGloss,
                ("subsurface", _) => Parameter::Subsurface,
                ("anisotropic", _) => Parameter::Aspect,
                ("name" | "type", _) => continue,
                x => panic!("{x:?}"),
            };
            let value = v.as_f64().map_or_else(|| v3(v), |x| [x; 3]);
            p[slot as usize] = val(if k == "anisotropic" {
                value.map(|a| (1.0 - 0.9 * a).sqrt())
            } else {
                value
            });
        }
        let model = match ty {
            "matte" => Model::Matte,
            "plastic" => Model::Plastic,
            "metal" => Model::Metal,
            "substrate" => Model::Substrate,
            _ => Model::Principled,
        };
        s.materials.push(Material {
            name,
            model,
            parameters: p,
            squared_roughness: squared,
            two_sided: true,
        });
    }
    // own OBJ reader
    let (mut pos, mut nor, mut tex): (Vec<[f32; 3]>, Vec<[f32; 3]>, Vec<[f32; 2]>) =
        Default::default();
    let mut mesh = Mesh::default();
    for l in std::fs::read_to_string(format!("{dir}/scene.obj"))
        .unwrap()
        .lines()
    {
        let w: Vec<_> = l.split_whitespace().collect();
        let f = |i: usize| w[i].parse::<f32>().unwrap();
        match w.first().copied() {
            Some("v") => pos.push([f(1), f(2), f(3)]),
            Some("vn") => nor.push([f(1), f(2), f(3)]),
            Some("vt") => tex.push([f(1), f(2)]),
            Some("usemtl") => {
                if !mesh.triangles.is_empty() {
                    s.meshes.push(std::mem::take(&mut mesh));
                }
                mesh.material = names[w[1]];
            }
            Some("f") => {
                let b = mesh.vertices.len() as u32;
                assert_eq!(w.len(), 4);
                for q in &w[1..] {
                    let i: Vec<_> = q
                        .split('/')
                        .map(|x| x.parse::<usize>().unwrap_or(0))
                        .collect();
                    mesh.vertices.push(Vertex {
                        position: pos[i[0] - 1],
                        normal: nor[i[2] - 1],
                        tangent: [0.0; 4],
                        uv: if i[1] > 0 { tex[i[1] - 1] } else { [0.0; 2] },
                    });
                }
                mesh.triangles.push([b, b + 1, b + 2]);
            }
            _ => {}
        }
    }
    s.meshes.push(mesh);
    // winding against vertex normals
    let (mut agree, mut against, mut deg) = (0, 0, 0);
    for m in &s.meshes {
        for t in &m.triangles {
            let p = t.map(|i| Vec3::from(m.vertices[i as usize].position));
            let n: Vec3 = t
                .iter()
                .map(|&i| Vec3::from(m.vertices[i as usize].normal))
                .sum();
            let d = (p[1] - p[0]).cross(p[2] - p[0]).dot(n);
            if d > 0.0 {
                agree += 1
            } else if d < 0.0 {
                against += 1
            } else {
                deg += 1
            }
        }
    }
    println!("{dir}: winding agrees {agree}, against {against}, degenerate {deg}");
    for l in t["light"].as_array().unwrap() {
        let g = |k: &str| Vec3::from(v3(&l[k]).map(|x| x as f32));
        let shape = match l["type"].as_str().unwrap() {
            "point" => {
                s.point_lights.push(PointLight {
                    position: g("position"),
                    intensity: g("intensity"),
                    range: None,
                });
                continue;
            }
            "rect" => AreaShape::Rect {
                center: g("center"),
                u: g("u"),
                v: g("v"),
            },
            "disk" => {
                let n = g("normal").normalize();
                let u = n.any_orthonormal_vector();
                let r = l["radius"].as_f64().unwrap() as f32;
                AreaShape::Disk {
                    center: g("center"),
                    u: u * r,
                    v: n.cross(u) * r,
                }
            }
            x => panic!("{x}"),
        };
        s.area_lights.push(AreaLight {
            shape,
            radiance: g("radiance"),
            two_sided: false,
            visible: false,
            texture: None,
        });
    }
    s
}
#[test]
fn refs() {
    let which = std::env::var("SCENES").unwrap_or("f_points64".into());
    for name in which.split(',') {
        let dir = format!("/work/shared/reference/{name}");
        let s = load(&dir);
        let start = std::time::Instant::now();
        let tol = std::env::var("TOL")
            .ok()
            .and_then(|x| x.parse().ok())
            .unwrap_or(5e-4);
        let r = render(
            &s,
            &s.cameras[0],
            &Options {
                tolerance: tol,
                ..Options::of_scene(&s)
            },
        )
        .unwrap();
        println!("rendered in {:?}", start.elapsed());
        let se: f64 = r
            .standard_error
            .pixels
            .as_flattened()
            .iter()
            .map(|x| f64::from(*x))
            .sum::<f64>()
            / r.image
                .pixels
                .as_flattened()
                .iter()
                .map(|x| f64::from(*x))
                .sum::<f64>();
        println!("mean se / mean {se:.2e}");
        r.image.save(format!("/tmp/oracle_{name}.exr")).unwrap();
        let want = HdrImage::load(format!("{dir}/reference.exr")).unwrap();
        let mask = image::open(format!("{dir}/mask.png")).unwrap().to_luma8();
        let ids = image::open(format!("{dir}/object_id.png"))
            .unwrap()
            .to_luma8();
        let mut errs = vec![];
        let (mut sa, mut sb, mut se2) = (0.0, 0.0, 0.0);
        let mean = want
            .pixels
            .as_flattened()
            .iter()
            .map(|x| f64::from(*x))
            .sum::<f64>()
            / (want.pixels.len() * 3) as f64;
        for (i, m) in mask.pixels().enumerate() {
            if m.0[0] == 255 {
                for c in 0..3 {
                    let (a, b) = (
                        f64::from(r.image.pixels[i][c]),
                        f64::from(want.pixels[i][c]),
                    );
                    sa += a;
                    sb += b;
                    se2 += (a - b) * (a - b);
                    errs.push((
                        (a - b).abs() / b.abs().max(0.01 * mean),
                        i,
                        a,
                        b,
                        ids.as_raw()[i],
                    ));
                }
            }
        }
        errs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let n = errs.len();
        println!(
            "{name}: n {n} bias {:.3e} rmse/mean {:.3e} p50 {:.2e} p99 {:.2e} p99.9 {:.2e} max {:.2e}",
            sa / sb - 1.0,
            (se2 / n as f64).sqrt() / (sb / n as f64),
            errs[n / 2].0,
            errs[n * 99 / 100].0,
            errs[n * 999 / 1000].0,
            errs[n - 1].0
        );
        for e in errs.iter().rev().take(8) {
            println!("   {:?} at {} {}", e, e.1 % 320, e.1 / 320);
        }
    }
}
