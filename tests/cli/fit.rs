//! `amas fit`: figures on stdout, maps in a folder that it makes.

use crate::Folder;

#[test]
fn maps_of_one_layer() {
    let folder = Folder::new();
    let printed = folder.done(&["fit", "--layer", "substrate_diffuse", "--maps", "maps"]);
    let lines: Vec<_> = printed.lines().collect();
    assert!(lines.len() == 2 && lines[0].starts_with("layer"), "{printed}");
    assert!(lines[1].starts_with("substrate_diffuse") && lines[1].contains("0.0412"), "{printed}");
    assert_eq!(folder.names(), ["maps", "scene.toml"]);
    let made = folder.path("maps").read_dir().unwrap();
    let mut made: Vec<_> = made.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    made.sort();
    assert_eq!(made, ["substrate_diffuse.csv", "substrate_diffuse.png", "summary.csv"]);
    let figures = String::from_utf8(folder.read("maps/substrate_diffuse.csv")).unwrap();
    assert_eq!(figures.lines().count(), 33);
    assert!(figures.starts_with("r,cos,albedo,tv,"), "{figures}");
    let summary = String::from_utf8(folder.read("maps/summary.csv")).unwrap();
    assert_eq!(summary.lines().count(), 2);
}
