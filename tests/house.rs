//! The map of the house in the README: what it names exists, it names every module, and modules import only from those
//! above them.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

use std::fs;
use std::path::{Path, PathBuf};

const README: &str = include_str!("../README.md");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// First words of the lines of the map.
fn map() -> Vec<&'static str> {
    let (_, house) = README.split_once("## The house").unwrap();
    let block = house.split("```").nth(1).unwrap();
    let lines = block.lines().skip(1);
    lines.filter_map(|line| line.split_whitespace().next()).collect()
}

/// Modules of `src/` in the order of the map.
fn modules() -> Vec<&'static str> {
    map()
        .into_iter()
        .filter_map(|path| path.strip_prefix("src/"))
        .map(|path| path.trim_end_matches('/').trim_end_matches(".rs"))
        .collect()
}

fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_dir() {
        let entries = path.read_dir().unwrap();
        return entries.flat_map(|entry| sources(&entry.unwrap().path())).collect();
    }
    let rust = path.extension().is_some_and(|extension| extension == "rs");
    rust.then(|| path.to_owned()).into_iter().collect()
}

#[test]
fn the_map_names_what_exists() {
    for path in map().iter().filter(|path| !path.contains('<')) {
        assert!(root().join(path).exists(), "{path}");
    }
    // Paths in the text, between backticks; those with a placeholder are for the reader to fill in.
    let quoted = README.split('`').skip(1).step_by(2);
    for path in quoted.filter(|quoted| !quoted.contains(['<', ' ', '\n'])) {
        let folder = ["src/", "glsl/", "tests/", "scenes/"];
        if folder.iter().any(|folder| path.starts_with(folder)) {
            assert!(root().join(path).exists(), "{path}");
        }
    }
    let (_, tests) = README.split_once("| test |").unwrap();
    let rows = tests.lines().skip(2).take_while(|line| line.starts_with('|'));
    for name in rows.flat_map(|row| row.split('|').nth(1).unwrap().split(',')) {
        let name = name.trim().trim_matches('`');
        let places = [format!("tests/{name}.rs"), format!("tests/{name}/main.rs")];
        assert!(places.iter().any(|place| root().join(place).exists()), "{name}");
    }
}

#[test]
fn every_module_is_on_the_map() {
    let lib = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let mut declared: Vec<_> =
        lib.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let mut mapped = modules();
    let rows = lib.lines().filter_map(|line| line.strip_prefix("//! | [`"));
    let documented: Vec<_> =
        rows.map(|row| row.split('`').next().unwrap().trim_start_matches("mod@")).collect();
    assert_eq!(documented, mapped, "the README's order and the crate's");
    declared.sort_unstable();
    mapped.sort_unstable();
    assert_eq!(declared, mapped);
}

#[test]
fn imports_point_up() {
    let order = modules();
    for (rank, module) in order.iter().enumerate() {
        let place = |suffix: &str| root().join(format!("src/{module}{suffix}"));
        let files = [place(".rs"), place("")].into_iter().filter(|path| path.exists());
        for file in files.flat_map(|path| sources(&path)) {
            let text = fs::read_to_string(&file).unwrap();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            for used in code.flat_map(|line| line.split("crate::").skip(1)) {
                let end = used.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
                let used = &used[..end.unwrap_or(used.len())];
                let below = order[rank + 1..].contains(&used);
                assert!(!below, "{} imports {used}", file.display());
            }
        }
    }
}

/// Keys that the parser knows, between quotes in its lists of keys.
#[test]
fn every_key_of_a_scene_is_documented() {
    let page = fs::read_to_string(root().join("docs/scene.md")).unwrap();
    let words: Vec<&str> = page
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
        .collect();
    let mut keys = 0;
    for path in sources(&root().join("src/scene/parse")) {
        let text = fs::read_to_string(&path).unwrap();
        for opening in ["allow(&[", "KEYS: [", "own: &[&str] = ", "allow(&[&COMMON_KEYS[..], "] {
            for list in text.split(opening).skip(1) {
                let ends = [")?", ");", "];", "};"].into_iter().filter_map(|end| list.find(end));
                let end = ends.min().unwrap_or(list.len());
                for key in list[..end].split('"').skip(1).step_by(2) {
                    assert!(words.contains(&key), "{}: {key}", path.display());
                    keys += 1;
                }
            }
        }
    }
    assert!(keys > 70, "{keys} keys found");
}
