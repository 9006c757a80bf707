//! What is counted, and the scenes that have so much of it. A further sweep is a row here.

use super::grid::light_grid;
use crate::error::Result;
use crate::scene::{Scene, load_embedded};

/// Something that is counted, and how much of it there is.
pub(super) struct Sweep {
    pub(super) name: &'static str,
    /// The scene, in words.
    pub(super) what: &'static str,
    pub(super) settings: &'static [u32],
    /// A scene of a setting at a size, or where pixels are counted at that of its own.
    make: fn(u32, [u32; 2]) -> Result<Scene>,
    size: [u32; 2],
    pub(super) count: fn(&Scene) -> u64,
}

/// The sweep over point lights, which other programs were timed on.
pub(super) const LIGHTS: &str = "point lights";
/// The sweep over pixels, of the same scene.
pub(super) const PIXELS: &str = "pixels";

pub(super) const SWEEPS: &[Sweep] = &[
    Sweep {
        name: "triangles",
        what: "a plane and 16 balls of ever finer triangles under 64 point lights",
        settings: &[1_000, 3_162, 10_000, 31_623, 100_000, 316_228, 1_000_000],
        make: balls,
        size: [320, 180],
        count: |scene| scene.meshes.iter().map(|mesh| mesh.triangles.len() as u64).sum(),
    },
    Sweep {
        name: PIXELS,
        what: "`scenes/light_grid.toml`, 4,096 point lights",
        settings: &[80, 160, 320, 640, 1280, 1920, 2560],
        make: |width, _| light_grid(4096, [width, width * 9 / 16]),
        size: [0; 2],
        count: |scene| u64::from(scene.render.size[0]) * u64::from(scene.render.size[1]),
    },
    Sweep {
        name: "area lights",
        what: "a ball of gold on a plastic floor under rectangles side by side, the smaller the more there are, all of which reach everything",
        settings: &[1, 4, 16, 64, 256],
        make: panels,
        size: [160, 90],
        count: |scene| scene.area_lights.len() as u64,
    },
    Sweep {
        name: LIGHTS,
        what: "`scenes/light_grid.toml`, ever denser",
        settings: &[0, 256, 1_024, 4_096, 16_384, 65_536],
        make: light_grid,
        size: [640, 360],
        count: |scene| scene.point_lights.len() as u64,
    },
];

impl Sweep {
    /// The scene of a setting, with so many times fewer pixels across and down where they are not what is counted.
    pub(super) fn scene(&self, setting: u32, smaller: u32) -> Result<Scene> {
        (self.make)(setting, self.size.map(|side| side / smaller))
    }
}

/// On a floor, seen by a camera, with these meshes and lights.
fn on_a_floor(more: &str, size: [u32; 2]) -> Result<Scene> {
    let toml = format!(
        "[[camera]]\nname = \"main\"\nposition = [0, 2.5, 6]\ntarget = [0, 0.4, 0]\nvertical_fov = 45\n\
         [[material]]\nname = \"floor\"\ntype = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\n\
         [[material]]\nname = \"ball\"\ntype = \"metal\"\npreset = \"gold\"\nroughness = 0.4\n\
         [[mesh]]\nshape = \"plane\"\nsize = 12\nmaterial = \"floor\"\n{more}"
    );
    let mut scene = load_embedded("scaling.toml", &toml, &[], &[])?;
    scene.render.size = size;
    Ok(scene)
}

/// About so many triangles, those of 4 × 4 balls nearly square.
fn balls(triangles: u32, size: [u32; 2]) -> Result<Scene> {
    const BALLS: u32 = 16;
    // A ball has 2 · longitudes · (latitudes − 1).
    let rings = (f64::from(triangles / BALLS) / 4.0).sqrt().round().max(2.0);
    let longitudes = (f64::from(triangles / BALLS) / (2.0 * rings)).round().max(3.0);
    let ball = |index: u32| {
        let [x, z] = [index % 4, index / 4].map(|place| f64::from(place) - 1.5);
        format!(
            "[[mesh]]\nshape = \"sphere\"\nradius = 0.4\nsegments = [{longitudes}, {}]\nmaterial = \"floor\"\n\
             translate = [{x}, 0.4, {z}]\n",
            rings + 1.0
        )
    };
    let lights = "[[light]]\ntype = \"points\"\ngenerate = { count = 64, seed = 1, min = [-3, 0.5, -3], max = [3, 2, 3], \
         intensity = [0.1, 0.3], range = 2 }\n";
    on_a_floor(&((0..BALLS).map(ball).collect::<String>() + lights), size)
}

/// So many panels in a square of 4 m, which cover half of it.
fn panels(count: u32, size: [u32; 2]) -> Result<Scene> {
    let across = f64::from(count).sqrt().round();
    let half = 2.0 / across * 0.5_f64.sqrt();
    let panel = |index: u32| {
        let place = |index: f64| 4.0 * (index + 0.5) / across - 2.0;
        let (row, column) = ((f64::from(index) / across).floor(), f64::from(index) % across);
        format!(
            "[[light]]\ntype = \"rect\"\ncenter = [{}, 3, {}]\nu = [{half}, 0, 0]\nv = [0, 0, {half}]\n\
             radiance = [2, 2, 2]\n",
            place(column),
            place(row)
        )
    };
    let ball = "[[mesh]]\nshape = \"sphere\"\nradius = 0.6\nmaterial = \"ball\"\ntranslate = [0, 0.6, 0]\n"
        .to_owned();
    on_a_floor(&(ball + &(0..count).map(panel).collect::<String>()), size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every scene but the largest is sound and has what its setting says.
    #[test]
    fn counts() {
        for sweep in SWEEPS {
            for &setting in sweep.settings.iter().filter(|&&setting| setting <= 100_000) {
                let scene = sweep.scene(setting, 1).unwrap();
                assert!(scene.warnings.is_empty(), "{}: {:?}", sweep.name, scene.warnings);
                let wanted = match sweep.name {
                    PIXELS => f64::from(setting).powi(2) * 9.0 / 16.0,
                    _ => f64::from(setting),
                };
                let count = (sweep.count)(&scene) as f64;
                assert!((count - wanted).abs() <= 0.03 * wanted, "{}: {count} for {wanted}", sweep.name);
            }
        }
    }
}
