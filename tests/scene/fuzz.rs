//! Noise: a scene with some bytes changed, added or cut off loads or fails, but never panics, and what loads
//! is valid.

use std::panic::{AssertUnwindSafe, catch_unwind};

use amas::scene::load_embedded;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::{CAMERA, check};

const TOML: &str = "[render]\nsize = [64, 64]\nindirect = { vpls = 3 }\n\
    [[material]]\nname = \"a\"\ntype = \"metal\"\npreset = \"gold\"\nalpha = [0.1, 0.3]\n\
    [[material]]\nname = \"b\"\ntype = \"principled\"\nbase_color = [0.1, 0.2, 0.3]\n\
    [[mesh]]\nobj = \"m.obj\"\nscale = [1, 2, -1]\nrotate = [10, 20, 30]\nmaterials = { x = \"b\" }\n\
    [[mesh]]\nshape = \"sphere\"\nsegments = [8, 4]\nmaterial = \"a\"\n\
    [[light]]\ntype = \"points\"\nfile = \"l.csv\"\n\
    [[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[4,0,0],[4,4,0],[2,1,0],[0,4,0]]\nradiance = [1, 1, 1]\n\
    [[light]]\ntype = \"points\"\ngenerate = { count = 9, min = [0,0,0], max = [1,1,1], intensity = [0, 1] }\n";
const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nv 0.4 0.4 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
    vn 0 0 1\nusemtl x\nf 1/1/1 2/2/1 3/3/1\nusemtl y\nf 1/1 3/3 4/4\nf -1 -2 -3 -4 -5\nf 1//1 2//1 5//1 \\\n4//1\n";
const MTL: &str =
    "newmtl y\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 10\nmap_d -s 1 1 1 none.png\nnewmtl x\nPr 0.3\n";
const CSV: &str = "x,y,z,r,g,b,range\n1,2,3,4,5,6,7\n-1.5,2e1,3,4,5,6,\n1,2,3,4,5,6,inf\n";

/// One change of a text: where (as a share), what sort, which byte.
type Edit = (f64, u8, u8);

fn edited(text: &str, edits: &[Edit]) -> Vec<u8> {
    // Bytes that mean something are more telling than noise.
    const TELLING: &[u8] = b"0123456789-+.,eE[]{}=\"'/\\#\n\r\t naif_";
    let mut bytes = text.as_bytes().to_vec();
    for (place, sort, byte) in edits {
        let at = ((place * bytes.len() as f64) as usize).min(bytes.len().saturating_sub(1));
        let telling = TELLING[usize::from(*byte) % TELLING.len()];
        match sort % 6 {
            0 if !bytes.is_empty() => bytes[at] = telling,
            1 => bytes.insert(at, telling),
            2 if !bytes.is_empty() => drop(bytes.remove(at)),
            3 if !bytes.is_empty() => bytes[at] = *byte,
            4 if byte % 8 == 0 => bytes.truncate(at),
            _ => bytes.insert(at, b'9'),
        }
    }
    bytes
}

/// Loads the scene made of these texts.
fn survives(toml: &str, obj: &[u8], mtl: &[u8], csv: &[u8], set: &str) -> Result<bool, TestCaseError> {
    let files: [(&str, &[u8]); 3] = [("m.obj", obj), ("m.mtl", mtl), ("l.csv", csv)];
    let set: Vec<_> = set.split_once('=').map(|(k, v)| (k.to_owned(), v.to_owned())).into_iter().collect();
    let loaded = catch_unwind(AssertUnwindSafe(|| load_embedded("t.toml", toml, &files, &set)));
    match loaded {
        Ok(Ok(scene)) => {
            prop_assert!(catch_unwind(AssertUnwindSafe(|| check(&scene))).is_ok(), "invalid scene");
            Ok(true)
        }
        Ok(Err(error)) => {
            let text = error.to_string();
            prop_assert!(text.contains("remedy: ") && error.exit_code() == 2, "{}", text);
            Ok(false)
        }
        Err(_) => Err(TestCaseError::fail("it panicked")),
    }
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    vec((0.0..1.0, any::<u8>(), any::<u8>()), 1..6)
}

#[test]
fn the_unchanged_scene_loads() {
    let toml = format!("{CAMERA}{TOML}");
    assert!(survives(&toml, OBJ.as_bytes(), MTL.as_bytes(), CSV.as_bytes(), "exposure=1").unwrap());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_toml_never_panics(edits in edits()) {
        let toml = edited(&format!("{CAMERA}{TOML}"), &edits);
        let toml = String::from_utf8_lossy(&toml);
        survives(&toml, OBJ.as_bytes(), MTL.as_bytes(), CSV.as_bytes(), "")?;
    }

    #[test]
    fn changed_files_never_panic(obj in edits(), mtl in edits(), csv in edits(), which in 0..3) {
        let part = |text: &str, edits: &[Edit], on: bool| if on { edited(text, edits) } else { text.into() };
        let toml = format!("{CAMERA}{TOML}");
        survives(&toml, &part(OBJ, &obj, which == 0), &part(MTL, &mtl, which == 1), &part(CSV, &csv, which == 2), "")?;
    }

    #[test]
    fn changed_overrides_never_panic(edits in edits()) {
        let set = edited("render.indirect={ vpls = 3, bounces = 2 }", &edits);
        survives(CAMERA, b"", b"", b"", &String::from_utf8_lossy(&set))?;
    }

    #[test]
    fn damaged_pictures_never_panic(edits in edits(), sort in 0..2) {
        let picture = crate::png(5, 3, |x, y| [x as u8 * 9, y as u8, 7, 255]);
        let mut bytes = picture.clone();
        for (place, _, byte) in &edits {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = *byte;
        }
        let name = ["t.png", "t.tga"][sort as usize];
        let toml = format!("{CAMERA}[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = {{ texture = \"{name}\" }}\n");
        let files: [(&str, &[u8]); 1] = [(name, &bytes)];
        let loaded = catch_unwind(AssertUnwindSafe(|| load_embedded("t.toml", &toml, &files, &[])));
        prop_assert!(loaded.is_ok());
    }
}
