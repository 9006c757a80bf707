//! What the window changes: a frame that takes an edit draws what a new frame of the edited scene does, to the bit.

use crate::support::{Rig, ranged_lights, scene};
use amas::gpu_scene::Edit;
use amas::passes::aov::Quantity;
use amas::scene::settings::Tonemap;
use amas::scene::{Parameter, Scene};
use amas::{Frame, FrameInputs, FrameSettings, HdrImage};

/// Two materials under lights with a range: a spare scene, because every test compiles its pipelines several times.
const ROOM: &str = r#"
[render]
size = [48, 32]
[[camera]]
name = "main"
position = [0, 1.5, 5]
target = [0, 0.5, 0]
vertical_fov = 40
[[material]]
name = "matte"
type = "matte"
color = [0.5, 0.3, 0.2]
[[material]]
name = "plastic"
type = "plastic"
diffuse = [0.2, 0.3, 0.4]
roughness = 0.5
[[mesh]]
shape = "plane"
size = [8, 8]
material = "matte"
[[mesh]]
shape = "sphere"
radius = 0.8
translate = [0, 0.8, 0]
material = "plastic"
"#;

const PANEL: &str = "[[light]]
type = \"rect\"
center = [0, 3, 1]
u = [0.5, 0, 0]
v = [0, 0, 0.5]
radiance = [4, 4, 4]
";

fn text() -> String {
    format!("{ROOM}{}", ranged_lights(40, 2.0))
}

/// Takes the edit in place, as `adopt` must be able to, and compares with a scene that was uploaded so.
fn adopts(text: &str, edit: Edit, change: impl Fn(&mut Scene)) {
    let Rig { gpu_scene, mut frame, scene: mut edited, _device: device } = Rig::new(scene(text));
    let before = render(&mut frame, &edited);
    change(&mut edited);
    // Somebody else has the scene: nothing is changed under their hands.
    assert!(!frame.adopt(&edited, edit).unwrap());
    drop(gpu_scene);
    assert!(frame.adopt(&edited, edit).unwrap(), "{edit:?} asks for a new scene");
    let after = render(&mut frame, &edited);
    assert_ne!(before, after, "{edit:?} changes nothing");
    assert_eq!(after, Rig::new(edited).render());
    drop((frame, device));
}

fn render(frame: &mut Frame, scene: &Scene) -> HdrImage {
    let inputs = FrameInputs {
        camera: &scene.cameras[0],
        time: 0.0,
        samples: 1,
        exposure: 0.0,
        split: false,
        progress: indicatif::ProgressBar::hidden(),
    };
    frame.render(&inputs).unwrap();
    frame.hdr().unwrap()
}

#[test]
fn materials_change_in_place() {
    adopts(&text(), Edit::Material(0), |scene| {
        scene.materials[0].parameters[Parameter::Color as usize].constant = [0.9, 0.1, 0.4];
    });
    adopts(&text(), Edit::Material(1), |scene| {
        scene.materials[1].parameters[Parameter::Roughness as usize].constant[0] = 0.71;
    });
}

#[test]
fn lights_change_in_place() {
    adopts(&text(), Edit::PointLights, |scene| {
        scene.point_lights[3].position.x += 0.25;
        scene.point_lights[5].intensity *= 3.0;
        scene.point_lights[7].range = Some(2.5);
    });
    adopts(&format!("{ROOM}{PANEL}"), Edit::AreaLights, |scene| scene.area_lights[0].radiance.x = 11.0);
}

/// What needs other pipelines or sizes is not done in place.
#[test]
fn larger_changes_ask_for_a_new_scene() {
    let Rig { gpu_scene, mut frame, mut scene, _device: device } = Rig::new(scene(&text()));
    drop(gpu_scene);
    scene.point_lights[0].range = None;
    assert!(!frame.adopt(&scene, Edit::PointLights).unwrap());
    scene.materials[0].two_sided = !scene.materials[0].two_sided;
    assert!(!frame.adopt(&scene, Edit::Material(0)).unwrap());
    drop((frame, device));
}

/// Settings, too: limits, tone curve, and what asks for other passes.
#[test]
fn settings_change_in_place() {
    let mut rig = Rig::new(scene(&text()));
    rig.render();
    let start = *rig.frame.settings();
    let settings = [
        FrameSettings { tonemap: Tonemap::Aces, ..start },
        FrameSettings { max_lights_per_cluster: 128, light_error: 0.2, ..start },
        FrameSettings { background: [0.5, 0.2, 0.1], tonemap: Tonemap::None, ..start },
        FrameSettings { brute_force: true, ..start },
        start,
    ];
    for settings in settings {
        rig.frame.retune(settings).unwrap();
        let image = rig.render();
        let pixels = rig.frame.ldr().unwrap();
        let mut new = Rig::with(rig.scene.clone(), |of_new| *of_new = settings);
        assert_eq!(image, new.render(), "{settings:?}");
        assert_eq!(pixels, new.frame.ldr().unwrap(), "{settings:?}");
    }
}

const WALL: &str = r#"
[render]
size = [16, 16]
[[camera]]
name = "main"
position = [0, 0, 4]
target = [0, 0, 0]
vertical_fov = 40
[[material]]
name = "wall"
MATERIAL
[[mesh]]
shape = "plane"
size = [20, 20]
rotate = [90, 0, 0]
material = "wall"
[[light]]
type = "rect"
center = [0, 0, 2]
u = [0.1, 0, 0]
v = [0, -0.1, 0]
radiance = [1, 1, 1]
visible = false
"#;

fn wall(material: &str) -> Rig {
    let mut rig = Rig::new(scene(&WALL.replace("MATERIAL", material)));
    rig.render();
    rig
}

fn near(values: &[[f32; 4]], want: [f32; 3], bound: f32) {
    for value in values {
        assert_eq!(value[3], 1.0);
        let off = [0, 1, 2].map(|axis| (value[axis] - want[axis]).abs());
        assert!(off.iter().all(|off| *off <= bound), "{value:?}, not {want:?}");
    }
}

/// A wall 4 m away: every variable of its material is known.
#[test]
fn variables_of_materials_are_known() {
    let matte = wall("type = \"matte\"\ncolor = [0.25, 0.5, 0.75]");
    near(&matte.aov(Quantity::Albedo), [0.25, 0.5, 0.75], 0.0);
    near(&matte.aov(Quantity::Roughness), [1.0; 3], 0.0);
    near(&matte.aov(Quantity::LtcBound), [0.0; 3], 0.0);
    near(&matte.aov(Quantity::Depth), [4.0; 3], 1e-5);
    drop(matte);
    let metal = wall("type = \"metal\"\neta = [0.2, 1, 2]\nk = [3, 2, 1]\nroughness = 0.6");
    // ((η − 1)² + k²) / ((η + 1)² + k²); alpha = roughness².
    near(&metal.aov(Quantity::Albedo), [9.64 / 10.44, 4.0 / 8.0, 2.0 / 10.0], 1e-6);
    near(&metal.aov(Quantity::Roughness), [0.36; 3], 1e-6);
    let bound = metal.aov(Quantity::LtcBound);
    assert!(bound.iter().all(|[x, ..]| (1e-4..=1.0).contains(x)), "{:?}", bound[0]);
}
