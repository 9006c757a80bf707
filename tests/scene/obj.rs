//! OBJ and MTL files as the world writes them.

use amas::scene::{Model, Parameter};

use crate::{check, close, load, obj, png};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn scene(text: &str, mtl: &str, toml: &str) -> amas::Scene {
    let scene = load(toml, &[("m.obj", text.as_bytes()), ("m.mtl", mtl.as_bytes())]);
    check(&scene);
    scene
}

#[test]
fn negative_indices_count_from_the_end() {
    let mesh = obj(&format!("{TRIANGLE}f -3 -2 -1\n"), "");
    assert_eq!(mesh, obj(&format!("{TRIANGLE}f 1 2 3\n"), ""));
}

#[test]
fn line_ends_bom_comments_and_continuations_change_nothing() {
    let plain = obj(&format!("{TRIANGLE}f 1 2 3\n"), "");
    assert_eq!(obj(&format!("\u{feff}{TRIANGLE}f 1 2 3\n").replace('\n', "\r\n"), ""), plain);
    assert_eq!(obj(&format!("# a \\\n{TRIANGLE}f 1 \\\n 2 3 # front\ns 1\nl 1 2\np 1\n"), ""), plain);
    assert_eq!(obj("v 0 0 0 1.0\nv\t1 0 0 0.2 0.3 0.4\nv 0 1 0 1 1 1 1\nf 1 2 3", ""), plain);
}

#[test]
fn an_n_gon_is_covered_once_even_if_it_is_concave() {
    // An L of area 3, which a fan from its first corner would leave.
    let text = "v 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nf 6 1 2 3 4 5\n";
    let mesh = obj(text, "");
    assert_eq!(mesh.triangles.len(), 4);
    let p = |i: u32| glam::Vec3::from(mesh.vertices[i as usize].position);
    let areas = mesh.triangles.iter().map(|[a, b, c]| (p(*b) - p(*a)).cross(p(*c) - p(*a)).z * 0.5);
    let areas: Vec<f32> = areas.collect();
    assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
    close(&[areas.iter().sum()], &[3.0]);
}

#[test]
fn degenerate_and_repeated_triangles_are_dropped_and_vertices_shared() {
    let text = format!("{TRIANGLE}v 1 0 0\nv 0.5 0 0\nf 1 2 3\nf 3 1 4\nf 1 1 2\nf 1 5 2\nf 1 2\n");
    let mesh = obj(&text, "");
    assert_eq!((mesh.triangles.len(), mesh.vertices.len()), (1, 3));
}

#[test]
fn bad_normals_are_recomputed_and_mixed_faces_keep_their_own() {
    let text = format!("{TRIANGLE}vn 0 0 0\nvn nan 0 1\nvn -1.#IND 0 0\nf 1//1 2//2 3//3\n");
    assert!(obj(&text, "").vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
    let text = format!(
        "{TRIANGLE}vt 0 0\nvt 1 0\nvt 0 1\nvn 0 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\n\
        f 1/1/1 2/2/1 3/3/1\nf 4 5 6\nf 1//1 2 4\n"
    );
    let mesh = obj(&text, "");
    let far = |v: &&amas::scene::Vertex| v.position[0] > 4.0 && v.uv == [0.0; 2];
    assert!(mesh.vertices.iter().filter(far).count() >= 3);
    let own = mesh.vertices.iter().filter(|v| v.normal == [0.0, 1.0, 0.0]);
    assert_eq!(own.map(|v| v.uv).collect::<Vec<_>>(), [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
}

#[test]
fn materials_bind_by_override_remap_name_mtl_and_grey_in_this_order() {
    let text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 2 2 2\n\
        usemtl a\nf 1 2 3\nusemtl b\nf 4 5 6\nusemtl c\nf 1 2 7\nusemtl d\nf 1 3 7\nusemtl a\nf 2 3 7\n";
    let mtl = "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\nnewmtl c\nKd 0 0 1\n";
    let materials = "[[material]]\nname = \"a\"\ntype = \"metal\"\npreset = \"gold\"\n\
        [[material]]\nname = \"x\"\ntype = \"matte\"\ncolor = [0.1, 0.2, 0.3]\n";
    let mesh = "[[mesh]]\nobj = \"m.obj\"\n";
    let names = |keys: &str| {
        let scene = scene(text, mtl, &format!("{materials}{mesh}{keys}"));
        let name = |mesh: &amas::scene::Mesh| scene.materials[mesh.material as usize].name.clone();
        (scene.meshes.iter().map(name).collect::<Vec<_>>(), scene.warnings)
    };
    let (bound, warnings) = names("");
    assert_eq!(bound, ["a", "b", "c", "grey"]);
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].contains("\"d\""), "{warnings:?}");
    let (bound, _) = names("materials = { a = \"x\", d = \"x\" }");
    assert_eq!(bound, ["x", "b", "c", "x"], "a remap is more particular than a name");
    let (bound, warnings) = names("materials = { bb = \"x\" }");
    assert_eq!(bound[1], "b");
    assert!(warnings[0].contains("nearest is \"b\""), "{warnings:?}");
    assert_eq!(names("material = \"x\"").0, ["x"; 4]);
}

#[test]
fn mtl_materials_follow_the_documented_rule() {
    let text =
        format!("mtllib m.mtl\n{TRIANGLE}v 0 0 1\nusemtl m\nf 1 2 3\nusemtl p\nf 1 2 4\nusemtl d\nf 1 3 4\n");
    let mtl = "newmtl m\r\nKd 0.1 0.2 0.3\r\nKs 0 0 0\r\nillum 2\r\n\
        newmtl p\nKd 0.4\nKs 0.5 0.5 0.5\nNs 98\nNi 1.0\nKe 1 1 1\nd 0.5\n\
        newmtl d\nKd 1 1 1\nPr 0.25\nPm 1\nPc 0.5\nPcr 0.2\naniso 0.5\nNi 1.3\n";
    let scene = scene(&text, mtl, "[[mesh]]\nobj = \"m.obj\"\n");
    let [m, p, d] = [0, 1, 2].map(|i| &scene.materials[i]);
    assert_eq!((m.model, p.model, d.model), (Model::Matte, Model::Plastic, Model::Principled));
    close(&m.value(Parameter::Color).constant, &[0.1, 0.2, 0.3]);
    close(&p.value(Parameter::Color).constant, &[0.4; 3]);
    close(&p.value(Parameter::Specular).constant, &[0.5; 3]);
    let first = |m: &amas::scene::Material, p| m.value(p).constant[0];
    close(&[first(p, Parameter::Eta), first(p, Parameter::Roughness)], &[1.5, 0.02_f32.sqrt()]);
    assert!(!p.squared_roughness && d.squared_roughness);
    let rows = [Parameter::Roughness, Parameter::Metallic, Parameter::Clearcoat, Parameter::ClearcoatGloss];
    close(&rows.map(|row| first(d, row)), &[0.25, 1.0, 0.5, 0.8]);
    close(&[first(d, Parameter::Eta), first(d, Parameter::Aspect)], &[1.3, 0.55_f32.sqrt()]);
    let said = |word: &str| scene.warnings.iter().any(|w| w.contains(word) && w.contains("\"p\""));
    assert!(said("emission") && said("transparency"), "{:?}", scene.warnings);
}

#[test]
fn paths_may_have_backslashes_spaces_and_a_stranger_s_folders() {
    let text =
        format!("mtllib C:\\work\\my model.mtl\n{TRIANGLE}vt 0 0\nvt 1 0\nvt 0 1\nusemtl w\nf 1/1 2/2 3/3\n");
    let mtl = "newmtl w\nmap_Kd -s 1 1 1 -clamp on tex\\wood grain.png\nmap_Bump -bm 2 tex\\bump.png\nmap_Ks gone.png\nKs 1 1 1\n";
    let color = png(2, 1, |x, _| [x as u8 * 255, 10, 20, 255]);
    let bump = png(2, 2, |x, _| [x as u8 * 255; 4]);
    let files: [(&str, &[u8]); 4] = [
        ("a/m.obj", text.as_bytes()),
        ("a/my model.mtl", mtl.as_bytes()),
        ("a/tex/wood grain.png", &color),
        ("a/tex/bump.png", &bump),
    ];
    let scene = load("[[mesh]]\nobj = \"a\\\\m.obj\"\n", &files);
    let material = &scene.materials[0];
    assert_eq!(material.model, Model::Plastic);
    assert_eq!(material.value(Parameter::Color).texture, Some(0));
    assert_eq!(material.value(Parameter::Normal).texture, Some(1));
    assert_eq!(material.value(Parameter::Specular).texture, None);
    assert!(scene.warnings.iter().any(|w| w.contains("gone.png")), "{:?}", scene.warnings);
}

#[test]
fn a_missing_mtl_is_a_warning() {
    let scene = load(
        "[[mesh]]\nobj = \"m.obj\"\n",
        &[("m.obj", format!("mtllib no such.mtl\n{TRIANGLE}usemtl x\nf 1 2 3\n").as_bytes())],
    );
    assert!(scene.warnings.iter().any(|w| w.contains("no such.mtl")), "{:?}", scene.warnings);
    assert_eq!(scene.materials[scene.meshes[0].material as usize].parameters[0].constant, [0.5; 3]);
}

#[test]
fn one_obj_twice_shares_its_mtl_materials() {
    let text = format!("mtllib m.mtl\n{TRIANGLE}usemtl a\nf 1 2 3\n");
    let mesh = "[[mesh]]\nobj = \"m.obj\"\n";
    let scene = scene(&text, "newmtl a\nKd 1 0 0\n", &format!("{mesh}{mesh}"));
    assert_eq!((scene.meshes.len(), scene.materials.len()), (2, 1));
}
