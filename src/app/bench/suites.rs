//! The suites: small scenes, each of which makes one thing dear.

use super::super::args::Suite;
use super::super::default_scene;

/// Ground, walls and sixty spheres of all five BSDFs, in a box of lights.
const HALL: &str = include_str!("../../../scenes/million.toml");
/// A box lit by one panel, most of it by way of its walls.
const ROOM: &str = include_str!("../../../scenes/indirect.toml");

/// What is measured of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measured {
    /// A frame.
    Frame,
    /// A frame of gathered light, from lights that were traced before.
    Gathering,
    /// From nothing to the first picture.
    Start,
}

/// A point of a suite.
pub(super) struct Case {
    /// Suite and point.
    pub(super) name: String,
    /// A scene file's text.
    pub(super) toml: String,
    pub(super) measured: Measured,
}

/// Names of points, and their scenes.
type Points = Vec<(String, String)>;
/// A suite, its name, and what makes its points.
type Row = (Suite, &'static str, fn() -> Points);

/// Every suite, in the order in which they run.
const SUITES: [Row; 6] = [
    (Suite::Lights, "lights", lights),
    (Suite::Area, "area", area),
    (Suite::Bsdf, "bsdf", bsdf),
    (Suite::Indirect, "indirect", indirect),
    (Suite::Passes, "passes", passes),
    (Suite::Startup, "startup", startup),
];

/// The points of these suites.
pub(super) fn cases(wanted: &[Suite]) -> Vec<Case> {
    let all = wanted.contains(&Suite::All);
    let suites = SUITES.iter().filter(|(suite, ..)| all || wanted.contains(suite));
    suites
        .flat_map(|(suite, prefix, points)| {
            let case = move |(name, toml)| Case {
                name: format!("{prefix}/{name}"),
                toml,
                measured: match suite {
                    Suite::Startup => Measured::Start,
                    Suite::Indirect => Measured::Gathering,
                    _ => Measured::Frame,
                },
            };
            points().into_iter().map(case)
        })
        .collect()
}

/// Lights by their number, as many of them at each pixel; without a range; and more than a list holds.
fn lights() -> Points {
    let mut points: Points =
        [10, 14, 18].map(|log2| (format!("ranged_{}", 1 << log2), hall(log2, &reach(log2), ""))).into();
    points.push(("unranged_4096".into(), hall(12, "", "")));
    points.push(("folded_4096".into(), hall(12, ", range = 20", "max_lights_per_cluster = 128")));
    points
}

/// One light of each kind, many of them, and a shadow.
fn area() -> Points {
    let rect = "type = \"rect\"\ncenter = [0, 2, -1]\nu = [0.6, 0, 0]\nv = [0, 0.4, 0.3]";
    let disk = "type = \"disk\"\ncenter = [0, 2, -1]\nnormal = [0, -0.6, 0.8]\nradius = 0.5";
    let polygon = "type = \"polygon\"\nvertices = [[-0.8, 0.6, -1.5], [0.8, 0.6, -1.5], [0.8, 1.8, -1.5], [-0.8, 1.8, -1.5]]\n\
         holes = [[[-0.2, 1, -1.5], [-0.2, 1.4, -1.5], [0.2, 1.4, -1.5], [0.2, 1, -1.5]]]";
    let line = "type = \"line\"\na = [-1, 2, -1]\nb = [1, 2, -1]\nradius = 0.02";
    let textured = format!("{rect}\ntexture = \"default_zellige.png\"");
    let kinds =
        [("rect", rect), ("disk", disk), ("polygon", polygon), ("line", line), ("textured", &textured)];
    let mut points: Points = kinds.map(|(name, light)| (name.into(), lit(&[light.into()], ""))).into();
    points.push(("shadowed".into(), lit(&[rect.into()], "shadows = true")));
    let small = |index: u32| {
        let (x, z) = (0.8 * f64::from(index % 4) - 1.2, 0.8 * f64::from(index / 4) - 1.2);
        format!("type = \"rect\"\ncenter = [{x}, 2, {z}]\nu = [0.2, 0, 0]\nv = [0, 0, 0.2]")
    };
    points.push(("sixteen".into(), lit(&(0..16).map(small).collect::<Vec<_>>(), "")));
    points
}

/// A wall and a ball of each BSDF under the same point lights.
fn bsdf() -> Points {
    let materials = [
        ("matte", "color = [0.6, 0.4, 0.3]\nsigma = 20"),
        ("plastic", "diffuse = [0.5, 0.1, 0.05]\nroughness = 0.4"),
        ("metal", "preset = \"gold\"\nroughness = 0.4"),
        ("substrate", "diffuse = [0.05, 0.1, 0.4]\nroughness = 0.4"),
        ("principled", "base_color = [0.1, 0.4, 0.2]\nroughness = 0.4\nsheen = 0.5\nclearcoat = 1"),
    ];
    let scene = |(name, parameters)| {
        let lights = "type = \"points\"\ngenerate = { count = 256, seed = 1, min = [-3, -2, 1.2], max = [3, 2, 2], \
             intensity = [0.1, 0.3], range = 3 }";
        format!(
            "[render]\nsize = [320, 180]\n{CAMERA}[[material]]\nname = \"it\"\ntype = \"{name}\"\n{parameters}\n\
             [[mesh]]\nshape = \"plane\"\nsize = [12, 8]\nrotate = [90, 0, 0]\nmaterial = \"it\"\n\
             [[mesh]]\nshape = \"sphere\"\nradius = 1\nmaterial = \"it\"\n[[light]]\n{lights}\n"
        )
    };
    materials.map(|material| (material.0.into(), scene(material))).into()
}

/// Light by way of walls, by the number of virtual lights and by materials; and point lights with shadows.
fn indirect() -> Points {
    let small = ROOM.replacen("size = [640, 480]", "size = [160, 120]", 1);
    let matte = "type = \"matte\"\ncolor = [0.6, 0.6, 0.6]";
    let points = "type = \"points\"\ngenerate = { count = 1024, seed = 1, min = [-3, 1, -3], max = [3, 2, 3], \
         intensity = [0.1, 0.3], range = 2 }";
    let room = |vpls: u32| small.replacen("vpls = 16384", &format!("vpls = {vpls}"), 1);
    let all_matte = small.replacen(FLOOR, matte, 1).replacen(
        "type = \"metal\"\npreset = \"gold\"\nalpha = 0.2",
        matte,
        1,
    );
    vec![
        ("room_1024".into(), room(1024)),
        ("room_65536".into(), room(65536)),
        ("room_matte_16384".into(), all_matte),
        ("points_1024".into(), lit(&[points.into()], "shadows = true")),
    ]
}

/// The room's glossy floor.
const FLOOR: &str =
    "type = \"plastic\"\ndiffuse = [0.3, 0.3, 0.3]\nspecular = [0.9, 0.9, 0.9]\neta = 1.8\nalpha = 0.12";

/// Each pass where it is the dearest. The balls' vertices fit into a core's own cache: with 16 times as many, 25 MB, the
/// prepass of the same program took 58 to 88 CPU ms from start to start, by what else used the memory.
fn passes() -> Points {
    let balls = (0..4).map(|index| {
        let x = f64::from(index) - 1.5;
        format!(
            "[[mesh]]\nshape = \"sphere\"\nradius = 0.4\nsegments = [128, 64]\nmaterial = \"floor\"\ntranslate = [{x}, 0.5, 0]\n"
        )
    });
    let few = "type = \"points\"\ngenerate = { count = 64, seed = 1, min = [-3, 1, -3], max = [3, 2, 3], intensity = [0.1, 0.3] }";
    let shaded = |front_end: &str| hall(14, ", range = 9", &format!("front_end = \"{front_end}\""));
    let points = [
        ("prepass", lit(&[], "") + &balls.collect::<String>()),
        ("cluster", hall(18, &reach(18), "").replace("[320, 180]", "[160, 90]")),
        ("resolve", shaded("compute")),
        ("indirect", shaded("fragment")),
        ("direct", lit(&[few.into()], "light_error = 0").replace("[160, 90]", "[320, 180]")),
        ("present", lit(&[], "").replace("[160, 90]", "[1280, 720]")),
    ];
    points.map(|(name, toml)| (name.into(), toml)).into()
}

/// The embedded scene, and lights by the million.
fn startup() -> Points {
    vec![
        ("default".into(), default_scene::TOML.replacen("size = [1280, 720]", "size = [320, 180]", 1)),
        ("million".into(), hall(20, &reach(20), "")),
    ]
}

const CAMERA: &str =
    "[[camera]]\nname = \"main\"\nposition = [0, 1.4, 5]\ntarget = [0, 0.6, 0]\nvertical_fov = 40\n";

/// The hall with 2^`log2` lights whose range is `range`.
fn hall(log2: u32, range: &str, keys: &str) -> String {
    HALL.replacen("size = [1280, 720]", &format!("size = [320, 180]\n{keys}"), 1)
        .replacen("count = 1048576", &format!("count = {}", 1 << log2), 1)
        .replacen(", range = 1.15", range, 1)
}

/// The range at which as many of the hall's lights reach a point as of its million.
fn reach(log2: u32) -> String {
    format!(", range = {}", 1.15 * f64::exp2(f64::from(20 - log2) / 3.0))
}

/// A ball on a floor under these lights.
fn lit(lights: &[String], keys: &str) -> String {
    let lights = lights.iter().map(|light| {
        let radiance = if light.contains("points") { "" } else { "radiance = [5, 5, 5]\n" };
        format!("[[light]]\n{light}\n{radiance}")
    });
    format!(
        "[render]\nsize = [160, 90]\n{keys}\n{CAMERA}\
         [[material]]\nname = \"floor\"\ntype = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\n\
         [[material]]\nname = \"ball\"\ntype = \"metal\"\npreset = \"gold\"\nroughness = 0.4\n\
         [[mesh]]\nshape = \"plane\"\nsize = [8, 8]\nmaterial = \"floor\"\n\
         [[mesh]]\nshape = \"sphere\"\nradius = 0.6\nmaterial = \"ball\"\ntranslate = [0, 0.6, 0]\n{}",
        lights.collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Model, RenderSettings, load_embedded};

    /// Every point's scene is sound and is what its name says: no replacement of a text has found nothing.
    #[test]
    fn scenes_of_all_suites() {
        let cases = cases(&[Suite::All]);
        assert_eq!(cases.len(), SUITES.iter().map(|(.., points)| points().len()).sum::<usize>());
        for case in &cases {
            let scene = load_embedded(&case.name, &case.toml, default_scene::FILES, &[]).unwrap();
            assert!(scene.warnings.is_empty(), "{}: {:?}", case.name, scene.warnings);
            let [width, _] = scene.render.size;
            assert_eq!(width == 1280, case.name == "passes/present", "{}", case.name);
            let (points, area) = (scene.point_lights.len(), scene.area_lights.len());
            match case.name.split_once('/').unwrap() {
                ("lights", name) => {
                    let [kind, count] = name.split_once('_').map(<[&str; 2]>::from).unwrap();
                    assert_eq!(points.to_string(), count);
                    let ranged = scene.point_lights.iter().all(|light| light.range.is_some());
                    assert_eq!(ranged, kind != "unranged", "{name}");
                }
                ("indirect", name) => {
                    let RenderSettings { vpls, shadows, .. } = scene.render;
                    let [_, count] = name.rsplit_once('_').map(<[&str; 2]>::from).unwrap();
                    assert!(shadows && (vpls as usize).max(points).to_string() == count, "{name}");
                    let all_matte = scene.materials.iter().all(|material| material.model == Model::Matte);
                    assert_eq!(all_matte, name.starts_with("room_matte"), "{name}");
                }
                ("area", name) => assert_eq!((points, area), (0, if name == "sixteen" { 16 } else { 1 })),
                ("startup", "million") => assert_eq!(points, 1 << 20),
                _ => assert_eq!(area, 0, "{}", case.name),
            }
        }
        let mut names: Vec<_> = cases.iter().map(|case| &case.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), cases.len());
    }

    #[test]
    fn suites_are_chosen() {
        let of = |wanted: &[Suite]| cases(wanted).into_iter().map(|case| case.name).collect::<Vec<_>>();
        assert!(of(&[]).is_empty());
        assert!(of(&[Suite::Bsdf]).iter().all(|name| name.starts_with("bsdf/")));
        assert_eq!(of(&[Suite::Area, Suite::Bsdf]), [of(&[Suite::Area]), of(&[Suite::Bsdf])].concat());
        assert!(
            cases(&[Suite::All])
                .iter()
                .all(|case| (case.measured == Measured::Start) == case.name.starts_with("startup/"))
        );
    }
}
